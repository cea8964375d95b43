//! Cuts a stream of PGN into games, with lines and tokens.
//!
//! pgn-reader drops what it cannot read and knows no lines; a blank line, an odd tag or an open
//! brace makes it lose moves or whole games. So games are cut here: a game ends where a tag
//! section begins, or where moves go on after a result. Blank lines and odd tags end nothing.

use std::io::{self, BufRead};

use super::Problem;
use super::bytes::Bytes;
use super::word::{Word, classify, decoded, parse_tag, split_number};

/// One game as it stands in the text.
#[derive(Debug, Default)]
pub struct ScannedGame {
    /// The line where the game begins, from 1.
    pub line: usize,
    /// Name and value of the tags that could be read, in order.
    pub tags: Vec<(String, String)>,
    /// Whether a tag that says where the game starts could not be read.
    pub start_is_lost: bool,
    /// What may be moves of the main line, without move numbers and glyphs.
    pub tokens: Vec<Token>,
    /// The first move number, where there is one.
    pub first_number: Option<u32>,
    /// The whole movetext, comments and variations too, on one line: what pgn-reader is given.
    pub movetext: Vec<u8>,
    pub result: Option<String>,
    pub problems: Vec<Problem>,
    /// Lines of the variations that are open, from the outermost.
    open_variations: Vec<usize>,
    /// Whether a blank line or a comment came after the last tag.
    gap: bool,
}

/// A word of the movetext.
#[derive(Debug, PartialEq, Eq)]
pub struct Token {
    pub line: usize,
    pub text: String,
}

/// Gives the games of a stream one after the other.
pub struct Scanner<R> {
    bytes: Bytes<R>,
    /// The game that has begun when the one before was given out.
    begun: Option<ScannedGame>,
    /// Unreadable tags after moves: of the next game if a tag follows, else of this one.
    stray_tags: Vec<(usize, String)>,
}

impl<R: BufRead> Scanner<R> {
    /// Scans `reader` from its beginning, which is line 1.
    pub fn new(reader: R) -> Scanner<R> {
        Scanner { bytes: Bytes::new(reader), begun: None, stray_tags: Vec::new() }
    }

    fn next_game(&mut self) -> io::Result<Option<ScannedGame>> {
        let mut game = self.begun.take();
        let mut blank = false;
        while let Some(byte) = self.bytes.peek()? {
            let finished = match byte {
                b'\n' | b'\r' => {
                    self.bytes.bump()?;
                    if let (true, Some(game)) = (blank, &mut game) {
                        game.gap = true;
                    }
                    blank = true;
                    continue;
                }
                byte if byte.is_ascii_whitespace() => {
                    self.bytes.bump()?;
                    continue;
                }
                b'%' if self.bytes.at_line_start => {
                    self.bytes.rest_of_line()?;
                    continue;
                }
                b'[' => self.bracket(&mut game)?,
                b'{' => self.comment(&mut game)?,
                b';' => {
                    let text = self.bytes.rest_of_line()?;
                    self.comment_text(&mut game, &text[1..]);
                    false
                }
                b'(' | b')' => {
                    self.variation(&mut game)?;
                    false
                }
                b'<' => {
                    self.angle(&mut game)?;
                    false
                }
                _ => self.word(&mut game)?,
            };
            blank = false;
            if finished {
                return Ok(game.map(ScannedGame::closed));
            }
        }
        if let Some(game) = &mut game {
            game.take_unreadable(&mut self.stray_tags);
        }
        Ok(game.map(ScannedGame::closed))
    }

