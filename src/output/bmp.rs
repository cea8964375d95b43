//! BMP, the thesis's format.

use std::io::{self, Write};

use image::codecs::bmp::BmpEncoder;
use image::{DynamicImage, ExtendedColorType, ImageError};

/// Encodes `picture` with 24 bits a pixel; what is transparent keeps the colour that it has.
///
/// # Errors
/// What `out` gives.
pub fn encode_bmp(picture: &DynamicImage, mut out: impl Write) -> io::Result<()> {
    let rgb = picture.to_rgb8();
    BmpEncoder::new(&mut out)
        .encode(rgb.as_raw(), rgb.width(), rgb.height(), ExtendedColorType::Rgb8)
        .map_err(|error| match error {
            ImageError::IoError(error) => error,
            other => io::Error::other(other),
        })
}
