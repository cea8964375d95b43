//! Whose turn it is, moves as scores number them, and how a game ended.

use shakmaty::variant::Variant;
use shakmaty::{Color, KnownOutcome, Outcome, Position};

use super::Game;

/// An end that the rules make.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    Checkmate,
    Stalemate,
    /// Neither player has the pieces to mate.
    InsufficientMaterial,
    /// Atomic: a king was blown up.
    Explosion,
    /// Antichess: who is to move has no pieces, or none that can move, and has won.
    NothingToMove,
    /// Three-check: the third one.
    ThirdCheck,
    /// King of the hill: a king has reached the middle.
    Hill,
    /// Racing kings: a king has reached the last rank, and the other one cannot follow.
    Goal,
    /// Racing kings: both have reached it, and nobody has won.
    BothAtGoal,
    /// Horde: none of it is left.
    HordeTaken,
}

impl Ending {
    /// Whether somebody has won.
    pub fn is_decisive(self) -> bool {
        !matches!(self, Ending::Stalemate | Ending::InsufficientMaterial | Ending::BothAtGoal)
    }
}

impl Game {
    /// Who is to move after `ply` half-moves; `ply` is at most `plies.len()`.
    pub fn turn(&self, ply: usize) -> Color {
        ply.checked_sub(1).map_or(self.start.turn, |index| self.plies[index].after.turn())
    }

    /// The number of the move that comes after `ply` half-moves.
    pub fn move_number(&self, ply: usize) -> u32 {
        let counted = ply.checked_sub(1).map(|index| self.plies[index].after.fullmoves());
        counted.unwrap_or(self.start.fullmoves).get()
    }

    /// The move that led to the position after `ply` half-moves, with its number: `17. Rd8#`,
    /// `16… Nf6`; none leads to the start.
    pub fn numbered_san(&self, ply: usize) -> Option<String> {
        let ply = self.plies.get(ply.checked_sub(1)?)?;
        let dots = ply.mover().fold_wb(".", "…");
        Some(format!("{}{dots} {}", ply.number(), ply.san))
    }

    /// How many checks White and Black have given up to `ply`, where the rules count them.
    pub fn checks_given(&self, ply: usize) -> Option<[u32; 2]> {
        let position = self.position(ply)?;
        let left = position.remaining_checks()?;
        Some([left.white, left.black].map(|left| 3_u32.saturating_sub(u32::from(left))))
    }

    /// What the rules say of the last position, if they end the game there.
    pub fn ending(&self) -> Option<Ending> {
        let last = &self.plies.last()?.after;
        match last.variant_outcome() {
            Outcome::Known(outcome) => Some(match self.variant {
                Variant::Atomic => Ending::Explosion,
                Variant::Antichess => Ending::NothingToMove,
                Variant::ThreeCheck => Ending::ThirdCheck,
                Variant::KingOfTheHill => Ending::Hill,
                Variant::RacingKings if outcome == KnownOutcome::Draw => Ending::BothAtGoal,
                Variant::RacingKings => Ending::Goal,
                Variant::Horde => Ending::HordeTaken,
                // They have no ends of their own.
                Variant::Chess | Variant::Crazyhouse => return None,
            }),
            Outcome::Unknown if last.is_checkmate() => Some(Ending::Checkmate),
            Outcome::Unknown if last.is_stalemate() => Some(Ending::Stalemate),
            Outcome::Unknown => {
                last.is_insufficient_material().then_some(Ending::InsufficientMaterial)
            }
        }
    }

    /// Who has won, if the rules end the game at its last position with a winner.
    pub fn winner(&self) -> Option<Color> {
        self.plies.last()?.after.outcome().winner()
    }
}
