//! Records in JSON. They hold no clock times: the same run writes the same bytes.

use std::path::Path;

use serde::Serialize;

use super::{OutputError, write_whole};

/// Writes one value, indented for reading.
///
/// # Errors
/// When the file cannot be written.
pub fn write_json(path: &Path, value: &impl Serialize) -> Result<(), OutputError> {
    write_whole(path, |mut out| {
        serde_json::to_writer_pretty(&mut out, value)?;
        writeln!(out)
    })
}

/// Writes one value a line.
///
/// # Errors
/// When the file cannot be written.
pub fn write_json_lines(path: &Path, values: &[impl Serialize]) -> Result<(), OutputError> {
    write_whole(path, |mut out| {
        for value in values {
            serde_json::to_writer(&mut out, value)?;
            writeln!(out)?;
        }
        Ok(())
    })
}
