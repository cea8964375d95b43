//! Bodies of revolution, as [`geometry::Lathe`]: the same formulas, so that f32 is enough.
//!
//! A ray's origin is first moved to where it is nearest to the axis within the heights of the body, so that
//! nothing large cancels. There u² has its least value, and only grows from there on.

use super::chain::{Bounds, Cuts, ROUNDING, Slopes, Tree, either, merged, size};
use super::{Crossing, Normals};
use crate::geometry::{self, Segment};
use crate::lanes::{F32x8, LANES, Mask8, Simd, U32x8, Vec3x8};
use crate::packet::Rays;

/// A profile turned about the y axis; its heights are y.
pub struct Lathe {
    rings: Vec<Ring>,
    /// From the lowest end of the profile up, and from the highest one down.
    trees: [Tree<Zone>; 2],
    sides: Vec<Side>,
    slopes: Slopes,
}

/// Heights and squares of distances from the axis.
#[derive(Clone, Copy)]
struct Zone {
    min_v: f32,
    max_v: f32,
    min_u2: f32,
    max_u2: f32,
}

impl Zone {
    fn new(bounds: Bounds) -> Zone {
        let Bounds { min, max } = bounds;
        let inner = min.x.max(0.0);
        Zone {
            min_v: min.y as f32,
            max_v: max.y as f32,
            min_u2: (inner * inner) as f32,
            max_u2: (max.x * max.x) as f32,
        }
    }
}

/// A segment for those who cross it, turned about the axis: `nu·u + nv·v = w`.
struct Ring {
    w: f32,
    nv: f32,
    nu2: f32,
    /// Where it is; rounding has room.
    zone: Zone,
}

impl Ring {
    /// Whether it lies in a level plane, which is crossed once: both roots are the same, but for rounding.
    #[inline(always)]
    fn is_flat(&self) -> bool {
        self.nu2 == 0.0
    }
}

/// A segment for those who ask on which side they are.
struct Side {
    from_u: f32,
    from_v: f32,
    to_v: f32,
    /// Change of u with v.
    slope: f32,
}

/// The least change of height that is told from none, in heights a unit of t.
const LEVEL: f32 = 1e-12;

/// Rays as the axis sees them, from where they are nearest to it within the body's heights.
struct AxisLines<S: Simd> {
    /// Where that is, as a distance of the ray. Other distances start from here.
    start: F32x8<S>,
    /// Height, its change with t, and that one's reciprocal.
    oy: F32x8<S>,
    dy: F32x8<S>,
    per_dy: F32x8<S>,
    /// |p|², p·q, 2 p·q, |q|² and (p × q)² of horizontal origin and direction.
    pp: F32x8<S>,
    pq: F32x8<S>,
    twice_pq: F32x8<S>,
    qq: F32x8<S>,
    cross2: F32x8<S>,
    /// Between what distances something may be met.
    from: F32x8<S>,
    to: F32x8<S>,
}

impl<S: Simd> AxisLines<S> {
    #[inline(always)]
    fn new(rays: &Rays<S>, whole: &Zone, after: F32x8<S>, before: F32x8<S>) -> AxisLines<S> {
        let Vec3x8 { x: qx, y: dy, z: qz } = rays.direction;
        let Vec3x8 { x: px, y: oy, z: pz } = rays.origin;
        let qq = qx * qx + qz * qz;
        let per_dy = dy.abs().max(F32x8::splat(LEVEL)).with_sign_of(dy).recip();
        let low = (F32x8::splat(whole.min_v) - oy) * per_dy;
        let high = (F32x8::splat(whole.max_v) - oy) * per_dy;
        let closest = -(px * qx + pz * qz) / qq.max(F32x8::splat(f32::MIN_POSITIVE));
        let start = closest.max(low.min(high)).min(low.max(high));
        let (px, pz) = (px + qx * start, pz + qz * start);
        let pq = px * qx + pz * qz;
        let cross = px * qz - pz * qx;
        // Differences are rounded, which may lose nothing.
        let (from, to) = (after - start, before - start);
        let room = F32x8::splat(3e-7);
        AxisLines {
            start,
            oy: oy + dy * start,
            dy,
            per_dy,
            pp: px * px + pz * pz,
            pq,
            twice_pq: pq + pq,
            qq,
            cross2: cross * cross,
            from: from - from.abs() * room,
            to: to + to.abs() * room,
        }
    }

    /// u² at distance `t`.
    #[inline(always)]
    fn u2(&self, t: F32x8<S>) -> F32x8<S> {
        (self.qq * t + self.twice_pq) * t + self.pp
    }

