//! What an earlier run has left in a game's folder: what of it can stay, and what has to go.
//!
//! A manifest is written before the pictures that it names, and pictures that are to be others are removed before that. So
//! whenever a run is ended, by whatever means, a picture is as some manifest's row says, or not there. (Shards write
//! before there is a manifest; what they have written tells of itself, or their records do.)

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};

use serde_json::Value;

use super::film::FILM_FORMATS;
use super::frames::frame_index;
use super::{
    FrameNames, OutputError, PictureFormat, crc32_of, film_name, is_whole, manifest_name,
    remove_if_there, remove_temporaries,
};

/// A game's folder, with what its manifests say.
pub struct Earlier {
    folder: PathBuf,
    part: Option<RangeInclusive<usize>>,
    /// What each file is that they name; none where one says this and another that.
    files: BTreeMap<String, Option<Told>>,
    /// What is said of the whole by the manifest of the same part, which is to be written again; and its pictures.
    fingerprint: Option<String>,
    films: BTreeSet<String>,
    own: BTreeSet<String>,
    is_any: bool,
}

/// What a manifest tells of a picture.
#[derive(PartialEq, Eq)]
struct Told {
    fingerprint: Option<String>,
    /// Of all its bytes.
    crc32: Option<u32>,
}

impl Earlier {
    /// Reads what is in `folder`, where a `part` of the frames is to be rendered, or all. What cannot be read is as if
    /// it were not there.
    pub fn read(folder: &Path, part: Option<&RangeInclusive<usize>>) -> Earlier {
        let mut files: BTreeMap<String, Option<Told>> = BTreeMap::new();
        let names = fs::read_dir(folder).into_iter().flatten().flatten();
        let names = names.map(|entry| entry.file_name().to_string_lossy().into_owned());
        let mut is_any = false;
        for name in names.filter(|name| is_manifest(name)) {
            is_any = true;
            for row in manifest(&folder.join(name))["frames"].as_array().into_iter().flatten() {
                let text = |key: &str| row[key].as_str().map(str::to_owned);
                let Some(file) = text("file") else { continue };
                let crc32 = row["crc32"].as_u64().and_then(|crc32| u32::try_from(crc32).ok());
                let told = Some(Told { fingerprint: text("fingerprint"), crc32 });
                files
                    .entry(file)
                    .and_modify(|known| {
                        if *known != told {
                            *known = None;
                        }
                    })
                    .or_insert(told);
            }
        }
        let own = manifest(&folder.join(manifest_name(part)));
        let films = own["films"].as_array().into_iter().flatten().filter_map(Value::as_str);
        let rows = own["frames"].as_array().into_iter().flatten();
        Earlier {
            folder: folder.to_owned(),
            part: part.cloned(),
            files,
            fingerprint: own["fingerprint"].as_str().map(str::to_owned),
            films: films.map(str::to_owned).collect(),
            own: rows.filter_map(|row| row["file"].as_str()).map(str::to_owned).collect(),
            is_any,
        }
    }

    /// Whether the picture `file` was made to be what has that fingerprint.
    pub fn has_frame(&self, file: &str, fingerprint: &str) -> bool {
        self.told(file).and_then(|told| told.fingerprint.as_deref()) == Some(fingerprint)
    }

    /// The CRC-32 of the picture `file` when it was written, where that is told.
    pub fn crc32(&self, file: &str) -> Option<u32> {
        self.told(file)?.crc32
    }

    /// Whether the picture `file` was made to be what has that fingerprint, and is there and whole.
    pub fn vouches(&self, file: &str, format: PictureFormat, fingerprint: &str) -> bool {
        let path = self.folder.join(file);
        self.has_frame(file, fingerprint)
            && match self.crc32(file) {
                Some(told) => crc32_of(&path).is_ok_and(|found| found == told),
                None => is_whole(&path, format, fingerprint),
            }
    }

    fn told(&self, file: &str) -> Option<&Told> {
        self.files.get(file)?.as_ref()
    }

