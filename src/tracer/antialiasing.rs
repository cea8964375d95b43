//! Where in a pixel rays go through.

use crate::scene::Rgb;

/// How many rays a pixel gets, and where.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Antialiasing {
    /// One, through the middle (the thesis's mode 0).
    None,
    /// N × N, through the middles of as many equal parts (the thesis's mode 1); N from 1 up.
    Grid(u32),
}

impl Antialiasing {
    /// Rays along one side of a pixel.
    pub fn rays_per_side(self) -> u32 {
        match self {
            Antialiasing::None => 1,
            Antialiasing::Grid(side) => side,
        }
    }

    /// The mean of `sample(dx, dy)` over the places of the pixel, each 0 to 1 from its top left.
    pub(super) fn mean(self, mut sample: impl FnMut(f64, f64) -> Rgb) -> Rgb {
        let side = self.rays_per_side();
        let place = |index: u32| (f64::from(index) + 0.5) / f64::from(side);
        let mut sum = Rgb::ZERO;
        for row in 0..side {
            for column in 0..side {
                sum += sample(place(column), place(row));
            }
        }
        sum / f64::from(side * side)
    }
}
