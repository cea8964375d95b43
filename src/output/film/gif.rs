//! GIF: each picture has a palette of its own, for what it changes.

use std::fs::File;
use std::io::{self, BufWriter};
use std::sync::Arc;

use gif::{DisposalMethod, Encoder, Frame, Repeat};
use image::RgbaImage;
use imagequant::{Attributes, RGBA};

use super::patch::Patch;
use super::{Cut, Encode};
use crate::output::RepeatedPicture;

/// It counts hundredths of a second; browsers take one that is shorter than two for a tenth.
pub const RATE: f64 = 100.0;
pub const LEAST: u64 = 2;

/// How much of the error of a pixel's colour goes to those beside it, of 1.
const DITHER: f32 = 0.7;

/// From 1, the best palettes, to 10, the quickest.
const SPEED: i32 = 7;

pub struct Gif {
    encoder: Encoder<BufWriter<File>>,
    is_transparent: bool,
    last: Option<Arc<RepeatedPicture>>,
}

impl Gif {
    pub fn new(file: File, cut: &Cut) -> io::Result<Gif> {
        let [width, height] = cut.size.map(|side| u16::try_from(side).unwrap_or(u16::MAX));
        let mut encoder =
            Encoder::new(BufWriter::new(file), width, height, &[]).map_err(io::Error::other)?;
        encoder.set_repeat(Repeat::Infinite).map_err(io::Error::other)?;
        Ok(Gif { encoder, is_transparent: cut.is_transparent, last: None })
    }

    /// Writes a frame, and for times that are longer than a frame's can be more of them.
    fn write(&mut self, mut frame: Frame<'_>, steps: u64) -> io::Result<()> {
        let mut rest = steps;
        loop {
            frame.delay = rest.min(u64::from(u16::MAX)) as u16;
            self.encoder.write_frame(&frame).map_err(io::Error::other)?;
            rest -= u64::from(frame.delay);
            if rest == 0 {
                return Ok(());
            }
            // What is taken away is put there again; over what stays a pixel of nothing is enough.
            if frame.dispose == DisposalMethod::Keep {
                let pixel = Frame::from_palette_pixels(1, 1, vec![0], vec![0; 3], Some(0));
                frame = Frame { dispose: DisposalMethod::Keep, ..pixel };
            }
        }
    }
}

impl Encode for Gif {
    fn add(&mut self, added: &Arc<RepeatedPicture>, steps: u64) -> io::Result<()> {
        let picture = added.picture();
        let size = [picture.width(), picture.height()];
        // What becomes transparent again can only be so by being taken away.
        let last = self.last.as_ref().filter(|_| !self.is_transparent);
        let (patch, change) = match last.map(|last| last.picture()) {
            Some(last) => {
                let patch = Patch::between(last, picture);
                (patch, patch.change(last, picture))
            }
            None => (Patch::whole(size), picture.to_rgba8()),
        };
        let dispose =
            if self.is_transparent { DisposalMethod::Background } else { DisposalMethod::Keep };
        let Colors { palette, transparent, buffer } = Colors::of(change)?;
        let [left, top, width, height] =
            [patch.left, patch.top, patch.width, patch.height].map(|side| side as u16);
        let buffer = buffer.into();
        let palette = Some(palette);
        let frame = Frame {
            dispose,
            transparent,
            left,
            top,
            width,
            height,
            palette,
            buffer,
            ..Frame::default()
        };
        self.write(frame, steps)?;
        self.last = Some(added.clone());
        Ok(())
    }

    fn finish(self: Box<Self>) -> io::Result<()> {
        let file = self.encoder.into_inner().map_err(io::Error::other)?;
        file.into_inner().map_err(io::IntoInnerError::into_error)?;
        Ok(())
    }
}

/// A picture in at most 256 colours.
struct Colors {
    /// Red, green and blue of each.
    palette: Vec<u8>,
    transparent: Option<u8>,
    /// The pixels' colours by number.
    buffer: Vec<u8>,
}

impl Colors {
    /// Those of a picture whose pixels are opaque, or transparent where they are less than half opaque.
    fn of(picture: RgbaImage) -> io::Result<Colors> {
        let (width, height) = (picture.width() as usize, picture.height() as usize);
        let pixels: Vec<RGBA> = picture
            .pixels()
            .map(|pixel| match pixel.0 {
                [_, _, _, 0..128] => RGBA::new(0, 0, 0, 0),
                [red, green, blue, _] => RGBA::new(red, green, blue, 255),
            })
            .collect();
        let clear: Vec<bool> = pixels.iter().map(|pixel| pixel.a == 0).collect();
        if clear.iter().all(|is_clear| *is_clear) {
            let buffer = vec![0; clear.len()];
            return Ok(Colors { palette: vec![0; 3], transparent: Some(0), buffer });
        }
        let made = || {
            let mut attributes = Attributes::new();
            attributes.set_speed(SPEED)?;
            // One is kept for what is transparent.
            attributes.set_max_colors(255)?;
            let mut image = attributes.new_image(pixels, width, height, 0.0)?;
            let mut quantized = attributes.quantize(&mut image)?;
            quantized.set_dithering_level(DITHER)?;
            quantized.remapped(&mut image)
        };
        let (palette, mut buffer) = made().map_err(io::Error::other)?;
        let has_clear = clear.contains(&true);
        // Whatever the palette has for it: what did not change is not to be touched, and what did is.
        let mut numbers = [None; 256];
        let mut colors: Vec<[u8; 3]> = Vec::new();
        for (number, color) in numbers.iter_mut().zip(&palette).filter(|(_, color)| color.a > 0) {
            *number = Some(colors.len() as u8);
            colors.push([color.r, color.g, color.b]);
        }
        let number = colors.len() as u8;
        for ((index, is_clear), pixel) in buffer.iter_mut().zip(&clear).zip(picture.pixels()) {
            *index = match numbers[usize::from(*index)] {
                _ if *is_clear => number,
                Some(number) => number,
                None => nearest(&colors, pixel.0),
            };
        }
        let mut palette = colors.concat();
        if has_clear {
            palette.extend([0; 3]);
        }
        Ok(Colors { palette, transparent: has_clear.then_some(number), buffer })
    }
}

/// The colour that is nearest to a pixel's, by number.
fn nearest(colors: &[[u8; 3]], pixel: [u8; 4]) -> u8 {
    let distance = |color: &[u8; 3]| -> u32 {
        color.iter().zip(pixel).map(|(a, b)| u32::from(a.abs_diff(b)).pow(2)).sum()
    };
    (0..).zip(colors).min_by_key(|(_, color)| distance(color)).map_or(0, |(number, _)| number)
}
