//! Prisms, as [`geometry::Prism`]: the same decisions by the sides on which vertices lie.
//!
//! The outline is moved to the origin, and a ray's origin to where it is nearest to that within the prism's heights,
//! so that little is lost to rounding.

use glam::DVec2;

use super::chain::{Bounds, Cuts, Slopes, Tree, either, merged};
use super::{Crossing, Normals};
use crate::geometry::{self, Segment, Solid};
use crate::lanes::{F32x8, Mask8, Simd, U32x8, Vec3x8};
use crate::packet::Rays;

/// What lies within an outline from one height along z to another.
pub struct Prism {
    walls: Vec<Wall>,
    tree: Tree<Area>,
    /// In the outline's own place.
    slopes: Slopes,
    /// The middle of the outline, where the walls have their origin.
    middle: [f32; 2],
    /// The heights of the lids. Their parts are the two numbers behind the walls'.
    back: f32,
    front: f32,
}

/// A box in the plane of the outline.
struct Area {
    min: [f32; 2],
    max: [f32; 2],
}

impl Area {
    fn new(Bounds { min, max }: Bounds) -> Area {
        Area { min: min.as_vec2().to_array(), max: max.as_vec2().to_array() }
    }
}

/// A segment of the outline, pushed along z.
struct Wall {
    from: [f32; 2],
    to: [f32; 2],
    /// Change of x with y.
    slope: f32,
}

/// The least part of a direction that is told from none, by a unit of t.
const LEVEL: f32 = 1e-12;

/// Rays as the outline sees them, from where they are nearest to its middle within the prism's heights.
struct FlatLines<S: Simd> {
    /// Where that is, as a distance of the ray. Other distances start from here.
    start: F32x8<S>,
    p: [F32x8<S>; 2],
    q: [F32x8<S>; 2],
    per_q: [F32x8<S>; 2],
    /// q × p, q · p and the reciprocal of |q|².
    cross: F32x8<S>,
    dot: F32x8<S>,
    per_qq: F32x8<S>,
    /// Distances at which the lids' planes are crossed, the nearer one first.
    lids: [F32x8<S>; 2],
    /// Between what distances walls matter.
    from: F32x8<S>,
    to: F32x8<S>,
}

/// The same by the side of a direction that itself may be no more than [`LEVEL`].
const STRAIGHT: f32 = 1e-30;

/// The reciprocal of a number that is taken to be at least as large as `least`.
#[inline(always)]
fn recip_of<S: Simd>(x: F32x8<S>, least: f32) -> F32x8<S> {
    x.abs().max(F32x8::splat(least)).with_sign_of(x).recip()
}

impl<S: Simd> FlatLines<S> {
    /// Which lanes may meet walls within `area` between `self.from` and `to`.
    #[inline(always)]
    fn may_meet(&self, area: &Area, to: F32x8<S>) -> Mask8<S> {
        let (mut start, mut end) = (self.from, to);
        for axis in 0..2 {
            let low = (F32x8::splat(area.min[axis]) - self.p[axis]) * self.per_q[axis];
            let high = (F32x8::splat(area.max[axis]) - self.p[axis]) * self.per_q[axis];
            start = start.max(low.min(high));
            end = end.min(low.max(high));
        }
        start.le(end)
    }

    /// Which lanes cross `wall`, and where.
    #[inline(always)]
    fn meet(&self, wall: &Wall) -> (Mask8<S>, F32x8<S>) {
        let ((from_off, from_along), (to_off, to_along)) = (self.see(wall.from), self.see(wall.to));
        let zero = F32x8::splat(0.0);
        let share = from_off / (from_off - to_off);
        let t = from_along.lerp(to_along, share) * self.per_qq;
        (either(from_off.gt(zero), to_off.gt(zero)), t)
    }

    /// How far a vertex lies off the line, and how far along it, times |q|.
    #[inline(always)]
    fn see(&self, [x, y]: [f32; 2]) -> (F32x8<S>, F32x8<S>) {
        let (x, y) = (F32x8::splat(x), F32x8::splat(y));
        let off = self.q[0] * y - self.q[1] * x - self.cross;
        (off, self.q[0] * x + self.q[1] * y - self.dot)
    }
}

/// What is known of the walls so far.
struct Found<S: Simd> {
    /// The nearest wall; distances from [`FlatLines::start`].
    t: F32x8<S>,
    part: U32x8<S>,
    /// Whether an odd number of walls lies before each lid.
    odd: [Mask8<S>; 2],
}

