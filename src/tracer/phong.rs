//! Whitted's recursion with Phong's sum (Turek 2008, 2.1 to 2.3 and 4.4), for packets of rays.

use glam::Vec3;

use super::RayCounts;
use super::eye::Eye;
use super::footprint::{Footprint, Footprints};
use super::optics::{facing, mirrored, refracted};
use super::pinhole::Pinhole;
use super::plane::Spot;
use super::ties::{Ties, Ties8};
use super::world::{Candidates, OFFSET, World};
use crate::lanes::{F32x8, LANES, Mask8, Simd, Task, Vec3x8, dispatch, math};
use crate::packet::Rays;
use crate::packet::boxes::Aabb;
use crate::scene::Rgb;

/// How often a ray may go straight through a surface before each further time counts as refraction.
const MAX_PASSES: f32 = 100.0;

/// How many packets from the camera are told together what they may meet.
const NEIGHBOURS: usize = 4;

/// Phong's eye on a world.
pub struct Phong<'a> {
    world: World<'a>,
    pinhole: Pinhole,
    /// The width that a ray through a whole pixel stands for at distance 1.
    spread: f32,
}

/// Places of the picture, in pixels from its upper left corner; their rays stand for one of `side` across a
/// pixel.
#[derive(Clone, Debug)]
pub struct Places {
    pub x: Vec<f32>,
    pub y: Vec<f32>,
    pub side: f32,
}

/// What a single ray from the camera brings back.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Shade {
    pub color: Vec3,
    /// Whether it met anything.
    pub hits: bool,
}

/// The same, with what it is made of.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Seen {
    pub shade: Shade,
    pub footprint: Footprint,
}

impl Places {
    /// The middles of `side` × `side` equal parts of each pixel.
    pub fn new(spots: &[Spot], side: u32) -> Places {
        let count = spots.len() * (side * side) as usize;
        let mut places = Places {
            x: Vec::with_capacity(count),
            y: Vec::with_capacity(count),
            side: side as f32,
        };
        let middles: Vec<f32> = (0..side).map(|part| (part as f32 + 0.5) / side as f32).collect();
        for [x, y] in spots {
            let (left, top) = (*x as f32, *y as f32);
            for row in &middles {
                places.x.extend(middles.iter().map(|column| left + column));
                places.y.extend(middles.iter().map(|_| top + row));
            }
        }
        places
    }
}

/// Rays on their way.
struct Flight<S: Simd> {
    rays: Rays<S>,
    lanes: Mask8<S>,
    /// How often they were reflected or refracted.
    depth: F32x8<S>,
    /// How often they went straight through a surface: between bodies of glass that touch or overlap.
    passes: F32x8<S>,
    /// How far they have come from the camera.
    length: F32x8<S>,
    /// Their shares of the pixel's colour.
    weight: F32x8<S>,
    /// The refractive index of what they are in.
    index: F32x8<S>,
}

/// What is found on the way.
struct Walk<S: Simd> {
    counts: RayCounts,
    /// Which rays from the camera met anything, once that is known.
    hits: Option<Mask8<S>>,
    footprints: Footprints<S>,
    /// The width that a ray stands for at distance 1.
    spread: F32x8<S>,
    /// What it depends on, where that is asked for.
    ties: Option<Ties8<S>>,
}

