//! Axis-aligned boxes round solids.

use glam::{DAffine3, DVec3};

use super::{Interval, Ray};

/// An axis-aligned box, from `min` to `max`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    pub min: DVec3,
    pub max: DVec3,
}

impl Bounds {
    /// The box that holds nothing; the neutral element of [`Bounds::union`].
    pub const EMPTY: Bounds = Bounds { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };

    /// The box that holds everything: that of an endless solid.
    pub const EVERYTHING: Bounds = Bounds { min: DVec3::NEG_INFINITY, max: DVec3::INFINITY };

    /// Whether the box ends in all directions.
    pub fn is_finite(&self) -> bool {
        self.min.is_finite() && self.max.is_finite()
    }

    /// Whether `point` lies inside or on a face.
    pub fn hold(&self, point: DVec3) -> bool {
        point.cmpge(self.min).all() && point.cmple(self.max).all()
    }

    /// The smallest box that holds all `points`.
    pub fn of(points: impl IntoIterator<Item = DVec3>) -> Bounds {
        points.into_iter().fold(Bounds::EMPTY, |bounds, point| Bounds {
            min: bounds.min.min(point),
            max: bounds.max.max(point),
        })
    }

    /// The smallest box that holds both.
    pub fn union(self, other: Bounds) -> Bounds {
        Bounds { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// The box that both have in common; it may be empty (`min > max`).
    pub fn intersection(self, other: Bounds) -> Bounds {
        Bounds { min: self.min.max(other.min), max: self.max.min(other.max) }
    }

    /// The smallest box round this one after `transform`; an endless one becomes everything.
    pub fn transformed(self, transform: &DAffine3) -> Bounds {
        if !self.is_finite() {
            return Bounds::EVERYTHING;
        }
        Bounds::of(self.corners().map(|corner| transform.transform_point3(corner)))
    }

    /// Round a ball or a disk that `place` has moved: of radius `radius` along the given axes of its own space.
    pub fn round(middle: DVec3, radius: f64, axes: &[DVec3], place: &DAffine3) -> Bounds {
        // It reaches as far along each axis of the world as the length of all its own axes' shares of that.
        let axes = axes.iter().map(|axis| place.transform_vector3(*axis));
        let reach = axes.map(|axis| axis * axis).sum::<DVec3>().map(f64::sqrt) * radius;
        let middle = place.transform_point3(middle);
        Bounds { min: middle - reach, max: middle + reach }
    }

    /// Its eight corners.
    pub fn corners(&self) -> [DVec3; 8] {
        std::array::from_fn(|index| {
            let pick = |bit: usize, low: f64, high: f64| if index & bit == 0 { low } else { high };
            DVec3::new(
                pick(1, self.min.x, self.max.x),
                pick(2, self.min.y, self.max.y),
                pick(4, self.min.z, self.max.z),
            )
        })
    }

    /// The part of `range` in which `ray` is inside the box, or `None`. Its ends are rounded: a
    /// surface that touches the box may be crossed a hair outside.
    ///
    /// A ray that lies within a face of the box counts as outside.
    pub fn clip(&self, ray: &Ray, range: Interval) -> Option<Interval> {
        self.clip_by(ray.origin, ray.direction.recip(), range)
    }

    /// The same for a ray from `origin` whose direction has the reciprocals `inverse`: those of zero are
    /// infinities of either sign, which is right.
    pub fn clip_by(&self, origin: DVec3, inverse: DVec3, range: Interval) -> Option<Interval> {
        let low = (self.min - origin) * inverse;
        let high = (self.max - origin) * inverse;
        let mut clipped = range;
        for axis in 0..3 {
            clipped.min = low[axis].min(high[axis]).max(clipped.min);
            clipped.max = low[axis].max(high[axis]).min(clipped.max);
        }
        (clipped.min <= clipped.max).then_some(clipped)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ray_along_an_axis_is_clipped_by_that_axis_alone() {
        let bounds = Bounds { min: DVec3::ZERO, max: DVec3::ONE };
        let ray = |x, direction| Ray { origin: DVec3::new(x, 0.5, -2.0), direction };
        let clipped = bounds.clip(&ray(0.5, DVec3::Z), Interval::AHEAD);
        assert_eq!(clipped, Some(Interval { min: 2.0, max: 3.0 }));
        assert_eq!(bounds.clip(&ray(1.5, DVec3::Z), Interval::AHEAD), None);
        assert_eq!(bounds.clip(&ray(0.5, DVec3::NEG_Z), Interval::AHEAD), None);
        assert_eq!(bounds.clip(&ray(0.5, DVec3::Z), Interval::up_to(1.0)), None);
    }
}
