//! What comments and glyphs say of a position.

use crate::notation::{Arrow, Circle};

/// What is said of the position after a move, or of the start.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Notes {
    /// Seconds left on the clock of the player who has just moved (`[%clk 1:02:03]`).
    pub clock: Option<f64>,
    /// Seconds that the move took (`[%emt 0:00:09]`).
    pub elapsed: Option<f64>,
    /// Who stands better (`[%eval 0.17]`).
    pub eval: Option<Eval>,
    /// Squares with a ring (`[%csl Gd5,Ra1]`).
    pub circles: Vec<Circle>,
    /// Arrows (`[%cal Ge2e4]`).
    pub arrows: Vec<Arrow>,
    /// Numeric annotation glyphs (`!` is 1, `?` is 2, …), in the order of the file.
    pub glyphs: Vec<u8>,
}

/// How much better White stands; negative where Black does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Eval {
    /// In pawns.
    Pawns(f64),
    /// Moves to mate (`[%eval #-3]`: Black mates in 3).
    Mate(i32),
}
