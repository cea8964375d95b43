//! Plays the moves of a scanned game and its variations, as far as they can be played.

use shakmaty::san::{San, SanError, SanPlus, Suffix};
use shakmaty::variant::{Variant, VariantPosition};
use shakmaty::{Color, File, Move, Position, Role, Setup};

use super::letters::{Language, Letters};
use super::line::{Line, Spelled, Token};
use super::movetext::{self, Reading, Written};
use super::word::ascii_dashes;
use super::{Game, Notes, Ply, Problem, ScannedGame, Variation, start, tag};

/// Replays `scanned`, the game of that number in its file.
pub fn replay(scanned: ScannedGame, number: usize, letters: Letters) -> Game {
    let ScannedGame { line, tags, unread_tags, start_is_lost, mut main, .. } = scanned;
    let from_fen = tag(&tags, "FEN").is_some();
    let first = main.tokens.first();
    let start = match (start::setup(&tags), first) {
        _ if start_is_lost => None,
        (Ok(_), Some(first)) if !from_fen && first.number.is_some_and(|number| number != 1) => {
            let what = "goes on with a game whose beginning is not known";
            main.problems.push(Problem::new(first.line, &first.text(), what, true));
            None
        }
        (Ok(start), _) => Some(start),
        (Err(refusal), _) => {
            main.problems.push(Problem::new(line, &refusal.token, &refusal.what, true));
            None
        }
    };
    let start_notes = main.notes.take().map(|notes| *notes).unwrap_or_default();
    let result = main.result.or_else(|| tag(&tags, "Result")).unwrap_or("*").to_owned();
    let start_is_known = start.is_some();
    let (variant, start) = start.unwrap_or((Variant::Chess, Setup::empty()));
    let played = match start_is_known.then(|| start::position(variant, &start)) {
        Some(Ok(position)) => {
            let shift = numbering_shift(&position, &main.tokens);
            let letters = match letters {
                Letters::Of(language) => language,
                Letters::Auto => find_language(&mut main, &position, shift),
            };
            Played::of(main, &position, 0, Way { shift, letters })
        }
        Some(Err(error)) => Played::nothing(main, &error),
        None => Played { problems: main.problems, ..Played::default() },
    };
    let Played { plies, variations, mut problems } = played;
    problems.sort_by_key(|problem| problem.line);
    Game {
        number,
        line,
        tags,
        unread_tags,
        start_is_known,
        variant,
        start,
        start_notes,
        plies,
        variations,
        result,
        problems,
    }
}

/// The language whose letters a line is written in. It is English, unless a move has no meaning in
/// that, and all of the line can be played in one other language, or in several with the same
/// moves. Where it can be played in several ways, it stops at the first move in question. A line is
/// never read in two languages.
fn find_language(main: &mut Line, start: &VariantPosition, shift: i64) -> Language {
    let reads = |token: &Token, letters| token.written(letters).is_anything();
    let is_foreign = |token: &Token| match &token.spelled {
        Spelled::Plain(_) => false,
        // A Dutch knight looks like a pawn.
        Spelled::Other(text) => text.starts_with('P') || !reads(token, Language::ENGLISH),
    };
    let Some(foreign) = main.tokens.iter().position(is_foreign) else {
        return Language::ENGLISH;
    };
    if main.tokens.iter().any(|token| token.fault.is_some()) {
        return Language::ENGLISH;
    }
    let mut found: Option<(Language, Vec<Ply>)> = None;
    for letters in Language::ALL {
        if !main.tokens.iter().all(|token| reads(token, letters)) {
            continue;
        }
        let mut plies = Vec::new();
        let way = Way { shift, letters };
        let reading = movetext::read(main, letters);
        if play(start, &main.tokens, &reading, way, &mut plies).is_some() {
            continue;
        }
        let is_same = |(a, b): (&Ply, &Ply)| a.played == b.played;
        match &found {
            None => found = Some((letters, plies)),
            Some((_, known)) if known.iter().zip(&plies).all(is_same) => {}
            Some(_) => {
                let what = "means one move in one language and another in another, and all of the \
                            game can be played in both";
                main.tokens[foreign].fault = Some(what);
                return Language::ENGLISH;
            }
        }
    }
    let Some((letters, _)) = found.filter(|(letters, _)| !letters.is_english()) else {
        return Language::ENGLISH;
    };
    let token = &main.tokens[foreign];
    let (line, text) = (token.line, token.text().into_owned());
    main.remark(line, &text, &format!("and the other moves have {letters} letters"));
    letters
}

