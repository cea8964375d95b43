//! A round dial with three hands and a flag.

use glam::{DVec2, DVec3};

use super::face::{INK, RED, covered};
use super::reading::Reading;
use crate::geometry::transform::sin_cos;

const DIAL: DVec3 = DVec3::new(0.95, 0.93, 0.86);
const RING: DVec3 = DVec3::new(0.72, 0.6, 0.32);

/// What the flag hangs from, right of twelve, how long and half as wide it is, in radii.
const FLAG: DVec2 = DVec2::new(0.12, 0.79);
const FLAG_LENGTH: f64 = 0.28;
const FLAG_HALF_WIDTH: f64 = 0.055;

/// A dial; lengths in world units.
pub struct Dial {
    pub middle: DVec2,
    pub radius: f64,
    /// Where the hour, minute and second hands point, and the flag.
    hands: [DVec2; 3],
    flag: DVec2,
}

impl Dial {
    pub fn new(middle: DVec2, radius: f64, reading: &Reading) -> Dial {
        // It hangs, or is lifted to the right by the minute hand.
        let flag = 180.0 - 90.0 * reading.flag;
        Dial { middle, radius, hands: hands(reading.hands).map(direction), flag: direction(flag) }
    }

    /// The colour at `point` (y upwards) where there was `color` before.
    pub fn paint(&self, point: DVec2, color: DVec3) -> DVec3 {
        let from_middle = (point - self.middle) / self.radius;
        let distance = from_middle.length();
        if distance > 1.1 {
            return color;
        }
        let paint =
            |color: DVec3, with: DVec3, outside: f64| covered(color, with, outside * self.radius);
        let mut color = paint(color, RING, distance - 1.0);
        color = paint(color, DIAL, distance - 0.93);
        color = paint(color, INK, mark(from_middle));
        let [hour, minute, second] = self.hands;
        color = paint(color, INK, stroke(from_middle, hour, -0.12, 0.48, 0.05));
        color = paint(color, INK, stroke(from_middle, minute, -0.12, 0.76, 0.035));
        color = paint(color, RED, stroke(from_middle, second, -0.16, 0.8, 0.012));
        color = paint(color, INK, distance - 0.06);
        paint(color, RED, stroke(from_middle - FLAG, self.flag, 0.0, FLAG_LENGTH, FLAG_HALF_WIDTH))
    }
}

/// Where the hour, minute and second hands point, in degrees clockwise from twelve.
fn hands(seconds: u32) -> [f64; 3] {
    let seconds = f64::from(seconds % 43_200);
    [seconds / 120.0, seconds / 10.0 % 360.0, seconds * 6.0 % 360.0]
}

/// `degrees` clockwise from straight up.
fn direction(degrees: f64) -> DVec2 {
    let (sin, cos) = sin_cos(degrees);
    DVec2::new(sin, cos)
}

/// How far `point` lies outside the nearest of the minutes' marks; every fifth is an hour's.
fn mark(point: DVec2) -> f64 {
    if point.length_squared() < 0.4 {
        return f64::INFINITY;
    }
    let degrees = libm::atan2(point.x, point.y).to_degrees();
    let minute = (degrees / 6.0 + 0.5).floor();
    let is_hour = minute.rem_euclid(5.0) == 0.0;
    let (inner, half_width) = if is_hour { (0.72, 0.026) } else { (0.82, 0.009) };
    stroke(point, direction(minute * 6.0), inner, 0.86, half_width)
}

/// How far `point` lies outside a stroke with round ends along `direction`, which goes from the
/// distance `from` to the distance `to`.
fn stroke(point: DVec2, direction: DVec2, from: f64, to: f64, half_width: f64) -> f64 {
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
    fn the_flag_hangs_or_stands() {
        let red_at = |lift: f64, x: f64, y: f64| {
            let reading = Reading {
                hands: 6 * 3600,
                window: String::new(),
                flag: lift,
                is_out: false,
                is_running: false,
            };
            Dial::new(DVec2::ZERO, 1.0, &reading).paint(DVec2::new(x, y), DVec3::ONE) == RED
        };
        let (below, beside) = ([FLAG.x, FLAG.y - 0.2], [FLAG.x + 0.2, FLAG.y]);
        assert!(red_at(0.0, below[0], below[1]) && !red_at(0.0, beside[0], beside[1]));
        assert!(!red_at(1.0, below[0], below[1]) && red_at(1.0, beside[0], beside[1]));
    }
}
