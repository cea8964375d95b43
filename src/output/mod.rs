//! Files: pictures that say what they show, films, and records beside them.
//!
//! A file is written whole or not at all: under a temporary name in the same folder, then renamed.

mod bmp;
mod earlier;
mod film;
mod frames;
mod inside;
mod lock;
mod picture;
mod png;
mod record;
mod repeated;
mod slug;
mod whole;

pub use earlier::Earlier;
pub use film::{Cut, FILM_FORMATS, Ffmpeg, FfmpegError, FilmFormat, FilmWriter, Stop};
pub use frames::{FrameNames, film_name, manifest_name};
pub use inside::{prepare_inside, remove_temporaries};
pub use lock::{FolderLock, LockError};
pub use picture::{FORMATS, PictureFormat, write_picture};
pub use png::encode_png;
pub use record::{JsonLines, write_json};
pub use repeated::RepeatedPicture;
pub use slug::slug;
pub use whole::{FINGERPRINT, crc32_of, is_whole};

use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use image::ImageError;
use tempfile::NamedTempFile;

use crate::text::shown;

/// Pixels a metre, as files count them, where there are `dpi` an inch.
fn per_metre(dpi: u32) -> u32 {
    (f64::from(dpi) / 0.0254).round() as u32
}

/// What went wrong as an encoder of `image` wrote.
fn of_image(error: ImageError) -> io::Error {
    match error {
        ImageError::IoError(error) => error,
        other => io::Error::other(other),
    }
}

/// A file or folder that could not be written.
#[derive(Debug, thiserror::Error)]
#[error("{}: cannot be written{}", shown(path), advice(error))]
pub struct OutputError {
    pub path: PathBuf,
    #[source]
    pub error: io::Error,
}

/// What helps, where that is known.
fn advice(error: &io::Error) -> &'static str {
    match error.kind() {
        io::ErrorKind::StorageFull => {
            " (what is finished stays, and the same command goes on with it once there is room)"
        }
        _ => "",
    }
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

/// What a file is to hold.
pub type Content<'a> = &'a dyn Fn(&mut dyn Write) -> io::Result<()>;

/// Writes files, none of them if one cannot be written: each whole under a temporary name in its
/// folder, then all renamed. A file of that name is replaced. What is no file (a pipe, a device) is written to as it
/// is; a link is followed.
///
/// # Errors
/// When one of them cannot be written.
pub fn write_together(files: &[(PathBuf, Content)]) -> Result<(), OutputError> {
    let staged: Vec<_> =
        files.iter().map(|(path, content)| staged(path, content)).collect::<Result<_, _>>()?;
    for ((path, _), file) in files.iter().zip(staged) {
        if let Some((file, target)) = file {
            let failed = |error: tempfile::PersistError| OutputError {
                path: path.clone(),
                error: error.error,
            };
            file.persist(&target).map_err(failed)?;
        }
    }
    Ok(())
}

/// Writes a file as [`write_together`] does.
fn write_whole(
    path: &Path,
    content: impl Fn(&mut dyn Write) -> io::Result<()>,
) -> Result<(), OutputError> {
    write_together(&[(path.to_owned(), &content)])
}

/// Writes a file of a folder that is ours: whole under a temporary name, then renamed. What has that name is replaced,
/// and a link is not followed.
fn write_inside(
    path: &Path,
    content: impl Fn(&mut dyn Write) -> io::Result<()>,
) -> Result<(), OutputError> {
    let written = || {
        let mut out = BufWriter::new(temporary(path)?);
        content(&mut out)?;
        let file = out.into_inner().map_err(io::IntoInnerError::into_error)?;
        file.persist(path).map_err(|error| error.error)?;
        Ok(())
    };
    written().map_err(|error| OutputError { path: path.to_owned(), error })
}

/// A file under a temporary name, and where it belongs; nothing is left to do for what is no file.
fn staged(path: &Path, content: Content) -> Result<Option<(NamedTempFile, PathBuf)>, OutputError> {
    let target = fs::canonicalize(path).unwrap_or_else(|_| match fs::read_link(path) {
        // A link to a file that is still to come.
        Ok(link) => path.parent().unwrap_or(Path::new("")).join(link),
        Err(_) => path.to_owned(),
    });
    let found = fs::metadata(&target).ok();
    let written = || {
        if found.as_ref().is_some_and(fs::Metadata::is_dir) {
            return Err(io::ErrorKind::IsADirectory.into());
        }
        if found.is_some_and(|found| !found.is_file()) {
            let mut out = BufWriter::new(fs::OpenOptions::new().write(true).open(&target)?);
            content(&mut out)?;
            out.flush()?;
            return Ok(None);
        }
        let mut out = BufWriter::new(temporary(&target)?);
        content(&mut out)?;
        let file = out.into_inner().map_err(io::IntoInnerError::into_error)?;
        Ok(Some((file, target.clone())))
    };
    written().map_err(|error| OutputError { path: path.to_owned(), error })
}

/// Removes a file, unless there is none.
///
/// # Errors
/// When it cannot be removed.
pub fn remove_file(path: &Path) -> Result<(), OutputError> {
    remove_if_there(path).map_err(|error| OutputError { path: path.to_owned(), error })
}

/// Removes a file, unless there is none.
fn remove_if_there(path: &Path) -> io::Result<()> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

/// How names of files begin that are not whole yet.
const TEMPORARY: &str = ".lightsquare-";

/// A file under a temporary name, in the folder of `target`; it is removed when it is dropped.
fn temporary(target: &Path) -> io::Result<NamedTempFile> {
    let folder = target.parent().filter(|folder| !folder.as_os_str().is_empty());
    let mut builder = tempfile::Builder::new();
    builder.prefix(TEMPORARY);
    // Readable as any other file is; the default is for secrets.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(folder.unwrap_or(Path::new(".")))
}
