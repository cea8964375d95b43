//! One run at a time in a folder, or several that are parts of one.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::thread;
use std::time::{Duration, Instant};

use super::OutputError;
use crate::text::shown;

/// Holds a folder for this process, by its file `.lock`. The system lets go of it when the process ends, however that
/// happens; so a file that a dead one has left does not block.
#[derive(Debug)]
pub struct FolderLock {
    path: PathBuf,
    is_shared: bool,
    /// `None` where the file system knows no locks.
    file: Option<File>,
}

/// How long those who share a folder wait for it.
const PATIENCE: Duration = Duration::from_secs(1);

/// Why a folder cannot be had.
#[derive(Debug, thiserror::Error)]
pub enum LockError {
    #[error(
        "{}: another lightsquare{} writes there, expected it to end first, or another --out",
        shown(folder),
        match process {
            Some(id) => format!(" (process {id})"),
            None => String::new(),
        }
    )]
    Held { folder: PathBuf, process: Option<u32> },
    #[error(transparent)]
    Output(#[from] OutputError),
}

impl FolderLock {
    /// Takes hold of `folder`, which is there, for this process alone.
    ///
    /// # Errors
    /// When another process has it, or the file cannot be made.
    pub fn take(folder: &Path) -> Result<FolderLock, LockError> {
        FolderLock::hold(folder, false)
    }

    /// Takes hold of `folder` as [`FolderLock::take`] does, together with others who share it.
    ///
    /// # Errors
    /// As for [`FolderLock::take`].
    pub fn share(folder: &Path) -> Result<FolderLock, LockError> {
        FolderLock::hold(folder, true)
    }

    fn hold(folder: &Path, is_shared: bool) -> Result<FolderLock, LockError> {
        let path = folder.join(".lock");
        let failed = |error| OutputError { path: path.clone(), error };
        let begun = Instant::now();
        loop {
            let mut file = open(&path).map_err(failed)?;
            match if is_shared { file.try_lock_shared() } else { file.try_lock() } {
                Ok(()) => {}
                // The last of those who share it may just be looking whether it is the last.
                Err(TryLockError::WouldBlock) if is_shared && begun.elapsed() < PATIENCE => {
                    thread::sleep(PATIENCE / 20);
                    continue;
                }
                Err(TryLockError::WouldBlock) => {
                    let mut text = String::new();
                    // Whoever has it may just be writing its number.
                    let _ = file.read_to_string(&mut text);
                    let process = text.trim().parse().ok();
                    return Err(LockError::Held { folder: folder.to_owned(), process });
                }
                // Some file systems of networks have no locks; pictures are written there all the same.
                Err(TryLockError::Error(_)) => {
                    return Ok(FolderLock { path, is_shared, file: None });
                }
            }
            // Between the two steps the one before may have taken its file away.
            if !is_at(&file, &path) {
                continue;
            }
            file.set_len(0).map_err(failed)?;
            writeln!(file, "{}", std::process::id()).map_err(failed)?;
            return Ok(FolderLock { path, is_shared, file: Some(file) });
        }
    }
}

impl Drop for FolderLock {
    fn drop(&mut self) {
        // Whoever shares the folder still needs the file; the last one has it alone.
        let is_alone = |file: &File| !self.is_shared || file.try_lock().is_ok();
        if self.file.as_ref().is_some_and(|file| is_alone(file) && is_at(file, &self.path)) {
            // One that stays does not block.
            let _ = fs::remove_file(&self.path);
        }
    }
}

fn open(path: &Path) -> io::Result<File> {
    // A link would lead elsewhere.
    if path.is_symlink() {
        fs::remove_file(path)?;
    }
    OpenOptions::new().read(true).write(true).create(true).truncate(false).open(path)
}

/// Whether `file` is still the one of that name.
#[cfg(unix)]
fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let id = |data: fs::Metadata| (data.dev(), data.ino());
    let (ours, named) = (file.metadata().map(id), fs::symlink_metadata(path).map(id));
    matches!((ours, named), (Ok(ours), Ok(named)) if ours == named)
}

/// Files that are open cannot be taken away elsewhere.
#[cfg(not(unix))]
fn is_at(_: &File, _: &Path) -> bool {
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_is_held_by_one_at_a_time() {
        let folder = tempfile::tempdir().unwrap();
        let held = FolderLock::take(folder.path()).unwrap();
        let error = FolderLock::take(folder.path()).unwrap_err().to_string();
        assert!(error.contains(&format!("(process {})", std::process::id())), "{error}");
        drop(held);
        assert!(fs::read_dir(folder.path()).unwrap().next().is_none());
        FolderLock::take(folder.path()).unwrap();
    }

    #[test]
    fn those_who_share_a_folder_keep_others_out_until_the_last_one_leaves() {
        let folder = tempfile::tempdir().unwrap();
        let first = FolderLock::share(folder.path()).unwrap();
        let second = FolderLock::share(folder.path()).unwrap();
        for held in [first, second] {
            assert!(FolderLock::take(folder.path()).is_err());
            drop(held);
        }
        assert!(fs::read_dir(folder.path()).unwrap().next().is_none());
        let alone = FolderLock::take(folder.path()).unwrap();
        assert!(FolderLock::share(folder.path()).is_err());
        drop(alone);
        assert!(fs::read_dir(folder.path()).unwrap().next().is_none());
    }

    #[test]
    fn what_a_dead_process_left_does_not_block() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join(".lock"), "4000000\n").unwrap();
        let held = FolderLock::take(folder.path()).unwrap();
        let text = fs::read_to_string(folder.path().join(".lock")).unwrap();
        assert_eq!(text.trim(), std::process::id().to_string());
        drop(held);
    }
}
