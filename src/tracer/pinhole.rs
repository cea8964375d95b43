//! The camera's rays, eight at once.

use glam::Vec3;

use crate::lanes::{F32x8, Simd, Vec3x8};
use crate::packet::Rays;
use crate::scene::{Camera, Projection};

/// A camera without its lens, in f32.
pub struct Pinhole {
    position: Vec3,
    right: Vec3,
    up: Vec3,
    forward: Vec3,
    is_parallel: bool,
    /// The width of a pixel: at distance 1, or anywhere in parallel projection.
    pixel: f32,
    /// The picture's middle, in pixels.
    middle: [f32; 2],
}

impl Pinhole {
    /// For a picture of `width` × `height` pixels.
    pub fn new(camera: &Camera, width: u32, height: u32) -> Pinhole {
        let [right, up, forward] = camera.axes().map(|axis| axis.as_vec3());
        Pinhole {
            position: camera.position().as_vec3(),
            right,
            up,
            forward,
            is_parallel: camera.projection() == Projection::Parallel,
            pixel: (camera.width() / f64::from(width)) as f32,
            middle: [width, height].map(|side| (f64::from(side) / 2.0) as f32),
        }
    }

    /// The rays of length 1 through points of the picture, as [`Camera::ray`] gives them.
    #[inline(always)]
    pub fn rays<S: Simd>(&self, x: F32x8<S>, y: F32x8<S>) -> Rays<S> {
        let pixel = F32x8::splat(self.pixel);
        let across = (x - F32x8::splat(self.middle[0])) * pixel;
        let upwards = (F32x8::splat(self.middle[1]) - y) * pixel;
        let aside = Vec3x8::splat(self.right) * across + Vec3x8::splat(self.up) * upwards;
        let (position, forward) = (Vec3x8::splat(self.position), Vec3x8::splat(self.forward));
        if self.is_parallel {
            Rays { origin: position + aside, direction: forward }
        } else {
            Rays { origin: position, direction: (forward + aside).normalized() }
        }
    }
}
