//! Coordinates on the board's frame: along the side near the viewer and the one on his left, upright
//! for him.

use glam::{DVec2, Vec3Swizzles};

use super::Camera;
use super::glyphs::{self, REACH, Stroke};
use super::measures::{FRAME, HALF, MIDDLE, SQUARE};

/// The height of a digit in world units, from middle to middle of its strokes.
pub const SIZE: f64 = 0.39 * FRAME;

/// How far from the squares their middles are: a moulding leaves less than the whole frame flat.
pub const WITHIN: f64 = 0.38 * FRAME;

/// Which height of letters and digits stands in the middle of the frame, in their own unit: the
/// bowls of letters weigh more than their stems and tails.
const LETTERS_MIDDLE: f64 = 0.38;
const DIGITS_MIDDLE: f64 = 0.5;

/// A side of the board.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Beyond rank 1.
    White,
    /// Beyond the h-file.
    Kingside,
    /// Beyond rank 8.
    Black,
    /// Beyond the a-file.
    Queenside,
}

impl Side {
    pub const ALL: [Side; 4] = [Side::White, Side::Kingside, Side::Black, Side::Queenside];

    /// The side that is at the bottom of what `camera` sees.
    pub fn near(camera: &Camera) -> Side {
        let right = camera.axes()[0];
        match (right.x.abs() >= right.z.abs(), right.x + right.z > 0.0) {
            (true, true) => Side::White,
            (false, true) => Side::Kingside,
            (true, false) => Side::Black,
            (false, false) => Side::Queenside,
        }
    }

    /// The side on the left of a viewer who has this one before him.
    fn left(self) -> Side {
        match self {
            Side::White => Side::Queenside,
            Side::Kingside => Side::White,
            Side::Black => Side::Kingside,
            Side::Queenside => Side::Black,
        }
    }

    /// A way on the board, x towards the h-file and y towards rank 8, as a viewer has it who has this
    /// side before him: x to his right, y away from him.
    fn seen(self, way: DVec2) -> DVec2 {
        match self {
            Side::White => way,
            Side::Kingside => DVec2::new(way.y, -way.x),
            Side::Black => -way,
            Side::Queenside => DVec2::new(-way.y, way.x),
        }
    }
}

/// Who reads coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Readers {
    /// The side that the viewer has before him.
    pub near: Side,
    /// Whether another one sits opposite, and reads the other two sides.
    pub both: bool,
}

impl Readers {
    /// The side that he has before him for whom a `side` is labelled.
    fn of(self, side: Side) -> Option<Side> {
        let opposite = self.near.left().left();
        let mut nears = [self.near, opposite].into_iter().take(if self.both { 2 } else { 1 });
        nears.find(|near| side == *near || side == near.left())
    }
}

/// What is written beside a square.
pub struct Label {
    /// Its middle, from the board's.
    middle: DVec2,
    /// The side that its reader has before him.
    near: Side,
    strokes: &'static [Stroke],
    /// Which height of it is in the middle.
    height: f64,
}

impl Label {
    /// The label at the `side` of the board beside a square, 0 to 7, if there is one.
    pub fn new(readers: Readers, side: Side, number: usize) -> Option<Label> {
        let near = readers.of(side)?;
        let beside = (number as f64 + 0.5) * SQUARE - HALF;
        let within = HALF + WITHIN;
        let middle = match side {
            Side::White => DVec2::new(beside, -within),
            Side::Black => DVec2::new(beside, within),
            Side::Kingside => DVec2::new(within, beside),
            Side::Queenside => DVec2::new(-within, beside),
        };
        let (strokes, height) = match side {
            Side::White | Side::Black => (glyphs::letter(number), LETTERS_MIDDLE),
            Side::Kingside | Side::Queenside => (glyphs::digit(number), DIGITS_MIDDLE),
        };
        Some(Label { middle, near, strokes, height })
    }

    /// A place, from the board's middle, as its glyph is drawn.
    pub fn point(&self, place: DVec2) -> DVec2 {
        self.near.seen(place - self.middle) / SIZE + DVec2::Y * self.height
    }

    /// The strokes of its glyph.
    pub fn strokes(&self) -> &'static [Stroke] {
        self.strokes
    }
}

