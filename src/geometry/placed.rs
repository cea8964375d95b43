//! A solid that is moved, turned or scaled.

use std::sync::Arc;

use glam::{DAffine3, DMat3, DVec3};

use super::{Bounds, Hit, Interval, Ray, Shape, Solid, Span, Spans};

/// A solid in another place: `transform` leads from its own space to the space round it.
#[derive(Clone)]
pub struct Placed {
    solid: Arc<dyn Solid>,
    transform: DAffine3,
    to_own: DAffine3,
    normals: DMat3,
    bounds: Bounds,
}

impl Placed {
    /// Places `solid`; `transform` must be invertible.
    pub fn new(solid: Arc<dyn Solid>, transform: DAffine3) -> Placed {
        let to_own = transform.inverse();
        Placed {
            bounds: solid.placed_bounds(&transform),
            normals: to_own.matrix3.transpose(),
            transform,
            to_own,
            solid,
        }
    }

    /// The same, carried farther.
    pub fn moved(&self, by: DVec3) -> Placed {
        let mut transform = self.transform;
        transform.translation += by;
        let Bounds { min, max } = self.bounds;
        Placed {
            solid: self.solid.clone(),
            transform,
            to_own: transform.inverse(),
            normals: self.normals,
            bounds: Bounds { min: min + by, max: max + by },
        }
    }

    /// The solid in its own space.
    pub fn solid(&self) -> &dyn Solid {
        &*self.solid
    }

    /// The same, shared by all that have it.
    pub fn shared(&self) -> &Arc<dyn Solid> {
        &self.solid
    }

    /// The way from the solid's own space to the space round it.
    pub fn transform(&self) -> DAffine3 {
        self.transform
    }

    /// A point of the space round the solid, in the solid's own space.
    pub fn own_point(&self, point: DVec3) -> DVec3 {
        self.to_own.transform_point3(point)
    }

    fn own_ray(&self, ray: &Ray) -> Ray {
        Ray {
            origin: self.to_own.transform_point3(ray.origin),
            direction: self.to_own.transform_vector3(ray.direction),
        }
    }

    fn carried(&self, hit: Hit) -> Hit {
        let carry = |normal: DVec3| (self.normals * normal).normalize();
        let normal = carry(hit.normal);
        let shading = if hit.shading == hit.normal { normal } else { carry(hit.shading) };
        Hit { t: hit.t, normal, shading }
    }
}

impl Solid for Placed {
    fn shape(&self) -> Shape<'_> {
        Shape::Placed(self)
    }

    fn bounds(&self) -> Bounds {
        self.bounds
    }

    fn placed_bounds(&self, place: &DAffine3) -> Bounds {
        self.solid.placed_bounds(&(*place * self.transform))
    }

    fn contains(&self, point: DVec3) -> bool {
        self.bounds.hold(point) && self.solid.contains(self.own_point(point))
    }

    fn spans(&self, ray: &Ray, spans: &mut Spans) {
        let mut own = Spans::new();
        self.solid.spans(&self.own_ray(ray), &mut own);
        spans.extend(
            own.into_iter().map(|span| Span {
                enter: self.carried(span.enter),
                exit: self.carried(span.exit),
            }),
        );
    }

    fn nearest(&self, ray: &Ray, range: Interval) -> Option<Hit> {
        self.bounds.clip(ray, range)?;
        let hit = self.solid.nearest(&self.own_ray(ray), range)?;
        Some(self.carried(hit))
    }

    fn blocks(&self, ray: &Ray, range: Interval) -> bool {
        self.bounds.clip(ray, range).is_some() && self.solid.blocks(&self.own_ray(ray), range)
    }
}
