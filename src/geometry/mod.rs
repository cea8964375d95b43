//! Solids and how rays meet them; one file a shape.
//!
//! Everything here has an inside: a ray meets a [`Solid`] in *spans*, the stretches of the ray that
//! lie inside it. Spans are what constructive solid geometry combines, and the first end of a
//! span in front of the eye is what the eye sees. A new shape is a file with one `impl Solid`, and
//! a line in [`Shape`]; the compiler then asks those who write shapes down for theirs.

mod bounds;
mod csg;
mod cuboid;
mod curve;
mod lathe;
mod placed;
mod plane;
mod polygon;
mod prism;
mod ray;
mod sphere;
pub mod transform;

pub use bounds::Bounds;
pub use csg::{Csg, Operation, Root};
pub use cuboid::Cuboid;
pub use curve::{ControlPoint, CurveError, Outline, Profile};
pub use lathe::Lathe;
pub use placed::Placed;
pub use plane::Plane;
pub use polygon::{Normals, Segment};
pub use prism::Prism;
pub use ray::{Hit, Interval, Ray, Span, Spans};
pub use sphere::Sphere;

use glam::{DAffine3, DVec3};

/// What a solid is, for those who write it down.
pub enum Shape<'a> {
    Plane(&'a Plane),
    Sphere(&'a Sphere),
    Cuboid(&'a Cuboid),
    Lathe(&'a Lathe),
    Prism(&'a Prism),
    Csg(&'a Csg),
    Placed(&'a Placed),
}

/// A body with an inside.
pub trait Solid: Send + Sync {
    /// The solid as its own kind.
    fn shape(&self) -> Shape<'_>;

    /// The smallest box that is known to hold the whole solid.
    fn bounds(&self) -> Bounds;

    /// The smallest box that is known to hold the whole solid where `place` has moved it: what is round is no
    /// wider for being turned, as the box round it is.
    fn placed_bounds(&self, place: &DAffine3) -> Bounds {
        self.bounds().transformed(place)
    }

    /// Whether `point` lies inside.
    fn contains(&self, point: DVec3) -> bool;

    /// Appends the stretches of the whole line of `ray` (negative distances too) that lie inside,
    /// in ascending order and without overlap, with outward normals at their ends.
    fn spans(&self, ray: &Ray, spans: &mut Spans);

    /// The nearest hit of the surface with a distance inside `range`.
    fn nearest(&self, ray: &Ray, range: Interval) -> Option<Hit> {
        nearest_end(self, ray, range)
    }

    /// Whether the surface is crossed anywhere inside `range`.
    fn blocks(&self, ray: &Ray, range: Interval) -> bool {
        self.nearest(ray, range).is_some()
    }
}

/// The nearest end of a span of `solid` within `range`.
fn nearest_end(solid: &(impl Solid + ?Sized), ray: &Ray, range: Interval) -> Option<Hit> {
    // The clipped range only rejects: its ends are rounded, and a face may lie on them.
    solid.bounds().clip(ray, range)?;
    let mut spans = Spans::new();
    solid.spans(ray, &mut spans);
    spans.iter().flat_map(|span| [span.enter, span.exit]).find(|hit| range.holds(hit.t))
}
