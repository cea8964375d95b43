//! The light that falls on surfaces, from softboxes and from the sky.

use super::directions::scattered;
use super::{
    Draw, FAR_GROUND, FREE_SKY, Flight, HIDES, Meet, SHADOWS_FROM, Studio, THROWN, purpose,
};
use crate::lanes::{F32x8, Mask8, Simd, Vec3x8};
use crate::packet::Rays;
use crate::packet::boxes::Aabb;
use crate::tracer::lights::LightBox;
use crate::tracer::outlook::{self, BOXES, SKY};
use crate::tracer::world::Candidates;

/// Ways to points of a softbox.
struct WayTo<S: Simd> {
    rays: Rays<S>,
    distance: F32x8<S>,
    /// Those that leave their surfaces, and the cosine there; 0 elsewhere.
    lit: Mask8<S>,
    cosine: F32x8<S>,
}

impl Studio<'_> {
    /// The light that falls on surfaces, as seen on white.
    #[inline(never)]
    pub(super) fn gathered<S: Simd>(
        &self,
        flight: &Flight<S>,
        meet: &Meet<S>,
        draw: &mut Draw<S>,
    ) -> Vec3x8<S> {
        S::run(
            #[inline(always)]
            || {
                let is_first = flight.depth == 0;
                let shaded = flight.lanes & flight.weight.ge(F32x8::splat(SHADOWS_FROM as f32));
                let no_lanes = Mask8::no_lanes();
                let pooled = if is_first { draw.outlooks.pooled[BOXES] } else { no_lanes };
                let [mut came, mut open, mut others] = [Vec3x8::zero(); 3];
                // Softboxes that have no bit are asked by all.
                let has_bits = self.lights.boxes.len() <= outlook::MIRROR as usize;
                let asked = if has_bits { shaded.but(pooled) } else { shaded };
                let places = Aabb::of_points(meet.leaving, asked);
                for (number, light) in self.lights.boxes.iter().enumerate() {
                    let is_noted = is_first && number < outlook::MIRROR as usize;
                    let number = number as u32;
                    let prospect = light.prospect(meet.leaving, meet.normal, meet.outward);
                    let lit = flight.lanes & prospect.may_light;
                    if !lit.any() {
                        continue;
                    }
                    let [mut asking, mut dark] = [shaded, no_lanes];
                    if is_noted {
                        let [free, hidden] = draw.outlooks.known(number);
                        (asking, dark) = (shaded.but(free | hidden | pooled), hidden);
                    }
                    let mut cosine = lit.keep(prospect.mean);
                    let mut lost = F32x8::splat(0.0);
                    let mut between = None;
                    if (lit & asking).any() {
                        let found = self.world.between::<S>(&places, &light.aabb);
                        let is_open = self.world.is_open(meet.leaving, &light.corners, &found);
                        let open = lit & asking & prospect.is_whole & is_open;
                        draw.counts.shadow += u64::from(open.bits().count_ones());
                        if is_noted {
                            draw.outlooks.found(number, open, no_lanes);
                        }
                        asking = asking.but(open);
                        between = Some(found);
                    }
                    let sampled = lit & (asking | !prospect.is_whole);
                    if sampled.any() {
                        let to = Flight { lanes: sampled, ..*flight };
                        let way = self.way_to(light, number, &to, meet, draw);
                        cosine = sampled.but(prospect.is_whole).select(way.cosine, cosine);
                        asking = asking & way.lit;
                        if let (true, Some(between)) = (asking.any(), &between) {
                            let through =
                                self.comes_through(&way, number, asking, between, is_noted, draw);
                            // Of a softbox that is seen whole, the sample says no more than how much is lost.
                            lost = asking.keep(way.cosine * (F32x8::splat(1.0) - through));
                        }
                    }
                    let color = Vec3x8::splat(light.color);
                    let there = color * dark.select(F32x8::splat(0.0), cosine - lost);
                    if is_noted {
                        came += there;
                        open += color * cosine;
                    } else {
                        others += there;
                    }
                }
                if is_first {
                    came = Vec3x8::select(pooled, Vec3x8::zero(), came);
                    draw.outlooks.gathered(BOXES, flight.lanes, came, open);
                }
                came + others + self.daylight(flight, meet, draw)
            },
        )
    }

    /// Ways to points of a softbox by number.
    #[inline(always)]
    fn way_to<S: Simd>(
        &self,
        light: &LightBox,
        number: u32,
        flight: &Flight<S>,
        meet: &Meet<S>,
        draw: &Draw<S>,
    ) -> WayTo<S> {
        let from = flight.depth * purpose::STEP;
        let pair = draw.numbers.pair(from + purpose::SOFTBOX + number);
        let towards = light.points(pair) - meet.leaving;
        let distance = towards.length();
        let direction = towards * distance.recip();
        let (zero, cosine) = (F32x8::splat(0.0), meet.normal.dot(direction));
        let lit = flight.lanes & cosine.gt(zero) & meet.outward.dot(direction).gt(zero);
        let rays = Rays { origin: meet.leaving, direction };
        WayTo { rays, distance, cosine: lit.keep(cosine), lit }
    }

    /// How much of a softbox's light comes to those who are `asking`, which later samples may be told.
    #[inline(always)]
    fn comes_through<S: Simd>(
        &self,
        way: &WayTo<S>,
        number: u32,
        asking: Mask8<S>,
        between: &Candidates,
        is_noted: bool,
        draw: &mut Draw<S>,
    ) -> F32x8<S> {
        draw.counts.shadow += u64::from(asking.bits().count_ones());
        let (rays, distance) = (&way.rays, way.distance);
        let through = self.world.transmission(rays, distance, asking, between, &mut draw.ties);
        if is_noted {
            let is_free = asking & through.gt(F32x8::splat(0.0));
            let is_hidden = asking & through.lt(F32x8::splat(1.0));
            draw.outlooks.found(number, is_free, is_hidden);
        }
        through
    }

    /// What comes from the sky, and from other surfaces that hide it.
    #[inline(always)]
    fn daylight<S: Simd>(
        &self,
        flight: &Flight<S>,
        meet: &Meet<S>,
        draw: &mut Draw<S>,
    ) -> Vec3x8<S> {
        let (brightness, share) = self.lights.daylight(meet.normal);
        if flight.depth > 0 {
            return brightness * (share * F32x8::splat(FREE_SKY as f32));
        }
        let one = F32x8::splat(1.0);
        let bounce = F32x8::splat(self.lights.bounce);
        let ground = Vec3x8::grey(F32x8::splat(FAR_GROUND as f32) * bounce);
        let thrown = Vec3x8::grey(F32x8::splat(THROWN as f32) * bounce);
        let open = brightness * share + ground * (one - share) + thrown;
        let asking = flight.lanes.but(draw.outlooks.pooled[SKY]);
        let mut sky = Vec3x8::zero();
        if asking.any() {
            sky = self.asked_sky(&Flight { lanes: asking, ..*flight }, meet, brightness, draw);
        }
        draw.outlooks.gathered(SKY, flight.lanes, sky, open);
        sky
    }

    /// What comes from the sky, and from other surfaces that hide it, by one ray each.
    #[inline(always)]
    fn asked_sky<S: Simd>(
        &self,
        flight: &Flight<S>,
        meet: &Meet<S>,
        brightness: Vec3x8<S>,
        draw: &mut Draw<S>,
    ) -> Vec3x8<S> {
        let zero = F32x8::splat(0.0);
        let direction = scattered(meet.normal, draw.numbers.pair(purpose::SKY));
        let asking = flight.lanes & direction.dot(meet.outward).gt(zero);
        if !asking.any() {
            return Vec3x8::zero();
        }
        draw.counts.shadow += u64::from(asking.bits().count_ones());
        let way = Rays { origin: meet.leaving, direction };
        let found = self.world.nearest(&way, F32x8::splat(HIDES as f32), asking, &mut draw.ties);
        let hidden = asking & found.lanes();
        let bounce = F32x8::splat(self.lights.bounce);
        let ground = Vec3x8::grey(F32x8::splat(FAR_GROUND as f32) * bounce);
        let mut sum = Vec3x8::select(direction.y.gt(zero), brightness, ground);
        if hidden.any() {
            let materials = &self.world.materials;
            let material = self.world.material(&way, &found, hidden);
            let mut thrown = materials.mean(material) * bounce;
            if self.world.is_transparent() {
                let clear = materials.transparency(material);
                thrown = Vec3x8::select(clear.gt(zero), brightness * clear, thrown);
            }
            sum = Vec3x8::select(hidden, thrown, sum);
        }
        Vec3x8::select(asking, sum, Vec3x8::zero())
    }
}
