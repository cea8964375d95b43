//! PNG with text chunks.

use std::borrow::Cow;
use std::io::{self, Write};

use image::DynamicImage;
use png::{BitDepth, ColorType, Compression, Encoder, PixelDimensions, Unit};

use super::per_metre;

/// A compressed picture, for files with any texts.
pub(super) struct Packed {
    size: [u32; 2],
    color: ColorType,
    /// All chunks behind the header.
    rest: Vec<u8>,
}

/// How long a file's signature and its first chunk are, and its last one, in bytes.
const HEAD: usize = 33;
const END: usize = 12;

impl Packed {
    /// Compresses `picture` quickly.
    pub fn new(picture: &DynamicImage) -> io::Result<Packed> {
        let (color, bytes) = match picture {
            DynamicImage::ImageRgba8(picture) => (ColorType::Rgba, Cow::Borrowed(picture.as_raw())),
            DynamicImage::ImageRgb8(picture) => (ColorType::Rgb, Cow::Borrowed(picture.as_raw())),
            other => (ColorType::Rgb, Cow::Owned(other.to_rgb8().into_raw())),
        };
        let mut packed =
            Packed { size: [picture.width(), picture.height()], color, rest: Vec::new() };
        let mut file = Vec::new();
        let mut writer = packed.encoder(&mut file).write_header()?;
        writer.write_image_data(&bytes)?;
        writer.finish()?;
        packed.rest = file.split_off(HEAD);
        Ok(packed)
    }

    fn encoder<'a, W: Write>(&self, out: W) -> Encoder<'a, W> {
        let [width, height] = self.size;
        let mut encoder = Encoder::new(out, width, height);
        encoder.set_color(self.color);
        encoder.set_depth(BitDepth::Eight);
        encoder.set_compression(Compression::Fast);
        encoder
    }

    pub fn write(
        &self,
        texts: &[(&str, String)],
        dpi: Option<u32>,
        mut out: impl Write,
    ) -> io::Result<()> {
        let mut head = Vec::new();
        let mut encoder = self.encoder(&mut head);
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
        // A writer that has nothing to write ends the file all the same.
        drop(encoder.write_header()?);
        head.truncate(head.len().saturating_sub(END));
        out.write_all(&head)?;
        out.write_all(&self.rest)
    }
}

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
    Packed::new(picture)?.write(texts, dpi, out)
}
