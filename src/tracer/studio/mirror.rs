//! What is seen in surfaces: mirror images in what is opaque, and what is in glass and behind it.

use super::directions::ball;
use super::{BRIGHTEST_IN_A_MIRROR, Draw, Flight, MIRRORS_FROM, Meet, Studio, purpose};
use crate::lanes::{F32x8, Mask8, Simd, Vec3x8};
use crate::packet::Rays;
use crate::tracer::optics::{fresnel, mirrored, refracted};
use crate::tracer::outlook;
use crate::tracer::world::OFFSET;

impl Studio<'_> {
    /// The shares of mirror images; nothing elsewhere.
    #[inline(never)]
    pub(super) fn mirror<S: Simd>(
        &self,
        flight: &Flight<S>,
        meet: &Meet<S>,
        share: Vec3x8<S>,
        draw: &mut Draw<S>,
    ) -> Vec3x8<S> {
        S::run(
            #[inline(always)]
            || {
                let lanes = flight.lanes;
                let roughness = self.world.materials.roughness(meet.material);
                let exact = mirrored(flight.rays.direction, meet.normal, meet.outward);
                let weight = flight.weight * share.max_element();
                let mut followed = Mask8::no_lanes();
                let mut seen = Vec3x8::zero();
                if flight.depth < self.world.scene.max_depth {
                    followed = lanes & weight.ge(F32x8::splat(MIRRORS_FROM as f32));
                }
                if flight.depth == 0 {
                    let [free, _] = draw.outlooks.known(outlook::MIRROR);
                    followed = followed.but(free);
                }
                if followed.any() {
                    let from = flight.depth * purpose::STEP;
                    let pair = draw.numbers.pair(from + purpose::MIRROR);
                    let blurred = (exact + ball(pair) * roughness).normalized();
                    let is_above = blurred.dot(meet.outward).gt(F32x8::splat(0.0));
                    let direction = Vec3x8::select(is_above, blurred, exact);
                    let rays = Rays { origin: meet.leaving, direction };
                    draw.counts.reflected += u64::from(followed.bits().count_ones());
                    let farthest = F32x8::splat(self.world.scene.max_distance as f32);
                    let meeting =
                        self.world.nearest_together(&rays, farthest, followed, &mut draw.ties);
                    let met = followed & meeting.lanes();
                    if flight.depth == 0 {
                        draw.outlooks.found(outlook::MIRROR, followed.but(met), met);
                    }
                    followed = met;
                    if followed.any() {
                        let next = Flight {
                            rays,
                            lanes: followed,
                            depth: flight.depth + 1,
                            length: flight.length + meet.distance,
                            weight,
                            index: flight.index,
                            spread: flight.spread + roughness,
                        };
                        seen = self.light(&next, &meeting, draw);
                    }
                }
                let free = lanes.but(followed);
                if free.any() {
                    // Softboxes are blurred as a whole, not by samples; those that are seen at second hand are
                    // found by few, and would leave specks.
                    let mut room = self.lights.radiance(meet.point, exact, roughness, free);
                    if flight.depth > 0 {
                        let most = F32x8::splat(BRIGHTEST_IN_A_MIRROR as f32);
                        room = room.min(Vec3x8::grey(most));
                    }
                    seen = Vec3x8::select(followed, seen, room);
                }
                Vec3x8::select(lanes, share.times(seen), Vec3x8::zero())
            },
        )
    }

    /// What is seen in glass, and through it.
    #[inline(never)]
    pub(super) fn glass<S: Simd>(
        &self,
        flight: &Flight<S>,
        meet: &Meet<S>,
        draw: &mut Draw<S>,
    ) -> Vec3x8<S> {
        S::run(
            #[inline(always)]
            || {
                let (world, lanes) = (&self.world, flight.lanes);
                let (zero, one) = (F32x8::splat(0.0), F32x8::splat(1.0));
                let clearness = world.materials.transparency(meet.material);
                let behind = meet.point - meet.outward * F32x8::splat(OFFSET);
                let index = world.index_at(behind, lanes, &mut draw.ties);
                let ratio = flight.index / index;
                let direction = flight.rays.direction;
                let cosine = -direction.dot(meet.normal);
                let (bent, gets_out) = refracted(direction, meet.normal, ratio);
                // On the way out the angle that counts is the one outside.
                let leaving = fresnel(-bent.dot(meet.normal), ratio);
                let entering = fresnel(cosine, one / ratio);
                let bends = ratio.gt(one).select(leaving, ratio.eq(one).select(zero, entering));
                let mirrored = gets_out.select(bends, one);
                let mut sum = Vec3x8::zero();
                let glossy = lanes & mirrored.gt(zero);
                if glossy.any() {
                    let flight = Flight { lanes: glossy, ..*flight };
                    sum = self.mirror(&flight, meet, Vec3x8::grey(mirrored), draw);
                }
                let through = lanes & gets_out;
                if !through.any() {
                    return sum;
                }
                let share = (one - mirrored) * clearness;
                let weight = flight.weight * share;
                let depth = flight.depth + 1;
                // Each of a body's two surfaces takes half of what its colour takes.
                let tint = meet.color.max(Vec3x8::zero()).roots();
                let least = F32x8::splat(world.scene.min_weight as f32);
                let mut followed = Mask8::no_lanes();
                let mut seen = Vec3x8::zero();
                if depth <= world.scene.max_depth {
                    followed = through & weight.ge(least);
                }
                if followed.any() {
                    draw.counts.refracted += u64::from(followed.bits().count_ones());
                    let rays = Rays { origin: behind, direction: bent };
                    let meeting = self.nearest(&rays, followed, draw);
                    let hit = followed & meeting.lanes();
                    seen = Vec3x8::splat(self.background);
                    if hit.any() {
                        let next = Flight {
                            rays,
                            lanes: hit,
                            depth,
                            length: flight.length + meet.distance,
                            weight,
                            index,
                            spread: flight.spread,
                        };
                        seen = Vec3x8::select(hit, self.light(&next, &meeting, draw), seen);
                    }
                }
                let lost = through.but(followed);
                if lost.any() {
                    let room = self.lights.radiance(meet.point, bent, one, lost);
                    seen = Vec3x8::select(followed, seen, room);
                }
                sum += Vec3x8::select(through, tint.times(seen) * share, Vec3x8::zero());
                let clouded = through & clearness.lt(one);
                if flight.depth == 0 && clouded.any() {
                    let gathered = self.gathered(&Flight { lanes: clouded, ..*flight }, meet, draw);
                    let shown = meet.color * (one - clearness);
                    draw.outlooks.weigh(clouded, shown);
                    sum += Vec3x8::select(clouded, shown.times(gathered), Vec3x8::zero());
                }
                sum
            },
        )
    }
}
