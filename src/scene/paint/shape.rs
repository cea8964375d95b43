//! Flat shapes, and how much of what is seen at once they cover.

use glam::DVec2;

use super::FOOT;
use super::arrow::Arrow;

/// A shape on the board; those of one square keep within it.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A whole square.
    Square {
        middle: DVec2,
    },
    /// A band inside a square: its outer border is `to` from the middle.
    Frame {
        middle: DVec2,
        to: f64,
        width: f64,
    },
    /// Strong round a piece's foot, and faint in the corners of the square.
    Glow {
        middle: DVec2,
    },
    /// Strokes along the diagonals, outside a piece's foot.
    Cross {
        middle: DVec2,
    },
    Disc {
        middle: DVec2,
        radius: f64,
    },
    Ring {
        middle: DVec2,
        radius: f64,
        width: f64,
    },
    Arrow(Arrow),
    /// Another one, and what is nearer to it than so much.
    Grown(Box<Shape>, f64),
}

/// Where the strokes of a cross begin and end along each side's direction, and half their width.
const CROSS: [f64; 2] = [0.32, 0.425];
const CROSS_HALF_WIDTH: f64 = 0.035;

/// How strong a glow is at the foot, and at the corners.
const GLOW: [f64; 2] = [1.0, 0.12];

impl Shape {
    /// How much of a width of `seen` about `point` it covers, 0 to 1, as if its edge ran straight
    /// through.
    pub fn cover(&self, point: DVec2, seen: f64) -> f64 {
        let inside = (0.5 - self.outside(point) / seen.max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        match self {
            // Its border is the square's own, as sharp as that.
            Shape::Square { middle } => f64::from(is_on(*middle, point)),
            Shape::Frame { middle, .. } => {
                if is_on(*middle, point) {
                    inside
                } else {
                    0.0
                }
            }
            Shape::Glow { middle } if is_on(*middle, point) => {
                let [strong, faint] = GLOW;
                let corner = 0.5 * std::f64::consts::SQRT_2;
                let t = ((point.distance(*middle) - FOOT) / (corner - FOOT)).clamp(0.0, 1.0);
                strong + (faint - strong) * t * (2.0 - t)
            }
            Shape::Glow { .. } => 0.0,
            _ => inside,
        }
    }

    /// Whether any of it may be nearer to `point` than `distance`.
    pub fn reaches(&self, point: DVec2, distance: f64) -> bool {
        match self {
            Shape::Square { middle }
            | Shape::Frame { middle, .. }
            | Shape::Glow { middle }
            | Shape::Cross { middle }
            | Shape::Disc { middle, .. }
            | Shape::Ring { middle, .. } => is_on(*middle, point),
            Shape::Arrow(_) => self.outside(point) <= distance,
            Shape::Grown(shape, by) => shape.reaches(point, distance + by),
        }
    }

    /// How far `point` lies outside, negative inside.
    fn outside(&self, point: DVec2) -> f64 {
        let from = |middle: &DVec2| (point - middle).abs();
        match self {
            Shape::Square { middle } | Shape::Glow { middle } => from(middle).max_element() - 0.5,
            Shape::Frame { middle, to, width } => {
                let half = width / 2.0;
                (from(middle).max_element() - (to - half)).abs() - half
            }
            Shape::Cross { middle } => {
                let aside = from(middle);
                let [begin, end] = CROSS;
                let along = ((aside.x + aside.y) / 2.0).clamp(begin, end);
                aside.distance(DVec2::splat(along)) - CROSS_HALF_WIDTH
            }
            Shape::Disc { middle, radius } => point.distance(*middle) - radius,
            Shape::Ring { middle, radius, width } => {
                (point.distance(*middle) - radius).abs() - width / 2.0
            }
            Shape::Arrow(arrow) => arrow.outside(point),
            Shape::Grown(shape, by) => shape.outside(point) - by,
        }
    }
}

/// Whether `point` lies on the square round `middle`.
fn is_on(middle: DVec2, point: DVec2) -> bool {
    (point + 0.5).floor() == middle
}

#[cfg(test)]
mod tests {
    use super::*;

    const E4: DVec2 = DVec2::new(4.0, 3.0);

    fn shapes() -> [Shape; 6] {
        let middle = E4;
        [
            Shape::Square { middle },
            Shape::Frame { middle, to: 0.455, width: 0.028 },
            Shape::Glow { middle },
            Shape::Cross { middle },
            Shape::Disc { middle, radius: 0.435 },
            Shape::Ring { middle, radius: 0.435, width: 0.08 },
        ]
    }

    #[test]
    fn shapes_of_a_square_keep_within_it() {
        for shape in shapes() {
            for step in 0..100 {
                let along = f64::from(step) / 50.0 - 1.0;
                for beyond in [[0.501, along], [-0.501, along], [along, 0.501], [along, -0.501]] {
                    let place = E4 + DVec2::from(beyond);
                    assert_eq!(shape.cover(place, 1e-3), 0.0, "{shape:?} at {place}");
                }
            }
        }
    }

    #[test]
    fn what_is_round_a_king_is_seen_outside_his_foot() {
        let [square, frame, glow, cross, disc, ring] =
            shapes().map(|shape| move |x: f64, y: f64| shape.cover(E4 + DVec2::new(x, y), 1e-3));
        for (x, y) in [(FOOT + 0.03, 0.0), (0.0, -FOOT - 0.03), (0.28, 0.28)] {
            assert!(glow(x, y) > 0.7 && square(x, y) == 1.0, "{x}, {y}");
        }
        assert!(glow(0.49, 0.49) < 0.3, "it fades");
        assert_eq!([cross(0.38, 0.38), cross(0.38, -0.38), cross(0.4, 0.0)], [1.0, 1.0, 0.0]);
        assert_eq!([ring(0.435, 0.0), ring(FOOT, 0.0), ring(0.49, 0.0)], [1.0, 0.0, 0.0]);
        assert_eq!([disc(0.1, 0.1), disc(0.4, 0.4)], [1.0, 0.0]);
        assert_eq!([frame(0.44, 0.1), frame(0.3, 0.1)], [1.0, 0.0]);
    }

    #[test]
    fn edges_fade_over_what_is_seen_at_once() {
        let ring = Shape::Ring { middle: E4, radius: 0.435, width: 0.08 };
        let edge = E4 + DVec2::X * 0.395;
        assert!((ring.cover(edge, 0.02) - 0.5).abs() < 1e-9);
        assert!((ring.cover(edge + DVec2::X * 0.01, 0.04) - 0.75).abs() < 1e-9);
    }
}
