//! BMP, the thesis's format.

use std::io::{self, Write};

use image::codecs::bmp::BmpEncoder;
use image::{ExtendedColorType, ImageError, RgbImage};

/// Encodes `picture` with 24 bits a pixel.
///
/// # Errors
/// What `out` gives.
pub fn encode_bmp(picture: &RgbImage, mut out: impl Write) -> io::Result<()> {
    BmpEncoder::new(&mut out)
        .encode(picture.as_raw(), picture.width(), picture.height(), ExtendedColorType::Rgb8)
        .map_err(|error| match error {
            ImageError::IoError(error) => error,
            other => io::Error::other(other),
        })
}
