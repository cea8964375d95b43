//! What subdivision makes of control points: a chain of straight segments that stands for a curve.

use glam::DVec2;
use smallvec::SmallVec;

/// A vertex of a subdivided curve, with the directions in which the limit curve comes and goes.
#[derive(Clone, Copy, Debug)]
pub struct Vertex {
    pub at: DVec2,
    /// Direction of the limit curve just before and just behind the vertex, of length 1; the same
    /// where the curve has no corner.
    pub arrives: DVec2,
    pub leaves: DVec2,
}

/// A straight piece of a curve. Going along it the outside lies to the right.
#[derive(Clone, Copy, Debug)]
pub struct Segment {
    pub from: DVec2,
    pub to: DVec2,
    /// Outward normal of length 1.
    pub normal: DVec2,
    /// Outward normals of the limit curve at the two ends, of length 1.
    pub smooth: [DVec2; 2],
}

/// Whether polygons are shaded as what they are or as the curves that they stand for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Normals {
    /// One normal a segment, as in the thesis.
    Flat,
    /// Those of the limit curve.
    Smooth,
}

/// Consecutive vertices as segments; the outside lies to their right. Stretches without length
/// are left out.
pub fn segments(vertices: &[Vertex], normals: Normals) -> Vec<Segment> {
    let outward = |along: DVec2| DVec2::new(along.y, -along.x);
    vertices
        .windows(2)
        .filter(|ends| ends[0].at != ends[1].at)
        .map(|ends| {
            let normal = outward((ends[1].at - ends[0].at).normalize());
            let smooth = match normals {
                Normals::Flat => [normal; 2],
                Normals::Smooth => [outward(ends[0].leaves), outward(ends[1].arrives)],
            };
            Segment { from: ends[0].at, to: ends[1].at, normal, smooth }
        })
        .collect()
}

impl Segment {
    /// The outward normal of the limit curve at `share` of the way along, 0 to 1.
    pub fn smooth_normal(&self, share: f64) -> DVec2 {
        self.smooth[0].lerp(self.smooth[1], share).try_normalize().unwrap_or(self.normal)
    }

    /// How far along `point` lies, 0 to 1.
    pub fn share(&self, point: DVec2) -> f64 {
        let along = self.to - self.from;
        ((point - self.from).dot(along) / along.length_squared()).clamp(0.0, 1.0)
    }
}

/// Whether `point` lies within the closed chain of `segments`. (What an open one lacks may only be
/// on the left of every point that is asked for.)
pub fn surround(segments: &[Segment], point: DVec2) -> bool {
    // Segments passed on the way to the right: an odd number when inside.
    let passed = segments.iter().filter(|segment| {
        let (from, to) = (segment.from, segment.to);
        (from.y <= point.y) != (to.y <= point.y)
            && from.x + (point.y - from.y) / (to.y - from.y) * (to.x - from.x) > point.x
    });
    passed.count() % 2 == 1
}

/// A place where two segments meet elsewhere than at the end of one that is the beginning of the
/// next.
pub fn crossing(segments: &[Segment]) -> Option<DVec2> {
    let count = segments.len();
    // Sorted by their left ends, only those that overlap from left to right are compared.
    let left = |index: usize| segments[index].from.x.min(segments[index].to.x);
    let right = |index: usize| segments[index].from.x.max(segments[index].to.x);
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by(|&a, &b| left(a).total_cmp(&left(b)));
    let mut open: SmallVec<[usize; 16]> = SmallVec::new();
    for &index in &order {
        open.retain(|other| right(*other) >= left(index));
        for &other in &open {
            let (first, second) = (&segments[index.min(other)], &segments[index.max(other)]);
            let follows = |a: usize, b: usize| (a + 1) % count == b;
            let meets = if follows(index, other) && segments[index].to == segments[other].from {
                folds_back(&segments[index], &segments[other])
            } else if follows(other, index) && segments[other].to == segments[index].from {
                folds_back(&segments[other], &segments[index])
            } else {
                touches(first, second)
            };
            if meets {
                return Some(first.to);
            }
        }
        open.push(index);
    }
    None
}

/// Whether `next` goes back over the segment that it follows.
fn folds_back(segment: &Segment, next: &Segment) -> bool {
    let (along, on) = (segment.to - segment.from, next.to - next.from);
    along.perp_dot(on) == 0.0 && along.dot(on) < 0.0
}

/// Whether two segments have a point in common.
fn touches(a: &Segment, b: &Segment) -> bool {
    let side = |segment: &Segment, point: DVec2| {
        (segment.to - segment.from).perp_dot(point - segment.from)
    };
    let (a_from, a_to) = (side(b, a.from), side(b, a.to));
    let (b_from, b_to) = (side(a, b.from), side(a, b.to));
    if a_from * a_to < 0.0 && b_from * b_to < 0.0 {
        return true;
    }
    let lies_on = |segment: &Segment, side: f64, point: DVec2| {
        side == 0.0
            && point.cmpge(segment.from.min(segment.to)).all()
            && point.cmple(segment.from.max(segment.to)).all()
    };
    lies_on(b, a_from, a.from)
        || lies_on(b, a_to, a.to)
        || lies_on(a, b_from, b.from)
        || lies_on(a, b_to, b.to)
}
