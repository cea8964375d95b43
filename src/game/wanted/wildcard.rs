//! Text with `*` for any run of characters, as people look for names.

use deunicode::deunicode;

/// A text to compare with, in which `*` stands for any run of characters, none too; `\*` is the
/// character itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Wildcard {
    /// What stands before the first `*`, plain; the whole text where there is none.
    start: String,
    /// What stands behind each `*`, plain.
    rest: Vec<String>,
}

impl Wildcard {
    pub fn new(text: &str) -> Wildcard {
        // A character that no text has stands for `\*` while the others part the text.
        let text = text.trim().replace("\\*", "\0");
        let mut pieces = text.split('*').map(|piece| plain(&piece.replace('\0', "*")));
        Wildcard { start: pieces.next().unwrap_or_default(), rest: pieces.collect() }
    }

    /// Whether it is the whole of `text`, which is [`plain`].
    pub fn matches(&self, text: &str) -> bool {
        let Some((end, middle)) = self.rest.split_last() else {
            return text == self.start;
        };
        let Some(mut text) = text.strip_prefix(self.start.as_str()) else {
            return false;
        };
        // The first place is as good as any: it leaves most to what follows.
        for piece in middle {
            match text.find(piece.as_str()) {
                Some(at) => text = &text[at + piece.len()..],
                None => return false,
            }
        }
        text.ends_with(end.as_str())
    }
}

/// `text` as it is compared: in small Latin letters without accents, with one blank for several and none
/// behind a comma.
pub fn plain(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    for character in deunicode(text).chars() {
        if !character.is_whitespace() {
            plain.push(character.to_ascii_lowercase());
        } else if !plain.ends_with([' ', ',']) {
            plain.push(' ');
        }
    }
    plain
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_star_is_any_run_of_characters() {
        for (pattern, yes, no) in [
            ("kasparov", vec!["Kasparov", "KASPAROV"], vec!["Kasparov, G", "Karpov", ""]),
            ("Kasparov*", vec!["Kasparov", "Kasparov, Garry", "KASPAROV,G"], vec!["A. Kasparov"]),
            ("*blitz*", vec!["Rated Blitz game", "blitz"], vec!["Rated bullet game"]),
            ("a*b*c", vec!["abc", "a-b-b-c", "abcbc"], vec!["ab", "acb", "xabc"]),
            ("aa*aa", vec!["aaaa", "aa aa"], vec!["aaa"]),
            ("*", vec!["", "anything"], vec![]),
            ("Kasparov,  G*", vec!["Kasparov,Garry", "Kasparov, G"], vec!["Kasparov"]),
            ("two  words", vec!["Two Words", "two\twords"], vec!["twowords"]),
            (r"1/2\*", vec!["1/2*"], vec!["1/2", "1/2-1/2"]),
            (r"\**", vec!["*", "*x"], vec!["x"]),
            (r"C:\*", vec![r"c:*"], vec![r"c:\x"]),
            (r"a\b", vec![r"A\B"], vec!["ab"]),
        ] {
            let wildcard = Wildcard::new(pattern);
            for text in yes {
                assert!(wildcard.matches(&plain(text)), "{pattern:?} {text:?}");
            }
            for text in no {
                assert!(!wildcard.matches(&plain(text)), "{pattern:?} {text:?}");
            }
        }
    }

    #[test]
    fn letters_are_as_good_without_accents_and_in_other_scripts() {
        for (pattern, text) in [
            ("reti*", "Réti, Richárd"),
            ("reti*", "Re\u{301}ti, Richard"),
            ("RÉTI", "reti"),
            ("Lodz", "Łódź"),
            ("Bogh", "Bøgh"),
            ("Strasse", "Straße"),
            ("Alekhin", "Алехин"),
            ("1-0", "1–0"),
        ] {
            assert!(Wildcard::new(pattern).matches(&plain(text)), "{pattern:?} {text:?}");
        }
    }

    /// The definition, character by character.
    fn matches_slowly(pattern: &[u8], text: &[u8]) -> bool {
        match (pattern, text) {
            ([], _) => text.is_empty(),
            ([b'*', rest @ ..], _) => (0..=text.len()).any(|at| matches_slowly(rest, &text[at..])),
            ([first, rest @ ..], [letter, others @ ..]) => {
                first == letter && matches_slowly(rest, others)
            }
            (_, []) => false,
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4096))]
        #[test]
        fn it_matches_what_the_definition_does(pattern in "[ab*]{0,8}", text in "[ab]{0,10}") {
            let expected = matches_slowly(pattern.as_bytes(), text.as_bytes());
            prop_assert_eq!(Wildcard::new(&pattern).matches(&text), expected);
        }
    }
}
