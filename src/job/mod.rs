//! What to do: render games or one position, say what a file holds, write a scene down, measure.
//!
//! A job is given typed and checked settings, tells a [`Progress`] how far it is, and gives back
//! a summary or its error. It writes where it is told to, and never prints.

mod batch;
mod bench;
mod captions;
mod crew;
mod desk;
mod diagram;
mod estimate;
mod export;
mod fingerprint;
mod input;
mod inspect;
mod layout;
mod line;
mod plan;
mod records;
mod reels;
mod render;
mod report;
mod room;
mod run;
mod script;
mod settings;
mod share;
mod shared;
mod shots;
mod studio;
mod subject;
mod wording;

pub use bench::{BenchJob, GameMeasurement, Measurement, Measurements, bench};
pub use crew::Summary;
pub use diagram::{DiagramJob, DiagramSummary, Drawn, diagram};
pub use estimate::{Estimate, estimate};
pub use export::{ExportJob, export};
pub use inspect::{InspectJob, Listing, inspect};
pub use plan::{
    Fault, Flaw, MOST_SHARDS, Merged, Plan, PlanError, PlanSummary, Verdict, merge, plan,
    render_shard, verify,
};
pub use render::render;
pub use run::{Films, RenderJob};
pub use script::Showing;
pub use settings::PictureSettings;
pub use subject::Subject;

use std::io;
use std::path::PathBuf;

use crate::assets::AssetError;
use crate::caption::CaptionError;
use crate::game::{Game, Moment, Selection, SourceError, Variation};
use crate::output::{LockError, OutputError};
use crate::scene::StageError;
use crate::text::shown;
use crate::timeline::PathError;

/// Why a job could not be done.
#[derive(Debug, thiserror::Error)]
pub enum JobError {
    #[error(transparent)]
    Source(#[from] SourceError),
    #[error(transparent)]
    Output(#[from] OutputError),
    #[error("{file}: none of its games is selected, it has {games}")]
    NothingSelected { file: String, games: usize },
    #[error("none of the games is selected, the {files} files have {games}")]
    NothingSelectedInAny { files: usize, games: usize },
    #[error("{file}: game {game} has no position {moment}, it goes from {start} to {end}")]
    NoSuchMoment { file: String, game: usize, moment: Moment, start: String, end: String },
    #[error("{file}: game {game} has no position that is certain")]
    NoPosition { file: String, game: usize },
    #[error("{}: is the file that is read, expected another one to write", shown(path))]
    OutputIsInput { path: PathBuf },
    #[error(
        "{}: is read, and lies in a folder that is written to, expected another --out",
        shown(path)
    )]
    InputInOutput { path: PathBuf },
    #[error("{file}: game {game} would take {frames} frames, expected at most {MAX_FRAMES}")]
    TooLong { file: String, game: usize, frames: usize },
    #[error(
        "--frames: {file}: game {game} has frames 0 to {last}, expected a part of them, found {wanted}"
    )]
    NoSuchFrames { file: String, game: usize, last: usize, wanted: String },
    #[error("{file}: game {game}: {error}")]
    Path { file: String, game: usize, error: PathError },
    #[error(transparent)]
    Plan(#[from] PlanError),
    #[error(transparent)]
    Lock(#[from] LockError),
    #[error(
        "{}: is of another run or plan, with other settings or another game, and is not to be replaced; expected another --out",
        shown(path)
    )]
    WouldReplace { path: PathBuf },
    #[error(
        "{}: {frames} frames of {width}x{height} take {} at least, and there is room for {}",
        shown(folder), in_bytes(*needed as f64), in_bytes(*free as f64)
    )]
    NoRoom { folder: PathBuf, frames: u64, width: u32, height: u32, needed: u64, free: u64 },
    #[error(transparent)]
    Assets(#[from] AssetError),
    #[error(transparent)]
    Caption(#[from] CaptionError),
    #[error(transparent)]
    Stage(#[from] StageError),
    #[error("{threads} threads cannot be started")]
    Threads {
        threads: usize,
        #[source]
        error: rayon::ThreadPoolBuildError,
    },
    #[error(
        "the scene has pictures (of the clock, or of materials), expected a file to write it to, \
         so that they can stand beside it"
    )]
    BitmapsOnStdout,
    #[error("the output cannot be written")]
    Write(#[source] io::Error),
}

/// The most frames of one game: an hour at 240 a second, and a little more.
pub const MAX_FRAMES: usize = 1_000_000;

/// Who wants to know how far a job is, and may end it early.
pub trait Progress: Sync {
    /// The job has read its input: so many frames are to come.
    fn begin(&self, frames: u64);
    /// From here on frames belong to this game.
    fn game(&self, name: &str);
    /// One more frame is written.
    fn frame_done(&self);
    /// Something that the user should know.
    fn say(&self, text: &str);
    /// Something for those who asked for details.
    fn detail(&self, text: &str);
    /// Whether to stop at the next game or frame.
    fn is_cancelled(&self) -> bool;
}

/// A number of bytes, in the unit that suits it.
pub fn in_bytes(number: f64) -> String {
    let units = [("TB", 1e12), ("GB", 1e9), ("MB", 1e6), ("kB", 1e3)];
    match units.iter().find(|(_, unit)| number >= *unit) {
        Some((name, unit)) => format!("{:.1} {name}", number / unit),
        // Sums of nothing are below nothing.
        None => format!("{} bytes", number.max(0.0)),
    }
}

/// Tells what could not be read of a game.
fn say_problems(file: &str, game: &Game, progress: &dyn Progress) {
    for problem in &game.problems {
        progress.say(&format!("{file}: game {}, {problem}", game.number));
    }
}

/// Tells what could not be read in variations.
fn say_variations(variations: &[Variation], file: &str, number: usize, progress: &dyn Progress) {
    for variation in variations {
        for problem in &variation.problems {
            progress.say(&format!("{file}: game {number}, in a variation, {problem}"));
        }
        say_variations(&variation.variations, file, number, progress);
    }
}

/// That none of so many games is selected, which are all that `inputs` have.
fn nothing_selected(inputs: &[PathBuf], games: usize) -> JobError {
    match inputs {
        [input] => JobError::NothingSelected { file: shown(input), games },
        _ => JobError::NothingSelectedInAny { files: inputs.len(), games },
    }
}

/// Tells when a selection names games that a file of so many games does not have.
fn say_missing(file: &str, selection: Option<&Selection>, games: usize, progress: &dyn Progress) {
    if let Some(highest) = selection.map(Selection::highest).filter(|highest| *highest > games) {
        progress.say(&format!("{file}: game {highest} is selected, but it has {games}"));
    }
}
