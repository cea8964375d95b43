//! Positions by what stands on their squares.

use std::str::FromStr;

use shakmaty::{Bitboard, Board, Color, File, Rank, Role, Square};

/// Positions, as a FEN with pgn-extract's wildcards: in a rank, `?` is a square with or without a
/// piece, `!` one with a piece, `A` one with a white piece and `a` with a black one, `*` any number of
/// squares, none too, `[…]` a square with any of the pieces listed, `[^…]` one with none of them, or
/// without any piece. In a list, `A`, `a` and `1` (an empty square) may stand beside pieces.
///
/// Behind the board may stand who is to move, `w`, `b` or `*`, and the other fields of a FEN, which are
/// not compared.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PositionPattern {
    /// For each rank that can be laid out in several ways all of them, and before these the ranks that can be
    /// laid out in one. Of each a position must keep to one.
    layouts: Vec<Vec<Forbidden>>,
    turn: Option<Color>,
}

/// For each content of squares (see [`contents`]) those where it must not be.
type Forbidden = [Bitboard; CONTENTS];

const NOTHING: Forbidden = [Bitboard::EMPTY; CONTENTS];

/// White's pieces, Black's pieces and nothing.
const CONTENTS: usize = 13;

/// Contents that a square may have, a bit each.
type Set = u16;

const EMPTY: Set = 1 << 12;
const WHITE: Set = 0b11_1111;
const BLACK: Set = WHITE << 6;
const ANY: Set = WHITE | BLACK | EMPTY;

/// Why a text is no pattern of positions.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ParsePatternError {
    #[error("{found} ranks, expected 8 with / between, as in ????????/*/*/*/*/*/*/*")]
    Ranks { found: usize },
    #[error(
        "`{found}` in rank {rank}, expected pieces (KQRBNP, kqrbnp), empty squares (1 to 8), or one of \
         ? ! A a * [ ]"
    )]
    Sign { rank: u32, found: char },
    #[error(
        "`{found}` in a list in rank {rank}, expected pieces (KQRBNP, kqrbnp), A, a or 1 (an empty square)"
    )]
    Listed { rank: u32, found: char },
    #[error("a list in rank {rank} is {what}, expected pieces between [ and ]")]
    List { rank: u32, what: &'static str },
    #[error("rank {rank}, `{text}`, has {found} squares, expected {}", if *open { "8 at most" } else { "8, or a * among them" })]
    Squares { rank: u32, text: String, found: usize, open: bool },
    #[error("`{found}` behind the board, expected who is to move: w, b or *")]
    Turn { found: String },
    #[error("`{found}` behind a FEN's six fields, expected nothing")]
    Behind { found: String },
}

/// A rank is a row of these.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Item {
    /// A square with one of a set of contents.
    Square(Set),
    /// Any number of squares.
    Gap,
}

impl FromStr for PositionPattern {
    type Err = ParsePatternError;

    fn from_str(text: &str) -> Result<PositionPattern, ParsePatternError> {
        let mut fields = text.split_whitespace();
        let ranks: Vec<&str> = fields.next().unwrap_or_default().split('/').collect();
        if ranks.len() != 8 {
            return Err(ParsePatternError::Ranks { found: ranks.len() });
        }
        let mut layouts = vec![vec![NOTHING]];
        for (rank, text) in Rank::ALL.into_iter().rev().zip(ranks) {
            let rows = rows(rank, text)?;
            match &rows[..] {
                [row] => forbid(rank, row, &mut layouts[0][0]),
                rows => layouts.push(
                    rows.iter()
                        .map(|row| {
                            let mut forbidden = NOTHING;
                            forbid(rank, row, &mut forbidden);
                            forbidden
                        })
                        .collect(),
                ),
            }
        }
        let turn = match fields.next() {
            None | Some("*") => None,
            Some("w") => Some(Color::White),
            Some("b") => Some(Color::Black),
            Some(found) => return Err(ParsePatternError::Turn { found: found.to_owned() }),
        };
        match fields.nth(4) {
            Some(found) => Err(ParsePatternError::Behind { found: found.to_owned() }),
            None => Ok(PositionPattern { layouts, turn }),
        }
    }
}

impl PositionPattern {
    /// Whether it is a pattern of the position on `board` with `turn` to move.
    pub fn matches(&self, board: &Board, turn: Color) -> bool {
        let contents = contents(board);
        let is_kept = |forbidden: &Forbidden| {
            forbidden.iter().zip(contents).all(|(forbidden, found)| forbidden.is_disjoint(found))
        };
        self.turn.is_none_or(|wanted| wanted == turn)
            && self.layouts.iter().all(|rank| rank.iter().any(is_kept))
    }
}

