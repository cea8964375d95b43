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
use super::input::StreamError;
use super::line::{Line, ScannedVariation};
use super::plain::{self, Plain};
use super::word::{Word, classify, decoded, is_harmless, parse_tag, shortened};
use super::{LONGEST_TOKEN, Problem, movetext};

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
    gap: bool,
}

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

/// How deep variations may lie within each other; what lies deeper is left out.
const DEEPEST: usize = 32;

/// How much of all variations of a game is kept: as many moves as some dozens of games have.
const MOST_ASIDE: usize = 50_000;

/// How many tags of a game are read. Files have some twenty.
const MOST_TAGS: usize = 1000;

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

impl ScannedGame {
    fn at(line: usize) -> ScannedGame {
        ScannedGame { line, ..ScannedGame::default() }
    }

    /// Whether nothing in the text says that it is a game: no tag, number, result or move.
    pub fn is_no_game(&self) -> bool {
        self.tags.is_empty()
            && self.unread_tags.is_empty()
            && !self.has_ended()
            && !self.main.is_played
    }

    /// Keeps no more than what tells where the game ends.
    fn skip(&mut self) {
        self.is_skipped = true;
        self.main.skip();
        for variation in &mut self.open {
            variation.line.skip();
        }
    }

    /// Whether a plain word may begin the next game, so that more must be looked at.
    #[inline]
    fn may_end_at(&self, word: Plain, at_line_start: bool) -> bool {
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
    fn take_plain(
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
    fn in_variation(&mut self, line: usize, go_on: impl FnOnce(&mut Line)) {
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

    fn has_moves(&self) -> bool {
        self.main.count > 0 || self.is_in_variation()
    }

    fn is_in_variation(&self) -> bool {
        !self.open.is_empty() || self.deeper > 0
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

    fn comment(&mut self, line: usize, comment: &Comment) {
        self.gap = true;
        if self.is_in_variation() {
            self.in_variation(line, |variation| variation.comment(line, comment));
        } else {
            self.main.comment(line, comment);
        }
    }

    fn open_variation(&mut self, line: usize) {
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
    fn take_stray(&mut self, tags: &mut Vec<(usize, String)>) {
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
                self.unread_tags.push(raw);
            }
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
fn hides_much(raw: &str) -> bool {
    may_hold_moves(raw) || may_say_start(raw)
}

/// Whether a tag of that name, or a text that may hold one, says where a game starts.
fn says_start(text: &str) -> bool {
    let text = text.to_ascii_lowercase();
    ["fen", "setup", "variant"].iter().any(|name| text.contains(name))
}
