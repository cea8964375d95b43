//! What a pixel shows, and as which bytes.

use image::{DynamicImage, Rgb as Rgb8, RgbImage, Rgba, RgbaImage};
use rayon::prelude::*;

use super::plane::{Plane, Spot};
use crate::scene::Rgb;

/// What a pixel, or a part of it, shows. The mean of any number of equal ones is the same again: sums of so few
/// f32 are exact in f64.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pixel {
    /// As it is stored, 0 to 1, times `cover`.
    pub color: Rgb,
    /// How much of it is not transparent, 0 to 1.
    pub cover: f64,
}

/// Red, green, blue and alpha, not multiplied.
pub type Stored = [u8; 4];

impl Pixel {
    /// As a picture stores it; the colour of what is hardly there is that of what is there.
    pub fn stored(self) -> Stored {
        let color = match self.cover {
            1.0 => self.color,
            0.0 => Rgb::ZERO,
            cover => self.color / cover,
        };
        let [red, green, blue] = color.to_array().map(byte);
        [red, green, blue, byte(self.cover)]
    }
}

fn byte(share: f64) -> u8 {
    (share.clamp(0.0, 1.0) * 255.0 + 0.5) as u8
}

impl std::ops::Add for Pixel {
    type Output = Pixel;

    fn add(self, other: Pixel) -> Pixel {
        Pixel { color: self.color + other.color, cover: self.cover + other.cover }
    }
}

impl std::ops::Div<f64> for Pixel {
    type Output = Pixel;

    fn div(self, by: f64) -> Pixel {
        Pixel { color: self.color / by, cover: self.cover / by }
    }
}

/// The picture, with its alpha channel only if it is said to be transparent.
pub fn picture(pixels: &Plane<Stored>, is_transparent: bool) -> DynamicImage {
    let (width, height) = (pixels.width, pixels.height);
    let picture = if is_transparent {
        let bytes = pixels.values().as_flattened().to_vec();
        RgbaImage::from_raw(width, height, bytes).map(DynamicImage::ImageRgba8)
    } else {
        RgbImage::from_raw(width, height, opaque(pixels.values())).map(DynamicImage::ImageRgb8)
    };
    picture.unwrap_or_default()
}

/// Changes some pixels of a picture.
pub fn set(picture: &mut DynamicImage, pixels: impl Iterator<Item = (Spot, Stored)>) {
    match picture {
        DynamicImage::ImageRgb8(picture) => pixels.for_each(|([x, y], [red, green, blue, _])| {
            picture.put_pixel(x, y, Rgb8([red, green, blue]));
        }),
        DynamicImage::ImageRgba8(picture) => {
            pixels.for_each(|([x, y], stored)| picture.put_pixel(x, y, Rgba(stored)));
        }
        // Pictures are made of no other kind.
        _ => {}
    }
}

/// How many pixels a thread converts at a time.
const RUN: usize = 1 << 14;

/// Red, green and blue alone.
fn opaque(pixels: &[Stored]) -> Vec<u8> {
    let mut bytes = vec![0; 3 * pixels.len()];
    bytes.par_chunks_mut(3 * RUN).zip(pixels.par_chunks(RUN)).for_each(|(bytes, pixels)| {
        for (bytes, [red, green, blue, _]) in bytes.chunks_exact_mut(3).zip(pixels) {
            (bytes[0], bytes[1], bytes[2]) = (*red, *green, *blue);
        }
    });
    bytes
}
