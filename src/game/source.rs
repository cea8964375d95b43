//! Where games come from: files, packed ones too, and the standard input.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use super::scan::{All, Head};
use super::stream::{Format, Stream, StreamError};
use super::{Game, Letters, Problem, Scanner};
use crate::text::shown;

/// A file of games that is open, or the standard input.
pub struct Source {
    name: String,
    reader: Box<dyn Read + Send>,
    letters: Letters,
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
    #[error(
        "{name}: is packed as {format}, expected games in PGN, plain or as zstd, gzip or bzip2"
    )]
    Packed { name: String, format: Format },
    #[error("{name}: is {inner} packed as {outer} again, expected games in PGN within")]
    PackedTwice { name: String, outer: Format, inner: Format },
    #[error("{name}: {error}, and no game can be read before")]
    Stream { name: String, error: StreamError },
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
    /// Opens a file, or the standard input for `-`, and looks at its first bytes. Zstd, gzip and
    /// bzip2 are unpacked on the way.
    ///
    /// # Errors
    /// When there is no such file, or it is a folder, empty, or no text that can be read.
    pub fn open(path: &Path) -> Result<Source, SourceError> {
        let name = shown(path);
        let failed = |error: io::Error| match error.kind() {
            io::ErrorKind::NotFound => SourceError::Missing { name: name.clone() },
            io::ErrorKind::IsADirectory => SourceError::Folder { name: name.clone() },
            _ => SourceError::of(name.clone(), error),
        };
        let reader: Box<dyn Read + Send> = if path == Path::new("-") {
            Box::new(io::stdin())
        } else {
            if path.is_dir() {
                return Err(SourceError::Folder { name });
            }
            Box::new(File::open(path).map_err(&failed)?)
        };
        Source::of(name, reader)
    }

    /// Reads from anywhere else, under a `name` in messages.
    ///
    /// # Errors
    /// As [`Source::open`].
    pub fn of(name: String, reader: Box<dyn Read + Send>) -> Result<Source, SourceError> {
        let failed = |error| SourceError::of(name.clone(), error);
        let Stream { reader, beginning, format } = Stream::new(reader).map_err(failed)?;
        let is_unpacked = matches!(format, Some(Format::Zstd | Format::Gzip | Format::Bzip2));
        match (format, Format::of(&beginning)) {
            (Some(outer), Some(inner)) if is_unpacked => {
                return Err(SourceError::PackedTwice { name, outer, inner });
            }
            (Some(format), _) if !is_unpacked => return Err(SourceError::Packed { name, format }),
            _ => {}
        }
        match &beginning[..] {
            [] => Err(SourceError::Empty { name }),
            [0xFF, 0xFE, ..] | [0xFE, 0xFF, ..] => Err(SourceError::Utf16 { name }),
            _ => match beginning.iter().position(|byte| *byte == 0) {
                Some(offset) => Err(SourceError::Binary { name, offset }),
                None => Ok(Source { name, reader, letters: Letters::default() }),
            },
        }
    }

    /// Reads the pieces' letters in another way than by their looks.
    pub fn with_letters(self, letters: Letters) -> Source {
        Source { letters, ..self }
    }

    /// Reads the games one after the other, numbered from 1. Text that is no game is reported with
    /// the game that follows; behind the last game, as a game of which nothing can be shown. So is
    /// the early end of a packed stream, unless a game is in hand there: then that one is not
    /// whole.
    pub fn games(self) -> Games {
        self.games_where(super::scan::all)
    }

    /// The games that `pick` wants, by the same numbers. Each game is asked for before its moves
    /// are read; those that are not picked are passed over.
    pub fn games_where<P: FnMut(&Head) -> bool>(self, pick: P) -> Games<P> {
        Games {
            name: self.name,
            scanner: Scanner::picking(self.reader, pick),
            letters: self.letters,
            strays: Vec::new(),
            has_ended: false,
            is_cut: false,
        }
    }
}

impl SourceError {
    fn of(name: String, error: io::Error) -> SourceError {
        match StreamError::of(&error) {
            Some(error) => SourceError::Stream { name, error },
            None => SourceError::Io { name, error },
        }
    }
}

/// The games of a [`Source`], read one by one.
pub struct Games<P = All> {
    name: String,
    scanner: Scanner<Box<dyn Read + Send>, P>,
    letters: Letters,
    strays: Vec<Problem>,
    has_ended: bool,
    /// Whether the stream ended early, in the game that was given last or behind it.
    is_cut: bool,
}

impl<P: FnMut(&Head) -> bool> Games<P> {
    /// How many games have been seen, those that were not picked too.
    pub fn seen(&self) -> usize {
        self.scanner.games()
    }

    /// Whether the last game that was given tells that the stream ended early there.
    pub fn is_cut(&self) -> bool {
        self.is_cut
    }
}

impl<P: FnMut(&Head) -> bool> Iterator for Games<P> {
    type Item = Result<Game, SourceError>;

    fn next(&mut self) -> Option<Result<Game, SourceError>> {
        while !self.has_ended {
            let scanned = match self.scanner.next() {
                Some(Ok(scanned)) => scanned,
                Some(Err(error)) => {
                    self.has_ended = true;
                    match StreamError::of(&error) {
                        Some(error) if self.seen() > 0 => {
                            self.strays.push(self.scanner.problem(error));
                            self.is_cut = true;
                            break;
                        }
                        _ => return Some(Err(SourceError::of(self.name.clone(), error))),
                    }
                }
                None => {
                    self.has_ended = true;
                    if self.seen() == 0 {
                        let problem = self.strays.drain(..).next();
                        return Some(Err(SourceError::NoGames {
                            name: self.name.clone(),
                            problem,
                        }));
                    }
                    break;
                }
            };
            if scanned.is_skipped {
                self.strays.clear();
                continue;
            }
            if scanned.is_no_game() {
                let what = "begins a text that is no game";
                let first = scanned.main.tokens.first();
                self.strays.extend(first.map(|t| Problem::new(t.line, &t.text(), what, false)));
                self.strays.extend(scanned.main.problems);
                continue;
            }
            self.is_cut = scanned.is_cut_off;
            let number = scanned.number;
            let mut game = Game::read_in(scanned, number, self.letters);
            game.problems.splice(0..0, self.strays.drain(..));
            return Some(Ok(game));
        }
        let strays = std::mem::take(&mut self.strays);
        let line = strays.first()?.line;
        Some(Ok(Game::nothing(self.seen() + 1, line, strays)))
    }
}
