//! Boxes round what rays may meet, and a tree of them.

use glam::{DVec3, Vec3};

use super::Rays;
use crate::geometry::Bounds;
use crate::lanes::{F32x8, Mask8, Simd, Vec3x8};

/// Rays as boxes ask for them.
#[derive(Clone, Copy)]
pub struct Way<S: Simd> {
    origin: Vec3x8<S>,
    /// The directions' reciprocals.
    pub per_length: Vec3x8<S>,
    /// Which lanes go down along each axis.
    falls: [u8; 3],
}

impl<S: Simd> Way<S> {
    #[inline(always)]
    pub fn new(rays: &Rays<S>) -> Way<S> {
        let (direction, zero) = (rays.direction, F32x8::splat(0.0));
        Way {
            origin: rays.origin,
            per_length: direction.recips(),
            falls: [
                direction.x.lt(zero).bits(),
                direction.y.lt(zero).bits(),
                direction.z.lt(zero).bits(),
            ],
        }
    }
}

/// A box along the axes, a little larger than what it holds.
#[derive(Clone, Copy, Debug)]
pub struct Aabb {
    pub min: Vec3,
    pub max: Vec3,
}

/// How much larger, for solids within `bounds`: more than rounding errors.
pub fn margin(bounds: &Bounds) -> f64 {
    let size = (bounds.max - bounds.min).max_element();
    3e-5 + if size.is_finite() { 1e-5 * size.max(0.0) } else { 0.0 }
}

impl Aabb {
    pub fn new(bounds: &Bounds, margin: f64) -> Aabb {
        Aabb { min: (bounds.min - margin).as_vec3(), max: (bounds.max + margin).as_vec3() }
    }

    /// The smallest box round points of some lanes; one of nothing where there are none.
    #[inline(always)]
    pub fn of_points<S: Simd>(points: Vec3x8<S>, lanes: Mask8<S>) -> Aabb {
        if !lanes.any() {
            return Aabb::union([]);
        }
        // Lanes that do not count are as one that does.
        let one = points.rows().lane(lanes.bits().trailing_zeros() as usize);
        let points = Vec3x8::select(lanes, points, Vec3x8::splat(one));
        let [x, y, z] = [points.x.range(), points.y.range(), points.z.range()];
        Aabb { min: Vec3::new(x[0], y[0], z[0]), max: Vec3::new(x[1], y[1], z[1]) }
    }

    /// The smallest box round the points at `t` of the `lanes` of packets of rays.
    #[inline(always)]
    pub fn of_packets<S: Simd>(packets: &[Rays<S>], t: F32x8<S>, lanes: Mask8<S>) -> Aabb {
        let [first, others @ ..] = packets else {
            return Aabb::union([]);
        };
        let (mut low, mut high) = (first.at(t), first.at(t));
        for rays in others {
            let points = rays.at(t);
            (low, high) = (low.min(points), high.max(points));
        }
        let (low, high) = (Aabb::of_points(low, lanes), Aabb::of_points(high, lanes));
        Aabb { min: low.min, max: high.max }
    }

    /// The smallest box round some boxes; one of nothing where there are none.
    pub fn union(boxes: impl IntoIterator<Item = Aabb>) -> Aabb {
        let nothing = Aabb { min: Vec3::INFINITY, max: Vec3::NEG_INFINITY };
        boxes.into_iter().fold(nothing, |round, aabb| Aabb {
            min: round.min.min(aabb.min),
            max: round.max.max(aabb.max),
        })
    }

    pub fn bounds(&self) -> Bounds {
        Bounds { min: self.min.as_dvec3(), max: self.max.as_dvec3() }
    }

    /// The middle; that of endless boxes is the origin.
    pub fn middle(&self) -> Vec3 {
        let middle = (self.min + self.max) / 2.0;
        if middle.is_finite() { middle } else { Vec3::ZERO }
    }

