//! From a scene to a picture.
//!
//! What a pixel becomes depends on the scene and on the pixel's place alone, so a picture is the
//! same for any number of threads. The arithmetic is scalar f64: the yardstick for quicker paths.

mod antialiasing;
mod footprint;
mod hierarchy;
mod shade;

pub use antialiasing::Antialiasing;

use std::ops::Range;

use image::RgbImage;
use rayon::prelude::*;

use crate::scene::{Rgb, Scene};
use footprint::Footprint;
use shade::Tracer;

/// How many rays a picture took, by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct RayCounts {
    /// From the camera.
    pub primary: u64,
    /// Towards a light.
    pub shadow: u64,
    /// From a mirror, or from the inside of what is transparent.
    pub reflected: u64,
    /// Through what is transparent.
    pub refracted: u64,
}

impl RayCounts {
    /// All kinds together.
    pub fn total(&self) -> u64 {
        self.primary + self.shadow + self.reflected + self.refracted
    }
}

impl std::ops::Add for RayCounts {
    type Output = RayCounts;

    fn add(self, other: RayCounts) -> RayCounts {
        RayCounts {
            primary: self.primary + other.primary,
            shadow: self.shadow + other.shadow,
            reflected: self.reflected + other.reflected,
            refracted: self.refracted + other.refracted,
        }
    }
}

/// Traces `scene` into a picture of `width` × `height` pixels, on the threads of the current pool.
pub fn render(scene: &Scene, width: u32, height: u32, mode: Antialiasing) -> (RgbImage, RayCounts) {
    let easel = Easel { tracer: Tracer::new(scene), scene, width, height };
    let mut picture = RgbImage::new(width, height);
    let counts = match mode {
        Antialiasing::None => easel.grid(&mut picture, 1),
        Antialiasing::Grid(side) => easel.grid(&mut picture, side),
        Antialiasing::Adaptive { rays, threshold } => easel.adaptive(&mut picture, rays, threshold),
    };
    (picture, counts)
}

/// What a single ray from the camera brings back.
#[derive(Clone, Copy)]
struct Sample {
    color: Rgb,
    footprint: Footprint,
}

/// A scene and the size that it is painted at.
struct Easel<'a> {
    tracer: Tracer<'a>,
    scene: &'a Scene,
    width: u32,
    height: u32,
}

/// How many rows a thread has in hand at a time in adaptive antialiasing: a bound for its memory.
const ROWS: usize = 32;

impl Easel<'_> {
    fn grid(&self, picture: &mut RgbImage, side: u32) -> RayCounts {
        self.paint(picture, 0..self.height as usize, |x, y, counts| self.mean(x, y, side, counts))
    }

    fn adaptive(&self, picture: &mut RgbImage, side: u32, threshold: f32) -> RayCounts {
        let (width, height) = (self.width as usize, self.height as usize);
        let mut counts = RayCounts::default();
        // The first pass over the rows from `first` on; at least those beside the band in hand.
        let (mut first, mut rows) = (0, Vec::<Vec<Sample>>::new());
        let band = ROWS * rayon::current_num_threads();
        for start in (0..height).step_by(band) {
            let end = (start + band).min(height);
            rows.drain(..start.saturating_sub(1) - first);
            first = start.saturating_sub(1);
            let (more, rays) = self.first_pass(first + rows.len()..(end + 1).min(height));
            rows.extend(more);
            let refined = self.paint(picture, start..end, |x, y, counts| {
                let here = rows[y - first][x];
                let differs = (y.max(1) - 1..(y + 2).min(height)).any(|row| {
                    rows[row - first][x.max(1) - 1..(x + 2).min(width)]
                        .iter()
                        .any(|there| there.footprint.differs(&here.footprint, threshold))
                });
                if differs { self.mean(x, y, side, counts) } else { here.color }
            });
            counts = counts + rays + refined;
        }
        counts
    }

    /// One ray through the middle of each pixel of some rows.
    fn first_pass(&self, rows: Range<usize>) -> (Vec<Vec<Sample>>, RayCounts) {
        let row = |y: usize| {
            let mut counts = RayCounts::default();
            let samples = (0..self.width as usize)
                .map(|x| self.sample(x as f64 + 0.5, y as f64 + 0.5, 1, &mut counts));
            (samples.collect(), counts)
        };
        let (samples, counts): (Vec<_>, Vec<_>) = rows.into_par_iter().map(row).unzip();
        (samples, counts.into_iter().fold(RayCounts::default(), std::ops::Add::add))
    }

    fn mean(&self, x: usize, y: usize, side: u32, counts: &mut RayCounts) -> Rgb {
        antialiasing::mean(side, |dx, dy| {
            // What is too bright is as bright as can be, also beside what is not.
            let sample = self.sample(x as f64 + dx, y as f64 + dy, side, counts);
            sample.color.min(Rgb::ONE)
        })
    }

    /// The ray through a place of the picture, one of `side` across its pixel.
    fn sample(&self, x: f64, y: f64, side: u32, counts: &mut RayCounts) -> Sample {
        let ray = self.scene.camera.ray(x, y, self.width, self.height);
        let spread = self.scene.camera.spread(self.width * side);
        self.tracer.trace(ray, spread, counts)
    }

    /// Gives the pixels of some rows their colours.
    fn paint(
        &self,
        picture: &mut RgbImage,
        rows: Range<usize>,
        color: impl Fn(usize, usize, &mut RayCounts) -> Rgb + Sync,
    ) -> RayCounts {
        let row_bytes = 3 * self.width as usize;
        picture.as_mut()[rows.start * row_bytes..rows.end * row_bytes]
            .par_chunks_mut(row_bytes)
            .enumerate()
            .map(|(index, row)| {
                let mut counts = RayCounts::default();
                for (x, pixel) in row.chunks_exact_mut(3).enumerate() {
                    pixel.copy_from_slice(&bytes(color(x, rows.start + index, &mut counts)));
                }
                counts
            })
            .reduce(RayCounts::default, std::ops::Add::add)
    }
}

/// The thesis knows no gamma: a channel is stored as it was computed.
fn bytes(color: Rgb) -> [u8; 3] {
    color.to_array().map(|channel| (channel.clamp(0.0, 1.0) * 255.0 + 0.5) as u8)
}
