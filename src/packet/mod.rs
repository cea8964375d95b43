//! What a scene is made of, for eight rays at once.
//!
//! Solids and surfaces are made from those of [`crate::geometry`] and [`crate::scene`], in f32, and answer
//! packets of eight rays. What a lane gets depends on nothing but what that lane asks: neighbours only decide
//! which questions are worth asking. So every bound that rejects by lanes together has a margin, and every answer is
//! taken over by its own lane's conditions, never because another lane had to look.
//!
//! All these functions leave lanes alone that are not among the `lanes` of the question: what they give
//! there has no meaning (but is no panic).

pub mod boxes;
pub mod shaft;
pub mod solids;
pub mod surfaces;

use glam::{DAffine3, DVec3, Vec3};

use crate::lanes::{F32x8, Simd, Vec3x8};

/// Eight half-lines; directions need not have length 1.
#[derive(Clone, Copy)]
pub struct Rays<S: Simd> {
    pub origin: Vec3x8<S>,
    pub direction: Vec3x8<S>,
}

impl<S: Simd> Rays<S> {
    /// The points at distances `t`, in lengths of the directions.
    #[inline(always)]
    pub fn at(&self, t: F32x8<S>) -> Vec3x8<S> {
        self.origin + self.direction * t
    }
}

/// A way from one space to another.
#[derive(Clone, Copy, Debug)]
pub struct Transform {
    /// Is taken away first: near the solid nothing large cancels.
    origin: Vec3,
    /// By columns; `None` where nothing turns or grows.
    columns: Option<[Vec3; 3]>,
}

impl Transform {
    /// The way that `transform`, which must be invertible, leads.
    pub fn new(transform: &DAffine3) -> Transform {
        let matrix = transform.matrix3;
        let origin = -(matrix.inverse() * transform.translation);
        let is_move = matrix == glam::DMat3::IDENTITY;
        Transform {
            origin: origin.as_vec3(),
            columns: (!is_move).then(|| {
                [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(|column: DVec3| column.as_vec3())
            }),
        }
    }

    #[inline(always)]
    pub fn point<S: Simd>(&self, point: Vec3x8<S>) -> Vec3x8<S> {
        self.vector(point - Vec3x8::splat(self.origin))
    }

    #[inline(always)]
    pub fn vector<S: Simd>(&self, vector: Vec3x8<S>) -> Vec3x8<S> {
        match &self.columns {
            None => vector,
            Some([x, y, z]) => {
                let columns = [Vec3x8::splat(*x), Vec3x8::splat(*y), Vec3x8::splat(*z)];
                vector.by_columns(&columns)
            }
        }
    }

    /// Normals of the space that this leads to, in the space that it comes from; of any length.
    #[inline(always)]
    pub fn normal<S: Simd>(&self, normal: Vec3x8<S>) -> Vec3x8<S> {
        match &self.columns {
            None => normal,
            Some([x, y, z]) => Vec3x8::new(
                normal.dot(Vec3x8::splat(*x)),
                normal.dot(Vec3x8::splat(*y)),
                normal.dot(Vec3x8::splat(*z)),
            ),
        }
    }

    #[inline(always)]
    pub fn rays<S: Simd>(&self, rays: &Rays<S>) -> Rays<S> {
        Rays { origin: self.point(rays.origin), direction: self.vector(rays.direction) }
    }
}
