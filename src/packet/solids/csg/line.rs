//! Rays as a tree of solids asks for them.

use glam::Vec3;

use super::ACROSS;
use crate::lanes::{F32x8, Simd, Vec3x8};
use crate::packet::Rays;
use crate::packet::boxes::Way;

/// Rays whose origins were moved.
pub struct Line<S: Simd> {
    pub rays: Rays<S>,
    /// The same for boxes.
    pub way: Way<S>,
    /// [`ACROSS`] as a distance.
    pub across: F32x8<S>,
}

impl<S: Simd> Line<S> {
    /// `rays` from where they are nearest to `middle`, and how far along they were moved: from there
    /// distances are short, and so are their errors.
    #[inline(always)]
    pub fn new(rays: &Rays<S>, middle: Vec3) -> (Line<S>, F32x8<S>) {
        let direction = rays.direction;
        let per_length2 = direction.dot(direction).recip();
        let moved = (Vec3x8::splat(middle) - rays.origin).dot(direction) * per_length2;
        let rays = Rays { origin: rays.at(moved), direction };
        let across = per_length2.sqrt() * F32x8::splat(ACROSS);
        (Line { rays, way: Way::new(&rays), across }, moved)
    }
}