/// How the tokens of a game are to be understood.
#[derive(Clone, Copy)]
struct Way {
    /// What the numbers of the text are ahead of the position's.
    shift: i64,
    letters: Language,
}

/// Half-moves that few games have more of.
const USUAL_LENGTH: usize = 256;

/// What could be played of a line.
#[derive(Default)]
struct Played {
    plies: Vec<Ply>,
    variations: Vec<Variation>,
    problems: Vec<Problem>,
}

impl Played {
    /// Plays `line` and its variations from `start`, which is `ply` half-moves from the game's
    /// start. Calls itself as deep as variations lie within each other, which the scanner bounds.
    fn of(line: Line, start: &VariantPosition, ply: usize, way: Way) -> Played {
        let reading = movetext::read(&line, way.letters);
        let Line { mut tokens, variations, mut problems, .. } = line;
        let mut plies = Vec::with_capacity(tokens.len().min(USUAL_LENGTH));
        problems.extend(play(start, &tokens, &reading, way, &mut plies));
        for (ply, token) in plies.iter_mut().zip(&mut tokens) {
            if let Some(notes) = token.notes.take() {
                ply.notes = *notes;
            }
        }
        // Behind the last good move it is not known what a variation would replace.
        let (attached, left_out): (Vec<_>, Vec<_>) =
            variations.into_iter().partition(|variation| variation.replaces < plies.len());
        if let Some(first) = left_out.first() {
            let what = match left_out.len() {
                1 => "opens a variation behind the last good move; it is left out".to_owned(),
                n => format!(
                    "opens the first of {n} variations behind the last good move; they are left out"
                ),
            };
            problems.push(Problem::new(first.opened, "(", &what, false));
        }
        let variations = attached
            .into_iter()
            .map(|variation| {
                let index = variation.replaces;
                let before = index.checked_sub(1).map_or(start, |index| &plies[index].after);
                let ply = ply + index;
                let Played { plies, variations, mut problems } =
                    Played::of(variation.line, before, ply, way);
                problems.sort_by_key(|problem| problem.line);
                Variation { ply, plies, variations, problems }
            })
            .collect();
        Played { plies, variations, problems }
    }

    /// Plays nothing, since there is no position to play from.
    fn nothing(line: Line, error: &str) -> Played {
        let mut problems = line.problems;
        if let Some(first) = line.tokens.first() {
            let what = format!("cannot be played from the FEN: {error}");
            problems.push(Problem::new(first.line, &first.text(), &what, true));
        }
        Played { problems, ..Played::default() }
    }
}

/// Plays move by move into `plies`; gives what stopped it. Where a number shows that a move is
/// missing, the moves since the last number that fits are taken back: each may be another one's.
fn play(
    start: &VariantPosition,
    tokens: &[Token],
    reading: &Reading,
    way: Way,
    plies: &mut Vec<Ply>,
) -> Option<Problem> {
    match start.clone() {
        // Most games are of standard chess, which is told here, not at every question to the rules.
        VariantPosition::Chess(start) => play_from(start, tokens, reading, way, plies),
        start => play_from(start, tokens, reading, way, plies),
    }
}

