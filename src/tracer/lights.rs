//! The studio's room for packets: softboxes and the sky. (The formulas and their sources stand in
//! [`Room`] and [`Softbox`].)

use std::f32::consts::SQRT_2;

use glam::Vec3;

use crate::lanes::{F32x8, Mask8, Simd, U32x8, Vec3x8, math};
use crate::packet::boxes::Aabb;
use crate::scene::{NARROW, Room, Softbox};

/// A room in f32.
pub struct Lights {
    pub boxes: Vec<LightBox>,
    /// Share of the light that surfaces throw at each other, 0 to 1.
    pub bounce: f32,
    /// From the horizon, from 30° above it, and from straight above.
    sky: [Vec3; 3],
    /// By the upward part of a normal, from −1 to 1 in equal steps: brightness in three columns, and share.
    daylight: [Vec<f32>; 4],
}

/// What surfaces see of a softbox as far as nothing stands in the way.
pub struct Prospect<S: Simd> {
    /// Where any of it may be above the horizon.
    pub may_light: Mask8<S>,
    /// Where all of it is, and it is small enough for the mean cosine to be known: see
    /// [`Softbox::mean_cosine`].
    pub is_whole: Mask8<S>,
    /// The mean cosine there, 0 elsewhere.
    pub mean: F32x8<S>,
}

/// A softbox.
pub struct LightBox {
    /// What it gives a surface that faces it.
    pub color: Vec3,
    center: Vec3,
    half: [Vec3; 2],
    pub corners: [Vec3; 4],
    /// A box that holds it.
    pub aabb: Aabb,
    /// Of its sides' halves.
    lengths: [f32; 2],
    normal: Vec3,
    radiance: Vec3,
}

impl Lights {
    pub fn new(room: &Room) -> Lights {
        let column = |part: fn(Vec3) -> f32| {
            room.daylight.iter().map(|step| part(step.brightness.as_vec3())).collect()
        };
        Lights {
            boxes: room.softboxes.iter().map(LightBox::new).collect(),
            bounce: room.bounce as f32,
            sky: room.sky.map(|color| color.as_vec3()),
            daylight: [
                column(|color| color.x),
                column(|color| color.y),
                column(|color| color.z),
                room.daylight.iter().map(|step| step.share as f32).collect(),
            ],
        }
    }

    /// What the sky gives surfaces with `normal`: mean brightness, and its share of all that they face.
    #[inline(always)]
    pub fn daylight<S: Simd>(&self, normal: Vec3x8<S>) -> (Vec3x8<S>, F32x8<S>) {
        let steps = (self.daylight[0].len() - 1) as f32;
        let upward = normal.y.clamp(-1.0, 1.0) + F32x8::splat(1.0);
        let place = upward * F32x8::splat(steps / 2.0);
        let below = place.floor().min(F32x8::splat(steps - 1.0));
        let (share, index) = (place - below, below.to_i32());
        let [red, green, blue, part] = &self.daylight;
        // Most surfaces face straight up: there all lanes are at the table's end, by the same rounding.
        if !place.lt(F32x8::splat(steps)).any() {
            return (Vec3x8::new(last(red), last(green), last(blue)), last(part));
        }
        let brightness = Vec3x8::new(
            between(red, index, share),
            between(green, index, share),
            between(blue, index, share),
        );
        (brightness, between(part, index, share))
    }

    /// What mirrors at `point` see along `direction` (of length 1) when nothing stands in the way, blurred as by
    /// a `roughness` of 0 to 1.
    #[inline(always)]
    pub fn radiance<S: Simd>(
        &self,
        point: Vec3x8<S>,
        direction: Vec3x8<S>,
        roughness: F32x8<S>,
        lanes: Mask8<S>,
    ) -> Vec3x8<S> {
        let mut sum = self.sky(direction.y);
        for light in &self.boxes {
            sum += light.seen(point, direction, roughness, lanes);
        }
        sum
    }

