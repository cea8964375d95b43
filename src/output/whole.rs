//! Whether a picture's file is whole.

use std::fs::{self, File};
use std::io::{self, BufReader, Read, Seek, SeekFrom};
use std::path::Path;

use image::{ImageFormat, ImageReader};

use super::picture::PictureFormat;

/// The first bytes of every PNG.
const SIGNATURE: [u8; 8] = *b"\x89PNG\r\n\x1a\n";

/// Whether the file at `path` is a picture of that format from its first byte to its last. In PNG each flipped bit is
/// noticed, in the other formats what keeps it from being decoded. What a link leads to is none of ours.
pub fn is_whole(path: &Path, format: PictureFormat) -> bool {
    let is_file = fs::symlink_metadata(path).is_ok_and(|data| data.is_file());
    is_file
        && match format {
            PictureFormat::Png => File::open(path).and_then(|file| ends_well(BufReader::new(file))),
            PictureFormat::Jpeg => is_jpeg(path),
            PictureFormat::Bmp => decodes(path, ImageFormat::Bmp),
            PictureFormat::Tiff => decodes(path, ImageFormat::Tiff),
            PictureFormat::Webp => decodes(path, ImageFormat::WebP),
        }
        .unwrap_or(false)
}

/// Whether chunks with right sums follow each other, and the last one ends the file.
fn ends_well(mut file: impl Read) -> io::Result<bool> {
    let mut signature = [0; 8];
    file.read_exact(&mut signature)?;
    if signature != SIGNATURE {
        return Ok(false);
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
            return Ok(false);
        }
        let mut sum = crc32fast::Hasher::new();
        sum.update(&kind);
        sum.update(&data);
        let mut told = [0; 4];
        file.read_exact(&mut told)?;
        if sum.finalize() != u32::from_be_bytes(told) {
            return Ok(false);
        }
        if &kind == b"IEND" {
            return Ok(file.read(&mut [0])? == 0);
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
            assert!(!is_whole(&path, format), "{ending}");
            write_picture(&path, &picture, &[("Ply", "1".to_owned())], None).unwrap();
            assert!(is_whole(&path, format), "{ending}");
            let bytes = fs::read(&path).unwrap();
            for length in [0, 1, 7, 20, bytes.len() / 2, bytes.len() * 3 / 4] {
                fs::write(&path, &bytes[..length]).unwrap();
                assert!(!is_whole(&path, format), "{ending}: {length}");
            }
        }
    }

    #[test]
    fn every_flipped_bit_of_a_png_is_noticed() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("x.png");
        write_picture(&path, &DynamicImage::new_rgb8(5, 4), &[("Ply", "1".to_owned())], None)
            .unwrap();
        let bytes = fs::read(&path).unwrap();
        for bit in 0..bytes.len() * 8 {
            let mut flipped = bytes.clone();
            flipped[bit / 8] ^= 1 << (bit % 8);
            assert!(!ends_well(&flipped[..]).unwrap_or(false), "{bit}");
        }
        assert!(!ends_well(&[&bytes[..], b"\0"].concat()[..]).unwrap());
    }
}
