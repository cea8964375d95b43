//! How a move looks while it is under way.

use shakmaty::{CastlingSide, Move};

use super::pieces::{Mover, Position, Spot};
use crate::notation::{Placement, Role, Square};

/// The highest point of a hop, in squares: a king (1.67 squares tall) has room below it.
const HOP: f64 = 2.0;

/// How far a sliding piece is lifted.
const GLIDE: f64 = 0.05;

/// Where a captured piece leaves the board: this high, and this far beyond the edge.
const CARRIED: f64 = 2.2;
const BESIDE: f64 = 2.0;

/// The paths of one move: who goes where, and what is taken.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// From, to, and whether the piece hops over what stands between.
    paths: Vec<(Square, Square, bool)>,
    captured: Option<Square>,
    dropped: Option<Square>,
}

impl Motion {
    /// The paths of a legal move.
    pub fn new(played: &Move) -> Motion {
        let (paths, captured, dropped) = match *played {
            Move::Normal { role, from, capture, to, .. } => {
                let hops = role == Role::Knight;
                (vec![(from, to, hops)], capture.map(|_| to), None)
            }
            Move::EnPassant { from, to } => {
                let taken = Square::from_coords(to.file(), from.rank());
                (vec![(from, to, false)], Some(taken), None)
            }
            // A castling move names the rook's square, not the king's.
            Move::Castle { king, rook } => {
                let side = CastlingSide::from_queen_side(rook < king);
                let to = |file| Square::from_coords(file, king.rank());
                let king_path = (king, to(side.king_to_file()), false);
                let rook_path = (rook, to(side.rook_to_file()), true);
                (vec![king_path, rook_path], None, None)
            }
            Move::Put { to, .. } => (vec![], None, Some(to)),
        };
        Motion {
            paths: paths.into_iter().filter(|(from, to, _)| from != to).collect(),
            captured,
            dropped,
        }
    }

    /// The position after the move, which has the pieces of `placement`.
    pub fn after(&self, before: &Position, placement: Placement) -> Position {
        let mut identities = before.identities;
        for &(from, to, _) in &self.paths {
            identities.set(to, before.identities.get(from));
        }
        if let Some(square) = self.dropped {
            identities.set(square, square);
        }
        Position { placement, identities }
    }

    /// What stands and what moves when the part `passed` (0 to 1) of the move's time is over.
    pub fn under_way(&self, before: &Position, passed: f64) -> (Placement, Vec<Mover>) {
        let mut standing = before.placement;
        let mut movers = Vec::new();
        let mut lift = |square: Square, spot: Spot| {
            if let Some(piece) = before.placement.get(square) {
                standing.set(square, None);
                movers.push(Mover { piece, identity: before.identities.get(square), spot });
            }
        };
        for &(from, to, hops) in &self.paths {
            lift(from, on_the_way(from, to, hops, passed));
        }
        if let Some(square) = self.captured {
            lift(square, leaving(square, passed));
        }
        (standing, movers)
    }
}

fn on_the_way(from: Square, to: Square, hops: bool, passed: f64) -> Spot {
    let (from, to) = (Spot::on(from), Spot::on(to));
    let along = ease(passed);
    let arc = 4.0 * passed * (1.0 - passed);
    Spot {
        file: mix(from.file, to.file, along),
        rank: mix(from.rank, to.rank, along),
        // A hop rises at once and stays high while it passes over other pieces.
        height: if hops { HOP * arc * (2.0 - arc) } else { GLIDE * arc },
    }
}

/// Up first, then over the nearer edge.
fn leaving(square: Square, passed: f64) -> Spot {
    let on = Spot::on(square);
    let beside = if on.file < 3.5 { -BESIDE } else { 7.0 + BESIDE };
    Spot {
        file: mix(on.file, beside, ease(2.0 * passed - 1.0)),
        rank: on.rank,
        height: CARRIED * ease(2.0 * passed),
    }
}

/// From 0 to 1 with a gentle beginning and end.
fn ease(t: f64) -> f64 {
    let t = t.clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

fn mix(a: f64, b: f64, t: f64) -> f64 {
    a + (b - a) * t
}
