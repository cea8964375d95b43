//! The chess clock: a case, and a painted face with two dials whose hands show a time.

use std::sync::Arc;

use glam::{DAffine3, DVec2, DVec3};
use image::RgbImage;

use super::materials::{MaterialError, Materials};
use super::measures::{DEPTH, MIDDLE};
use super::{Mapping, Material, Object, Surface, Texture};
use crate::assets::Bitmap;
use crate::config::{self, Clock, Coat, Finish};
use crate::geometry::transform::{sin_cos, translation};
use crate::geometry::{Bounds, Cuboid};

/// The case where it was made: on the table, on the side of the a-file.
const CASE: Cuboid = Cuboid {
    min: DVec3::new(-10.5, -DEPTH, MIDDLE.z - 6.0),
    max: DVec3::new(-7.5, 5.2, MIDDLE.z + 6.0),
};

/// What the face leaves free at its edges, and how far it stands out, in world units.
const RIM: f64 = 0.45;
const THICKNESS: f64 = 0.02;

/// Texels a world unit of the face.
const TEXELS: f64 = 64.0;

const FACE: DVec3 = DVec3::new(0.32, 0.24, 0.17);
const DIAL: DVec3 = DVec3::new(0.95, 0.93, 0.86);
const RING: DVec3 = DVec3::new(0.72, 0.6, 0.32);
const INK: DVec3 = DVec3::new(0.08, 0.07, 0.07);
const RED: DVec3 = DVec3::new(0.75, 0.1, 0.08);

/// The way from where the clock was made to where it stands for a camera that looks along `forward`:
/// beside the a-file, or half a turn about the board's middle from there, such that its face is seen.
pub fn place(forward: DVec3) -> DAffine3 {
    if forward.x > 1e-9 {
        let half_turn = DAffine3::from_scale(DVec3::new(-1.0, 1.0, -1.0));
        translation(MIDDLE) * half_turn * translation(-MIDDLE)
    } else {
        DAffine3::IDENTITY
    }
}

/// The case and its face, which looks over the board, at a [`place`]; White's dial is on White's side.
pub fn clock(
    clock: &Clock,
    materials: &Materials,
    place: DAffine3,
) -> Result<[Object; 2], MaterialError> {
    let finish = Finish {
        ambient: 0.45,
        diffuse: 0.55,
        specular: 0.2,
        shininess: 80.0,
        reflectivity: 0.0,
        transparency: 0.0,
    };
    let plate = Cuboid {
        min: DVec3::new(CASE.max.x, CASE.min.y + RIM, CASE.min.z + RIM),
        max: DVec3::new(CASE.max.x + THICKNESS, CASE.max.y - RIM, CASE.max.z - RIM),
    };
    let size = plate.max - plate.min;
    // From in front of it, looking along −x, z lies to the right.
    let filter = materials.config.render.filter;
    let times = [clock.white, clock.black];
    let is_turned = place != DAffine3::IDENTITY;
    let times = if is_turned { [times[1], times[0]] } else { times };
    let face = face(size.z, size.y, times);
    let texture = Texture::Bitmap {
        bitmap: Arc::new(Bitmap::new(face, filter)),
        mapping: Mapping {
            kind: config::Mapping::Planar,
            origin: plate.min,
            u: DVec3::Z * size.z,
            v: DVec3::Y * size.y,
        },
        filter,
        linear: materials.is_linear(),
    };
    let case = materials.surface(&clock.case)?;
    let face = Surface::Uniform(Material { finish, coat: Coat::default(), texture });
    Ok([(CASE, case), (plate, face)]
        .map(|(solid, surface)| Object::placed(Arc::new(solid), place, surface)))
}

/// What the clock fills at a [`place`].
pub fn bounds(place: &DAffine3) -> Bounds {
    Bounds { min: CASE.min, max: CASE.max + DVec3::X * THICKNESS }.transformed(place)
}

