//! Pictures in the formats that their files' names ask for.

use std::io::{self, Cursor, Write};
use std::path::Path;

use image::codecs::jpeg::{JpegEncoder, PixelDensity};
use image::codecs::tiff::TiffEncoder;
use image::codecs::webp::WebPEncoder;
use image::{DynamicImage, ImageEncoder, ImageError};

use super::bmp::encode_bmp;
use super::png::encode_png;
use super::{OutputError, of_image, write_whole};

/// What a single picture may be written as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PictureFormat {
    Png,
    /// The others have no texts.
    Jpeg,
    Bmp,
    Tiff,
    /// Without loss.
    Webp,
}

/// The endings of formats, the usual one of each first.
pub const FORMATS: [(&str, PictureFormat); 7] = [
    ("png", PictureFormat::Png),
    ("jpg", PictureFormat::Jpeg),
    ("bmp", PictureFormat::Bmp),
    ("tiff", PictureFormat::Tiff),
    ("webp", PictureFormat::Webp),
    ("jpeg", PictureFormat::Jpeg),
    ("tif", PictureFormat::Tiff),
];

/// Of 100; nobody sees what is lost.
const JPEG_QUALITY: u8 = 92;

impl PictureFormat {
    /// The format of a file by the ending of its name, whatever its case; PNG without one. `None`
    /// when no format has such an ending.
    pub fn of(path: &Path) -> Option<PictureFormat> {
        path.extension()
            .map_or(Some(PictureFormat::Png), |ending| PictureFormat::named(ending.to_str()?))
    }

    /// The format with that ending, whatever its case.
    pub fn named(ending: &str) -> Option<PictureFormat> {
        let found = FORMATS.iter().find(|(known, _)| ending.eq_ignore_ascii_case(known));
        found.map(|(_, format)| *format)
    }

    /// The usual ending of its files.
    pub fn ending(self) -> &'static str {
        FORMATS.iter().find(|(_, format)| *format == self).map_or("png", |(ending, _)| ending)
    }

    /// Whether a picture can be read from its file as it was.
    pub fn is_exact(self) -> bool {
        self != PictureFormat::Jpeg
    }

    /// Whether a picture's file tells its own fingerprint, and each flipped bit of it is noticed.
    pub fn is_sealed(self) -> bool {
        self == PictureFormat::Png
    }

    /// Whether it can say what is transparent.
    pub fn has_alpha(self) -> bool {
        matches!(self, PictureFormat::Png | PictureFormat::Tiff | PictureFormat::Webp)
    }
}

/// Encodes `picture`; `texts` (keyword, text) go into its text chunks where the format has such, and `dpi`, the pixels an
/// inch of paper, into its header where it has a place for it. What is transparent keeps the colour that it has where the
/// format has no alpha channel.
///
/// # Errors
/// What `out` gives.
pub fn encode(
    format: PictureFormat,
    picture: &DynamicImage,
    texts: &[(&str, String)],
    dpi: Option<u32>,
    mut out: impl Write,
) -> io::Result<()> {
    let mut bytes = Vec::new();
    let done = match format {
        PictureFormat::Png => return encode_png(picture, texts, dpi, out),
        PictureFormat::Bmp => return encode_bmp(picture, dpi, out),
        PictureFormat::Jpeg => {
            let mut encoder = JpegEncoder::new_with_quality(&mut bytes, JPEG_QUALITY);
            if let Some(dpi) = dpi.and_then(|dpi| u16::try_from(dpi).ok()) {
                encoder.set_pixel_density(PixelDensity::dpi(dpi));
            }
            encoder.encode_image(&picture.to_rgb8())
        }
        PictureFormat::Tiff => written(picture, TiffEncoder::new(Cursor::new(&mut bytes))),
        PictureFormat::Webp => written(picture, WebPEncoder::new_lossless(&mut bytes)),
    };
    done.map_err(of_image)?;
    out.write_all(&bytes)
}

fn written(picture: &DynamicImage, encoder: impl ImageEncoder) -> Result<(), ImageError> {
    picture.write_with_encoder(encoder)
}

/// Writes `picture` as the ending of `path` asks, PNG when no format does, as [`encode`] encodes it.
///
/// # Errors
/// When the file cannot be written.
pub fn write_picture(
    path: &Path,
    picture: &DynamicImage,
    texts: &[(&str, String)],
    dpi: Option<u32>,
) -> Result<(), OutputError> {
    let format = PictureFormat::of(path).unwrap_or(PictureFormat::Png);
    write_whole(path, |out| encode(format, picture, texts, dpi, out))
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{ImageFormat, Rgb, RgbImage};

    fn picture() -> DynamicImage {
        RgbImage::from_fn(33, 20, |x, y| Rgb([x as u8 * 7, y as u8 * 12, 128])).into()
    }

    /// All that are exact give back what they were given.
    #[test]
    fn each_format_can_be_read_again() {
        for (ending, format) in FORMATS {
            let mut bytes = Vec::new();
            encode(format, &picture(), &[], Some(300), &mut bytes).unwrap();
            let known = ImageFormat::from_extension(ending).unwrap();
            let read = image::load_from_memory_with_format(&bytes, known).unwrap().to_rgb8();
            let furthest = read.iter().zip(picture().as_bytes()).map(|(a, b)| a.abs_diff(*b)).max();
            let allowed = if format.is_exact() { 0 } else { 12 };
            assert!(furthest <= Some(allowed), "{ending}: {furthest:?}");
        }
    }

    #[test]
    fn alpha_is_kept_by_those_that_say_so() {
        let clear =
            DynamicImage::ImageRgba8(image::RgbaImage::from_pixel(4, 4, image::Rgba([1, 2, 3, 0])));
        for (ending, format) in FORMATS {
            let mut bytes = Vec::new();
            encode(format, &clear, &[], None, &mut bytes).unwrap();
            let known = ImageFormat::from_extension(ending).unwrap();
            let read = image::load_from_memory_with_format(&bytes, known).unwrap().to_rgba8();
            assert_eq!(read.get_pixel(0, 0)[3] == 0, format.has_alpha(), "{ending}");
        }
    }
}
