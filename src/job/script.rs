//! From settings to what timelines and stages are told.

use crate::config::{Camera, Captured, Config, ShowClock, View};
use crate::scene::{Reach, TO_MOVER};
use crate::timeline::{Bodies, Camerawork, Film, Lead, Script};

/// How games are shown in time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Showing {
    /// The film's times; those of a film that might be made, where there is one frame a position.
    pub film: Film,
    /// Whether there are frames between the positions.
    pub animate: bool,
    /// How far the camera turns about the board, in degrees.
    pub orbit: f64,
    /// Whether it turns so far with each move, instead of over the whole game.
    pub orbits_each_move: bool,
}

impl Showing {
    /// What a timeline is to do with the settings of `config`, where things take the room of `bodies`.
    pub fn script(&self, config: &Config, bodies: Bodies) -> Script {
        let Camera { view, path, .. } = &config.camera;
        let lead = match view {
            View::Mover => Lead::Mover { turn: TO_MOVER },
            View::Follow => Lead::Piece,
            View::Path => Lead::Path(path.clone()),
            _ => Lead::Nothing,
        };
        Script {
            film: self.film,
            animate: self.animate,
            camerawork: Camerawork { orbit: self.orbit, each_move: self.orbits_each_move, lead },
            keeps_captured: self.keeps_captured(config),
            has_clock: config.clock.show == ShowClock::Game
                || config.captions.show && config.captions.clocks,
            bodies,
        }
    }

    /// What pictures have to hold.
    pub fn reach(&self, config: &Config) -> Reach {
        let mover = if config.camera.view == View::Mover { TO_MOVER } else { 0.0 };
        // With each move it may come round as often as it likes.
        let goes_round = self.orbits_each_move && self.orbit != 0.0;
        let orbit = if goes_round { 360_f64.copysign(self.orbit) } else { self.orbit };
        let turns = [0.0, orbit, mover, orbit + mover];
        Reach {
            moves: self.animate,
            captured: self.keeps_captured(config),
            columns: 0,
            orbit: [turns.into_iter().fold(0.0, f64::min), turns.into_iter().fold(0.0, f64::max)],
        }
    }

    fn keeps_captured(&self, config: &Config) -> bool {
        match config.captured {
            Captured::Films => self.animate,
            Captured::Beside => true,
            Captured::Gone => false,
        }
    }
}
