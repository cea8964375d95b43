//! What the clock beside the board shows.

use super::Dials;
use super::film::Moment;
use crate::game::{Clocks, Game};
use crate::notation::Color;

/// The part of the last position's time after which a flag falls.
const FLAGGING: f64 = 0.6;

/// The clock of one game.
pub struct Clock {
    clocks: Clocks,
    first_ply: usize,
    /// Who is to move after each half-move, from the first shown one on, and the number of that move.
    turns: Vec<(Color, u32)>,
    /// The ply after which the game has no more moves.
    end: usize,
}

impl Clock {
    /// The clock of `game` from ply `first` to ply `last`.
    pub fn new(game: &Game, first: usize, last: usize) -> Clock {
        let turn = |ply| (game.turn(ply), game.move_number(ply));
        Clock {
            clocks: game.clocks(),
            first_ply: first,
            turns: (first..=last).map(turn).collect(),
            end: game.plies.len(),
        }
    }

    /// What it shows at a `moment`; `runs` where the times between positions are shown too.
    pub fn dials(&self, moment: Moment, runs: bool) -> Dials {
        let (moves, passed) = match moment {
            Moment::Title => (0, 0.0),
            Moment::Rest { moves, passed } => (moves, if runs { passed } else { 0.0 }),
            // The player has thought, and presses the clock when the move is over.
            Moment::Move { moves, .. } => (moves, 1.0),
            Moment::Result { moves } => (moves, 1.0),
        };
        let ply = self.first_ply + moves;
        let (player, number) = self.turns[moves];
        if !self.clocks.is_known() {
            let made = number.saturating_sub(1);
            return Dials::Moves { made: [made + player.fold_wb(0, 1), made], to_move: player };
        }
        let mut left = self.clocks.left(ply);
        let own = &mut left[player.fold_wb(0, 1)];
        let is_over = ply == self.end;
        let flags = is_over && self.clocks.flag() == Some(player);
        if flags && runs {
            // What was left when this player was to move, down to nothing.
            let before = self.clocks.left(ply.saturating_sub(1))[player.fold_wb(0, 1)];
            *own = before.map(|before| before * (1.0 - passed / FLAGGING).max(0.0));
        } else if let (Some(left), Some(thought)) = (*own, self.clocks.thought(ply + 1)) {
            *own = Some((left - thought * passed).max(0.0));
        }
        // A clock that has not run out yet shows a second.
        let seconds = |left: f64| left.ceil().min(f64::from(u32::MAX)) as u32;
        Dials::Times {
            left: left.map(|left| left.map(seconds)),
            running: (!is_over || flags).then_some(player),
        }
    }
}
