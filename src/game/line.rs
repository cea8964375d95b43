//! A line of play as it stands in the text: the main line of a game, or a variation.

use std::borrow::Cow;
use std::mem;

use shakmaty::san::SanPlus;

use super::comment::Comment;
use super::letters::Language;
use super::movetext::Written;
use super::notes::Notes;
use super::plain::{self, Plain};
use super::word::Word;
use super::{LONGEST_TOKEN, Problem, command, movetext};
use crate::text::shortened;

/// The moves of a line and what is written between them.
#[derive(Debug, Default)]
pub struct Line {
    /// What may be moves, without move numbers and glyphs; the moves of variations are not among
    /// them.
    pub tokens: Vec<Token>,
    /// How many tokens there were, those that were not kept too.
    pub count: usize,
    /// Whether one of the tokens shows that this is a game: it is a move, or has a number.
    pub is_played: bool,
    /// Whether no more is kept of the line than what tells where its game ends.
    pub is_skipped: bool,
    /// The words on one line, without comments and variations: what pgn-reader is given. Empty as
    /// long as all words are plain: those need no second opinion.
    pub movetext: Vec<u8>,
    /// What is said before the first token.
    pub notes: Option<Box<Notes>>,
    /// What might have been played instead, in the order of the text.
    pub variations: Vec<ScannedVariation>,
    pub result: Option<&'static str>,
    pub problems: Vec<Problem>,
    /// What stands before the next token.
    before: Before,
}

/// A variation as it stands in the text.
#[derive(Debug)]
pub struct ScannedVariation {
    /// The line of the text where its bracket opens, from 1.
    pub opened: usize,
    /// The token of the line around it whose place it takes, from 0.
    pub replaces: usize,
    pub line: Line,
}

/// A word of the movetext that may be a move, or that hides one.
#[derive(Debug, Default)]
pub struct Token {
    pub line: usize,
    pub spelled: Spelled,
    /// The move number directly before it.
    pub number: Option<u32>,
    /// Whether dots before it say that it is Black's.
    pub is_blacks: bool,
    /// A lone letter before it: a remark, or its piece.
    pub letter: Option<char>,
    /// Why the line cannot go on here, as a clause after the text.
    pub fault: Option<&'static str>,
    /// What is said behind it. Most moves have none, so it is apart.
    pub notes: Option<Box<Notes>>,
}

/// How a token is written.
#[derive(Debug)]
pub enum Spelled {
    /// As the standard has it.
    Plain(SanPlus),
    Other(Box<str>),
}

impl Default for Spelled {
    fn default() -> Spelled {
        Spelled::Other(Box::default())
    }
}

#[derive(Debug, Default)]
struct Before {
    number: Option<u32>,
    dots: bool,
    letter: Option<char>,
}

/// How many problems a line has before remarks add no more to them.
const MOST_PROBLEMS: usize = 1000;

/// How many half-moves of a line are read. By the rule of 75 moves no game has more than about
/// 11 800.
pub const MOST_PLIES: usize = 20_000;

impl Token {
    /// The token as it stands in the text.
    pub fn text(&self) -> Cow<'_, str> {
        match &self.spelled {
            Spelled::Plain(san) => Cow::Owned(san.to_string()),
            Spelled::Other(text) => Cow::Borrowed(text),
        }
    }

    /// What it may mean, its pieces' letters read as in `letters`.
    pub fn written(&self, letters: Language) -> Written {
        match &self.spelled {
            Spelled::Plain(san) if letters.is_english() => {
                Written { san: Some(san.san), ..Written::default() }
            }
            _ => movetext::tolerant(&self.text(), letters),
        }
    }
}

impl Line {
    /// Whether a number stands there, and not yet its move.
    pub fn awaits_a_move(&self) -> bool {
        self.before.number.is_some()
    }

    /// Notes something that hides no move.
    pub fn remark(&mut self, line: usize, token: &str, what: &str) {
        if self.is_skipped || self.problems.len() >= MOST_PROBLEMS {
            return;
        }
        self.add_remark(Problem::new(line, token, what, false));
    }

    fn add_remark(&mut self, problem: Problem) {
        let is_same = |known: &Problem| known.token == problem.token && known.what == problem.what;
        if self.problems.len() < MOST_PROBLEMS && !self.problems.iter().any(is_same) {
            self.problems.push(problem);
        }
    }

    /// Adds a problem. There is always room for one that loses moves.
    pub fn problem(&mut self, problem: Problem) {
        let most = if problem.loses_moves { 2 * MOST_PROBLEMS } else { MOST_PROBLEMS };
        if !self.is_skipped && self.problems.len() < most {
            self.problems.push(problem);
        }
    }

    /// Adds a token at which the line cannot go on; behind the result there is nothing to lose.
    pub fn stop(&mut self, line: usize, text: &str, fault: &'static str) {
        if self.result.is_some() {
            self.remark(line, text, fault);
        } else if self.counts_one_more() {
            let spelled = Spelled::Other(shortened(text, LONGEST_TOKEN).into());
            self.tokens.push(Token { line, spelled, fault: Some(fault), ..Token::default() });
        }
    }

    /// Keeps no more of the line than what tells where its game ends.
    pub fn skip(&mut self) {
        self.is_skipped = true;
        (self.tokens, self.movetext, self.variations) = Default::default();
        (self.notes, self.problems) = Default::default();
    }

    /// Counts a token; whether it is to be kept.
    fn counts_one_more(&mut self) -> bool {
        self.count += 1;
        !self.is_skipped && self.tokens.len() <= MOST_PLIES
    }

