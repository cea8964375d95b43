//! A solid in its place in a tree.

use std::sync::Arc;

use glam::DAffine3;

use super::tree::Placed;
use crate::geometry;
use crate::lanes::{F32x8, Mask8, Simd, U32x8, Vec3x8};
use crate::packet::solids::sphere::nearest_of_ball;
use crate::packet::solids::{Crossing, Normals, Solid};
use crate::packet::{Rays, Transform};

pub struct Leaf {
    /// From the tree's space to the solid's own.
    to_own: Transform,
    shape: Shape,
    /// Whether what lies outside is meant.
    is_turned: bool,
}

#[derive(Clone)]
enum Shape {
    /// Of radius 1 round the origin: its size is part of its place.
    Ball,
    /// One and the same for all its places.
    Other(Arc<Solid>),
}

/// Solids that have been made, by where the originals are.
#[derive(Default)]
pub struct Made(Vec<(*const (), Arc<Solid>)>);

impl Made {
    fn solid(&mut self, original: &dyn geometry::Solid) -> Arc<Solid> {
        let address = std::ptr::from_ref(original).cast::<()>();
        if let Some((_, made)) = self.0.iter().find(|(other, _)| *other == address) {
            return made.clone();
        }
        let made = Arc::new(Solid::new(original));
        self.0.push((address, made.clone()));
        made
    }
}

impl Leaf {
    pub fn new(leaf: &Placed, made: &mut Made) -> Leaf {
        let (shape, place) = match leaf.solid.shape() {
            geometry::Shape::Sphere(sphere) => {
                let scale = DAffine3::from_scale(glam::DVec3::splat(sphere.radius));
                let ball = DAffine3::from_translation(sphere.center) * scale;
                (Shape::Ball, leaf.place * ball)
            }
            _ => (Shape::Other(made.solid(leaf.solid)), leaf.place),
        };
        Leaf { to_own: Transform::new(&place.inverse()), shape, is_turned: leaf.is_turned }
    }

    #[inline(always)]
    pub fn nearest<S: Simd>(
        &self,
        rays: &Rays<S>,
        after: F32x8<S>,
        before: F32x8<S>,
        lanes: Mask8<S>,
    ) -> Crossing<S> {
        let own = self.to_own.rays(rays);
        match &self.shape {
            Shape::Ball => nearest_of_ball(&own, 1.0, after, before),
            Shape::Other(solid) => nearest(solid, &own, after, before, lanes),
        }
    }

    #[inline(always)]
    pub fn blocks<S: Simd>(
        &self,
        rays: &Rays<S>,
        after: F32x8<S>,
        before: F32x8<S>,
        lanes: Mask8<S>,
    ) -> Mask8<S> {
        let own = self.to_own.rays(rays);
        match &self.shape {
            Shape::Ball => nearest_of_ball(&own, 1.0, after, before).is_one(),
            Shape::Other(solid) => blocks(solid, &own, after, before, lanes),
        }
    }

    /// Whether points lie inside, or outside of what is turned.
    #[inline(always)]
    pub fn holds<S: Simd>(&self, points: Vec3x8<S>, lanes: Mask8<S>) -> Mask8<S> {
        let own = self.to_own.point(points);
        let inside = match &self.shape {
            Shape::Ball => own.dot(own).lt(F32x8::splat(1.0)),
            Shape::Other(solid) => contains(solid, own, lanes),
        };
        if self.is_turned { !inside } else { inside }
    }

    #[inline(always)]
    pub fn normals<S: Simd>(
        &self,
        points: Vec3x8<S>,
        parts: U32x8<S>,
        lanes: Mask8<S>,
    ) -> Normals<S> {
        let own = self.to_own.point(points);
        let found = match &self.shape {
            Shape::Ball => Normals::flat(own),
            Shape::Other(solid) => normals(solid, own, parts, lanes),
        };
        Normals { flat: self.carried(found.flat), smooth: self.carried(found.smooth) }
    }

    /// A normal in the tree's space.
    #[inline(always)]
    fn carried<S: Simd>(&self, normal: Vec3x8<S>) -> Vec3x8<S> {
        let normal = self.to_own.normal(normal).normalized();
        if self.is_turned { -normal } else { normal }
    }
}

// Solids of all kinds, out of line: trees ask for them in many places.

#[inline(never)]
fn nearest<S: Simd>(
    solid: &Solid,
    rays: &Rays<S>,
    after: F32x8<S>,
    before: F32x8<S>,
    lanes: Mask8<S>,
) -> Crossing<S> {
    S::run(
        #[inline(always)]
        || solid.nearest(rays, after, before, lanes),
    )
}

#[inline(never)]
fn blocks<S: Simd>(
    solid: &Solid,
    rays: &Rays<S>,
    after: F32x8<S>,
    before: F32x8<S>,
    lanes: Mask8<S>,
) -> Mask8<S> {
    S::run(
        #[inline(always)]
        || solid.blocks(rays, after, before, lanes),
    )
}

#[inline(never)]
fn contains<S: Simd>(solid: &Solid, points: Vec3x8<S>, lanes: Mask8<S>) -> Mask8<S> {
    S::run(
        #[inline(always)]
        || solid.contains(points, lanes),
    )
}

#[inline(never)]
fn normals<S: Simd>(
    solid: &Solid,
    points: Vec3x8<S>,
    parts: U32x8<S>,
    lanes: Mask8<S>,
) -> Normals<S> {
    S::run(
        #[inline(always)]
        || solid.normals(points, parts, lanes),
    )
}