    /// Reads what a `[` opens; true when it begins the next game.
    fn bracket(&mut self, game: &mut Option<ScannedGame>) -> io::Result<bool> {
        let line = self.bytes.line;
        let in_place = self.bytes.at_line_start
            || game.as_ref().is_none_or(|game| !game.has_moves() || game.result.is_some());
        let raw = self.bytes.bracket()?;
        if !in_place {
            if let Some(game) = game {
                game.report(line, &raw, "is no move", false);
            }
            return Ok(false);
        }
        let Some((name, value)) = parse_tag(&raw) else {
            // After moves it is not yet clear whether the next game begins here.
            self.stray_tags.push((line, raw));
            let game = game.get_or_insert_with(|| ScannedGame::at(line));
            if !game.has_moves() && !game.has_ended() {
                game.take_unreadable(&mut self.stray_tags);
            }
            return Ok(false);
        };
        if let Some(current) = game {
            let again = current.gap && super::tag(&current.tags, &name).is_some();
            if current.has_moves() || current.has_ended() || again {
                self.begun = Some(self.first_tag(line, name, value));
                return Ok(true);
            }
            current.tag(line, name, value);
        } else {
            *game = Some(self.first_tag(line, name, value));
        }
        Ok(false)
    }

    fn first_tag(&mut self, line: usize, name: String, value: String) -> ScannedGame {
        let line = self.stray_tags.first().map_or(line, |(line, _)| *line);
        let mut game = ScannedGame::at(line);
        game.take_unreadable(&mut self.stray_tags);
        game.tag(line, name, value);
        game
    }

    /// Reads a `{ comment }`; true when it is never closed, and a new game begins within it.
    fn comment(&mut self, game: &mut Option<ScannedGame>) -> io::Result<bool> {
        let opened = self.bytes.line;
        self.bytes.bump()?;
        let mut text = Vec::new();
        let mut line_start = 0;
        let mut blank_before = false;
        loop {
            let line = self.bytes.line;
            match self.bytes.bump()? {
                Some(b'}') => {
                    self.comment_text(game, &text);
                    return Ok(false);
                }
                Some(b'\n') => {
                    let last = text[line_start..].trim_ascii();
                    // A tag section within a comment: the brace was forgotten.
                    if blank_before
                        && last.starts_with(b"[Event ")
                        && let Some((name, value)) = parse_tag(&decoded(last))
                    {
                        self.begun = Some(self.first_tag(line, name, value));
                        break;
                    }
                    blank_before = last.is_empty();
                    text.push(b' ');
                    line_start = text.len();
                }
                Some(byte) => text.push(byte),
                None => break,
            }
        }
        if let Some(game) = game {
            game.report(opened, "{", "opens a comment that is never closed", true);
        }
        Ok(self.begun.is_some())
    }

    fn comment_text(&mut self, game: &mut Option<ScannedGame>, text: &[u8]) {
        if let Some(game) = game {
            game.gap = true;
            game.movetext.push(b'{');
            game.movetext.extend(text.iter().filter(|byte| !b"{}\r\n".contains(byte)));
            game.movetext.extend(b"} ");
        }
    }

    fn variation(&mut self, game: &mut Option<ScannedGame>) -> io::Result<()> {
        let line = self.bytes.line;
        let Some(byte) = self.bytes.bump()? else {
            return Ok(());
        };
        let game = game.get_or_insert_with(|| ScannedGame::at(line));
        game.take_unreadable(&mut self.stray_tags);
        if byte == b'(' {
            game.open_variations.push(line);
        } else if game.open_variations.pop().is_none() {
            // What came before may have been a variation: nothing after it is certain.
            game.tokens.push(Token { line, text: ")".to_owned() });
            return Ok(());
        }
        game.movetext.extend([byte, b' ']);
        Ok(())
    }

    /// Passes over `<…>`: the standard keeps it for later, and pages from the web leave `<br>`.
    fn angle(&mut self, game: &mut Option<ScannedGame>) -> io::Result<()> {
        let line = self.bytes.line;
        let mut raw = self.bytes.until(|byte| b">\r\n".contains(&byte))?;
        if self.bytes.peek()? == Some(b'>') {
            raw.extend(self.bytes.bump()?);
        }
        let raw = decoded(&raw);
        if let Some(game) = game {
            let reported = game.problems.iter().any(|problem| problem.token == raw);
            if !reported {
                game.report(line, &raw, "is no move", false);
            }
        }
        Ok(())
    }

