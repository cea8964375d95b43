//! PNG with text chunks.

use std::borrow::Cow;
use std::io::{self, Write};
use std::path::Path;

use image::DynamicImage;
use png::{BitDepth, ColorType, Compression, Encoder, PixelDimensions, Unit};

use super::{OutputError, per_metre, write_whole};

/// Encodes `picture` quickly, with `texts` as text chunks in their order (keyword, text). What is
/// not plain ASCII becomes an international text chunk. With `dpi`, it says how many pixels an inch it
/// is to be printed with.
///
/// # Errors
/// What `out` gives.
pub fn encode_png(
    picture: &DynamicImage,
    texts: &[(&str, String)],
    dpi: Option<u32>,
    out: impl Write,
) -> io::Result<()> {
    let mut encoder = Encoder::new(out, picture.width(), picture.height());
    let (color, bytes) = match picture {
        DynamicImage::ImageRgba8(picture) => (ColorType::Rgba, Cow::Borrowed(picture.as_raw())),
        DynamicImage::ImageRgb8(picture) => (ColorType::Rgb, Cow::Borrowed(picture.as_raw())),
        other => (ColorType::Rgb, Cow::Owned(other.to_rgb8().into_raw())),
    };
    encoder.set_color(color);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::Fast);
    encoder.set_pixel_dims(dpi.map(|dpi| PixelDimensions {
        xppu: per_metre(dpi),
        yppu: per_metre(dpi),
        unit: Unit::Meter,
    }));
    for (keyword, text) in texts {
        if text.is_ascii() {
            encoder.add_text_chunk((*keyword).to_owned(), text.clone())?;
        } else {
            encoder.add_itxt_chunk((*keyword).to_owned(), text.clone())?;
        }
    }
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&bytes)?;
    writer.finish()?;
    Ok(())
}

/// Writes `picture` to a file, as [`encode_png`] encodes it.
///
/// # Errors
/// When the file cannot be written.
pub fn write_png(
    path: &Path,
    picture: &DynamicImage,
    texts: &[(&str, String)],
    dpi: Option<u32>,
) -> Result<(), OutputError> {
    write_whole(path, |out| encode_png(picture, texts, dpi, out))
}
