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
        let slope = HALF_HEAD / self.head;
        ((aside - slope * back) / (1.0 + slope * slope).sqrt()).max(back - self.head)
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
