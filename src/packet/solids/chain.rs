//! Chains of segments, which lathes and prisms are made of: trees over them, and their normals.

use glam::DVec2;

use crate::geometry::Segment;
use crate::lanes::{F32x8, Mask8, Simd, U32x8};

/// So much of the chain's size may rounding move what is met.
pub const ROUNDING: f64 = 1e-6;

/// So much of the chain's size boxes are larger than what they hold, to all sides: more than rounding moves.
const MARGIN: f64 = 1e-5;

/// Normals that differ by less are the same.
const SAME: f64 = 1e-9;

/// `segments` without joints at which nothing changes: edges of control polygons come in many pieces.
pub fn merged(segments: &[Segment]) -> Vec<Segment> {
    let is_straight = |segment: &Segment| {
        segment.smooth.iter().all(|smooth| smooth.distance(segment.normal) < SAME)
    };
    let mut merged: Vec<Segment> = Vec::with_capacity(segments.len());
    for segment in segments {
        match merged.last_mut() {
            Some(last)
                if last.to == segment.from
                    && last.normal.distance(segment.normal) < SAME
                    && is_straight(last)
                    && is_straight(segment) =>
            {
                last.to = segment.to;
            }
            _ => merged.push(*segment),
        }
    }
    merged
}

/// The greatest coordinate of `segments`, by its amount.
pub fn size(segments: &[Segment]) -> f64 {
    let ends = segments.iter().flat_map(|segment| [segment.from, segment.to]);
    ends.fold(0.0, |size: f64, end| size.max(end.abs().max_element()))
}

/// A box round a run of a chain.
#[derive(Clone, Copy, Debug)]
pub struct Bounds {
    pub min: DVec2,
    pub max: DVec2,
}

impl Bounds {
    /// The least box round `segments`.
    pub fn of(segments: &[Segment]) -> Bounds {
        let ends = segments.iter().flat_map(|segment| [segment.from, segment.to]);
        let nothing = Bounds { min: DVec2::INFINITY, max: DVec2::NEG_INFINITY };
        ends.fold(nothing, |bounds, end| Bounds {
            min: bounds.min.min(end),
            max: bounds.max.max(end),
        })
    }

    /// The box made larger to all sides.
    pub fn grown(self, by: f64) -> Bounds {
        Bounds { min: self.min - by, max: self.max + by }
    }

    /// How likely a line meets it, in no unit.
    fn girth(&self) -> f64 {
        let size = self.max - self.min;
        size.x + size.y
    }

    fn union(self, other: Bounds) -> Bounds {
        Bounds { min: self.min.min(other.min), max: self.max.max(other.max) }
    }
}

/// A binary tree over a chain; nodes lie in the order in which they are asked, so that there is nothing to
/// remember on the way.
pub struct Tree<B> {
    nodes: Vec<Node<B>>,
}

struct Node<B> {
    bounds: B,
    /// Where the tree goes on when this node is not met, behind all that is below it.
    beyond: u32,
    /// The segment of a leaf.
    segment: u32,
}

/// The segment of a node that is no leaf.
const NONE: u32 = u32::MAX;

/// How a chain is cut in two, and its halves again, down to single segments.
pub struct Cuts {
    /// With room for rounding.
    bounds: Bounds,
    /// The first segment's number.
    first: usize,
    halves: Option<Box<[Cuts; 2]>>,
}

impl Cuts {
    /// None where there is nothing to cut.
    pub fn new(segments: &[Segment]) -> Option<Cuts> {
        let margin = MARGIN * size(segments);
        (!segments.is_empty()).then(|| Cuts::of(segments, 0, 0, margin))
    }

    fn of(segments: &[Segment], first: usize, depth: usize, margin: f64) -> Cuts {
        if segments.len() == 1 {
            return Cuts { bounds: Bounds::of(segments).grown(margin), first, halves: None };
        }
        let middle = if depth < DEEPEST { best_split(segments) } else { segments.len() / 2 };
        let (low, high) = segments.split_at(middle);
        let half = |run, first| Cuts::of(run, first, depth + 1, margin);
        let halves = [half(low, first), half(high, first + middle)];
        let bounds = halves[0].bounds.union(halves[1].bounds);
        Cuts { bounds, first, halves: Some(Box::new(halves)) }
    }
}

impl<B> Tree<B> {
    /// The tree that `cuts` make, with each box in the form that rays ask for; from the last segment to the first one
    /// if `is_backward`.
    pub fn new(cuts: Option<&Cuts>, is_backward: bool, form: impl Fn(Bounds) -> B) -> Tree<B> {
        let mut nodes = Vec::new();
        if let Some(cuts) = cuts {
            grow(cuts, is_backward, &form, &mut nodes);
        }
        Tree { nodes }
    }

    /// Calls `leaf` with each segment whose boxes, from the root down, `meets` says yes to, until it has enough and
    /// says so by `true`.
    #[inline(always)]
    pub fn walk<T>(
        &self,
        state: &mut T,
        meets: impl Fn(&T, &B) -> bool,
        mut leaf: impl FnMut(&mut T, usize) -> bool,
    ) {
        let mut index = 0;
        while let Some(node) = self.nodes.get(index) {
            if !meets(state, &node.bounds) {
                index = node.beyond as usize;
                continue;
            }
            index += 1;
            if node.segment != NONE && leaf(state, node.segment as usize) {
                return;
            }
        }
    }

