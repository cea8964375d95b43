//! PNG with text chunks.

use std::io::{self, Write};
use std::path::Path;

use image::RgbImage;
use png::{BitDepth, ColorType, Compression, Encoder, PixelDimensions, Unit};

use super::{OutputError, per_metre, write_whole};

/// Encodes `picture` quickly, with `texts` as text chunks in their order (keyword, text). What is
/// not plain ASCII becomes an international text chunk. With `dpi`, it says how many pixels an inch it
/// is to be printed with.
///
/// # Errors
/// What `out` gives.
pub fn encode_png(
    picture: &RgbImage,
    texts: &[(&str, String)],
    dpi: Option<u32>,
    out: impl Write,
) -> io::Result<()> {
    let mut encoder = Encoder::new(out, picture.width(), picture.height());
    encoder.set_color(ColorType::Rgb);
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
    writer.write_image_data(picture.as_raw())?;
    writer.finish()?;
    Ok(())
}

/// Writes `picture` to a file, as [`encode_png`] encodes it.
///
/// # Errors
/// When the file cannot be written.
pub fn write_png(
    path: &Path,
    picture: &RgbImage,
    texts: &[(&str, String)],
    dpi: Option<u32>,
) -> Result<(), OutputError> {
    write_whole(path, |out| encode_png(picture, texts, dpi, out))
}