    /// Whether there is any manifest.
    pub fn is_any(&self) -> bool {
        self.is_any
    }

    /// Whether a manifest tells of the picture `file`.
    pub fn tells(&self, file: &str) -> bool {
        self.files.contains_key(file)
    }

    /// Whether anything is said of the whole.
    pub fn is_told(&self) -> bool {
        self.fingerprint.is_some()
    }

    /// Whether something else is said of the whole than that it has that fingerprint, and some of these films.
    pub fn is_other(&self, fingerprint: &str, films: &[String]) -> bool {
        self.fingerprint.as_deref().is_some_and(|known| known != fingerprint)
            || self.films.iter().any(|film| !films.contains(film))
    }

    /// Whether there is the film `file` of what has that fingerprint.
    pub fn has_film(&self, file: &str, fingerprint: &str) -> bool {
        let is_there = || {
            let found = fs::symlink_metadata(self.folder.join(file));
            found.is_ok_and(|found| found.is_file() && found.len() > 0)
        };
        self.films.contains(file) && self.fingerprint.as_deref() == Some(fingerprint) && is_there()
    }

    /// Removes numbered pictures by `names`, by their usual ones and by manifests, films, and all variations, unless
    /// somebody `keeps` what has that name: they would stand among the new ones, and be of another film. Where a part is
    /// rendered, only its film, its pictures where there are to be others, and those of its manifest: nobody would know
    /// any more what they are.
    ///
    /// # Errors
    /// When the folder cannot be read, or a file cannot be removed.
    pub fn remove(
        &self,
        names: Option<&FrameNames>,
        keeps: impl Fn(&str) -> bool,
    ) -> Result<(), OutputError> {
        let failed = |error| OutputError { path: self.folder.clone(), error };
        for (name, path) in self.old(names, keeps)? {
            if path.is_symlink() || !path.is_dir() {
                remove_if_there(&path).map_err(failed)?;
            } else if is_variation(&name) {
                remove_variation(&path, names)?;
            }
        }
        Ok(())
    }

    /// Removes the manifests of parts, once that of the whole has been written: what is there has a name in that one, so that it
    /// is always known what pictures are. That of a part leaves the others alone.
    ///
    /// # Errors
    /// When the folder cannot be read, or a file cannot be removed.
    pub fn remove_manifests(&self) -> Result<(), OutputError> {
        let failed = |error| OutputError { path: self.folder.clone(), error };
        if self.part.is_some() {
            return Ok(());
        }
        for entry in fs::read_dir(&self.folder).map_err(failed)? {
            let entry = entry.map_err(failed)?;
            let is_file = !entry.file_type().map_err(failed)?.is_dir();
            if is_file && is_part_manifest(&entry.file_name().to_string_lossy()) {
                remove_if_there(&entry.path()).map_err(failed)?;
            }
        }
        Ok(())
    }

    /// The name of something that [`Earlier::remove`] would take away, if there is anything.
    ///
    /// # Errors
    /// When the folder cannot be read.
    pub fn first_old(
        &self,
        names: Option<&FrameNames>,
        keeps: impl Fn(&str) -> bool,
    ) -> Result<Option<String>, OutputError> {
        let old = self.old(names, keeps)?.into_iter().map(|(name, _)| name);
        Ok(old.min())
    }

    /// What has to go, but for manifests.
    fn old(
        &self,
        names: Option<&FrameNames>,
        keeps: impl Fn(&str) -> bool,
    ) -> Result<Vec<(String, PathBuf)>, OutputError> {
        let failed = |error| OutputError { path: self.folder.clone(), error };
        let part = self.part.as_ref();
        let mut old = Vec::new();
        for entry in fs::read_dir(&self.folder).map_err(failed)? {
            let entry = entry.map_err(failed)?;
            let name = entry.file_name().to_string_lossy().into_owned();
            // What a link leads to is not ours.
            let is_folder = entry.file_type().map_err(failed)?.is_dir();
            let is_old = match (frame_index(&name, names), part) {
                _ if is_folder => part.is_none() && is_variation(&name),
                (_, Some(_)) if self.own.contains(&name) && is_picture(&name) => true,
                (Some(index), Some(part)) => names.is_some() && part.contains(&index),
                (Some(_), None) => true,
                (None, Some(part)) => {
                    FILM_FORMATS.iter().any(|(_, film)| name == film_name(*film, Some(part)))
                }
                (None, None) => {
                    self.files.contains_key(&name) && is_picture(&name) || is_film(&name)
                }
            };
            if is_old && !keeps(&name) {
                old.push((name, entry.path()));
            }
        }
        Ok(old)
    }
}