    /// Takes a plain word of the text; `text` is how it is written.
    #[inline]
    pub fn take_plain(&mut self, line: usize, text: &[u8], plain: Plain) {
        if !self.movetext.is_empty() && !self.is_skipped {
            self.add_movetext(text);
        }
        match plain {
            Plain::Number { number, dots } => self.number(line, text, number, dots),
            Plain::Move(san) => self.plain_token(line, san),
            Plain::NumberedMove { number, dots, played } => {
                self.number(line, text, number, dots);
                self.plain_token(line, played);
            }
            Plain::Result(result) => self.result(line, result, result),
        }
    }

    fn plain_token(&mut self, line: usize, san: SanPlus) {
        if self.result.is_some() {
            self.remark(line, &san.to_string(), "is no move");
        } else {
            self.is_played = true;
            self.token(line, Spelled::Plain(san));
        }
    }

    fn number(&mut self, line: usize, text: &[u8], number: u32, dots: usize) {
        let twice = self.before.number.is_some();
        self.before = Before { number: Some(number), dots: dots > 1, letter: None };
        if twice {
            let what = "is a second number without a move between";
            self.stop(line, &String::from_utf8_lossy(text), what);
        }
    }

    fn result(&mut self, line: usize, text: &str, result: &'static str) {
        match self.result {
            Some(known) if known != result => {
                self.remark(line, text, "is a second result; the first one counts");
            }
            _ => self.result = Some(result),
        }
    }

    /// Adds a word to what pgn-reader is given, from the first that is not plain on. Brackets are
    /// left out, since they would hide from it what follows.
    fn add_movetext(&mut self, text: &[u8]) {
        if self.movetext.is_empty() {
            for token in &self.tokens {
                self.movetext.extend(token.text().bytes());
                self.movetext.push(b' ');
            }
            self.movetext.extend(self.result.unwrap_or_default().bytes());
            self.movetext.push(b' ');
        }
        if self.tokens.len() <= MOST_PLIES {
            self.movetext.extend(text.iter().filter(|byte| !b"[()".contains(byte)));
            self.movetext.push(b' ');
        }
    }

    /// Takes a word of the text, which was found to be `words`.
    pub fn take(&mut self, line: usize, text: &str, words: impl IntoIterator<Item = Word>) {
        if let Some(plain) = plain::read(text.as_bytes()) {
            return self.take_plain(line, text.as_bytes(), plain);
        }
        if !self.is_skipped {
            self.add_movetext(text.as_bytes());
        }
        for word in words {
            match word {
                Word::Number { number, dots } => self.number(line, text.as_bytes(), number, dots),
                Word::Dots(dots) => self.before.dots |= dots > 1,
                Word::Result(result) => self.result(line, text, result),
                Word::Move(text) if self.result.is_some() => {
                    self.remark(line, &text, "is no move");
                }
                Word::Move(text) => {
                    self.is_played = self.is_played || movetext::is_move(&text);
                    self.token(line, Spelled::Other(text.into()));
                }
                Word::Annotation(glyphs) => self.glyphs(line, text, &glyphs),
                Word::Letter(letter @ ('N' | 'D')) if self.before.number.is_none() => {
                    self.remark(line, text, "is no move");
                    self.before.letter = Some(letter);
                }
                Word::Letter(_) | Word::Unknown => self.stop(line, text, "is no move"),
            }
        }
    }

    fn token(&mut self, line: usize, spelled: Spelled) {
        let before = mem::take(&mut self.before);
        self.is_played |= before.number.is_some();
        if !self.counts_one_more() {
            return;
        }
        let fault = (self.tokens.len() == MOST_PLIES)
            .then_some("is behind the 20000 half-moves that are read of a game");
        self.tokens.push(Token {
            line,
            spelled,
            number: before.number,
            is_blacks: before.dots,
            letter: before.letter,
            fault,
            ..Token::default()
        });
    }

    fn glyphs(&mut self, line: usize, text: &str, glyphs: &[u8]) {
        if self.is_skipped {
            return;
        }
        if glyphs.is_empty() && text.starts_with('$') && !text.trim_matches(['$', '0']).is_empty() {
            self.remark(line, text, "is no glyph, expected $1 to $255");
        }
        for nag in glyphs {
            self.notes().add_glyph(*nag);
        }
    }

    /// Takes what a comment says to programs; it begins in line `line`.
    pub fn comment(&mut self, line: usize, comment: &Comment) {
        if self.is_skipped {
            return;
        }
        command::read(line, comment.text(), |note| match note {
            Ok(note) => self.notes().add(note),
            Err(problem) => self.add_remark(problem),
        });
        if comment.loses_commands {
            let what = "opens a comment longer than the 64 KiB that are read; what it says to \
                        programs behind them is lost";
            self.remark(line, "{", what);
        }
    }

    /// Where notes go that are found now.
    fn notes(&mut self) -> &mut Notes {
        let notes = match self.tokens.last_mut() {
            Some(token) => &mut token.notes,
            None => &mut self.notes,
        };
        notes.get_or_insert_default()
    }

    /// A variation of the last token, whose bracket opens in line `opened`.
    pub fn variation(&self, opened: usize) -> ScannedVariation {
        let replaces = self.tokens.len().saturating_sub(1);
        let mut line = Line { is_skipped: self.is_skipped, ..Line::default() };
        if self.awaits_a_move() {
            line.stop(opened, "(", "opens a variation between a number and its move");
        }
        ScannedVariation { opened, replaces, line }
    }

    /// Takes a variation that has been closed, unless there is nothing in it.
    pub fn add(&mut self, variation: ScannedVariation) {
        let Line { tokens, problems, variations, .. } = &variation.line;
        if !(tokens.is_empty() && problems.is_empty() && variations.is_empty()) {
            self.variations.push(variation);
        }
    }
}
