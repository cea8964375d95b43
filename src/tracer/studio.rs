//! Soft light: a coloured ground under a clear coat, in a room with softboxes and a sky.
//!
//! Every sample of a pixel asks each softbox at one point, the sky in one direction, and the mirror in
//! one, but for what is known from others ([`super::outlook`]). What nothing stands in the way of is known
//! without samples, so a plain that sees the whole sky has no noise.

use glam::Vec3;

use super::RayCounts;
use super::exposure::{Glimpse, LENS, PLACE, Sample};
use super::eye::Eye;
use super::lights::Lights;
use super::optics::{facing, fresnel, grazing, mirrored, refracted};
use super::outlook::{self, Known, Outlooks};
use super::pinhole::Pinhole;
use super::sequence::{Sequence, Sequences};
use super::ties::{Ties, Ties8};
use super::world::{Meeting, OFFSET, World};
use crate::lanes::{F32x8, LANES, Mask8, Simd, Task, U32x8, Vec3x8, dispatch, math};
use crate::packet::Rays;
use crate::scene::{MIDDLE, Room, linear_light};

/// How much of its light a ground under a coat throws back, of what its colour says.
pub const GROUND: f64 = 0.9;

/// What is seen at second hand is lit by all softboxes, but asks for shadows only where it counts as
/// much as this in the pixel.
pub const SHADOWS_FROM: f64 = 0.06;

/// Of the sky that a surface seen at second hand faces, so much is taken to be free.
pub const FREE_SKY: f64 = 0.75;

/// Rays in a mirror are followed when they count as much as this; fainter ones see the room.
pub const MIRRORS_FROM: f64 = 0.02;

/// What has no end melts into the background, from the first of these distances from the board to
/// the second.
pub const MELTS: [f64; 2] = [35.0, 190.0];

/// No light is brighter in the mirror image of a mirror.
pub const BRIGHTEST_IN_A_MIRROR: f64 = 1.0;

/// What is farther than this, in world units, hides no sky; so what moves changes nothing far away.
pub const HIDES: f64 = 16.0;

/// The colour of the ground that far away.
pub const FAR_GROUND: f64 = 0.2;

/// What is seen through glass where the ground is transparent, as pictures store it.
pub const PAPER: f64 = 0.8;

/// What numbers are for.
pub mod purpose {
    pub const SKY: u32 = 2;
    pub const MIRROR: u32 = 3;
    pub const SOFTBOX: u32 = 8;
    /// Between the numbers of one reflection and the next.
    pub const STEP: u32 = 256;
}

/// The studio's eye on a world.
pub struct Studio<'a> {
    world: World<'a>,
    lights: Lights,
    pinhole: Pinhole,
    size: [u32; 2],
    /// The width that a sample stands for at distance 1.
    spread: f32,
    /// What is seen through glass where there is nothing.
    background: Vec3,
}

/// Rays on their way, all reflected or refracted as often.
struct Flight<S: Simd> {
    rays: Rays<S>,
    lanes: Mask8<S>,
    depth: u32,
    /// How far they have come from the camera.
    length: F32x8<S>,
    /// Their shares of the pixel's colour.
    weight: F32x8<S>,
    /// The refractive index of what they are in.
    index: F32x8<S>,
    /// The width that they stand for at distance 1.
    spread: F32x8<S>,
}

/// Places where rays meet surfaces.
struct Meet<S: Simd> {
    distance: F32x8<S>,
    point: Vec3x8<S>,
    /// Just outside.
    leaving: Vec3x8<S>,
    /// Out of the surfaces themselves, and of what they are shaded as, on the rays' side.
    outward: Vec3x8<S>,
    normal: Vec3x8<S>,
    material: U32x8<S>,
    color: Vec3x8<S>,
}

/// What samples are made with.
struct Draw<S: Simd> {
    numbers: Sequences<S>,
    counts: RayCounts,
    outlooks: Outlooks<S>,
    /// What they depend on, where that is asked for.
    ties: Option<Ties8<S>>,
}

impl<S: Simd> Draw<S> {
    /// Appends what the first few lanes depend on, where they are asked for.
    #[inline(always)]
    fn tell(&self, count: usize, ties: Option<&mut Vec<Ties>>) {
        if let (Some(ties), Some(found)) = (ties, &self.ties) {
            ties.extend_from_slice(&found.store()[..count]);
        }
    }
}