/// The squares of each content: kings to pawns of White, then of Black, and nothing.
fn contents(board: &Board) -> [Bitboard; CONTENTS] {
    let mut contents = [!board.occupied(); CONTENTS];
    for (index, squares) in contents[..12].iter_mut().enumerate() {
        let color = if index < 6 { Color::White } else { Color::Black };
        *squares = board.by_color(color) & board.by_role(ROLES[index % 6].1);
    }
    contents
}

const ROLES: [(char, Role); 6] = [
    ('k', Role::King),
    ('q', Role::Queen),
    ('r', Role::Rook),
    ('b', Role::Bishop),
    ('n', Role::Knight),
    ('p', Role::Pawn),
];

/// All that a row of eight squares can be where a rank is `text`, once each.
fn rows(rank: Rank, text: &str) -> Result<Vec<[Set; 8]>, ParsePatternError> {
    let items = items(rank, text)?;
    let squares = items.iter().filter(|item| **item != Item::Gap).count();
    let open = squares < items.len();
    let spare = match 8usize.checked_sub(squares) {
        Some(spare) if open || spare == 0 => spare,
        _ => {
            let (rank, text) = (number(rank), text.to_owned());
            return Err(ParsePatternError::Squares { rank, text, found: squares, open });
        }
    };
    let mut rows = vec![Vec::new()];
    for item in items {
        match item {
            Item::Square(set) => rows.iter_mut().for_each(|row| row.push(set)),
            Item::Gap => {
                let longer = |row: Vec<Set>| {
                    (0..=spare).map(move |more| [&row[..], &vec![ANY; more]].concat())
                };
                rows = rows.into_iter().flat_map(longer).collect();
            }
        }
    }
    let mut rows: Vec<[Set; 8]> = rows.into_iter().filter_map(|row| row.try_into().ok()).collect();
    rows.sort_unstable();
    rows.dedup();
    Ok(rows)
}

/// The items of a rank; gaps that meet are one.
fn items(rank: Rank, text: &str) -> Result<Vec<Item>, ParsePatternError> {
    let mut items = Vec::new();
    let mut signs = text.chars();
    while let Some(sign) = signs.next() {
        match sign {
            '*' if items.last() == Some(&Item::Gap) => {}
            '*' => items.push(Item::Gap),
            '?' => items.push(Item::Square(ANY)),
            '!' => items.push(Item::Square(WHITE | BLACK)),
            '[' => items.push(Item::Square(list(rank, &mut signs)?)),
            '1'..='8' => {
                let empty = sign as usize - '0' as usize;
                items.extend(vec![Item::Square(EMPTY); empty]);
            }
            found => {
                let set = pieces(found);
                let error = ParsePatternError::Sign { rank: number(rank), found };
                items.push(Item::Square(set.ok_or(error)?));
            }
        }
    }
    Ok(items)
}

/// The set that a list names, up to its `]`.
fn list(rank: Rank, signs: &mut impl Iterator<Item = char>) -> Result<Set, ParsePatternError> {
    let rank = number(rank);
    let mut signs = signs.peekable();
    let is_negated = signs.next_if_eq(&'^').is_some();
    let mut set = 0;
    for sign in signs {
        match sign {
            ']' if set == 0 => return Err(ParsePatternError::List { rank, what: "empty" }),
            ']' => return Ok(if is_negated { ANY & !set } else { set }),
            '1' => set |= EMPTY,
            found => set |= pieces(found).ok_or(ParsePatternError::Listed { rank, found })?,
        }
    }
    Err(ParsePatternError::List { rank, what: "not closed" })
}

/// The pieces that a letter stands for.
fn pieces(letter: char) -> Option<Set> {
    let (all, shift) = if letter.is_ascii_uppercase() { (WHITE, 0) } else { (BLACK, 6) };
    let letter = letter.to_ascii_lowercase();
    let index = ROLES.iter().position(|(known, _)| *known == letter);
    index.map(|index| 1 << (index + shift)).or((letter == 'a').then_some(all))
}

/// Forbids in `rank` what a row does not allow.
fn forbid(rank: Rank, row: &[Set; 8], forbidden: &mut Forbidden) {
    for (file, set) in File::ALL.into_iter().zip(row) {
        let square = Bitboard::from(Square::from_coords(file, rank));
        for (content, squares) in forbidden.iter_mut().enumerate() {
            if set >> content & 1 == 0 {
                *squares |= square;
            }
        }
    }
}

