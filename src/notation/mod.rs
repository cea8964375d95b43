//! The thesis's piece notation, and the seam of the program: the chess side ends in a
//! [`Placement`], the picture side starts from one.
//!
//! One string a player: a piece letter, a file `A`–`H` and a rank `1`–`8`, again and again. The
//! letters are Czech: `K` král (king), `D` dáma (queen), `V` věž (rook), `S` střelec (bishop),
//! `J` jezdec (knight), `P` pěšec (pawn).
//!
//! ```
//! use lightsquare::notation::{Color, Placement, Square};
//!
//! let placement = Placement::parse("KE1PA2", "KE8")?;
//! assert_eq!(placement.notation(Color::White), "KE1PA2");
//! assert!(placement.get(Square::A2).is_some());
//! # Ok::<(), lightsquare::notation::NotationError>(())
//! ```

mod marks;

pub use marks::{Arrow, Brush, Circle, ParseMarkError};

use shakmaty::fen::Fen;
pub use shakmaty::{Board, Color, File, Piece, Rank, Role, Square};

/// Which pieces stand where; no rule of chess is asked.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Placement {
    squares: [Option<Piece>; 64],
}

/// Why a string is no notation of a player's pieces. Positions count characters from 1.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NotationError {
    #[error("{player}: `{found}` at character {at} is no piece, expected K, D, V, S, J or P")]
    NoPiece { player: Color, at: usize, found: char },
    #[error("{player}: `{found}` at character {at} is no file, expected A to H")]
    NoFile { player: Color, at: usize, found: char },
    #[error("{player}: `{found}` at character {at} is no rank, expected 1 to 8")]
    NoRank { player: Color, at: usize, found: char },
    #[error(
        "{player}: the string ends at character {at} within a piece, expected a letter, a file and a rank"
    )]
    Incomplete { player: Color, at: usize },
    #[error(
        "{player}: the piece `{second}` at character {at} stands on the square of {} `{first}`",
        if player == first_player { "the".to_owned() } else { format!("{first_player}'s") }
    )]
    Occupied {
        player: Color,
        at: usize,
        /// The piece that came first, as it was written, and whose it is.
        first: String,
        first_player: Color,
        second: String,
    },
}

const LETTERS: [(char, Role); 6] = [
    ('K', Role::King),
    ('D', Role::Queen),
    ('V', Role::Rook),
    ('S', Role::Bishop),
    ('J', Role::Knight),
    ('P', Role::Pawn),
];

impl Placement {
    /// The empty board.
    pub const EMPTY: Placement = Placement { squares: [None; 64] };

    /// Reads both players' strings; small letters are as good as capitals.
    ///
    /// # Errors
    /// A character that is no piece, file or rank in its place, a string that ends too early, or
    /// two pieces on one square.
    pub fn parse(white: &str, black: &str) -> Result<Placement, NotationError> {
        let mut placement = Placement::EMPTY;
        for (player, text) in [(Color::White, white), (Color::Black, black)] {
            placement.add(player, text)?;
        }
        Ok(placement)
    }

    fn add(&mut self, player: Color, text: &str) -> Result<(), NotationError> {
        let characters: Vec<char> = text.chars().collect();
        for (index, triple) in characters.chunks(3).enumerate() {
            let at = 3 * index + 1;
            let upper = |offset: usize| triple.get(offset).map(char::to_ascii_uppercase);
            let incomplete = NotationError::Incomplete { player, at: characters.len() };
            let role = upper(0)
                .and_then(|letter| LETTERS.iter().find(|(known, _)| *known == letter))
                .map(|(_, role)| *role)
                .ok_or(NotationError::NoPiece { player, at, found: triple[0] })?;
            let file = upper(1).ok_or(incomplete.clone())?;
            let file = File::from_char(file.to_ascii_lowercase()).ok_or(NotationError::NoFile {
                player,
                at: at + 1,
                found: triple[1],
            })?;
            let rank = Rank::from_char(upper(2).ok_or(incomplete)?)
                .ok_or(NotationError::NoRank { player, at: at + 2, found: triple[2] })?;
            let square = Square::from_coords(file, rank);
            let piece = Piece { color: player, role };
            if let Some(first) = self.get(square) {
                return Err(NotationError::Occupied {
                    player,
                    at,
                    first: written(first, square),
                    first_player: first.color,
                    second: written(piece, square),
                });
            }
            self.set(square, Some(piece));
        }
        Ok(())
    }

    /// The pieces of a FEN, or of its board part alone; the rest is read but not used, and the
    /// position need not be legal.
    ///
    /// # Errors
    /// When the text is no FEN.
    pub fn from_fen(fen: &str) -> Result<Placement, shakmaty::fen::ParseFenError> {
        let fen: Fen = fen.trim().parse()?;
        Ok(Placement::from(&fen.as_setup().board))
    }