    /// Where lines enter and leave; what misses leaves before it enters.
    #[inline(always)]
    pub fn clip<S: Simd>(&self, way: &Way<S>) -> (F32x8<S>, F32x8<S>) {
        let low = (Vec3x8::splat(self.min) - way.origin).times(way.per_length);
        let high = (Vec3x8::splat(self.max) - way.origin).times(way.per_length);
        // Along an axis and within a face a distance may be no number: then it counts for nothing.
        let (near, far) = (low.min(high), low.max(high));
        let infinity = F32x8::splat(f32::INFINITY);
        let enter = near.x.max(near.y.max(near.z.max(-infinity)));
        let exit = far.x.min(far.y.min(far.z.min(infinity)));
        (enter, exit)
    }

    /// Which lines meet it between `after` and `before`.
    #[inline(always)]
    pub fn may_meet<S: Simd>(&self, way: &Way<S>, after: F32x8<S>, before: F32x8<S>) -> Mask8<S> {
        let (enter, exit) = self.clip(way);
        enter.max(after).le(exit.min(before))
    }

    /// Whether points lie inside.
    #[inline(always)]
    pub fn holds<S: Simd>(&self, points: Vec3x8<S>) -> Mask8<S> {
        let (min, max) = (Vec3x8::splat(self.min), Vec3x8::splat(self.max));
        points.x.ge(min.x)
            & points.x.le(max.x)
            & points.y.ge(min.y)
            & points.y.le(max.y)
            & points.z.ge(min.z)
            & points.z.le(max.z)
    }
}

/// A binary tree of boxes over items.
pub struct Hierarchy {
    boxes: Vec<Branch>,
}

/// Its first half follows at once, the second one is at `second`; where that is 0, it is a leaf with one item.
struct Branch {
    aabb: Aabb,
    second: u32,
    item: u32,
    /// The axis along which the halves follow each other.
    axis: usize,
}

/// Trees are not deeper: beyond half of it they are cut in the middle, and there are not that many items.
const DEPTH: usize = 48;

/// What waits while a tree is walked.
struct Pending {
    stack: [u32; DEPTH],
    count: usize,
}

impl Pending {
    #[inline(always)]
    fn new(is_any: bool) -> Pending {
        Pending { stack: [0; DEPTH], count: usize::from(is_any) }
    }

    #[inline(always)]
    fn push(&mut self, index: u32) {
        if let Some(place) = self.stack.get_mut(self.count) {
            *place = index;
            self.count += 1;
        }
    }

    #[inline(always)]
    fn pop(&mut self) -> Option<u32> {
        self.count = self.count.checked_sub(1)?;
        self.stack.get(self.count).copied()
    }
}

impl Hierarchy {
    /// A tree over items in `bounds`, whose boxes are larger by `margin`.
    pub fn new(bounds: &[Bounds], margin: f64) -> Hierarchy {
        let mut items: Vec<usize> = (0..bounds.len()).collect();
        let mut boxes = Vec::with_capacity(2 * items.len());
        if !items.is_empty() {
            build(bounds, &mut items, margin, 0, &mut boxes);
        }
        Hierarchy { boxes }
    }

    /// Which lines meet the box round all items between `after` and `before`.
    #[inline(always)]
    pub fn may_meet<S: Simd>(
        &self,
        way: &Way<S>,
        after: F32x8<S>,
        before: F32x8<S>,
        lanes: Mask8<S>,
    ) -> Mask8<S> {
        let Some(whole) = self.boxes.first() else {
            return Mask8::no_lanes();
        };
        lanes & whole.aabb.may_meet(way, after, before)
    }

    /// Visits the items whose boxes the lines of `lanes` meet between `after` and `before`, the nearer half
    /// first. `visit` gets an item and the lanes that meet its box, and says what `before` and
    /// `lanes` are from then on.
    #[inline(always)]
    pub fn along<S: Simd>(
        &self,
        way: &Way<S>,
        after: F32x8<S>,
        mut before: F32x8<S>,
        mut lanes: Mask8<S>,
        mut visit: impl FnMut(usize, F32x8<S>, Mask8<S>) -> (F32x8<S>, Mask8<S>),
    ) {
        // All lines share an order, that of one among them.
        let first = 1_u8 << (lanes.bits().trailing_zeros() & 7);
        let mut pending = Pending::new(lanes.any() && !self.boxes.is_empty());
        while let Some(index) = pending.pop() {
            let branch = &self.boxes[index as usize];
            let meets = lanes & branch.aabb.may_meet(way, after, before);
            if !meets.any() {
                continue;
            }
            if branch.second == 0 {
                (before, lanes) = visit(branch.item as usize, before, meets);
                if !lanes.any() {
                    return;
                }
            } else if way.falls[branch.axis] & first != 0 {
                pending.push(index + 1);
                pending.push(branch.second);
            } else {
                pending.push(branch.second);
                pending.push(index + 1);
            }
        }
    }

