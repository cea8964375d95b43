//! Soft light: a coloured ground under a clear coat, in a room with softboxes and a sky.
//!
//! Every sample of a pixel asks each softbox at one point, the sky in one direction, and the mirror in
//! one, but for what is known: from others ([`super::outlook`]), or since nothing can be in the way
//! ([`crate::packet::shaft`]). How bright what nothing stands in the way of is needs no samples, so a plain that sees
//! all of the sky and the softboxes has no noise.

mod directions;
mod gathered;
mod mirror;

use glam::Vec3;

use super::RayCounts;
use super::eye::Eye;
use super::lights::Lights;
use super::optics::{facing, fresnel, grazing};
use super::outlook::{Known, Outlooks};
use super::pinhole::Pinhole;
use super::samples::{Glimpse, LENS, PLACE, Sample};
use super::sequence::{Sequence, Sequences};
use super::ties::{Ties, Ties8};
use super::world::{Meeting, OFFSET, World};
use crate::lanes::{F32x8, LANES, Mask8, Simd, Task, U32x8, Vec3x8, dispatch};
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

/// What is thrown at surfaces counts so much, of the share that is thrown at all, as if it came from an open sky: under
/// a black one it could not be shared out.
pub const THROWN: f64 = 0.05;

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
        let mut tied = [Ties::default(); 8];
        for lane in 0..LANES {
            let sample = &samples[lane.min(samples.len() - 1)];
            [x[lane], y[lane]] = sample.spot;
            (index[lane], known[lane], tied[lane]) = (sample.index, sample.known, sample.ties);
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
        let mut found = if ties.is_some() { Some(Ties8::load(&tied)) } else { None };
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
        let farthest = F32x8::splat(self.world.scene.max_distance as f32);
        let meeting = self.world.nearest_together(&rays, farthest, lanes, &mut draw.ties);
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