impl Prism {
    pub fn new(solid: &geometry::Prism) -> Prism {
        let bounds = solid.bounds();
        let middle = ((bounds.min + bounds.max) / 2.0).truncate();
        let segments = merged(solid.segments());
        let moved = |segment: &Segment| Segment {
            from: segment.from - middle,
            to: segment.to - middle,
            ..*segment
        };
        let segments: Vec<Segment> = segments.iter().map(moved).collect();
        let array = |point: DVec2| point.as_vec2().to_array();
        let wall = |segment: &Segment| {
            let along = segment.to - segment.from;
            Wall {
                from: array(segment.from),
                to: array(segment.to),
                slope: (along.x / along.y) as f32,
            }
        };
        Prism {
            walls: segments.iter().map(wall).collect(),
            tree: Tree::new(Cuts::new(&segments).as_ref(), false, Area::new),
            slopes: Slopes::new(&segments),
            middle: array(middle),
            back: bounds.min.z as f32,
            front: bounds.max.z as f32,
        }
    }

    /// Places in the outline's plane, from its middle.
    #[inline(always)]
    fn off_middle<S: Simd>(&self, points: &Vec3x8<S>) -> [F32x8<S>; 2] {
        let [x, y] = self.middle;
        [points.x - F32x8::splat(x), points.y - F32x8::splat(y)]
    }

    /// Which heights lie between the lids.
    #[inline(always)]
    fn is_between<S: Simd>(&self, z: F32x8<S>) -> Mask8<S> {
        z.gt(F32x8::splat(self.back)) & z.lt(F32x8::splat(self.front))
    }

    /// Distances of the lids from a height, the nearer one first.
    #[inline(always)]
    fn lids<S: Simd>(&self, z: F32x8<S>, per_dz: F32x8<S>) -> [F32x8<S>; 2] {
        let back = (F32x8::splat(self.back) - z) * per_dz;
        let front = (F32x8::splat(self.front) - z) * per_dz;
        [back.min(front), back.max(front)]
    }

    #[inline(always)]
    fn lines<S: Simd>(
        &self,
        rays: &Rays<S>,
        after: F32x8<S>,
        before: F32x8<S>,
        lanes: Mask8<S>,
    ) -> FlatLines<S> {
        let Rays { origin, direction } = rays;
        let per_dz = recip_of(direction.z, LEVEL);
        // Seen along z, a ray may as well go the least bit to the side.
        let is_along = (direction.x.abs() + direction.y.abs()).lt(F32x8::splat(2.0 * LEVEL));
        let q = [
            is_along.select(F32x8::splat(LEVEL), direction.x),
            is_along.select(F32x8::splat(0.0), direction.y),
        ];
        let per_qq = (q[0] * q[0] + q[1] * q[1]).recip();
        let p = self.off_middle(origin);
        let closest = -(p[0] * q[0] + p[1] * q[1]) * per_qq;
        let within = self.lids(origin.z, per_dz);
        let start = closest.max(within[0]).min(within[1]);
        let p = [p[0] + q[0] * start, p[1] + q[1] * start];
        let oz = origin.z + direction.z * start;
        let lids = self.lids(oz, per_dz);
        // A ray within the plane of a lid is outside.
        let is_level = direction.z.abs().lt(F32x8::splat(LEVEL));
        let lanes = lanes.but(is_level.but(self.is_between(oz)));
        // Differences are rounded, which may lose nothing.
        let room = F32x8::splat(3e-7);
        let (from, to) = (after - start, before - start);
        let from = from - from.abs() * room;
        let to = (to + to.abs() * room).min(lids[1]);
        FlatLines {
            start,
            p,
            q,
            per_q: [recip_of(q[0], STRAIGHT), recip_of(q[1], STRAIGHT)],
            cross: q[0] * p[1] - q[1] * p[0],
            dot: q[0] * p[0] + q[1] * p[1],
            per_qq,
            lids,
            from,
            to: lanes.select(to, F32x8::splat(f32::NEG_INFINITY)),
        }
    }