    /// The box of the whole chain.
    pub fn root(&self) -> Option<&B> {
        self.nodes.first().map(|node| &node.bounds)
    }
}

/// Adds a part of a tree.
fn grow<B>(cuts: &Cuts, is_backward: bool, form: &impl Fn(Bounds) -> B, nodes: &mut Vec<Node<B>>) {
    let index = nodes.len();
    let segment = if cuts.halves.is_none() { cuts.first as u32 } else { NONE };
    nodes.push(Node { bounds: form(cuts.bounds), beyond: 0, segment });
    if let Some([low, high]) = cuts.halves.as_deref() {
        for half in if is_backward { [high, low] } else { [low, high] } {
            grow(half, is_backward, form, nodes);
        }
    }
    nodes[index].beyond = nodes.len() as u32;
}

/// Below so many levels, runs are halved.
const DEEPEST: usize = 40;

/// Where to cut a run so that lines meet few segments' boxes: the sum of girth times number is least (the surface-area
/// heuristic of J. D. MacDonald and K. S. Booth, 1990, in the plane).
fn best_split(segments: &[Segment]) -> usize {
    let bounds = |segment: &Segment| Bounds::of(std::slice::from_ref(segment));
    let joined = |sum: &mut Option<Bounds>, segment: &Segment| {
        let all = sum.map_or(bounds(segment), |sum| sum.union(bounds(segment)));
        *sum = Some(all);
        Some(all.girth())
    };
    let low: Vec<f64> = segments.iter().scan(None, joined).collect();
    let mut high: Vec<f64> = segments.iter().rev().scan(None, joined).collect();
    high.reverse();
    let cost = |at: usize| low[at - 1] * at as f64 + high[at] * (segments.len() - at) as f64;
    (1..segments.len()).min_by(|a, b| cost(*a).total_cmp(&cost(*b))).unwrap_or(1)
}

/// The normals along a chain.
pub struct Slopes {
    /// So many numbers a segment: its normal; the smooth one where it begins, and what it has gained where it ends;
    /// what makes a share of the way of a point.
    table: Vec<f32>,
    /// Whether the smooth normals are the segments' own.
    is_flat: bool,
}

/// Numbers a segment in the table, a power of two so that none lies across two lines of the cache.
const ROW: usize = 16;

/// Normals in a chain's plane.
pub struct Slope<S: Simd> {
    pub flat: [F32x8<S>; 2],
    pub smooth: [F32x8<S>; 2],
}

impl Slopes {
    pub fn new(segments: &[Segment]) -> Slopes {
        let row = |segment: &Segment| {
            let along = segment.to - segment.from;
            let along = along / along.length_squared();
            let gained = segment.smooth[1] - segment.smooth[0];
            let row = [
                segment.normal.to_array(),
                segment.smooth[0].to_array(),
                gained.to_array(),
                along.to_array(),
                [along.dot(segment.from), 0.0],
            ];
            let mut numbers = [0.0; ROW];
            for (number, exact) in numbers.iter_mut().zip(row.as_flattened()) {
                *number = *exact as f32;
            }
            numbers
        };
        let is_flat = segments.iter().all(|segment| segment.smooth == [segment.normal; 2]);
        Slopes { table: segments.iter().flat_map(row).collect(), is_flat }
    }

    /// The normals of `segments` at the points (x, y) of them.
    #[inline(always)]
    pub fn at<S: Simd>(&self, x: F32x8<S>, y: F32x8<S>, segments: U32x8<S>) -> Slope<S> {
        let row = segments * U32x8::splat(ROW as u32);
        let flat = [self.number(row, 0), self.number(row, 1)];
        if self.is_flat {
            return Slope { flat, smooth: flat };
        }
        let way = x * self.number(row, 6) + y * self.number(row, 7) - self.number(row, 8);
        let share = way.clamp(0.0, 1.0);
        let smooth_x = self.number(row, 2) + self.number(row, 4) * share;
        let smooth_y = self.number(row, 3) + self.number(row, 5) * share;
        let length2 = smooth_x * smooth_x + smooth_y * smooth_y;
        let has_length = length2.gt(F32x8::splat(1e-12));
        let by = length2.sqrt().recip();
        let smooth =
            [has_length.select(smooth_x * by, flat[0]), has_length.select(smooth_y * by, flat[1])];
        Slope { flat, smooth }
    }

    #[inline(always)]
    fn number<S: Simd>(&self, row: U32x8<S>, column: u32) -> F32x8<S> {
        F32x8::gather(&self.table, row + U32x8::splat(column))
    }
}

/// Where one of the answers is yes, and not the other.
#[inline(always)]
pub fn either<S: Simd>(a: Mask8<S>, b: Mask8<S>) -> Mask8<S> {
    (a | b).but(a & b)
}
