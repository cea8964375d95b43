//! A game as it stands in the text: what has been cut out of it, token by token.

use super::bytes::LONGEST_BRACKET;
use super::comment::Comment;
use super::line::{Line, ScannedVariation};
use super::plain::Plain;
use super::word::is_harmless;
use super::{Problem, movetext};
use crate::text::printable;

/// How many tags of a game are read. Files have some twenty.
pub(super) const MOST_TAGS: usize = 1000;

/// How deep variations may lie within each other; what lies deeper is left out.
const DEEPEST: usize = 32;

/// How much of all variations of a game is kept: as many moves as some dozens of games have.
const MOST_ASIDE: usize = 50_000;

/// One game as it stands in the text.
#[derive(Debug, Default)]
pub struct ScannedGame {
    /// The game's number in its text, from 1; 0 as long as it is not known to be one.
    pub number: usize,
    /// Whether it was not picked, and nothing more is known of it.
    pub is_skipped: bool,
    /// Whether a packed stream has ended within it, which it then tells.
    pub is_cut_off: bool,
    /// The line where the game begins, from 1.
    pub line: usize,
    /// Name and value of the tags that could be read, in order.
    pub tags: Vec<(String, String)>,
    /// Tags that could not be read, as they stand.
    pub unread_tags: Vec<String>,
    /// Whether a tag that says where the game starts could not be read.
    pub start_is_lost: bool,
    /// The moves that were played, and the variations of them.
    pub main: Line,
    /// The variations that are open, from the outermost.
    open: Vec<ScannedVariation>,
    /// How many more are open that are not kept, and the line of the first of them.
    deeper: usize,
    deeper_from: usize,
    /// How much is kept of variations: how many there are, and tokens and problems of theirs.
    aside: usize,
    /// Whether a blank line or a comment came after the last tag.
    pub(super) gap: bool,
}

impl ScannedGame {
    pub(super) fn at(line: usize) -> ScannedGame {
        ScannedGame { line, ..ScannedGame::default() }
    }

    /// Whether nothing in the text says that it is a game: no tag, number, result or move.
    pub(super) fn is_no_game(&self) -> bool {
        self.tags.is_empty()
            && self.unread_tags.is_empty()
            && !self.has_ended()
            && !self.main.is_played
    }

    /// Keeps no more than what tells where the game ends.
    pub(super) fn skip(&mut self) {
        self.is_skipped = true;
        self.main.skip();
        for variation in &mut self.open {
            variation.line.skip();
        }
    }

    /// Whether a plain word may begin the next game, so that more must be looked at.
    #[inline]
    pub(super) fn may_end_at(&self, word: Plain, at_line_start: bool) -> bool {
        let is_first = |number: u32, dots: usize| at_line_start && number == 1 && dots == 1;
        !self.is_in_variation()
            && (self.has_ended()
                || match word {
                    Plain::Number { number, dots } => is_first(number, dots),
                    Plain::NumberedMove { number, dots, .. } => is_first(number, dots),
                    Plain::Move(_) | Plain::Result(_) => false,
                })
    }

    /// Takes a plain word that goes on with this game.
    #[inline]
    pub(super) fn take_plain(
        &mut self,
        line: usize,
        text: &[u8],
        plain: Plain,
        stray: &mut Vec<(usize, String)>,
    ) {
        if self.is_in_variation() {
            self.in_variation(line, |variation| variation.take_plain(line, text, plain));
        } else {
            if !stray.is_empty() {
                self.take_stray(stray);
            }
            self.main.take_plain(line, text, plain);
        }
    }

    /// Goes on with the innermost variation, as long as so much is kept.
    pub(super) fn in_variation(&mut self, line: usize, go_on: impl FnOnce(&mut Line)) {
        if self.deeper > 0 || self.aside > MOST_ASIDE {
            return;
        }
        let innermost = self.innermost();
        let kept = |line: &Line| line.tokens.len() + line.problems.len();
        let before = kept(innermost);
        go_on(innermost);
        self.aside += kept(self.innermost()).saturating_sub(before);
        if self.aside > MOST_ASIDE {
            let what = "comes behind the 50000 half-moves of variations that are read of a game";
            self.stop_variations(line, "(", what);
        }
    }

    pub(super) fn has_moves(&self) -> bool {
        self.main.count > 0 || self.is_in_variation()
    }

    pub(super) fn is_in_variation(&self) -> bool {
        !self.open.is_empty() || self.deeper > 0
    }

    pub(super) fn has_ended(&self) -> bool {
        self.main.result.is_some()
    }

    /// The line that the text is in: the main line, or the innermost variation that is kept.
    pub(super) fn innermost(&mut self) -> &mut Line {
        match self.open.last_mut() {
            Some(variation) => &mut variation.line,
            None => &mut self.main,
        }
    }

    /// Ends the main line at something that may hide a move, and the variations that are open.
    pub(super) fn stop(&mut self, line: usize, text: &str, fault: &'static str) {
        self.main.stop(line, text, fault);
        self.stop_variations(line, text, fault);
    }

