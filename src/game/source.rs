//! Where games come from: files, and the standard input.

use std::fs::File;
use std::io::{self, BufRead, BufReader};
use std::path::Path;

use super::{Game, Scanner};

/// A file of games that is open, or the standard input.
pub struct Source {
    name: String,
    reader: Box<dyn BufRead>,
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
    NoGames { name: String, problem: Option<super::Problem> },
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
        let name = path.display().to_string();
        let failed = |error: io::Error| match error.kind() {
            io::ErrorKind::NotFound => SourceError::Missing { name: name.clone() },
            io::ErrorKind::IsADirectory => SourceError::Folder { name: name.clone() },
            _ => SourceError::Io { name: name.clone(), error },
        };
        let mut reader: Box<dyn BufRead> = if path == Path::new("-") {
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

    /// Reads the games one after the other, numbered from 1. Text before a game that is none is
    /// reported with the game that follows.
    pub fn games(self) -> impl Iterator<Item = Result<Game, SourceError>> {
        let name = self.name;
        let mut scanner = Scanner::new(self.reader);
        let mut number = 0;
        let mut strays = Vec::new();
        let mut ended = false;
        std::iter::from_fn(move || {
            while !ended {
                match scanner.next() {
                    Some(Ok(scanned)) => {
                        let mut game = Game::read(scanned);
                        if game.tags.is_empty() && game.plies.is_empty() && number == 0 {
                            strays.append(&mut game.problems);
                            continue;
                        }
                        number += 1;
                        game.number = number;
                        game.problems.splice(
                            0..0,
                            strays.drain(..).map(|mut stray: super::Problem| {
                                stray.loses_moves = false;
                                stray
                            }),
                        );
                        return Some(Ok(game));
                    }
                    Some(Err(error)) => {
                        ended = true;
                        return Some(Err(SourceError::Io { name: name.clone(), error }));
                    }
                    None => ended = true,
                }
            }
            if number == 0 {
                number = usize::MAX;
                let problem = strays.drain(..).next();
                return Some(Err(SourceError::NoGames { name: name.clone(), problem }));
            }
            None
        })
    }
}

const BUFFER: usize = 64 * 1024;
