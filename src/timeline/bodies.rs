//! How much room pieces and board take, as far as moving needs to know.

use super::pieces::Spot;
use crate::notation::Role;

/// The room that the pieces of a set take, and the board's. Lengths are in squares.
#[derive(Clone, Debug, Default)]
pub struct Bodies {
    /// Of pawn, knight, bishop, rook, queen and king.
    pub envelopes: [Envelope; 6],
    /// From the board's middle to the outer edge of its frame.
    pub edge: f64,
    /// The height of the table, counted from the squares: below 0.
    pub table: f64,
}

impl Bodies {
    /// The room of a piece.
    pub fn of(&self, role: Role) -> &Envelope {
        // Roles are numbered from 1 in this order.
        &self.envelopes[role as usize - 1]
    }

    /// The height of the tallest piece, and of the tallest one that can be captured.
    pub fn tallest(&self) -> [f64; 2] {
        let most = |roles: &[Envelope]| roles.iter().map(Envelope::height).fold(0.0, f64::max);
        [most(&self.envelopes), most(&self.envelopes[..5])]
    }
}

/// The thickness of an envelope's slices.
pub const SLICE: f64 = 1.0 / 32.0;

/// A body of revolution that a piece fits into, whichever way it is turned, as slices of equal thickness. It
/// is measured by rays (`scene::bodies`): what is thinner than a twentieth of a square may stand out.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Envelope {
    radii: Vec<f64>,
    widest: f64,
}

impl Envelope {
    /// An envelope by the radii of its slices, each [`SLICE`] thick, from the foot up.
    pub fn new(radii: Vec<f64>) -> Envelope {
        let widest = radii.iter().copied().fold(0.0, f64::max);
        Envelope { radii, widest }
    }

    /// From the foot to the top.
    pub fn height(&self) -> f64 {
        self.radii.len() as f64 * SLICE
    }

    /// The radius of the widest slice.
    pub fn radius(&self) -> f64 {
        self.widest
    }

    /// How far apart this envelope with its foot on `spot` and an `other` on its own are, seen from above and
    /// at the heights that both have: below 0 where they overlap, infinite where one is above the other.
    pub fn gap(&self, spot: Spot, other: &Envelope, others: Spot) -> f64 {
        let apart = spot.apart(others);
        // Where the foot of the other is, in slices of this one.
        let shift = (others.height - spot.height) / SLICE;
        let mut reach = f64::NEG_INFINITY;
        for (index, radius) in self.radii.iter().enumerate() {
            let from = index as f64 - shift;
            let first = from.floor().max(0.0) as usize;
            let behind = ((from + 1.0).ceil().max(0.0) as usize).min(other.radii.len());
            for others in other.radii.get(first..behind).unwrap_or_default() {
                reach = reach.max(radius + others);
            }
        }
        apart - reach
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(file: f64, height: f64) -> Spot {
        Spot { file, rank: 0.0, height }
    }

    #[test]
    fn gaps_are_those_of_the_heights_that_both_have() {
        // A foot of 4 slices, and a stem of 4 slices on it.
        let man = Envelope::new([vec![0.4; 4], vec![0.1; 4]].concat());
        assert_eq!((man.height(), man.radius()), (8.0 * SLICE, 0.4));
        let cases = [
            (0.0, 0.2),
            // Stem and foot overlap, then only stem and foot's upper edge, then nothing.
            (3.5 * SLICE, 0.2),
            (4.0 * SLICE, 0.5),
            (7.5 * SLICE, 0.5),
            (8.0 * SLICE, f64::INFINITY),
            (-8.0 * SLICE, f64::INFINITY),
            (-4.0 * SLICE, 0.5),
        ];
        for (height, gap) in cases {
            let found = man.gap(at(0.0, height), &man, at(1.0, 0.0));
            assert!((found - gap).abs() < 1e-12 || found == gap, "{height}: {found} is not {gap}");
        }
        assert!(man.gap(at(0.0, 0.0), &man, at(0.5, 0.0)) < 0.0);
    }
}
