//! Cuts a stream of PGN into games, with lines and tokens.
//!
//! pgn-reader drops what it cannot read and knows no lines; a blank line, an odd tag or an open
//! brace makes it lose moves or whole games. So games are cut here: a game ends where a tag
//! section begins, where moves go on after a result, or where they are numbered from 1 again.
//! Blank lines and odd tags end nothing. What may hide a move becomes a token with a fault, at
//! which the replay stops.

use std::io::{self, Read};
use std::mem;

use super::bytes::{Bytes, LONGEST_BRACKET};
use super::comment::Comment;

use super::plain;
use super::scanned::{MOST_TAGS, ScannedGame, hides_much};
use super::stream::StreamError;
use super::word::{Word, classify, decoded, is_harmless, parse_tag};
use super::{LONGEST_TOKEN, Problem, movetext};
use crate::text::shortened;

/// What is known of a game before its moves are read.
#[derive(Clone, Copy, Debug)]
pub struct Head<'a> {
    /// The game's number in its file, from 1.
    pub number: usize,
    /// The line where the game begins, from 1.
    pub line: usize,
    /// Name and value, in the order of the file.
    pub tags: &'a [(String, String)],
}

/// Picks every game.
pub type All = fn(&Head) -> bool;

/// See [`All`].
pub fn all(_: &Head) -> bool {
    true
}

/// Gives the games of a stream one after the other. Of those that `pick` does not want, only what
/// tells where the next one begins is looked at.
pub struct Scanner<R, P = All> {
    bytes: Bytes<R>,
    pick: P,
    /// How many games have begun.
    games: usize,
    /// The game that has begun when the one before was given out.
    begun: Option<ScannedGame>,
    /// Unreadable tags after moves: of the next game if a tag follows, else of this one.
    stray_tags: Vec<(usize, String)>,
    /// Whether there is nothing more to read; then why, unless that has been told.
    is_over: bool,
    error: Option<io::Error>,
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

impl<R: Read> Scanner<R> {
    /// Scans `reader` from its beginning, which is line 1.
    pub fn new(reader: R) -> Scanner<R> {
        Scanner::picking(reader, all)
    }
}

impl<R: Read, P: FnMut(&Head) -> bool> Scanner<R, P> {
    /// Like [`Scanner::new`], and asks of each game whether it is wanted.
    pub fn picking(reader: R, pick: P) -> Scanner<R, P> {
        Scanner {
            bytes: Bytes::new(reader),
            pick,
            games: 0,
            begun: None,
            stray_tags: Vec::new(),
            is_over: false,
            error: None,
        }
    }

    /// How many games there were until now.
    pub fn games(&self) -> usize {
        self.games
    }

    /// The end of a packed stream, as a problem of what comes last.
    pub fn problem(&self, error: StreamError) -> Problem {
        let how = if error.is_cut { "ends early" } else { "is damaged" };
        let what = format!("is how the file is packed, and its stream {how} behind this line");
        Problem::new(self.bytes.line, &error.format.to_string(), &what, true)
    }

    fn next_game(&mut self) -> io::Result<Option<ScannedGame>> {
        if self.is_over {
            return self.error.take().map_or(Ok(None), Err);
        }
        let mut game = self.begun.take();
        let read = self.read_game(&mut game);
        if read.is_err() {
            self.is_over = true;
        }
        if let (Some(game), None) = (&mut game, &self.begun) {
            game.take_stray(&mut self.stray_tags);
        }
        let Some(mut game) = game else {
            return read.map(|()| None);
        };
        self.ask(&mut game);
        if let Err(error) = read {
            match StreamError::of(&error) {
                // What is behind may be more of this game.
                Some(error) if !game.has_ended() && !game.is_skipped => {
                    let problem = self.problem(error);
                    game.main.problem(problem);
                    game.is_cut_off = true;
                }
                _ => self.error = Some(error),
            }
        }
        Ok(Some(game.closed()))
    }

