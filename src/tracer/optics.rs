//! Where light goes at surfaces, and how much of it, for packets of rays. (The formulas and their sources
//! stand in `oracle::optics`.)

use crate::lanes::{F32x8, Mask8, Simd, Vec3x8};
use crate::packet::solids::Normals;

/// The normals of the surface itself and of what it is shaded as, on the side of rays that come along
/// `direction`.
#[inline(always)]
pub fn facing<S: Simd>(normals: Normals<S>, direction: Vec3x8<S>) -> (Vec3x8<S>, Vec3x8<S>) {
    let zero = F32x8::splat(0.0);
    let is_behind = direction.dot(normals.flat).gt(zero);
    let flat = Vec3x8::select(is_behind, -normals.flat, normals.flat);
    let smooth = Vec3x8::select(is_behind, -normals.smooth, normals.smooth);
    // A smooth normal may face away where the polygon just does not.
    let faces = direction.dot(smooth).lt(zero);
    (flat, Vec3x8::select(faces, smooth, flat))
}

/// Where a mirror across `normal` sends rays, but never below the surface itself.
#[inline(always)]
pub fn mirrored<S: Simd>(direction: Vec3x8<S>, normal: Vec3x8<S>, outward: Vec3x8<S>) -> Vec3x8<S> {
    let two = F32x8::splat(2.0);
    let mirrored = direction - normal * (two * direction.dot(normal));
    let is_above = mirrored.dot(outward).gt(F32x8::splat(0.0));
    Vec3x8::select(is_above, mirrored, direction - outward * (two * direction.dot(outward)))
}

/// Snell's law: where rays go behind a surface with `normal` on their own side, and which do: others are
/// reflected totally. `ratio` is the refractive index here over the one behind.
#[inline(always)]
pub fn refracted<S: Simd>(
    direction: Vec3x8<S>,
    normal: Vec3x8<S>,
    ratio: F32x8<S>,
) -> (Vec3x8<S>, Mask8<S>) {
    let one = F32x8::splat(1.0);
    let cos = -direction.dot(normal);
    let cos2_behind = one - ratio * ratio * (one - cos * cos);
    let root = cos2_behind.max(F32x8::splat(0.0)).sqrt();
    let bent = direction * ratio + normal * (ratio * cos - root);
    (bent.normalized(), cos2_behind.ge(F32x8::splat(0.0)))
}

/// Schlick's share of light that a smooth surface throws back.
#[inline(always)]
pub fn fresnel<S: Simd>(cosine: F32x8<S>, index: F32x8<S>) -> F32x8<S> {
    let one = F32x8::splat(1.0);
    let straight = (index - one) / (index + one);
    let straight = straight * straight;
    straight + (one - straight) * grazing(cosine)
}

/// How near rays are to grazing a surface, 0 to 1, as Schlick weighs it.
#[inline(always)]
pub fn grazing<S: Simd>(cosine: F32x8<S>) -> F32x8<S> {
    let rest = (F32x8::splat(1.0) - cosine).clamp(0.0, 1.0);
    let squared = rest * rest;
    squared * squared * rest
}
