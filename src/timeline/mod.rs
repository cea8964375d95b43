//! From a game to frames: what stands or moves where at a time.
//!
//! A [`Timeline`] gives frame `i` without the ones before it, so that any part of a film can be
//! made alone. Times are seconds from the film's beginning.

mod motion;
mod pieces;
mod shown;

pub use motion::{BESIDE, CARRIED};
pub use pieces::{Identities, Mover, Spot};
pub use shown::{Card, Dials, Gaze, Marks};

use crate::game::Game;
use crate::notation::Placement;

use motion::Motion;
use pieces::Position;

/// Times of a film, in seconds, and its frames a second.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Film {
    pub fps: f64,
    /// How long a move takes.
    pub transition: f64,
    /// How long each position stands, but the first and the last.
    pub pause: f64,
    /// How long the first position stands.
    pub first: f64,
    /// How long the last position stands.
    pub last: f64,
}

impl Default for Film {
    fn default() -> Film {
        Film { fps: 25.0, transition: 0.6, pause: 0.8, first: 1.0, last: 5.0 }
    }
}

impl Film {
    /// The length of a film of so many moves:
    /// first + moves × transition + (moves − 1) × pause + last.
    pub fn length(&self, moves: usize) -> f64 {
        let pauses = moves.saturating_sub(1) as f64;
        self.first + moves as f64 * self.transition + pauses * self.pause + self.last
    }

    /// The number of frames of a film of so many moves, at least 1.
    pub fn frames(&self, moves: usize) -> usize {
        ((self.length(moves) * self.fps).round() as usize).max(1)
    }
}

/// What one picture shows.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Seconds from the film's beginning.
    pub time: f64,
    /// Half-moves from the game's start to the position that is shown, or left by the move under
    /// way.
    pub ply: usize,
    /// Pieces that stand on their squares.
    pub placement: Placement,
    /// Who the standing pieces are.
    pub identities: Identities,
    /// Pieces that stand nowhere: on their way, or leaving the board.
    pub movers: Vec<Mover>,
    /// Captured pieces that stand beside the board, in the order of their capture.
    pub taken: Vec<Mover>,
    pub marks: Marks,
    /// Nothing where there is no clock to be shown.
    pub dials: Option<Dials>,
    pub gaze: Gaze,
    /// Words before or behind the game, over a picture of it.
    pub card: Option<Card>,
}

impl Frame {
    /// A position at rest, of no game: each piece is named for the square where it stands.
    pub fn still(placement: Placement) -> Frame {
        Frame {
            time: 0.0,
            ply: 0,
            placement,
            identities: Identities::default(),
            movers: Vec::new(),
            taken: Vec::new(),
            marks: Marks::default(),
            dials: None,
            gaze: Gaze::default(),
            card: None,
        }
    }

    /// Whether both frames show the same scene, whatever their times and words.
    pub fn shows_the_same(&self, other: &Frame) -> bool {
        let bare = |frame: &Frame| Frame { time: 0.0, ply: 0, card: None, ..frame.clone() };
        bare(self) == bare(other)
    }
}

/// All frames of a game, or of a part of it.
pub struct Timeline {
    positions: Vec<Position>,
    /// The motion from each position to the next.
    motions: Vec<Motion>,
    first_ply: usize,
    film: Option<Film>,
    orbit: f64,
}

impl Timeline {
    /// The positions of `game` from ply `first` to ply `last` (both shown, at most the game's
    /// length): one frame each, or with `film` as a film. The camera turns by `orbit` degrees over
    /// the whole.
    pub fn new(game: &Game, first: usize, last: usize, film: Option<Film>, orbit: f64) -> Timeline {
        let mut position = Position::new(game.placement(0));
        let mut timeline = Timeline {
            positions: Vec::with_capacity(last + 1 - first),
            motions: Vec::with_capacity(last - first),
            first_ply: first,
            film,
            orbit,
        };
        for ply in 0..=last {
            if ply > 0 {
                let motion = Motion::new(&game.plies[ply - 1].played);
                position = motion.after(&position, game.placement(ply));
                if ply > first {
                    timeline.motions.push(motion);
                }
            }
            if ply >= first {
                timeline.positions.push(position.clone());
            }
        }
        timeline
    }

    /// The number of frames, at least 1.
    pub fn frames(&self) -> usize {
        match &self.film {
            None => self.positions.len(),
            Some(film) => film.frames(self.motions.len()),
        }
    }

    /// Frame `index`, from 0 to `frames() - 1`.
    pub fn frame(&self, index: usize) -> Frame {
        let mut frame = match &self.film {
            None => self.at_rest(index, reached(&Film::default(), index)),
            Some(film) => self.at_time(film, index as f64 / film.fps),
        };
        let steps = self.frames().saturating_sub(1).max(1);
        frame.gaze.orbit = self.orbit * index as f64 / steps as f64;
        frame
    }

    fn at_rest(&self, moves: usize, time: f64) -> Frame {
        let position = &self.positions[moves];
        Frame {
            time,
            ply: self.first_ply + moves,
            identities: position.identities,
            ..Frame::still(position.placement)
        }
    }

    fn at_time(&self, film: &Film, time: f64) -> Frame {
        let since_first = time - film.first;
        let period = film.transition + film.pause;
        let moves = self.motions.len();
        if since_first <= 0.0 || moves == 0 {
            return self.at_rest(0, time);
        }
        let begun = if period > 0.0 { since_first / period } else { f64::INFINITY };
        if begun >= moves as f64 {
            return self.at_rest(moves, time);
        }
        let current = begun as usize;
        let passed = (since_first - current as f64 * period) / film.transition;
        if passed < 1.0 {
            let position = &self.positions[current];
            let (standing, movers) = self.motions[current].under_way(position, passed.max(0.0));
            Frame { placement: standing, movers, ..self.at_rest(current, time) }
        } else {
            self.at_rest(current + 1, time)
        }
    }
}

/// When a film reaches the position after so many moves.
fn reached(film: &Film, moves: usize) -> f64 {
    if moves == 0 { 0.0 } else { Film { last: 0.0, ..*film }.length(moves) }
}
