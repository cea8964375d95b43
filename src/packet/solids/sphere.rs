//! Spheres.

use glam::Vec3;

use super::{Crossing, Normals};
use crate::geometry;
use crate::lanes::{F32x8, Mask8, Simd, U32x8, Vec3x8};
use crate::packet::Rays;

/// All points within a radius of a centre.
pub struct Sphere {
    center: Vec3,
    radius: f32,
}

impl Sphere {
    pub fn new(solid: &geometry::Sphere) -> Sphere {
        Sphere { center: solid.center.as_vec3(), radius: solid.radius as f32 }
    }

    #[inline(always)]
    pub fn nearest<S: Simd>(
        &self,
        rays: &Rays<S>,
        after: F32x8<S>,
        before: F32x8<S>,
        _lanes: Mask8<S>,
    ) -> Crossing<S> {
        let origin = rays.origin - Vec3x8::splat(self.center);
        let own = Rays { origin, direction: rays.direction };
        nearest_of_ball(&own, self.radius * self.radius, after, before)
    }

    #[inline(always)]
    pub fn contains<S: Simd>(&self, points: Vec3x8<S>, _lanes: Mask8<S>) -> Mask8<S> {
        let from_center = points - Vec3x8::splat(self.center);
        from_center.dot(from_center).lt(F32x8::splat(self.radius * self.radius))
    }

    #[inline(always)]
    pub fn normals<S: Simd>(
        &self,
        points: Vec3x8<S>,
        _parts: U32x8<S>,
        _lanes: Mask8<S>,
    ) -> Normals<S> {
        Normals::flat((points - Vec3x8::splat(self.center)).normalized())
    }
}

/// The first crossing of the sphere round the origin whose radius has the square `radius2`.
///
/// The ray's origin is moved to where it is nearest to the centre: from there both crossings are as far,
/// and nothing large cancels.
#[inline(always)]
pub fn nearest_of_ball<S: Simd>(
    rays: &Rays<S>,
    radius2: f32,
    after: F32x8<S>,
    before: F32x8<S>,
) -> Crossing<S> {
    let per_length2 = rays.direction.dot(rays.direction).recip();
    let closest = -(rays.origin.dot(rays.direction) * per_length2);
    let point = rays.at(closest);
    let height2 = F32x8::splat(radius2) - point.dot(point);
    // Of a negative number the root is none, and neither are the distances.
    let half = (height2 * per_length2).sqrt();
    let (enter, exit) = (closest - half, closest + half);
    let t = enter.gt(after).select(enter, exit);
    let is_crossed = height2.gt(F32x8::splat(0.0)) & t.gt(after) & t.lt(before);
    Crossing { t: is_crossed.select(t, F32x8::splat(f32::INFINITY)), part: U32x8::splat(0) }
}
