//! From tokens to moves as they are written; whether they are legal is asked later.
//!
//! A token that is not plain gets a tolerant reading here. pgn-reader reads such a line too. It says
//! nothing of words that it drops (`b8Q`, `e2-e4`, `o-o`, a castling with other hyphens), so its
//! moves are held against the scanner's tokens: a move of which the scanner knows nothing ends the
//! line. Of a line of plain words alone it reads the same, see `plain`.

use std::ops::ControlFlow;

use pgn_reader::{Reader, SanPlus, Visitor};
use shakmaty::san::San;
use shakmaty::uci::UciMove;
use shakmaty::{File, Role};

use super::letters::Language;
use super::line::Line;
use super::word::{ascii_dashes, is_null};

/// What a token may mean.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Written {
    pub san: Option<San>,
    /// The squares as UCI writes them, where the token has that form too (`g1f3`).
    pub uci: Option<UciMove>,
    /// The files that a pawn goes from and to, where its capture says no more (`ed`).
    pub files: Option<(File, File)>,
    /// Whether the player passes (`--`, `Z0`).
    pub passes: bool,
}

impl Written {
    /// Whether it is a move of some kind, or the lack of one.
    pub fn is_anything(&self) -> bool {
        *self != Written::default()
    }
}

/// How far a line's tokens can be trusted.
#[derive(Debug, PartialEq, Eq)]
pub struct Reading {
    /// How many tokens are certain.
    pub certain: usize,
    /// Whether pgn-reader saw no move of which the scanner knows nothing.
    pub is_certain: bool,
}

/// Holds the tokens of a line against what pgn-reader reads in its text; there is nothing to hold
/// them against where its letters are not English.
pub fn read(line: &Line, letters: Language) -> Reading {
    let count = line.tokens.len();
    if line.movetext.is_empty() || !letters.is_english() {
        return Reading { certain: count, is_certain: true };
    }
    let mut reached = 0;
    for san in moves(&line.movetext) {
        let same = |written: Written| written.san == Some(san);
        let rest = &line.tokens[reached..];
        match rest.iter().position(|token| same(token.written(letters))) {
            Some(skipped) => reached += skipped + 1,
            None => return Reading { certain: reached, is_certain: false },
        }
    }
    Reading { certain: count, is_certain: true }
}

/// The moves of a line, as pgn-reader sees them.
pub fn moves(movetext: &[u8]) -> Vec<San> {
    let read = Reader::new(movetext).read_game(&mut Moves);
    read.ok().flatten().unwrap_or_default()
}

struct Moves;

impl Visitor for Moves {
    type Tags = ();
    type Movetext = Vec<San>;
    type Output = Vec<San>;

    fn begin_tags(&mut self) -> ControlFlow<Vec<San>> {
        ControlFlow::Continue(())
    }

    fn begin_movetext(&mut self, (): ()) -> ControlFlow<Vec<San>, Vec<San>> {
        ControlFlow::Continue(Vec::new())
    }

    fn san(&mut self, moves: &mut Vec<San>, san: SanPlus) -> ControlFlow<Vec<San>> {
        moves.push(san.san);
        ControlFlow::Continue(())
    }

    fn end_game(&mut self, moves: Vec<San>) -> Vec<San> {
        moves
    }
}

/// Reads a token in the ways that files really write moves; its pieces have the letters of a
/// language.
pub fn tolerant(token: &str, letters: Language) -> Written {
    let passes = is_null(token);
    let Some(plain) = plain(token, letters) else {
        return Written { passes, ..Written::default() };
    };
    let san = SanPlus::from_ascii(plain.as_bytes()).ok().map(|san| san.san);
    Written {
        san: san.filter(|san| is_complete(san, &plain)),
        uci: uci(&plain),
        files: files(&plain),
        passes,
    }
}

/// Whether a token is written as a move, legal or not, in one language or another.
pub fn is_move(token: &str) -> bool {
    let is_move = |letters| {
        let written = tolerant(token, letters);
        written.san.is_some() || written.uci.is_some()
    };
    Language::ALL.into_iter().any(is_move)
}

/// Whether a move has not visibly lost a part: a capture names who captures, and a pawn's file is
/// named only where it leaves it.
fn is_complete(san: &San, text: &str) -> bool {
    let San::Normal { role: Role::Pawn, file, rank, to, .. } = san else {
        return true;
    };
    !text.starts_with('x') && (rank.is_some() || *file != Some(to.file()))
}

/// Squares as UCI writes them, from a move as the standard writes it.
fn uci(text: &str) -> Option<UciMove> {
    // A drop is read as SAN.
    let text = text.trim_end_matches(['+', '#']).replace('=', "");
    let (squares, promotion) = text.split_at_checked(4)?;
    let text = format!("{squares}{}", promotion.to_ascii_lowercase());
    UciMove::from_ascii(text.as_bytes()).ok().filter(|m| matches!(m, UciMove::Normal { .. }))
}

