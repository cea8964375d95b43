//! How a move looks while it is under way.

use shakmaty::{CastlingSide, Move};

use super::pieces::{Mover, Position, Spot};
use crate::notation::{Placement, Role, Square};

/// The highest point of a hop, in squares: a king (1.67 squares tall) has room below it where the
/// way crosses other pieces.
const HOP: f64 = 2.0;

/// How far a sliding piece is lifted.
const GLIDE: f64 = 0.05;

/// Where a captured piece leaves the board, in squares: this high, above a knight (1.06 squares tall)
/// in the middle of the hop that takes it, and this far beyond the middles of the outer files, off the
/// frame. No more: pictures have to hold it.
pub const CARRIED: f64 = 3.2;
pub const BESIDE: f64 = 1.6;

/// The paths of one move: who goes where, and what is taken.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    paths: Vec<Path>,
    captured: Option<Square>,
    dropped: Option<Square>,
}

/// The way of one piece.
#[derive(Clone, Debug, PartialEq)]
struct Path {
    from: Square,
    to: Square,
    /// Whether it hops over what stands between.
    hops: bool,
}

impl Motion {
    /// The paths of a legal move.
    pub fn new(played: &Move) -> Motion {
        let (paths, captured, dropped) = match *played {
            Move::Normal { role, from, capture, to, .. } => {
                let hops = role == Role::Knight;
                (vec![Path { from, to, hops }], capture.map(|_| to), None)
            }
            Move::EnPassant { from, to } => {
                let taken = Square::from_coords(to.file(), from.rank());
                (vec![Path { from, to, hops: false }], Some(taken), None)
            }
            // A castling move names the rook's square, not the king's.
            Move::Castle { king, rook } => {
                let side = CastlingSide::from_queen_side(rook < king);
                let to = |file| Square::from_coords(file, king.rank());
                let king_path = Path { from: king, to: to(side.king_to_file()), hops: false };
                let rook_path = Path { from: rook, to: to(side.rook_to_file()), hops: true };
                (vec![king_path, rook_path], None, None)
            }
            Move::Put { to, .. } => (vec![], None, Some(to)),
        };
        Motion {
            paths: paths.into_iter().filter(|path| path.from != path.to).collect(),
            captured,
            dropped,
        }
    }

    /// The position after the move, which has the pieces of `placement`.
    pub fn after(&self, before: &Position, placement: Placement) -> Position {
        let mut identities = before.identities;
        for path in &self.paths {
            identities.set(path.to, before.identities.get(path.from));
        }
        if let Some(square) = self.dropped {
            identities.set(square, square);
        }
        // On an empty square nobody stands: it must not remember who left.
        for square in Square::ALL.into_iter().filter(|square| placement.get(*square).is_none()) {
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
        for path in &self.paths {
            lift(path.from, path.at(passed));
        }
        if let Some(square) = self.captured {
            lift(square, leaving(square, passed));
        }
        (standing, movers)
    }
}

impl Path {
    fn at(&self, passed: f64) -> Spot {
        let (from, to) = (Spot::on(self.from), Spot::on(self.to));
        let along = ease(passed);
        let arc = 4.0 * passed * (1.0 - passed);
        Spot {
            file: mix(from.file, to.file, along),
            rank: mix(from.rank, to.rank, along),
            // A hop rises at once and stays high while it passes over other pieces.
            height: if self.hops { HOP * arc * (2.0 - arc) } else { GLIDE * arc },
        }
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
