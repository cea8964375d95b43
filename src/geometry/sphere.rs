//! Spheres.

use glam::{DAffine3, DVec3};

use super::{Bounds, Hit, Ray, Shape, Solid, Span, Spans};

/// All points within `radius` of `center`.
#[derive(Clone, Copy, Debug)]
pub struct Sphere {
    pub center: DVec3,
    pub radius: f64,
}

impl Solid for Sphere {
    fn shape(&self) -> Shape<'_> {
        Shape::Sphere(self)
    }

    fn bounds(&self) -> Bounds {
        Bounds { min: self.center - self.radius, max: self.center + self.radius }
    }

    fn placed_bounds(&self, place: &DAffine3) -> Bounds {
        Bounds::round(self.center, self.radius, &DVec3::AXES, place)
    }

    fn contains(&self, point: DVec3) -> bool {
        point.distance_squared(self.center) < self.radius * self.radius
    }

    fn spans(&self, ray: &Ray, spans: &mut Spans) {
        let from_center = ray.origin - self.center;
        let a = ray.direction.length_squared();
        let half_b = from_center.dot(ray.direction);
        let c = from_center.length_squared() - self.radius * self.radius;
        let discriminant = half_b * half_b - a * c;
        if discriminant <= 0.0 {
            return;
        }
        let root = discriminant.sqrt();
        let hit = |t: f64| Hit::new(t, (ray.at(t) - self.center) / self.radius);
        spans.push(Span { enter: hit((-half_b - root) / a), exit: hit((-half_b + root) / a) });
    }
}