/// Paints a face of `width` × `height` world units with a dial for each of two times, which are in
/// seconds since twelve o'clock.
fn face(width: f64, height: f64, times: [u32; 2]) -> RgbImage {
    let dials = [0.25, 0.75].into_iter().zip(times).map(|(share, seconds)| Dial {
        middle: DVec2::new(share * width, height / 2.0),
        radius: 0.44 * height.min(width / 2.0),
        hands: hands(seconds),
    });
    let dials: Vec<Dial> = dials.collect();
    let texels = |length: f64| (length * TEXELS) as u32;
    RgbImage::from_fn(texels(width), texels(height), |x, y| {
        let at = (DVec2::new(f64::from(x), f64::from(y)) + 0.5) / TEXELS;
        let point = DVec2::new(at.x, height - at.y);
        let color = dials.iter().fold(FACE, |color, dial| dial.paint(point, color));
        image::Rgb(color.to_array().map(|channel| (channel * 255.0 + 0.5) as u8))
    })
}

/// Where the hour, minute and second hands point, in degrees clockwise from twelve.
fn hands(seconds: u32) -> [f64; 3] {
    let seconds = f64::from(seconds % 43_200);
    [seconds / 120.0, seconds / 10.0 % 360.0, seconds * 6.0 % 360.0]
}

/// A round dial; lengths in world units.
struct Dial {
    middle: DVec2,
    radius: f64,
    hands: [f64; 3],
}

impl Dial {
    /// The colour at `point` (y upwards) where there was `color` before.
    fn paint(&self, point: DVec2, color: DVec3) -> DVec3 {
        let from_middle = (point - self.middle) / self.radius;
        let distance = from_middle.length();
        if distance > 1.2 {
            return color;
        }
        let paint = |color: DVec3, with: DVec3, outside: f64| {
            // How much of the texel is covered.
            let cover = (0.5 - outside * self.radius * TEXELS).clamp(0.0, 1.0);
            color.lerp(with, cover)
        };
        let mut color = paint(color, RING, distance - 1.0);
        color = paint(color, DIAL, distance - 0.92);
        // The nearest of the minutes' marks; every fifth is an hour's.
        let degrees = libm::atan2(from_middle.x, from_middle.y).to_degrees();
        let minute = (degrees / 6.0 + 0.5).floor();
        let is_hour = minute.rem_euclid(5.0) == 0.0;
        let (inner, half_width) = if is_hour { (0.72, 0.022) } else { (0.82, 0.008) };
        color = paint(color, INK, stroke(from_middle, minute * 6.0, inner, 0.86, half_width));
        let [hour, minute, second] = self.hands;
        color = paint(color, INK, stroke(from_middle, hour, -0.12, 0.48, 0.04));
        color = paint(color, INK, stroke(from_middle, minute, -0.12, 0.74, 0.028));
        color = paint(color, RED, stroke(from_middle, second, -0.16, 0.8, 0.01));
        paint(color, INK, distance - 0.055)
    }
}

/// How far `point` lies outside a stroke with round ends, which points `degrees` clockwise from
/// straight up and goes from the distance `from` to the distance `to`.
fn stroke(point: DVec2, degrees: f64, from: f64, to: f64, half_width: f64) -> f64 {
    let (sin, cos) = sin_cos(degrees);
    let direction = DVec2::new(sin, cos);
    let along = point.dot(direction).clamp(from, to);
    point.distance(direction * along) - half_width
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hands_point_where_clocks_have_them() {
        for (time, expected) in [
            ((0, 0, 0), [0.0, 0.0, 0.0]),
            ((3, 0, 0), [90.0, 0.0, 0.0]),
            ((1, 30, 15), [45.125, 181.5, 90.0]),
            ((13, 0, 0), [30.0, 0.0, 0.0]),
        ] {
            let (hours, minutes, seconds) = time;
            for (found, expected) in
                hands(3600 * hours + 60 * minutes + seconds).into_iter().zip(expected)
            {
                assert!((found - expected).abs() < 1e-9, "{time:?}: {found} is not {expected}");
            }
        }
    }

    #[test]
    fn whites_dial_is_the_left_one_and_shows_its_time() {
        let picture = face(8.0, 4.0, [3 * 3600, 0]);
        let (width, height) = picture.dimensions();
        // Towards three o'clock, at a third of the radius, only the left dial has a hand.
        let ink_at = |share: f64| {
            let x = (share * f64::from(width) + 0.44 * f64::from(height) / 3.0) as u32;
            picture.get_pixel(x, height / 2).0.iter().all(|channel| *channel < 60)
        };
        assert_eq!([0.25, 0.75].map(ink_at), [true, false]);
    }
}
