//! What rays ask a scene, whatever then becomes of the answers.

use glam::DVec3;

use super::hierarchy::Hierarchy;
use crate::geometry::{Hit, Ray, Solid};
use crate::scene::Scene;

/// How far off a surface its secondary rays begin, along the normal, in world units: enough not
/// to meet the surface itself, too little to miss what touches it.
pub const OFFSET: f64 = 1e-4;

/// A scene with what is needed to trace rays through it.
pub struct World<'a> {
    pub scene: &'a Scene,
    hierarchy: Hierarchy<'a>,
    /// Which objects are transparent.
    transparent: Vec<usize>,
}

impl<'a> World<'a> {
    pub fn new(scene: &'a Scene) -> World<'a> {
        let is_transparent = |index: &usize| scene.objects[*index].surface.is_transparent();
        World {
            scene,
            hierarchy: Hierarchy::new(&scene.objects),
            transparent: (0..scene.objects.len()).filter(is_transparent).collect(),
        }
    }

    /// The nearest object in front of `ray`, and where the ray meets it.
    pub fn nearest(&self, ray: &Ray) -> Option<(usize, Hit)> {
        self.hierarchy.nearest(ray, self.scene.max_distance)
    }

    /// The nearest object in front of `ray` up to `distance`, and where the ray meets it.
    pub fn nearest_within(&self, ray: &Ray, distance: f64) -> Option<(usize, Hit)> {
        self.hierarchy.nearest(ray, distance)
    }

    /// How much of a light at `distance` comes along `ray`.
    pub fn transmission(&self, ray: &Ray, distance: f64) -> f64 {
        self.hierarchy.transmission(ray, distance)
    }

    /// The refractive index at `point`: that of all that is transparent, where it lies inside any of
    /// it (Turek 2008, 4.2).
    pub fn index_at(&self, point: DVec3) -> f64 {
        let holds = |index: &usize| self.scene.objects[*index].body.contains(point);
        if self.transparent.iter().any(holds) { self.scene.snell_index } else { 1.0 }
    }
}