fn play_from<P: Position + Clone + Into<VariantPosition>>(
    mut position: P,
    tokens: &[Token],
    reading: &Reading,
    way: Way,
    plies: &mut Vec<Ply>,
) -> Option<Problem> {
    let mut certain = 0;
    for (index, token) in tokens.iter().enumerate() {
        let stop = |what: &str| Some(Problem::new(token.line, &token.text(), what, true));
        if is_torn_castling(token) {
            // The torn end of a long castling: what went before is no short one.
            plies.pop();
        }
        if let Some(fault) = token.fault {
            return stop(fault);
        }
        let expected = i64::from(position.fullmoves().get()) + way.shift;
        if let Some(found) = token.number.filter(|found| i64::from(*found) != expected) {
            plies.truncate(certain);
            return stop(&format!("is numbered {found}, expected {expected}"));
        }
        if token.is_blacks && position.turn() == Color::White {
            plies.truncate(certain);
            return stop("is marked as a move of Black, but White is to move");
        }
        if token.number.is_some() {
            certain = plies.len();
        }
        if let Some(letter) = token.letter
            && let text = format!("{letter}{}", token.text())
            && legal(&position, &movetext::tolerant(&text, way.letters)).is_ok()
        {
            return stop(&format!("follows the letter {letter}, which may be its piece"));
        }
        if index >= reading.certain {
            return stop("cannot be read for certain");
        }
        let written = token.written(way.letters);
        let played = match legal(&position, &written) {
            Ok(played) => played,
            Err(what) => return stop(what),
        };
        let san = match token.spelled {
            Spelled::Plain(plain) if way.letters.is_english() && is_shortest(plain.san, played) => {
                plain.san
            }
            _ => San::from_move(&position, played),
        };
        position.play_unchecked(played);
        let san = SanPlus { san, suffix: Suffix::from_position(&position) };
        plies.push(Ply { san, played, after: position.clone().into(), notes: Notes::default() });
    }
    let last = tokens.last().filter(|_| !reading.is_certain)?;
    let what = "is followed by something that may be a move";
    Some(Problem::new(last.line, &last.text(), what, true))
}

/// Whether a token is the torn end of a long castling (`-O`).
fn is_torn_castling(token: &Token) -> bool {
    let Spelled::Other(text) = &token.spelled else {
        return false;
    };
    token.number.is_none() && ascii_dashes(text).starts_with("-O")
}

/// Whether the plain word of a move, which can mean no other, is its shortest form: it names no
/// square that the piece comes from, but for a pawn's file, and says whether it captures.
fn is_shortest(san: San, played: Move) -> bool {
    match san {
        San::Normal { role, file, rank, capture, .. } => {
            capture == played.is_capture()
                && rank.is_none()
                && (role == Role::Pawn || file.is_none())
        }
        San::Castle(_) => true,
        San::Put { .. } | San::Null => false,
    }
}

/// What the numbers of the text are ahead of the position's. Texts count on from a FEN, from 1, or
/// rightly from a FEN that says nothing but 1.
fn numbering_shift(position: &VariantPosition, tokens: &[Token]) -> i64 {
    let counted = i64::from(position.fullmoves().get());
    match tokens.first().and_then(|token| token.number).map(i64::from) {
        Some(first) if first == 1 || counted == 1 => first - counted,
        _ => 0,
    }
}

/// The legal move that is meant, or a clause that says what is wrong.
fn legal(position: &impl Position, written: &Written) -> Result<Move, &'static str> {
    if written.passes {
        return Err("is a null move, which no position can show");
    }
    let by_squares = written.uci.as_ref().and_then(|uci| uci.to_move(position).ok());
    let by_files = || written.files.map(|files| by_files(position, files));
    match (&written.san, by_squares) {
        (Some(san), by_squares) => match (to_move(position, *san), by_squares) {
            (Ok(played), _) | (Err(_), Some(played)) => Ok(played),
            (Err(SanError::AmbiguousSan), None) => Err("can be more than one legal move"),
            (Err(SanError::IllegalSan), None) => Err("is no legal move"),
        },
        (None, Some(played)) => Ok(played),
        (None, None) if written.uci.is_some() => Err("is no legal move"),
        (None, None) => by_files().unwrap_or(Err("is no move")),
    }
}

/// The move that is written, a capture with its `x` or without.
fn to_move(position: &impl Position, san: San) -> Result<Move, SanError> {
    match (san.to_move(position), san) {
        (
            Err(SanError::IllegalSan),
            San::Normal { role, file, rank, capture: false, to, promotion },
        ) if role != Role::Pawn || file.is_some() => {
            San::Normal { role, file, rank, capture: true, to, promotion }.to_move(position)
        }
        (result, _) => result,
    }
}

/// The one capture of a pawn that goes from one file to another.
fn by_files(position: &impl Position, (from, to): (File, File)) -> Result<Move, &'static str> {
    let moves = position.legal_moves();
    let mut captures = moves.iter().filter(|m| {
        let goes = |square: shakmaty::Square| square.file() == from && m.to().file() == to;
        m.role() == Role::Pawn && m.is_capture() && m.from().is_some_and(goes)
    });
    match (captures.next(), captures.next()) {
        (Some(played), None) => Ok(*played),
        (Some(_), Some(_)) => Err("can be more than one legal move"),
        (None, _) => Err("is no legal move"),
    }
}
