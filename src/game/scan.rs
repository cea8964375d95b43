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
    /// What may be moves of the main line, without move numbers and glyphs.
    pub tokens: Vec<Token>,
    /// The whole movetext, comments and variations too, on one line: what pgn-reader is given.
    pub movetext: Vec<u8>,
    pub result: Option<&'static str>,
    pub problems: Vec<Problem>,
    /// Lines of the variations that are open, from the outermost.
    open_variations: Vec<usize>,
    /// Whether a blank line or a comment came after the last tag.
    gap: bool,
    /// What stands before the next token.
    before: Before,
}

/// A word of the movetext that may be a move, or that hides one.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct Token {
    pub line: usize,
    pub text: String,
    /// The move number directly before it.
    pub number: Option<u32>,
    /// Whether dots before it say that it is Black's.
    pub is_blacks: bool,
    /// A lone letter before it: a remark, or its piece.
    pub letter: Option<char>,
    /// Why the game cannot go on here, as a clause after the text.
    pub fault: Option<&'static str>,
}

impl Token {
    /// Whether it is written as a move.
    fn is_move(&self) -> bool {
        self.fault.is_none() && movetext::is_move(&self.text)
    }
}

#[derive(Debug, Default)]
struct Before {
    number: Option<u32>,
    dots: bool,
    letter: Option<char>,
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
                    let text = self.bytes.rest_of_line()?;
                    self.comment_text(&mut game, &text[1..]);
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
                self.stray_tags.push((line, raw));
                let game = game.get_or_insert_with(|| ScannedGame::at(line));
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
                    self.comment_text(game, &text);
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
                    text.push(b' ');
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
            Some(begun) => begun.problems.push(problem),
            None => game.get_or_insert_with(|| ScannedGame::at(opened)).problems.push(problem),
        }
        Ok(if self.begun.is_some() { Next::NewGame } else { Next::SameGame })
    }

    fn comment_text(&mut self, game: &mut Option<ScannedGame>, text: &[u8]) {
        if let Some(game) = game {
            game.gap = true;
            game.movetext.push(b'{');
            game.movetext.extend(text.iter().filter(|byte| !b"{}\r\n".contains(byte)));
            game.movetext.extend(b"} ");
        }
    }

    fn variation(&mut self, game: &mut Option<ScannedGame>) -> io::Result<Next> {
        let line = self.bytes.line;
        let Some(byte) = self.bytes.bump()? else {
            return Ok(Next::SameGame);
        };
        let game = self.current(game, line);
        if byte == b'(' {
            if game.tokens.is_empty() {
                game.stop(line, "(", "opens a variation before any move");
            }
            game.open_variations.push(line);
        } else if game.open_variations.pop().is_none() {
            // What came before may have been a variation: nothing after it is certain.
            game.stop(line, ")", "closes nothing");
            return Ok(Next::SameGame);
        }
        game.movetext.extend([byte, b' ']);
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
        if let Some(game) = game.as_mut().filter(|game| !game.open_variations.is_empty()) {
            game.keep(text);
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
            let again = from_one && at_line_start && game.before.number.is_none();
            game.has_ended() && goes_on() || again && game.tokens.len() > 1
        };
        if game.as_ref().is_some_and(begins) {
            let mut next = ScannedGame::at(line);
            next.take_stray(&mut self.stray_tags);
            if !at_line_start && !matches!(words.first(), Some(Word::Number { .. })) {
                // In the middle of a line they may go on with the game that seemed to end.
                let what = "goes on behind a result";
                next.problems.push(Problem::new(line, text, what, true));
                next.start_is_lost = true;
            }
            next.take(line, text, words);
            self.begun = Some(next);
            return Ok(Next::NewGame);
        }
        // A result alone, outside any game, is none.
        if game.is_none() && matches!(words[..], [Word::Result(_)]) {
            return Ok(Next::SameGame);
        }
        self.current(game, line).take(line, text, words);
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
            && self.tokens.iter().all(|token| token.number.is_none() && !token.is_move())
    }

    fn has_moves(&self) -> bool {
        !self.tokens.is_empty() || !self.open_variations.is_empty()
    }

    fn has_ended(&self) -> bool {
        self.result.is_some()
    }

    /// Notes something that hides no move.
    fn remark(&mut self, line: usize, token: &str, what: &str) {
        let problem = Problem::new(line, token, what, false);
        let known =
            self.problems.iter().any(|known| known.token == problem.token && known.what == what);
        if !known {
            self.problems.push(problem);
        }
    }

    /// Adds a token at which the game cannot go on; behind the result there is nothing to lose.
    fn stop(&mut self, line: usize, text: &str, fault: &'static str) {
        if self.has_ended() {
            self.remark(line, text, fault);
        } else {
            let text = text.to_owned();
            self.tokens.push(Token { line, text, fault: Some(fault), ..Token::default() });
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
                    self.problems.push(Problem::new(line, &raw, what, true));
                    self.start_is_lost = true;
                } else {
                    self.remark(line, &raw, "repeats a tag; the first one counts");
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
            self.problems.push(Problem::new(line, &raw, what, says_start));
            self.unread_tags.push(raw);
        }
    }

    fn bracketed(&mut self, line: usize, raw: &str) {
        let mut words = raw.split([' ', '\t', ']', ',']);
        if is_harmless(raw) && !words.any(movetext::is_move) {
            self.remark(line, raw, "is no move");
        } else {
            self.stop(line, raw, "may hide moves");
        }
    }

    fn keep(&mut self, text: &str) {
        self.movetext.extend(text.bytes().filter(|byte| *byte != b'['));
        self.movetext.push(b' ');
    }

    fn take(&mut self, line: usize, text: &str, words: Vec<Word>) {
        self.keep(text);
        for word in words {
            match word {
                Word::Number { number, dots } => {
                    let twice = self.before.number.is_some();
                    self.before = Before { number: Some(number), dots: dots > 1, letter: None };
                    if twice {
                        self.stop(line, text, "is a second number without a move between");
                    }
                }
                Word::Dots(dots) => self.before.dots |= dots > 1,
                Word::Result(result) => match self.result {
                    Some(known) if known != result => {
                        self.remark(line, text, "is a second result; the first one counts");
                    }
                    _ => self.result = Some(result),
                },
                Word::Move(text) if self.has_ended() => self.remark(line, &text, "is no move"),
                Word::Move(text) => self.token(line, text),
                Word::Annotation => {}
                Word::Letter(letter @ ('N' | 'D')) if self.before.number.is_none() => {
                    self.remark(line, text, "is no move");
                    self.before.letter = Some(letter);
                }
                Word::Letter(_) | Word::Unknown => self.stop(line, text, "is no move"),
            }
        }
    }

    fn token(&mut self, line: usize, text: String) {
        let before = mem::take(&mut self.before);
        self.tokens.push(Token {
            line,
            text,
            number: before.number,
            is_blacks: before.dots,
            letter: before.letter,
            fault: None,
        });
    }

    fn closed(mut self) -> ScannedGame {
        if let Some(&line) = self.open_variations.first() {
            let what = "opens a variation that is never closed";
            self.problems.push(Problem::new(line, "(", what, true));
        }
        self
    }
}

/// Whether a tag of that name, or a text that may hold one, says where a game starts.
fn says_start(text: &str) -> bool {
    let text = text.to_ascii_lowercase();
    ["fen", "setup", "variant"].iter().any(|name| text.contains(name))
}
