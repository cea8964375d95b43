//! From a game to frames: what stands or moves where at a time.
//!
//! A [`Timeline`] gives frame `i` without the ones before it, so that any part of a film can be
//! made alone. Times are seconds from the film's beginning.

mod beside;
mod bodies;
mod camera;
mod dials;
mod film;
mod flight;
mod marks;
mod motion;
mod path;
mod pieces;
mod plan;
mod shown;
mod tray;

pub use bodies::{Bodies, Envelope, SLICE};
pub use camera::{Camerawork, Lead};
pub use film::{Film, Pause};
pub use path::PathError;
pub use pieces::{Identities, Mover, Spot};
pub use plan::ceiling;
pub use shown::{Card, Dials, Gaze, Marks, digital};
pub use tray::reach as tray_reach;

use std::sync::OnceLock;

use crate::game::{Game, fen_in_hand};
use crate::notation::Placement;

use beside::Beside;
use camera::Track;
use dials::Clock;
use film::{Moment, Schedule, paced};
use marks::marks;
use motion::Motion;
use pieces::Position;
use plan::Plan;

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
    /// Pieces on their way, or leaving the board; the one whose move it is comes first.
    pub movers: Vec<Mover>,
    /// Captured pieces that stand beside the board, in the order of their capture; or those that players have in
    /// hand.
    pub taken: Vec<Mover>,
    /// For how many columns of them, at either side, pictures leave room: the same in all of a game, 0 where none
    /// are shown.
    pub columns: u32,
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
            columns: 0,
            marks: Marks::default(),
            dials: None,
            gaze: Gaze::default(),
            card: None,
        }
    }

    /// The position of a FEN with the pieces of `placement`: check, where it says who is to move and the position can
    /// be played, and what players have in hand, where it tells.
    pub fn of_fen(placement: Placement, fen: &str, bodies: &Bodies) -> Frame {
        let frame = Frame { marks: Marks::of_fen(fen), ..Frame::still(placement) };
        match fen_in_hand(fen) {
            Some(in_hand) => {
                let beside = Beside::in_hand(&in_hand, &placement);
                Frame { taken: beside.movers(bodies), columns: beside.columns(bodies), ..frame }
            }
            None => frame,
        }
    }

    /// Whether both frames show the same scene, whatever their times and words.
    pub fn shows_the_same(&self, other: &Frame) -> bool {
        let bare = |frame: &Frame| Frame { time: 0.0, ply: 0, card: None, ..frame.clone() };
        bare(self) == bare(other)
    }
}

/// How a game is shown.
#[derive(Clone, Debug, Default)]
pub struct Script {
    pub film: Film,
    /// Whether there are frames between the positions; else each position is one frame.
    pub animate: bool,
    pub camerawork: Camerawork,
    /// The room that things take, where captured pieces stay beside the board, or move away.
    pub bodies: Bodies,
    /// Whether captured pieces stay beside the board.
    pub keeps_captured: bool,
    /// Whether frames say what a clock shows.
    pub has_clock: bool,
}

/// All frames of a game, or of a part of it.
pub struct Timeline<'a> {
    script: &'a Script,
    /// The columns beside the board that pictures leave room for.
    columns: u32,
    positions: Vec<Position>,
    /// What the board tells of each of them.
    marks: Vec<Marks>,
    /// What leads from each position to the next.
    motions: Vec<Motion>,
    /// The ways of the pieces in each, once they were asked for.
    plans: Vec<OnceLock<Plan>>,
    first_ply: usize,
    schedule: Schedule,
    /// What happens in each frame, where each position is one.
    stills: Vec<Moment>,
    track: Track,
    clock: Option<Clock>,
}

