//! Files: pictures that say what they show, and records beside them.
//!
//! A file is written whole or not at all: under a temporary name in the same folder, then renamed.

mod bmp;
mod frames;
mod picture;
mod png;
mod record;
mod slug;

pub use frames::{frame_name, remove_frames};
pub use picture::{PictureFormat, write_picture};
pub use png::{encode_png, write_png};
pub use record::{write_json, write_json_lines, write_text};
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

/// Makes the folder that `file` is to be written to, as [`prepare_folder`] does.
///
/// # Errors
/// When that cannot be done.
pub fn prepare_file(file: &Path) -> Result<(), OutputError> {
    match file.parent().filter(|folder| !folder.as_os_str().is_empty()) {
        Some(folder) => prepare_folder(folder),
        None => Ok(()),
    }
}

/// Writes a file through `write`, whole or not at all; a file of that name is replaced. What is no
/// file (a pipe, a device) is written to as it is; a link is followed.
fn write_whole(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), OutputError> {
    let target = fs::canonicalize(path).unwrap_or_else(|_| match fs::read_link(path) {
        // A link to a file that is still to come.
        Ok(link) => path.parent().unwrap_or(Path::new("")).join(link),
        Err(_) => path.to_owned(),
    });
    let special = fs::metadata(&target).is_ok_and(|found| !found.is_file() && !found.is_dir());
    let written = || {
        if special {
            let mut out = BufWriter::new(fs::OpenOptions::new().write(true).open(&target)?);
            write(&mut out)?;
            return out.flush();
        }
        let folder = target.parent().filter(|folder| !folder.as_os_str().is_empty());
        let mut builder = tempfile::Builder::new();
        builder.prefix(".lightsquare-");
        // Readable as any other file is; the default is for secrets.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        let mut out = BufWriter::new(builder.tempfile_in(folder.unwrap_or(Path::new(".")))?);
        write(&mut out)?;
        let file = out.into_inner().map_err(io::IntoInnerError::into_error)?;
        file.persist(&target).map_err(|error| error.error)?;
        Ok(())
    };
    written().map_err(|error| OutputError { path: path.to_owned(), error })
}
