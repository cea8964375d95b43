//! What a pixel shows, and as which bytes.

use image::{DynamicImage, Rgb as Rgb8, RgbImage, Rgba, RgbaImage};
use rayon::prelude::*;

use super::plane::{Plane, Spot};

/// Red, green, blue and alpha, not multiplied.
pub type Stored = [u8; 4];

/// A pixel as a picture stores it: of red, green and blue, each from 0 to 1 and times cover, and cover, how much of it is
/// not transparent. The colour of what is hardly there is that of what is there.
#[inline(always)]
pub fn stored([red, green, blue, cover]: [f64; 4]) -> Stored {
    let whole = if cover > 0.0 { cover } else { 1.0 };
    [byte(red / whole), byte(green / whole), byte(blue / whole), byte(cover)]
}

#[inline(always)]
fn byte(share: f64) -> u8 {
    (share.clamp(0.0, 1.0) * 255.0 + 0.5) as u8
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
