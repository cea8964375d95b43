//! Where captured pieces and pieces in hand stand: beside the board, at the right hand of the player who took
//! or has them, from his end of the board on, in columns.

use super::bodies::Bodies;
use super::pieces::{Spot, Taken};
use crate::notation::{Color, Placement, Role};

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
    /// The empty tray of the pieces of `color`, with so many columns.
    fn new(bodies: &Bodies, color: Color, columns: u32) -> Tray<'_> {
        Tray { bodies, columns, color, column: 0, filled: 0.0 }
    }

    /// The place of the next piece.
    fn next(&mut self, role: Role) -> Spot {
        let radius = self.bodies.of(role).radius();
        // What comes behind all that a player has at first, promoted pieces, makes the last column longer.
        if self.filled + 2.0 * radius > length(self.bodies) && self.column + 1 < self.columns {
            (self.column, self.filled) = (self.column + 1, 0.0);
        }
        let along = self.filled + radius - self.bodies.edge;
        self.filled += 2.0 * radius + APART;
        at_hand(self.color.other(), self.column, along, self.bodies)
    }
}

/// A place at the right hand of `player`: so far along the board's side, from its middle away from him.
fn at_hand(player: Color, column: u32, along: f64, bodies: &Bodies) -> Spot {
    let beside = bodies.edge + GAP + (f64::from(column) + 0.5) * width(bodies);
    let side = player.fold_wb(1.0, -1.0);
    Spot { file: 3.5 + side * beside, rank: 3.5 + side * along, height: bodies.table }
}

/// Each of the `taken` pieces and where it stands, on so many columns a player.
pub fn places(taken: &[Taken], columns: u32, bodies: &Bodies) -> Vec<(Taken, Spot)> {
    let mut trays = Color::ALL.map(|color| Tray::new(bodies, color, columns));
    let mut place = |taken: &Taken| trays[taken.piece.color.fold_wb(0, 1)].next(taken.piece.role);
    taken.iter().map(|taken| (*taken, place(taken))).collect()
}

/// Place number `index`, from 0, of what `player` has in hand. Each place has room for any piece.
pub fn place_in_hand(index: usize, player: Color, bodies: &Bodies) -> Spot {
    let fit = in_a_column(bodies);
    let along = (index % fit) as f64 * (2.0 * widest(bodies) + APART) + widest(bodies);
    at_hand(player, (index / fit) as u32, along - bodies.edge, bodies)
}

/// How many pieces in hand find place in a column, whatever they are.
fn in_a_column(bodies: &Bodies) -> usize {
    let each = 2.0 * widest(bodies) + APART;
    // Without bodies all places are the same one.
    ((length(bodies) + APART) / each).max(1.0) as usize
}

/// The columns for so many pieces in hand, at least one.
pub fn columns_in_hand(pieces: usize, bodies: &Bodies) -> u32 {
    pieces.div_ceil(in_a_column(bodies)).max(1) as u32
}

/// A column's length in squares.
fn length(bodies: &Bodies) -> f64 {
    2.0 * bodies.edge + BEYOND
}

/// A column's width in squares.
fn width(bodies: &Bodies) -> f64 {
    2.0 * widest(bodies) + GAP
}

/// The greatest radius of a piece that can be captured in standard chess.
fn widest(bodies: &Bodies) -> f64 {
    bodies.envelopes[..5].iter().map(|envelope| envelope.radius()).fold(0.0, f64::max)
}

/// The columns that all these pieces of a player take.
fn columns(army: impl IntoIterator<Item = Role>, bodies: &Bodies) -> u32 {
    let mut tray = Tray::new(bodies, Color::White, u32::MAX);
    for role in army {
        tray.next(role);
    }
    tray.column + 1
}

/// The columns that either player's pieces of `start` take, and at least those of standard chess.
pub fn columns_for(start: &Placement, bodies: &Bodies) -> u32 {
    let army = |color| {
        let all = start.iter().map(|(_, piece)| piece).filter(move |piece| piece.color == color);
        let mut roles: Vec<Role> =
            all.map(|piece| piece.role).filter(|role| *role != Role::King).collect();
        roles.sort_unstable_by(|one, other| other.cmp(one));
        columns(roles, bodies)
    };
    Color::ALL.map(army).into_iter().fold(columns(ARMY, bodies), u32::max)
}

/// How far the places of all pieces that a player has at first reach from the board's middle, in squares: to
/// the side, and along the board; with at least so many `columns`.
pub fn reach(bodies: &Bodies, at_least: u32) -> [f64; 2] {
    let columns = f64::from(columns(ARMY, bodies).max(at_least));
    [bodies.edge + GAP + columns * width(bodies), bodies.edge + BEYOND]
}
