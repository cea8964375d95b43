//! Constructive solid geometry: union, intersection and difference of solids, to any depth.

use std::sync::Arc;

use glam::{DAffine3, DVec3};

use super::{Bounds, Hit, Interval, Placed, Ray, Shape, Solid, Span, Spans, nearest_end};

/// A tree of solids; a line is combined span by span from the leaves up (Turek 2008, 3.7.6).
#[derive(Clone)]
pub struct Csg {
    node: Node,
    bounds: Bounds,
}

#[derive(Clone)]
enum Node {
    Leaf(Arc<dyn Solid>),
    Pair(Operation, Box<[Csg; 2]>),
}

/// What stands at the root of a tree.
pub enum Root<'a> {
    Leaf(&'a dyn Solid),
    Pair(Operation, &'a Csg, &'a Csg),
}

/// How two solids are joined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operation {
    Union,
    Intersection,
    Difference,
}

impl Operation {
    fn holds(self, in_first: bool, in_second: bool) -> bool {
        match self {
            Operation::Union => in_first || in_second,
            Operation::Intersection => in_first && in_second,
            Operation::Difference => in_first && !in_second,
        }
    }

    /// A box that holds what comes of solids in two boxes.
    fn bounds(self, first: Bounds, second: Bounds) -> Bounds {
        match self {
            Operation::Union => first.union(second),
            Operation::Intersection => first.intersection(second),
            Operation::Difference => first,
        }
    }
}

impl Csg {
    /// A tree of one solid.
    pub fn leaf(solid: impl Solid + 'static) -> Csg {
        Csg { bounds: solid.bounds(), node: Node::Leaf(Arc::new(solid)) }
    }

    /// What lies in this or in `other`.
    pub fn or(self, other: Csg) -> Csg {
        self.joined(Operation::Union, other)
    }

    /// What lies in this and in `other`.
    pub fn and(self, other: Csg) -> Csg {
        self.joined(Operation::Intersection, other)
    }

    /// What lies in this but not in `other`.
    pub fn minus(self, other: Csg) -> Csg {
        self.joined(Operation::Difference, other)
    }

    /// The whole tree, moved by an invertible `transform`.
    pub fn placed(self, transform: DAffine3) -> Csg {
        Csg::leaf(Placed::new(Arc::new(self), transform))
    }

    /// The tree's root: a solid by itself, or two trees and how they are joined.
    pub fn root(&self) -> Root<'_> {
        match &self.node {
            Node::Leaf(solid) => Root::Leaf(&**solid),
            Node::Pair(operation, pair) => Root::Pair(*operation, &pair[0], &pair[1]),
        }
    }

    fn joined(self, operation: Operation, other: Csg) -> Csg {
        let bounds = operation.bounds(self.bounds, other.bounds);
        Csg { node: Node::Pair(operation, Box::new([self, other])), bounds }
    }
}

impl Solid for Csg {
    fn shape(&self) -> Shape<'_> {
        Shape::Csg(self)
    }

    fn bounds(&self) -> Bounds {
        self.bounds
    }

    fn placed_bounds(&self, place: &DAffine3) -> Bounds {
        match &self.node {
            Node::Leaf(solid) => solid.placed_bounds(place),
            Node::Pair(operation, pair) => {
                let placed = pair.each_ref().map(|tree| tree.placed_bounds(place));
                let [first, second] = placed;
                operation.bounds(first, second).intersection(self.bounds.transformed(place))
            }
        }
    }

    fn contains(&self, point: DVec3) -> bool {
        if !self.bounds.hold(point) {
            return false;
        }
        match &self.node {
            Node::Leaf(solid) => solid.contains(point),
            Node::Pair(operation, pair) => {
                let [first, second] = &**pair;
                match operation {
                    Operation::Union => first.contains(point) || second.contains(point),
                    Operation::Intersection => first.contains(point) && second.contains(point),
                    Operation::Difference => first.contains(point) && !second.contains(point),
                }
            }
        }
    }

    fn spans(&self, ray: &Ray, spans: &mut Spans) {
        if self.bounds.clip(ray, Interval::WHOLE_LINE).is_none() {
            return;
        }
        match &self.node {
            Node::Leaf(solid) => solid.spans(ray, spans),
            Node::Pair(operation, pair) => {
                let [mut first, mut second] = [Spans::new(), Spans::new()];
                pair[0].spans(ray, &mut first);
                if !first.is_empty() || matches!(operation, Operation::Union) {
                    pair[1].spans(ray, &mut second);
                }
                combine(*operation, &first, &second, spans);
            }
        }
    }

    fn nearest(&self, ray: &Ray, range: Interval) -> Option<Hit> {
        self.bounds.clip(ray, range)?;
        match &self.node {
            Node::Leaf(solid) => solid.nearest(ray, range),
            Node::Pair(operation, pair) => operation
                .first_entry(&pair[0], &pair[1], ray, range)
                .unwrap_or_else(|| nearest_end(self, ray, range)),
        }
    }
}

