//! A tree of boxes: which of many bodies rays may meet.

use glam::Vec3;

use super::world::enters;
use crate::lanes::{F32x8, Mask8, Simd};
use crate::packet::Rays;

/// Numbers of bodies, by their boxes.
#[derive(Default)]
pub struct Tree {
    /// The root first; each with what is below it behind it.
    nodes: Vec<Node>,
}

struct Node {
    bounds: [Vec3; 2],
    /// The body, where nothing is below.
    body: Option<usize>,
    /// How many nodes further the first is that is not below this one.
    skip: usize,
}

impl Tree {
    /// Of boxes by their lower and upper corners; bodies are numbered as they are.
    pub fn new(boxes: &[[Vec3; 2]]) -> Tree {
        let mut tree = Tree::default();
        let mut all: Vec<usize> = (0..boxes.len()).collect();
        if !all.is_empty() {
            tree.add(boxes, &mut all);
        }
        tree
    }

    /// Adds a node over some bodies, of which there is at least one.
    fn add(&mut self, boxes: &[[Vec3; 2]], some: &mut [usize]) {
        let nothing = [Vec3::INFINITY, Vec3::NEG_INFINITY];
        let bounds = some.iter().fold(nothing, |[min, max], index| {
            let [low, high] = boxes[*index];
            [min.min(low), max.max(high)]
        });
        let place = self.nodes.len();
        let body = if let [one] = some { Some(*one) } else { None };
        self.nodes.push(Node { bounds, body, skip: 1 });
        if body.is_none() {
            let extent = bounds[1] - bounds[0];
            let axis = extent.max_position();
            let middle = |index: &usize| boxes[*index][0][axis] + boxes[*index][1][axis];
            some.sort_by(|a, b| middle(a).total_cmp(&middle(b)));
            let (left, right) = some.split_at_mut(some.len() / 2);
            self.add(boxes, left);
            self.add(boxes, right);
        }
        self.nodes[place].skip = self.nodes.len() - place;
    }

    /// Shows `look` the bodies whose boxes rays enter before `before`, with the lanes that do.
    #[inline(always)]
    pub fn visit<S: Simd>(
        &self,
        rays: &Rays<S>,
        before: F32x8<S>,
        lanes: Mask8<S>,
        mut look: impl FnMut(usize, Mask8<S>),
    ) {
        let inverse = rays.direction.recips();
        let mut index = 0;
        while let Some(node) = self.nodes.get(index) {
            let near = lanes & enters(rays, inverse, node.bounds, before);
            match (near.any(), node.body) {
                (false, _) => index += node.skip,
                (true, None) => index += 1,
                (true, Some(body)) => {
                    look(body, near);
                    index += 1;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::{Task, Vec3x8, dispatch};
    use proptest::prelude::*;

    /// Which bodies a packet of rays is shown, and to which lanes.
    struct Visit<'a>(&'a Tree, [Vec3; 8], [Vec3; 8]);

    impl Task for Visit<'_> {
        type Output = Vec<(usize, u8)>;

        #[inline(always)]
        fn run<S: Simd>(self) -> Vec<(usize, u8)> {
            let Visit(tree, origin, direction) = self;
            let load = |of: [Vec3; 8]| Vec3x8::<S>::load(&of.map(Vec3::as_dvec3));
            let rays = Rays { origin: load(origin), direction: load(direction) };
            let mut seen = Vec::new();
            tree.visit(&rays, F32x8::splat(9.0), Mask8::all_lanes(), |body, lanes| {
                seen.push((body, lanes.bits()));
            });
            seen.sort_unstable();
            seen
        }
    }

    fn places(of: std::ops::Range<f32>) -> impl Strategy<Value = Vec3> {
        (of.clone(), of.clone(), of).prop_map(|(x, y, z)| Vec3::new(x, y, z))
    }

    proptest! {
        #[test]
        fn all_boxes_that_are_entered_are_shown_once(
            boxes in prop::collection::vec((places(-5.0..5.0), places(0.1..3.0)), 0..40),
            origin in prop::array::uniform8(places(-9.0..9.0)),
            direction in prop::array::uniform8(places(-1.0..1.0)),
        ) {
            let boxes: Vec<[Vec3; 2]> =
                boxes.into_iter().map(|(min, extent)| [min, min + extent]).collect();
            let found = dispatch(Visit(&Tree::new(&boxes), origin, direction));
            let each: Vec<(usize, u8)> = (0..boxes.len())
                .flat_map(|index| {
                    let alone = Tree::new(&boxes[index..=index]);
                    let seen = dispatch(Visit(&alone, origin, direction));
                    seen.into_iter().map(move |(_, lanes)| (index, lanes))
                })
                .collect();
            prop_assert_eq!(found, each);
        }
    }
}
