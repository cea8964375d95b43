//! Drawing on pictures: letters, bars and discs with smooth edges.

use image::{Rgb, RgbImage};

/// A colour as it is written to pictures.
pub type Ink = [u8; 3];

/// A picture that is drawn on; what lies outside it is cut off.
pub struct Canvas {
    picture: RgbImage,
}

/// An upright rectangle in pixels, from the picture's upper left corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Area {
    pub left: f32,
    pub top: f32,
    pub right: f32,
    pub bottom: f32,
}

impl Canvas {
    pub fn new(picture: RgbImage) -> Canvas {
        Canvas { picture }
    }

    pub fn into_picture(self) -> RgbImage {
        self.picture
    }

    pub fn width(&self) -> f32 {
        self.picture.width() as f32
    }

    pub fn height(&self) -> f32 {
        self.picture.height() as f32
    }

    /// Lays `ink` over a pixel, as thick as `cover` (0 to 1) says.
    pub fn blend(&mut self, x: i64, y: i64, ink: Ink, cover: f32) {
        let (Ok(x), Ok(y)) = (u32::try_from(x), u32::try_from(y)) else {
            return;
        };
        if let Some(Rgb(below)) = self.picture.get_pixel_mut_checked(x, y) {
            for (below, ink) in below.iter_mut().zip(ink) {
                *below = mixed(*below, ink, cover);
            }
        }
    }

    /// Lays `ink` over the whole picture.
    pub fn wash(&mut self, ink: Ink, cover: f32) {
        for Rgb(below) in self.picture.pixels_mut() {
            for (below, ink) in below.iter_mut().zip(ink) {
                *below = mixed(*below, ink, cover);
            }
        }
    }

    /// Fills an area; pixels at its edges get their share.
    pub fn fill(&mut self, area: Area, ink: Ink) {
        let Area { left, top, right, bottom } = area;
        let within = |low: f32, high: f32, pixel: i64| {
            (high.min(pixel as f32 + 1.0) - low.max(pixel as f32)).clamp(0.0, 1.0)
        };
        for y in rows(top, bottom, self.height()) {
            for x in rows(left, right, self.width()) {
                let cover = within(left, right, x) * within(top, bottom, y);
                self.blend(x, y, ink, cover);
            }
        }
    }

    /// Fills an area whose corners are rounded by `radius`; half its height makes a disc or a pill.
    pub fn fill_round(&mut self, area: Area, radius: f32, ink: Ink) {
        let Area { left, top, right, bottom } = area;
        for y in rows(top - 1.0, bottom + 1.0, self.height()) {
            for x in rows(left - 1.0, right + 1.0, self.width()) {
                // From the pixel's middle to the rectangle between the corners' middles.
                let (px, py) = (x as f32 + 0.5, y as f32 + 0.5);
                let dx = (left + radius - px).max(px - right + radius).max(0.0);
                let dy = (top + radius - py).max(py - bottom + radius).max(0.0);
                let distance = (dx * dx + dy * dy).sqrt();
                self.blend(x, y, ink, (radius - distance + 0.5).clamp(0.0, 1.0));
            }
        }
    }
}

impl Area {
    pub fn disc(x: f32, y: f32, radius: f32) -> Area {
        Area { left: x - radius, top: y - radius, right: x + radius, bottom: y + radius }
    }

    pub fn width(&self) -> f32 {
        self.right - self.left
    }
}

/// The pixels from `low` to `high` that a side of so many has.
fn rows(low: f32, high: f32, side: f32) -> std::ops::Range<i64> {
    low.floor().max(0.0) as i64..high.ceil().min(side) as i64
}

fn mixed(below: u8, above: u8, cover: f32) -> u8 {
    let (below, above) = (f32::from(below), f32::from(above));
    (below + (above - below) * cover.clamp(0.0, 1.0) + 0.5) as u8
}
