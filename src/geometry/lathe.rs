//! Bodies of revolution: a profile turned about the y axis.
//!
//! In the half-plane of the profile a point has u² = x² + z² and v = y, and a ray has
//! u² = |p + q·t|² with its horizontal origin p and direction q. A segment of the profile lies on
//! the line `nu·u + nv·v = w`, which turned about the axis is a cone; put together they give a
//! quadratic in t (Turek 2008, 3.7.5, with the segment in normal form: steep and flat segments
//! are then the same case).

use glam::{DAffine3, DVec2, DVec3};

use super::polygon::{Normals, Segment, surround};
use super::{Bounds, CurveError, Hit, Interval, Profile, Ray, Shape, Solid, Span, Spans};

/// A profile turned about the y axis; its heights are y.
pub struct Lathe {
    segments: Vec<Segment>,
    tree: Vec<Node>,
    bounds: Bounds,
}

/// A run of segments with bounds in (u², v). Children follow their parent: the left one at once,
/// the right one at `right`; a leaf has `right == 0` and holds one segment.
struct Node {
    min_u2: f64,
    max_u2: f64,
    min_v: f64,
    max_v: f64,
    right: usize,
    segment: usize,
}

/// Room for rounding in the bounds of nodes, in units of the profile (and of the ray, about 1).
const MARGIN: f64 = 1e-9;

impl Lathe {
    /// Turns `profile` after `subdivisions` steps.
    ///
    /// # Errors
    /// When the subdivided profile bounds nothing, or meets itself.
    pub fn new(
        profile: &Profile,
        subdivisions: u32,
        normals: Normals,
    ) -> Result<Lathe, CurveError> {
        let segments = profile.segments(subdivisions, normals)?;
        let mut tree = Vec::with_capacity(2 * segments.len());
        build(&segments, 0, segments.len(), &mut tree);
        let points = || segments.iter().flat_map(|segment| [segment.from, segment.to]);
        let radius = points().fold(0.0, |radius: f64, point| radius.max(point.x));
        let bounds = Bounds::of(points().flat_map(|point| {
            [DVec3::new(radius, point.y, radius), DVec3::new(-radius, point.y, -radius)]
        }));
        Ok(Lathe { segments, tree, bounds })
    }

    /// The subdivided profile in (u, v), without what lies on the axis.
    pub fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// Calls `found(t, segment)` for each hit of the line of `ray` within `range`, in no
    /// order; `found` gives back how far it still wants to be told.
    fn hits<'a>(
        &'a self,
        ray: &Ray,
        range: Interval,
        mut found: impl FnMut(f64, &'a Segment) -> f64,
    ) {
        // The clipped range is finite and culls nodes, which have a margin; hits are held
        // against the range itself.
        let Some(mut within) = self.bounds.clip(ray, range) else {
            return;
        };
        let mut range = range;
        let line = AxisLine::new(ray);
        let mut pending: smallvec::SmallVec<[usize; 24]> = smallvec::smallvec![0];
        while let Some(index) = pending.pop() {
            let node = &self.tree[index];
            if !line.may_meet(node, within) {
                continue;
            }
            if node.right != 0 {
                pending.push(node.right);
                pending.push(index + 1);
                continue;
            }
            let segment = &self.segments[node.segment];
            for t in line.meet(segment) {
                if range.holds(t) {
                    range.max = range.max.min(found(t, segment));
                    within.max = within.max.min(range.max + MARGIN);
                }
            }
        }
    }
}

fn build(segments: &[Segment], start: usize, end: usize, tree: &mut Vec<Node>) {
    let mut node = Node {
        min_u2: f64::INFINITY,
        max_u2: 0.0,
        min_v: f64::INFINITY,
        max_v: f64::NEG_INFINITY,
        right: 0,
        segment: start,
    };
    for point in segments[start..end].iter().flat_map(|segment| [segment.from, segment.to]) {
        let (inner, outer) = ((point.x - MARGIN).max(0.0), point.x + MARGIN);
        node.min_u2 = node.min_u2.min(inner * inner);
        node.max_u2 = node.max_u2.max(outer * outer);
        node.min_v = node.min_v.min(point.y - MARGIN);
        node.max_v = node.max_v.max(point.y + MARGIN);
    }
    let index = tree.len();
    tree.push(node);
    if end - start > 1 {
        let middle = start.midpoint(end);
        build(segments, start, middle, tree);
        tree[index].right = tree.len();
        build(segments, middle, end, tree);
    }
}

/// A ray as the axis sees it.
struct AxisLine {
    /// Height of the origin, and its change with t.
    oy: f64,
    dy: f64,
    /// |p|², p·q, |q|² and (p × q)² of the horizontal origin and direction.
    pp: f64,
    pq: f64,
    qq: f64,
    cross2: f64,
    /// Where the ray is nearest to the axis.
    closest: f64,
}

impl AxisLine {
    fn new(ray: &Ray) -> AxisLine {
        let p = DVec2::new(ray.origin.x, ray.origin.z);
        let q = DVec2::new(ray.direction.x, ray.direction.z);
        let (pq, qq, cross) = (p.dot(q), q.length_squared(), p.perp_dot(q));
        AxisLine {
            oy: ray.origin.y,
            dy: ray.direction.y,
            pp: p.length_squared(),
            pq,
            qq,
            cross2: cross * cross,
            closest: if qq > 0.0 { -pq / qq } else { 0.0 },
        }
    }

    /// u² at distance `t`.
    fn u2(&self, t: f64) -> f64 {
        self.pp + t * (2.0 * self.pq + t * self.qq)
    }

