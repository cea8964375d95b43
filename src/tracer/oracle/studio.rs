//! Soft light: a coloured ground under a clear coat, in a room with softboxes and a sky.
//!
//! Every sample of a pixel asks each softbox at one point, the sky in one direction, and the mirror in
//! one, but for what is known from others. What nothing stands in the way of is known without samples, so a plain that
//! sees the whole sky has no noise.

use std::f64::consts::TAU;

use glam::{DVec3, Vec3};

use super::optics::{facing, fresnel, grazing, mirrored, refracted};
use super::world::{OFFSET, World};
use crate::geometry::{Hit, Ray, Solid};
use crate::scene::{MIDDLE, Material, Rgb, Room, Scene, Softbox, linear_light};
use crate::tracer::RayCounts;
use crate::tracer::eye::Eye;
use crate::tracer::outlook::{self, BOXES, Known, Outlook, Pool, SKY};
use crate::tracer::samples::{Glimpse, LENS, PLACE, Sample};
use crate::tracer::sequence::Sequence;
use crate::tracer::studio::{
    BRIGHTEST_IN_A_MIRROR, FAR_GROUND, FREE_SKY, GROUND, HIDES, MELTS, MIRRORS_FROM, PAPER,
    SHADOWS_FROM, THROWN, purpose,
};
use crate::tracer::ties::Ties;

/// The studio's eye on a world, for a picture of a size.
pub struct Studio<'a> {
    world: World<'a>,
    size: [u32; 2],
    /// Rays stand for so much less than a pixel.
    across: f64,
    room: &'a Room,
    /// What is seen through glass where there is nothing.
    background: Rgb,
}

/// A ray on its way.
struct Flight {
    ray: Ray,
    /// How often it was reflected or refracted.
    depth: u32,
    /// How far it has come from the camera.
    length: f64,
    /// Its share of the pixel's colour.
    weight: f64,
    /// The refractive index of what it is in.
    index: f64,
    /// The width that it stands for at distance 1.
    spread: f64,
}

/// What a sample is made with.
struct Draw {
    numbers: Sequence,
    known: Known,
    counts: RayCounts,
    outlook: Outlook,
}

/// A place where a ray meets a surface.
struct Meeting<'a> {
    point: DVec3,
    /// Just outside.
    leaving: DVec3,
    /// Out of the surface itself, and of what it is shaded as, on the ray's side.
    outward: DVec3,
    normal: DVec3,
    material: &'a Material,
    color: Rgb,
}

