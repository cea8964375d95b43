//! Where captured pieces stand: beside the board, at the right hand of the player who took them, from
//! his end of the board on, in columns.

use super::bodies::Bodies;
use super::pieces::{Mover, Spot, Taken};
use crate::notation::{Color, Role};

/// Between the board's frame and a column, and between columns, in squares.
const GAP: f64 = 0.1;

/// Between two pieces of a column, in squares.
const APART: f64 = 0.06;

/// How far a column reaches beyond the board at its other end, in squares: so that all that a player can
/// lose finds room in one.
const BEYOND: f64 = 0.5;

/// All of a player's pieces that can be captured.
const ARMY: [Role; 15] = [
    Role::Queen,
    Role::Rook,
    Role::Rook,
    Role::Bishop,
    Role::Bishop,
    Role::Knight,
    Role::Knight,
    Role::Pawn,
    Role::Pawn,
    Role::Pawn,
    Role::Pawn,
    Role::Pawn,
    Role::Pawn,
    Role::Pawn,
    Role::Pawn,
];

/// The places of one player's captured pieces, one after the other.
struct Tray<'a> {
    bodies: &'a Bodies,
    /// How many there are.
    columns: u32,
    /// Whose pieces they are.
    color: Color,
    column: u32,
    /// How far the column is filled, in squares from its beginning.
    filled: f64,
}

impl Tray<'_> {
    /// The empty tray of the pieces of `color`.
    fn new(bodies: &Bodies, color: Color) -> Tray<'_> {
        Tray { columns: columns(bodies), ..Tray::endless(bodies, color) }
    }

    /// One with as many columns as it takes.
    fn endless(bodies: &Bodies, color: Color) -> Tray<'_> {
        Tray { bodies, columns: u32::MAX, color, column: 0, filled: 0.0 }
    }

    /// The place of the next piece.
    fn next(&mut self, role: Role) -> Spot {
        let radius = self.bodies.of(role).radius();
        let length = 2.0 * self.bodies.edge + BEYOND;
        // What comes behind all that a player has at first, promoted pieces, makes the last column longer.
        if self.filled + 2.0 * radius > length && self.column + 1 < self.columns {
            (self.column, self.filled) = (self.column + 1, 0.0);
        }
        let along = self.filled + radius - self.bodies.edge;
        self.filled += 2.0 * radius + APART;
        let beside = self.bodies.edge + GAP + (f64::from(self.column) + 0.5) * width(self.bodies);
        // As the player has it who took the piece: his right, and away from him.
        let side = self.color.fold_wb(-1.0, 1.0);
        Spot { file: 3.5 + side * beside, rank: 3.5 + side * along, height: self.bodies.table }
    }
}

/// Where each of the `taken` pieces stands.
pub fn places<'a>(
    taken: &'a [Taken],
    bodies: &'a Bodies,
) -> impl Iterator<Item = (&'a Taken, Spot)> + 'a {
    let mut trays = Color::ALL.map(|color| Tray::new(bodies, color));
    taken
        .iter()
        .map(move |taken| (taken, trays[taken.piece.color.fold_wb(0, 1)].next(taken.piece.role)))
}

/// The `taken` pieces on their places.
pub fn movers(taken: &[Taken], bodies: &Bodies) -> Vec<Mover> {
    let stand = |(Taken { piece, identity }, spot): (&Taken, Spot)| Mover {
        piece: *piece,
        identity: *identity,
        spot,
        size: 1.0,
    };
    places(taken, bodies).map(stand).collect()
}

/// A column's width in squares.
fn width(bodies: &Bodies) -> f64 {
    2.0 * bodies.envelopes[..5].iter().map(|envelope| envelope.radius()).fold(0.0, f64::max) + GAP
}

/// The columns that all pieces take which a player has at first.
fn columns(bodies: &Bodies) -> u32 {
    let mut tray = Tray::endless(bodies, Color::White);
    for role in ARMY {
        tray.next(role);
    }
    tray.column + 1
}

/// How far the places of all pieces that a player has at first reach from the board's middle, in squares: to
/// the side, and along the board.
pub fn reach(bodies: &Bodies) -> [f64; 2] {
    let columns = f64::from(columns(bodies));
    [bodies.edge + GAP + columns * width(bodies), bodies.edge + BEYOND]
}
