//! Boxes along the axes of their own space.

use glam::Vec3;

use super::{Crossing, Normals};
use crate::geometry;
use crate::lanes::{F32x8, Mask8, Simd, U32x8, Vec3x8};
use crate::packet::Rays;

/// A rectangular box. Its parts are its faces: twice the axis, and 1 more for the upper one.
pub struct Cuboid {
    min: Vec3,
    max: Vec3,
}

impl Cuboid {
    pub fn new(solid: &geometry::Cuboid) -> Cuboid {
        Cuboid { min: solid.min.as_vec3(), max: solid.max.as_vec3() }
    }

    #[inline(always)]
    pub fn nearest<S: Simd>(
        &self,
        rays: &Rays<S>,
        after: F32x8<S>,
        before: F32x8<S>,
        _lanes: Mask8<S>,
    ) -> Crossing<S> {
        let infinity = F32x8::splat(f32::INFINITY);
        let mut enter = Crossing { t: -infinity, part: U32x8::splat(0) };
        let mut exit = Crossing { t: infinity, part: U32x8::splat(0) };
        let (origin, direction) = (rays.origin, rays.direction);
        let axes = [(origin.x, direction.x), (origin.y, direction.y), (origin.z, direction.z)];
        for (axis, (origin, direction)) in axes.into_iter().enumerate() {
            let (min, max) = (F32x8::splat(self.min[axis]), F32x8::splat(self.max[axis]));
            let rises = direction.gt(F32x8::splat(0.0));
            let per_length = direction.recip();
            let near = (rises.select(min, max) - origin) * per_length;
            let far = (rises.select(max, min) - origin) * per_length;
            // Along a slab a ray is in it all the time, or never.
            let along = direction.eq(F32x8::splat(0.0));
            let beside = along & (origin.le(min) | origin.ge(max));
            let near = along.select(beside.select(infinity, -infinity), near);
            let far = along.select(infinity, far);
            let (low, high) = (U32x8::splat(2 * axis as u32), U32x8::splat(2 * axis as u32 + 1));
            let later = near.gt(enter.t);
            enter.t = later.select(near, enter.t);
            enter.part = later.select_words(rises.select_words(low, high), enter.part);
            let sooner = far.lt(exit.t);
            exit.t = sooner.select(far, exit.t);
            exit.part = sooner.select_words(rises.select_words(high, low), exit.part);
        }
        let enters = enter.t.gt(after);
        let t = enters.select(enter.t, exit.t);
        let part = enters.select_words(enter.part, exit.part);
        let found = Crossing::between(t, part, after, before);
        Crossing { t: enter.t.lt(exit.t).select(found.t, infinity), part }
    }

    #[inline(always)]
    pub fn contains<S: Simd>(&self, points: Vec3x8<S>, _lanes: Mask8<S>) -> Mask8<S> {
        within(points.x, self.min.x, self.max.x)
            & within(points.y, self.min.y, self.max.y)
            & within(points.z, self.min.z, self.max.z)
    }

    #[inline(always)]
    pub fn normals<S: Simd>(
        &self,
        _points: Vec3x8<S>,
        parts: U32x8<S>,
        _lanes: Mask8<S>,
    ) -> Normals<S> {
        let is_upper = (parts & U32x8::splat(1)).eq(U32x8::splat(1));
        let outward = is_upper.select(F32x8::splat(1.0), F32x8::splat(-1.0));
        let axis = parts >> 1;
        Normals::flat(Vec3x8::new(
            axis.eq(U32x8::splat(0)).keep(outward),
            axis.eq(U32x8::splat(1)).keep(outward),
            axis.eq(U32x8::splat(2)).keep(outward),
        ))
    }
}

#[inline(always)]
fn within<S: Simd>(x: F32x8<S>, min: f32, max: f32) -> Mask8<S> {
    x.gt(F32x8::splat(min)) & x.lt(F32x8::splat(max))
}
