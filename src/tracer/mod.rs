//! From a scene to a picture.
//!
//! What a pixel becomes depends on the scene and on the pixel's place alone, so a picture is the
//! same for any number of threads. Rays go in packets of eight, in f32 ([`crate::packet`]); `oracle` does
//! the same one ray at a time in f64, for tests.

mod absent;
mod antialiasing;
mod body;
mod cast;
mod cells;
mod exposure;
mod eye;
mod footprint;
#[doc(hidden)]
pub mod kernels;
mod lights;
mod mask;
mod materials;
mod optics;
mod oracle;
mod outlook;
mod phong;
mod pinhole;
mod pixel;
mod plane;
mod record;
mod reuse;
mod samples;
mod sampling;
mod sequence;
mod shelf;
mod silhouette;
mod sizes;
mod sketch;
mod slab;
mod studio;
mod ties;
mod tone;
mod world;

pub use antialiasing::Antialiasing;
pub use reuse::{Tracer, render, render_by_oracle};

/// How many rays a picture took, by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct RayCounts {
    /// From the camera.
    pub primary: u64,
    /// Towards a light, those among them that nothing can stand in the way of, as a shaft tells.
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
