//! Boxes along the axes of their own space.

use glam::DVec3;

use super::{Bounds, Hit, Ray, Shape, Solid, Span, Spans};

/// A rectangular box from `min` to `max` (turn it by placing it: [`super::Placed`]).
#[derive(Clone, Copy, Debug)]
pub struct Cuboid {
    pub min: DVec3,
    pub max: DVec3,
}

impl Cuboid {
    /// The box of the given half-sizes round the origin.
    pub fn centered(half: DVec3) -> Cuboid {
        Cuboid { min: -half, max: half }
    }
}

impl Solid for Cuboid {
    fn shape(&self) -> Shape<'_> {
        Shape::Cuboid(self)
    }

    fn bounds(&self) -> Bounds {
        Bounds { min: self.min, max: self.max }
    }

    fn contains(&self, point: DVec3) -> bool {
        point.cmpgt(self.min).all() && point.cmplt(self.max).all()
    }

    fn spans(&self, ray: &Ray, spans: &mut Spans) {
        let mut enter = Hit::new(f64::NEG_INFINITY, DVec3::ZERO);
        let mut exit = Hit::new(f64::INFINITY, DVec3::ZERO);
        for axis in 0..3 {
            let (origin, direction) = (ray.origin[axis], ray.direction[axis]);
            if direction == 0.0 {
                if origin <= self.min[axis] || origin >= self.max[axis] {
                    return;
                }
                continue;
            }
            let outward = DVec3::AXES[axis];
            let low = Hit::new((self.min[axis] - origin) / direction, -outward);
            let high = Hit::new((self.max[axis] - origin) / direction, outward);
            let (near, far) = if direction > 0.0 { (low, high) } else { (high, low) };
            if near.t > enter.t {
                enter = near;
            }
            if far.t < exit.t {
                exit = far;
            }
        }
        if enter.t < exit.t {
            spans.push(Span { enter, exit });
        }
    }
}