/// The files of a pawn's capture that names no rank: `ed`, `exd`.
fn files(text: &str) -> Option<(File, File)> {
    let text = text.trim_end_matches(['+', '#']);
    let (from, to) = match text.as_bytes() {
        [from, to] | [from, b'x', to] => (from, to),
        _ => return None,
    };
    let file = |byte: &u8| File::from_char(char::from(*byte));
    let (from, to) = (file(from)?, file(to)?);
    (from.distance(to) == 1).then_some((from, to))
}

/// The token as the standard writes it: English letters, castling with capital Os, no hyphen between
/// squares, `=` before what a pawn becomes, `x` before where it is captured, no `e.p.`, one sign of
/// check. `None` if it has a letter that is none of the language's.
fn plain(token: &str, letters: Language) -> Option<String> {
    let token = ascii_dashes(token).replace(['\u{fe0e}', '\u{fe0f}'], "");
    let body = token.trim_end_matches(CHECKS);
    let check = match &token[body.len()..] {
        "" => "",
        signs if signs.contains(['#', '‡']) => "#",
        _ => "+",
    };
    let body = body.strip_suffix("e.p").or_else(|| body.strip_suffix("ep")).unwrap_or(body);
    let castling: String =
        body.chars().map(|c| if matches!(c, 'o' | '0') { 'O' } else { c }).collect();
    match castling.as_str() {
        "O-O" | "OO" => return Some(format!("O-O{check}")),
        "O-O-O" | "OOO" => return Some(format!("O-O-O{check}")),
        _ => {}
    }
    let (piece, rest) = match figurine(body).or_else(|| letters.piece(body)) {
        Some(found) => found,
        // Squares; or a letter that no piece has.
        None if body.starts_with(|c: char| c.is_ascii_lowercase() || !c.is_alphabetic()) => {
            ("", body)
        }
        None if is_null(body) => ("", body),
        None => return None,
    };
    let (squares, promotion) = match promoted(rest, letters) {
        Some((squares, role)) if piece.is_empty() => (squares, Some(role)),
        _ => (rest, None),
    };
    let mut squares = squares.replace(':', "x");
    // `e2-e4`, `Ng1-f3`: the hyphen stands between two squares.
    if let Some((from, to)) = squares.split_once('-')
        && from.ends_with(|c: char| ('1'..='8').contains(&c))
        && to.starts_with(|c: char| ('a'..='h').contains(&c))
    {
        squares = format!("{from}{to}");
    }
    // `Nd5:` is a capture.
    if let Some(before) = squares.strip_suffix('x')
        && let Some((from, to)) =
            before.len().checked_sub(2).and_then(|n| before.split_at_checked(n))
        && !from.contains('x')
        && to.starts_with(|c: char| c.is_ascii_lowercase())
    {
        squares = format!("{from}x{to}");
    }
    let promotion = promotion.map(|role| format!("={role}")).unwrap_or_default();
    Some(format!("{piece}{squares}{promotion}{check}"))
}

/// Signs of check and mate.
const CHECKS: [char; 4] = ['+', '#', '†', '‡'];

/// Cuts a drawn piece from the front of `text`: its English letter (none for a pawn), and the rest.
fn figurine(text: &str) -> Option<(&'static str, &str)> {
    let first = text.chars().next()?;
    let piece = match first {
        '♔' | '♚' => "K",
        '♕' | '♛' => "Q",
        '♖' | '♜' => "R",
        '♗' | '♝' => "B",
        '♘' | '♞' => "N",
        '♙' | '♟' => "",
        _ => return None,
    };
    Some((piece, &text[first.len_utf8()..]))
}

/// Cuts what a pawn becomes from the end of a move (`b8=Q`, `b8Q`, `b8(Q)`, `b8/Q`): the squares,
/// and an English letter.
fn promoted(text: &str, letters: Language) -> Option<(&str, &'static str)> {
    let rank = text.rfind(['1', '8'])?;
    let (squares, behind) = text.split_at(rank + 1);
    let named = behind.trim_start_matches('=');
    let named = match named.strip_prefix('(') {
        Some(inner) => inner.strip_suffix(')')?,
        None => named.trim_start_matches('/'),
    };
    let upper = named.to_uppercase();
    let (role, rest) = figurine(&upper).or_else(|| letters.piece(&upper)).or_else(|| {
        // UCI's letters are the same everywhere.
        (named == behind).then(|| Language::ENGLISH.piece(&upper)).flatten()
    })?;
    // `d8b` is no more than a piece of something.
    let is_small = named == behind && named.starts_with(|c: char| c.is_lowercase());
    if is_small && squares.len() != "e7e8".len() {
        return None;
    }
    (rest.is_empty() && !role.is_empty()).then_some((squares, role))
}

