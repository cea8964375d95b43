//! Files of games that are read more than once.

use std::fs::File;
use std::io::{self, Read, Seek, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

use crate::game::{Source, SourceError};
use crate::text::shown;

/// A file of games, or what comes from the standard input.
pub struct Input {
    /// As messages show it.
    pub name: String,
    path: PathBuf,
    /// The standard input comes once: what has come is kept here, in a file without a name.
    kept: Option<File>,
    is_known: AtomicBool,
}

impl Input {
    /// Reads nothing yet; `-` is the standard input.
    ///
    /// # Errors
    /// When there is no room among temporary files to keep the standard input.
    pub fn new(path: &Path) -> Result<Input, SourceError> {
        let name = shown(path);
        let kept = match path == Path::new("-") {
            true => Some(tempfile::tempfile().map_err(|error| failed(&name, error))?),
            false => None,
        };
        Ok(Input { name, path: path.to_owned(), kept, is_known: AtomicBool::new(false) })
    }

    /// Opens it at its beginning. Of the standard input nothing is read that the first one who opens it does not want; those
    /// who come after get that.
    ///
    /// # Errors
    /// As [`Source::open`].
    pub fn open(&self) -> Result<Source, SourceError> {
        let Some(kept) = &self.kept else { return Source::open(&self.path) };
        let mut kept = kept.try_clone().map_err(|error| failed(&self.name, error))?;
        kept.rewind().map_err(|error| failed(&self.name, error))?;
        let reader: Box<dyn Read + Send> = match self.is_known.swap(true, Ordering::Relaxed) {
            true => Box::new(kept),
            false => Box::new(Kept { from: io::stdin(), to: kept }),
        };
        Source::of(self.name.clone(), reader)
    }
}

/// Hands all bytes of a file on, and gives their number.
///
/// # Errors
/// When it cannot be read.
pub fn read_through(path: &Path, mut take: impl FnMut(&[u8])) -> io::Result<u64> {
    let mut file = File::open(path)?;
    let (mut buffer, mut all) = (vec![0; 1 << 16], 0);
    loop {
        match file.read(&mut buffer) {
            Ok(0) => return Ok(all),
            Ok(read) => {
                take(&buffer[..read]);
                all += read as u64;
            }
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
}

fn failed(name: &str, error: io::Error) -> SourceError {
    SourceError::Io { name: name.to_owned(), error }
}

/// What is read is kept.
struct Kept<R> {
    from: R,
    to: File,
}

impl<R: Read> Read for Kept<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let read = self.from.read(buffer)?;
        self.to.write_all(&buffer[..read])?;
        Ok(read)
    }
}