    /// Reads a word; true when it begins the next game.
    fn word(&mut self, game: &mut Option<ScannedGame>) -> io::Result<bool> {
        let line = self.bytes.line;
        let at_line_start = self.bytes.at_line_start;
        let raw = self.bytes.word()?;
        let text = decoded(&raw);
        let text = text.trim_start_matches('\u{feff}');
        if text.is_empty() {
            self.bytes.at_line_start = at_line_start;
            return Ok(false);
        }
        if let Some(game) = game.as_mut().filter(|game| !game.open_variations.is_empty()) {
            game.keep(text);
            return Ok(false);
        }
        let (number, rest) = split_number(text);
        let mut words = number.map(Word::Number).into_iter().chain(classify(rest)).peekable();
        let goes_on =
            words.peek().is_some_and(|word| matches!(word, Word::Number(_) | Word::Move(_)));
        if goes_on && game.as_ref().is_some_and(ScannedGame::has_ended) {
            let mut next = ScannedGame::at(line);
            next.take_unreadable(&mut self.stray_tags);
            next.take(line, text, words);
            self.begun = Some(next);
            return Ok(true);
        }
        // A result alone, outside any game, is none.
        if game.is_none() && !goes_on {
            return Ok(false);
        }
        let game = game.get_or_insert_with(|| ScannedGame::at(line));
        game.take_unreadable(&mut self.stray_tags);
        game.take(line, text, words);
        Ok(false)
    }
}

impl<R: BufRead> Iterator for Scanner<R> {
    type Item = io::Result<ScannedGame>;

    fn next(&mut self) -> Option<io::Result<ScannedGame>> {
        self.next_game().transpose()
    }
}

impl ScannedGame {
    fn at(line: usize) -> ScannedGame {
        ScannedGame { line, ..ScannedGame::default() }
    }

    fn has_moves(&self) -> bool {
        !self.tokens.is_empty() || !self.open_variations.is_empty()
    }

    fn has_ended(&self) -> bool {
        self.result.is_some()
    }

    fn report(&mut self, line: usize, token: &str, what: &str, loses_moves: bool) {
        self.problems.push(Problem::new(line, token, what, loses_moves));
    }

    fn tag(&mut self, line: usize, name: String, value: String) {
        self.gap = false;
        if super::tag(&self.tags, &name).is_some() {
            self.report(
                line,
                &format!("[{name} \"{value}\"]"),
                "repeats a tag; the first one counts",
                false,
            );
        } else {
            self.tags.push((name, value));
        }
    }

    /// Takes unreadable tags over as problems.
    fn take_unreadable(&mut self, tags: &mut Vec<(usize, String)>) {
        for (line, raw) in tags.drain(..) {
            let name = raw.trim_start_matches(['[', ' ', '\t']).to_ascii_lowercase();
            let says_start = ["fen", "setup", "variant"].iter().any(|tag| name.starts_with(tag));
            if says_start && self.has_moves() {
                // What follows may be moves of a game with a start of its own: stop there.
                self.tokens.push(Token { line, text: raw });
                continue;
            }
            self.start_is_lost |= says_start;
            self.report(line, &raw, "is no tag, expected [Name \"Value\"]", says_start);
        }
    }

    fn keep(&mut self, text: &str) {
        self.movetext.extend(text.bytes().filter(|byte| *byte != b'['));
        self.movetext.push(b' ');
    }

    fn take(&mut self, line: usize, text: &str, words: impl Iterator<Item = Word>) {
        self.keep(text);
        for word in words {
            match word {
                Word::Number(number) => {
                    self.first_number = self.first_number.or(Some(number));
                }
                Word::Result(result) => {
                    if self.result.as_ref().is_some_and(|known| *known != result) {
                        self.report(line, text, "is a second result; the first one counts", false);
                    }
                    self.result.get_or_insert(result);
                }
                Word::Move(text) => self.tokens.push(Token { line, text }),
                Word::Annotation => {}
                Word::Odd => self.report(line, text, "is no move", false),
            }
        }
    }

    fn closed(mut self) -> ScannedGame {
        if let Some(&line) = self.open_variations.first() {
            self.report(line, "(", "opens a variation that is never closed", true);
        }
        self
    }
}
