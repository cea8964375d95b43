//! The clock's painted face: two windows with digits, and a dial under each.

use glam::{DVec2, DVec3};
use image::RgbImage;

use super::dial::Dial;
use super::digits;
use super::reading::Reading;

/// Texels a world unit of the face.
const TEXELS: f64 = 48.0;

const FACE: DVec3 = DVec3::new(0.32, 0.24, 0.17);
const WINDOW: DVec3 = DVec3::new(0.74, 0.79, 0.68);
const BEZEL: DVec3 = DVec3::new(0.06, 0.06, 0.06);
pub const INK: DVec3 = DVec3::new(0.08, 0.07, 0.07);
pub const RED: DVec3 = DVec3::new(0.75, 0.1, 0.08);
const LAMP: DVec3 = DVec3::new(0.35, 0.95, 0.3);
const NO_LAMP: DVec3 = DVec3::new(0.12, 0.16, 0.1);

/// What is free between the parts, in world units.
const FREE: f64 = 0.16;

/// How high the windows are, and their digits.
const WINDOW_HEIGHT: f64 = 1.62;
const DIGIT_HEIGHT: f64 = 1.2;

/// How wide the black border of a window is, and what is free on its left and right.
const BEZEL_WIDTH: f64 = 0.09;
const PADDING: f64 = 0.12;

const LAMP_RADIUS: f64 = 0.2;

/// The colour of a texel of `color` that a shape covers as far as `outside`, in world units, says.
pub fn covered(color: DVec3, with: DVec3, outside: f64) -> DVec3 {
    color.lerp(with, (0.5 - outside * TEXELS).clamp(0.0, 1.0))
}

/// Paints a face of `width` × `height` world units: what its left half shows, and its right one.
pub fn paint(width: f64, height: f64, readings: &[Reading; 2]) -> RgbImage {
    let halves = [0.0, 0.5].into_iter().zip(readings).map(|(share, reading)| {
        Half::new(DVec2::new(share * width, 0.0), DVec2::new(width / 2.0, height), reading)
    });
    let halves: Vec<Half> = halves.collect();
    let texels = |length: f64| (length * TEXELS) as u32;
    RgbImage::from_fn(texels(width), texels(height), |x, y| {
        let at = (DVec2::new(f64::from(x), f64::from(y)) + 0.5) / TEXELS;
        let half = &halves[usize::from(at.x > width / 2.0)];
        let color = half.color(DVec2::new(at.x, height - at.y));
        image::Rgb(color.to_array().map(|channel| (channel * 255.0 + 0.5) as u8))
    })
}

/// One player's half of the face.
struct Half<'a> {
    reading: &'a Reading,
    dial: Dial,
    /// The window's middle, and half of its width and height.
    window: DVec2,
    half_window: DVec2,
    /// Where the digits begin, and how high they are.
    text: DVec2,
    scale: f64,
    lamp: DVec2,
}

impl<'a> Half<'a> {
    /// The half of `size` with its lower left corner at `corner`.
    fn new(corner: DVec2, size: DVec2, reading: &'a Reading) -> Half<'a> {
        let half_window = DVec2::new(size.x / 2.0 - FREE, WINDOW_HEIGHT / 2.0);
        let window = corner + DVec2::new(size.x / 2.0, size.y - FREE - half_window.y);
        let below = size.y - WINDOW_HEIGHT - 2.0 * FREE;
        let radius = (below - FREE).min(size.x) / 2.0;
        let room = 2.0 * (half_window.x - BEZEL_WIDTH - PADDING);
        let width = digits::width(&reading.window);
        let scale = DIGIT_HEIGHT.min(room / width);
        let text = window - DVec2::new(width, 1.0) * scale / 2.0;
        let is_left = corner.x == 0.0;
        let inner = if is_left { size.x - 2.0 * LAMP_RADIUS } else { 2.0 * LAMP_RADIUS };
        Half {
            reading,
            dial: Dial::new(corner + DVec2::new(size.x / 2.0, FREE + radius), radius, reading),
            window,
            half_window,
            text,
            scale,
            lamp: corner + DVec2::new(inner, below - 1.5 * LAMP_RADIUS),
        }
    }

    /// The colour at `point` (y upwards).
    fn color(&self, point: DVec2) -> DVec3 {
        let beyond = ((point - self.window).abs() - self.half_window).max_element();
        if beyond > 0.5 / TEXELS {
            let lamp = if self.reading.is_running { LAMP } else { NO_LAMP };
            let outside_lamp = point.distance(self.lamp) - LAMP_RADIUS;
            let color = covered(FACE, BEZEL, outside_lamp - 0.04);
            return self.dial.paint(point, covered(color, lamp, outside_lamp));
        }
        let color = covered(covered(FACE, BEZEL, beyond), WINDOW, beyond + BEZEL_WIDTH);
        let ink = if self.reading.is_out { RED } else { INK };
        let outside = digits::outside(&self.reading.window, (point - self.text) / self.scale);
        covered(color, ink, outside * self.scale)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn reading(window: &str) -> Reading {
        Reading { hands: 0, window: window.to_owned(), flag: 0.0, is_out: false, is_running: false }
    }

    /// Shares of texels of a part of the face that are near a colour.
    fn share(picture: &RgbImage, left: bool, color: DVec3) -> f64 {
        let half = picture.width() / 2;
        let near = |pixel: &image::Rgb<u8>| {
            let found = DVec3::from_array(pixel.0.map(|byte| f64::from(byte) / 255.0));
            found.distance(color) < 0.02
        };
        let pixels = picture.enumerate_pixels().filter(|(x, ..)| (*x < half) == left);
        let found = pixels.filter(|(_, _, pixel)| near(pixel)).count();
        found as f64 / f64::from(half * picture.height())
    }

    #[test]
    fn digits_fit_into_their_window() {
        for window in ["8:88:88", "88:88:88", "100:00:00", "0:09", "-:--"] {
            let readings = [reading(window), reading("0:00")];
            let half = Half::new(DVec2::ZERO, DVec2::new(5.55, 5.9), &readings[0]);
            let end = half.text.x + half.scale * digits::width(window);
            let inner = half.half_window.x - BEZEL_WIDTH;
            assert!(half.text.x > half.window.x - inner && end < half.window.x + inner, "{window}");
        }
    }

    #[test]
    fn each_half_shows_its_own_reading() {
        let quiet = paint(11.1, 5.9, &[reading("1:11"), reading("1:11")]);
        let out = Reading { is_out: true, is_running: true, ..reading("1:11") };
        let [left, right] = [
            paint(11.1, 5.9, &[out.clone(), reading("1:11")]),
            paint(11.1, 5.9, &[reading("1:11"), out]),
        ];
        for (picture, is_left) in [(left, true), (right, false)] {
            for color in [LAMP, RED] {
                let before = [true, false].map(|half| share(&quiet, half, color));
                let after = [true, false].map(|half| share(&picture, half, color));
                let [own, other] = if is_left { [0, 1] } else { [1, 0] };
                assert!(after[own] > before[own] + 0.002, "{is_left}, {color}: {after:?}");
                assert_eq!(after[other], before[other]);
            }
        }
    }
}