impl<'a> Timeline<'a> {
    /// The positions of `game` from ply `first` to ply `last` (both shown, at most the game's
    /// length), as `script` has it.
    ///
    /// # Errors
    /// A camera's path that cannot be taken.
    pub fn new(
        game: &Game,
        first: usize,
        last: usize,
        script: &'a Script,
    ) -> Result<Timeline<'a>, PathError> {
        let schedule = schedule(game, first, last, script.film);
        let bodies = &script.bodies;
        let mut position = Position::new(game, bodies);
        let in_hand = matches!(position.beside, Beside::InHand(_));
        let shows_beside = script.keeps_captured || in_hand;
        let mut timeline = Timeline {
            script,
            positions: Vec::with_capacity(last + 1 - first),
            columns: if shows_beside { position.beside.columns(bodies) } else { 0 },
            marks: (first..=last).map(|ply| marks(game, ply)).collect(),
            motions: Vec::with_capacity(last - first),
            plans: vec![OnceLock::new(); last - first],
            first_ply: first,
            stills: stills(last - first, script.film),
            track: Track::new(&script.camerawork, game, [first, last], &schedule)?,
            schedule,
            clock: script.has_clock.then(|| Clock::new(game, first, last)),
        };
        // Whatever part of a game is shown, it has room for all that is ever in hand.
        let end = if in_hand { game.plies.len() } else { last };
        for ply in 0..=end {
            if ply > 0 {
                let motion = Motion::new(game, ply);
                position = motion.after(&position, game.placement(ply));
                if !script.keeps_captured {
                    position.beside.clear();
                }
                if ply > first && ply <= last {
                    timeline.motions.push(motion);
                }
            }
            if in_hand {
                timeline.columns = timeline.columns.max(position.beside.columns(bodies));
            }
            if (first..=last).contains(&ply) {
                timeline.positions.push(position.clone());
            }
        }
        Ok(timeline)
    }

    /// The number of frames of such a timeline, without all that they show.
    ///
    /// # Errors
    /// Those of [`Timeline::new`].
    pub fn count(
        game: &Game,
        first: usize,
        last: usize,
        script: &Script,
    ) -> Result<usize, PathError> {
        let schedule = schedule(game, first, last, script.film);
        Track::new(&script.camerawork, game, [first, last], &schedule)?;
        let stills = || stills(last - first, script.film).len();
        Ok(if script.animate { schedule.frames() } else { stills() })
    }

    /// The number of frames, at least 1.
    pub fn frames(&self) -> usize {
        if self.script.animate { self.schedule.frames() } else { self.stills.len() }
    }

    /// Frame `index`, from 0 to `frames() - 1`.
    pub fn frame(&self, index: usize) -> Frame {
        let (moment, time) = if self.script.animate {
            let time = self.schedule.time(index);
            (self.schedule.at(time), time)
        } else {
            let moment = self.stills[index];
            (moment, self.still_time(moment))
        };
        let steps = self.frames().saturating_sub(1).max(1);
        let whole = index as f64 / steps as f64;
        let runs = self.script.animate;
        Frame {
            gaze: self.track.gaze(moment, time, whole),
            dials: self.clock.as_ref().map(|clock| clock.dials(moment, runs)),
            time,
            ..self.at(moment)
        }
    }

    /// When frame `index` begins, in seconds; where there is none more, when the film ends.
    pub fn begins(&self, index: usize) -> f64 {
        match self.stills.get(index) {
            _ if self.script.animate => self.schedule.time(index),
            Some(moment) => self.still_time(*moment),
            None => self.schedule.length(),
        }
    }

    fn at(&self, moment: Moment) -> Frame {
        match moment {
            Moment::Title => Frame { card: Some(Card::Title), ..self.at_rest(0) },
            Moment::Rest { moves, .. } => self.at_rest(moves),
            Moment::Result { moves } => Frame { card: Some(Card::Result), ..self.at_rest(moves) },
            Moment::Move { moves, passed } => {
                let position = &self.positions[moves];
                let plan = self.plans[moves]
                    .get_or_init(|| Plan::new(&self.motions[moves], position, &self.script.bodies));
                let (placement, movers) = plan.under_way(position, passed);
                let marks = self.marks[moves + 1].under_way();
                let mut frame = Frame { placement, movers, marks, ..self.at_rest(moves) };
                let Frame { taken, movers, .. } = &mut frame;
                taken.retain(|held| movers.iter().all(|mover| mover.identity != held.identity));
                frame
            }
        }
    }

    fn at_rest(&self, moves: usize) -> Frame {
        let position = &self.positions[moves];
        Frame {
            ply: self.first_ply + moves,
            identities: position.identities,
            taken: position.beside.movers(&self.script.bodies),
            columns: self.columns,
            marks: self.marks[moves].clone(),
            ..Frame::still(position.placement)
        }
    }

    /// When a film would reach a picture of a position.
    fn still_time(&self, moment: Moment) -> f64 {
        match moment {
            Moment::Title => 0.0,
            Moment::Rest { moves, .. } | Moment::Move { moves, .. } => {
                self.schedule.reached(moves as i64)
            }
            Moment::Result { .. } => self.schedule.length() - self.script.film.result,
        }
    }
}

/// The times of the film of a part of `game`.
fn schedule(game: &Game, first: usize, last: usize, film: Film) -> Schedule {
    let moves = last - first;
    let pauses = match film.pause {
        Pause::Even(seconds) => vec![seconds; moves.saturating_sub(1)],
        Pause::Real => {
            let clocks = game.clocks();
            let thought: Vec<_> = (first + 2..=last).map(|ply| clocks.thought(ply)).collect();
            paced(&thought)
        }
    };
    Schedule::new(film, moves, &pauses)
}

/// The frames of a game, or of a part of it with so many `moves`, without those between the positions.
fn stills(moves: usize, film: Film) -> Vec<Moment> {
    let title = (film.title > 0.0).then_some(Moment::Title);
    let result = (film.result > 0.0).then_some(Moment::Result { moves });
    let rests = (0..=moves).map(|moves| Moment::Rest { moves, passed: 1.0 });
    title.into_iter().chain(rests).chain(result).collect()
}
