//! The innermost loops by themselves, for `benches/`.

use glam::DVec3;

use super::sequence::Sequences;
use crate::geometry;
use crate::lanes::{F32x8, Mask8, Simd, Task, U32x8, Vec3x8, dispatch};
use crate::packet::Rays;
use crate::packet::solids::Solid;
use crate::packet::surfaces::Surface;
use crate::scene::Object;

/// Eight values each of several numbers.
type Packet<const N: usize> = [[f32; 8]; N];

/// A solid, and rays of one eye that keep together and fill its box.
pub struct Fan {
    solid: Solid,
    /// Directions.
    rays: Vec<Packet<3>>,
    eye: DVec3,
}

impl Fan {
    /// With `side` × `side` rays; `side` is a multiple of 4.
    pub fn new(solid: &dyn geometry::Solid, side: usize) -> Fan {
        let bounds = solid.bounds();
        let middle = (bounds.min + bounds.max) / 2.0;
        let half = (bounds.max - bounds.min).length() / 2.0;
        let eye = middle + DVec3::new(0.3, 0.5, -0.8) * (12.0 * half);
        let forward = (middle - eye).normalize();
        let right = forward.cross(DVec3::Y).normalize();
        let up = right.cross(forward);
        let rays = packets(side, |x, y| {
            middle + right * (half * (2.0 * x - 1.0)) + up * (half * (2.0 * y - 1.0)) - eye
        });
        Fan { solid: Solid::new(solid), rays, eye }
    }

    /// How many of the rays meet the solid.
    pub fn nearest(&self) -> u32 {
        dispatch(self)
    }
}

impl Task for &Fan {
    type Output = u32;

    #[inline(always)]
    fn run<S: Simd>(self) -> u32 {
        let mut count = 0;
        for direction in &self.rays {
            let origin = Vec3x8::<S>::splat(self.eye.as_vec3());
            let rays = Rays { origin, direction: loaded(direction) };
            let (after, before) = (F32x8::splat(0.0), F32x8::splat(f32::INFINITY));
            let found = self.solid.nearest(&rays, after, before, Mask8::all_lanes());
            count += found.is_one().bits().count_ones();
        }
        count
    }
}

/// A surface, and points of a square of it.
pub struct Patch {
    surface: Surface,
    points: Vec<Packet<3>>,
}

impl Patch {
    /// `side` × `side` points in the plane of x and z of an object's own space, from `from` on and up to `width`
    /// world units away; `side` is a multiple of 4.
    pub fn new(object: &Object, from: DVec3, width: f64, side: usize) -> Patch {
        let points = packets(side, |x, y| from + DVec3::new(x, 0.0, y) * width);
        Patch { surface: Surface::new(object), points }
    }

    /// The sum of all reds.
    pub fn color(&self) -> f32 {
        dispatch(self)
    }
}

impl Task for &Patch {
    type Output = f32;

    #[inline(always)]
    fn run<S: Simd>(self) -> f32 {
        let mut sum = F32x8::<S>::splat(0.0);
        for points in &self.points {
            let seen = F32x8::splat(0.05);
            let look = self.surface.look(loaded(points), seen, Mask8::all_lanes());
            sum = look.color.x + sum;
        }
        sum.store().iter().sum()
    }
}

/// The sum of the first numbers of `count` pixels in a row, a multiple of 8.
pub fn sequence(count: u32) -> f32 {
    struct Row(u32);
    impl Task for Row {
        type Output = f32;

        #[inline(always)]
        fn run<S: Simd>(self) -> f32 {
            let mut sum = F32x8::<S>::splat(0.0);
            for x in (0..self.0).step_by(8) {
                let x = U32x8::splat(x) + U32x8::load(&[0, 1, 2, 3, 4, 5, 6, 7]);
                let (a, b) = Sequences::new(x, U32x8::splat(7), U32x8::splat(3)).pair(5);
                sum = sum + a + b;
            }
            sum.store().iter().sum()
        }
    }
    dispatch(Row(count))
}

#[inline(always)]
fn loaded<S: Simd>([x, y, z]: &Packet<3>) -> Vec3x8<S> {
    Vec3x8::new(F32x8::load(x), F32x8::load(y), F32x8::load(z))
}

/// What `at` gives for `side` × `side` places of the square from 0 to 1, in blocks of 4 × 2.
fn packets(side: usize, at: impl Fn(f64, f64) -> DVec3) -> Vec<Packet<3>> {
    let blocks = (0..side / 2).flat_map(|row| (0..side / 4).map(move |column| (column, row)));
    let packet = |(column, row): (usize, usize)| {
        let mut packet = Packet::default();
        for lane in 0..8 {
            let (x, y) = (4 * column + lane % 4, 2 * row + lane / 4);
            let share = |index: usize| (index as f64 + 0.5) / side as f64;
            for (numbers, number) in packet.iter_mut().zip(at(share(x), share(y)).to_array()) {
                numbers[lane] = number as f32;
            }
        }
        packet
    };
    blocks.map(packet).collect()
}
