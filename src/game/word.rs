//! Words of the movetext, and tag pairs.
//!
//! A word that is not known to be harmless is never passed over: it may be a move, or a part of
//! one, and what follows it would then be played from a position that the game never had.

use std::borrow::Cow;

use encoding_rs::WINDOWS_1252;

use super::glyph;
use crate::text::printable;

/// What a word of the main line is.
#[derive(Debug, PartialEq, Eq)]
pub enum Word {
    /// A move number; with two dots or more, Black's move follows.
    Number {
        number: u32,
        dots: usize,
    },
    /// Dots on their own: Black's move follows (or a number's own dot stands apart).
    Dots(usize),
    Result(&'static str),
    /// What may be a move.
    Move(String),
    /// A glyph, an evaluation, `e.p.`: it says nothing about the moves. With the numbers of its
    /// glyphs, as far as they have one.
    Annotation(Vec<u8>),
    /// A single letter: a remark (`N` for a novelty), or a piece that was torn from its square.
    Letter(char),
    /// Nothing that belongs into a game.
    Unknown,
}

/// What evaluations and glyphs are made of.
const SYMBOLS: &str = "+-=/!?#~±∓⩲⩱∞□○⟳⊕⨁↑→⇆△▲⌓⟂∥×";

/// Cuts a move number from the front of a word, and says what that and the rest are.
pub fn classify(word: &str) -> impl Iterator<Item = Word> {
    let rest = word.trim_start_matches(|c: char| c.is_ascii_digit());
    let digits = &word[..word.len() - rest.len()];
    let after = rest.trim_start_matches(['.', '…']);
    let dots: usize =
        rest[..rest.len() - after.len()].chars().map(|c| if c == '…' { 3 } else { 1 }).sum();
    let numbered = (dots > 0 || rest.is_empty()) && word != "0000";
    let number = match digits.parse() {
        _ if !numbered || word.is_empty() => None,
        Ok(number) => Some(Word::Number { number, dots }),
        // `...e5`, but not `.e5`, which has lost something.
        Err(_) if digits.is_empty() && (dots > 1 || after.is_empty()) => Some(Word::Dots(dots)),
        Err(_) => Some(Word::Unknown),
    };
    let rest = if numbered { after } else { word };
    number.into_iter().chain(unnumbered(rest).into_iter().flatten())
}

/// What a word is, and what is glued to it.
fn unnumbered(word: &str) -> [Option<Word>; 2] {
    if word.is_empty() {
        return [None, None];
    }
    if let Some(result) = result(word) {
        return [Some(Word::Result(result)), None];
    }
    if let Some(nag) = word.strip_prefix('$').and_then(|number| number.parse::<u32>().ok()) {
        let known = u8::try_from(nag).ok().filter(|nag| *nag > 0);
        return [Some(Word::Annotation(known.into_iter().collect())), None];
    }
    let bare = without_evaluation(word.trim_end_matches(GLYPHS)).trim_end_matches(GLYPHS);
    let alphanumerics = bare.chars().filter(|c| c.is_alphanumeric()).count();
    let word = match alphanumerics {
        _ if bare.eq_ignore_ascii_case("ep") || bare.eq_ignore_ascii_case("e.p") => {
            Word::Annotation(Vec::new())
        }
        0 if is_null(bare) => Word::Move(bare.to_owned()),
        0 if is_annotation(&ascii_dashes(word)) => Word::Annotation(glyph::numbers(word)),
        0 | 1 => match bare.as_bytes() {
            [letter @ b'A'..=b'Z'] => Word::Letter(char::from(*letter)),
            _ => Word::Unknown,
        },
        _ => {
            let glued = &word[bare.len()..];
            let glued = (!glued.is_empty()).then(|| Word::Annotation(glyph::numbers(glued)));
            return [Some(Word::Move(bare.to_owned())), glued];
        }
    };
    [Some(word), None]
}

/// Whether signs alone are an evaluation or a glyph. Dashes alone stand for a move that is not there.
fn is_annotation(signs: &str) -> bool {
    let is_dashed = signs.trim_matches(['-', '/', '=']).is_empty() && !signs.contains('=');
    !is_dashed && signs.chars().all(|c| SYMBOLS.contains(c))
}

const GLYPHS: [char; 3] = ['!', '?', '.'];

/// A move without the evaluation that is glued to it (`Nf3+-`, but `Nf3+` is a check).
fn without_evaluation(word: &str) -> &str {
    const EVALUATIONS: [&str; 18] = [
        "+/-", "-/+", "+/=", "=/+", "+-", "-+", "+−", "−+", "+–", "–+", "+=", "=+", "=", "±", "∓",
        "⩲", "⩱", "∞",
    ];
    EVALUATIONS
        .iter()
        .find_map(|evaluation| word.strip_suffix(evaluation))
        .filter(|rest| rest.ends_with(|c: char| c.is_alphanumeric() || GLYPHS.contains(&c)))
        .unwrap_or(word)
}

fn result(word: &str) -> Option<&'static str> {
    match ascii_dashes(word).trim_end_matches('.') {
        "1-0" | "1:0" => Some("1-0"),
        "0-1" | "0:1" => Some("0-1"),
        "1/2-1/2" | "1/2:1/2" | "1/2" | "½-½" | "½:½" | "½" => Some("1/2-1/2"),
        "*" => Some("*"),
        _ => None,
    }
}

/// Whether a word says that a player passes.
pub fn is_null(word: &str) -> bool {
    matches!(ascii_dashes(word).as_str(), "--" | "Z0" | "0000" | "@@@@" | "null" | "pass")
}

