//! Axis-aligned boxes round solids.

use glam::{DAffine3, DVec2, DVec3};

use super::csg::Root;
use super::{Interval, Operation, Ray, Shape, Solid};

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

    /// The smallest box that is known to hold a solid that `place` has moved: what is round is no wider for being
    /// turned, as the box round it is.
    pub fn placed(solid: &dyn Solid, place: &DAffine3) -> Bounds {
        // A disk or ball of radius 1 along some axes reaches as far as their common length.
        let reach =
            |axes: &[DVec3]| axes.iter().map(|axis| axis * axis).sum::<DVec3>().map(f64::sqrt);
        let round = |middle: DVec3, reach: DVec3| {
            let middle = place.transform_point3(middle);
            Bounds { min: middle - reach, max: middle + reach }
        };
        let axes = place.matrix3;
        match solid.shape() {
            Shape::Sphere(sphere) => round(
                sphere.center,
                reach(&[axes.x_axis, axes.y_axis, axes.z_axis]) * sphere.radius,
            ),
            Shape::Lathe(lathe) => {
                let disk = reach(&[axes.x_axis, axes.z_axis]);
                let ends = lathe.segments().iter().flat_map(|segment| [segment.from, segment.to]);
                ends.map(|end: DVec2| round(DVec3::Y * end.y, disk * end.x))
                    .fold(Bounds::EMPTY, Bounds::union)
            }
            Shape::Prism(prism) => {
                let own = solid.bounds();
                let ends = prism.segments().iter().map(|segment| segment.from);
                Bounds::of(
                    ends.flat_map(|end| [end.extend(own.min.z), end.extend(own.max.z)])
                        .map(|corner| place.transform_point3(corner)),
                )
            }
            Shape::Placed(placed) => Bounds::placed(placed.solid(), &(*place * placed.transform())),
            Shape::Csg(csg) => match csg.root() {
                Root::Leaf(solid) => Bounds::placed(solid, place),
                Root::Pair(operation, first, second) => {
                    let first = Bounds::placed(first, place);
                    match operation {
                        Operation::Union => first.union(Bounds::placed(second, place)),
                        Operation::Intersection => {
                            first.intersection(Bounds::placed(second, place))
                        }
                        Operation::Difference => first,
                    }
                }
            },
            _ => solid.bounds().transformed(place),
        }
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
    use crate::geometry::transform::{rotation_y, translation};
    use crate::geometry::{ControlPoint, Csg, Cuboid, Lathe, Normals, Profile};

    #[test]
    fn what_is_round_is_no_wider_for_being_turned() {
        let points = [(0.0, 0.0), (1.0, 0.0), (0.4, 2.0), (0.0, 2.0)];
        let points = points.map(|(u, v)| ControlPoint { at: DVec2::new(u, v), corner: true });
        let profile = Profile::new(points.to_vec()).expect("a profile");
        let lathe = Lathe::new(&profile, 0, Normals::Flat).expect("a lathe");
        let cube = Csg::leaf(Cuboid::centered(DVec3::splat(0.5)));
        let body = Csg::leaf(lathe).or(cube.clone()).minus(cube.placed(translation(DVec3::Y)));
        let Bounds { min, max } = Bounds::placed(&body, &rotation_y(30.0));
        assert!(min.distance(DVec3::new(-1.0, -0.5, -1.0)) < 1e-12, "{min}");
        assert!(max.distance(DVec3::new(1.0, 2.0, 1.0)) < 1e-12, "{max}");
        let boxes = Bounds::placed(&body, &DAffine3::IDENTITY).transformed(&rotation_y(30.0));
        assert!(boxes.max.x > 1.3);
    }

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
