//! Prisms: a closed outline in the plane of x and y, pushed along the z axis.

use glam::{DAffine3, DVec2, DVec3};
use smallvec::{SmallVec, smallvec};

use super::polygon::{Normals, Segment, surround};
use super::{Bounds, CurveError, Hit, Outline, Ray, Shape, Solid, Span, Spans};

/// What lies within an outline from one height along z to another.
pub struct Prism {
    segments: Vec<Segment>,
    tree: Vec<Node>,
    bounds: Bounds,
}

/// A run of segments in a box. Children follow their parent: the left one at once, the right one at
/// `right`; a leaf has `right == 0` and holds segments `start` to `end`.
struct Node {
    middle: DVec2,
    half: DVec2,
    right: usize,
    start: usize,
    end: usize,
}

/// So many segments are asked one by one.
const LEAF: usize = 4;

/// Room for rounding in the boxes, as a share of the outline's size.
const MARGIN: f64 = 1e-9;

fn build(segments: &[Segment], start: usize, end: usize, tree: &mut Vec<Node>) {
    let ends = segments[start..end].iter().flat_map(|segment| [segment.from, segment.to]);
    let (min, max) = ends
        .fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(min, max), at| (min.min(at), max.max(at)));
    let size = max.abs().max(min.abs()).max_element();
    let half = (max - min) / 2.0 + MARGIN * size;
    let index = tree.len();
    tree.push(Node { middle: (min + max) / 2.0, half, right: 0, start, end });
    if end - start > LEAF {
        let middle = start.midpoint(end);
        build(segments, start, middle, tree);
        tree[index].right = tree.len();
        build(segments, middle, end, tree);
    }
}

impl Prism {
    /// Pushes `outline` after `subdivisions` steps from z = `back` to z = `front`, either of which
    /// may be the greater.
    ///
    /// # Errors
    /// When the subdivided outline bounds nothing or meets itself, or the heights are the same or not
    /// finite.
    pub fn new(
        outline: &Outline,
        subdivisions: u32,
        normals: Normals,
        back: f64,
        front: f64,
    ) -> Result<Prism, CurveError> {
        let segments = outline.segments(subdivisions, normals)?;
        if back == front || !back.is_finite() || !front.is_finite() {
            return Err(CurveError::NoBody);
        }
        let corners = segments.iter().flat_map(|segment| {
            let DVec2 { x, y } = segment.from;
            [DVec3::new(x, y, back), DVec3::new(x, y, front)]
        });
        let mut tree = Vec::new();
        build(&segments, 0, segments.len(), &mut tree);
        Ok(Prism { bounds: Bounds::of(corners), tree, segments })
    }

    /// The subdivided outline, anticlockwise from x towards y.
    pub fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// The hits of the endless prism's walls by the line of `ray`, in ascending order and even in
    /// number: each vertex lies on one side of the line, and a wall is crossed where its ends
    /// lie on different ones. How far they lie off the line says where; so no hit lies off its
    /// wall, not even when the ray runs within it.
    fn walls(&self, ray: &Ray) -> SmallVec<[Hit; 8]> {
        let (origin, direction) = (ray.origin.truncate(), ray.direction.truncate());
        let off = |point: DVec2| direction.perp_dot(point - origin);
        let mut hits: SmallVec<[Hit; 8]> = SmallVec::new();
        let mut pending: SmallVec<[usize; 24]> = smallvec![0];
        while let Some(index) = pending.pop() {
            let node = &self.tree[index];
            // All of a box on one side of the line is not crossed.
            let reach = direction.x.abs() * node.half.y + direction.y.abs() * node.half.x;
            if off(node.middle).abs() > reach {
                continue;
            }
            if node.right != 0 {
                pending.extend([node.right, index + 1]);
                continue;
            }
            for segment in &self.segments[node.start..node.end] {
                let (from, to) = (off(segment.from), off(segment.to));
                if (from > 0.0) == (to > 0.0) {
                    continue;
                }
                let share = from / (from - to);
                let point = segment.from.lerp(segment.to, share);
                let t = (point - origin).dot(direction) / direction.length_squared();
                hits.push(Hit {
                    t,
                    normal: segment.normal.extend(0.0),
                    shading: segment.smooth_normal(share).extend(0.0),
                });
            }
        }
        hits.sort_by(|a, b| a.t.total_cmp(&b.t));
        hits
    }
}

impl Solid for Prism {
    fn shape(&self) -> Shape<'_> {
        Shape::Prism(self)
    }

    fn bounds(&self) -> Bounds {
        self.bounds
    }

    fn placed_bounds(&self, place: &DAffine3) -> Bounds {
        let ends = self.segments.iter().map(|segment| segment.from);
        let corners = ends.flat_map(|end| {
            [self.bounds.min.z, self.bounds.max.z].map(|z| place.transform_point3(end.extend(z)))
        });
        Bounds::of(corners)
    }

    fn contains(&self, point: DVec3) -> bool {
        self.bounds.min.z < point.z
            && point.z < self.bounds.max.z
            && surround(&self.segments, point.truncate())
    }

    fn spans(&self, ray: &Ray, spans: &mut Spans) {
        let Bounds { min, max } = self.bounds;
        let (oz, dz) = (ray.origin.z, ray.direction.z);
        let lids = if dz == 0.0 {
            if oz <= min.z || oz >= max.z {
                return;
            }
            Span {
                enter: Hit::new(f64::NEG_INFINITY, DVec3::NEG_Z),
                exit: Hit::new(f64::INFINITY, DVec3::Z),
            }
        } else {
            let low = Hit::new((min.z - oz) / dz, DVec3::NEG_Z);
            let high = Hit::new((max.z - oz) / dz, DVec3::Z);
            let (enter, exit) = if dz > 0.0 { (low, high) } else { (high, low) };
            Span { enter, exit }
        };
        if ray.direction.truncate() == DVec2::ZERO {
            if self.contains(DVec3::new(ray.origin.x, ray.origin.y, min.z.midpoint(max.z))) {
                spans.push(lids);
            }
            return;
        }
        for pair in self.walls(ray).chunks_exact(2) {
            let enter = if pair[0].t > lids.enter.t { pair[0] } else { lids.enter };
            let exit = if pair[1].t < lids.exit.t { pair[1] } else { lids.exit };
            if enter.t < exit.t {
                spans.push(Span { enter, exit });
            }
        }
    }
}
