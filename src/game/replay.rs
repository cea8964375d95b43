//! Plays the moves of a scanned game and its variations, as far as they can be played.

use shakmaty::san::{SanError, SanPlus};
use shakmaty::variant::{Variant, VariantPosition};
use shakmaty::{Color, Move, Position, Setup};

use super::line::{Line, Token};
use super::movetext::{self, Reading, Written, tolerant};
use super::word::ascii_dashes;
use super::{Game, Notes, Ply, Problem, ScannedGame, Variation, start, tag};

/// Replays `scanned`, the game of that number in its file.
pub fn replay(scanned: ScannedGame, number: usize) -> Game {
    let ScannedGame { line, tags, unread_tags, start_is_lost, mut main, .. } = scanned;
    let from_fen = tag(&tags, "FEN").is_some();
    let first = main.tokens.first();
    let start = match (start::setup(&tags), first) {
        _ if start_is_lost => None,
        (Ok(_), Some(first)) if !from_fen && first.number.is_some_and(|number| number != 1) => {
            let what = "goes on with a game whose beginning is not known";
            main.problems.push(Problem::new(first.line, &first.text, what, true));
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
            Played::of(main, &position, 0, shift)
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
    /// start. Its numbers are `shift` ahead of the position's. Calls itself as deep as variations
    /// lie within each other, which the scanner bounds.
    fn of(line: Line, start: &VariantPosition, ply: usize, shift: i64) -> Played {
        let Line { mut tokens, movetext, variations, mut problems, .. } = line;
        let reading = movetext::read(&tokens, &movetext);
        let mut plies = Vec::with_capacity(tokens.len().min(USUAL_LENGTH));
        problems.extend(match start.clone() {
            // Most games are of standard chess, which is told here, not at every question to the rules.
            VariantPosition::Chess(start) => play(start, &tokens, &reading, shift, &mut plies),
            start => play(start, &tokens, &reading, shift, &mut plies),
        });
        for (ply, token) in plies.iter_mut().zip(&mut tokens) {
            ply.notes = token.notes.take().map(|notes| *notes).unwrap_or_default();
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
                    Played::of(variation.line, before, ply, shift);
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
            problems.push(Problem::new(first.line, &first.text, &what, true));
        }
        Played { problems, ..Played::default() }
    }
}

/// Plays move by move into `plies`; gives what stopped it. Where a number shows that a move is
/// missing, the moves since the last number that fits are taken back: each may be another one's.
fn play<P: Position + Clone + Into<VariantPosition>>(
    mut position: P,
    tokens: &[Token],
    reading: &Reading,
    shift: i64,
    plies: &mut Vec<Ply>,
) -> Option<Problem> {
    let mut certain = 0;
    for (index, token) in tokens.iter().enumerate() {
        let stop = |what: &str| Some(Problem::new(token.line, &token.text, what, true));
        if token.number.is_none() && ascii_dashes(&token.text).starts_with("-O") {
            // The torn end of a long castling: what went before is no short one.
            plies.pop();
        }
        if let Some(fault) = token.fault {
            return stop(fault);
        }
        let expected = i64::from(position.fullmoves().get()) + shift;
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
            && legal(&position, &tolerant(&format!("{letter}{}", token.text))).is_ok()
        {
            return stop(&format!("follows the letter {letter}, which may be its piece"));
        }
        let Some(written) = reading.written.get(index) else {
            return stop("cannot be read for certain");
        };
        let played = match legal(&position, written) {
            Ok(played) => played,
            Err(what) => return stop(what),
        };
        let san = SanPlus::from_move_and_play_unchecked(&mut position, played);
        plies.push(Ply {
            san: san.to_string(),
            played,
            after: position.clone().into(),
            notes: Notes::default(),
        });
    }
    let last = tokens.last().filter(|_| !reading.is_certain)?;
    let what = "is followed by something that may be a move";
    Some(Problem::new(last.line, &last.text, what, true))
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
    match (&written.san, by_squares) {
        (Some(san), by_squares) => match (san.to_move(position), by_squares) {
            (Ok(played), _) | (Err(_), Some(played)) => Ok(played),
            (Err(SanError::AmbiguousSan), None) => Err("can be more than one legal move"),
            (Err(SanError::IllegalSan), None) => Err("is no legal move"),
        },
        (None, Some(played)) => Ok(played),
        (None, None) if written.uci.is_some() => Err("is no legal move"),
        (None, None) => Err("is no move"),
    }
}
