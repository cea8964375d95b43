//! Pictures in the format that their file's name asks for.

use std::path::Path;

use image::DynamicImage;

use super::bmp::encode_bmp;
use super::{OutputError, write_png, write_whole};

/// What a single picture may be written as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PictureFormat {
    Png,
    /// Without texts: it has no place for them.
    Bmp,
}

impl PictureFormat {
    /// The format of a file by the ending of its name, whatever its case; PNG without one. `None`
    /// when no format has such an ending.
    pub fn of(path: &Path) -> Option<PictureFormat> {
        let Some(ending) = path.extension() else {
            return Some(PictureFormat::Png);
        };
        [("png", PictureFormat::Png), ("bmp", PictureFormat::Bmp)]
            .into_iter()
            .find(|(known, _)| ending.eq_ignore_ascii_case(known))
            .map(|(_, format)| format)
    }
}

/// Writes `picture` as the ending of `path` asks, PNG when no format does; `texts` go into its text
/// chunks where it has such, and `dpi`, the pixels an inch of paper, into its header.
///
/// # Errors
/// When the file cannot be written.
pub fn write_picture(
    path: &Path,
    picture: &DynamicImage,
    texts: &[(&str, String)],
    dpi: Option<u32>,
) -> Result<(), OutputError> {
    match PictureFormat::of(path) {
        Some(PictureFormat::Bmp) => write_whole(path, |out| encode_bmp(picture, dpi, out)),
        Some(PictureFormat::Png) | None => write_png(path, picture, texts, dpi),
    }
}
