//! What is round the board in the studio: softboxes and a sky, linear light.

use std::f64::consts::{PI, SQRT_2, TAU};

use glam::DVec3;

use super::Rgb;
use super::measures::MIDDLE;
use crate::config::{self, Light};
use crate::geometry::transform::rotation_y;

/// Softboxes, and a sky that grows brighter upwards.
#[derive(Clone, Debug, PartialEq)]
pub struct Room {
    pub softboxes: Vec<Softbox>,
    /// Share of the light that surfaces throw at each other, 0 to 1.
    pub bounce: f64,
    /// From the horizon, from 30° above it, and from straight above.
    pub sky: [Rgb; 3],
    /// By the upward part of a normal, from −1 to 1 in equal steps.
    pub daylight: Vec<Daylight>,
}

/// A rectangle that faces the board's middle and lights everything alike, near or far. Only
/// mirrors see it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Softbox {
    /// What it gives a surface that faces it, as a share of what is then seen on white.
    pub color: Rgb,
    pub center: DVec3,
    /// Along its sides, each as long as half of one.
    pub half: [DVec3; 2],
    pub normal: DVec3,
    /// What a mirror sees in it.
    pub radiance: Rgb,
}

/// Softboxes whose distance's square is more than so many times the sum of the squares of half their sides are seen so
/// small that [`Softbox::mean_cosine`] errs by less than a thousandth or so.
pub const NARROW: f64 = 8.0;

/// What the sky gives a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Daylight {
    /// Mean brightness of the part of the sky that the surface faces, by the cosine.
    pub brightness: Rgb,
    /// Share of the light from all that it faces that the sky has, 0 to 1; the rest is below the
    /// horizon.
    pub share: f64,
}

/// Steps of the table of daylight.
const STEPS: usize = 64;

impl Room {
    /// The room of `settings` with softboxes for `lights`, which are given as seen from White's side
    /// and turned by `degrees` about the board's middle.
    pub fn new(settings: &config::Room, lights: &[Light], degrees: f64) -> Room {
        let sky = [settings.horizon, settings.sky, settings.zenith];
        let daylight = (0..=STEPS).map(|step| {
            let upward = 2.0 * step as f64 / STEPS as f64 - 1.0;
            Daylight::new(&sky, upward)
        });
        Room {
            softboxes: lights.iter().map(|light| Softbox::new(light, degrees)).collect(),
            bounce: settings.bounce,
            daylight: daylight.collect(),
            sky,
        }
    }

    /// What the sky gives a surface with `normal`.
    pub fn daylight(&self, normal: DVec3) -> Daylight {
        let place = (normal.y.clamp(-1.0, 1.0) + 1.0) / 2.0 * STEPS as f64;
        let index = (place as usize).min(STEPS - 1);
        let (low, high, share) =
            (self.daylight[index], self.daylight[index + 1], place - index as f64);
        Daylight {
            brightness: low.brightness.lerp(high.brightness, share),
            share: low.share + (high.share - low.share) * share,
        }
    }

    /// What a mirror at `point` sees along `direction` (of length 1) when nothing stands in the
    /// way, blurred as by a `roughness` of 0 to 1.
    pub fn radiance(&self, point: DVec3, direction: DVec3, roughness: f64) -> Rgb {
        let seen =
            |softbox: &Softbox| softbox.radiance * softbox.cover(point, direction, roughness);
        self.softboxes.iter().map(seen).fold(sky(&self.sky, direction.y), |sum, seen| sum + seen)
    }
}

impl Softbox {
    fn new(light: &Light, degrees: f64) -> Softbox {
        let turn = rotation_y(degrees);
        let center = MIDDLE + turn.transform_vector3(light.position - MIDDLE);
        let normal = (MIDDLE - center).normalize_or(DVec3::NEG_Y);
        let level = DVec3::Y.cross(normal).normalize_or(DVec3::X);
        let area = light.width * light.height;
        let gathered = if area > 0.0 { PI * center.distance_squared(MIDDLE) / area } else { 0.0 };
        Softbox {
            color: light.color,
            center,
            half: [level * (light.width / 2.0), normal.cross(level) * (light.height / 2.0)],
            normal,
            radiance: light.color * gathered,
        }
    }

    /// The point of it at (`across`, `along`), each 0 to 1.
    pub fn point(&self, (across, along): (f64, f64)) -> DVec3 {
        self.center + self.half[0] * (2.0 * across - 1.0) + self.half[1] * (2.0 * along - 1.0)
    }

    /// The mean cosine, between `normal` and the ways from `point` to all points of it; `None` where not all of it is
    /// above the horizon, by the normal or by that of the surface itself (`outward`), or where it is too near.
    ///
    /// The mean of v / |v| over v ± a ± b is, by Taylor's series up to the third order, v / |v| and a sixth of
    /// its second derivatives along a and b.
    pub fn mean_cosine(&self, point: DVec3, normal: DVec3, outward: DVec3) -> Option<f64> {
        let way = self.center - point;
        let spread = |normal: DVec3| self.half.map(|half| normal.dot(half).abs()).iter().sum();
        let is_above = |normal: DVec3| normal.dot(way) > spread(normal);
        let square = way.length_squared();
        let size = self.half[0].length_squared() + self.half[1].length_squared();
        if !is_above(normal) || !is_above(outward) || square <= NARROW * size {
            return None;
        }
        let bent = |half: &DVec3| {
            let along = half.dot(way);
            let bend = 3.0 * along * along / square - half.length_squared();
            (way * bend - *half * (2.0 * along)) / 6.0
        };
        let sum = self.half.iter().map(bent).fold(way * square, |sum, bent| sum + bent);
        Some(normal.dot(sum) / (square * square.sqrt()))
    }

