//! Whether a picture's file is whole, and of what it should be.

use std::fs::{self, File};
use std::io::{self, BufReader, Read, Seek, SeekFrom};
use std::path::Path;

use image::{ImageFormat, ImageReader};

use super::picture::PictureFormat;

/// The first bytes of every PNG.
const SIGNATURE: [u8; 8] = *b"\x89PNG\r\n\x1a\n";

/// The keyword of the text in which a PNG says what it is made of.
pub const FINGERPRINT: &str = "Fingerprint";

/// Whether the file at `path` is a picture of that format from its first byte to its last. A PNG must say that it has that
/// `fingerprint`, and each flipped bit is noticed; in the other formats what keeps it from being decoded. What a link leads
/// to is none of ours.
pub fn is_whole(path: &Path, format: PictureFormat, fingerprint: &str) -> bool {
    let is_file = fs::symlink_metadata(path).is_ok_and(|data| data.is_file());
    is_file
        && match format {
            PictureFormat::Png => {
                let says = File::open(path).and_then(|file| fingerprint_of(BufReader::new(file)));
                says.map(|says| says.as_deref() == Some(fingerprint.as_bytes()))
            }
            PictureFormat::Jpeg => is_jpeg(path),
            PictureFormat::Bmp => decodes(path, ImageFormat::Bmp),
            PictureFormat::Tiff => decodes(path, ImageFormat::Tiff),
            PictureFormat::Webp => decodes(path, ImageFormat::WebP),
        }
        .unwrap_or(false)
}

/// The CRC-32 of all bytes of a file.
///
/// # Errors
/// When it cannot be read, or is none: what a link leads to is none of ours.
pub fn crc32_of(path: &Path) -> io::Result<u32> {
    if !fs::symlink_metadata(path)?.is_file() {
        return Err(io::ErrorKind::InvalidInput.into());
    }
    let mut file = File::open(path)?;
    let (mut sum, mut buffer) = (crc32fast::Hasher::new(), vec![0; 1 << 16]);
    loop {
        match file.read(&mut buffer)? {
            0 => return Ok(sum.finalize()),
            read => sum.update(&buffer[..read]),
        }
    }
}

/// The fingerprint of a PNG whose chunks follow each other with right sums, and whose last one ends the file.
fn fingerprint_of(mut file: impl Read) -> io::Result<Option<Vec<u8>>> {
    let mut fingerprint = None;
    let mut signature = [0; 8];
    file.read_exact(&mut signature)?;
    if signature != SIGNATURE {
        return Ok(None);
    }
    let mut data = Vec::new();
    loop {
        let mut head = [0; 8];
        file.read_exact(&mut head)?;
        let [a, b, c, d, kind @ ..] = head;
        let length = u64::from(u32::from_be_bytes([a, b, c, d]));
        data.clear();
        // No more than there is, whatever the length says.
        if file.by_ref().take(length).read_to_end(&mut data)? as u64 != length {
            return Ok(None);
        }
        let mut sum = crc32fast::Hasher::new();
        sum.update(&kind);
        sum.update(&data);
        let mut told = [0; 4];
        file.read_exact(&mut told)?;
        if sum.finalize() != u32::from_be_bytes(told) {
            return Ok(None);
        }
        if let Some(text) = data.strip_prefix(FINGERPRINT.as_bytes())
            && &kind == b"tEXt"
        {
            fingerprint = text.strip_prefix(b"\0").map(<[u8]>::to_vec);
        }
        if &kind == b"IEND" {
            return Ok(fingerprint.filter(|_| file.read(&mut [0]).is_ok_and(|read| read == 0)));
        }
    }
}

/// Whether it can be decoded, and comes to its end mark: its decoder makes do with less.
fn is_jpeg(path: &Path) -> io::Result<bool> {
    let mut last = [0; 2];
    let mut file = File::open(path)?;
    file.seek(SeekFrom::End(-2))?;
    file.read_exact(&mut last)?;
    Ok(last == [0xFF, 0xD9] && decodes(path, ImageFormat::Jpeg)?)
}

fn decodes(path: &Path, format: ImageFormat) -> io::Result<bool> {
    let reader = ImageReader::with_format(BufReader::new(File::open(path)?), format);
    Ok(reader.decode().is_ok())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::{FORMATS, write_picture};
    use image::{DynamicImage, Rgb, RgbImage};

    #[test]
    fn a_file_that_is_cut_is_not_whole() {
        let folder = tempfile::tempdir().unwrap();
        let picture: DynamicImage =
            RgbImage::from_fn(200, 100, |x, y| Rgb([x as u8, y as u8, (x * y) as u8])).into();
        for (ending, format) in FORMATS {
            let path = folder.path().join(format!("x.{ending}"));
            assert!(!is_whole(&path, format, "a7"), "{ending}");
            write_picture(&path, &picture, &[(FINGERPRINT, "a7".to_owned())], None).unwrap();
            assert!(is_whole(&path, format, "a7"), "{ending}");
            // The others have no texts.
            assert_eq!(is_whole(&path, format, "a"), format != PictureFormat::Png, "{ending}");
            let bytes = fs::read(&path).unwrap();
            for length in [0, 1, 7, 20, bytes.len() / 2, bytes.len() * 3 / 4] {
                fs::write(&path, &bytes[..length]).unwrap();
                assert!(!is_whole(&path, format, "a7"), "{ending}: {length}");
            }
        }
    }

    #[test]
    fn every_flipped_bit_of_a_png_is_noticed() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("x.png");
        let texts = [("Ply", "1".to_owned()), (FINGERPRINT, "a7".to_owned())];
        write_picture(&path, &DynamicImage::new_rgb8(5, 4), &texts, None).unwrap();
        let bytes = fs::read(&path).unwrap();
        for bit in 0..bytes.len() * 8 {
            let mut flipped = bytes.clone();
            flipped[bit / 8] ^= 1 << (bit % 8);
            assert_eq!(fingerprint_of(&flipped[..]).unwrap_or(None), None, "{bit}");
        }
        assert_eq!(fingerprint_of(&[&bytes[..], b"\0"].concat()[..]).unwrap(), None);
    }
}
