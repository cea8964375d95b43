//! WebP's animations, by libwebp: with loss, and small.

use std::fs::File;
use std::io::{self, Write};
use std::sync::Arc;

use webp_animation::{Encoder, EncoderOptions, EncodingConfig};

use super::Encode;
use crate::output::RepeatedPicture;

/// It counts milliseconds.
pub const RATE: f64 = 1000.0;

/// Of 100.
const QUALITY: f32 = 85.0;

/// From 0, the quickest, to 6, the smallest.
const METHOD: usize = 3;

pub struct Webp {
    file: File,
    encoder: Encoder,
    /// When the next picture begins, in milliseconds.
    time: i32,
}

impl Webp {
    pub fn new(file: File, size: [u32; 2]) -> io::Result<Webp> {
        let encoding = EncodingConfig { method: METHOD, ..EncodingConfig::new_lossy(QUALITY) };
        let options =
            EncoderOptions { encoding_config: Some(encoding), ..EncoderOptions::default() };
        let encoder = Encoder::new_with_options((size[0], size[1]), options).map_err(failed)?;
        Ok(Webp { file, encoder, time: 0 })
    }
}

impl Encode for Webp {
    fn add(&mut self, picture: &Arc<RepeatedPicture>, steps: u64) -> io::Result<()> {
        self.encoder.add_frame(picture.picture().to_rgba8().as_raw(), self.time).map_err(failed)?;
        self.time = self.time.saturating_add(i32::try_from(steps).unwrap_or(i32::MAX));
        Ok(())
    }

    fn finish(self: Box<Self>) -> io::Result<()> {
        let Webp { mut file, encoder, time } = *self;
        file.write_all(&encoder.finalize(time).map_err(failed)?)
    }
}

fn failed(error: webp_animation::Error) -> io::Error {
    io::Error::other(format!("libwebp: {error:?}"))
}
