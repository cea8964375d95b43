//! TODO

use super::{Crossing, Normals};
use crate::geometry;
use crate::lanes::{F32x8, Mask8, Simd, U32x8, Vec3x8};
use crate::packet::Rays;

pub struct Plane {}

impl Plane {
    pub fn new(_solid: &geometry::Plane) -> Plane {
        todo!()
    }

    #[inline(always)]
    pub fn nearest<S: Simd>(
        &self,
        _rays: &Rays<S>,
        _after: F32x8<S>,
        _before: F32x8<S>,
        _lanes: Mask8<S>,
    ) -> Crossing<S> {
        todo!()
    }

    #[inline(always)]
    pub fn blocks<S: Simd>(
        &self,
        _rays: &Rays<S>,
        _after: F32x8<S>,
        _before: F32x8<S>,
        _lanes: Mask8<S>,
    ) -> Mask8<S> {
        todo!()
    }

    #[inline(always)]
    pub fn contains<S: Simd>(&self, _points: Vec3x8<S>, _lanes: Mask8<S>) -> Mask8<S> {
        todo!()
    }

    #[inline(always)]
    pub fn normals<S: Simd>(
        &self,
        _points: Vec3x8<S>,
        _parts: U32x8<S>,
        _lanes: Mask8<S>,
    ) -> Normals<S> {
        todo!()
    }
}
