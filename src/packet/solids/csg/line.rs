//! Rays as a tree of solids asks for them.

use glam::Vec3;

use super::ACROSS;
use crate::lanes::{F32x8, Simd, Vec3x8};
use crate::packet::Rays;

/// Rays whose origins were moved, and what boxes want to know of them.
pub struct Line<S: Simd> {
    pub rays: Rays<S>,
    /// The directions' reciprocals.
    pub per_length: Vec3x8<S>,
    /// [`ACROSS`] as a distance.
    pub across: F32x8<S>,
    /// Which lanes go down along each axis.
    pub falls: [u8; 3],
}

impl<S: Simd> Line<S> {
    /// `rays` from where they are nearest to `middle`, and how far along they were moved: from there
    /// distances are short, and so are their errors.
    #[inline(always)]
    pub fn new(rays: &Rays<S>, middle: Vec3) -> (Line<S>, F32x8<S>) {
        let direction = rays.direction;
        let per_length2 = direction.dot(direction).recip();
        let moved = (Vec3x8::splat(middle) - rays.origin).dot(direction) * per_length2;
        let zero = F32x8::splat(0.0);
        let line = Line {
            rays: Rays { origin: rays.at(moved), direction },
            per_length: direction.recips(),
            across: per_length2.sqrt() * F32x8::splat(ACROSS),
            falls: [
                direction.x.lt(zero).bits(),
                direction.y.lt(zero).bits(),
                direction.z.lt(zero).bits(),
            ],
        };
        (line, moved)
    }
}
