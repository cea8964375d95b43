//! Records in JSON. They hold no clock times: the same run writes the same bytes.

use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use serde::Serialize;
use tempfile::NamedTempFile;

use super::{OutputError, temporary, write_inside};

/// Writes one value, indented for reading.
///
/// # Errors
/// When the file cannot be written.
pub fn write_json(path: &Path, value: &impl Serialize) -> Result<(), OutputError> {
    write_inside(path, |mut out| {
        serde_json::to_writer_pretty(&mut out, value)?;
        writeln!(out)
    })
}

/// A file of one value a line under way. It is there once it is finished.
pub struct JsonLines {
    path: PathBuf,
    out: BufWriter<NamedTempFile>,
}

impl JsonLines {
    /// Begins the file `path`. One of that name stays until this one is in its place.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn begin(path: &Path) -> Result<JsonLines, OutputError> {
        let path = path.to_owned();
        match temporary(&path) {
            Ok(file) => Ok(JsonLines { path, out: BufWriter::new(file) }),
            Err(error) => Err(OutputError { path, error }),
        }
    }

    /// Adds a line.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn add(&mut self, value: &impl Serialize) -> Result<(), OutputError> {
        let written = serde_json::to_writer(&mut self.out, value).map_err(io::Error::from);
        let written = written.and_then(|()| writeln!(self.out));
        written.map_err(|error| OutputError { path: self.path.clone(), error })
    }

    /// Puts the file in its place.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn finish(self) -> Result<(), OutputError> {
        let JsonLines { path, out } = self;
        let file = out.into_inner().map_err(io::IntoInnerError::into_error);
        let put = file.and_then(|file| file.persist(&path).map_err(|error| error.error));
        put.map(|_| ()).map_err(|error| OutputError { path, error })
    }
}
