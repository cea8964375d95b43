//! The letters and digits of coordinates: a to h, 1 to 8, drawn with a round pen.
//!
//! A capital or digit is 1 high, from the middle of its lowest stroke to that of its highest; small
//! letters have bowls of 0.62, stems up to 1 and a tail that hangs below 0. Each is drawn about the
//! upright through its middle. x goes to the right, y up.

use glam::DVec2;

use crate::geometry::transform::sin_cos;

/// Half of the pen's width.
pub const PEN: f64 = 0.07;

/// How far ink reaches from (0, 0) at most, to the sides, downwards and upwards.
pub const REACH: [f64; 3] = [0.31 + PEN, 0.34 + PEN, 1.0 + PEN];

/// One stroke of the pen.
#[derive(Clone, Copy)]
pub enum Stroke {
    /// From one point straight to another.
    Line(DVec2, DVec2),
    /// About a centre with a radius, between two angles in degrees, anticlockwise from the right.
    Arc(DVec2, f64, [f64; 2]),
}

const fn line(from: [f64; 2], to: [f64; 2]) -> Stroke {
    Stroke::Line(DVec2::from_array(from), DVec2::from_array(to))
}

const fn arc(center: [f64; 2], radius: f64, degrees: [f64; 2]) -> Stroke {
    Stroke::Arc(DVec2::from_array(center), radius, degrees)
}

/// The round of a small letter, and the lower one of 6.
const BOWL: Stroke = arc([0.0, 0.31], 0.31, [0.0, 360.0]);

const LETTERS: [&[Stroke]; 8] = [
    &[BOWL, line([0.31, 0.0], [0.31, 0.62])],
    &[BOWL, line([-0.31, 0.0], [-0.31, 1.0])],
    &[arc([0.04, 0.31], 0.31, [48.0, 312.0])],
    &[BOWL, line([0.31, 0.0], [0.31, 1.0])],
    &[arc([0.0, 0.31], 0.31, [0.0, 318.0]), line([-0.31, 0.31], [0.31, 0.31])],
    &[
        arc([0.14, 0.79], 0.21, [55.0, 180.0]),
        line([-0.07, 0.79], [-0.07, 0.0]),
        line([-0.26, 0.62], [0.19, 0.62]),
    ],
    &[BOWL, line([0.31, 0.62], [0.31, -0.03]), arc([0.0, -0.03], 0.31, [215.0, 360.0])],
    &[
        line([-0.28, 0.0], [-0.28, 1.0]),
        arc([0.0, 0.34], 0.28, [0.0, 180.0]),
        line([0.28, 0.34], [0.28, 0.0]),
    ],
];

const DIGITS: [&[Stroke]; 8] = [
    &[line([0.08, 0.0], [0.08, 1.0]), line([0.08, 1.0], [-0.17, 0.8])],
    &[
        arc([0.0, 0.7], 0.3, [-45.0, 170.0]),
        line([0.212, 0.488], [-0.276, 0.0]),
        line([-0.276, 0.0], [0.3, 0.0]),
    ],
    &[arc([0.0, 0.76], 0.24, [-90.0, 150.0]), arc([0.0, 0.26], 0.26, [-145.0, 90.0])],
    &[
        line([0.13, 0.0], [0.13, 1.0]),
        line([0.13, 1.0], [-0.31, 0.27]),
        line([-0.31, 0.27], [0.31, 0.27]),
    ],
    &[
        line([0.24, 1.0], [-0.19, 1.0]),
        line([-0.19, 1.0], [-0.237, 0.509]),
        arc([0.0, 0.31], 0.31, [-140.0, 140.0]),
    ],
    &[BOWL, line([0.15, 1.0], [-0.243, 0.502])],
    &[line([-0.29, 1.0], [0.29, 1.0]), line([0.29, 1.0], [-0.11, 0.0])],
    &[arc([0.0, 0.765], 0.235, [0.0, 360.0]), arc([0.0, 0.265], 0.265, [0.0, 360.0])],
];

/// The strokes of a file's letter, 0 (a) to 7 (h).
pub fn letter(file: usize) -> &'static [Stroke] {
    LETTERS[file]
}

