//! What the board tells of a position: the move that led to it, check, and what somebody drew.

use shakmaty::{CastlingSide, Move, Position};

use super::Marks;
use crate::game::{Game, fen_position};
use crate::notation::Square;

/// The marks of the position after `ply` half-moves, at rest.
pub fn marks(game: &Game, ply: usize) -> Marks {
    let played = ply.checked_sub(1).map(|index| &game.plies[index].played);
    let notes = game.notes(ply);
    Marks {
        last_move: played.map_or(Vec::new(), squares),
        circles: notes.circles.clone(),
        arrows: notes.arrows.clone(),
        ..game.position(ply).map_or(Marks::default(), |position| check(&position))
    }
}

impl Marks {
    /// While the move to a position with these marks is under way: its squares alone.
    pub fn under_way(&self) -> Marks {
        Marks { last_move: self.last_move.clone(), ..Marks::default() }
    }

    /// Those of a position without a game: a check, where the FEN says who is to move and the position
    /// can be played.
    pub fn of_fen(fen: &str) -> Marks {
        let has_turn = fen.split_whitespace().nth(1).is_some();
        let position = fen_position(fen).filter(|_| has_turn);
        position.map_or(Marks::default(), |position| check(&position))
    }
}

fn check(position: &impl Position) -> Marks {
    let king = position.board().king_of(position.turn()).filter(|_| position.is_check());
    // A third check, say, leaves no moves either.
    let is_mate = position.is_checkmate() && !position.is_variant_end();
    Marks { check: king, is_mate, ..Marks::default() }
}

/// The squares that a move leaves and reaches; a single one where nothing comes from another square.
fn squares(played: &Move) -> Vec<Square> {
    match *played {
        Move::Normal { from, to, .. } | Move::EnPassant { from, to } => vec![from, to],
        // A castling move names the rook's square, not where the king goes.
        Move::Castle { king, rook } => {
            let file = CastlingSide::from_queen_side(rook < king).king_to_file();
            let to = Square::from_coords(file, king.rank());
            if to == king { vec![king] } else { vec![king, to] }
        }
        Move::Put { to, .. } => vec![to],
    }
}
