//! Whose turn it is, moves as scores number them, and how a game ended.

use shakmaty::{Color, Position};

use super::Game;

/// An end that the rules of chess make.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    Checkmate,
    Stalemate,
    /// Neither player has the pieces to mate.
    InsufficientMaterial,
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

    /// What the rules say of the last position, if they end the game there.
    pub fn ending(&self) -> Option<Ending> {
        let last = &self.plies.last()?.after;
        if last.is_checkmate() {
            Some(Ending::Checkmate)
        } else if last.is_stalemate() {
            Some(Ending::Stalemate)
        } else {
            last.is_insufficient_material().then_some(Ending::InsufficientMaterial)
        }
    }
}
