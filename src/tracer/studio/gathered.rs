//! The light that falls on surfaces, from softboxes and from the sky.

use super::directions::scattered;
use super::{Draw, FAR_GROUND, FREE_SKY, Flight, HIDES, Meet, SHADOWS_FROM, Studio, purpose};
use crate::lanes::{F32x8, Simd, Vec3x8};
use crate::packet::Rays;
use crate::tracer::outlook;

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
                let zero = F32x8::splat(0.0);
                let from = flight.depth * purpose::STEP;
                let shaded = flight.lanes & flight.weight.ge(F32x8::splat(SHADOWS_FROM as f32));
                let mut sum = Vec3x8::zero();
                for (number, light) in self.lights.boxes.iter().enumerate() {
                    let pair = draw.numbers.pair(from + purpose::SOFTBOX + number as u32);
                    let towards = light.points(pair) - meet.leaving;
                    let distance = towards.length();
                    let towards = towards * distance.recip();
                    let cosine = meet.normal.dot(towards);
                    let lit = flight.lanes & cosine.gt(zero) & meet.outward.dot(towards).gt(zero);
                    if !lit.any() {
                        continue;
                    }
                    let mut share = lit.keep(cosine);
                    let mut asking = lit & shaded;
                    let is_noted = flight.depth == 0 && number < outlook::MIRROR as usize;
                    if is_noted {
                        let [free, hidden] = draw.outlooks.known(number as u32);
                        asking = asking.but(free | hidden);
                        share = hidden.select(F32x8::splat(0.0), share);
                    }
                    if asking.any() {
                        draw.counts.shadow += u64::from(asking.bits().count_ones());
                        let way = Rays { origin: meet.leaving, direction: towards };
                        let open = self.world.transmission(&way, distance, asking, &mut draw.ties);
                        share = asking.select(share * open, share);
                        if is_noted {
                            let (is_free, is_hidden) = (open.gt(zero), open.lt(F32x8::splat(1.0)));
                            draw.outlooks.found(
                                number as u32,
                                asking & is_free,
                                asking & is_hidden,
                            );
                        }
                    }
                    sum += Vec3x8::splat(light.color) * share;
                }
                sum + self.daylight(flight, meet, draw)
            },
        )
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
        let open = brightness * share + ground * (one - share);
        let asking = flight.lanes.but(draw.outlooks.knows_sky);
        let mut sky = Vec3x8::zero();
        if asking.any() {
            sky = self.asked_sky(&Flight { lanes: asking, ..*flight }, meet, brightness, draw);
        }
        let outlooks = &mut draw.outlooks;
        outlooks.sky = Vec3x8::select(flight.lanes, sky, outlooks.sky);
        outlooks.open_sky = Vec3x8::select(flight.lanes, open, outlooks.open_sky);
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
