//! Files of games that are read more than once.

use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};

use tempfile::TempPath;

use crate::game::{Source, SourceError};
use crate::text::shown;

/// A file of games, or what came from the standard input.
pub struct Input {
    /// As messages show it.
    pub name: String,
    path: PathBuf,
    /// The standard input comes once; what came is kept here.
    kept: Option<TempPath>,
}

impl Input {
    /// Reads the standard input to its end for `-`; of a file nothing yet.
    ///
    /// # Errors
    /// When the standard input cannot be read, or there is no room for it among temporary files.
    pub fn new(path: &Path) -> Result<Input, SourceError> {
        let name = shown(path);
        let kept = match path == Path::new("-") {
            true => Some(kept().map_err(|error| SourceError::Io { name: name.clone(), error })?),
            false => None,
        };
        Ok(Input { name, path: path.to_owned(), kept })
    }

    /// Opens it, at its beginning.
    ///
    /// # Errors
    /// As [`Source::open`].
    pub fn open(&self) -> Result<Source, SourceError> {
        let path = self.kept.as_deref().unwrap_or(&self.path);
        Source::open_as(path, self.name.clone())
    }
}

fn kept() -> io::Result<TempPath> {
    let (mut file, path): (File, TempPath) = tempfile::NamedTempFile::new()?.into_parts();
    io::copy(&mut io::stdin().lock(), &mut file)?;
    Ok(path)
}
