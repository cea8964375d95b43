//! Reading games: from PGN text to tags, a start position and legal moves.
//!
//! Four steps: `stream` unpacks what is packed; `scan` cuts it into games, each a main `line` of tokens with
//! variations; tokens become moves as written, which nearly all are `plain`, and the rest is read by `movetext` (with
//! pgn-reader, and a tolerant reading of what it drops); `replay` plays them. What comments and glyphs say becomes `notes`,
//! on the way. What cannot be read becomes a [`Problem`] with its line and token; a game is shown up to its last good move,
//! and the next game is read.

mod bytes;
mod clock;
mod command;
mod comment;
mod glyph;
mod letters;
mod line;
mod movetext;
mod notes;
mod outcome;
mod plain;
mod replay;
mod scan;
mod scanned;
mod select;
mod source;
mod start;
mod stream;
mod variant;
mod variation;
mod wanted;
mod word;

pub use clock::Clocks;
pub use letters::{Language, Letters, ParseLettersError};
pub use notes::{Eval, Notes};
pub use outcome::Ending;
pub use scan::{Head, Scanner};
pub use scanned::ScannedGame;
pub use select::{Absent, Moment, ParseMomentError, ParseSelectionError, Selection};
pub use source::{Games, Source, SourceError};
pub use start::{fen_in_hand, fen_position};
pub use stream::{Format, StreamError};
pub use variation::Branch;
pub use wanted::{
    ParsePatternError, ParsePlyRangeError, ParseTagTestError, Players, PlayersError, PlyRange,
    PositionPattern, TagTest, Wanted, WantedGames,
};

use shakmaty::fen::Fen;
use shakmaty::san::SanPlus;
use shakmaty::variant::{Variant, VariantPosition};
use shakmaty::{Bitboard, ByColor, ByRole, Color, EnPassantMode, Move, Position, Setup};

use crate::notation::Placement;
use crate::text;

/// One game of a file.
#[derive(Clone, Debug)]
pub struct Game {
    /// The game's number in its file, from 1.
    pub number: usize,
    /// The line where the game begins, from 1.
    pub line: usize,
    /// Name and value, in the order of the file.
    pub tags: Vec<(String, String)>,
    /// Tags that could not be read, as they stand in the file.
    pub unread_tags: Vec<String>,
    /// Whether it is known where the game starts; if not, no position of it can be shown, and
    /// `start` is empty.
    pub start_is_known: bool,
    /// The rules that it is played by; Chess960 is standard chess.
    pub variant: Variant,
    pub start: Setup,
    /// What comments say before the first move.
    pub start_notes: Notes,
    pub plies: Vec<Ply>,
    /// Lines that were not played, in the order of the file.
    pub variations: Vec<Variation>,
    /// The result as the movetext gives it, or the tag, or `*`.
    pub result: String,
    /// What could not be read, in the order of the file.
    pub problems: Vec<Problem>,
}

/// A move that was played, and the position after it.
#[derive(Clone, Debug)]
pub struct Ply {
    /// In standard algebraic notation, with `+` or `#`.
    pub san: SanPlus,
    pub played: Move,
    pub after: VariantPosition,
    /// What comments and glyphs say of it.
    pub notes: Notes,
}

/// Moves that might have been played instead.
#[derive(Clone, Debug)]
pub struct Variation {
    /// Half-moves from the game's start to the position where it begins: it replaces move
    /// `plies[ply]` of the line that it belongs to.
    pub ply: usize,
    pub plies: Vec<Ply>,
    /// Variations of this one, with their `ply` counted from the game's start too.
    pub variations: Vec<Variation>,
    /// What could not be read in it; the game itself is none the worse for it.
    pub problems: Vec<Problem>,
}

/// Something in the text that could not be used.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize, thiserror::Error)]
#[error("line {line}: `{token}` {what}")]
pub struct Problem {
    pub line: usize,
    /// The text in question, shortened where it is long.
    pub token: String,
    /// A clause that goes on after the token.
    pub what: String,
    /// Whether moves may be missing because of it.
    pub loses_moves: bool,
}

/// How many characters of a token are kept in a problem.
const LONGEST_TOKEN: usize = 80;

impl Problem {
    /// A problem with a token that is made fit for print: no control characters, not too long.
    fn new(line: usize, token: &str, what: &str, loses_moves: bool) -> Problem {
        let token = text::shortened(&text::printable(token), LONGEST_TOKEN);
        Problem { line, token, what: what.to_owned(), loses_moves }
    }
}

impl Game {
    /// Reads and replays a game that the scanner has cut out, number `number` of its file.
    pub fn read(scanned: ScannedGame, number: usize) -> Game {
        Game::read_in(scanned, number, Letters::Auto)
    }

