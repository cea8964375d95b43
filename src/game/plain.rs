//! Words as the PGN standard writes them, which nearly all words are: move numbers, moves in short
//! algebraic notation, results.
//!
//! They are told without taking them apart any further. What is read here is read in the same way
//! by `word` and `movetext`, and by pgn-reader (tests hold all three against each other), so that a
//! line of such words alone needs no second opinion. Everything else is no plain word.

use shakmaty::san::{San, SanPlus, Suffix};
use shakmaty::{CastlingSide, File, Rank, Role, Square};

/// A plain word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Plain {
    Number {
        number: u32,
        dots: usize,
    },
    Move(SanPlus),
    /// A number and the move behind it, without a blank between.
    NumberedMove {
        number: u32,
        dots: usize,
        played: SanPlus,
    },
    Result(&'static str),
}

/// Move numbers of more digits are none of any game.
const MOST_DIGITS: usize = 4;

/// What a word is, if it is plain.
#[inline]
pub fn read(word: &[u8]) -> Option<Plain> {
    match word.first()? {
        b'0'..=b'9' => numbered(word),
        b'*' => (word.len() == 1).then_some(Plain::Result("*")),
        _ => san(word).map(Plain::Move),
    }
}

fn numbered(word: &[u8]) -> Option<Plain> {
    let digits = word.iter().take_while(|byte| byte.is_ascii_digit()).count();
    let (digits, rest) = word.split_at(digits);
    let dots = rest.iter().take_while(|byte| **byte == b'.').count();
    if dots == 0 && !rest.is_empty() {
        return match word {
            b"1-0" => Some(Plain::Result("1-0")),
            b"0-1" => Some(Plain::Result("0-1")),
            b"1/2-1/2" => Some(Plain::Result("1/2-1/2")),
            _ => None,
        };
    }
    if digits.len() > MOST_DIGITS || digits == b"0000" {
        return None;
    }
    let number = digits.iter().fold(0, |number, digit| 10 * number + u32::from(digit - b'0'));
    match &rest[dots..] {
        [] => Some(Plain::Number { number, dots }),
        rest => Some(Plain::NumberedMove { number, dots, played: san(rest)? }),
    }
}

/// A move in short algebraic notation.
fn san(word: &[u8]) -> Option<SanPlus> {
    let (body, suffix) = match word {
        [body @ .., b'+'] => (body, Some(Suffix::Check)),
        [body @ .., b'#'] => (body, Some(Suffix::Checkmate)),
        body => (body, None),
    };
    let san = match body {
        [b'a'..=b'h', ..] => pawn(body)?,
        [b'O', ..] => San::Castle(match body {
            b"O-O" => CastlingSide::KingSide,
            b"O-O-O" => CastlingSide::QueenSide,
            _ => return None,
        }),
        [letter, rest @ ..] => piece(role(*letter)?, rest)?,
        [] => return None,
    };
    Some(SanPlus { san, suffix })
}

fn pawn(body: &[u8]) -> Option<San> {
    let (body, promotion) = match body {
        [body @ .., rank @ (b'1' | b'8'), b'=', letter] => {
            let role = role(*letter).filter(|role| *role != Role::King)?;
            (body, Some((*rank, role)))
        }
        body => (body, None),
    };
    let (file, to_file, to_rank) = match (body, promotion) {
        ([to, rank], None) => (None, to, rank),
        ([from, b'x', to, rank], None) => (Some(file(*from)?), to, rank),
        ([to], Some((rank, _))) => (None, to, &rank.clone()),
        ([from, b'x', to], Some((rank, _))) => (Some(file(*from)?), to, &rank.clone()),
        _ => return None,
    };
    let to = Square::from_coords(self::file(*to_file)?, rank(*to_rank)?);
    // A pawn's file is named only where it leaves it.
    if file == Some(to.file()) {
        return None;
    }
    let promotion = promotion.map(|(_, role)| role);
    Some(San::Normal { role: Role::Pawn, file, rank: None, capture: file.is_some(), to, promotion })
}

