//! Planes.

use glam::Vec3;

use super::{Crossing, Normals};
use crate::geometry;
use crate::lanes::{F32x8, Mask8, Simd, U32x8, Vec3x8};
use crate::packet::Rays;

/// All points behind the plane through `origin` across `normal`.
pub struct Plane {
    origin: Vec3,
    normal: Vec3,
}

impl Plane {
    pub fn new(solid: &geometry::Plane) -> Plane {
        Plane { origin: solid.origin.as_vec3(), normal: solid.normal.as_vec3() }
    }

    #[inline(always)]
    pub fn nearest<S: Simd>(
        &self,
        rays: &Rays<S>,
        after: F32x8<S>,
        before: F32x8<S>,
        _lanes: Mask8<S>,
    ) -> Crossing<S> {
        let climb = rays.direction.dot(Vec3x8::splat(self.normal));
        let t = -self.height(rays.origin) / climb;
        // Along the plane the distance is infinite or no number: neither lies between the two.
        Crossing::between(t, U32x8::splat(0), after, before)
    }

    #[inline(always)]
    pub fn contains<S: Simd>(&self, points: Vec3x8<S>, _lanes: Mask8<S>) -> Mask8<S> {
        self.height(points).lt(F32x8::splat(0.0))
    }

    #[inline(always)]
    pub fn normals<S: Simd>(
        &self,
        _points: Vec3x8<S>,
        _parts: U32x8<S>,
        _lanes: Mask8<S>,
    ) -> Normals<S> {
        Normals::flat(Vec3x8::splat(self.normal))
    }

    /// Which of the `points` lie in front of it.
    #[inline(always)]
    pub fn is_in_front_of<S: Simd>(&self, points: Vec3x8<S>) -> Mask8<S> {
        self.height(points).gt(F32x8::splat(0.0))
    }

    #[inline(always)]
    fn height<S: Simd>(&self, points: Vec3x8<S>) -> F32x8<S> {
        (points - Vec3x8::splat(self.origin)).dot(Vec3x8::splat(self.normal))
    }
}
