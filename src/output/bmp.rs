//! BMP, the thesis's format.

use std::io::{self, Write};
use std::ops::Range;

use image::codecs::bmp::BmpEncoder;
use image::{DynamicImage, ExtendedColorType};

use super::{of_image, per_metre};

/// Where the header has the pixels a metre, to the right and upwards.
const PIXELS_PER_METRE: Range<usize> = 38..46;

/// Encodes `picture` with 24 bits a pixel; what is transparent keeps the colour that it has. With
/// `dpi`, it says how many pixels an inch it is to be printed with.
///
/// # Errors
/// What `out` gives.
pub fn encode_bmp(picture: &DynamicImage, dpi: Option<u32>, mut out: impl Write) -> io::Result<()> {
    let rgb = picture.to_rgb8();
    let mut bytes = Vec::new();
    BmpEncoder::new(&mut bytes)
        .encode(rgb.as_raw(), rgb.width(), rgb.height(), ExtendedColorType::Rgb8)
        .map_err(of_image)?;
    if let (Some(dpi), Some(fields)) = (dpi, bytes.get_mut(PIXELS_PER_METRE)) {
        fields.copy_from_slice(&[per_metre(dpi).to_le_bytes(); 2].concat());
    }
    out.write_all(&bytes)
}
