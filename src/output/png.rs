//! PNG with text chunks.

use std::borrow::Cow;
use std::io::{self, Write};
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

use image::DynamicImage;
use png::{BitDepth, ColorType, Compression, Encoder, PixelDimensions, Unit};

use super::{OutputError, per_metre, write_whole};

/// A compressed picture, for files with any texts.
struct Packed {
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
    fn new(picture: &DynamicImage) -> io::Result<Packed> {
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

    fn write(
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

/// A picture that may be written to many files, each with its own texts: it is compressed once.
pub struct RepeatedPicture {
    picture: DynamicImage,
    packed: Mutex<Option<Arc<Packed>>>,
}

impl RepeatedPicture {
    pub fn new(picture: DynamicImage) -> RepeatedPicture {
        RepeatedPicture { picture, packed: Mutex::default() }
    }

    pub fn picture(&self) -> &DynamicImage {
        &self.picture
    }

    /// Writes the file that [`write_png`] would.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn write_png(&self, path: &Path, texts: &[(&str, String)]) -> Result<(), OutputError> {
        write_whole(path, |out| self.packed()?.write(texts, None, out))
    }

    /// Those who come while it is packed wait for it.
    fn packed(&self) -> io::Result<Arc<Packed>> {
        let mut packed = self.packed.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(packed) = &*packed {
            return Ok(packed.clone());
        }
        let made = Arc::new(Packed::new(&self.picture)?);
        *packed = Some(made.clone());
        Ok(made)
    }
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

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn a_repeated_picture_is_written_with_the_texts_of_each_file() {
        let folder = tempfile::tempdir().unwrap();
        let picture = DynamicImage::from(image::RgbImage::from_fn(30, 20, |x, y| {
            image::Rgb([x as u8 * 8, y as u8 * 12, (x * y) as u8])
        }));
        let repeated = RepeatedPicture::new(picture.clone());
        let [once, again] = ["once.png", "again.png"].map(|name| folder.path().join(name));
        for text in ["1", "²"] {
            let texts = [("Ply", text.to_owned())];
            repeated.write_png(&again, &texts).unwrap();
            write_png(&once, &picture, &texts, None).unwrap();
            assert_eq!(fs::read(&again).unwrap(), fs::read(&once).unwrap());
            let decoder = png::Decoder::new(io::BufReader::new(fs::File::open(&again).unwrap()));
            let mut reader = decoder.read_info().unwrap();
            let mut bytes = vec![0; 30 * 20 * 3];
            reader.next_frame(&mut bytes).unwrap();
            assert_eq!(&bytes, picture.as_bytes());
            let info = reader.info();
            let plain = info.uncompressed_latin1_text.iter().map(|text| text.text.clone());
            let international = info.utf8_text.iter().map(|text| text.get_text().unwrap());
            assert_eq!(plain.chain(international).collect::<Vec<_>>(), [text]);
        }
    }
}