    /// Which lanes may meet something in `zone` between `self.from` and `to`.
    #[inline(always)]
    fn may_meet(&self, zone: &Zone, to: F32x8<S>) -> Mask8<S> {
        let low = (F32x8::splat(zone.min_v) - self.oy) * self.per_dy;
        let high = (F32x8::splat(zone.max_v) - self.oy) * self.per_dy;
        let start = low.min(high).max(self.from);
        let end = low.max(high).min(to);
        // The least u² is where t is 0. Whether all of the way lies within a hole is not asked: where that is so,
        // something nearer has mostly been met.
        let nearest = self.u2(F32x8::splat(0.0).max(start).min(end));
        start.le(end) & nearest.le(F32x8::splat(zone.max_u2))
    }

    /// Whether most lanes lead down.
    #[inline(always)]
    fn go_down(&self) -> bool {
        self.dy.lt(F32x8::splat(0.0)).bits().count_ones() > LANES as u32 / 2
    }

    /// The two distances at which a ring's cone is crossed; no number where it is not.
    #[inline(always)]
    fn meet(&self, ring: &Ring) -> [F32x8<S>; 2] {
        let nu2 = F32x8::splat(ring.nu2);
        let nv = F32x8::splat(ring.nv);
        let h = F32x8::splat(ring.w) - nv * self.oy;
        let g = -nv * self.dy;
        let (hh, gg, hg) = (h * h, g * g, h * g);
        let a = nu2 * self.qq - gg;
        let b = nu2 * self.pq - hg;
        let c = nu2 * self.pp - hh;
        // b² − a·c, written so that nothing large cancels. The root of what is negative is no number.
        let discriminant =
            nu2 * (hh * self.qq + gg * self.pp - hg * self.twice_pq - nu2 * self.cross2);
        let stable = -(b + discriminant.sqrt().with_sign_of(b));
        [stable / a, c / stable]
    }

    /// Whether the points at distances `t` lie in `zone`.
    #[inline(always)]
    fn is_in(&self, t: F32x8<S>, zone: &Zone) -> Mask8<S> {
        let (v, u2) = (self.oy + self.dy * t, self.u2(t));
        v.ge(F32x8::splat(zone.min_v))
            & v.le(F32x8::splat(zone.max_v))
            & u2.ge(F32x8::splat(zone.min_u2))
            & u2.le(F32x8::splat(zone.max_u2))
    }
}

/// The nearest crossing so far.
struct Best<S: Simd> {
    /// From [`AxisLines::start`].
    t: F32x8<S>,
    part: U32x8<S>,
}