impl<'a> Studio<'a> {
    /// For samples as wide as a pixel over `across`.
    pub fn new(scene: &'a Scene, room: &'a Room, size: [u32; 2], across: f64) -> Studio<'a> {
        let background = linear_light(scene.background.unwrap_or(Rgb::splat(PAPER)));
        Studio { world: World { scene }, room, size, across, background }
    }

    /// What comes back along a ray from the camera, which stands for a width of `spread` at
    /// distance 1.
    fn trace(&self, ray: Ray, spread: f64, draw: &mut Draw) -> Glimpse {
        draw.counts.primary += 1;
        let index = self.world.index_at(ray.origin);
        let flight = Flight { ray, depth: 0, length: 0.0, weight: 1.0, index, spread };
        let Some((object, hit)) = self.nearest(&ray) else {
            return Glimpse::default();
        };
        let light = self.light(&flight, object, hit, draw);
        let body = &self.world.scene.objects[object].body;
        let is_endless = !body.bounds().is_finite();
        let cover = if is_endless { 1.0 - melted(ray.at(hit.t)) } else { 1.0 };
        Glimpse::new(light.as_vec3(), cover as f32, draw.outlook)
    }

    fn nearest(&self, ray: &Ray) -> Option<(usize, Hit)> {
        self.world.nearest(ray, self.world.scene.max_distance)
    }

    /// The light that comes back along a ray that met something, or nothing.
    fn radiance(&self, flight: &Flight, draw: &mut Draw) -> Rgb {
        match self.nearest(&flight.ray) {
            Some((object, hit)) => self.light(flight, object, hit, draw),
            None => self.background,
        }
    }

    /// The light from a hit.
    fn light(&self, flight: &Flight, object: usize, hit: Hit, draw: &mut Draw) -> Rgb {
        let object = &self.world.scene.objects[object];
        let ray = &flight.ray;
        let point = ray.at(hit.t);
        let (material, place) = object.material(point, hit.normal);
        let (outward, normal) = facing(hit, ray.direction);
        let seen = (flight.length + hit.t) * flight.spread;
        let meeting = Meeting {
            point,
            leaving: point + outward * OFFSET,
            outward,
            normal,
            material,
            color: object.color(material, place, seen),
        };
        let cosine = -ray.direction.dot(normal);
        if material.finish.transparency > 0.0 {
            return self.glass(flight, &meeting, hit.t, draw);
        }
        let coat = &material.coat;
        if coat.metal {
            let share = meeting.color.lerp(Rgb::ONE, grazing(cosine));
            return self.mirror(flight, &meeting, hit.t, share, draw);
        }
        let ground = meeting.color * GROUND * self.gathered(flight, &meeting, draw);
        if flight.depth == 0 {
            draw.outlook.weigh((meeting.color * GROUND).as_vec3());
        }
        if coat.coat <= 1.0 {
            return ground;
        }
        // A rough coat has no grazing glare: part of it is always seen from its side.
        let share = fresnel(cosine, coat.coat) * (1.0 - 0.5 * coat.roughness);
        if flight.depth == 0 {
            draw.outlook.weigh(Vec3::splat(1.0 - share as f32));
        }
        let above = self.mirror(flight, &meeting, hit.t, Rgb::splat(share), draw);
        ground * (1.0 - share) + above
    }

    /// The light that falls on a surface, as seen on white.
    fn gathered(&self, flight: &Flight, meeting: &Meeting, draw: &mut Draw) -> Rgb {
        let [mut came, mut open, mut others] = [Rgb::ZERO; 3];
        for (number, softbox) in self.room.softboxes.iter().enumerate() {
            let is_noted = flight.depth == 0 && number < outlook::MIRROR as usize;
            let (full, lost) = self.softbox(softbox, number as u32, flight, meeting, draw);
            if is_noted {
                open += softbox.color * full;
                came += softbox.color * (full - lost);
            } else {
                others += softbox.color * (full - lost);
            }
        }
        if flight.depth == 0 {
            if draw.known.pooled[BOXES] {
                came = Rgb::ZERO;
            }
            draw.outlook.pools[BOXES] = Pool { came: came.as_vec3(), open: open.as_vec3() };
        }
        came + others + self.daylight(flight, meeting, draw)
    }

    /// The cosine of the light of a softbox, by number, and what is lost of it by what stands in the way.
    fn softbox(
        &self,
        softbox: &Softbox,
        number: u32,
        flight: &Flight,
        meeting: &Meeting,
        draw: &mut Draw,
    ) -> (f64, f64) {
        let Meeting { leaving, normal, outward, .. } = *meeting;
        let pair = draw.numbers.pair(flight.depth * purpose::STEP + purpose::SOFTBOX + number);
        let towards = softbox.point(pair) - leaving;
        let distance = towards.length();
        let towards = towards / distance;
        let is_lit = normal.dot(towards) > 0.0 && outward.dot(towards) > 0.0;
        let cosine = if is_lit { normal.dot(towards) } else { 0.0 };
        // Of a softbox that is seen whole, the sample says no more than how much is lost.
        let full = softbox.mean_cosine(leaving, normal, outward).unwrap_or(cosine);
        let bit = if flight.depth == 0 && number < outlook::MIRROR { 1 << number } else { 0 };
        if draw.known.hidden & bit != 0 {
            return (full, full);
        }
        let is_pooled = bit != 0 && draw.known.pooled[BOXES];
        if !is_lit || draw.known.free & bit != 0 || is_pooled || flight.weight < SHADOWS_FROM {
            return (full, 0.0);
        }
        draw.counts.shadow += 1;
        let open = self.world.transmission(&Ray { origin: leaving, direction: towards }, distance);
        draw.outlook.free |= if open > 0.0 { bit } else { 0 };
        draw.outlook.hidden |= if open < 1.0 { bit } else { 0 };
        (full, cosine * (1.0 - open))
    }

    /// What comes from the sky, and from other surfaces that hide it.
    fn daylight(&self, flight: &Flight, meeting: &Meeting, draw: &mut Draw) -> Rgb {
        let sky = self.room.daylight(meeting.normal);
        if flight.depth > 0 {
            return sky.brightness * (sky.share * FREE_SKY);
        }
        let ground = Rgb::splat(FAR_GROUND) * self.room.bounce;
        let thrown = Rgb::splat(THROWN) * self.room.bounce;
        let open = sky.brightness * sky.share + ground * (1.0 - sky.share) + thrown;
        let light = if draw.known.pooled[SKY] {
            Rgb::ZERO
        } else {
            self.asked_sky(meeting, sky.brightness, draw)
        };
        draw.outlook.pools[SKY] = Pool { came: light.as_vec3(), open: open.as_vec3() };
        light
    }

    /// The same by one ray, where the sky has that `brightness`.
    fn asked_sky(&self, meeting: &Meeting, brightness: Rgb, draw: &mut Draw) -> Rgb {
        let direction = scattered(meeting.normal, draw.numbers.pair(purpose::SKY));
        if direction.dot(meeting.outward) <= 0.0 {
            return Rgb::ZERO;
        }
        draw.counts.shadow += 1;
        let way = Ray { origin: meeting.leaving, direction };
        match self.world.nearest(&way, HIDES) {
            None if direction.y > 0.0 => brightness,
            None => Rgb::splat(FAR_GROUND) * self.room.bounce,
            Some((index, hit)) => {
                let object = &self.world.scene.objects[index];
                let (material, _) = object.material(way.at(hit.t), hit.normal);
                if material.finish.transparency > 0.0 {
                    return brightness * material.finish.transparency;
                }
                material.texture.mean() * self.room.bounce
            }
        }
    }

    /// The share of a mirror image.
    fn mirror(
        &self,
        flight: &Flight,
        meeting: &Meeting,
        distance: f64,
        share: Rgb,
        draw: &mut Draw,
    ) -> Rgb {
        let roughness = meeting.material.coat.roughness;
        let exact = mirrored(flight.ray.direction, meeting.normal, meeting.outward);
        let weight = flight.weight * share.max_element();
        let bit = if flight.depth == 0 { 1 << outlook::MIRROR } else { 0 };
        let is_free = draw.known.free & bit != 0;
        if weight >= MIRRORS_FROM && flight.depth < self.world.scene.max_depth && !is_free {
            let from = flight.depth * purpose::STEP;
            let blurred =
                (exact + ball(draw.numbers.pair(from + purpose::MIRROR)) * roughness).normalize();
            let direction = if blurred.dot(meeting.outward) > 0.0 { blurred } else { exact };
            let ray = Ray { origin: meeting.leaving, direction };
            draw.counts.reflected += 1;
            if let Some((object, hit)) = self.nearest(&ray) {
                draw.outlook.hidden |= bit;
                let next = Flight {
                    ray,
                    depth: flight.depth + 1,
                    length: flight.length + distance,
                    weight,
                    index: flight.index,
                    spread: flight.spread + roughness,
                };
                return share * self.light(&next, object, hit, draw);
            }
            draw.outlook.free |= bit;
        }
        // Softboxes are blurred as a whole, not by samples; those that are seen at second hand are
        // found by few, and would leave specks.
        let seen = self.room.radiance(meeting.point, exact, roughness);
        share * if flight.depth == 0 { seen } else { seen.min(Rgb::splat(BRIGHTEST_IN_A_MIRROR)) }
    }

    /// What is seen in glass, and through it.
    fn glass(&self, flight: &Flight, meeting: &Meeting, distance: f64, draw: &mut Draw) -> Rgb {
        let finish = &meeting.material.finish;
        let behind = meeting.point - meeting.outward * OFFSET;
        let index = self.world.index_at(behind);
        let ratio = flight.index / index;
        let direction = flight.ray.direction;
        let cosine = -direction.dot(meeting.normal);
        let bent = refracted(direction, meeting.normal, ratio);
        let share = match bent {
            None => 1.0,
            // On the way out the angle that counts is the one outside.
            Some(bent) if ratio > 1.0 => fresnel(-bent.dot(meeting.normal), ratio),
            Some(_) if ratio == 1.0 => 0.0,
            Some(_) => fresnel(cosine, 1.0 / ratio),
        };
        let mut sum = Rgb::ZERO;
        if share > 0.0 {
            sum += self.mirror(flight, meeting, distance, Rgb::splat(share), draw);
        }
        let Some(bent) = bent else {
            return sum;
        };
        let share = (1.0 - share) * finish.transparency;
        let next = Flight {
            ray: Ray { origin: behind, direction: bent },
            depth: flight.depth + 1,
            length: flight.length + distance,
            weight: flight.weight * share,
            index,
            spread: flight.spread,
        };
        // Each of a body's two surfaces takes half of what its colour takes.
        let tint = Rgb::from_array(meeting.color.max(Rgb::ZERO).to_array().map(f64::sqrt));
        if next.depth <= self.world.scene.max_depth && next.weight >= self.world.scene.min_weight {
            draw.counts.refracted += 1;
            sum += tint * self.radiance(&next, draw) * share;
        } else {
            sum += tint * self.room.radiance(meeting.point, bent, 1.0) * share;
        }
        let clouded = 1.0 - finish.transparency;
        if clouded > 0.0 && flight.depth == 0 {
            let shown = meeting.color * clouded;
            sum += shown * self.gathered(flight, meeting, draw);
            draw.outlook.weigh(shown.as_vec3());
        }
        sum
    }
}