/// `word` with every kind of dash and hyphen as `-`.
pub fn ascii_dashes(word: &str) -> String {
    word.replace(['–', '—', '−', '‐', '‑'], "-")
}

/// Whether what stands in brackets within the moves is known to hold none: a command for programs
/// (`[%clk 0:01]`), a diagram mark (`[#]`), or a tag of a web page (`<br />`).
pub fn is_harmless(bracketed: &str) -> bool {
    let inner = |open, close| bracketed.strip_prefix(open)?.strip_suffix(close);
    if let Some(inner) = inner('[', ']') {
        return inner.starts_with('%') || inner == "#";
    }
    let Some(inner) = inner('<', '>') else {
        return false;
    };
    let name = inner.trim_matches(['/', ' ']);
    !name.is_empty() && name.len() < 8 && name.chars().all(|c| c.is_ascii_lowercase())
}

/// Name and value of a tag pair; the closing bracket may be missing.
pub fn parse_tag(raw: &str) -> Option<(String, String)> {
    let inner = raw.strip_prefix('[')?.trim();
    let inner = inner.strip_suffix(']').unwrap_or(inner).trim_end();
    let (name, quoted) = inner.split_at(inner.find([' ', '\t', '"'])?);
    let named =
        !name.is_empty() && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_' || c == '-');
    let quoted = quoted.trim_start().strip_prefix('"')?.strip_suffix('"')?;
    if named && !quoted.contains(['\\', '"']) {
        return Some((name.to_owned(), printable(quoted)));
    }
    let mut value = String::with_capacity(quoted.len());
    let mut characters = quoted.chars().peekable();
    while let Some(character) = characters.next() {
        match character {
            '\\' => value.push(characters.next_if(|c| "\"\\".contains(*c)).unwrap_or('\\')),
            '"' => return None,
            other => value.push(other),
        }
    }
    // A backslash before the last quote has made it a part of the value.
    (named && !ends_escaped(quoted)).then(|| (name.to_owned(), printable(&value)))
}

fn ends_escaped(quoted: &str) -> bool {
    let backslashes = quoted.len() - quoted.trim_end_matches('\\').len();
    backslashes % 2 == 1
}

/// UTF-8 where the bytes are that, else Windows-1252, which is Latin-1 and a little more.
pub fn decoded(bytes: &[u8]) -> Cow<'_, str> {
    match std::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => WINDOWS_1252.decode_without_bom_handling(bytes).0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_told_apart() {
        let number = |number, dots| Word::Number { number, dots };
        let a_move = |text: &str| Word::Move(text.to_owned());
        let glyphs = |numbers: &[u8]| Word::Annotation(numbers.to_vec());
        let cases = [
            ("12.", vec![number(12, 1)]),
            ("12", vec![number(12, 0)]),
            ("1.e4!?", vec![number(1, 1), a_move("e4"), glyphs(&[5])]),
            ("3...Nf6", vec![number(3, 3), a_move("Nf6")]),
            ("3…Nf6", vec![number(3, 3), a_move("Nf6")]),
            ("...Nf6", vec![Word::Dots(3), a_move("Nf6")]),
            ("...", vec![Word::Dots(3)]),
            (".Nf6", vec![Word::Unknown, a_move("Nf6")]),
            ("0-0", vec![a_move("0-0")]),
            ("0000", vec![a_move("0000")]),
            ("–‐", vec![a_move("–‐")]),
            ("1-0", vec![Word::Result("1-0")]),
            ("1–0.", vec![Word::Result("1-0")]),
            ("½", vec![Word::Result("1/2-1/2")]),
            ("Nf3+-", vec![a_move("Nf3"), glyphs(&[18])]),
            ("Nf3!?±", vec![a_move("Nf3"), glyphs(&[5, 16])]),
            ("Nf3+", vec![a_move("Nf3+")]),
            ("N@f3!", vec![a_move("N@f3"), glyphs(&[1])]),
            ("@e4", vec![a_move("@e4")]),
            ("O-O=", vec![a_move("O-O"), glyphs(&[10])]),
            ("+-", vec![glyphs(&[18])]),
            ("+–", vec![glyphs(&[18])]),
            ("Nc6∞", vec![a_move("Nc6"), glyphs(&[13])]),
            ("Nc6−+", vec![a_move("Nc6"), glyphs(&[19])]),
            ("—", vec![Word::Unknown]),
            ("=", vec![glyphs(&[10])]),
            ("!?", vec![glyphs(&[5])]),
            ("$12", vec![glyphs(&[12])]),
            ("$300", vec![glyphs(&[])]),
            ("$", vec![Word::Unknown]),
            ("e.p.", vec![glyphs(&[])]),
            ("N", vec![Word::Letter('N')]),
            ("♘", vec![Word::Unknown]),
            ("-", vec![Word::Unknown]),
            ("_", vec![Word::Unknown]),
            ("5x", vec![a_move("5x")]),
            ("e", vec![Word::Unknown]),
            ("", vec![]),
        ];
        for (word, expected) in cases {
            assert_eq!(classify(word).collect::<Vec<_>>(), expected, "{word:?}");
        }
    }

    #[test]
    fn brackets_without_moves_are_known() {
        for harmless in ["[%clk 0:01:00]", "[#]", "<br>", "<br />", "</p>"] {
            assert!(is_harmless(harmless), "{harmless}");
        }
        for other in ["[2. Nf3 Nc6]", "[%clk", "<2. Nf3>", "<Nf3>", "<br", "[]", "<>"] {
            assert!(!is_harmless(other), "{other}");
        }
    }
}
