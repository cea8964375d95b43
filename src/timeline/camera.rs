//! What the camera does while a game goes on.

use super::Gaze;
use super::film::{Moment, Schedule};
use super::flight::{ease, mix};
use super::motion::Motion;
use super::path::{Path, PathError};
use super::pieces::Spot;
use crate::config::KeyFrame;
use crate::game::Game;
use crate::notation::Color;

/// The part of a pause in which the camera goes round to the player who is to move.
const TURNING: f64 = 0.8;

/// How the camera moves.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Camerawork {
    /// How far it turns about the board, in degrees, positive anticlockwise as seen from above.
    pub orbit: f64,
    /// Whether it turns so far with each move, instead of over the whole game.
    pub each_move: bool,
    pub lead: Lead,
}

/// What the camera follows.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Lead {
    #[default]
    Nothing,
    /// It goes to the side of the player who is to move, by so many degrees from White's to Black's.
    Mover { turn: f64 },
    /// It leans towards the piece that moves.
    Piece,
    /// Key frames, in their order.
    Path(Vec<KeyFrame>),
}

/// What the camera does in one game, with all that it follows.
#[derive(Clone, Debug)]
pub struct Track {
    orbit: f64,
    each_move: bool,
    lead: LeadTrack,
}

#[derive(Clone, Debug)]
enum LeadTrack {
    Nothing,
    /// Who moves first, and the turn to Black's side.
    Mover(Color, f64),
    /// Where each move goes, in squares from the board's middle.
    Piece(Vec<[f64; 2]>),
    Path(Path),
}

impl Track {
    /// What `work` means in `game` from ply `first` to ply `last`, at the times of `schedule`.
    ///
    /// # Errors
    /// A path that cannot be taken.
    pub fn new(
        work: &Camerawork,
        game: &Game,
        [first, last]: [usize; 2],
        schedule: &Schedule,
    ) -> Result<Track, PathError> {
        let lead = match &work.lead {
            Lead::Nothing => LeadTrack::Nothing,
            Lead::Mover { turn } => LeadTrack::Mover(game.turn(first), *turn),
            Lead::Piece => {
                let target = |ply: usize| {
                    let to = Motion::new(game, ply + 1).target();
                    to.map(Spot::on).map_or([0.0, 0.0], |spot| [spot.file - 3.5, spot.rank - 3.5])
                };
                LeadTrack::Piece((first..last).map(target).collect())
            }
            Lead::Path(keys) => LeadTrack::Path(Path::new(keys, game, first, schedule)?),
        };
        Ok(Track { orbit: work.orbit, each_move: work.each_move, lead })
    }

    /// Where the camera is at a `moment`: at `time` in seconds, when the share `whole` (0 to 1) of all
    /// frames is over.
    pub fn gaze(&self, moment: Moment, time: f64, whole: f64) -> Gaze {
        let moves = match moment {
            Moment::Title => 0.0,
            Moment::Rest { moves, .. } | Moment::Result { moves } => moves as f64,
            Moment::Move { moves, passed } => moves as f64 + ease(passed),
        };
        let orbit = self.orbit * if self.each_move { moves } else { whole };
        let still = Gaze { orbit, ..Gaze::default() };
        match &self.lead {
            LeadTrack::Nothing => still,
            LeadTrack::Mover(first, turn) => {
                // It turns while the position stands, and is there before the next move.
                let turned = match moment {
                    Moment::Rest { moves: moves @ 1.., passed } => {
                        (moves - 1) as f64 + ease(passed / TURNING)
                    }
                    Moment::Move { moves, .. } => moves as f64,
                    _ => moves,
                };
                Gaze { orbit: orbit + turn * to_mover(*first, turned), ..still }
            }
            LeadTrack::Piece(targets) => Gaze { lean: leaning(targets, moves), ..still },
            LeadTrack::Path(path) => Gaze { pose: Some(path.pose(time)), ..still },
        }
    }
}

/// How far the camera has turned from White's side to Black's, 0 to 1, when so many half-moves are over
/// since `first` was to move: there and back the same way.
fn to_mover(first: Color, turned: f64) -> f64 {
    let from_white = turned + first.fold_wb(0.0, 1.0);
    1.0 - (from_white.rem_euclid(2.0) - 1.0).abs()
}

/// The point between the squares that the last moves went to.
fn leaning(targets: &[[f64; 2]], moves: f64) -> [f64; 2] {
    let target = |moves: usize| match moves.checked_sub(1) {
        None => [0.0, 0.0],
        Some(index) => targets.get(index).or(targets.last()).copied().unwrap_or_default(),
    };
    let whole = moves.floor();
    let [a, b] = [target(whole as usize), target(whole as usize + 1)];
    [0, 1].map(|axis| mix(a[axis], b[axis], moves - whole))
}
