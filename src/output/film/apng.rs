//! APNG: without loss, each picture no more than the rectangle that it changes.

use std::fs::File;
use std::io::{self, BufWriter};

use image::DynamicImage;
use png::{BitDepth, BlendOp, ColorType, Compression, DisposeOp, Encoder, Writer};

use super::Encode;
use super::patch::Patch;

/// It can count anything; milliseconds are fine enough.
pub const RATE: f64 = 1000.0;

/// The longest that a picture can stand.
const MOST: u64 = u16::MAX as u64;

pub struct Apng {
    size: [u32; 2],
    /// How many frames there will be.
    frames: u32,
    /// Until the first picture tells its kind there is no writer.
    state: State,
    last: Option<DynamicImage>,
}

enum State {
    Waiting(Option<File>),
    Writing(Writer<BufWriter<File>>),
}

impl Apng {
    /// For pictures that stand for so many steps each; those that stand for none are no frames.
    pub fn new(file: File, size: [u32; 2], steps: &[u64]) -> Apng {
        let frames = steps.iter().map(|steps| steps.div_ceil(MOST)).sum::<u64>();
        let frames = u32::try_from(frames).unwrap_or(u32::MAX);
        Apng { size, frames, state: State::Waiting(Some(file)), last: None }
    }

    fn writer(&mut self, color: ColorType) -> io::Result<&mut Writer<BufWriter<File>>> {
        if let State::Waiting(file) = &mut self.state {
            let file = file.take().ok_or(io::ErrorKind::BrokenPipe)?;
            let mut encoder = Encoder::new(BufWriter::new(file), self.size[0], self.size[1]);
            encoder.set_color(color);
            encoder.set_depth(BitDepth::Eight);
            encoder.set_compression(Compression::Balanced);
            encoder.set_animated(self.frames, 0)?;
            encoder.set_blend_op(BlendOp::Source)?;
            encoder.set_dispose_op(DisposeOp::None)?;
            self.state = State::Writing(encoder.write_header()?);
        }
        match &mut self.state {
            State::Writing(writer) => Ok(writer),
            State::Waiting(_) => Err(io::ErrorKind::BrokenPipe.into()),
        }
    }

    fn write(&mut self, patch: Patch, picture: &DynamicImage, steps: u64) -> io::Result<()> {
        let has_alpha = picture.color().has_alpha();
        let cut = picture.crop_imm(patch.left, patch.top, patch.width, patch.height);
        let (color, bytes) = if has_alpha {
            (ColorType::Rgba, cut.into_rgba8().into_raw())
        } else {
            (ColorType::Rgb, cut.into_rgb8().into_raw())
        };
        let writer = self.writer(color)?;
        writer.reset_frame_position()?;
        writer.set_frame_dimension(patch.width, patch.height)?;
        writer.set_frame_position(patch.left, patch.top)?;
        writer.set_frame_delay(steps as u16, RATE as u16)?;
        writer.write_image_data(&bytes)?;
        Ok(())
    }
}

impl Encode for Apng {
    fn add(&mut self, picture: &DynamicImage, steps: u64) -> io::Result<()> {
        let patch = match &self.last {
            Some(last) => Patch::between(last, picture),
            None => Patch::whole(self.size),
        };
        self.write(patch, picture, steps.min(MOST))?;
        let mut rest = steps.saturating_sub(MOST);
        while rest > 0 {
            let pixel = Patch { left: 0, top: 0, width: 1, height: 1 };
            self.write(pixel, picture, rest.min(MOST))?;
            rest = rest.saturating_sub(MOST);
        }
        self.last = Some(picture.clone());
        Ok(())
    }

    fn finish(self: Box<Self>) -> io::Result<()> {
        match self.state {
            State::Writing(writer) => Ok(writer.finish()?),
            State::Waiting(_) => Ok(()),
        }
    }
}
