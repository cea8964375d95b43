//! From tokens to moves as they are written; whether they are legal is asked later.
//!
//! pgn-reader reads the cut line. It says nothing of words that it drops (`b8Q`, `e2-e4`, `o-o`,
//! a castling with other hyphens), so its moves are held against the scanner's tokens: a token
//! that it dropped gets a tolerant reading here, and a move of which the scanner knows nothing
//! ends the line.

use std::ops::ControlFlow;

use pgn_reader::{Reader, SanPlus, Visitor};
use shakmaty::Role;
use shakmaty::san::San;
use shakmaty::uci::UciMove;

use super::line::Token;
use super::word::{ascii_dashes, is_null};

/// What a token may mean.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Written {
    pub san: Option<San>,
    /// The squares as UCI writes them, where the token has that form too (`g1f3`).
    pub uci: Option<UciMove>,
    /// Whether the player passes (`--`, `Z0`).
    pub passes: bool,
}

/// The meanings of tokens.
pub struct Reading {
    /// One a token, up to the last that is certain.
    pub written: Vec<Written>,
    /// Whether pgn-reader saw no move of which the scanner knows nothing.
    pub is_certain: bool,
}

/// Reads the tokens of a line, and holds them against what pgn-reader reads in its text.
pub fn read(tokens: &[Token], movetext: &[u8]) -> Reading {
    let mut written: Vec<Written> = tokens.iter().map(|token| tolerant(&token.text)).collect();
    let mut reached = 0;
    for san in moves(movetext) {
        let same = |written: &Written| written.san.as_ref() == Some(&san);
        match written[reached..].iter().position(same) {
            Some(skipped) => reached += skipped + 1,
            None => {
                written.truncate(reached);
                return Reading { written, is_certain: false };
            }
        }
    }
    Reading { written, is_certain: true }
}

/// The moves of a line, as pgn-reader sees them.
fn moves(movetext: &[u8]) -> Vec<San> {
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

/// Reads a token in the ways that files really write moves.
pub fn tolerant(token: &str) -> Written {
    let plain = plain(token);
    let san = SanPlus::from_ascii(plain.as_bytes()).ok().map(|san| san.san);
    Written {
        san: san.filter(|san| is_complete(san, &plain)),
        uci: uci(&plain),
        passes: is_null(token),
    }
}

/// Whether a token is written as a move, legal or not.
pub fn is_move(token: &str) -> bool {
    let written = tolerant(token);
    written.san.is_some() || written.uci.is_some()
}

/// Whether a move has not visibly lost a part: a capture names who captures, and a pawn's file is
/// named only where it leaves it.
fn is_complete(san: &San, text: &str) -> bool {
    let San::Normal { role: Role::Pawn, file, rank, to, .. } = san else {
        return true;
    };
    !text.starts_with('x') && (rank.is_some() || *file != Some(to.file()))
}

fn uci(text: &str) -> Option<UciMove> {
    let text = text.trim_end_matches(['+', '#']);
    // A drop is read as SAN.
    UciMove::from_ascii(text.as_bytes()).ok().filter(|m| matches!(m, UciMove::Normal { .. }))
}

/// The token as the standard writes it: castling with capital Os, no hyphen between squares, `=`
/// before what a pawn becomes, no `e.p.`, one sign of check.
fn plain(token: &str) -> String {
    let token = ascii_dashes(token);
    let body = token.trim_end_matches(['+', '#']);
    let check = if token.contains('#') {
        "#"
    } else if body.len() < token.len() {
        "+"
    } else {
        ""
    };
    let body = body.strip_suffix("e.p").or_else(|| body.strip_suffix("ep")).unwrap_or(body);
    let castling: String =
        body.chars().map(|c| if matches!(c, 'o' | '0') { 'O' } else { c }).collect();
    if matches!(castling.as_str(), "O-O" | "O-O-O") {
        return castling + check;
    }
    let mut squares = body.replace(':', "x");
    // `e2-e4`, `Ng1-f3`: the hyphen stands between two squares.
    if let Some((from, to)) = squares.split_once('-')
        && from.ends_with(|c: char| ('1'..='8').contains(&c))
        && to.starts_with(|c: char| ('a'..='h').contains(&c))
    {
        squares = format!("{from}{to}");
    }
    let promoted = squares.len().checked_sub(1).filter(|&last| {
        squares.is_char_boundary(last)
            && squares[last..].starts_with(['Q', 'R', 'B', 'N', 'K'])
            && squares[..last].ends_with(['1', '8'])
    });
    if let Some(last) = promoted {
        squares.insert(last, '=');
    }
    squares + check
}

#[cfg(test)]
mod tests {
    use super::*;

    fn san(text: &str) -> Option<San> {
        San::from_ascii(text.as_bytes()).ok()
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
        ];
        for (token, expected) in cases {
            let token = token.trim_end_matches('.');
            let expected = if token == "e4:d5" { "e4xd5" } else { expected };
            assert_eq!(tolerant(token).san, san(expected), "{token}");
        }
    }

    #[test]
    fn uci_moves_keep_their_squares() {
        assert_eq!(tolerant("g1f3").uci.map(|m| m.to_string()).as_deref(), Some("g1f3"));
        assert_eq!(tolerant("d7d8r").uci.map(|m| m.to_string()).as_deref(), Some("d7d8r"));
    }

    #[test]
    fn what_has_lost_a_part_is_no_move() {
        for token in ["xd5", "aa3", "-f3", "—f3", "B1C3", "Nf", "e9", "=Q"] {
            assert_eq!(tolerant(token).san, None, "{token}");
            assert_eq!(tolerant(token).uci, None, "{token}");
        }
        // A bishop on the first rank, never the squares b1 and c3.
        assert_eq!(tolerant("B1c3").uci, None);
    }

    #[test]
    fn a_move_that_only_pgn_reader_sees_ends_the_certainty() {
        let tokens =
            ["e4", "e5"].map(|text| Token { line: 1, text: text.to_owned(), ..Token::default() });
        for (movetext, certain, read_tokens) in
            [("e4 e5", true, 2), ("e4 d5 e5", false, 1), ("e4 e5 d5", false, 2)]
        {
            let reading = read(&tokens, movetext.as_bytes());
            assert_eq!((reading.is_certain, reading.written.len()), (certain, read_tokens));
        }
    }
}