    pub(super) fn stop_variations(&mut self, line: usize, text: &str, fault: &'static str) {
        for variation in &mut self.open {
            variation.line.stop(line, text, fault);
        }
    }

    pub(super) fn comment(&mut self, line: usize, comment: &Comment) {
        self.gap = true;
        if self.is_in_variation() {
            self.in_variation(line, |variation| variation.comment(line, comment));
        } else {
            self.main.comment(line, comment);
        }
    }

    pub(super) fn open_variation(&mut self, line: usize) {
        let what = match self.open.len() {
            DEEPEST => "opens a variation that lies too deep in others; it is left out",
            _ if self.aside >= MOST_ASIDE => {
                "opens a variation behind the 50000 half-moves of them that are read of a game; \
                 it is left out"
            }
            _ if self.deeper > 0 => "",
            _ => {
                let parent = self.innermost();
                if parent.count == 0 {
                    parent.stop(line, "(", "opens a variation before any move");
                }
                let variation = parent.variation(line);
                self.open.push(variation);
                self.aside += usize::from(!self.is_skipped);
                return;
            }
        };
        if self.deeper == 0 {
            self.innermost().remark(line, "(", what);
            self.deeper_from = line;
        }
        self.deeper += 1;
    }

    pub(super) fn close_variation(&mut self, line: usize) {
        if self.deeper > 0 {
            self.deeper -= 1;
        } else if let Some(closed) = self.open.pop() {
            self.innermost().add(closed);
        } else {
            // What came before may have been a variation: nothing after it is certain.
            self.main.stop(line, ")", "closes nothing");
        }
    }

    pub(super) fn tag(&mut self, line: usize, name: String, value: String) {
        self.gap = false;
        match super::tag(&self.tags, &name) {
            None if self.tags.len() < MOST_TAGS => self.tags.push((name, value)),
            None => {
                let raw = format!("[{name} \"{value}\"]");
                let loses_start = says_start(&name);
                self.start_is_lost |= loses_start;
                let what = "comes behind the 1000 tags that are read of a game";
                self.main.problem(Problem::new(line, &raw, what, loses_start));
            }
            Some(first) => {
                let raw = format!("[{name} \"{value}\"]");
                if says_start(&name) && first != value {
                    let what = "says something else than the tag of that name before it";
                    self.main.problem(Problem::new(line, &raw, what, true));
                    self.start_is_lost = true;
                } else {
                    self.main.remark(line, &raw, "repeats a tag; the first one counts");
                }
            }
        }
    }

    /// Takes unreadable tags over.
    pub(super) fn take_stray(&mut self, tags: &mut Vec<(usize, String)>) {
        for (line, raw) in tags.drain(..) {
            let what = if is_cut(&raw) {
                "is longer than the 8 KiB of a tag that are read"
            } else {
                "is no tag, expected [Name \"Value\"]"
            };
            if self.has_moves() || may_hold_moves(&raw) {
                // It may hold moves, or be the start of a game that is not this one.
                self.stop(line, &raw, what);
                continue;
            }
            let says_start = may_say_start(&raw);
            self.start_is_lost |= says_start;
            self.main.problem(Problem::new(line, &raw, what, says_start));
            if self.unread_tags.len() < MOST_TAGS {
                self.unread_tags.push(printable(&raw));
            }
        }
    }

    pub(super) fn bracketed(&mut self, line: usize, raw: &str) {
        let mut words = raw.split([' ', '\t', ']', ',']);
        if is_harmless(raw) && !words.any(movetext::is_move) {
            self.main.remark(line, raw, "is no move");
        } else {
            self.stop(line, raw, "may hide moves");
        }
    }

    pub(super) fn closed(mut self) -> ScannedGame {
        // It is not known where they end; so nothing of them is kept.
        if self.is_in_variation() {
            let opened = self.open.first().map_or(self.deeper_from, |outermost| outermost.opened);
            let what = "opens a variation that is never closed";
            self.main.problem(Problem::new(opened, "(", what, true));
        }
        self.open.clear();
        self
    }
}

/// Whether what stands in a bracket was longer than what is kept of it.
fn is_cut(raw: &str) -> bool {
    raw.len() > LONGEST_BRACKET && raw.ends_with('…')
}

/// Whether moves may be a part of a tag that could not be read.
fn may_hold_moves(raw: &str) -> bool {
    !raw.ends_with(']') && (raw.contains("1.") || is_cut(raw))
}

/// Whether a tag that could not be read may say where a game starts.
fn may_say_start(raw: &str) -> bool {
    says_start(raw) || raw.matches('/').count() >= 7
}

/// Whether there is more in a tag that could not be read than words.
pub(super) fn hides_much(raw: &str) -> bool {
    may_hold_moves(raw) || may_say_start(raw)
}

/// Whether a tag of that name, or a text that may hold one, says where a game starts.
fn says_start(text: &str) -> bool {
    let text = text.to_ascii_lowercase();
    ["fen", "setup", "variant"].iter().any(|name| text.contains(name))
}
