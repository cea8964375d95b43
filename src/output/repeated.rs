//! Pictures that are written to many files.

use std::io;
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

use image::DynamicImage;

use super::picture::{PictureFormat, encode};
use super::png::Packed;
use super::{OutputError, write_inside};

/// A picture that may be written to many files of one format, each with its own texts: it is compressed once.
pub struct RepeatedPicture {
    picture: DynamicImage,
    made: Mutex<Option<(PictureFormat, Arc<Made>)>>,
}

/// A compressed picture.
enum Made {
    Png(Packed),
    /// A whole file, without texts.
    Other(Vec<u8>),
}

impl RepeatedPicture {
    pub fn new(picture: DynamicImage) -> RepeatedPicture {
        RepeatedPicture { picture, made: Mutex::default() }
    }

    pub fn picture(&self) -> &DynamicImage {
        &self.picture
    }

    /// Writes the file that [`write_picture`](super::write_picture) would, in a folder of ours: a link of that name is
    /// replaced.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn write(
        &self,
        path: &Path,
        format: PictureFormat,
        texts: &[(&str, String)],
    ) -> Result<(), OutputError> {
        write_inside(path, |out| match &*self.made(format)? {
            Made::Png(packed) => packed.write(texts, None, out),
            Made::Other(bytes) => out.write_all(bytes),
        })
    }

    /// How long its file is, without texts.
    ///
    /// # Errors
    /// When it cannot be encoded.
    pub fn bytes(&self, format: PictureFormat) -> io::Result<usize> {
        self.of_file(format, <[u8]>::len)
    }

    /// The CRC-32 of its file, without texts.
    ///
    /// # Errors
    /// When it cannot be encoded.
    pub fn crc32(&self, format: PictureFormat) -> io::Result<u32> {
        self.of_file(format, crc32fast::hash)
    }

    /// What `tell` says of its file without texts.
    fn of_file<T>(&self, format: PictureFormat, tell: impl FnOnce(&[u8]) -> T) -> io::Result<T> {
        match &*self.made(format)? {
            Made::Png(packed) => {
                let mut file = Vec::new();
                packed.write(&[], None, &mut file)?;
                Ok(tell(&file))
            }
            Made::Other(bytes) => Ok(tell(bytes)),
        }
    }

    /// Those who come while it is made wait for it.
    fn made(&self, format: PictureFormat) -> io::Result<Arc<Made>> {
        let mut made = self.made.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, made)) = made.as_ref().filter(|(known, _)| *known == format) {
            return Ok(made.clone());
        }
        let new = Arc::new(match format {
            PictureFormat::Png => Made::Png(Packed::new(&self.picture)?),
            other => {
                let mut bytes = Vec::new();
                encode(other, &self.picture, &[], None, &mut bytes)?;
                Made::Other(bytes)
            }
        });
        *made = Some((format, new.clone()));
        Ok(new)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::write_picture;
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
            repeated.write(&again, PictureFormat::Png, &texts).unwrap();
            write_picture(&once, &picture, &texts, None).unwrap();
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
