//! What a move does: who goes where, who is taken, what becomes of a pawn.

use shakmaty::{CastlingSide, Move};

use super::pieces::{Position, Taken};
use crate::notation::{Placement, Role, Square};

/// The steps of one move.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// At most two: castling moves the king and, behind it here, the rook. Who stays is left out.
    pub steps: Vec<Step>,
    pub captured: Option<Square>,
    pub dropped: Option<Square>,
}

/// One piece's step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    pub from: Square,
    pub to: Square,
    /// Whether it hops over what stands between.
    pub hops: bool,
    /// What a pawn becomes.
    pub becomes: Option<Role>,
}

impl Motion {
    /// The steps of a legal move.
    pub fn new(played: &Move) -> Motion {
        let step = |from, to, hops| Step { from, to, hops, becomes: None };
        let (steps, captured, dropped) = match *played {
            Move::Normal { role, from, capture, to, promotion } => {
                let step = Step { becomes: promotion, ..step(from, to, role == Role::Knight) };
                (vec![step], capture.map(|_| to), None)
            }
            Move::EnPassant { from, to } => {
                let taken = Square::from_coords(to.file(), from.rank());
                (vec![step(from, to, false)], Some(taken), None)
            }
            // A castling move names the rook's square, not the king's.
            Move::Castle { king, rook } => {
                let side = CastlingSide::from_queen_side(rook < king);
                let to = |file| Square::from_coords(file, king.rank());
                let king_step = step(king, to(side.king_to_file()), false);
                let rook_step = step(rook, to(side.rook_to_file()), true);
                (vec![king_step, rook_step], None, None)
            }
            Move::Put { to, .. } => (vec![], None, Some(to)),
        };
        let steps = steps.into_iter().filter(|step| step.from != step.to).collect();
        Motion { steps, captured, dropped }
    }

    /// The position after the move, which has the pieces of `placement`.
    pub fn after(&self, before: &Position, placement: Placement) -> Position {
        let mut identities = before.identities;
        for step in &self.steps {
            identities.set(step.to, before.identities.get(step.from));
        }
        if let Some(square) = self.dropped {
            identities.set(square, square);
        }
        // On an empty square nobody stands: it must not remember who left.
        for square in Square::ALL.into_iter().filter(|square| placement.get(*square).is_none()) {
            identities.set(square, square);
        }
        let mut taken = before.taken.clone();
        if let Some((square, piece)) =
            self.captured.and_then(|square| Some((square, before.placement.get(square)?)))
        {
            taken.push(Taken { piece, identity: before.identities.get(square) });
        }
        Position { placement, identities, taken }
    }
}
