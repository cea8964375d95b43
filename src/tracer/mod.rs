//! From a scene to a picture.
//!
//! What a pixel becomes depends on the scene and on the pixel's place alone, so a picture is the
//! same for any number of threads. The arithmetic is scalar f64: the yardstick for quicker paths.

mod antialiasing;
mod hierarchy;
mod shade;

pub use antialiasing::Antialiasing;

use image::RgbImage;
use rayon::prelude::*;

use crate::scene::{Rgb, Scene};

/// How many rays a picture took, by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RayCounts {
    /// From the camera.
    pub primary: u64,
    /// Towards a light.
    pub shadow: u64,
    /// From a mirror.
    pub reflected: u64,
}

impl std::ops::Add for RayCounts {
    type Output = RayCounts;

    fn add(self, other: RayCounts) -> RayCounts {
        RayCounts {
            primary: self.primary + other.primary,
            shadow: self.shadow + other.shadow,
            reflected: self.reflected + other.reflected,
        }
    }
}

/// Traces `scene` into a picture of `width` × `height` pixels, on the threads of the current pool.
pub fn render(scene: &Scene, width: u32, height: u32, mode: Antialiasing) -> (RgbImage, RayCounts) {
    let tracer = shade::Tracer::new(scene);
    let mut picture = RgbImage::new(width, height);
    let row_bytes = 3 * width as usize;
    let counts = picture
        .as_mut()
        .par_chunks_mut(row_bytes)
        .enumerate()
        .map(|(y, row)| {
            let mut counts = RayCounts::default();
            for (x, pixel) in row.chunks_exact_mut(3).enumerate() {
                let color = mode.mean(|dx, dy| {
                    let ray = scene.camera.ray(x as f64 + dx, y as f64 + dy, width, height);
                    tracer.trace(&ray, &mut counts)
                });
                pixel.copy_from_slice(&bytes(color));
            }
            counts
        })
        .reduce(RayCounts::default, std::ops::Add::add);
    (picture, counts)
}

/// The thesis knows no gamma: a channel is stored as it was computed.
fn bytes(color: Rgb) -> [u8; 3] {
    color.to_array().map(|channel| (channel.clamp(0.0, 1.0) * 255.0 + 0.5) as u8)
}
