//! Brightness and colour apart, as films have them: ITU-R BT.709, 16 to 235, with a colour for each 2 × 2 pixels.

use image::DynamicImage;

/// Planes of Y, Cb and Cr, one after the other.
pub struct Yuv {
    size: [usize; 2],
    bytes: Vec<u8>,
}

/// The share of red, green and blue in brightness, in parts of 2¹⁶ (BT.709, 3.2), of 219 steps for 255.
const RED: i32 = 11_966;
const GREEN: i32 = 40_254;
const BLUE: i32 = 4_064;

impl Yuv {
    /// For pictures of an even width and height.
    pub fn new([width, height]: [u32; 2]) -> Yuv {
        let size = [width as usize, height as usize];
        Yuv { size, bytes: vec![0; size[0] * size[1] * 3 / 2] }
    }

    /// All three planes.
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// Y, Cb and Cr.
    #[cfg(feature = "h264")]
    pub fn planes(&self) -> [&[u8]; 3] {
        let [width, height] = self.size;
        let (y, rest) = self.bytes.split_at(width * height);
        let (cb, cr) = rest.split_at(rest.len() / 2);
        [y, cb, cr]
    }

    /// Takes a picture that is as large, or a column or row larger; what is transparent is as dark as it is.
    pub fn read(&mut self, picture: &DynamicImage) {
        let rgb = match picture {
            DynamicImage::ImageRgb8(rgb) => std::borrow::Cow::Borrowed(rgb),
            other => std::borrow::Cow::Owned(other.to_rgb8()),
        };
        let [width, height] = self.size;
        let pitch = 3 * rgb.width() as usize;
        let (y, rest) = self.bytes.split_at_mut(width * height);
        let (cb, cr) = rest.split_at_mut(width * height / 4);
        let rows = rgb.as_raw().chunks_exact(2 * pitch);
        let colors = cb.chunks_exact_mut(width / 2).zip(cr.chunks_exact_mut(width / 2));
        for ((rows, y), (cb, cr)) in rows.zip(y.chunks_exact_mut(2 * width)).zip(colors) {
            let (upper, lower) = rows.split_at(pitch);
            let (y_upper, y_lower) = y.split_at_mut(width);
            bright(upper, y_upper);
            bright(lower, y_lower);
            let pairs = upper.chunks_exact(6).zip(lower.chunks_exact(6));
            for ((upper, lower), (cb, cr)) in pairs.zip(cb.iter_mut().zip(cr)) {
                let sum = |channel: usize| {
                    let four =
                        [upper[channel], upper[channel + 3], lower[channel], lower[channel + 3]];
                    four.iter().map(|value| i32::from(*value)).sum::<i32>()
                };
                let [red, green, blue] = [sum(0), sum(1), sum(2)];
                (*cb, *cr) = (
                    chroma(-6_596 * red - 22_189 * green + 28_785 * blue),
                    chroma(28_785 * red - 26_145 * green - 2_640 * blue),
                );
            }
        }
    }
}

fn bright(rgb: &[u8], y: &mut [u8]) {
    for (pixel, y) in rgb.chunks_exact(3).zip(y) {
        let [red, green, blue] = [pixel[0], pixel[1], pixel[2]].map(i32::from);
        *y = (16 + ((RED * red + GREEN * green + BLUE * blue + (1 << 15)) >> 16)) as u8;
    }
}

/// Of a sum of four pixels in parts of 2¹⁶, of 112 steps for 255.
fn chroma(sum: i32) -> u8 {
    (128 + ((sum + (1 << 17)) >> 18)) as u8
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{Rgb, RgbImage};

    /// The formulas of BT.709, 3.2 to 3.5, in f64.
    fn expected([red, green, blue]: [u8; 3]) -> [f64; 3] {
        let [red, green, blue] = [red, green, blue].map(|value| f64::from(value) / 255.0);
        let y = 0.2126 * red + 0.7152 * green + 0.0722 * blue;
        [16.0 + 219.0 * y, 128.0 + 224.0 * (blue - y) / 1.8556, 128.0 + 224.0 * (red - y) / 1.5748]
    }

    #[test]
    fn colors_are_those_of_the_standard() {
        for red in (0..=255).step_by(15) {
            for green in (0..=255).step_by(15) {
                for blue in (0..=255).step_by(51) {
                    let color = [red, green, blue];
                    let mut yuv = Yuv::new([4, 2]);
                    yuv.read(&RgbImage::from_pixel(5, 3, Rgb(color)).into());
                    let found = [yuv.bytes[0], yuv.bytes[8], yuv.bytes[10]].map(f64::from);
                    for (found, expected) in found.into_iter().zip(expected(color)) {
                        assert!((found - expected).abs() <= 0.51, "{color:?}: {found} {expected}");
                    }
                }
            }
        }
    }
}
