//! Where games come from: files, and the standard input.

use std::fs::File;
use std::io::{self, BufRead, BufReader};
use std::path::Path;

use super::{Game, Problem, Scanner, Wanted, printable};

/// A file of games that is open, or the standard input.
pub struct Source {
    name: String,
    reader: Box<dyn BufRead + Send>,
}

/// Why a file gives no games. Each message begins with the file's name.
#[derive(Debug, thiserror::Error)]
pub enum SourceError {
    #[error("{name}: no such file")]
    Missing { name: String },
    #[error("{name}: is a folder, expected a PGN file")]
    Folder { name: String },
    #[error("{name}: is empty, expected games in PGN")]
    Empty { name: String },
    #[error("{name}: is UTF-16 text, expected UTF-8 or Latin-1")]
    Utf16 { name: String },
    #[error("{name}: is no text (byte {offset} is 0), expected games in PGN")]
    Binary { name: String, offset: usize },
    #[error("{name}: no game in it, {}", match problem {
        Some(problem) => format!("{problem}"),
        None => "expected tags or moves in PGN".to_owned(),
    })]
    NoGames { name: String, problem: Option<Problem> },
    #[error("{name}: cannot be read")]
    Io {
        name: String,
        #[source]
        error: io::Error,
    },
}

impl Source {
    /// Opens a file, or the standard input for `-`, and looks at its first bytes.
    ///
    /// # Errors
    /// When there is no such file, or it is a folder, empty, or no text that can be read.
    pub fn open(path: &Path) -> Result<Source, SourceError> {
        Source::open_as(path, printable(&path.to_string_lossy()))
    }

    /// The same, under a `name` of its own in messages.
    ///
    /// # Errors
    /// As [`Source::open`].
    pub fn open_as(path: &Path, name: String) -> Result<Source, SourceError> {
        let failed = |error: io::Error| match error.kind() {
            io::ErrorKind::NotFound => SourceError::Missing { name: name.clone() },
            io::ErrorKind::IsADirectory => SourceError::Folder { name: name.clone() },
            _ => SourceError::Io { name: name.clone(), error },
        };
        let mut reader: Box<dyn BufRead + Send> = if path == Path::new("-") {
            Box::new(BufReader::with_capacity(BUFFER, io::stdin()))
        } else {
            if path.is_dir() {
                return Err(SourceError::Folder { name });
            }
            Box::new(BufReader::with_capacity(BUFFER, File::open(path).map_err(&failed)?))
        };
        let beginning = reader.fill_buf().map_err(&failed)?;
        match beginning {
            [] => Err(SourceError::Empty { name }),
            [0xFF, 0xFE, ..] | [0xFE, 0xFF, ..] => Err(SourceError::Utf16 { name }),
            _ => match beginning.iter().position(|byte| *byte == 0) {
                Some(offset) => Err(SourceError::Binary { name, offset }),
                None => Ok(Source { name, reader }),
            },
        }
    }

    /// Reads the games one after the other, numbered from 1. Text that is no game is reported with
    /// the game that follows; behind the last game, as a game of which nothing can be shown.
    pub fn games(self) -> Games {
        Games {
            name: self.name,
            scanner: Scanner::new(self.reader),
            number: 0,
            strays: Vec::new(),
            has_ended: false,
        }
    }
}

/// The games of a [`Source`], read one by one.
pub struct Games {
    name: String,
    scanner: Scanner<Box<dyn BufRead + Send>>,
    number: usize,
    strays: Vec<Problem>,
    has_ended: bool,
}

impl Games {
    /// How many games have come by, those that were not wanted too.
    pub fn seen(&self) -> usize {
        self.number
    }

    /// The next game that is wanted. What its tags rule out is not replayed, and of a game that is not wanted
    /// nothing is reported.
    pub fn next_wanted(&mut self, wanted: &Wanted) -> Option<Result<Game, SourceError>> {
        let name = || self.name.clone();
        while !self.has_ended {
            let scanned = match self.scanner.next() {
                Some(Ok(scanned)) => scanned,
                Some(Err(error)) => {
                    self.has_ended = true;
                    return Some(Err(SourceError::Io { name: name(), error }));
                }
                None => {
                    self.has_ended = true;
                    break;
                }
            };
            if scanned.is_no_game() {
                let what = "begins a text that is no game";
                let first = scanned.main.tokens.first();
                self.strays.extend(first.map(|t| Problem::new(t.line, &t.text, what, false)));
                self.strays.extend(scanned.main.problems);
                continue;
            }
            self.number += 1;
            let strays = std::mem::take(&mut self.strays);
            if !wanted.takes_head(self.number, &scanned.tags) {
                continue;
            }
            let mut game = Game::read(scanned, self.number);
            if wanted.takes_game(&game) {
                game.problems.splice(0..0, strays);
                return Some(Ok(game));
            }
        }
        let strays = std::mem::take(&mut self.strays);
        match strays.first() {
            _ if self.number == 0 => {
                self.number = 1;
                let problem = strays.into_iter().next();
                Some(Err(SourceError::NoGames { name: name(), problem }))
            }
            None => None,
            Some(first) => {
                self.number += 1;
                let game = Game::nothing(self.number, first.line, strays);
                let is_wanted =
                    wanted.takes_head(game.number, &game.tags) && wanted.takes_game(&game);
                is_wanted.then_some(Ok(game))
            }
        }
    }
}

impl Iterator for Games {
    type Item = Result<Game, SourceError>;

    fn next(&mut self) -> Option<Result<Game, SourceError>> {
        self.next_wanted(&Wanted::default())
    }
}

const BUFFER: usize = 64 * 1024;
