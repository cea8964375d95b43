//! A tree of boxes round the objects of a scene, so that a ray asks few of them.

use smallvec::{SmallVec, smallvec};

use crate::geometry::{Bounds, Hit, Interval, Ray, Solid};
use crate::scene::Object;

/// A bounding volume hierarchy, halved at the median along the longest side.
pub struct Hierarchy<'a> {
    objects: &'a [Object],
    nodes: Vec<Node>,
}

/// Children follow their parent: the first one at once, the second at `second`.
struct Node {
    bounds: Bounds,
    content: Content,
}

enum Content {
    Object(usize),
    Pair { second: usize },
}

impl<'a> Hierarchy<'a> {
    /// Builds the tree for `objects`.
    pub fn new(objects: &'a [Object]) -> Hierarchy<'a> {
        let mut order: Vec<usize> = (0..objects.len()).collect();
        let mut nodes = Vec::with_capacity(2 * objects.len());
        if !order.is_empty() {
            build(objects, &mut order, &mut nodes);
        }
        Hierarchy { objects, nodes }
    }

    /// The nearest object in front of `ray`, and where the ray meets it.
    pub fn nearest(&self, ray: &Ray) -> Option<(&'a Object, Hit)> {
        let mut range = Interval::AHEAD;
        let mut found = None;
        self.visit(ray, &mut range, |object, range| {
            if let Some(hit) = object.body.nearest(ray, *range) {
                range.max = hit.t;
                found = Some((object, hit));
            }
            false
        });
        found
    }

    /// Whether anything stands in the way of `ray` before `distance`.
    pub fn blocks(&self, ray: &Ray, distance: f64) -> bool {
        let mut range = Interval::up_to(distance);
        self.visit(ray, &mut range, |object, range| object.body.blocks(ray, *range))
    }

    /// Shows `look` every object whose box meets `ray` within `range`, which `look` may shorten,
    /// until it says true.
    fn visit(
        &self,
        ray: &Ray,
        range: &mut Interval,
        mut look: impl FnMut(&'a Object, &mut Interval) -> bool,
    ) -> bool {
        let mut pending: SmallVec<[usize; 16]> = smallvec![];
        if !self.nodes.is_empty() {
            pending.push(0);
        }
        while let Some(index) = pending.pop() {
            let node = &self.nodes[index];
            if node.bounds.clip(ray, *range).is_none() {
                continue;
            }
            match node.content {
                Content::Pair { second } => pending.extend([second, index + 1]),
                Content::Object(object) => {
                    if look(&self.objects[object], range) {
                        return true;
                    }
                }
            }
        }
        false
    }
}

fn build(objects: &[Object], order: &mut [usize], nodes: &mut Vec<Node>) {
    let bounds = |index: usize| objects[index].body.bounds();
    let all = order.iter().fold(Bounds::EMPTY, |all, &index| all.union(bounds(index)));
    let index = nodes.len();
    nodes.push(Node { bounds: all, content: Content::Object(order[0]) });
    if order.len() == 1 {
        return;
    }
    let axis = (all.max - all.min).max_position();
    let middle = |index: usize| (bounds(index).min[axis] + bounds(index).max[axis]) / 2.0;
    order.sort_by(|&a, &b| middle(a).total_cmp(&middle(b)));
    let (first, second) = order.split_at_mut(order.len() / 2);
    build(objects, first, nodes);
    nodes[index].content = Content::Pair { second: nodes.len() };
    build(objects, second, nodes);
}