    /// Reads up to where the next game has begun, or the text has ended.
    fn read_game(&mut self, game: &mut Option<ScannedGame>) -> io::Result<()> {
        let mut blank = false;
        while let Some(byte) = self.bytes.peek()? {
            let was_blank = mem::take(&mut blank);
            let next = match byte {
                b'\n' | b'\r' => {
                    self.bytes.bump()?;
                    if let (true, Some(game)) = (was_blank, &mut *game) {
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
                    self.bytes.until(b'\n', 0)?;
                    continue;
                }
                b'[' => self.bracket(game)?,
                b'{' => self.comment(game)?,
                b';' => {
                    self.comment_line(game)?;
                    continue;
                }
                b'(' | b')' => self.variation(game)?,
                b'<' => self.angle(game)?,
                _ => self.word(game)?,
            };
            if next == Next::NewGame {
                if game.is_some() {
                    return Ok(());
                }
                *game = self.begun.take();
            }
            if let Some(game) = game
                && game.number == 0
                && (game.has_moves() || game.has_ended())
            {
                self.ask(game);
            }
        }
        self.is_over = true;
        Ok(())
    }

    /// Numbers a game, as soon as it is known to be one, and asks whether it is wanted.
    fn ask(&mut self, game: &mut ScannedGame) {
        if game.number > 0 || game.is_no_game() {
            return;
        }
        self.games += 1;
        game.number = self.games;
        if !(self.pick)(&Head { number: game.number, line: game.line, tags: &game.tags }) {
            game.skip();
        }
    }

    /// Reads what a `[` opens.
    fn bracket(&mut self, game: &mut Option<ScannedGame>) -> io::Result<Next> {
        let line = self.bytes.line;
        let in_place = self.bytes.at_line_start
            || game.as_ref().is_none_or(|game| !game.has_moves() || game.has_ended());
        let kept = self.bytes.bracket()?;
        let mut raw = decoded(&kept.text);
        if kept.is_cut {
            raw.to_mut().push('…');
        }
        match parse_tag(&raw) {
            Some((name, value)) if in_place => return Ok(self.tag(game, line, name, value)),
            None if in_place && !is_harmless(&raw) => {
                // After moves it is not yet clear whether the next game begins here.
                let game = game.get_or_insert_with(|| ScannedGame::at(line));
                game.stop_variations(line, &raw, "is no move");
                // Those that change anything come first of all that are told.
                let most = if hides_much(&raw) { 2 * MOST_TAGS } else { MOST_TAGS };
                if self.stray_tags.len() < most {
                    self.stray_tags.push((line, raw.into_owned()));
                }
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
        let mut comment = Comment::new(game.as_ref().is_some_and(|game| !game.is_skipped));
        loop {
            let line = self.bytes.line;
            let unread = self.bytes.unread()?;
            let length = memchr::memchr3(b'}', b'\n', b'\r', unread).unwrap_or(unread.len());
            comment.add(&unread[..length]);
            let is_more = length == unread.len() && length > 0;
            self.bytes.pass(length);
            if is_more {
                continue;
            }
            match self.bytes.bump()? {
                Some(b'}') => {
                    if let Some(game) = game {
                        if comment.has_brace {
                            // Either this comment or the one within it was never closed.
                            game.stop(opened, "{", "opens a comment with another one in it");
                        }
                        game.comment(opened, &comment);
                    }
                    return Ok(Next::SameGame);
                }
                Some(_) => {
                    if let Some((name, value)) =
                        comment.end_line().filter(|(name, _)| FIRST_TAGS.contains(&name.as_str()))
                    {
                        self.begun = Some(self.first_tag(line, name, value));
                        break;
                    }
                }
                None => break,
            }
        }
        // Before a game, or behind a result, it hides nothing when a game begins within.
        let hides_moves =
            self.begun.is_none() || game.as_ref().is_some_and(|game| !game.has_ended());
        let what = "opens a comment that is never closed";
        let problem = Problem::new(opened, "{", what, hides_moves);
        match self.begun.as_mut().filter(|_| game.is_none()) {
            Some(begun) => begun.main.problem(problem),
            None => game.get_or_insert_with(|| ScannedGame::at(opened)).main.problem(problem),
        }
        Ok(if self.begun.is_some() { Next::NewGame } else { Next::SameGame })
    }

    /// Reads a comment from `;` to the end of the line.
    fn comment_line(&mut self, game: &mut Option<ScannedGame>) -> io::Result<()> {
        let line = self.bytes.line;
        self.bytes.pass(1);
        let mut comment = Comment::new(game.as_ref().is_some_and(|game| !game.is_skipped));
        loop {
            let unread = self.bytes.unread()?;
            let found = memchr::memchr2(b'\n', b'\r', unread);
            let length = found.unwrap_or(unread.len());
            comment.add(&unread[..length]);
            let has_ended = found.is_some() || unread.is_empty();
            self.bytes.pass(length);
            if has_ended {
                break;
            }
        }
        if let Some(game) = game {
            game.comment(line, &comment);
        }
        Ok(())
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
        let mut raw = self.bytes.until(b'>', LONGEST_BRACKET)?.text;
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
        let word = self.bytes.word()?;
        if let Some(game) = game {
            // Where the game ends is said by none of the words in brackets.
            if game.is_skipped && game.is_in_variation() {
                return Ok(Next::SameGame);
            }
            if !word.is_cut
                && let Some(plain) = plain::read(word.text)
                && !game.may_end_at(plain, at_line_start)
            {
                game.take_plain(line, word.text, plain, &mut self.stray_tags);
                return Ok(Next::SameGame);
            }
        }
        let is_cut = word.is_cut;
        let mut raw = decoded(word.text).into_owned();
        if is_cut {
            raw = shortened(&raw, LONGEST_TOKEN);
        }
        let text = raw.trim_start_matches('\u{feff}');
        if text.is_empty() {
            // It is no part of the text.
            self.bytes.at_line_start = at_line_start;
            return Ok(Next::SameGame);
        }
        let words = || {
            let words = text.split_whitespace().flat_map(classify);
            is_cut.then_some(Word::Unknown).into_iter().chain(words.filter(move |_| !is_cut))
        };
        if let Some(game) = game.as_mut().filter(|game| game.is_in_variation()) {
            game.in_variation(line, |variation| variation.take(line, text, words()));
            return Ok(Next::SameGame);
        }
        // Blanks that are not ASCII (a no-break space) may stand within.
        let words: Vec<Word> = words().collect();
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
            game.has_ended() && goes_on() || again && game.main.count > 1
        };
        if game.as_ref().is_some_and(begins) {
            let mut next = ScannedGame::at(line);
            next.take_stray(&mut self.stray_tags);
            if !at_line_start && !matches!(words.first(), Some(Word::Number { .. })) {
                // In the middle of a line they may go on with the game that seemed to end.
                let what = "goes on behind a result";
                next.main.problem(Problem::new(line, text, what, true));
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

impl<R: Read, P: FnMut(&Head) -> bool> Iterator for Scanner<R, P> {
    type Item = io::Result<ScannedGame>;

    fn next(&mut self) -> Option<io::Result<ScannedGame>> {
        self.next_game().transpose()
    }
}