fn piece(role: Role, body: &[u8]) -> Option<San> {
    let [rest @ .., to_file, to_rank] = body else {
        return None;
    };
    let to = Square::from_coords(file(*to_file)?, rank(*to_rank)?);
    let (rest, capture) = match rest {
        [rest @ .., b'x'] => (rest, true),
        rest => (rest, false),
    };
    let (file, rank) = match rest {
        [] => (None, None),
        [f, r] => (Some(file(*f)?), Some(rank(*r)?)),
        [one] => match file(*one) {
            Some(file) => (Some(file), None),
            None => (None, Some(rank(*one)?)),
        },
        _ => return None,
    };
    Some(San::Normal { role, file, rank, capture, to, promotion: None })
}

fn role(letter: u8) -> Option<Role> {
    match letter {
        b'N' => Some(Role::Knight),
        b'B' => Some(Role::Bishop),
        b'R' => Some(Role::Rook),
        b'Q' => Some(Role::Queen),
        b'K' => Some(Role::King),
        _ => None,
    }
}

fn file(byte: u8) -> Option<File> {
    File::from_char(char::from(byte))
}

fn rank(byte: u8) -> Option<Rank> {
    Rank::from_char(char::from(byte))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::letters::Language;
    use super::super::movetext::{moves, tolerant};
    use super::super::word::{Word, classify};
    use super::*;

    /// Words of the letters that moves, numbers and results are made of, plain ones and others.
    fn word() -> impl Strategy<Value = String> {
        prop_oneof![
            "[NBRQKP]?[a-h]?[1-8]?x?[a-h][1-8](=?[NBRQKP])?[+#]?",
            "[a-h]?x?[a-h][18]=[NBRQ][+#]?",
            "[0-9]{0,5}\\.{0,3}[NBRQK]?x?[a-h][1-8][+#]{0,2}",
            "(1-0|0-1|1/2-1/2|\\*|O-O|O-O-O|0-0|0000|OO)[+#]?",
            "[0-9a-hNBRQKPOx=+#./*-]{1,8}",
        ]
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20_000))]

        #[test]
        fn a_plain_word_is_what_the_tolerant_reading_says(word in word()) {
            let Some(plain) = read(word.as_bytes()) else {
                return Ok(());
            };
            let words: Vec<Word> = classify(&word).collect();
            let number = |number, dots| Word::Number { number, dots };
            let (expected, san) = match plain {
                Plain::Number { number: n, dots } => (vec![number(n, dots)], None),
                Plain::Result(result) => (vec![Word::Result(result)], None),
                Plain::Move(san) => (vec![Word::Move(san.to_string())], Some(san)),
                Plain::NumberedMove { number: n, dots, played } => {
                    (vec![number(n, dots), Word::Move(played.to_string())], Some(played))
                }
            };
            prop_assert_eq!(&words, &expected);
            if let (Some(san), Some(Word::Move(text))) = (san, words.last()) {
                let written = tolerant(text, Language::ENGLISH);
                prop_assert_eq!(written.san, Some(san.san));
                prop_assert_eq!(written.uci, None);
                prop_assert!(!written.passes);
            }
        }

        /// Of plain words pgn-reader drops none, and adds none.
        #[test]
        fn pgn_reader_reads_plain_words_alike(words in prop::collection::vec(word(), 0..40)) {
            let is_kept = |word: &&String| {
                !matches!(read(word.as_bytes()), None | Some(Plain::Result(_)))
            };
            let words: Vec<&String> = words.iter().filter(is_kept).collect();
            let text: String = words.iter().map(|word| format!("{word} ")).collect();
            let expected: Vec<San> = words
                .iter()
                .filter_map(|word| match read(word.as_bytes()) {
                    Some(Plain::Move(san) | Plain::NumberedMove { played: san, .. }) => {
                        Some(san.san)
                    }
                    _ => None,
                })
                .collect();
            prop_assert_eq!(moves(text.as_bytes()), expected, "{}", text);
        }
    }

    #[test]
    fn plain_words_are_told_from_others() {
        for word in ["e4", "exd5", "Nf3", "Nbd7+", "R1a3", "Qh4xe1#", "O-O-O+", "exd8=Q#", "a1=N"] {
            assert!(matches!(read(word.as_bytes()), Some(Plain::Move(_))), "{word}");
        }
        for word in ["e2e4", "e9", "eexd5", "exe5", "Pe4", "b8Q", "e4!", "e8=K", "0-0", "OO", ""] {
            assert_eq!(read(word.as_bytes()), None, "{word}");
        }
    }
}
