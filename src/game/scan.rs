//! Cuts a stream of PGN into games, with lines and tokens.
//!
//! pgn-reader drops what it cannot read and knows no lines; a blank line, an odd tag or an open
//! brace makes it lose moves or whole games. So games are cut here: a game ends where a tag
//! section begins, where moves go on after a result, or where they are numbered from 1 again.
//! Blank lines and odd tags end nothing. What may hide a move becomes a token with a fault, at
//! which the replay stops.

use std::io::{self, BufRead};
use std::mem;

use super::bytes::Bytes;
use super::line::{Line, ScannedVariation};
use super::word::{Word, classify, decoded, is_harmless, parse_tag};
use super::{Problem, movetext};

/// One game as it stands in the text.
#[derive(Debug, Default)]
pub struct ScannedGame {
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
    /// How many more are open, too deep to be kept.
    deeper: usize,
    /// Whether a blank line or a comment came after the last tag.
    gap: bool,
}

/// Gives the games of a stream one after the other.
pub struct Scanner<R> {
    bytes: Bytes<R>,
    /// The game that has begun when the one before was given out.
    begun: Option<ScannedGame>,
    /// Unreadable tags after moves: of the next game if a tag follows, else of this one.
    stray_tags: Vec<(usize, String)>,
}

/// Whether a piece of text begins the next game, which then stands in `Scanner::begun`.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Next {
    SameGame,
    NewGame,
}

/// How deep variations may lie within each other; what lies deeper is left out.
const DEEPEST: usize = 32;

/// Tags that begin a section; one of them within a comment shows that a brace was forgotten.
const FIRST_TAGS: [&str; 10] =
    ["Event", "Site", "Date", "Round", "White", "Black", "Result", "FEN", "SetUp", "Variant"];

impl<R: BufRead> Scanner<R> {
    /// Scans `reader` from its beginning, which is line 1.
    pub fn new(reader: R) -> Scanner<R> {
        Scanner { bytes: Bytes::new(reader), begun: None, stray_tags: Vec::new() }
    }

    fn next_game(&mut self) -> io::Result<Option<ScannedGame>> {
        let mut game = self.begun.take();
        let mut blank = false;
        while let Some(byte) = self.bytes.peek()? {
            let was_blank = mem::take(&mut blank);
            let next = match byte {
                b'\n' | b'\r' => {
                    self.bytes.bump()?;
                    if let (true, Some(game)) = (was_blank, &mut game) {
                        game.gap = true;
                    }
                    blank = true;
                    continue;
                }
                // 0x1A is how DOS ends a text.
                byte if byte.is_ascii_whitespace() || byte == 0x1A => {
                    self.bytes.bump()?;
                    blank = was_blank;
                    continue;
                }
                b'%' if self.bytes.at_first_column => {
                    self.bytes.rest_of_line()?;
                    continue;
                }
                b'[' => self.bracket(&mut game)?,
                b'{' => self.comment(&mut game)?,
                b';' => {
                    let line = self.bytes.line;
                    let text = self.bytes.rest_of_line()?;
                    if let Some(game) = &mut game {
                        game.comment(line, &text[1..]);
                    }
                    continue;
                }
                b'(' | b')' => self.variation(&mut game)?,
                b'<' => self.angle(&mut game)?,
                _ => self.word(&mut game)?,
            };
            if next == Next::NewGame {
                match game {
                    Some(game) => return Ok(Some(game.closed())),
                    None => game = self.begun.take(),
                }
            }
        }
        if let Some(game) = &mut game {
            game.take_stray(&mut self.stray_tags);
        }
        Ok(game.map(ScannedGame::closed))
    }

    /// Reads what a `[` opens.
    fn bracket(&mut self, game: &mut Option<ScannedGame>) -> io::Result<Next> {
        let line = self.bytes.line;
        let in_place = self.bytes.at_line_start
            || game.as_ref().is_none_or(|game| !game.has_moves() || game.has_ended());
        let raw = self.bytes.bracket()?;
        match parse_tag(&raw) {
            Some((name, value)) if in_place => return Ok(self.tag(game, line, name, value)),
            None if in_place && !is_harmless(&raw) => {
                // After moves it is not yet clear whether the next game begins here.
                let game = game.get_or_insert_with(|| ScannedGame::at(line));
                game.stop_variations(line, &raw, "is no move");
                self.stray_tags.push((line, raw));
                if !game.has_moves() && !game.has_ended() {
                    game.take_stray(&mut self.stray_tags);
                }
            }
            _ => self.current(game, line).bracketed(line, &raw),
        }
        Ok(Next::SameGame)
    }

    fn tag(
        &mut self,
        game: &mut Option<ScannedGame>,
        line: usize,
        name: String,
        value: String,
    ) -> Next {
        let Some(current) = game else {
            *game = Some(self.first_tag(line, name, value));
            return Next::SameGame;
        };
        let again = current.gap && super::tag(&current.tags, &name).is_some();
        if current.has_moves() || current.has_ended() || again {
            self.begun = Some(self.first_tag(line, name, value));
            return Next::NewGame;
        }
        current.tag(line, name, value);
        Next::SameGame
    }

