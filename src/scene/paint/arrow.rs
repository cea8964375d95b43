//! Arrows: a shaft that bends for a knight, and a head.

use glam::DVec2;

use super::FOOT;

/// Half of the shaft's width.
const HALF_SHAFT: f64 = 0.07;

/// A head's length and half of its width.
const HEAD: f64 = 0.33;
const HALF_HEAD: f64 = 0.19;

/// What remains free round a piece's foot.
const FREE: f64 = 0.05;

/// How far from the middle of an empty square arrows begin and end.
const NEAR: f64 = 0.08;

/// An arrow on the board.
#[derive(Clone, Debug, PartialEq)]
pub struct Arrow {
    /// The middle of the shaft: its beginning, where it bends if it does, and the neck.
    shaft: Vec<DVec2>,
    tip: DVec2,
    /// Of length 1, from the neck to the tip.
    direction: DVec2,
    /// From the neck to the tip.
    head: f64,
}

impl Arrow {
    /// An arrow from the middle of one square to that of another, each with whether a piece stands
    /// there. A knight's goes the long way first.
    pub fn new([(from, is_left), (to, is_taken)]: [(DVec2, bool); 2]) -> Arrow {
        let way = to - from;
        let (wide, tall) = (way.x.abs(), way.y.abs());
        let long = if wide > tall { DVec2::new(way.x, 0.0) } else { DVec2::new(0.0, way.y) };
        let is_knights = wide.min(tall) == 1.0 && wide.max(tall) == 2.0;
        let bend = is_knights.then_some(from + long);
        let first = (bend.unwrap_or(to) - from).normalize_or_zero();
        let direction = (to - bend.unwrap_or(from)).normalize_or_zero();
        let free = |is_occupied| if is_occupied { FOOT + FREE } else { NEAR };
        let tip = to - direction * free(is_taken);
        // The shaft's end is round.
        let begin = from + first * (free(is_left) + HALF_SHAFT);
        // Between pieces on neighbouring squares there is hardly room for a head.
        let head = HEAD.min((tip - bend.unwrap_or(begin)).dot(direction).max(1e-3));
        let neck = tip - direction * head;
        Arrow {
            shaft: [begin].into_iter().chain(bend).chain([neck]).collect(),
            tip,
            direction,
            head,
        }
    }

    /// How far `point` lies outside, negative inside.
    pub fn outside(&self, point: DVec2) -> f64 {
        let legs = self.shaft.windows(2).map(|leg| distance(point, leg[0], leg[1]) - HALF_SHAFT);
        legs.fold(self.outside_head(point), f64::min)
    }

    /// How far `point` lies outside the head, a triangle.
    fn outside_head(&self, point: DVec2) -> f64 {
        let back = (self.tip - point).dot(self.direction);
        let aside = (self.tip - point).perp_dot(self.direction).abs();
        let (place, corner) = (DVec2::new(back, aside), DVec2::new(self.head, HALF_HEAD));
        let side = distance(place, DVec2::ZERO, corner);
        let border = side.min(distance(place, DVec2::new(self.head, 0.0), corner));
        let is_inside = back < self.head && aside * self.head < HALF_HEAD * back;
        if is_inside { -border } else { border }
    }
}

/// The distance of `point` from the stretch between two others.
fn distance(point: DVec2, from: DVec2, to: DVec2) -> f64 {
    let way = to - from;
    let length2 = way.length_squared();
    let share =
        if length2 > 0.0 { ((point - from).dot(way) / length2).clamp(0.0, 1.0) } else { 0.0 };
    point.distance(from + way * share)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether there is any ink within `radius` of `place`.
    fn is_near(arrow: &Arrow, place: DVec2, radius: f64) -> bool {
        arrow.outside(place) < radius
    }

    fn arrow(from: [i32; 2], to: [i32; 2], are_taken: [bool; 2]) -> Arrow {
        let [from, to] = [from, to].map(|[x, y]| DVec2::new(f64::from(x), f64::from(y)));
        Arrow::new([(from, are_taken[0]), (to, are_taken[1])])
    }

    const E2: [i32; 2] = [4, 1];

    /// Far and near, straight, aslant and as knights go.
    const TO: [[i32; 2]; 8] = [[4, 3], [4, 2], [5, 2], [0, 5], [7, 1], [5, 3], [6, 2], [3, 0]];

    #[test]
    fn arrows_keep_clear_of_pieces_and_go_near_the_middles_of_empty_squares() {
        for to in TO {
            for are_taken in [[false, false], [true, false], [false, true], [true, true]] {
                let arrow = arrow(E2, to, are_taken);
                for (square, is_taken) in [E2, to].into_iter().zip(are_taken) {
                    let middle = DVec2::new(f64::from(square[0]), f64::from(square[1]));
                    let case = format!("to {to:?}, {are_taken:?}, {square:?}");
                    if is_taken {
                        assert!(!is_near(&arrow, middle, FOOT + 0.02), "{case}");
                        assert!(is_near(&arrow, middle, FOOT + 0.09), "{case}");
                    } else {
                        assert!(is_near(&arrow, middle, 0.15), "{case}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_head_is_at_the_end_that_is_pointed_to() {
        let arrow = arrow(E2, [4, 5], [true, true]);
        let width = |y: f64| {
            let inked = (0..100)
                .filter(|step| arrow.outside(DVec2::new(4.0 + 0.01 * f64::from(*step), y)) < 0.0);
            inked.count()
        };
        let (shaft, head) = (width(3.0), width(5.0 - FOOT - FREE - HEAD + 0.01));
        assert_eq!((shaft, head), (7, 19));
        assert!(width(5.0 - FOOT - FREE - 0.02) < 3);
    }

    /// g1 to f3 goes by g3, and b1 to d2 by d1.
    #[test]
    fn knights_go_the_long_way_first() {
        let cases = [([6, 0], [5, 2], [6.0, 2.0]), ([1, 0], [3, 1], [3.0, 0.0])];
        for (from, to, bend) in cases {
            let arrow = arrow(from, to, [true, false]);
            assert!(arrow.outside(bend.into()) < 0.0, "{from:?}");
            let halfway = DVec2::new(f64::from(from[0] + to[0]), f64::from(from[1] + to[1])) / 2.0;
            assert!(arrow.outside(halfway) > 0.2, "{from:?}");
        }
        // Nobody else bends.
        let straight = arrow([0, 0], [3, 6], [true, false]);
        assert!(straight.outside(DVec2::new(1.5, 3.0)) < 0.0);
    }
}