    /// The sky in directions with the upward parts `upward`, −1 to 1.
    #[inline(always)]
    fn sky<S: Simd>(&self, upward: F32x8<S>) -> Vec3x8<S> {
        let [horizon, middle, zenith] = self.sky;
        let (horizon, middle) = (Vec3x8::splat(horizon), Vec3x8::splat(middle));
        let zenith = Vec3x8::splat(zenith);
        let (one, two) = (F32x8::splat(1.0), F32x8::splat(2.0));
        let low = horizon.lerp(middle, two * upward);
        let high = middle.lerp(zenith, two * upward - one);
        let above = Vec3x8::select(upward.lt(F32x8::splat(0.5)), low, high);
        let below = horizon * (one + upward);
        Vec3x8::select(upward.lt(F32x8::splat(0.0)), below, above)
    }
}

impl LightBox {
    fn new(softbox: &Softbox) -> LightBox {
        let half = softbox.half.map(|side| side.as_vec3());
        let corner = |across: f64, along: f64| softbox.point((across, along)).as_vec3();
        let corners = [corner(0.0, 0.0), corner(0.0, 1.0), corner(1.0, 0.0), corner(1.0, 1.0)];
        LightBox {
            corners,
            aabb: Aabb::union(corners.map(|corner| Aabb { min: corner, max: corner })),
            color: softbox.color.as_vec3(),
            center: softbox.center.as_vec3(),
            half,
            lengths: softbox.half.map(|side| side.length() as f32),
            normal: softbox.normal.as_vec3(),
            radiance: softbox.radiance.as_vec3(),
        }
    }

    /// The points of it at (`across`, `along`), each 0 to 1.
    #[inline(always)]
    pub fn points<S: Simd>(&self, (across, along): (F32x8<S>, F32x8<S>)) -> Vec3x8<S> {
        let (one, two) = (F32x8::splat(1.0), F32x8::splat(2.0));
        let [wide, tall] = self.half;
        let (wide, tall) = (Vec3x8::splat(wide), Vec3x8::splat(tall));
        Vec3x8::splat(self.center) + wide * (two * across - one) + tall * (two * along - one)
    }

    /// What is known of it, as seen from `points`, without asking any of its own points.
    #[inline(always)]
    pub fn prospect<S: Simd>(
        &self,
        points: Vec3x8<S>,
        normals: Vec3x8<S>,
        outward: Vec3x8<S>,
    ) -> Prospect<S> {
        let way = Vec3x8::splat(self.center) - points;
        let halves = [Vec3x8::splat(self.half[0]), Vec3x8::splat(self.half[1])];
        let [normal_whole, normal_part] = above(normals, way, &halves);
        let [outward_whole, outward_part] = above(outward, way, &halves);
        let square = way.dot(way);
        let [wide, tall] = self.lengths;
        let is_far = square.gt(F32x8::splat(NARROW as f32 * (wide * wide + tall * tall)));
        let is_whole = normal_whole & outward_whole & is_far;
        let mut mean = F32x8::splat(0.0);
        if is_whole.any() {
            let mut sum = way * square;
            for half in halves {
                let (along, own) = (half.dot(way), half.dot(half));
                let bend = F32x8::splat(3.0) * along * along * square.recip() - own;
                sum += (way * bend - half * (along + along)) * F32x8::splat(1.0 / 6.0);
            }
            mean = is_whole.keep(normals.dot(sum) * (square * square.sqrt()).recip());
        }
        Prospect { may_light: normal_part & outward_part, is_whole, mean }
    }

    /// What mirrors see in it.
    #[inline(always)]
    fn seen<S: Simd>(
        &self,
        point: Vec3x8<S>,
        direction: Vec3x8<S>,
        roughness: F32x8<S>,
        lanes: Mask8<S>,
    ) -> Vec3x8<S> {
        let zero = F32x8::splat(0.0);
        let normal = Vec3x8::splat(self.normal);
        let center = Vec3x8::splat(self.center);
        let towards = -direction.dot(normal);
        let distance = (point - center).dot(normal) / towards;
        let met = point + direction * distance - center;
        // Its edges are never sharper than a hair, so that they need few samples.
        let blur = distance * roughness.max(F32x8::splat(0.01)) * F32x8::splat(SQRT_2);
        // Farther off than this beyond the edges there is less than a picture can show.
        let beyond = F32x8::splat(4.0) * blur;
        let [wide, tall] = self.lengths;
        let (wide, tall) = (F32x8::splat(wide), F32x8::splat(tall));
        let across = met.dot(Vec3x8::splat(self.half[0])) / wide;
        let along = met.dot(Vec3x8::splat(self.half[1])) / tall;
        let near = lanes
            & towards.gt(zero)
            & distance.gt(zero)
            & across.abs().le(wide + beyond)
            & along.abs().le(tall + beyond);
        if self.radiance == Vec3::ZERO || !near.any() {
            return Vec3x8::zero();
        }
        let scale = blur.recip();
        let share = filled(wide, across, scale) * filled(tall, along, scale);
        Vec3x8::splat(self.radiance) * near.keep(share)
    }
}