    fn first_tag(&mut self, line: usize, name: String, value: String) -> ScannedGame {
        let line = self.stray_tags.first().map_or(line, |(line, _)| *line);
        let mut game = ScannedGame::at(line);
        game.take_stray(&mut self.stray_tags);
        game.tag(line, name, value);
        game
    }

    /// The game under way, which now goes on; begun here if there is none.
    fn current<'a>(
        &mut self,
        game: &'a mut Option<ScannedGame>,
        line: usize,
    ) -> &'a mut ScannedGame {
        let game = game.get_or_insert_with(|| ScannedGame::at(line));
        game.take_stray(&mut self.stray_tags);
        game
    }

    /// Reads a `{ comment }`; a tag section within shows that it is never closed.
    fn comment(&mut self, game: &mut Option<ScannedGame>) -> io::Result<Next> {
        let opened = self.bytes.line;
        self.bytes.bump()?;
        let mut text = Vec::new();
        let mut line_start = 0;
        loop {
            let line = self.bytes.line;
            match self.bytes.bump()? {
                Some(b'}') => {
                    if let Some(game) = game.as_mut().filter(|_| text.contains(&b'{')) {
                        // Either this comment or the one within it was never closed.
                        game.stop(opened, "{", "opens a comment with another one in it");
                    }
                    if let Some(game) = game {
                        game.comment(opened, &text);
                    }
                    return Ok(Next::SameGame);
                }
                Some(b'\n') => {
                    let last = decoded(text[line_start..].trim_ascii());
                    let tag = parse_tag(&last);
                    if let Some((name, value)) =
                        tag.filter(|(name, _)| FIRST_TAGS.contains(&name.as_str()))
                    {
                        self.begun = Some(self.first_tag(line, name, value));
                        break;
                    }
                    text.push(b'\n');
                    line_start = text.len();
                }
                Some(byte) => text.push(byte),
                None => break,
            }
        }
        // Before a game, or behind a result, it hides nothing when a game begins within.
        let hides_moves =
            self.begun.is_none() || game.as_ref().is_some_and(|game| !game.has_ended());
        let what = "opens a comment that is never closed";
        let problem = Problem::new(opened, "{", what, hides_moves);
        match self.begun.as_mut().filter(|_| game.is_none()) {
            Some(begun) => begun.main.problems.push(problem),
            None => {
                game.get_or_insert_with(|| ScannedGame::at(opened)).main.problems.push(problem);
            }
        }
        Ok(if self.begun.is_some() { Next::NewGame } else { Next::SameGame })
    }

    /// Reads a bracket that opens or closes a variation.
    fn variation(&mut self, game: &mut Option<ScannedGame>) -> io::Result<Next> {
        let line = self.bytes.line;
        let opens = self.bytes.bump()? == Some(b'(');
        let game = self.current(game, line);
        if opens {
            game.open_variation(line);
        } else {
            game.close_variation(line);
        }
        Ok(Next::SameGame)
    }

    /// Reads `<…>`: the standard keeps it for later, and pages from the web leave `<br>`.
    fn angle(&mut self, game: &mut Option<ScannedGame>) -> io::Result<Next> {
        let line = self.bytes.line;
        let mut raw = self.bytes.until(|byte| b">\r\n".contains(&byte))?;
        if self.bytes.peek()? == Some(b'>') {
            raw.extend(self.bytes.bump()?);
        }
        if let Some(game) = game {
            game.bracketed(line, &decoded(&raw));
        }
        Ok(Next::SameGame)
    }

    fn word(&mut self, game: &mut Option<ScannedGame>) -> io::Result<Next> {
        let line = self.bytes.line;
        let at_line_start = self.bytes.at_line_start;
        let raw = decoded(&self.bytes.word()?);
        let text = raw.trim_start_matches('\u{feff}');
        if text.is_empty() {
            self.bytes.at_line_start = at_line_start;
            return Ok(Next::SameGame);
        }
        if let Some(game) = game.as_mut().filter(|game| !game.open.is_empty()) {
            if game.deeper == 0 {
                let words = text.split_whitespace().flat_map(classify);
                game.innermost().take(line, text, words);
            }
            return Ok(Next::SameGame);
        }
        // Blanks that are not ASCII (a no-break space) may stand within.
        let words: Vec<Word> = text.split_whitespace().flat_map(classify).collect();
        let goes_on = || {
            words.iter().any(|word| match word {
                Word::Number { .. } => true,
                Word::Move(text) => movetext::is_move(text),
                _ => false,
            })
        };
        let from_one = matches!(words.first(), Some(Word::Number { number: 1, dots: 1 }));
        let begins = |game: &ScannedGame| {
            let again = from_one && at_line_start && !game.main.awaits_a_move();
            game.has_ended() && goes_on() || again && game.main.tokens.len() > 1
        };
        if game.as_ref().is_some_and(begins) {
            let mut next = ScannedGame::at(line);
            next.take_stray(&mut self.stray_tags);
            if !at_line_start && !matches!(words.first(), Some(Word::Number { .. })) {
                // In the middle of a line they may go on with the game that seemed to end.
                let what = "goes on behind a result";
                next.main.problems.push(Problem::new(line, text, what, true));
                next.start_is_lost = true;
            }
            next.main.take(line, text, words);
            self.begun = Some(next);
            return Ok(Next::NewGame);
        }
        // A result alone, outside any game, is none.
        if game.is_none() && matches!(words[..], [Word::Result(_)]) {
            return Ok(Next::SameGame);
        }
        self.current(game, line).main.take(line, text, words);
        Ok(Next::SameGame)
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

    /// Whether nothing in the text says that it is a game: no tag, number, result or move.
    pub fn is_no_game(&self) -> bool {
        self.tags.is_empty()
            && self.unread_tags.is_empty()
            && !self.has_ended()
            && self.main.tokens.iter().all(|token| token.number.is_none() && !token.is_move())
    }

    fn has_moves(&self) -> bool {
        !self.main.tokens.is_empty() || !self.open.is_empty()
    }

    fn has_ended(&self) -> bool {
        self.main.result.is_some()
    }

    /// The line that the text is in: the main line, or the innermost variation that is kept.
    fn innermost(&mut self) -> &mut Line {
        match self.open.last_mut() {
            Some(variation) => &mut variation.line,
            None => &mut self.main,
        }
    }

    /// Ends the main line at something that may hide a move, and the variations that are open.
    fn stop(&mut self, line: usize, text: &str, fault: &'static str) {
        self.main.stop(line, text, fault);
        self.stop_variations(line, text, fault);
    }

    fn stop_variations(&mut self, line: usize, text: &str, fault: &'static str) {
        for variation in &mut self.open {
            variation.line.stop(line, text, fault);
        }
    }

    fn comment(&mut self, line: usize, text: &[u8]) {
        self.gap = true;
        if self.deeper == 0 {
            self.innermost().comment(line, text);
        }
    }

    fn open_variation(&mut self, line: usize) {
        if self.open.len() == DEEPEST {
            let what = "opens a variation that lies too deep in others; it is left out";
            self.innermost().remark(line, "(", what);
            self.deeper += 1;
            return;
        }
        let parent = self.innermost();
        if parent.tokens.is_empty() {
            parent.stop(line, "(", "opens a variation before any move");
        }
        let variation = parent.variation(line);
        self.open.push(variation);
    }

    fn close_variation(&mut self, line: usize) {
        if self.deeper > 0 {
            self.deeper -= 1;
        } else if let Some(closed) = self.open.pop() {
            self.innermost().add(closed);
        } else {
            // What came before may have been a variation: nothing after it is certain.
            self.main.stop(line, ")", "closes nothing");
        }
    }

    fn tag(&mut self, line: usize, name: String, value: String) {
        self.gap = false;
        match super::tag(&self.tags, &name) {
            None => self.tags.push((name, value)),
            Some(first) => {
                let raw = format!("[{name} \"{value}\"]");
                if says_start(&name) && first != value {
                    let what = "says something else than the tag of that name before it";
                    self.main.problems.push(Problem::new(line, &raw, what, true));
                    self.start_is_lost = true;
                } else {
                    self.main.remark(line, &raw, "repeats a tag; the first one counts");
                }
            }
        }
    }

    /// Takes unreadable tags over.
    fn take_stray(&mut self, tags: &mut Vec<(usize, String)>) {
        for (line, raw) in tags.drain(..) {
            let what = "is no tag, expected [Name \"Value\"]";
            if self.has_moves() || !raw.ends_with(']') && raw.contains("1.") {
                // It may hold moves, or be the start of a game that is not this one.
                self.stop(line, &raw, what);
                continue;
            }
            let says_start = says_start(&raw) || raw.matches('/').count() >= 7;
            self.start_is_lost |= says_start;
            self.main.problems.push(Problem::new(line, &raw, what, says_start));
            self.unread_tags.push(raw);
        }
    }

    fn bracketed(&mut self, line: usize, raw: &str) {
        let mut words = raw.split([' ', '\t', ']', ',']);
        if is_harmless(raw) && !words.any(movetext::is_move) {
            self.main.remark(line, raw, "is no move");
        } else {
            self.stop(line, raw, "may hide moves");
        }
    }

    fn closed(mut self) -> ScannedGame {
        // It is not known where they end; so nothing of them is kept.
        if let Some(outermost) = self.open.first() {
            let what = "opens a variation that is never closed";
            self.main.problems.push(Problem::new(outermost.opened, "(", what, true));
        }
        self.open.clear();
        self
    }
}

/// Whether a tag of that name, or a text that may hold one, says where a game starts.
fn says_start(text: &str) -> bool {
    let text = text.to_ascii_lowercase();
    ["fen", "setup", "variant"].iter().any(|name| text.contains(name))
}