impl<'a> Phong<'a> {
    pub fn new(world: World<'a>, [width, height]: [u32; 2]) -> Phong<'a> {
        let camera = &world.scene.camera;
        let (pinhole, spread) = (Pinhole::new(camera, width, height), camera.spread(width) as f32);
        Phong { world, pinhole, spread }
    }

    /// Through up to eight places.
    #[inline(always)]
    fn rays<S: Simd>(&self, places: &Places, start: usize) -> Rays<S> {
        let (x, y) = (&places.x[start..], &places.y[start..]);
        self.pinhole.rays(F32x8::load_some(x), F32x8::load_some(y))
    }

    /// What may be met through the places from `start` that neighbouring packets have, if that is few.
    #[inline(always)]
    fn ahead<S: Simd>(&self, places: &Places, start: usize) -> Option<Candidates> {
        if start + NEIGHBOURS * LANES > places.x.len() {
            return None;
        }
        let mut packets = [self.rays::<S>(places, start); NEIGHBOURS];
        for (index, packet) in (0..).zip(&mut packets).skip(1) {
            *packet = self.rays(places, start + index * LANES);
        }
        self.world.ahead(&packets, Mask8::all_lanes())
    }

    /// What comes back through up to eight places; the lanes behind them have no meaning.
    #[inline(always)]
    fn packet<S: Simd>(
        &self,
        places: &Places,
        start: usize,
        ahead: Option<&Candidates>,
        ties: Option<&mut Vec<Ties>>,
    ) -> (Vec3x8<S>, Walk<S>) {
        let count = (places.x.len() - start).min(LANES);
        let rays = self.rays(places, start);
        let lanes = Mask8::first(count);
        let (zero, one) = (F32x8::splat(0.0), F32x8::splat(1.0));
        let mut found = ties.is_some().then(Ties8::new);
        let flight = Flight {
            rays,
            lanes,
            depth: zero,
            passes: zero,
            length: zero,
            weight: one,
            index: if self.world.is_transparent() {
                self.world.index_at(rays.origin, lanes, &mut found)
            } else {
                one
            },
        };
        let mut walk = Walk {
            counts: RayCounts::default(),
            hits: None,
            footprints: Footprints::new(),
            spread: F32x8::splat(self.spread / places.side),
            ties: found,
        };
        walk.counts.primary = count as u64;
        let color = self.radiance(&flight, ahead, &mut walk);
        if let (Some(ties), Some(found)) = (ties, &walk.ties) {
            ties.extend_from_slice(&found.store()[..count]);
        }
        (color, walk)
    }

    #[inline(never)]
    fn radiance<S: Simd>(
        &self,
        flight: &Flight<S>,
        ahead: Option<&Candidates>,
        walk: &mut Walk<S>,
    ) -> Vec3x8<S> {
        S::run(
            #[inline(always)]
            || {
                let Flight { rays, lanes, .. } = flight;
                let (world, scene) = (&self.world, self.world.scene);
                let (before, ties) = (F32x8::splat(scene.max_distance as f32), &mut walk.ties);
                let meeting = match ahead {
                    Some(ahead) => world.nearest_of(ahead, rays, before, *lanes, ties),
                    None => world.nearest_together(rays, before, *lanes, ties),
                };
                let hit = *lanes & meeting.lanes();
                walk.hits = walk.hits.or(Some(hit));
                walk.footprints.meet_nothing(lanes.but(hit));
                let background = scene.background.unwrap_or(Rgb::ZERO).as_vec3();
                let background = Vec3x8::splat(background);
                if !hit.any() {
                    return background;
                }
                let length = flight.length + meeting.t;
                let sight = world.sight(rays, &meeting, length * walk.spread, hit, &mut walk.ties);
                let materials = &world.materials;
                let direction = rays.direction;
                let (outward, normal) = facing(sight.normals, direction);
                let leaving = sight.point + outward * F32x8::splat(OFFSET);
                let mirrored = mirrored(direction, normal, outward);

                let diffuse = materials.diffuse(sight.material);
                let specular = materials.specular(sight.material);
                let mut scattered = Vec3x8::grey(materials.ambient(sight.material));
                let mut highlights = Vec3x8::zero();
                let zero = F32x8::splat(0.0);
                let places = Aabb::of_points(leaving, hit);
                for light in &scene.lights {
                    let at = light.position.as_vec3();
                    let towards = Vec3x8::splat(at) - leaving;
                    let distance = towards.length();
                    let towards = towards * distance.recip();
                    let incidence = normal.dot(towards);
                    let lit = hit & incidence.gt(zero);
                    if !lit.any() {
                        continue;
                    }
                    walk.counts.shadow += u64::from(lit.bits().count_ones());
                    let way = Rays { origin: leaving, direction: towards };
                    let between = world.between::<S>(&places, &Aabb { min: at, max: at });
                    let asking = lit.but(world.is_open(leaving, &[at], &between));
                    let mut share = lit.keep(F32x8::splat(1.0));
                    if asking.any() {
                        let ties = &mut walk.ties;
                        let through = world.transmission(&way, distance, asking, &between, ties);
                        share = asking.select(through, share);
                    }
                    let lit = lit & share.gt(zero);
                    if !lit.any() {
                        continue;
                    }
                    let light = Vec3x8::splat(light.color.as_vec3()) * share;
                    let lit_by = light * (diffuse * incidence);
                    scattered += Vec3x8::select(lit, lit_by, Vec3x8::zero());
                    let highlight = mirrored.dot(towards);
                    let glossy = lit & highlight.gt(materials.least_highlight(sight.material));
                    if glossy.any() {
                        let power = math::pow(highlight, materials.shininess(sight.material));
                        let gloss = light * (specular * power);
                        highlights += Vec3x8::select(glossy, gloss, Vec3x8::zero());
                    }
                }
                walk.footprints.meet(
                    hit,
                    flight.weight,
                    world.names(&meeting),
                    normal,
                    sight.color,
                    scattered + highlights,
                );
                let mut sum = sight.color.times(scattered) + highlights;
                let deeper = hit & flight.depth.lt(F32x8::splat(scene.max_depth as f32));
                let mut mirror = materials.reflectivity(sight.material);
                let depth = flight.depth + F32x8::splat(1.0);
                if world.is_transparent() && deeper.any() {
                    let share = materials.transparency(sight.material);
                    let clear = deeper & share.gt(zero);
                    if clear.any() {
                        let behind = sight.point - outward * F32x8::splat(OFFSET);
                        let index = world.index_at(behind, clear, &mut walk.ties);
                        let (bent, passes_through) =
                            refracted(direction, normal, flight.index / index);
                        // The reflection is total: all that comes this way is thrown back.
                        mirror = clear.but(passes_through).select(F32x8::splat(1.0), mirror);
                        // What does not bend does not count, as long as there is an end to it.
                        let straight =
                            index.eq(flight.index) & flight.passes.lt(F32x8::splat(MAX_PASSES));
                        let next = Flight {
                            rays: Rays { origin: behind, direction: bent },
                            lanes: clear & passes_through,
                            depth: straight.select(flight.depth, depth),
                            passes: flight.passes + straight.keep(F32x8::splat(1.0)),
                            length,
                            weight: flight.weight * share,
                            index,
                        };
                        let seen = self.followed(next, walk, |counts| &mut counts.refracted);
                        sum += seen * (clear & passes_through).keep(share);
                    }
                }
                if deeper.any() {
                    let next = Flight {
                        rays: Rays { origin: leaving, direction: mirrored },
                        lanes: deeper,
                        depth,
                        passes: flight.passes,
                        length,
                        weight: flight.weight * mirror,
                        index: flight.index,
                    };
                    let seen = self.followed(next, walk, |counts| &mut counts.reflected);
                    sum += seen * deeper.keep(mirror);
                }
                Vec3x8::select(hit, sum, background)
            },
        )
    }

    /// What comes back along those rays that are worth their while; nothing along others.
    #[inline(always)]
    fn followed<S: Simd>(
        &self,
        flight: Flight<S>,
        walk: &mut Walk<S>,
        count: impl FnOnce(&mut RayCounts) -> &mut u64,
    ) -> Vec3x8<S> {
        let least = F32x8::splat(self.world.scene.min_weight as f32);
        let is_worth = flight.weight.gt(F32x8::splat(0.0)) & flight.weight.ge(least);
        let lanes = flight.lanes & is_worth;
        if !lanes.any() {
            return Vec3x8::zero();
        }
        *count(&mut walk.counts) += u64::from(lanes.bits().count_ones());
        let seen = self.radiance(&Flight { lanes, ..flight }, None, walk);
        Vec3x8::select(lanes, seen, Vec3x8::zero())
    }
}

impl<S: Simd> Walk<S> {
    /// What a packet of `count` rays has seen, with its colours.
    #[inline(always)]
    fn shades(&self, color: Vec3x8<S>) -> [Shade; 8] {
        let hits = self.hits.map_or(0, Mask8::bits);
        let (x, y, z) = (color.x.store(), color.y.store(), color.z.store());
        let mut shades = [Shade::default(); 8];
        for (lane, shade) in shades.iter_mut().enumerate() {
            let color = Vec3::new(x[lane], y[lane], z[lane]);
            *shade = Shade { color, hits: hits >> lane & 1 == 1 };
        }
        shades
    }
}

/// A look through places, in either form.
struct Look<'a, 'b, T> {
    eye: &'a Phong<'b>,
    places: &'a Places,
    seen: &'a mut Vec<T>,
    ties: Option<&'a mut Vec<Ties>>,
}

impl<T> Look<'_, '_, T> {
    /// Looks through all places; `tell` says what of it is kept of a packet of so many.
    #[inline(always)]
    fn through<S: Simd>(self, tell: impl Fn(&mut Vec<T>, Vec3x8<S>, &Walk<S>, usize)) -> RayCounts {
        let Look { eye, places, seen, mut ties } = self;
        let (mut counts, mut ahead) = (RayCounts::default(), None);
        for (index, start) in (0..places.x.len()).step_by(LANES).enumerate() {
            if index % NEIGHBOURS == 0 {
                ahead = eye.ahead::<S>(places, start);
            }
            let (color, walk) = eye.packet::<S>(places, start, ahead.as_ref(), ties.as_deref_mut());
            tell(seen, color, &walk, (places.x.len() - start).min(LANES));
            counts = counts + walk.counts;
        }
        counts
    }
}

impl Task for Look<'_, '_, Shade> {
    type Output = RayCounts;

