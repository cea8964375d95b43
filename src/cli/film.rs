//! The options of films: times, frames, and how the camera goes about the board.

use std::ops::RangeInclusive;

use clap::{Args, ValueEnum};
use lightsquare::job::Showing;
use lightsquare::timeline::{Film, Pause};

use super::values::{degrees, fps, frames, pause, seconds};

/// Times and frames of films.
#[derive(Args)]
#[command(next_help_heading = "Film")]
pub struct FilmArgs {
    /// Make the frames of a film, with the moves between the positions
    #[arg(long)]
    animate: bool,
    /// Frames a second, from 1 to 240
    #[arg(
        long,
        value_name = "N",
        default_value = "25",
        value_parser = fps,
        allow_negative_numbers = true,
        requires = "animate"
    )]
    fps: f64,
    /// Seconds that a move takes
    #[arg(
        long,
        value_name = "S",
        default_value = "0.6",
        value_parser = seconds,
        allow_negative_numbers = true,
        requires = "animate"
    )]
    transition: f64,
    /// Seconds that a position stands; or real, by the players' clocks in the game: 0.8 for the
    /// median, no less than 0.4, no more than 2
    #[arg(
        long,
        value_name = "S|real",
        default_value = "0.8",
        value_parser = pause,
        allow_negative_numbers = true,
        requires = "animate"
    )]
    pause: Pause,
    /// Seconds that the first position stands
    #[arg(
        long,
        value_name = "S",
        default_value = "1",
        value_parser = seconds,
        allow_negative_numbers = true,
        requires = "animate"
    )]
    first: f64,
    /// Seconds that the last position stands
    #[arg(
        long,
        value_name = "S",
        default_value = "5",
        value_parser = seconds,
        allow_negative_numbers = true,
        requires = "animate"
    )]
    last: f64,
    /// Seconds that a title stands before the game; without --animate, one picture of it
    #[arg(
        long,
        value_name = "S",
        default_value = "0",
        default_missing_value = "3",
        num_args = 0..=1,
        require_equals = true,
        value_parser = seconds
    )]
    title: f64,
    /// Seconds that the result stands behind the game; without --animate, one picture of it
    #[arg(
        long,
        value_name = "S",
        default_value = "0",
        default_missing_value = "3",
        num_args = 0..=1,
        require_equals = true,
        value_parser = seconds
    )]
    result: f64,
    /// Only these frames of each game, as in 100-250 or 7, with their names and times in the whole
    #[arg(long, value_name = "FRAMES", value_parser = frames)]
    pub frames: Option<RangeInclusive<usize>>,
    /// Turn the camera about the board by so many degrees, anticlockwise as seen from above
    #[arg(
        long,
        value_name = "DEG",
        default_value = "0",
        value_parser = degrees,
        allow_negative_numbers = true
    )]
    orbit: f64,
    /// Over what the camera turns so far
    #[arg(
        long,
        value_name = "SPAN",
        default_value = "film",
        requires = "orbit",
        ignore_case = true
    )]
    orbit_over: OrbitSpan,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum OrbitSpan {
    /// The whole film.
    Film,
    /// Each move.
    Move,
}

impl FilmArgs {
    /// How games are to be shown in time.
    pub fn showing(&self) -> Showing {
        let FilmArgs { fps, transition, pause, first, last, title, result, .. } = *self;
        Showing {
            film: Film { fps, transition, pause, first, last, title, result },
            animate: self.animate,
            orbit: self.orbit,
            orbits_each_move: self.orbit_over == OrbitSpan::Move,
        }
    }
}