impl Lathe {
    pub fn new(solid: &geometry::Lathe) -> Lathe {
        let segments = merged(solid.segments());
        let rounding = ROUNDING * size(&segments);
        let ring = |segment: &Segment| Ring {
            w: segment.normal.dot(segment.from) as f32,
            nv: segment.normal.y as f32,
            nu2: (segment.normal.x * segment.normal.x) as f32,
            zone: Zone::new(Bounds::of(std::slice::from_ref(segment)).grown(rounding)),
        };
        let side = |segment: &Segment| {
            let along = segment.to - segment.from;
            Side {
                from_u: segment.from.x as f32,
                from_v: segment.from.y as f32,
                to_v: segment.to.y as f32,
                slope: (along.x / along.y) as f32,
            }
        };
        let cuts = Cuts::new(&segments);
        Lathe {
            rings: segments.iter().map(ring).collect(),
            trees: [false, true].map(|is_down| Tree::new(cuts.as_ref(), is_down, Zone::new)),
            sides: segments.iter().map(side).collect(),
            slopes: Slopes::new(&segments),
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
        let Some(whole) = self.trees[0].root() else {
            return nothing;
        };
        let lines = AxisLines::new(rays, whole, after, before);
        let lanes = lanes & lines.may_meet(whole, lines.to);
        if !lanes.any() {
            return nothing;
        }
        // What is not asked ends before it begins.
        let to = lanes.select(lines.to, F32x8::splat(f32::NEG_INFINITY));
        let mut best = Best { t: to, part: U32x8::splat(u32::MAX) };
        // What comes first is asked first.
        if lines.go_down() {
            self.find::<S, true>(&lines, after, &mut best);
        } else {
            self.find::<S, false>(&lines, after, &mut best);
        }
        let t = lines.start + best.t;
        let is_met = t.lt(before) & !best.part.eq(U32x8::splat(u32::MAX));
        Crossing { t: is_met.select(t, none), part: best.part }
    }

    /// Of crossings in one place the lower one's ring counts, whichever way the tree is walked.
    #[inline(never)]
    fn find<S: Simd, const DOWN: bool>(
        &self,
        lines: &AxisLines<S>,
        after: F32x8<S>,
        best: &mut Best<S>,
    ) {
        S::run(
            #[inline(always)]
            || {
                self.trees[usize::from(DOWN)].walk(
                    best,
                    #[inline(always)]
                    |best, zone| lines.may_meet(zone, best.t).any(),
                    #[inline(always)]
                    |best, index| {
                        let Some(ring) = self.rings.get(index) else { return false };
                        for t in lines.meet(ring) {
                            let is_nearer = if DOWN { t.le(best.t) } else { t.lt(best.t) };
                            let is_nearer = is_nearer
                                & lines.is_in(t, &ring.zone)
                                & (lines.start + t).gt(after);
                            best.t = is_nearer.select(t, best.t);
                            let part = U32x8::splat(index as u32);
                            best.part = is_nearer.select_words(part, best.part);
                            if ring.is_flat() {
                                break;
                            }
                        }
                        false
                    },
                );
            },
        );
    }

    #[inline(always)]
    pub fn blocks<S: Simd>(
        &self,
        rays: &Rays<S>,
        after: F32x8<S>,
        before: F32x8<S>,
        lanes: Mask8<S>,
    ) -> Mask8<S> {
        let Some(whole) = self.trees[0].root() else {
            return Mask8::no_lanes();
        };
        let lines = AxisLines::new(rays, whole, after, before);
        let lanes = lanes & lines.may_meet(whole, lines.to);
        if !lanes.any() {
            return Mask8::no_lanes();
        }
        let to = lanes.select(lines.to, F32x8::splat(f32::NEG_INFINITY));
        self.any(&lines, [after, before], to)
    }

    #[inline(never)]
    fn any<S: Simd>(
        &self,
        lines: &AxisLines<S>,
        [after, before]: [F32x8<S>; 2],
        to: F32x8<S>,
    ) -> Mask8<S> {
        S::run(
            #[inline(always)]
            || {
                let nowhere = F32x8::splat(f32::NEG_INFINITY);
                // How far lanes still want to know.
                let mut open = to;
                self.trees[usize::from(lines.go_down())].walk(
                    &mut open,
                    #[inline(always)]
                    |open, zone| lines.may_meet(zone, *open).any(),
                    #[inline(always)]
                    |open, index| {
                        let Some(ring) = self.rings.get(index) else { return false };
                        for t in lines.meet(ring) {
                            let distance = lines.start + t;
                            let is_met = lines.is_in(t, &ring.zone)
                                & distance.gt(after)
                                & distance.lt(before);
                            *open = is_met.select(nowhere, *open);
                            if ring.is_flat() {
                                break;
                            }
                        }
                        !open.gt(nowhere).any()
                    },
                );
                to.gt(nowhere) & open.eq(nowhere)
            },
        )
    }

    #[inline(always)]
    pub fn contains<S: Simd>(&self, points: Vec3x8<S>, lanes: Mask8<S>) -> Mask8<S> {
        let (u2, v) = (points.x * points.x + points.z * points.z, points.y);
        let u = u2.sqrt();
        // An odd number of segments lies farther out when inside; runs without any are left out.
        let mut inside = Mask8::no_lanes();
        self.trees[0].walk(
            &mut inside,
            #[inline(always)]
            |_, zone| {
                let is_near = v.ge(F32x8::splat(zone.min_v))
                    & v.le(F32x8::splat(zone.max_v))
                    & u2.le(F32x8::splat(zone.max_u2));
                (is_near & lanes).any()
            },
            #[inline(always)]
            |inside, index| {
                let Some(side) = self.sides.get(index) else { return false };
                let starts = F32x8::splat(side.from_v).le(v);
                let ends = F32x8::splat(side.to_v).le(v);
                let at = F32x8::splat(side.from_u)
                    + (v - F32x8::splat(side.from_v)) * F32x8::splat(side.slope);
                *inside = either(*inside, either(starts, ends) & at.gt(u));
                false
            },
        );
        inside
    }

    #[inline(always)]
    pub fn normals<S: Simd>(
        &self,
        points: Vec3x8<S>,
        parts: U32x8<S>,
        _lanes: Mask8<S>,
    ) -> Normals<S> {
        let u = (points.x * points.x + points.z * points.z).sqrt();
        let slope = self.slopes.at(u, points.y, parts);
        let per_u = u.gt(F32x8::splat(0.0)).keep(u.recip());
        Normals {
            flat: turned(slope.flat, points, per_u),
            smooth: turned(slope.smooth, points, per_u),
        }
    }
}

/// A normal of the profile at `points`, whose distances from the axis have the reciprocals `per_u`, none 0.
#[inline(always)]
fn turned<S: Simd>([nu, nv]: [F32x8<S>; 2], points: Vec3x8<S>, per_u: F32x8<S>) -> Vec3x8<S> {
    let radial = nu * per_u;
    // On the axis the normals from all round it have it as their middle.
    let is_off = per_u.gt(F32x8::splat(0.0));
    let y = is_off.select(nv, F32x8::splat(1.0).with_sign_of(nv));
    Vec3x8::new(radial * points.x, y, radial * points.z)
}

#[cfg(test)]
mod tests;
