//! The wood of a board: which piece of it is where, and how its grain goes.

use glam::DVec3;

use super::measures::{FRAME, HALF, MIDDLE, SQUARE};
use super::noise::hash;
use super::{Material, Place};

/// How wide the inlay between squares and frame is.
const INLAY: f64 = 0.16;

/// What the parts of a moulded board are made of: each square and each side of the frame from a
/// piece of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct Joinery {
    /// Dark squares, light squares, frame, inlay.
    pub materials: [Material; 4],
    has_inlay: bool,
}

impl Joinery {
    pub(super) fn new(materials: [Material; 4], has_inlay: bool) -> Joinery {
        Joinery { materials, has_inlay }
    }

    /// How wide the line between squares and frame is, 0 where there is none.
    pub fn inlay_width(&self) -> f64 {
        if self.has_inlay { INLAY } else { 0.0 }
    }

    /// The material at a place of the world, and the place as the piece of wood has it.
    pub fn material(&self, place: Place) -> (&Material, Place) {
        let [dark, light, frame, inlay] = &self.materials;
        let cut = |part: u64| {
            let Cut { middle, is_turned } = Cut::new(part);
            let DVec3 { x, y, z } = place.point - middle;
            let point = if is_turned { DVec3::new(-z, y, x) } else { DVec3::new(x, y, z) };
            Place { point, seed: hash(place.seed, part), ..place }
        };
        let from_middle = place.point - MIDDLE;
        let (dx, dz) = (from_middle.x.abs(), from_middle.z.abs());
        let beyond = dx.max(dz) - HALF;
        if beyond >= 0.0 {
            // They meet in mitres.
            let along_x = dz > dx;
            let side = if along_x { from_middle.z } else { from_middle.x };
            let part = SQUARES + 2 * u64::from(along_x) + u64::from(side > 0.0);
            return (if beyond < self.inlay_width() { inlay } else { frame }, cut(part));
        }
        let cell = (place.point / SQUARE + 0.5).floor();
        let square = 8 * cell.z as u64 + cell.x as u64;
        (if is_dark(square) { dark } else { light }, cut(square))
    }
}

/// Parts of a board are numbered: first its squares, a1, b1, … h8, then the sides of its frame at a, h, 1 and 8.
pub const SQUARES: u64 = 64;
pub const SIDES: u64 = 4;

/// How a part is cut from its piece of wood.
pub struct Cut {
    pub middle: DVec3,
    /// By a quarter: its grain goes along x.
    pub is_turned: bool,
}

impl Cut {
    pub fn new(part: u64) -> Cut {
        if part < SQUARES {
            let middle = DVec3::new((part % 8) as f64, 0.0, (part / 8) as f64) * SQUARE;
            // The dark squares' grain goes across the light squares'.
            return Cut { middle, is_turned: is_dark(part) };
        }
        // The grain of mouldings goes along them.
        let along_x = part >= SQUARES + 2;
        let axis = if along_x { DVec3::Z } else { DVec3::X };
        let side = if part % 2 == 1 { axis } else { -axis };
        Cut { middle: MIDDLE + side * (HALF + FRAME / 2.0), is_turned: along_x }
    }
}

/// Whether a square is dark, by its number.
pub fn is_dark(square: u64) -> bool {
    (square / 8 + square % 8).is_multiple_of(2)
}
