//! Text from outside, fit to be shown.

use std::path::Path;

/// `text` on one line, with nothing in it that moves a cursor, rings a bell, turns the direction
/// of writing or cannot be seen.
pub fn printable(text: &str) -> String {
    let unfit = |c: char| {
        c.is_control()
            || matches!(c, '\u{61c}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}')
            || matches!(c, '\u{2060}'..='\u{2069}' | '\u{feff}')
    };
    if text.contains(unfit) { text.replace(unfit, " ") } else { text.to_owned() }
}

/// The first `longest` characters of `text`, with `…` where some are cut off.
pub fn shortened(text: &str, longest: usize) -> String {
    match text.char_indices().nth(longest) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}

/// A path as messages show it.
pub fn shown(path: &Path) -> String {
    printable(&path.to_string_lossy())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_moves_a_cursor_or_hides_is_not_shown() {
        let text = "a\u{1b}[2J\u{7}\u{9b}b\u{202e}\u{61c}\u{200b}c\u{7f}é";
        assert_eq!(printable(text), "a [2J  b   c é");
        assert_eq!(shown(Path::new("x\ny.pgn")), "x y.pgn");
    }
}
