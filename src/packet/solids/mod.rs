//! Solids for packets of rays; one file a shape, as in [`crate::geometry`].

mod chain;
mod csg;
mod cuboid;
mod lathe;
#[cfg(test)]
mod oracle;
mod plane;
mod prism;
mod sphere;
#[cfg(test)]
mod tests;

use crate::geometry::{self, Shape};
use crate::lanes::{F32x8, Mask8, Simd, U32x8, Vec3x8};
use crate::packet::Rays;

/// Where rays cross a surface first.
#[derive(Clone, Copy)]
pub struct Crossing<S: Simd> {
    /// The distance, in lengths of the ray's direction; infinite where there is none.
    pub t: F32x8<S>,
    /// Which part of the solid's surface is crossed, by its own numbers: enough to ask for normals later.
    pub part: U32x8<S>,
}

/// Outward normals of length 1.
#[derive(Clone, Copy)]
pub struct Normals<S: Simd> {
    /// Of the surface itself.
    pub flat: Vec3x8<S>,
    /// Of the smooth one that it stands for; the same where there is none.
    pub smooth: Vec3x8<S>,
}

impl<S: Simd> Crossing<S> {
    /// No crossing.
    #[inline(always)]
    pub fn none() -> Crossing<S> {
        Crossing { t: F32x8::splat(f32::INFINITY), part: U32x8::splat(0) }
    }

    /// One at `t`, where that lies between two distances.
    #[inline(always)]
    pub fn between(t: F32x8<S>, part: U32x8<S>, after: F32x8<S>, before: F32x8<S>) -> Crossing<S> {
        let is_one = t.gt(after) & t.lt(before);
        Crossing { t: is_one.select(t, F32x8::splat(f32::INFINITY)), part }
    }

    /// Where there is one.
    #[inline(always)]
    pub fn is_one(&self) -> Mask8<S> {
        self.t.lt(F32x8::splat(f32::INFINITY))
    }

    #[inline(always)]
    pub fn select(mask: Mask8<S>, yes: Crossing<S>, no: Crossing<S>) -> Crossing<S> {
        Crossing { t: mask.select(yes.t, no.t), part: mask.select_words(yes.part, no.part) }
    }
}

impl<S: Simd> Normals<S> {
    /// Those of a surface that is what it looks like.
    #[inline(always)]
    pub fn flat(normal: Vec3x8<S>) -> Normals<S> {
        Normals { flat: normal, smooth: normal }
    }
}

/// A solid in its own space.
pub enum Solid {
    Plane(plane::Plane),
    Sphere(sphere::Sphere),
    Cuboid(cuboid::Cuboid),
    Lathe(lathe::Lathe),
    Prism(prism::Prism),
    /// Solids that are placed, and trees of them.
    Csg(csg::Csg),
}

impl Solid {
    pub fn new(solid: &dyn geometry::Solid) -> Solid {
        match solid.shape() {
            Shape::Plane(plane) => Solid::Plane(plane::Plane::new(plane)),
            Shape::Sphere(sphere) => Solid::Sphere(sphere::Sphere::new(sphere)),
            Shape::Cuboid(cuboid) => Solid::Cuboid(cuboid::Cuboid::new(cuboid)),
            Shape::Lathe(lathe) => Solid::Lathe(lathe::Lathe::new(lathe)),
            Shape::Prism(prism) => Solid::Prism(prism::Prism::new(prism)),
            Shape::Csg(_) | Shape::Placed(_) => csg::simplest(solid),
        }
    }

    /// The first crossing of the surface that is farther than `after` and nearer than `before`, from either
    /// side. Asked again with `after` set to what it found, it finds the next one: a distance does not depend on
    /// where the search began.
    #[inline(always)]
    pub fn nearest<S: Simd>(
        &self,
        rays: &Rays<S>,
        after: F32x8<S>,
        before: F32x8<S>,
        lanes: Mask8<S>,
    ) -> Crossing<S> {
        match self {
            Solid::Plane(plane) => plane.nearest(rays, after, before, lanes),
            Solid::Sphere(sphere) => sphere.nearest(rays, after, before, lanes),
            Solid::Cuboid(cuboid) => cuboid.nearest(rays, after, before, lanes),
            Solid::Lathe(lathe) => lathe.nearest(rays, after, before, lanes),
            Solid::Prism(prism) => prism.nearest(rays, after, before, lanes),
            Solid::Csg(csg) => csg.nearest(rays, after, before, lanes),
        }
    }

    /// Whether the surface is crossed anywhere between `after` and `before`: where [`Solid::nearest`] finds
    /// something.
    #[inline(always)]
    pub fn blocks<S: Simd>(
        &self,
        rays: &Rays<S>,
        after: F32x8<S>,
        before: F32x8<S>,
        lanes: Mask8<S>,
    ) -> Mask8<S> {
        match self {
            Solid::Lathe(lathe) => lathe.blocks(rays, after, before, lanes),
            Solid::Csg(csg) => csg.blocks(rays, after, before, lanes),
            _ => self.nearest(rays, after, before, lanes).is_one(),
        }
    }

    /// Which points lie in front of a plane, so that no way between any two of them meets it; no other solid tells.
    #[inline(always)]
    pub fn is_in_front_of<S: Simd>(&self, points: Vec3x8<S>) -> Mask8<S> {
        match self {
            Solid::Plane(plane) => plane.is_in_front_of(points),
            _ => Mask8::no_lanes(),
        }
    }

    /// Whether points lie inside.
    #[inline(always)]
    pub fn contains<S: Simd>(&self, points: Vec3x8<S>, lanes: Mask8<S>) -> Mask8<S> {
        match self {
            Solid::Plane(plane) => plane.contains(points, lanes),
            Solid::Sphere(sphere) => sphere.contains(points, lanes),
            Solid::Cuboid(cuboid) => cuboid.contains(points, lanes),
            Solid::Lathe(lathe) => lathe.contains(points, lanes),
            Solid::Prism(prism) => prism.contains(points, lanes),
            Solid::Csg(csg) => csg.contains(points, lanes),
        }
    }

    /// The normals at `points` of the surface, of the parts that [`Solid::nearest`] gave with them.
    #[inline(always)]
    pub fn normals<S: Simd>(
        &self,
        points: Vec3x8<S>,
        parts: U32x8<S>,
        lanes: Mask8<S>,
    ) -> Normals<S> {
        match self {
            Solid::Plane(plane) => plane.normals(points, parts, lanes),
            Solid::Sphere(sphere) => sphere.normals(points, parts, lanes),
            Solid::Cuboid(cuboid) => cuboid.normals(points, parts, lanes),
            Solid::Lathe(lathe) => lathe.normals(points, parts, lanes),
            Solid::Prism(prism) => prism.normals(points, parts, lanes),
            Solid::Csg(csg) => csg.normals(points, parts, lanes),
        }
    }
}