    fn may_meet(&self, node: &Node, range: Interval) -> bool {
        let (mut start, mut end) = (range.min, range.max);
        if self.dy == 0.0 {
            if self.oy < node.min_v || self.oy > node.max_v {
                return false;
            }
        } else {
            let low = (node.min_v - self.oy) / self.dy;
            let high = (node.max_v - self.oy) / self.dy;
            start = start.max(low.min(high));
            end = end.min(low.max(high));
            if start > end {
                return false;
            }
        }
        let nearest = self.u2(self.closest.max(start).min(end));
        let farthest = self.u2(start).max(self.u2(end));
        nearest <= node.max_u2 && farthest >= node.min_u2
    }

    /// The distances at which the ray crosses the turned segment; a segment owns its first end.
    fn meet(&self, segment: &Segment) -> smallvec::SmallVec<[f64; 2]> {
        let (nu, nv) = (segment.normal.x, segment.normal.y);
        // The segment's line is nu·u + nv·v = w.
        let h = segment.normal.dot(segment.from) - nv * self.oy;
        let g = -nv * self.dy;
        let owns = |t: f64| {
            let (du, dv) = (segment.to.x - segment.from.x, segment.to.y - segment.from.y);
            let along = if dv.abs() > du.abs() {
                (self.oy + self.dy * t - segment.from.y) / dv
            } else {
                (self.u2(t).max(0.0).sqrt() - segment.from.x) / du
            };
            // The next segment has the second end; behind one that ends on the axis there is none.
            (0.0..1.0).contains(&along) || along == 1.0 && segment.to.x == 0.0
        };
        if nu == 0.0 {
            // A flat ring: the plane v = w / nv.
            return [-h / g].into_iter().filter(|&t| t.is_finite() && owns(t)).collect();
        }
        let nu2 = nu * nu;
        let a = nu2 * self.qq - g * g;
        let b = nu2 * self.pq - h * g;
        let c = nu2 * self.pp - h * h;
        // b² − a·c, written so that nothing large cancels.
        let discriminant =
            nu2 * (h * h * self.qq + g * g * self.pp - 2.0 * h * g * self.pq - nu2 * self.cross2);
        if discriminant < 0.0 {
            return smallvec::SmallVec::new();
        }
        let root = discriminant.sqrt();
        let stable = if b < 0.0 { root - b } else { -root - b };
        // The other nappe of the cone has u < 0; rounding must not lose its tip, where u is 0.
        let in_front = |t: f64| (h + g * t) / nu >= -MARGIN;
        [stable / a, c / stable]
            .into_iter()
            .filter(|&t| t.is_finite() && in_front(t) && owns(t))
            .collect()
    }
}

/// Where a ray at distance `t` meets the turned `segment`.
fn hit(ray: &Ray, t: f64, segment: &Segment) -> Hit {
    let point = ray.at(t);
    let u = (point.x * point.x + point.z * point.z).sqrt();
    let turned = |normal: DVec2| {
        if u == 0.0 {
            // On the axis the normals from all round it have it as their middle.
            return DVec3::Y * normal.y.signum();
        }
        let radial = normal.x / u;
        DVec3::new(radial * point.x, normal.y, radial * point.z)
    };
    let flat = Hit::new(t, turned(segment.normal));
    if segment.smooth == [segment.normal; 2] {
        return flat;
    }
    let share = segment.share(DVec2::new(u, point.y));
    Hit { shading: turned(segment.smooth_normal(share)), ..flat }
}

impl Solid for Lathe {
    fn shape(&self) -> Shape<'_> {
        Shape::Lathe(self)
    }

    fn bounds(&self) -> Bounds {
        self.bounds
    }

    fn placed_bounds(&self, place: &DAffine3) -> Bounds {
        let ends = self.segments.iter().flat_map(|segment| [segment.from, segment.to]);
        let disk =
            |end: DVec2| Bounds::round(DVec3::Y * end.y, end.x, &[DVec3::X, DVec3::Z], place);
        ends.map(disk).fold(Bounds::EMPTY, Bounds::union)
    }

    fn contains(&self, point: DVec3) -> bool {
        let u2 = point.x * point.x + point.z * point.z;
        let place = DVec2::new(u2.sqrt(), point.y);
        // An odd number of segments lies farther out when inside; runs without any are left out.
        let mut inside = false;
        let mut pending: smallvec::SmallVec<[usize; 24]> = smallvec::smallvec![0];
        while let Some(index) = pending.pop() {
            let node = &self.tree[index];
            if point.y < node.min_v || point.y > node.max_v || u2 > node.max_u2 {
                continue;
            }
            if node.right == 0 {
                inside ^= surround(&self.segments[node.segment..=node.segment], place);
            } else {
                pending.extend([node.right, index + 1]);
            }
        }
        inside
    }

    fn spans(&self, ray: &Ray, spans: &mut Spans) {
        let mut ends: smallvec::SmallVec<[Hit; 8]> = smallvec::SmallVec::new();
        self.hits(ray, Interval::WHOLE_LINE, |t, segment| {
            ends.push(hit(ray, t, segment));
            f64::INFINITY
        });
        ends.sort_by(|a, b| a.t.total_cmp(&b.t));
        // A ray that grazes a joint may lose one of a pair to rounding; a lone end bounds nothing.
        let mut enter = None;
        for end in ends {
            if end.normal.dot(ray.direction) < 0.0 {
                enter = enter.or(Some(end));
            } else if let Some(enter) = enter.take() {
                spans.push(Span { enter, exit: end });
            }
        }
    }

    fn nearest(&self, ray: &Ray, range: Interval) -> Option<Hit> {
        let mut nearest: Option<(f64, &Segment)> = None;
        self.hits(ray, range, |t, segment| {
            if nearest.is_none_or(|(best, _)| t < best) {
                nearest = Some((t, segment));
            }
            t
        });
        nearest.map(|(t, segment)| hit(ray, t, segment))
    }
}
