//! The letters of the pieces, which each language has its own of.

use std::fmt::{self, Display};
use std::str::FromStr;

/// Which letters pieces have in a text.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Letters {
    /// English ones; in a game that has none of these moves, those of the one language in which
    /// all of it can be played.
    #[default]
    Auto,
    Of(Language),
}

/// A language's letters, or those that several have in common.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Language {
    /// In English, in lower case.
    names: &'static [&'static str],
    /// Of king, queen, rook, bishop, knight and pawn; nothing where a pawn has none.
    pieces: [&'static str; 6],
}

/// The same pieces in English; a pawn is not named.
const ENGLISH: [&str; 6] = ["K", "Q", "R", "B", "N", ""];

impl Language {
    pub const ENGLISH: Language =
        Language { names: &["english"], pieces: ["K", "Q", "R", "B", "N", "P"] };

    /// All that are known, English first. Pawns are named in none of the others: their letters are
    /// those of pieces elsewhere, and nobody writes them.
    pub const ALL: [Language; 16] = [
        Language::ENGLISH,
        of(&["czech", "slovak"], ["K", "D", "V", "S", "J"]),
        of(
            &["german", "danish", "norwegian", "swedish", "slovene", "croatian"],
            ["K", "D", "T", "L", "S"],
        ),
        of(&["french"], ["R", "D", "T", "F", "C"]),
        of(&["spanish", "italian", "catalan"], ["R", "D", "T", "A", "C"]),
        of(&["portuguese"], ["R", "D", "T", "B", "C"]),
        of(&["dutch"], ["K", "D", "T", "L", "P"]),
        of(&["polish"], ["K", "H", "W", "G", "S"]),
        of(&["hungarian"], ["K", "V", "B", "F", "H"]),
        of(&["romanian"], ["R", "D", "T", "N", "C"]),
        of(&["finnish"], ["K", "D", "T", "L", "R"]),
        of(&["estonian"], ["K", "L", "V", "O", "R"]),
        of(&["icelandic"], ["K", "D", "H", "B", "R"]),
        of(&["turkish"], ["Ş", "V", "K", "F", "A"]),
        of(&["russian"], ["Кр", "Ф", "Л", "С", "К"]),
        of(&["ukrainian"], ["Кр", "Ф", "Т", "С", "К"]),
    ];

    /// Whether moves are read as the standard writes them.
    pub fn is_english(self) -> bool {
        self == Language::ENGLISH
    }

    /// Cuts a piece's letter from the front of `text`; gives its English letter (none for a pawn),
    /// and the rest.
    pub fn piece(self, text: &str) -> Option<(&'static str, &str)> {
        // The longest first: `Кр` is no `К`.
        self.pieces
            .iter()
            .zip(ENGLISH)
            .filter(|(letter, _)| !letter.is_empty())
            .filter_map(|(letter, english)| Some((letter, english, text.strip_prefix(letter)?)))
            .max_by_key(|(letter, ..)| letter.len())
            .map(|(_, english, rest)| (english, rest))
    }
}

const fn of(names: &'static [&'static str], pieces: [&'static str; 5]) -> Language {
    let [king, queen, rook, bishop, knight] = pieces;
    Language { names, pieces: [king, queen, rook, bishop, knight, ""] }
}

impl Display for Language {
    /// Name and letters, as in `German (K D T L S)`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = self.names[0];
        let (first, rest) = name.split_at(1);
        let pieces = self.pieces.join(" ");
        write!(f, "{}{rest} ({})", first.to_ascii_uppercase(), pieces.trim_end())
    }
}

/// Why a text names no letters.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{text}` is no language whose letters are known, expected auto, {}", names().join(", "))]
pub struct ParseLettersError {
    text: String,
}

/// The names of all languages.
fn names() -> Vec<&'static str> {
    Language::ALL.iter().flat_map(|language| language.names).copied().collect()
}

impl FromStr for Letters {
    type Err = ParseLettersError;

    fn from_str(text: &str) -> Result<Letters, ParseLettersError> {
        let wanted = text.trim().to_lowercase();
        if wanted == "auto" {
            return Ok(Letters::Auto);
        }
        Language::ALL
            .into_iter()
            .find(|language| language.names.contains(&wanted.as_str()))
            .map(Letters::Of)
            .ok_or_else(|| ParseLettersError { text: text.to_owned() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn languages_have_names_and_letters_of_their_own() {
        for (index, language) in Language::ALL.iter().enumerate() {
            for name in language.names {
                assert_eq!(name.parse(), Ok(Letters::Of(*language)));
            }
            let others = &Language::ALL[index + 1..];
            assert!(others.iter().all(|other| other.pieces != language.pieces), "{language}");
            let mut letters: Vec<_> = language.pieces.iter().filter(|p| !p.is_empty()).collect();
            letters.sort_unstable();
            letters.dedup();
            assert!(letters.len() >= 5, "{language}");
        }
        assert_eq!("Auto".parse(), Ok(Letters::Auto));
        let error = "klingon".parse::<Letters>().unwrap_err().to_string();
        assert!(
            error.starts_with("`klingon` is no language") && error.contains("dutch"),
            "{error}"
        );
    }

    #[test]
    fn a_letter_is_cut_from_the_front() {
        let russian = Language::ALL[14];
        assert_eq!(russian.piece("Крf1"), Some(("K", "f1")));
        assert_eq!(russian.piece("Кf3"), Some(("N", "f3")));
        assert_eq!(Language::ENGLISH.piece("Pxe4"), Some(("", "xe4")));
        assert_eq!(Language::ALL[2].piece("Nf3"), None);
    }
}
