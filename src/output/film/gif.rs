//! GIF: each picture has a palette of its own, for what it changes.

use std::fs::File;
use std::io::{self, BufWriter};

use gif::{DisposalMethod, Encoder, Frame, Repeat};
use image::{DynamicImage, RgbaImage};
use imagequant::{Attributes, RGBA};

use super::Encode;
use super::patch::Patch;

/// It counts hundredths of a second; browsers take one that is shorter than two for a tenth.
pub const RATE: f64 = 100.0;
pub const LEAST: u64 = 2;

/// How much of the error of a pixel's colour goes to those beside it, of 1.
const DITHER: f32 = 0.7;

/// From 1, the best palettes, to 10, the quickest.
const SPEED: i32 = 7;

pub struct Gif {
    encoder: Encoder<BufWriter<File>>,
    last: Option<DynamicImage>,
}

impl Gif {
    pub fn new(file: File, size: [u32; 2]) -> io::Result<Gif> {
        let [width, height] = size.map(|side| u16::try_from(side).unwrap_or(u16::MAX));
        let mut encoder =
            Encoder::new(BufWriter::new(file), width, height, &[]).map_err(io::Error::other)?;
        encoder.set_repeat(Repeat::Infinite).map_err(io::Error::other)?;
        Ok(Gif { encoder, last: None })
    }

    /// Writes a frame, or one of a single pixel more for each time that is longer than a frame's can be.
    fn write(&mut self, frame: Frame<'_>, steps: u64) -> io::Result<()> {
        let most = u64::from(u16::MAX);
        let first = steps.min(most);
        let mut rest = steps - first;
        let delay = first as u16;
        self.encoder.write_frame(&Frame { delay, ..frame }).map_err(io::Error::other)?;
        while rest > 0 {
            let delay = rest.min(most) as u16;
            rest -= u64::from(delay);
            let pixel = Frame {
                delay,
                dispose: DisposalMethod::Keep,
                transparent: Some(0),
                width: 1,
                height: 1,
                palette: Some(vec![0; 3]),
                buffer: vec![0].into(),
                ..Frame::default()
            };
            self.encoder.write_frame(&pixel).map_err(io::Error::other)?;
        }
        Ok(())
    }
}

impl Encode for Gif {
    fn add(&mut self, picture: &DynamicImage, steps: u64) -> io::Result<()> {
        let size = [picture.width(), picture.height()];
        // What becomes transparent again can only be so by being taken away.
        let is_clear = picture.color().has_alpha();
        let (patch, change) = match self.last.as_ref().filter(|_| !is_clear) {
            Some(last) => {
                let patch = Patch::between(last, picture);
                (patch, patch.change(last, picture))
            }
            None => (Patch::whole(size), picture.to_rgba8()),
        };
        let dispose = if is_clear { DisposalMethod::Background } else { DisposalMethod::Keep };
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
        self.last = Some(picture.clone());
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
        let opaque: Vec<usize> = (0..palette.len()).filter(|index| palette[*index].a > 0).collect();
        let number = opaque.len().min(255) as u8;
        let mut numbers = vec![0; 256];
        for (new, old) in (0..=255_u8).zip(&opaque) {
            numbers[*old] = new;
        }
        for (index, is_clear) in buffer.iter_mut().zip(&clear) {
            *index = if *is_clear { number } else { numbers[usize::from(*index)] };
        }
        let colors = opaque.iter().map(|index| palette[*index]);
        let mut palette: Vec<u8> = colors.flat_map(|color| [color.r, color.g, color.b]).collect();
        if has_clear {
            palette.extend([0; 3]);
        }
        Ok(Colors { palette, transparent: has_clear.then_some(number), buffer })
    }
}