fn number(rank: Rank) -> u32 {
    u32::from(rank) + 1
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use shakmaty::Piece;

    const START: &str = "rnbqkbnr/pppppppp/8/8/8/8/PPPPPPPP/RNBQKBNR";
    const MATE: &str = "1n1Rkb1r/p4ppp/4q3/4p1B1/4P3/8/PPP2PPP/2K5";

    fn matches(pattern: &str, board: &str, turn: Color) -> bool {
        let board = Board::from_ascii_board_fen(board.as_bytes()).unwrap();
        let pattern: PositionPattern =
            pattern.parse().unwrap_or_else(|error| panic!("{pattern}: {error}"));
        pattern.matches(&board, turn)
    }

    #[test]
    fn patterns_are_of_the_positions_that_they_describe() {
        for (pattern, board, expected) in [
            (START, START, true),
            (START, MATE, false),
            ("*/*/*/*/*/*/*/*", MATE, true),
            ("aaaaaaaa/!!!!!!!!/????????/8/8/8/AAAAAAAA/*", START, true),
            ("AAAAAAAA/*/*/*/*/*/*/*", START, false),
            ("*Rk*/*/*/*/*/*/*/*", MATE, true),
            ("*kR*/*/*/*/*/*/*/*", MATE, false),
            ("*R*r/*/*/*/*/*/*/*", MATE, true),
            ("*r*R/*/*/*/*/*/*/*", MATE, false),
            ("1*R*1*/*/*/*/*/*/*/*", MATE, true),
            ("*/*/*/4p1[BN]1/*/*/*/*", MATE, true),
            ("*/*/*/4p1[^BN]1/*/*/*/*", MATE, false),
            ("*/*/*/[^Aa][^P]2p1[A]1/*/*/*/*", MATE, true),
            ("*/*/*/[1p]3p1B1/*/*/*/*", MATE, true),
            ("*/*/*/[^1]3p1B1/*/*/*/*", MATE, false),
            ("*/*/*/*/*/*/*PPP/*", MATE, true),
            ("*/*/*/*/*/*/*PPP*PPP*/*", START, true),
            ("*/*/*/*/*/*/*PPP*PPP*/*", MATE, true),
            ("*/*/*/*/*/*/*PPPP*/*", MATE, false),
            ("*/*/*/*/*/*/**PP**PP**/*", MATE, true),
        ] {
            assert_eq!(matches(pattern, board, Color::White), expected, "{pattern} {board}");
        }
    }

    #[test]
    fn who_is_to_move_counts_where_it_is_said() {
        for (fields, white, black) in [
            ("", true, true),
            (" *", true, true),
            (" w", true, false),
            (" b", false, true),
            (" w KQkq - 0 1", true, false),
            (" b - e3 12 34", false, true),
        ] {
            let pattern = format!("{START}{fields}");
            assert_eq!(matches(&pattern, START, Color::White), white, "{pattern}");
            assert_eq!(matches(&pattern, START, Color::Black), black, "{pattern}");
        }
    }

    #[test]
    fn what_is_no_pattern_is_told() {
        for (text, part) in [
            ("", "1 ranks, expected 8 with / between"),
            ("*/*/*/*/*/*/*", "7 ranks, expected 8"),
            ("*/*/*/*/*/*/*/*/*", "9 ranks, expected 8"),
            ("*/*/xK*/*/*/*/*/*", "`x` in rank 6, expected pieces"),
            ("*/9/*/*/*/*/*/*", "`9` in rank 7"),
            ("*/É*/*/*/*/*/*/*", "`É` in rank 7"),
            ("*/*/*/*/*/*/*/[Qx]*", "`x` in a list in rank 1"),
            ("*/*/*/*/*/*/*/[Q2]*", "`2` in a list in rank 1"),
            ("*/*/*/*/*/*/*/[Q*", "`*` in a list in rank 1"),
            ("*/*/*/*/*/*/*/*[Q", "a list in rank 1 is not closed"),
            ("*/*/*/*/*/*/*/*[]", "a list in rank 1 is empty"),
            ("*/*/*/*/*/*/*/*[^]", "a list in rank 1 is empty"),
            ("*/*/*/*/pp?/*/*/*", "rank 4, `pp?`, has 3 squares, expected 8, or a * among them"),
            ("*/*/*/*/8p/*/*/*", "rank 4, `8p`, has 9 squares, expected 8, or"),
            ("*/*/*/*/8p*/*/*/*", "rank 4, `8p*`, has 9 squares, expected 8 at most"),
            ("*/*/*/*//*/*/*", "rank 4, ``, has 0 squares, expected 8"),
            ("*/*/*/*/*/*/*/* x", "`x` behind the board, expected who is to move"),
            ("*/*/*/*/*/*/*/* w KQkq - 0 1 x", "`x` behind a FEN's six fields"),
        ] {
            let error = text.parse::<PositionPattern>().unwrap_err().to_string();
            assert!(error.contains(part), "{text:?} gave {error:?}");
        }
    }

    /// The definition, sign by sign; a square is its letter, or `1`.
    fn rank_matches(pattern: &str, squares: &str) -> bool {
        let Some(sign) = pattern.chars().next() else {
            return squares.is_empty();
        };
        let (rest, found) = (&pattern[1..], squares.chars().next());
        let goes_on = |is_right: bool, rest: &str| is_right && rank_matches(rest, &squares[1..]);
        let Some(found) = found else {
            return sign == '*' && rank_matches(rest, "");
        };
        match sign {
            '*' => rank_matches(rest, squares) || rank_matches(pattern, &squares[1..]),
            '?' => goes_on(true, rest),
            '!' => goes_on(found != '1', rest),
            'A' => goes_on(found.is_ascii_uppercase(), rest),
            'a' => goes_on(found.is_ascii_lowercase(), rest),
            '[' => {
                let (list, rest) = rest.split_once(']').unwrap();
                match list.strip_prefix('^') {
                    Some(list) => goes_on(!list.contains(found), rest),
                    None => goes_on(list.contains(found), rest),
                }
            }
            '2'..='8' => {
                let fewer = format!("{}{rest}", sign as u8 - b'0' - 1);
                goes_on(found == '1', &fewer)
            }
            sign => goes_on(found == sign, rest),
        }
    }

    /// Few kinds of pieces, so that boards and patterns often meet.
    fn boards() -> impl Strategy<Value = Board> {
        let piece = prop::sample::select(vec![' ', ' ', 'P', 'p', 'K', 'q']);
        prop::collection::vec(piece, 64).prop_map(|squares| {
            let mut board = Board::empty();
            for (square, piece) in Square::ALL.into_iter().zip(squares) {
                if let Some(piece) = Piece::from_char(piece) {
                    board.set_piece_at(square, piece);
                }
            }
            board
        })
    }

    fn letters(board: &Board, rank: Rank) -> String {
        let at = |file| board.piece_at(Square::from_coords(file, rank));
        File::ALL.into_iter().map(|file| at(file).map_or('1', Piece::char)).collect()
    }

    /// Each square of a rank as a sign that is often right, and gaps in place of some.
    fn likely_rank(squares: String) -> impl Strategy<Value = String> {
        let sign = (0..12usize, 0..300usize);
        prop::collection::vec(sign, 8).prop_map(move |signs| {
            let of = |(square, (kind, fault)): (char, (usize, usize))| match (kind, fault) {
                (_, 0) => "P".to_owned(),
                (_, 1) => "[^p]".to_owned(),
                (_, 2) => "A".to_owned(),
                (0..=3, _) => "*".to_owned(),
                (4, _) => "?".to_owned(),
                (5, _) => format!("[{square}Q]"),
                (6, _) => "[^nN]".to_owned(),
                (7, _) if square != '1' => "!".to_owned(),
                (8, _) if square.is_ascii_uppercase() => "A".to_owned(),
                (9, _) if square.is_ascii_lowercase() => "a".to_owned(),
                _ => square.to_string(),
            };
            squares.chars().zip(signs).map(of).collect()
        })
    }

    fn boards_and_patterns() -> impl Strategy<Value = (Board, Vec<String>)> {
        boards().prop_flat_map(|board| {
            let ranks: Vec<_> = Rank::ALL
                .into_iter()
                .rev()
                .map(|rank| likely_rank(letters(&board, rank)))
                .collect();
            (Just(board), ranks)
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4096))]
        #[test]
        fn a_pattern_matches_what_the_definition_does((board, ranks) in boards_and_patterns()) {
            let expected = Rank::ALL
                .into_iter()
                .rev()
                .zip(&ranks)
                .all(|(rank, pattern)| rank_matches(pattern, &letters(&board, rank)));
            let pattern: PositionPattern = ranks.join("/").parse().unwrap();
            prop_assert_eq!(pattern.matches(&board, Color::White), expected, "{:?}", ranks);
        }

        #[test]
        fn any_text_is_read_or_refused(text in r"([KQRBNPkqrbnpAa1-9?!*\[\]^x/ w]|\PC){0,60}") {
            let _ = text.parse::<PositionPattern>();
        }
    }
}