/// The strokes of a rank's digit, 0 (1) to 7 (8).
pub fn digit(rank: usize) -> &'static [Stroke] {
    DIGITS[rank]
}

/// How far `point` lies outside the ink of `strokes`: the distance from the nearest one's middle, less half of
/// the pen's width.
pub fn outside(strokes: &[Stroke], point: DVec2) -> f64 {
    let distances = strokes.iter().map(|stroke| stroke.distance(point));
    distances.fold(f64::INFINITY, f64::min) - PEN
}

impl Stroke {
    /// How far `point` lies from the stroke's middle.
    fn distance(self, point: DVec2) -> f64 {
        match self {
            Stroke::Line(from, to) => {
                let along = to - from;
                let share = (point - from).dot(along) / along.length_squared();
                point.distance(from + along * share.clamp(0.0, 1.0))
            }
            Stroke::Arc(center, radius, [from, to]) => {
                let aside = point - center;
                let angle = libm::atan2(aside.y, aside.x).to_degrees();
                if (angle - from).rem_euclid(360.0) <= to - from {
                    return (aside.length() - radius).abs();
                }
                let end = |degrees| {
                    let (sin, cos) = sin_cos(degrees);
                    aside.distance(DVec2::new(cos, sin) * radius)
                };
                end(from).min(end(to))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is inked of a glyph, on a grid of `COLUMNS` × `ROWS` points over its whole reach.
    fn raster(glyph: impl Fn(DVec2) -> f64) -> Vec<bool> {
        let [aside, below, above] = REACH;
        let at = |low: f64, high: f64, index: usize, of: usize| {
            low + (high - low) * (index as f64 + 0.5) / of as f64
        };
        let cells = (0..ROWS).flat_map(|row| (0..COLUMNS).map(move |column| (column, row)));
        let point = |(column, row)| {
            DVec2::new(at(-aside, aside, column, COLUMNS), at(above, -below, row, ROWS))
        };
        cells.map(|cell| glyph(point(cell)) < 0.0).collect()
    }

    const COLUMNS: usize = 12;
    const ROWS: usize = 23;

    #[test]
    fn ink_stays_within_its_reach() {
        let [aside, below, above] = REACH;
        for index in 0..8 {
            for step in 0..400 {
                let part = f64::from(step) / 399.0;
                let x = -aside + 2.0 * aside * part;
                let y = -below + (above + below) * part;
                let border = [
                    DVec2::new(x, above),
                    DVec2::new(x, -below),
                    DVec2::new(-aside, y),
                    DVec2::new(aside, y),
                ];
                for point in border {
                    let outside = outside(letter(index), point).min(outside(digit(index), point));
                    assert!(outside > -1e-3, "{index} at {point}: {outside}");
                }
            }
        }
    }

    #[test]
    fn every_glyph_is_another_one_and_most_of_its_place_is_free() {
        let letters = (0..8).map(|file| raster(|point| outside(letter(file), point)));
        let digits = (0..8).map(|rank| raster(|point| outside(digit(rank), point)));
        let glyphs: Vec<Vec<bool>> = letters.chain(digits).collect();
        for (index, glyph) in glyphs.iter().enumerate() {
            let inked = glyph.iter().filter(|inked| **inked).count();
            assert!((25..110).contains(&inked), "{index}: {inked} of {}", glyph.len());
            for other in &glyphs[..index] {
                let apart = glyph.iter().zip(other).filter(|(a, b)| a != b).count();
                assert!(apart >= 10, "{index}: {apart}");
            }
        }
    }

    /// As somebody saw them who looked: their tall and hanging parts.
    #[test]
    fn stems_stand_and_tails_hang_where_they_should() {
        let is_inked = |file, x, y| outside(letter(file), DVec2::new(x, y)) < 0.0;
        let left_stem: Vec<usize> = (0..8).filter(|file| is_inked(*file, -0.3, 0.9)).collect();
        let right_stem: Vec<usize> = (0..8).filter(|file| is_inked(*file, 0.3, 0.9)).collect();
        let tail: Vec<usize> = (0..8).filter(|file| is_inked(*file, 0.0, -0.34)).collect();
        assert_eq!((left_stem, right_stem, tail), (vec![1, 7], vec![3], vec![6]));
    }
}