fn manifest(path: &Path) -> Value {
    let is_file = fs::symlink_metadata(path).is_ok_and(|found| found.is_file());
    let bytes = if is_file { fs::read(path).unwrap_or_default() } else { Vec::new() };
    serde_json::from_slice(&bytes).unwrap_or_default()
}

/// Whether a name ends as those of pictures that we write.
fn is_picture(name: &str) -> bool {
    name.rsplit_once('.').is_some_and(|(_, ending)| PictureFormat::named(ending).is_some())
}

/// Removes what a variation's folder holds of ours; without a manifest it is another's, unless it is empty.
fn remove_variation(folder: &Path, names: Option<&FrameNames>) -> Result<(), OutputError> {
    let failed = |error| OutputError { path: folder.to_owned(), error };
    remove_temporaries(folder)?;
    let manifest = folder.join(manifest_name(None));
    if manifest.is_file() {
        let earlier = Earlier::read(folder, None);
        earlier.remove(names, |_| false)?;
        earlier.remove_manifests()?;
        remove_if_there(&manifest).map_err(failed)?;
    } else {
        for entry in fs::read_dir(folder).map_err(failed)? {
            let entry = entry.map_err(failed)?;
            let is_nested = is_variation(&entry.file_name().to_string_lossy());
            if is_nested && entry.file_type().map_err(failed)?.is_dir() {
                remove_variation(&entry.path(), names)?;
            }
        }
    }
    // Somebody may keep other things in it.
    let _ = fs::remove_dir(folder);
    Ok(())
}

/// Whether a folder is named as those of variations are: `12w-nf3`.
fn is_variation(name: &str) -> bool {
    let rest = name.trim_start_matches(|c: char| c.is_ascii_digit());
    let san = rest.strip_prefix("w-").or(rest.strip_prefix("b-"));
    let is_plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
    rest.len() < name.len() && san.is_some_and(|san| !san.is_empty() && san.chars().all(is_plain))
}

/// Whether a manifest, or one of a part, has that name.
fn is_manifest(name: &str) -> bool {
    name == manifest_name(None) || is_part_manifest(name)
}

fn is_part_manifest(name: &str) -> bool {
    name.strip_prefix("game_").and_then(|rest| rest.strip_suffix(".json")).is_some_and(is_part)
}

/// Whether a film, or one of a part, has that name.
fn is_film(name: &str) -> bool {
    FILM_FORMATS.iter().any(|(ending, _)| {
        let stem = name.strip_suffix(ending).and_then(|rest| rest.strip_suffix('.'));
        stem.and_then(|stem| stem.strip_prefix("film"))
            .is_some_and(|rest| rest.is_empty() || rest.strip_prefix('_').is_some_and(is_part))
    })
}

/// Whether that stands for a part of the frames: `00100-00250`.
fn is_part(text: &str) -> bool {
    text.split_once('-').is_some_and(|(a, b)| is_number(a) && is_number(b))
}

fn is_number(digits: &str) -> bool {
    digits.len() >= 5 && digits.bytes().all(|b| b.is_ascii_digit())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn films_are_told_from_others() {
        for (_, format) in FILM_FORMATS {
            for part in [None, Some(&(100..=250))] {
                assert!(is_film(&film_name(format, part)));
            }
        }
        for other in ["film.avi", "film_1-2.gif", "film", "my_film.gif", "filmgif"] {
            assert!(!is_film(other), "{other}");
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