    /// Like [`Game::read`], with the letters that its pieces have.
    pub fn read_in(scanned: ScannedGame, number: usize, letters: Letters) -> Game {
        replay::replay(scanned, number, letters)
    }

    /// A stretch of text that is no game.
    fn nothing(number: usize, line: usize, problems: Vec<Problem>) -> Game {
        Game {
            number,
            line,
            tags: Vec::new(),
            unread_tags: Vec::new(),
            start_is_known: false,
            variant: Variant::Chess,
            start: Setup::empty(),
            start_notes: Notes::default(),
            plies: Vec::new(),
            variations: Vec::new(),
            result: "*".to_owned(),
            problems: problems
                .into_iter()
                .map(|problem| Problem { loses_moves: true, ..problem })
                .collect(),
        }
    }

    /// Whether every move of the text was understood and played.
    pub fn is_whole(&self) -> bool {
        !self.problems.iter().any(|problem| problem.loses_moves)
    }

    /// The value of the tag `name`, unless it is missing, empty or `?`.
    pub fn tag(&self, name: &str) -> Option<&str> {
        tag(&self.tags, name).filter(|value| !value.is_empty() && *value != "?")
    }

    /// Who plays `color`, or `?`.
    pub fn player(&self, color: Color) -> &str {
        self.tag(color.fold_wb("White", "Black")).unwrap_or("?")
    }

    /// Where pieces stand after `ply` half-moves; `ply` is at most `plies.len()`.
    pub fn placement(&self, ply: usize) -> Placement {
        match ply.checked_sub(1) {
            None => Placement::from(&self.start.board),
            Some(index) => Placement::from(self.plies[index].after.board()),
        }
    }

    /// The position after `ply` half-moves, as far as it can be played.
    pub fn position(&self, ply: usize) -> Option<VariantPosition> {
        match ply.checked_sub(1) {
            None => start::position(self.variant, &self.start).ok(),
            Some(index) => self.plies.get(index).map(|ply| ply.after.clone()),
        }
    }

    /// What the players have in hand after `ply` half-moves, where the rules let them drop it.
    pub fn in_hand(&self, ply: usize) -> Option<ByColor<ByRole<u8>>> {
        match ply.checked_sub(1) {
            _ if self.variant != Variant::Crazyhouse => None,
            None => Some(self.start.pockets.unwrap_or_default()),
            Some(index) => self.plies[index].after.pockets().copied(),
        }
    }

    /// Where pieces stand after `ply` half-moves that were pawns, and become ones again when they are captured.
    pub fn promoted(&self, ply: usize) -> Bitboard {
        match ply.checked_sub(1) {
            None => self.start.promoted,
            Some(index) => self.plies[index].after.promoted(),
        }
    }

    /// What comments and glyphs say of the position after `ply` half-moves.
    pub fn notes(&self, ply: usize) -> &Notes {
        ply.checked_sub(1)
            .and_then(|index| self.plies.get(index))
            .map_or(&self.start_notes, |ply| &ply.notes)
    }

    /// The position after `ply` half-moves as a FEN, with an en passant square only where the
    /// capture is legal.
    pub fn fen(&self, ply: usize) -> String {
        match ply.checked_sub(1) {
            None => start::fen(self.variant, &self.start),
            Some(index) => {
                Fen::from_position(&self.plies[index].after, EnPassantMode::Legal).to_string()
            }
        }
    }

    /// The name of the position after `ply` half-moves: `17w`, or `start`.
    pub fn moment_name(&self, ply: usize) -> String {
        match ply {
            0 => "start".to_owned(),
            1 => self.first_move(),
            _ => {
                let before = &self.plies[ply - 2].after;
                format!("{}{}", before.fullmoves(), before.turn().char())
            }
        }
    }

    /// The name of the first move that the game can have: `1w`, or from a FEN another.
    pub fn first_move(&self) -> String {
        format!("{}{}", self.start.fullmoves, self.start.turn.char())
    }

    /// The move that led to the position after `ply` half-moves, if there are that many; none leads
    /// to the start.
    pub fn san(&self, ply: usize) -> Option<String> {
        Some(self.plies.get(ply.checked_sub(1)?)?.san.to_string())
    }
}

fn tag<'a>(tags: &'a [(String, String)], name: &str) -> Option<&'a str> {
    tags.iter().find(|(known, _)| known.eq_ignore_ascii_case(name)).map(|(_, value)| value.as_str())
}

/// Whether the value of a tag says anything: what is empty, `?` or `????.??.??` does not.
fn is_known(value: &str) -> bool {
    value.chars().any(|c| !matches!(c, '?' | '.') && !c.is_whitespace())
}
