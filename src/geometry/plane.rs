//! Planes, each the skin of all that lies behind it.

use glam::DVec3;

use super::{Bounds, Hit, Ray, Shape, Solid, Span, Spans};

/// All points behind the plane through `origin`; it goes on for ever.
#[derive(Clone, Copy, Debug)]
pub struct Plane {
    pub origin: DVec3,
    /// Points out of the solid half of space; of length 1.
    pub normal: DVec3,
}

impl Plane {
    /// The plane through `origin` across `normal`, which may have any length above 0.
    pub fn new(origin: DVec3, normal: DVec3) -> Plane {
        Plane { origin, normal: normal.normalize() }
    }
}

impl Solid for Plane {
    fn shape(&self) -> Shape<'_> {
        Shape::Plane(self)
    }

    fn bounds(&self) -> Bounds {
        Bounds::EVERYTHING
    }

    fn contains(&self, point: DVec3) -> bool {
        (point - self.origin).dot(self.normal) < 0.0
    }

    fn spans(&self, ray: &Ray, spans: &mut Spans) {
        let height = (ray.origin - self.origin).dot(self.normal);
        let climb = ray.direction.dot(self.normal);
        // Where there is no surface, the span has an end that no ray reaches.
        let along = ray.direction.normalize();
        let start = Hit::new(f64::NEG_INFINITY, -along);
        let end = Hit::new(f64::INFINITY, along);
        let crossing = Hit::new(-height / climb, self.normal);
        let inside = if climb == 0.0 {
            (height < 0.0).then_some(Span { enter: start, exit: end })
        } else if climb < 0.0 {
            Some(Span { enter: crossing, exit: end })
        } else {
            Some(Span { enter: start, exit: crossing })
        };
        spans.extend(inside);
    }
}
