//! From a scene to a picture.
//!
//! What a pixel becomes depends on the scene and on the pixel's place alone, so a picture is the
//! same for any number of threads. The arithmetic is scalar f64: the yardstick for quicker paths.

mod antialiasing;
mod canvas;
mod exposure;
mod footprint;
mod hierarchy;
mod optics;
mod phong;
mod sampling;
mod sequence;
mod studio;
mod tone;
mod world;

pub use antialiasing::Antialiasing;

use image::DynamicImage;

use crate::scene::Scene;

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
/// The picture has an alpha channel (not multiplied into its colours) when the scene has no
/// background.
pub fn render(
    scene: &Scene,
    width: u32,
    height: u32,
    mode: Antialiasing,
) -> (DynamicImage, RayCounts) {
    match &scene.room {
        None => sampling::render(scene, width, height, mode),
        Some(room) => exposure::render(scene, room, width, height, mode),
    }
}
