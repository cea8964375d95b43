//! From a scene to a picture.
//!
//! What a pixel becomes depends on the scene and on the pixel's place alone, so a picture is the
//! same for any number of threads. Rays go in packets of eight, in f32 ([`crate::packet`]); `oracle` does
//! the same one ray at a time in f64, for tests.

mod antialiasing;
mod cells;
mod exposure;
mod eye;
mod footprint;
mod lights;
mod materials;
mod optics;
pub mod oracle;
mod phong;
mod pinhole;
mod pixel;
mod plane;
mod sampling;
mod sequence;
mod shelf;
mod silhouette;
mod studio;
mod tone;
mod world;

pub use antialiasing::Antialiasing;

use image::DynamicImage;

use crate::scene::Scene;
use exposure::Exposure;
use phong::Phong;
use shelf::Shelf;
use silhouette::Silhouette;
use studio::Studio;
use world::World;

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
    let shelf = Shelf::default();
    let size = [width, height];
    let is_transparent = scene.background.is_none();
    let (pixels, counts) = match &scene.room {
        None => {
            let eye = Phong::new(World::new(scene, &shelf), size);
            sampling::render(&eye, scene, size, mode)
        }
        Some(room) => {
            let exposure = Exposure::new(scene, mode);
            let eye = Studio::new(World::new(scene, &shelf), room, size, exposure.across());
            exposure.take(&eye, &Silhouette::new(scene, size), size)
        }
    };
    (pixel::picture(&pixels, is_transparent), counts)
}

/// The same picture from the `oracle`, to within rounding.
pub fn render_by_oracle(
    scene: &Scene,
    width: u32,
    height: u32,
    mode: Antialiasing,
) -> (DynamicImage, RayCounts) {
    let size = [width, height];
    let is_transparent = scene.background.is_none();
    let (pixels, counts) = match &scene.room {
        None => {
            let eye = oracle::Phong::new(scene, size);
            sampling::render(&eye, scene, size, mode)
        }
        Some(room) => {
            let exposure = Exposure::new(scene, mode);
            let eye = oracle::Studio::new(scene, room, size, exposure.across());
            exposure.take(&eye, &Silhouette::new(scene, size), size)
        }
    };
    (pixel::picture(&pixels, is_transparent), counts)
}