/// How much ink there is at the place (`x`, `z`) of the frame's top, 0 to 1, where a width of `seen` world
/// units is seen at once.
pub fn ink(x: f64, z: f64, readers: Readers, seen: f64) -> f64 {
    let place = DVec2::new(x, z) - MIDDLE.xz();
    // On which side's part of the frame, and how far along.
    let (side, along) = match (place.x.abs() > HALF, place.y.abs() > HALF) {
        (false, true) if place.y < 0.0 => (Side::White, place.x),
        (false, true) => (Side::Black, place.x),
        (true, false) if place.x < 0.0 => (Side::Queenside, place.y),
        (true, false) => (Side::Kingside, place.y),
        _ => return 0.0,
    };
    let number = ((along + HALF) / SQUARE).floor().clamp(0.0, 7.0);
    let Some(label) = Label::new(readers, side, number as usize) else {
        return 0.0;
    };
    let point = label.point(place);
    let [aside, below, above] = REACH;
    let blur = seen / SIZE / 2.0;
    if point.x.abs() > aside + blur || point.y < -below - blur || point.y > above + blur {
        return 0.0;
    }
    let outside = glyphs::outside(label.strokes, point) * SIZE;
    // As if an edge ran straight through what is seen.
    (0.5 - outside / seen.max(f64::MIN_POSITIVE)).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::Pose;
    use glam::DVec3;

    /// How far from the board's middle the labels' middles are.
    const AMID: f64 = HALF + WITHIN;

    /// Whether there is any ink round a point of the frame, given from the board's middle.
    fn is_labelled(readers: Readers, x: f64, z: f64) -> bool {
        let inked = |dx: i32, dz: i32| {
            let at = |from: f64, by: i32| from + 14.0 + 0.05 * f64::from(by);
            ink(at(x, dx), at(z, dz), readers, 0.01) > 0.5
        };
        (-16..=16).any(|dx| (-16..=16).any(|dz| inked(dx, dz)))
    }

    #[test]
    fn the_near_side_and_the_left_one_are_labelled_beside_every_square() {
        let sides = [
            (Side::White, [true, false, false, true]),
            (Side::Kingside, [true, true, false, false]),
            (Side::Black, [false, true, true, false]),
            (Side::Queenside, [false, false, true, true]),
        ];
        for (near, both, labelled) in
            sides.into_iter().flat_map(|(near, one)| [(near, false, one), (near, true, [true; 4])])
        {
            let readers = Readers { near, both };
            for square in 0..8 {
                let along = f64::from(4 * square) - 14.0;
                let places = [(along, -AMID), (AMID, along), (along, AMID), (-AMID, along)];
                let found = places.map(|(x, z)| is_labelled(readers, x, z));
                assert_eq!(found, labelled, "{near:?}, {square}");
            }
            assert!(!is_labelled(readers, -AMID, -AMID), "{near:?}: the corner");
            assert!(!is_labelled(readers, 0.0, 0.0), "{near:?}: the squares");
        }
    }

    /// The stem of b, and the hook of f, tell the way up and the way it is read.
    #[test]
    fn labels_are_upright_for_their_viewer() {
        let stem = DVec2::new(-0.31, 0.9 - LETTERS_MIDDLE) * SIZE;
        for (near, b) in [
            (Side::White, DVec2::new(-10.0, -AMID) + stem),
            (Side::Kingside, DVec2::new(-10.0, -AMID) + DVec2::new(-stem.y, stem.x)),
            (Side::Black, DVec2::new(-10.0, AMID) - stem),
            (Side::Queenside, DVec2::new(-10.0, AMID) + DVec2::new(stem.y, -stem.x)),
        ] {
            let readers = Readers { near, both: false };
            assert!(ink(b.x + 14.0, b.y + 14.0, readers, 0.01) == 1.0, "{near:?}");
        }
    }

    #[test]
    fn ink_fades_over_what_is_seen_at_once() {
        // The stem of h: its middle, its edge, and beside it.
        let across = |x: f64, seen| {
            let h = DVec2::new(28.0, 14.0 - AMID) + DVec2::new(-0.28, 0.9 - LETTERS_MIDDLE) * SIZE;
            ink(h.x + x, h.y, Readers { near: Side::White, both: false }, seen)
        };
        let edge = glyphs::PEN * SIZE;
        assert_eq!([0.0, -edge - 0.1].map(|x| across(x, 0.02)), [1.0, 0.0]);
        assert!((across(-edge, 0.02) - 0.5).abs() < 1e-9);
        assert!(across(-edge - 0.1, 0.4) > 0.0 && across(0.0, 0.4) < 1.0);
    }

    #[test]
    fn the_near_side_is_the_one_below_in_the_picture() {
        for (x, z, near) in [
            (14.0, -40.0, Side::White),
            (34.0, -30.0, Side::White),
            (60.0, 10.0, Side::Kingside),
            (10.0, 60.0, Side::Black),
            (-60.0, 20.0, Side::Queenside),
            (14.0, 14.0, Side::White),
        ] {
            let camera =
                Camera::free(&Pose { position: DVec3::new(x, 30.0, z), ..Pose::default() });
            assert_eq!(Side::near(&camera), near, "{x}, {z}");
        }
    }
}
