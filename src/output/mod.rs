//! Files: pictures that say what they show, and records beside them.
//!
//! A file is written whole or not at all: under a temporary name in the same folder, then renamed.

mod png;
mod record;
mod slug;

pub use png::{encode_png, write_png};
pub use record::{write_json, write_json_lines};
pub use slug::slug;

use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// A file or folder that could not be written.
#[derive(Debug, thiserror::Error)]
#[error("{}: cannot be written", path.display())]
pub struct OutputError {
    pub path: PathBuf,
    #[source]
    pub error: io::Error,
}

/// Makes `folder` with all that lead to it, and makes sure that files can be written there.
///
/// # Errors
/// When that cannot be done.
pub fn prepare_folder(folder: &Path) -> Result<(), OutputError> {
    let failed = |error| OutputError { path: folder.to_owned(), error };
    fs::create_dir_all(folder).map_err(failed)?;
    tempfile::tempfile_in(folder).map_err(failed)?;
    Ok(())
}

/// Writes a file through `write`, whole or not at all; a file of that name is replaced.
fn write_whole(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), OutputError> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let write_renamed = || {
        let mut builder = tempfile::Builder::new();
        builder.prefix(".lightsquare-");
        // Readable as any other file is; the default is for secrets.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        let file = builder.tempfile_in(folder.unwrap_or(Path::new(".")))?;
        let mut buffered = BufWriter::new(file);
        write(&mut buffered)?;
        let file = buffered.into_inner().map_err(io::IntoInnerError::into_error)?;
        file.persist(path).map_err(|error| error.error)?;
        Ok(())
    };
    write_renamed().map_err(|error| OutputError { path: path.to_owned(), error })
}