    #[inline(always)]
    fn run<S: Simd>(self) -> RayCounts {
        self.through::<S>(
            #[inline(always)]
            |seen, color, walk, count| seen.extend_from_slice(&walk.shades(color)[..count]),
        )
    }
}

impl Task for Look<'_, '_, Seen> {
    type Output = RayCounts;

    #[inline(always)]
    fn run<S: Simd>(self) -> RayCounts {
        self.through::<S>(
            #[inline(always)]
            |seen, color, walk, count| {
                let (shades, footprints) = (walk.shades(color), walk.footprints.store());
                for (shade, footprint) in shades.into_iter().zip(footprints).take(count) {
                    seen.push(Seen { shade, footprint });
                }
            },
        )
    }
}

impl Eye<Places, Shade> for Phong<'_> {
    fn see(
        &self,
        places: &Places,
        seen: &mut Vec<Shade>,
        ties: Option<&mut Vec<Ties>>,
    ) -> RayCounts {
        dispatch(Look { eye: self, places, seen, ties })
    }
}

impl Eye<Places, Seen> for Phong<'_> {
    fn see(
        &self,
        places: &Places,
        seen: &mut Vec<Seen>,
        ties: Option<&mut Vec<Ties>>,
    ) -> RayCounts {
        dispatch(Look { eye: self, places, seen, ties })
    }
}
