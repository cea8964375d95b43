//! Glyphs and their numbers: the numeric annotation glyphs (NAGs) of the PGN standard.

use super::word::ascii_dashes;

/// Glyphs of moves, from number 1.
const OF_MOVES: [&str; 6] = ["!", "?", "!!", "??", "!?", "?!"];

/// The usual glyphs of positions.
const OF_POSITIONS: [(u8, &str); 8] =
    [(10, "="), (13, "∞"), (14, "⩲"), (15, "⩱"), (16, "±"), (17, "∓"), (18, "+−"), (19, "−+")];

/// Other glyphs, and other ways to write one. Where White's and Black's have two numbers, it is
/// White's.
const OTHERS: [(u8, &str); 16] = [
    (7, "□"),
    (14, "+/="),
    (14, "+="),
    (15, "=/+"),
    (15, "=+"),
    (16, "+/-"),
    (17, "-/+"),
    (18, "+-"),
    (19, "-+"),
    (22, "○"),
    (32, "⟳"),
    (36, "↑"),
    (40, "→"),
    (132, "⇆"),
    (138, "⊕"),
    (138, "⨁"),
];

/// The glyph of a move that has that number.
pub fn of_move(nag: u8) -> Option<&'static str> {
    OF_MOVES.get(usize::from(nag).checked_sub(1)?).copied()
}

/// The glyph of a position that has that number.
pub fn of_position(nag: u8) -> Option<&'static str> {
    OF_POSITIONS.iter().find(|(known, _)| *known == nag).map(|(_, glyph)| *glyph)
}

/// The numbers of the glyphs that stand in `text` without a blank: `!?±` is 5 and 16. Signs that
/// have no number are passed over.
pub fn numbers(text: &str) -> Vec<u8> {
    let known = || (1..).zip(OF_MOVES).chain(OF_POSITIONS).chain(OTHERS);
    let text = ascii_dashes(text);
    let mut numbers = Vec::new();
    let mut rest = text.as_str();
    while let Some(next) = rest.chars().next() {
        let longest = known()
            .filter(|(_, glyph)| rest.starts_with(glyph))
            .max_by_key(|(_, glyph)| glyph.len());
        numbers.extend(longest.map(|(number, _)| number));
        rest = &rest[longest.map_or(next.len_utf8(), |(_, glyph)| glyph.len())..];
    }
    numbers
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn glyphs_have_the_numbers_of_the_standard() {
        let cases: [(&str, &[u8]); 16] = [
            ("", &[]),
            ("!", &[1]),
            ("??", &[4]),
            ("!?", &[5]),
            ("?!", &[6]),
            ("!!!", &[3, 1]),
            ("!?±", &[5, 16]),
            ("=!", &[10, 1]),
            ("∞", &[13]),
            ("+/=", &[14]),
            ("=+", &[15]),
            ("+/-", &[16]),
            ("+-", &[18]),
            ("+−", &[18]),
            ("-+", &[19]),
            ("~#", &[]),
        ];
        for (text, expected) in cases {
            assert_eq!(numbers(text), expected, "{text}");
        }
    }
}