    #[inline(always)]
    pub fn nearest<S: Simd>(
        &self,
        rays: &Rays<S>,
        after: F32x8<S>,
        before: F32x8<S>,
        lanes: Mask8<S>,
    ) -> Crossing<S> {
        let none = F32x8::splat(f32::INFINITY);
        let nothing = Crossing { t: none, part: U32x8::splat(0) };
        let Some(whole) = self.tree.root() else {
            return nothing;
        };
        let mut lines = self.lines(rays, after, before, lanes);
        let lanes = lines.may_meet(whole, lines.to);
        if !lanes.any() {
            return nothing;
        }
        lines.to = lanes.select(lines.to, F32x8::splat(f32::NEG_INFINITY));
        // A lid counts where the ray is inside, which all walls before it tell.
        let (at_entry, at_exit) = (lines.start + lines.lids[0], lines.start + lines.lids[1]);
        let entry_counts = lanes & at_entry.gt(after) & at_entry.lt(before);
        let exit_counts = lanes & at_exit.gt(after) & at_exit.lt(before);
        lines.from = (entry_counts | exit_counts)
            .select(F32x8::splat(f32::NEG_INFINITY), lines.from.max(lines.lids[0]));
        let mut found =
            Found { t: lines.to, part: U32x8::splat(u32::MAX), odd: [Mask8::no_lanes(); 2] };
        self.find(&lines, [after, before], &mut found);
        let count = self.walls.len() as u32;
        let is_back_first = rays.direction.z.gt(F32x8::splat(0.0));
        let (back, front) = (U32x8::splat(count), U32x8::splat(count + 1));
        let wall = !found.part.eq(U32x8::splat(u32::MAX));
        let exits = (exit_counts & found.odd[1]).but(wall);
        let t = exits.select(at_exit, wall.select(lines.start + found.t, none));
        let part = exits.select_words(is_back_first.select_words(front, back), found.part);
        let enters = entry_counts & found.odd[0];
        let entry = is_back_first.select_words(back, front);
        Crossing { t: enters.select(at_entry, t), part: enters.select_words(entry, part) }
    }

    #[inline(never)]
    fn find<S: Simd>(
        &self,
        lines: &FlatLines<S>,
        [after, before]: [F32x8<S>; 2],
        found: &mut Found<S>,
    ) {
        S::run(
            #[inline(always)]
            || {
                self.tree.walk(
                    found,
                    #[inline(always)]
                    |found, area| lines.may_meet(area, found.t).any(),
                    #[inline(always)]
                    |found, index| {
                        let Some(wall) = self.walls.get(index) else { return false };
                        let (is_crossed, t) = lines.meet(wall);
                        let [entry, exit] = lines.lids;
                        let [before_entry, before_exit] = found.odd;
                        found.odd = [
                            either(before_entry, is_crossed & t.le(entry)),
                            either(before_exit, is_crossed & t.lt(exit)),
                        ];
                        let distance = lines.start + t;
                        let is_nearer = is_crossed
                            & t.gt(entry)
                            & t.lt(exit)
                            & t.lt(found.t)
                            & distance.gt(after)
                            & distance.lt(before);
                        found.t = is_nearer.select(t, found.t);
                        let part = U32x8::splat(index as u32);
                        found.part = is_nearer.select_words(part, found.part);
                        false
                    },
                );
            },
        );
    }

    #[inline(always)]
    pub fn contains<S: Simd>(&self, points: Vec3x8<S>, lanes: Mask8<S>) -> Mask8<S> {
        let [x, y] = self.off_middle(&points);
        let lanes = lanes & self.is_between(points.z);
        // An odd number of walls lies to the right when inside; runs without any are left out.
        let mut inside = Mask8::no_lanes();
        self.tree.walk(
            &mut inside,
            #[inline(always)]
            |_, area| {
                let is_near = y.ge(F32x8::splat(area.min[1]))
                    & y.le(F32x8::splat(area.max[1]))
                    & x.le(F32x8::splat(area.max[0]));
                (is_near & lanes).any()
            },
            #[inline(always)]
            |inside, index| {
                let Some(wall) = self.walls.get(index) else { return false };
                let starts = F32x8::splat(wall.from[1]).le(y);
                let ends = F32x8::splat(wall.to[1]).le(y);
                let at = F32x8::splat(wall.from[0])
                    + (y - F32x8::splat(wall.from[1])) * F32x8::splat(wall.slope);
                *inside = either(*inside, either(starts, ends) & at.gt(x));
                false
            },
        );
        inside & lanes
    }

    #[inline(always)]
    pub fn normals<S: Simd>(
        &self,
        points: Vec3x8<S>,
        parts: U32x8<S>,
        _lanes: Mask8<S>,
    ) -> Normals<S> {
        let count = self.walls.len() as u32;
        let (zero, one) = (F32x8::splat(0.0), F32x8::splat(1.0));
        let [x, y] = self.off_middle(&points);
        let slope = self.slopes.at(x, y, parts);
        let is_back = parts.eq(U32x8::splat(count));
        let is_lid = is_back | parts.eq(U32x8::splat(count + 1));
        let lid = Vec3x8::new(zero, zero, is_back.select(-one, one));
        let ([flat_x, flat_y], [x, y]) = (slope.flat, slope.smooth);
        Normals {
            flat: Vec3x8::select(is_lid, lid, Vec3x8::new(flat_x, flat_y, zero)),
            smooth: Vec3x8::select(is_lid, lid, Vec3x8::new(x, y, zero)),
        }
    }
}

#[cfg(test)]
mod tests;
