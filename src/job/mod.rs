//! What to do: render games, one position, or say what a file holds.
//!
//! A job is given typed and checked settings, tells a [`Progress`] how far it is, and gives back
//! a summary or its error. It never prints.

mod diagram;
mod inspect;
mod render;
mod report;
mod studio;

pub use diagram::{DiagramJob, Subject, diagram};
pub use inspect::{InspectJob, inspect};
pub use render::{RenderJob, Summary, render};
pub use studio::PictureSettings;

use std::io;
use std::path::PathBuf;

use crate::game::{Moment, SourceError};
use crate::geometry::ProfileError;
use crate::output::OutputError;

/// Why a job could not be done.
#[derive(Debug, thiserror::Error)]
pub enum JobError {
    #[error(transparent)]
    Source(#[from] SourceError),
    #[error(transparent)]
    Output(#[from] OutputError),
    #[error("{file}: none of the selected games is there, it has {games}")]
    NothingSelected { file: String, games: usize },
    #[error(
        "{file}: game {game} has no position {moment}, its last one is after {plies} half-moves"
    )]
    NoSuchMoment { file: String, game: usize, moment: Moment, plies: usize },
    #[error("{file}: game {game} has no position that is certain, {problem}")]
    NoPosition { file: String, game: usize, problem: String },
    #[error("the piece set cannot be built")]
    Set(#[from] ProfileError),
    #[error("{threads} threads cannot be started")]
    Threads {
        threads: usize,
        #[source]
        error: rayon::ThreadPoolBuildError,
    },
    #[error("the output cannot be written")]
    Write(#[source] io::Error),
}

/// Who wants to know how far a job is, and may end it early.
pub trait Progress: Sync {
    /// The job has read its input: so many frames are to come.
    fn begin(&self, frames: u64);
    /// From here on frames belong to this game.
    fn game(&self, name: &str);
    /// One more frame is written.
    fn frame_done(&self);
    /// Something that the user should know at once.
    fn warn(&self, text: &str);
    /// Something for those who asked for details.
    fn detail(&self, text: &str);
    /// Whether to stop at the next frame.
    fn is_cancelled(&self) -> bool;
}

/// A file's name as messages show it, `-` for the standard input.
fn shown(path: &std::path::Path) -> String {
    path.display().to_string()
}

/// Settings that every picture of a job shares, as they stand in the manifest.
#[derive(serde::Serialize)]
struct SettingsRecord<'a> {
    version: &'static str,
    config_file: Option<&'a PathBuf>,
    antialiasing_rays_per_side: u32,
    #[serde(flatten)]
    config: &'a crate::config::Config,
}
