//! Measurements: the thesis's own on today's machine, and a game's.

mod game;
mod thesis;

pub use game::GameMeasurement;
pub use thesis::Measurement;

use serde::Serialize;

use super::JobError;

/// How to measure.
#[derive(Clone, Copy, Debug)]
pub struct BenchJob {
    /// As many as the machine has cores when `None`.
    pub threads: Option<usize>,
    /// How often each of the thesis's settings is rendered; the quickest counts.
    pub runs: usize,
    /// How many half-moves of the game are rendered, once.
    pub plies: usize,
}

/// What was measured. Seconds are of tracing alone.
#[derive(Clone, Debug, Serialize)]
pub struct Measurements {
    pub pictures: Vec<Measurement>,
    pub games: Vec<GameMeasurement>,
}

/// Measures the thesis's three settings, and then a game.
///
/// # Errors
/// When threads cannot be started.
pub fn bench(job: &BenchJob) -> Result<Measurements, JobError> {
    Ok(Measurements { pictures: thesis::measure(job)?, games: game::measure(job)? })
}