impl<'a> Studio<'a> {
    /// For a picture of `size` and samples as wide as a pixel over `across`.
    pub fn new(world: World<'a>, room: &Room, size: [u32; 2], across: f64) -> Studio<'a> {
        let scene = world.scene;
        let background = scene.background.unwrap_or(glam::DVec3::splat(PAPER));
        Studio {
            lights: Lights::new(room),
            pinhole: Pinhole::new(&scene.camera, size[0], size[1]),
            size,
            spread: (scene.camera.spread(size[0]) / across) as f32,
            background: linear_light(background).as_vec3(),
            world,
        }
    }

    /// What comes back along up to eight samples.
    #[inline(always)]
    fn packet<S: Simd>(
        &self,
        samples: &[Sample],
        seen: &mut Vec<Glimpse>,
        ties: Option<&mut Vec<Ties>>,
    ) -> RayCounts {
        let ([mut x, mut y, mut index], mut known) = ([[0; 8]; 3], [Known::default(); 8]);
        for lane in 0..LANES {
            let sample = &samples[lane.min(samples.len() - 1)];
            [x[lane], y[lane]] = sample.spot;
            (index[lane], known[lane]) = (sample.index, sample.known);
        }
        let (x, y) = (U32x8::<S>::load(&x), U32x8::load(&y));
        let numbers = Sequences::new(x, y, U32x8::load(&index));
        let lanes = Mask8::first(samples.len());
        let rays = if self.world.scene.camera.has_lens() {
            self.rays_through_lens(samples)
        } else {
            let half = F32x8::splat(0.5);
            let (dx, dy) = if samples[0].is_centered { (half, half) } else { numbers.pair(PLACE) };
            self.pinhole.rays(x.i32_to_f32() + dx, y.i32_to_f32() + dy)
        };
        let (zero, one) = (F32x8::splat(0.0), F32x8::splat(1.0));
        let mut found = ties.is_some().then(Ties8::new);
        let index = if self.world.is_transparent() {
            self.world.index_at(rays.origin, lanes, &mut found)
        } else {
            one
        };
        let flight = Flight {
            rays,
            lanes,
            depth: 0,
            length: zero,
            weight: one,
            index,
            spread: F32x8::splat(self.spread),
        };
        let mut draw = Draw {
            numbers,
            counts: RayCounts { primary: samples.len() as u64, ..RayCounts::default() },
            outlooks: Outlooks::new(&known),
            ties: found,
        };
        let meeting = self.nearest(&rays, lanes, &mut draw);
        let hit = lanes & meeting.lanes();
        if !hit.any() {
            seen.extend(samples.iter().map(|_| Glimpse::default()));
            draw.tell(samples.len(), ties);
            return draw.counts;
        }
        let light = self.light(&Flight { lanes: hit, ..flight }, &meeting, &mut draw);
        let endless = self.world.is_endless(&meeting);
        let mut cover = hit.keep(one);
        if endless.any() {
            cover = (hit & endless).select(one - melted(rays.at(meeting.t)), cover);
        }
        let (light, cover, hit) = (light.rows(), cover.store(), hit.bits());
        let outlooks = draw.outlooks.rows();
        let glimpse = |lane: usize| match hit >> lane & 1 {
            0 => Glimpse::default(),
            _ => Glimpse::new(light.lane(lane), cover[lane], outlooks.lane(lane)),
        };
        seen.extend((0..samples.len()).map(glimpse));
        draw.tell(samples.len(), ties);
        draw.counts
    }

    /// The rays of a camera with a lens, one by one.
    fn rays_through_lens<S: Simd>(&self, samples: &[Sample]) -> Rays<S> {
        let ([width, height], camera) = (self.size, &self.world.scene.camera);
        let rays: [crate::geometry::Ray; 8] = std::array::from_fn(|lane| {
            let Sample { spot: [x, y], index, is_centered, .. } =
                samples[lane.min(samples.len() - 1)];
            let numbers = Sequence::new(x, y, index);
            let (dx, dy) = if is_centered { (0.5, 0.5) } else { numbers.pair(PLACE) };
            let ray = camera.ray(f64::from(x) + dx, f64::from(y) + dy, width, height);
            camera.ray_through_lens(ray, || numbers.pair(LENS))
        });
        Rays {
            origin: Vec3x8::load(&rays.map(|ray| ray.origin)),
            direction: Vec3x8::load(&rays.map(|ray| ray.direction)),
        }
    }

    #[inline(always)]
    fn nearest<S: Simd>(&self, rays: &Rays<S>, lanes: Mask8<S>, draw: &mut Draw<S>) -> Meeting<S> {
        let farthest = F32x8::splat(self.world.scene.max_distance as f32);
        self.world.nearest(rays, farthest, lanes, &mut draw.ties)
    }

    /// The light that comes back along rays that meet something.
    #[inline(never)]
    fn light<S: Simd>(
        &self,
        flight: &Flight<S>,
        meeting: &Meeting<S>,
        draw: &mut Draw<S>,
    ) -> Vec3x8<S> {
        S::run(
            #[inline(always)]
            || {
                let Flight { rays, lanes, .. } = flight;
                let (world, materials) = (&self.world, &self.world.materials);
                let seen = (flight.length + meeting.t) * flight.spread;
                let sight = world.sight(rays, meeting, seen, *lanes, &mut draw.ties);
                let (outward, normal) = facing(sight.normals, rays.direction);
                let meet = Meet {
                    distance: meeting.t,
                    point: sight.point,
                    leaving: sight.point + outward * F32x8::splat(OFFSET),
                    outward,
                    normal,
                    material: sight.material,
                    color: sight.color,
                };
                let one = F32x8::splat(1.0);
                let mut clear = Mask8::no_lanes();
                if world.is_transparent() {
                    clear = *lanes & materials.transparency(meet.material).gt(F32x8::splat(0.0));
                }
                let mut sum = Vec3x8::zero();
                if clear.any() {
                    sum = self.glass(&Flight { lanes: clear, ..*flight }, &meet, draw);
                }
                let opaque = lanes.but(clear);
                if !opaque.any() {
                    return sum;
                }
                let cosine = -rays.direction.dot(normal);
                let metal = opaque & materials.is_metal(meet.material);
                let dull = opaque.but(metal);
                let mut ground = Vec3x8::zero();
                if dull.any() {
                    let gathered = self.gathered(&Flight { lanes: dull, ..*flight }, &meet, draw);
                    ground = meet.color.times(gathered) * dull.keep(F32x8::splat(GROUND as f32));
                }
                if flight.depth == 0 {
                    let shown = meet.color * dull.keep(F32x8::splat(GROUND as f32));
                    draw.outlooks.weigh(opaque, shown);
                }
                let coat = materials.coat(meet.material);
                let coated = dull & coat.gt(one);
                let glossy = metal | coated;
                if !glossy.any() {
                    return Vec3x8::select(clear, sum, ground);
                }
                // A rough coat has no grazing glare: part of it is always seen from its side.
                let roughness = materials.roughness(meet.material);
                let share =
                    coated.keep(fresnel(cosine, coat) * (one - F32x8::splat(0.5) * roughness));
                let tinted = meet.color.lerp(Vec3x8::grey(one), grazing(cosine));
                let shares = Vec3x8::select(metal, tinted, Vec3x8::grey(share));
                let above = self.mirror(&Flight { lanes: glossy, ..*flight }, &meet, shares, draw);
                if flight.depth == 0 {
                    draw.outlooks.weigh(opaque, Vec3x8::grey(one - share));
                }
                let opaque = ground * (one - share) + above;
                Vec3x8::select(clear, sum, opaque)
            },
        )
    }

    /// The light that falls on surfaces, as seen on white.
    #[inline(never)]
    fn gathered<S: Simd>(
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

    /// The shares of mirror images; nothing elsewhere.
    #[inline(never)]
    fn mirror<S: Simd>(
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
                    let meeting = self.nearest(&rays, followed, draw);
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
    fn glass<S: Simd>(&self, flight: &Flight<S>, meet: &Meet<S>, draw: &mut Draw<S>) -> Vec3x8<S> {
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

impl Eye<[Sample], Glimpse> for Studio<'_> {
    fn see(
        &self,
        samples: &[Sample],
        seen: &mut Vec<Glimpse>,
        ties: Option<&mut Vec<Ties>>,
    ) -> RayCounts {
        struct See<'a, 'b>(
            &'a Studio<'b>,
            &'a [Sample],
            &'a mut Vec<Glimpse>,
            Option<&'a mut Vec<Ties>>,
        );
        impl Task for See<'_, '_> {
            type Output = RayCounts;

            #[inline(always)]
            fn run<S: Simd>(self) -> RayCounts {
                let See(eye, samples, seen, mut ties) = self;
                let mut counts = RayCounts::default();
                for packet in samples.chunks(LANES) {
                    counts = counts + eye.packet::<S>(packet, seen, ties.as_deref_mut());
                }
                counts
            }
        }
        dispatch(See(self, samples, seen, ties))
    }
}

/// How much of endless bodies has melted into the background at `point`, 0 to 1.
#[inline(always)]
fn melted<S: Simd>(point: Vec3x8<S>) -> F32x8<S> {
    let [from, to] = MELTS.map(|distance| distance as f32);
    let away = (point - Vec3x8::splat(MIDDLE.as_vec3())).length();
    let t = ((away - F32x8::splat(from)) * F32x8::splat(1.0 / (to - from))).clamp(0.0, 1.0);
    t * t * (F32x8::splat(3.0) - F32x8::splat(2.0) * t)
}

/// Directions round `normal`, by the cosine.
#[inline(always)]
fn scattered<S: Simd>(normal: Vec3x8<S>, pair: (F32x8<S>, F32x8<S>)) -> Vec3x8<S> {
    let direction = normal + sphere(pair);
    let length = direction.length();
    let is_any = length.gt(F32x8::splat(1e-6));
    Vec3x8::select(is_any, direction * length.recip(), normal)
}

/// Points on the sphere of radius 1.
#[inline(always)]
fn sphere<S: Simd>((u, v): (F32x8<S>, F32x8<S>)) -> Vec3x8<S> {
    let one = F32x8::splat(1.0);
    let y = one - F32x8::splat(2.0) * u;
    let radius = (one - y * y).max(F32x8::splat(0.0)).sqrt();
    let (sin, cos) = math::sin_cos_turns(v);
    Vec3x8::new(radius * cos, y, radius * sin)
}

/// Points in the ball of radius 1, more likely near its middle.
#[inline(always)]
fn ball<S: Simd>((u, v): (F32x8<S>, F32x8<S>)) -> Vec3x8<S> {
    // The golden ratio parts u from what it is used for a second time.
    let place = u * F32x8::splat(1.618_034 * 8.0);
    sphere((u, v)) * (place - place.floor())
}
