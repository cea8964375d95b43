//! Names of numbered pictures.

use std::fs;
use std::path::Path;

use super::OutputError;

/// The file name of picture `index`: `frame_00000.png`.
pub fn frame_name(index: usize) -> String {
    format!("frame_{index:05}.png")
}

/// Removes the numbered pictures of an earlier run from `folder`: they would stand among the new
/// ones, and be of another film.
///
/// # Errors
/// When the folder cannot be read, or a picture cannot be removed.
pub fn remove_frames(folder: &Path) -> Result<(), OutputError> {
    let failed = |error| OutputError { path: folder.to_owned(), error };
    for entry in fs::read_dir(folder).map_err(failed)? {
        let path = entry.map_err(failed)?.path();
        if path.is_file() && path.file_name().is_some_and(|name| is_frame(&name.to_string_lossy()))
        {
            fs::remove_file(&path).map_err(failed)?;
        }
    }
    Ok(())
}

fn is_frame(name: &str) -> bool {
    name.strip_prefix("frame_")
        .and_then(|rest| rest.strip_suffix(".png"))
        .is_some_and(|digits| digits.len() >= 5 && digits.bytes().all(|b| b.is_ascii_digit()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_is_named_as_a_frame_is_one() {
        assert!(is_frame(&frame_name(7)) && is_frame(&frame_name(1_234_567)));
        for other in ["frame_1.png", "frame_0000x.png", "frame_00001.jpg", "my_frame_00001.png"] {
            assert!(!is_frame(other), "{other}");
        }
    }
}
