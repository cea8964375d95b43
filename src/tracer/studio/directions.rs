//! Directions and points of samples.

use crate::lanes::{F32x8, Simd, Vec3x8, math};

/// Directions round `normal`, by the cosine.
#[inline(always)]
pub fn scattered<S: Simd>(normal: Vec3x8<S>, pair: (F32x8<S>, F32x8<S>)) -> Vec3x8<S> {
    let direction = normal + sphere(pair);
    let length = direction.length();
    let is_any = length.gt(F32x8::splat(1e-6));
    Vec3x8::select(is_any, direction * length.recip(), normal)
}

/// Points on the sphere of radius 1.
#[inline(always)]
pub fn sphere<S: Simd>((u, v): (F32x8<S>, F32x8<S>)) -> Vec3x8<S> {
    let one = F32x8::splat(1.0);
    let y = one - F32x8::splat(2.0) * u;
    let radius = (one - y * y).max(F32x8::splat(0.0)).sqrt();
    let (sin, cos) = math::sin_cos_turns(v);
    Vec3x8::new(radius * cos, y, radius * sin)
}

/// Points in the ball of radius 1, more likely near its middle.
#[inline(always)]
pub fn ball<S: Simd>((u, v): (F32x8<S>, F32x8<S>)) -> Vec3x8<S> {
    // The golden ratio parts u from what it is used for a second time.
    let place = u * F32x8::splat(1.618_034 * 8.0);
    sphere((u, v)) * (place - place.floor())
}
