//! A tree of boxes round the objects of a scene, so that a ray asks few of them.

use smallvec::{SmallVec, smallvec};

use crate::geometry::{Bounds, Hit, Interval, Ray, Solid, Spans};
use crate::scene::Object;

/// A bounding volume hierarchy, halved at the median along the longest side.
pub struct Hierarchy<'a> {
    objects: &'a [Object],
    nodes: Vec<Node>,
    /// What has no end is in no box.
    endless: Vec<usize>,
}

/// Surfaces of two bodies that are no farther apart along a ray than this, in world units, touch:
/// which of them a ray meets first is not for rounding to say.
const CONTACT: f64 = 1e-6;

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
        let (mut order, endless): (Vec<usize>, Vec<usize>) =
            (0..objects.len()).partition(|index| objects[*index].body.bounds().is_finite());
        let mut nodes = Vec::with_capacity(2 * objects.len());
        if !order.is_empty() {
            build(objects, &mut order, &mut nodes);
        }
        Hierarchy { objects, nodes, endless }
    }

    /// The nearest object in front of `ray` up to `distance`, and where the ray meets it.
    pub fn nearest(&self, ray: &Ray, distance: f64) -> Option<(usize, Hit)> {
        let mut range = Interval::up_to(distance);
        let mut found: Option<(usize, Hit)> = None;
        // Of bodies in contact what is opaque is seen, and of others of a kind the first.
        let rank = |index: usize| (self.objects[index].surface.is_transparent(), index);
        self.visit(ray, &mut range, |index, range| {
            if let Some(hit) = self.objects[index].body.nearest(ray, *range) {
                let is_seen = found.is_none_or(|(other, best)| {
                    let apart = hit.t - best.t;
                    apart < -CONTACT || apart <= CONTACT && rank(index) < rank(other)
                });
                if is_seen {
                    found = Some((index, hit));
                    range.max = range.max.min(hit.t + CONTACT);
                }
            }
            false
        });
        found
    }

    /// How much of a light at `distance` comes along `ray`: what is opaque holds all of it back,
    /// each surface of what is transparent lets its share through. (A line bends at none of them.)
    pub fn transmission(&self, ray: &Ray, distance: f64) -> f64 {
        let mut range = Interval::up_to(distance);
        let mut share = 1.0;
        self.visit(ray, &mut range, |index, range| {
            let object = &self.objects[index];
            if object.surface.is_transparent() {
                share *= transmission(object, ray, *range);
            } else if object.body.blocks(ray, *range) {
                share = 0.0;
            }
            share == 0.0
        });
        share
    }

    /// Shows `look` the index of every object whose box meets `ray` within `range`, which `look` may shorten,
    /// until it says true.
    fn visit(
        &self,
        ray: &Ray,
        range: &mut Interval,
        mut look: impl FnMut(usize, &mut Interval) -> bool,
    ) {
        if self.endless.iter().any(|index| look(*index, range)) {
            return;
        }
        let inverse = ray.direction.recip();
        let mut pending: SmallVec<[usize; 16]> = smallvec![];
        if !self.nodes.is_empty() {
            pending.push(0);
        }
        while let Some(index) = pending.pop() {
            let node = &self.nodes[index];
            if node.bounds.clip_by(ray.origin, inverse, *range).is_none() {
                continue;
            }
            match node.content {
                Content::Pair { second } => pending.extend([second, index + 1]),
                Content::Object(object) => {
                    if look(object, range) {
                        return;
                    }
                }
            }
        }
    }
}

/// What the surfaces of a transparent object within `range` let through.
fn transmission(object: &Object, ray: &Ray, range: Interval) -> f64 {
    let mut spans = Spans::new();
    object.body.spans(ray, &mut spans);
    let ends = spans.iter().flat_map(|span| [span.enter, span.exit]);
    let share = |hit: Hit| object.material(ray.at(hit.t), hit.normal).0.finish.transparency;
    ends.filter(|hit| range.holds(hit.t)).map(share).product()
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