/// Whether all of a rectangle, its middle at the end of `way`, lies above the horizon of `normal`, and whether any
/// of it may.
#[inline(always)]
fn above<S: Simd>(normal: Vec3x8<S>, way: Vec3x8<S>, [a, b]: &[Vec3x8<S>; 2]) -> [Mask8<S>; 2] {
    let (middle, spread) = (normal.dot(way), normal.dot(*a).abs() + normal.dot(*b).abs());
    // Room for rounding: all points of what is whole are above.
    let room = (way.x.abs() + way.y.abs() + way.z.abs()) * F32x8::splat(1e-5);
    [middle.gt(spread + room), middle.gt(-spread - room)]
}

/// How much of a blurred stretch of half the `length` each way is seen at `place`.
#[inline(always)]
fn filled<S: Simd>(length: F32x8<S>, place: F32x8<S>, scale: F32x8<S>) -> F32x8<S> {
    let (low, high) = ((length - place) * scale, (length + place) * scale);
    (math::erf(low) + math::erf(high)) * F32x8::splat(0.5)
}

/// A column's last number, as [`between`] rounds it.
#[inline(always)]
fn last<S: Simd>(column: &[f32]) -> F32x8<S> {
    let [low, high] = [column[column.len() - 2], column[column.len() - 1]];
    F32x8::splat(low + (high - low))
}

/// A column's numbers between those at `index` and at the next one.
#[inline(always)]
fn between<S: Simd>(column: &[f32], index: U32x8<S>, share: F32x8<S>) -> F32x8<S> {
    let low = F32x8::gather(column, index);
    low.lerp(F32x8::gather(column, index + U32x8::splat(1)), share)
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::config::Light;
    use crate::lanes::Plain;

    #[test]
    fn softboxes_are_as_whole_and_as_bright_as_one_by_one() {
        let light = Light {
            position: DVec3::new(14.0, 30.0, 14.0),
            color: DVec3::ONE,
            width: 20.0,
            height: 10.0,
        };
        let softbox = Room::new(&crate::config::Room::default(), &[light], 0.0).softboxes[0];
        let lights = LightBox::new(&softbox);
        let (mut whole, mut part, mut none) = (0, 0, 0);
        for step in 0..2000 {
            let turn = |number: u32| (f64::from(step * number % 1999) / 999.5 - 1.0) * 30.0;
            let point = DVec3::new(turn(7), turn(11).abs(), turn(13));
            let normal = DVec3::new(turn(17), turn(19), turn(23)).normalize_or(DVec3::Y);
            let outward = (normal + DVec3::new(turn(29), turn(31), 9.0) * 0.01).normalize();
            let load = |v: DVec3| Vec3x8::<Plain>::load(&[v; 8]);
            let found = lights.prospect(load(point), load(normal), load(outward));
            let expected = softbox.mean_cosine(point, normal, outward);
            let is_whole = found.is_whole.any();
            // Where it nearly touches the horizon rounding decides.
            match (is_whole, expected) {
                (true, Some(mean)) => {
                    whole += 1;
                    assert!((f64::from(found.mean.store()[0]) - mean).abs() < 1e-5, "{point}");
                }
                (true, None) => panic!("{point}, {normal}: not all of it is above"),
                (false, Some(_)) => part += 1,
                (false, None) => none += 1,
            }
            let corners = [(0.0, 0.0), (0.0, 1.0), (1.0, 0.0), (1.0, 1.0)];
            let ways = corners.map(|pair| softbox.point(pair) - point);
            let lit = ways.iter().any(|way| way.dot(normal) > 0.0 && way.dot(outward) > 0.0);
            assert!(found.may_light.any() || !lit, "{point}, {normal}");
        }
        assert!(whole > 300 && none > 300 && part < 10, "{whole}, {part}, {none}");
    }
}
