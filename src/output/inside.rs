//! Folders within the one that all output goes to. Nothing is written outside it, whatever lies there already.

use std::fs;
use std::io;
use std::path::{Component, Path, PathBuf};

use super::{OutputError, TEMPORARY, prepare_folder};

/// Makes the folder `inside` of `root`, which is a relative path, with all that lead to it, and makes sure that files can
/// be written there.
///
/// # Errors
/// When that cannot be done, or would lead out of `root` by a link.
pub fn prepare_inside(root: &Path, inside: &Path) -> Result<PathBuf, OutputError> {
    let mut folder = root.to_owned();
    for component in inside.components() {
        let failed = |what: &str| {
            let error = io::Error::other(what.to_owned());
            Err(OutputError { path: root.join(inside), error })
        };
        let Component::Normal(name) = component else {
            return failed("the path leads out of its folder");
        };
        folder.push(name);
        if folder.is_symlink() {
            return failed("it is a link, or lies behind one, expected folders alone");
        }
    }
    prepare_folder(&folder)?;
    Ok(folder)
}

/// Removes what runs that were killed have left of their files; nobody else may write to `folder` meanwhile.
///
/// # Errors
/// When the folder cannot be read, or a file cannot be removed.
pub fn remove_temporaries(folder: &Path) -> Result<(), OutputError> {
    let failed = |error| OutputError { path: folder.to_owned(), error };
    for entry in fs::read_dir(folder).map_err(failed)? {
        let entry = entry.map_err(failed)?;
        let is_ours = entry.file_name().to_string_lossy().starts_with(TEMPORARY);
        if is_ours && entry.file_type().map_err(failed)?.is_file() {
            fs::remove_file(entry.path()).map_err(failed)?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_path_leads_out() {
        let root = tempfile::tempdir().unwrap();
        let made = prepare_inside(root.path(), Path::new("a/b")).unwrap();
        assert_eq!(made, root.path().join("a/b"));
        assert!(made.is_dir());
        for path in ["../x", "a/../../x", "/x"] {
            assert!(prepare_inside(root.path(), Path::new(path)).is_err(), "{path}");
        }
        assert_eq!(fs::read_dir(root.path()).unwrap().count(), 1);
    }

    #[cfg(unix)]
    #[test]
    fn links_are_not_followed() {
        let (root, other) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
        std::os::unix::fs::symlink(other.path(), root.path().join("a")).unwrap();
        for path in ["a", "a/b"] {
            let error = prepare_inside(root.path(), Path::new(path)).unwrap_err();
            assert!(error.error.to_string().contains("link"), "{path}");
        }
        assert_eq!(fs::read_dir(other.path()).unwrap().count(), 0);
    }

    #[test]
    fn leftovers_are_removed_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        for name in [".lightsquare-x1", ".mine", "frame_00000.png"] {
            fs::write(folder.path().join(name), "").unwrap();
        }
        remove_temporaries(folder.path()).unwrap();
        let names = fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().file_name());
        let mut names: Vec<_> = names.map(|name| name.into_string().unwrap()).collect();
        names.sort();
        assert_eq!(names, [".mine", "frame_00000.png"]);
    }
}
