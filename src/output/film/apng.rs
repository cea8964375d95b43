//! APNG: without loss, each picture no more than what it changes.

use std::fs::File;
use std::io::{self, BufWriter};
use std::sync::Arc;

use png::{BitDepth, BlendOp, ColorType, Compression, DisposeOp, Encoder, Writer};

use super::patch::Patch;
use super::{Cut, Encode};
use crate::output::RepeatedPicture;

/// It can count anything; milliseconds are fine enough.
pub const RATE: f64 = 1000.0;

/// The longest that a picture can stand.
const MOST: u64 = u16::MAX as u64;

pub struct Apng {
    writer: Writer<BufWriter<File>>,
    is_transparent: bool,
    last: Option<Arc<RepeatedPicture>>,
}

impl Apng {
    /// For pictures that stand for so many steps each; those that stand for none are no frames.
    pub fn new(file: File, cut: &Cut, steps: &[u64]) -> io::Result<Apng> {
        let [width, height] = cut.size;
        let frames = steps.iter().map(|steps| steps.div_ceil(MOST)).sum::<u64>();
        let mut encoder = Encoder::new(BufWriter::new(file), width, height);
        encoder.set_color(ColorType::Rgba);
        encoder.set_depth(BitDepth::Eight);
        encoder.set_compression(Compression::Balanced);
        encoder.set_animated(u32::try_from(frames).unwrap_or(u32::MAX), 0)?;
        encoder.set_dispose_op(DisposeOp::None)?;
        let writer = encoder.write_header()?;
        Ok(Apng { writer, is_transparent: cut.is_transparent, last: None })
    }

    /// Writes a frame that is laid over, or takes the place of, what was there.
    fn write(&mut self, patch: Patch, pixels: &[u8], blend: BlendOp, steps: u64) -> io::Result<()> {
        let writer = &mut self.writer;
        writer.reset_frame_position()?;
        writer.set_frame_dimension(patch.width, patch.height)?;
        writer.set_frame_position(patch.left, patch.top)?;
        writer.set_frame_delay(steps as u16, RATE as u16)?;
        writer.set_blend_op(blend)?;
        writer.write_image_data(pixels)?;
        Ok(())
    }
}

impl Encode for Apng {
    fn add(&mut self, added: &Arc<RepeatedPicture>, steps: u64) -> io::Result<()> {
        let picture = added.picture();
        let patch = match &self.last {
            Some(last) => Patch::between(last.picture(), picture),
            None => Patch::whole([picture.width(), picture.height()]),
        };
        // What becomes transparent again cannot be laid over what is there.
        let last = self.last.as_ref().filter(|_| !self.is_transparent);
        let (pixels, blend) = match last {
            Some(last) => (patch.change(last.picture(), picture), BlendOp::Over),
            None => (patch.of(picture), BlendOp::Source),
        };
        self.write(patch, pixels.as_raw(), blend, steps.min(MOST))?;
        let mut rest = steps.saturating_sub(MOST);
        while rest > 0 {
            self.write(Patch::PIXEL, &[0; 4], BlendOp::Over, rest.min(MOST))?;
            rest = rest.saturating_sub(MOST);
        }
        self.last = Some(added.clone());
        Ok(())
    }

    fn finish(self: Box<Self>) -> io::Result<()> {
        Ok(self.writer.finish()?)
    }
}
