//! What rays ask a scene, by asking every object.

use glam::DVec3;

use crate::geometry::{Hit, Interval, Ray, Solid, Spans};
use crate::scene::{Object, Scene};

/// How far off a surface its secondary rays begin, along the normal, in world units.
pub const OFFSET: f64 = 1e-4;

/// Surfaces of two bodies that are no farther apart along a ray than this, in world units, touch:
/// which of them a ray meets first is not for rounding to say.
const CONTACT: f64 = 1e-6;

/// A scene that is asked for all that it holds.
pub struct World<'a> {
    pub scene: &'a Scene,
}

impl World<'_> {
    /// The nearest object in front of `ray` up to `distance`, and where the ray meets it.
    pub fn nearest(&self, ray: &Ray, distance: f64) -> Option<(usize, Hit)> {
        let range = Interval::up_to(distance);
        // Of bodies in contact what is opaque is seen, and of others of a kind the first.
        let rank = |index: usize| (self.scene.objects[index].surface.is_transparent(), index);
        let hits = self.scene.objects.iter().enumerate();
        let hits =
            hits.filter_map(|(index, object)| Some((index, object.body.nearest(ray, range)?)));
        hits.reduce(|(index, hit), (other, next)| {
            let apart = next.t - hit.t;
            let is_seen = apart < -CONTACT || apart <= CONTACT && rank(other) < rank(index);
            if is_seen { (other, next) } else { (index, hit) }
        })
    }

    /// How much of a light at `distance` comes along `ray`: what is opaque holds all of it back,
    /// each surface of what is transparent lets its share through. (A line bends at none of them.)
    pub fn transmission(&self, ray: &Ray, distance: f64) -> f64 {
        let range = Interval::up_to(distance);
        let share = |object: &Object| {
            if object.surface.is_transparent() {
                transmission(object, ray, range)
            } else if object.body.blocks(ray, range) {
                0.0
            } else {
                1.0
            }
        };
        self.scene.objects.iter().map(share).product()
    }

    /// The refractive index at `point`: that of all that is transparent, where it lies inside any of
    /// it (Turek 2008, 4.2).
    pub fn index_at(&self, point: DVec3) -> f64 {
        let holds =
            |object: &Object| object.surface.is_transparent() && object.body.contains(point);
        if self.scene.objects.iter().any(holds) { self.scene.snell_index } else { 1.0 }
    }
}

/// What the surfaces of a transparent object within `range` let through.
fn transmission(object: &Object, ray: &Ray, range: Interval) -> f64 {
    let mut spans = Spans::new();
    object.body.spans(ray, &mut spans);
    let ends = spans.iter().flat_map(|span| [span.enter, span.exit]);
    let share = |hit: Hit| object.material(ray.at(hit.t), hit.normal).0.finish.transparency;
    ends.filter(|hit| range.holds(hit.t)).map(share).product()
}
