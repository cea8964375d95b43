//! Names of numbered pictures.

use std::fs;
use std::io;
use std::ops::RangeInclusive;
use std::path::Path;

use super::OutputError;

/// The file name of picture `index`: `frame_00000.png`.
pub fn frame_name(index: usize) -> String {
    format!("frame_{index:05}.png")
}

/// The name of a game's manifest, or of that of a part of its frames.
pub fn manifest_name(part: Option<&RangeInclusive<usize>>) -> String {
    match part {
        None => "game.json".to_owned(),
        Some(part) => format!("game_{:05}-{:05}.json", part.start(), part.end()),
    }
}

/// Removes the numbered pictures of an earlier run from `folder`, manifests of parts of it, and all of its
/// variations: they would stand among the new ones, and be of another film. Where a `part` is rendered, only its
/// pictures.
///
/// # Errors
/// When the folder cannot be read, or a picture cannot be removed.
pub fn remove_frames(
    folder: &Path,
    part: Option<&RangeInclusive<usize>>,
) -> Result<(), OutputError> {
    let failed = |error| OutputError { path: folder.to_owned(), error };
    for entry in fs::read_dir(folder).map_err(failed)? {
        let entry = entry.map_err(failed)?;
        let name = entry.file_name().to_string_lossy().into_owned();
        // What a link leads to is not ours.
        let kind = entry.file_type().map_err(failed)?;
        if kind.is_dir() && part.is_none() && is_variation(&name) {
            remove_variation(&entry.path())?;
            continue;
        }
        let is_old = match (frame_index(&name), part) {
            (Some(index), Some(part)) => part.contains(&index),
            (Some(_), None) => true,
            (None, part) => part.is_none() && is_part_manifest(&name),
        };
        if is_old && !kind.is_dir() {
            remove_if_there(&entry.path()).map_err(failed)?;
        }
    }
    Ok(())
}

/// Removes what a variation's folder holds of ours; without a manifest it is another's, unless it is empty.
fn remove_variation(folder: &Path) -> Result<(), OutputError> {
    let failed = |error| OutputError { path: folder.to_owned(), error };
    let manifest = folder.join(manifest_name(None));
    if manifest.is_file() {
        remove_frames(folder, None)?;
        remove_if_there(&manifest).map_err(failed)?;
    } else {
        for entry in fs::read_dir(folder).map_err(failed)? {
            let entry = entry.map_err(failed)?;
            let is_nested = is_variation(&entry.file_name().to_string_lossy());
            if is_nested && entry.file_type().map_err(failed)?.is_dir() {
                remove_variation(&entry.path())?;
            }
        }
    }
    // Somebody may keep other things in it.
    let _ = fs::remove_dir(folder);
    Ok(())
}

fn remove_if_there(path: &Path) -> io::Result<()> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

/// Whether a folder is named as those of variations are: `12w-nf3`.
fn is_variation(name: &str) -> bool {
    let rest = name.trim_start_matches(|c: char| c.is_ascii_digit());
    let san = rest.strip_prefix("w-").or(rest.strip_prefix("b-"));
    let is_plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
    rest.len() < name.len() && san.is_some_and(|san| !san.is_empty() && san.chars().all(is_plain))
}

/// Which picture has that name, if one has.
fn frame_index(name: &str) -> Option<usize> {
    let digits = name.strip_prefix("frame_")?.strip_suffix(".png")?;
    is_number(digits).then(|| digits.parse().unwrap_or(usize::MAX))
}

fn is_part_manifest(name: &str) -> bool {
    let part = name.strip_prefix("game_").and_then(|rest| rest.strip_suffix(".json"));
    part.and_then(|part| part.split_once('-')).is_some_and(|(a, b)| is_number(a) && is_number(b))
}

fn is_number(digits: &str) -> bool {
    digits.len() >= 5 && digits.bytes().all(|b| b.is_ascii_digit())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_is_named_as_a_frame_is_one() {
        for index in [0, 7, 1_234_567] {
            assert_eq!(frame_index(&frame_name(index)), Some(index));
        }
        for other in ["frame_1.png", "frame_0000x.png", "frame_00001.jpg", "my_frame_00001.png"] {
            assert_eq!(frame_index(other), None, "{other}");
        }
    }

    #[test]
    fn folders_of_variations_are_told_from_others() {
        for name in ["12w-nf3", "1b-o-o-o-2", "100w-axb8q"] {
            assert!(is_variation(name), "{name}");
        }
        for other in ["w-nf3", "12w", "12w-", "12-nf3", "12w-Nf3", "0001-morphy-black", "12w-../x"]
        {
            assert!(!is_variation(other), "{other}");
        }
    }

    #[test]
    fn manifests_of_parts_are_told_from_others() {
        assert!(is_part_manifest(&manifest_name(Some(&(100..=250)))));
        for other in [&manifest_name(None), "game_1-2.json", "game_00100.json", "game_my-own.json"]
        {
            assert!(!is_part_manifest(other), "{other}");
        }
    }
}