#[cfg(test)]
mod tests {
    use super::super::letters::Letters;
    use super::super::line::{Spelled, Token};
    use super::*;

    fn san(text: &str) -> Option<San> {
        San::from_ascii(text.as_bytes()).ok()
    }

    fn english(token: &str) -> Written {
        tolerant(token, Language::ENGLISH)
    }

    #[test]
    fn moves_are_read_as_files_write_them() {
        let cases = [
            ("Nf3", "Nf3"),
            ("b8Q", "b8=Q"),
            ("axb8Q+", "axb8=Q"),
            ("e2-e4", "e2e4"),
            ("Ng1-f3", "Ng1f3"),
            ("e4:d5", "exd5"),
            ("exf6ep", "exf6"),
            ("exf6e.p.", "exf6"),
            ("o-o", "O-O"),
            ("0-0-0", "O-O-O"),
            ("O‑O", "O-O"),
            ("O–O–O+", "O-O-O"),
            ("Nf6++", "Nf6"),
            ("N@f3", "N@f3"),
            ("@e4", "@e4"),
            ("P@e4+", "@e4"),
            ("b8K", "b8=K"),
            ("b8(Q)", "b8=Q"),
            ("b8=(N)", "b8=N"),
            ("axb8/R+", "axb8=R"),
            ("b8=q", "b8=Q"),
            ("b8=♕", "b8=Q"),
            ("Nd5:", "Nxd5"),
            ("ed5", "ed5"),
            ("OOO", "O-O-O"),
            ("♘f3", "Nf3"),
            ("♞g8—f6", "Ng8f6"),
            ("♙e2-e4", "e2e4"),
            ("♗\u{fe0e}b5†", "Bb5"),
        ];
        for (token, expected) in cases {
            let token = token.trim_end_matches('.');
            let expected = if token == "e4:d5" { "e4xd5" } else { expected };
            assert_eq!(english(token).san, san(expected), "{token}");
        }
    }

    #[test]
    fn uci_moves_keep_their_squares() {
        assert_eq!(english("g1f3").uci.map(|m| m.to_string()).as_deref(), Some("g1f3"));
        assert_eq!(english("d7d8r").uci.map(|m| m.to_string()).as_deref(), Some("d7d8r"));
    }

    #[test]
    fn what_has_lost_a_part_is_no_move() {
        for token in ["xd5", "aa3", "-f3", "—f3", "B1C3", "Nf", "e9", "=Q"] {
            assert_eq!(english(token).san, None, "{token}");
            assert_eq!(english(token).uci, None, "{token}");
        }
        // A bishop on the first rank, never the squares b1 and c3.
        assert_eq!(english("B1c3").uci, None);
    }

    #[test]
    fn letters_of_other_languages_are_read_as_theirs_alone() {
        let cases = [
            ("german", "Sf3", Some("Nf3")),
            ("german", "Dxd8+", Some("Qxd8")),
            ("german", "e8D", Some("e8=Q")),
            ("german", "Nf3", None),
            ("czech", "Jf3", Some("Nf3")),
            ("czech", "bxa1=V", Some("bxa1=R")),
            ("french", "Fb5", Some("Bb5")),
            ("french", "Re2", Some("Ke2")),
            ("dutch", "Pf3", Some("Nf3")),
            ("russian", "Крe2", Some("Ke2")),
            ("russian", "♘f3", Some("Nf3")),
            ("spanish", "0-0", Some("O-O")),
            ("english", "Sf3", None),
        ];
        for (language, token, expected) in cases {
            let Ok(Letters::Of(letters)) = language.parse() else {
                panic!("{language}");
            };
            let found = tolerant(token, letters).san;
            assert_eq!(found, expected.and_then(san), "{language} {token}");
        }
    }

    #[test]
    fn a_move_that_only_pgn_reader_sees_ends_the_certainty() {
        let spelled = |text: &str| Spelled::Other(text.into());
        let tokens =
            || ["e4", "e5"].map(|text| Token { spelled: spelled(text), ..Token::default() });
        for (movetext, is_certain, certain) in
            [("e4 e5", true, 2), ("e4 d5 e5", false, 1), ("e4 e5 d5", false, 2)]
        {
            let mut line = Line::default();
            line.tokens = tokens().into();
            line.movetext = movetext.into();
            assert_eq!(read(&line, Language::ENGLISH), Reading { certain, is_certain });
        }
    }
}