    /// How much of a mirror's view along `direction` it fills.
    fn cover(&self, point: DVec3, direction: DVec3, roughness: f64) -> f64 {
        let towards = -direction.dot(self.normal);
        if towards <= 0.0 || self.radiance == Rgb::ZERO {
            return 0.0;
        }
        let distance = (point - self.center).dot(self.normal) / towards;
        let met = point + direction * distance - self.center;
        // Its edges are never sharper than a hair, so that they need few samples.
        let blur = distance * roughness.max(0.01) * SQRT_2;
        let filled = |half: DVec3| {
            let length = half.length();
            let place = met.dot(half) / length;
            // Farther off there is less than a picture can show.
            if place.abs() > length + 4.0 * blur {
                return 0.0;
            }
            (libm::erf((length - place) / blur) + libm::erf((length + place) / blur)) / 2.0
        };
        if distance <= 0.0 { 0.0 } else { filled(self.half[0]) * filled(self.half[1]) }
    }
}

/// The sky in a direction with the upward part `upward`, −1 to 1.
fn sky([horizon, middle, zenith]: &[Rgb; 3], upward: f64) -> Rgb {
    if upward < 0.0 {
        *horizon * (1.0 + upward)
    } else if upward < 0.5 {
        horizon.lerp(*middle, 2.0 * upward)
    } else {
        middle.lerp(*zenith, 2.0 * upward - 1.0)
    }
}

impl Daylight {
    /// By summing over the half of all directions that a normal with the upward part `upward` faces.
    fn new(colors: &[Rgb; 3], upward: f64) -> Daylight {
        const RINGS: usize = 48;
        let normal = DVec3::new((1.0 - upward * upward).max(0.0).sqrt(), upward, 0.0);
        let around: [(f64, f64); RINGS] =
            std::array::from_fn(|step| libm::sincos((step as f64 + 0.5) / RINGS as f64 * TAU));
        let (mut light, mut above, mut all) = (Rgb::ZERO, 0.0, 0.0);
        for ring in 0..2 * RINGS {
            // Rings of equal height have equal areas.
            let y = (ring as f64 + 0.5) / RINGS as f64 - 1.0;
            let radius = (1.0 - y * y).sqrt();
            for (sin, cos) in around {
                let cosine = normal.dot(DVec3::new(radius * cos, y, radius * sin)).max(0.0);
                all += cosine;
                if y > 0.0 {
                    above += cosine;
                    light += sky(colors, y) * cosine;
                }
            }
        }
        let brightness = if above > 0.0 { light / above } else { colors[0] };
        Daylight { brightness, share: above / all }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn room() -> Room {
        let light = Light {
            position: MIDDLE + DVec3::Y * 60.0,
            color: DVec3::ONE,
            width: 20.0,
            height: 10.0,
        };
        Room::new(&config::Room::default(), &[light], 0.0)
    }

    #[test]
    fn a_surface_that_faces_up_has_all_of_the_sky_and_one_that_faces_down_none() {
        let room = room();
        for (normal, share) in [(DVec3::Y, 1.0), (DVec3::X, 0.5), (DVec3::NEG_Y, 0.0)] {
            assert!((room.daylight(normal).share - share).abs() < 0.02, "{normal}");
        }
    }

    #[test]
    fn the_mean_cosine_is_that_of_many_points() {
        let softbox = room().softboxes[0];
        let turned = DVec3::new(0.6, 0.8, 0.0);
        for (point, normal) in [
            (DVec3::ZERO, DVec3::Y),
            (MIDDLE, DVec3::Y),
            (DVec3::new(40.0, 3.0, -20.0), DVec3::Y),
            (DVec3::new(5.0, 20.0, 9.0), turned),
        ] {
            const STEPS: u32 = 200;
            let place = |step: u32| (f64::from(step) + 0.5) / f64::from(STEPS);
            let pairs = (0..STEPS).flat_map(|a| (0..STEPS).map(move |b| (place(a), place(b))));
            let cosine = |pair| normal.dot((softbox.point(pair) - point).normalize());
            let exact = pairs.map(cosine).sum::<f64>() / f64::from(STEPS * STEPS);
            let found = softbox.mean_cosine(point, normal, normal).unwrap();
            assert!((found / exact - 1.0).abs() < 1e-3, "{found} instead of {exact} at {point}");
        }
        for (point, normal, outward) in [
            (MIDDLE, DVec3::NEG_Y, DVec3::Y),
            (MIDDLE, DVec3::Y, DVec3::X),
            (MIDDLE + DVec3::Y * 40.0, DVec3::Y, DVec3::Y),
        ] {
            assert_eq!(softbox.mean_cosine(point, normal, outward), None);
        }
    }

    /// What a softbox gives a surface is what all mirrors there would see of it, by their cosines.
    #[test]
    fn a_softbox_is_as_bright_in_a_mirror_as_its_light_says() {
        let mut room = room();
        room.sky = [Rgb::ZERO; 3];
        for roughness in [0.0, 0.1] {
            let mut sum = 0.0;
            let steps = 400;
            for (x, z) in (0..steps).flat_map(|x| (0..steps).map(move |z| (x, z))) {
                let side = |step: i32| 2.0 * (f64::from(step) + 0.5) / f64::from(steps) - 1.0;
                let direction = DVec3::new(side(x), 1.0, side(z));
                let cosine = 1.0 / direction.length();
                let solid_angle = cosine * cosine * cosine * 4.0 / f64::from(steps * steps);
                let seen = room.radiance(MIDDLE, direction.normalize(), roughness).x;
                sum += seen * cosine * solid_angle / PI;
            }
            assert!((sum - 1.0).abs() < 0.05, "{roughness}: {sum}");
        }
    }
}