impl Operation {
    /// The nearest hit, where it needs no spans: of a ray that comes from outside. `None` where
    /// spans have to tell.
    fn first_entry(
        self,
        first: &Csg,
        second: &Csg,
        ray: &Ray,
        range: Interval,
    ) -> Option<Option<Hit>> {
        // What is entered within the range was not around the ray where that begins.
        let enters = |hit: &Option<Hit>| hit.is_some_and(|hit| hit.normal.dot(ray.direction) < 0.0);
        let surrounds = |solid: &Csg| solid.contains(ray.at(range.min));
        match self {
            Operation::Union => {
                let one = first.nearest(ray, range);
                if one.is_some() && !enters(&one) {
                    return None;
                }
                let nearer = Interval { max: one.map_or(range.max, |hit| hit.t), ..range };
                match second.nearest(ray, nearer) {
                    None if one.is_none() => Some(None),
                    None => (!surrounds(second)).then_some(one),
                    other if !enters(&other) || one.is_none() && surrounds(first) => None,
                    // Of two walls in one place the first one's counts.
                    other if one.is_some_and(|one| other.is_some_and(|other| one.t <= other.t)) => {
                        Some(one)
                    }
                    other => Some(other),
                }
            }
            Operation::Difference => {
                let hit = first.nearest(ray, range);
                let is_all = match hit {
                    Some(entry) => enters(&hit) && !second.contains(ray.at(entry.t)),
                    None => !surrounds(first),
                };
                is_all.then_some(hit)
            }
            Operation::Intersection => None,
        }
    }
}

/// Walks both lists by distance and keeps the stretches where `operation` holds. The wall that a
/// difference cuts belongs to the second solid, turned inside out.
fn combine(operation: Operation, first: &Spans, second: &Spans, spans: &mut Spans) {
    let inside_out = matches!(operation, Operation::Difference);
    let turned = |end: Hit| if inside_out { end.turned() } else { end };
    let ends = |list: &Spans, index: usize| {
        list.get(index / 2).map(|span| [span.enter, span.exit][index % 2])
    };
    let [mut i, mut j] = [0, 0];
    let mut enter: Option<Hit> = None;
    loop {
        let end = match (ends(first, i), ends(second, j)) {
            (None, None) => break,
            (Some(a), Some(b)) if a.t <= b.t => take(&mut i, a),
            (Some(a), None) => take(&mut i, a),
            (_, Some(b)) => take(&mut j, turned(b)),
        };
        // An odd number of ends passed: inside.
        let inside = operation.holds(i % 2 == 1, j % 2 == 1);
        match enter {
            None if inside => enter = Some(end),
            Some(start) if !inside => {
                if start.t < end.t {
                    spans.push(Span { enter: start, exit: end });
                }
                enter = None;
            }
            _ => {}
        }
    }
}

fn take(index: &mut usize, end: Hit) -> Hit {
    *index += 1;
    end
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;
    use crate::geometry::transform::{rotation_y, translation};
    use crate::geometry::{ControlPoint, Cuboid, Lathe, Normals, Profile};

    #[test]
    fn what_is_round_is_no_wider_for_being_turned() {
        let points = [(0.0, 0.0), (1.0, 0.0), (0.4, 2.0), (0.0, 2.0)];
        let points = points.map(|(u, v)| ControlPoint { at: DVec2::new(u, v), corner: true });
        let profile = Profile::new(points.to_vec()).expect("a profile");
        let lathe = Lathe::new(&profile, 0, Normals::Flat).expect("a lathe");
        let cube = Csg::leaf(Cuboid::centered(DVec3::splat(0.5)));
        let body = Csg::leaf(lathe).or(cube.clone()).minus(cube.placed(translation(DVec3::Y)));
        let Bounds { min, max } = body.placed_bounds(&rotation_y(30.0));
        assert!(min.distance(DVec3::new(-1.0, -0.5, -1.0)) < 1e-12, "{min}");
        assert!(max.distance(DVec3::new(1.0, 2.0, 1.0)) < 1e-12, "{max}");
        let boxes = body.bounds().transformed(&rotation_y(30.0));
        assert!(boxes.max.x > 1.3);
    }
}
