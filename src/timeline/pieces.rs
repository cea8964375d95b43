//! Pieces with an identity, on squares and off them.

use super::beside::Beside;
use super::bodies::Bodies;
use crate::game::Game;
use crate::notation::{Piece, Placement, Square};

/// A place on, above or beside the board, in squares: (0, 0) is the middle of a1, files go to the
/// right and ranks away from White; the height counts from the board's surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    pub file: f64,
    pub rank: f64,
    pub height: f64,
}

impl Spot {
    /// The middle of `square`, on the board.
    pub fn on(square: Square) -> Spot {
        let (file, rank) = square.coords();
        Spot { file: f64::from(u32::from(file)), rank: f64::from(u32::from(rank)), height: 0.0 }
    }

    /// How far it is from the board's middle towards the nearest side, seen from above: 4.0 at the edge of
    /// the outer squares.
    pub fn from_middle(self) -> f64 {
        (self.file - 3.5).abs().max((self.rank - 3.5).abs())
    }

    /// How far apart two places are as seen from above.
    pub fn apart(self, other: Spot) -> f64 {
        let (across, away) = (self.file - other.file, self.rank - other.rank);
        (across * across + away * away).sqrt()
    }
}

/// A piece that stands on no square.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mover {
    pub piece: Piece,
    /// The square where the piece stood when the game began.
    pub identity: Square,
    pub spot: Spot,
    /// How large it is, as a share of its own size, above 0 up to 1: a pawn and what it becomes are less
    /// while one gives way to the other.
    pub size: f64,
}

/// Who stands on each square: the square where the piece was when the game began (a promoted
/// pawn's stays the pawn's). It goes with the piece, and so does the grain of its wood.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Identities([Square; 64]);

impl Default for Identities {
    /// Every piece is named for the square where it stands.
    fn default() -> Identities {
        Identities(Square::ALL)
    }
}

impl Identities {
    /// The identity of the piece on `square`; for an empty square it means nothing.
    pub fn get(&self, square: Square) -> Square {
        self.0[square.to_usize()]
    }

    pub(super) fn set(&mut self, square: Square, identity: Square) {
        self.0[square.to_usize()] = identity;
    }
}

/// Pieces at rest.
#[derive(Clone)]
pub struct Position {
    pub placement: Placement,
    pub identities: Identities,
    pub beside: Beside,
}

/// A piece that has left the board, or waits to come there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Taken {
    pub piece: Piece,
    pub identity: Square,
}

impl Position {
    /// The position that a game starts from.
    pub fn new(game: &Game, bodies: &Bodies) -> Position {
        let placement = game.placement(0);
        let beside = match game.in_hand(0) {
            Some(in_hand) => Beside::in_hand(&in_hand, &placement),
            None => Beside::captured(&placement, bodies),
        };
        Position { placement, identities: Identities::default(), beside }
    }
}
