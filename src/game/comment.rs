//! A comment that is being read, of which a bounded part is kept.

use super::bytes::{Kept, LONGEST_BRACKET};
use super::word::{decoded, parse_tag};

/// How much of a comment is looked through for what it says to programs. The longest ones in real
/// files are essays of some thousand words before a game.
pub const LONGEST_COMMENT: usize = 64 * 1024;

/// What stands between `{` and `}`.
pub struct Comment {
    text: Kept<Vec<u8>>,
    /// The line that is being read, if it may be a tag.
    line: Kept<Vec<u8>>,
    is_blank: bool,
    keeps: bool,
    /// Whether a `{` stands within.
    pub has_brace: bool,
    /// Whether something said to programs may lie behind what is kept.
    pub loses_commands: bool,
}

impl Comment {
    /// An empty comment; one that does not keep its text is read for its end alone.
    pub fn new(keeps: bool) -> Comment {
        Comment {
            text: Kept::default(),
            line: Kept::default(),
            is_blank: true,
            keeps,
            has_brace: false,
            loses_commands: false,
        }
    }

    /// Adds text without a line end.
    pub fn add(&mut self, text: &[u8]) {
        self.has_brace = self.has_brace || memchr::memchr(b'{', text).is_some();
        let mut words = text;
        if self.is_blank {
            words = text.trim_ascii_start();
            self.is_blank = words.is_empty();
        }
        if words.first() == Some(&b'[') || !self.line.text.is_empty() {
            self.line.add(words, LONGEST_BRACKET);
        }
        self.keep(text);
    }

    /// Ends a line; gives the tag that it was, if it was one.
    pub fn end_line(&mut self) -> Option<(String, String)> {
        self.keep(b"\n");
        self.is_blank = true;
        let is_cut = std::mem::take(&mut self.line.is_cut);
        let tag = match self.line.text.trim_ascii() {
            line if line.is_empty() || is_cut => None,
            line => parse_tag(&decoded(line)),
        };
        self.line.text.clear();
        tag
    }

    /// What was kept.
    pub fn text(&self) -> &[u8] {
        &self.text.text
    }

    fn keep(&mut self, text: &[u8]) {
        if !self.keeps {
            return;
        }
        let begun = self.text.text.len();
        let was_cut = self.text.is_cut;
        self.text.add(text, LONGEST_COMMENT);
        let left_out = &text[self.text.text.len() - begun..];
        // Commands begin with `[`; one that is cut has begun before.
        self.loses_commands = self.loses_commands || memchr::memchr(b'[', left_out).is_some();
        if self.text.is_cut && !was_cut && !self.loses_commands {
            let last = memchr::memrchr2(b'[', b']', &self.text.text);
            self.loses_commands = last.is_some_and(|last| self.text.text[last] == b'[');
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tag_within_is_found_at_a_line_start_alone() {
        let mut comment = Comment::new(true);
        comment.add(b"see [Event \"x\"]");
        assert_eq!(comment.end_line(), None);
        for part in [" ", "[Eve", "nt \"x\"] "] {
            comment.add(part.as_bytes());
        }
        assert_eq!(comment.end_line(), Some(("Event".to_owned(), "x".to_owned())));
        assert_eq!(comment.text(), b"see [Event \"x\"]\n [Event \"x\"] \n");
    }

    #[test]
    fn what_is_kept_is_bounded_and_commands_behind_it_are_told() {
        for (behind, loses) in [("", false), ("[%clk 0:01]", true)] {
            let mut comment = Comment::new(true);
            for _ in 0..100_000 {
                comment.add(b"word ");
            }
            comment.add(behind.as_bytes());
            assert_eq!((comment.text().len(), comment.loses_commands), (LONGEST_COMMENT, loses));
        }
    }
}