    /// Visits the items whose boxes hold `points` of `lanes`, always in one order. `visit` gets an item and
    /// the lanes that are in its box, and says where the points are, and in which lanes, from then on.
    #[inline(always)]
    pub fn around<S: Simd>(
        &self,
        mut points: Vec3x8<S>,
        mut lanes: Mask8<S>,
        mut visit: impl FnMut(usize, Mask8<S>) -> (Vec3x8<S>, Mask8<S>),
    ) {
        let mut pending = Pending::new(lanes.any() && !self.boxes.is_empty());
        while let Some(index) = pending.pop() {
            let branch = &self.boxes[index as usize];
            let within = lanes & branch.aabb.holds(points);
            if !within.any() {
                continue;
            }
            if branch.second == 0 {
                (points, lanes) = visit(branch.item as usize, within);
                if !lanes.any() {
                    return;
                }
            } else {
                pending.push(branch.second);
                pending.push(index + 1);
            }
        }
    }
}

fn build(
    bounds: &[Bounds],
    items: &mut [usize],
    margin: f64,
    depth: usize,
    boxes: &mut Vec<Branch>,
) {
    let whole = whole(bounds, items);
    let index = boxes.len();
    let aabb = Aabb::new(&whole, margin);
    boxes.push(Branch { aabb, second: 0, item: items[0] as u32, axis: 0 });
    if items.len() == 1 {
        return;
    }
    let (axis, cut) = best_cut(bounds, items, depth);
    sort(bounds, items, axis);
    let (first, second) = items.split_at_mut(cut);
    build(bounds, first, margin, depth + 1, boxes);
    boxes[index].second = boxes.len() as u32;
    boxes[index].axis = axis;
    build(bounds, second, margin, depth + 1, boxes);
}

/// The axis and the number of items in the first half for which the halves' surfaces, each times its
/// number of items, are least.
fn best_cut(bounds: &[Bounds], items: &mut [usize], depth: usize) -> (usize, usize) {
    let mut best = (f64::INFINITY, 0, items.len() / 2);
    if depth >= DEPTH / 2 {
        return (best.1, best.2);
    }
    for axis in 0..3 {
        sort(bounds, items, axis);
        let first = surfaces(bounds, items.iter());
        let second = surfaces(bounds, items.iter().rev());
        for cut in 1..items.len() {
            let rest = items.len() - cut;
            let cost = first[cut - 1] * cut as f64 + second[rest - 1] * rest as f64;
            if cost < best.0 {
                best = (cost, axis, cut);
            }
        }
    }
    (best.1, best.2)
}

fn sort(bounds: &[Bounds], items: &mut [usize], axis: usize) {
    let middle = |item: usize| bounds[item].min[axis] + bounds[item].max[axis];
    items.sort_by(|a, b| middle(*a).total_cmp(&middle(*b)).then(a.cmp(b)));
}

fn whole(bounds: &[Bounds], items: &[usize]) -> Bounds {
    items.iter().fold(Bounds::EMPTY, |whole, item| whole.union(bounds[*item]))
}

/// The surfaces of the boxes round the first item, the first two, and so on.
fn surfaces<'a>(bounds: &[Bounds], items: impl Iterator<Item = &'a usize>) -> Vec<f64> {
    let grows = |whole: &mut Bounds, item: &usize| {
        *whole = whole.union(bounds[*item]);
        Some(surface(whole))
    };
    items.scan(Bounds::EMPTY, grows).collect()
}

fn surface(bounds: &Bounds) -> f64 {
    let DVec3 { x, y, z } = (bounds.max - bounds.min).max(DVec3::ZERO);
    x * y + y * z + z * x
}
