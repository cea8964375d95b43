//! What a move does: who goes where, who is taken, what becomes of a pawn.

use shakmaty::variant::Variant;
use shakmaty::{CastlingSide, Move};

use super::pieces::{Position, Taken};
use crate::game::Game;
use crate::notation::{Piece, Placement, Role, Square};

/// The steps of one move.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Motion {
    /// At most two: castling moves the king and, behind it here, the rook. Who stays is left out.
    pub steps: Vec<Step>,
    pub captured: Option<Captured>,
    pub dropped: Option<Drop>,
    /// Where all stood that a capture blows up, who captures and who is captured among them; then nobody is
    /// `captured`.
    pub exploded: Vec<Square>,
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

/// A piece that is taken off the board.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Captured {
    pub on: Square,
    /// What it becomes in the hand of who took it, where it goes there.
    pub held: Option<Piece>,
}

/// A piece that comes from a hand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drop {
    pub piece: Piece,
    pub to: Square,
}

impl Motion {
    /// The steps of the move of `game` that leads to `ply`, which is at least 1.
    pub fn new(game: &Game, ply: usize) -> Motion {
        let played = &game.plies[ply - 1].played;
        let before = game.placement(ply - 1);
        let (steps, captured) = steps(played);
        let motion = Motion { steps, ..Motion::default() };
        match (captured, played) {
            (Some(_), _) if game.variant == Variant::Atomic => {
                let after = game.placement(ply);
                let gone = before.iter().map(|(square, _)| square);
                Motion { exploded: gone.filter(|at| after.get(*at).is_none()).collect(), ..motion }
            }
            (Some(on), _) => {
                let taken = before.get(on).filter(|_| game.variant == Variant::Crazyhouse);
                let held = taken.map(|taken| {
                    let was_pawn = game.promoted(ply - 1).contains(on);
                    let role = if was_pawn { Role::Pawn } else { taken.role };
                    Piece { color: taken.color.other(), role }
                });
                Motion { captured: Some(Captured { on, held }), ..motion }
            }
            (None, Move::Put { role, to }) => {
                let piece = Piece { color: game.turn(ply - 1), role: *role };
                Motion { dropped: Some(Drop { piece, to: *to }), ..motion }
            }
            (None, _) => motion,
        }
    }

    /// The square that it leads to, a castling's where the king goes.
    pub fn target(&self) -> Option<Square> {
        let step = self.steps.first().map(|step| step.to);
        step.or(self.dropped.map(|drop| drop.to))
    }

    /// The position after the move, which has the pieces of `placement`.
    pub fn after(&self, before: &Position, placement: Placement) -> Position {
        let mut identities = before.identities;
        let mut beside = before.beside.clone();
        for step in &self.steps {
            identities.set(step.to, before.identities.get(step.from));
        }
        if let Some(Drop { piece, to }) = self.dropped {
            let held = before.beside.next(piece);
            identities.set(to, held.map_or(to, |held| held.identity));
            if let Some(held) = held {
                beside.remove(held);
            }
        }
        // On an empty square nobody stands: it must not remember who left.
        for square in Square::ALL.into_iter().filter(|square| placement.get(*square).is_none()) {
            identities.set(square, square);
        }
        if let Some(Captured { on, held }) = self.captured
            && let Some(piece) = held.or(before.placement.get(on))
        {
            beside.add(Taken { piece, identity: before.identities.get(on) });
        }
        Position { placement, identities, beside }
    }
}

/// Who goes where, and where who is captured stood.
fn steps(played: &Move) -> (Vec<Step>, Option<Square>) {
    let step = |from, to, hops| Step { from, to, hops, becomes: None };
    let (mut steps, captured) = match *played {
        Move::Normal { role, from, capture, to, promotion } => {
            let step = Step { becomes: promotion, ..step(from, to, role == Role::Knight) };
            (vec![step], capture.map(|_| to))
        }
        Move::EnPassant { from, to } => {
            let taken = Square::from_coords(to.file(), from.rank());
            (vec![step(from, to, false)], Some(taken))
        }
        // A castling move names the rook's square, not the king's.
        Move::Castle { king, rook } => {
            let side = CastlingSide::from_queen_side(rook < king);
            let to = |file| Square::from_coords(file, king.rank());
            let king_step = step(king, to(side.king_to_file()), false);
            let rook_step = step(rook, to(side.rook_to_file()), true);
            (vec![king_step, rook_step], None)
        }
        Move::Put { .. } => (Vec::new(), None),
    };
    steps.retain(|step| step.from != step.to);
    (steps, captured)
}
