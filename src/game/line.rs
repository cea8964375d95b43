//! A line of play as it stands in the text: the main line of a game, or a variation.

use std::mem;

use super::notes::Notes;
use super::word::{Word, shortened};
use super::{LONGEST_TOKEN, Problem, command, movetext};

/// The moves of a line and what is written between them.
#[derive(Debug, Default)]
pub struct Line {
    /// What may be moves, without move numbers and glyphs; the moves of variations are not among
    /// them.
    pub tokens: Vec<Token>,
    /// The words on one line, without comments and variations: what pgn-reader is given.
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
    pub text: String,
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

#[derive(Debug, Default)]
struct Before {
    number: Option<u32>,
    dots: bool,
    letter: Option<char>,
}

/// How many problems a line has before remarks add no more to them.
const MOST_PROBLEMS: usize = 1000;

impl Token {
    /// Whether it is written as a move.
    pub fn is_move(&self) -> bool {
        self.fault.is_none() && movetext::is_move(&self.text)
    }
}

impl Line {
    /// Whether a number stands there, and not yet its move.
    pub fn awaits_a_move(&self) -> bool {
        self.before.number.is_some()
    }

    /// Notes something that hides no move.
    pub fn remark(&mut self, line: usize, token: &str, what: &str) {
        self.add_remark(Problem::new(line, token, what, false));
    }

    fn add_remark(&mut self, problem: Problem) {
        let is_same = |known: &Problem| known.token == problem.token && known.what == problem.what;
        if self.problems.len() < MOST_PROBLEMS && !self.problems.iter().any(is_same) {
            self.problems.push(problem);
        }
    }

    /// Adds a token at which the line cannot go on; behind the result there is nothing to lose.
    pub fn stop(&mut self, line: usize, text: &str, fault: &'static str) {
        if self.result.is_some() {
            self.remark(line, text, fault);
        } else {
            let text = shortened(text, LONGEST_TOKEN);
            self.tokens.push(Token { line, text, fault: Some(fault), ..Token::default() });
        }
    }

    /// Takes a word of the text, which was found to be `words`.
    pub fn take(&mut self, line: usize, text: &str, words: impl IntoIterator<Item = Word>) {
        self.movetext.extend(text.bytes().filter(|byte| *byte != b'['));
        self.movetext.push(b' ');
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
                Word::Move(text) if self.result.is_some() => {
                    self.remark(line, &text, "is no move");
                }
                Word::Move(text) => self.token(line, text),
                Word::Annotation(glyphs) => self.glyphs(line, text, &glyphs),
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
            ..Token::default()
        });
    }

    fn glyphs(&mut self, line: usize, text: &str, glyphs: &[u8]) {
        if glyphs.is_empty() && text.starts_with('$') && !text.trim_matches(['$', '0']).is_empty() {
            self.remark(line, text, "is no glyph, expected $1 to $255");
        }
        for nag in glyphs {
            self.notes().add_glyph(*nag);
        }
    }

    /// Takes what a comment says to programs; it begins in line `line`.
    pub fn comment(&mut self, line: usize, text: &[u8]) {
        command::read(line, text, |note| match note {
            Ok(note) => self.notes().add(note),
            Err(problem) => self.add_remark(problem),
        });
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
        let mut line = Line::default();
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