/// How much of an endless body has melted into the background at `point`, 0 to 1.
fn melted(point: DVec3) -> f64 {
    let t = (((point - MIDDLE).length() - MELTS[0]) / (MELTS[1] - MELTS[0])).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// A direction round `normal`, by the cosine.
fn scattered(normal: DVec3, pair: (f64, f64)) -> DVec3 {
    (normal + sphere(pair)).try_normalize().unwrap_or(normal)
}

/// A point on the sphere of radius 1.
fn sphere((u, v): (f64, f64)) -> DVec3 {
    let y = 1.0 - 2.0 * u;
    let radius = (1.0 - y * y).max(0.0).sqrt();
    let (sin, cos) = libm::sincos(TAU * v);
    DVec3::new(radius * cos, y, radius * sin)
}

/// A point in the ball of radius 1, more likely near its middle.
fn ball((u, v): (f64, f64)) -> DVec3 {
    // The golden ratio parts u from what it is used for a second time.
    sphere((u, v)) * (u * 1.618_033_988_749_895 * 8.0).fract()
}

impl Eye<[Sample], Glimpse> for Studio<'_> {
    fn see(
        &self,
        samples: &[Sample],
        seen: &mut Vec<Glimpse>,
        _: Option<&mut Vec<Ties>>,
    ) -> RayCounts {
        // It does not know.
        let mut all = RayCounts::default();
        let ([width, height], camera) = (self.size, &self.world.scene.camera);
        seen.extend(samples.iter().map(
            |&Sample { spot: [x, y], index, is_centered, known, .. }| {
                let numbers = Sequence::new(x, y, index);
                let (dx, dy) = if is_centered { (0.5, 0.5) } else { numbers.pair(PLACE) };
                let ray = camera.ray(f64::from(x) + dx, f64::from(y) + dy, width, height);
                let ray = camera.ray_through_lens(ray, || numbers.pair(LENS));
                let (counts, outlook) = (RayCounts::default(), Outlook::default());
                let mut draw = Draw { numbers, known, counts, outlook };
                let glimpse = self.trace(ray, camera.spread(width) / self.across, &mut draw);
                all = all + draw.counts;
                glimpse
            },
        ));
        all
    }
}
