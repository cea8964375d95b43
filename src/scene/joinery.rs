//! The wood of a board: which piece of it is where, and how its grain goes.

use glam::DVec3;

use super::measures::{FRAME, HALF, MIDDLE, SQUARE};
use super::noise::hash;
use super::{Material, Place};

/// How wide the inlay between squares and frame is.
const INLAY: f64 = 0.16;

/// What the parts of a moulded board are made of: each square and each side of the frame from a
/// piece of its own.
#[derive(Clone, Debug)]
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
        let cut = |part: u64, middle: DVec3, turned: bool| {
            let DVec3 { x, y, z } = place.point - middle;
            let point = if turned { DVec3::new(-z, y, x) } else { DVec3::new(x, y, z) };
            Place { point, seed: hash(place.seed, part), ..place }
        };
        let from_middle = place.point - MIDDLE;
        let (dx, dz) = (from_middle.x.abs(), from_middle.z.abs());
        let beyond = dx.max(dz) - HALF;
        if beyond >= 0.0 {
            // The grain of mouldings goes along them; they meet in mitres.
            let along_x = dz > dx;
            let side = if along_x { from_middle.z } else { from_middle.x };
            let part = 64 + 2 * u64::from(along_x) + u64::from(side > 0.0);
            let axis = if along_x { DVec3::Z } else { DVec3::X };
            let middle = MIDDLE + axis * (HALF + FRAME / 2.0) * side.signum();
            return (
                if beyond < self.inlay_width() { inlay } else { frame },
                cut(part, middle, along_x),
            );
        }
        let cell = (place.point / SQUARE + 0.5).floor();
        let (file, rank) = (cell.x as u64, cell.z as u64);
        let is_dark = (file + rank) % 2 == 0;
        let middle = DVec3::new(cell.x, 0.0, cell.z) * SQUARE;
        // The dark squares' grain goes across the light squares'.
        (if is_dark { dark } else { light }, cut(8 * rank + file, middle, is_dark))
    }
}