    /// The board part of a FEN.
    pub fn board_fen(&self) -> String {
        let board: Board = self.iter().collect();
        board.board_fen().to_string()
    }

    /// The player's string, with White's pieces from rank 1 upwards and Black's from rank 8
    /// downwards, files a to h.
    pub fn notation(&self, player: Color) -> String {
        let ranks: &mut dyn Iterator<Item = Rank> = match player {
            Color::White => &mut Rank::ALL.into_iter(),
            Color::Black => &mut Rank::ALL.into_iter().rev(),
        };
        ranks
            .flat_map(|rank| File::ALL.map(|file| Square::from_coords(file, rank)))
            .filter_map(|square| self.get(square).map(|piece| (square, piece)))
            .filter(|(_, piece)| piece.color == player)
            .map(|(square, piece)| written(piece, square))
            .collect()
    }

    /// The piece on `square`.
    pub fn get(&self, square: Square) -> Option<Piece> {
        self.squares[square.to_usize()]
    }

    /// Puts a piece on `square`, or empties it.
    pub fn set(&mut self, square: Square, piece: Option<Piece>) {
        self.squares[square.to_usize()] = piece;
    }

    /// All pieces with their squares, a1, b1, … h8.
    pub fn iter(&self) -> impl Iterator<Item = (Square, Piece)> + '_ {
        Square::ALL.into_iter().filter_map(|square| self.get(square).map(|piece| (square, piece)))
    }
}

impl From<&Board> for Placement {
    fn from(board: &Board) -> Placement {
        let mut placement = Placement::EMPTY;
        for (square, piece) in board.iter() {
            placement.set(square, Some(piece));
        }
        placement
    }
}

impl std::fmt::Debug for Placement {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let [white, black] = [Color::White, Color::Black].map(|player| self.notation(player));
        write!(f, "Placement({white:?}, {black:?})")
    }
}

fn written(piece: Piece, square: Square) -> String {
    let letter =
        LETTERS.iter().find(|(_, role)| *role == piece.role).map_or('?', |(letter, _)| *letter);
    format!("{letter}{}{}", square.file().upper_char(), square.rank())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn placements() -> impl Strategy<Value = Placement> {
        let piece = (0..2usize, 0..6usize).prop_map(|(color, role)| Piece {
            color: [Color::White, Color::Black][color],
            role: LETTERS[role].1,
        });
        proptest::collection::vec(proptest::option::of(piece), 64).prop_map(|squares| {
            let mut placement = Placement::EMPTY;
            for (square, piece) in Square::ALL.into_iter().zip(squares) {
                placement.set(square, piece);
            }
            placement
        })
    }

    proptest! {
        #[test]
        fn reading_what_was_written_gives_it_back(placement in placements()) {
            let [white, black] = [Color::White, Color::Black].map(|c| placement.notation(c));
            prop_assert_eq!(Placement::parse(&white, &black), Ok(placement));
        }

        #[test]
        fn any_text_is_read_or_refused(white in ".*", black in "[KDVSJPa-h1-8]*") {
            let _ = Placement::parse(&white, &black);
        }
    }

    #[test]
    fn white_is_written_from_rank_1_up_and_black_from_rank_8_down() {
        let start = Placement::from(&Board::new());
        assert_eq!(
            start.notation(Color::White),
            "VA1JB1SC1DD1KE1SF1JG1VH1PA2PB2PC2PD2PE2PF2PG2PH2"
        );
        assert_eq!(
            start.notation(Color::Black),
            "VA8JB8SC8DD8KE8SF8JG8VH8PA7PB7PC7PD7PE7PF7PG7PH7"
        );
    }

    #[test]
    fn faults_name_the_character() {
        let cases = [
            ("XA1", "", "white: `X` at character 1 is no piece, expected K, D, V, S, J or P"),
            ("KE1QD1", "", "white: `Q` at character 4 is no piece"),
            ("KI1", "", "white: `I` at character 2 is no file, expected A to H"),
            ("", "KE9", "black: `9` at character 3 is no rank, expected 1 to 8"),
            ("KE1D", "", "white: the string ends at character 4 within a piece"),
            (
                "KE1DE1",
                "",
                "white: the piece `DE1` at character 4 stands on the square of the `KE1`",
            ),
            (
                "KE1",
                "dE1",
                "black: the piece `DE1` at character 1 stands on the square of white's `KE1`",
            ),
            ("KÉ1", "", "white: `É` at character 2 is no file"),
        ];
        for (white, black, message) in cases {
            let error = Placement::parse(white, black).unwrap_err().to_string();
            assert!(error.contains(message), "{white:?} {black:?} gave {error:?}");
        }
    }
}
