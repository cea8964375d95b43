//! What bodies are made of, for packets of points.

use crate::lanes::{F32x8, Mask8, Simd, U32x8, Vec3x8};
use crate::scene;

/// What is seen of a surface.
#[derive(Clone, Copy)]
pub struct Look<S: Simd> {
    pub color: Vec3x8<S>,
    /// Which of the surface's materials (by [`scene::Surface::materials`]) it is.
    pub material: U32x8<S>,
}

/// The surface of an object.
pub struct Surface {}

impl Surface {
    /// The surface of `object`: its materials, its seed, its paint.
    pub fn new(_object: &scene::Object) -> Surface {
        todo!()
    }

    /// What is seen at `points` of the object's own space, where widths of `seen` world units are seen at
    /// once.
    #[inline(always)]
    pub fn look<S: Simd>(&self, _points: Vec3x8<S>, _seen: F32x8<S>, _lanes: Mask8<S>) -> Look<S> {
        todo!()
    }

    /// Whether there is one material all over.
    pub fn is_uniform(&self) -> bool {
        todo!()
    }

    /// Which material is at `points`, for those who need no colour.
    #[inline(always)]
    pub fn material<S: Simd>(&self, _points: Vec3x8<S>, _lanes: Mask8<S>) -> U32x8<S> {
        todo!()
    }
}
