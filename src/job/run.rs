//! A job of rendering: what is wanted, and what those who do it share.

use std::ops::RangeInclusive;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};

use rayon::ThreadPool;

use super::fingerprint::Fingerprints;
use super::records::{Ledger, Sums};
use super::settings::PictureSettings;
use super::share::Shard;
use super::{Progress, Showing};
use crate::game::{Letters, Moment, Wanted};
use crate::output::{Ffmpeg, FilmFormat, FrameNames, PictureFormat};
use crate::timeline::{Bodies, Script};

/// Which games to render, how, and where to.
#[derive(Clone, Debug)]
pub struct RenderJob {
    /// Files of games; `-` is the standard input.
    pub inputs: Vec<PathBuf>,
    /// The folder that gets one folder a file, each with one folder a game.
    pub out: PathBuf,
    pub wanted: Wanted,
    pub letters: Letters,
    /// The first position and the last one.
    pub from: Moment,
    pub to: Moment,
    /// Whether variations are rendered too, each in a folder of its own within its game's.
    pub variations: bool,
    pub showing: Showing,
    /// Which frames of each game, counted as in the whole; all when `None`.
    pub frames: Option<RangeInclusive<usize>>,
    /// Every so manyth frame is rendered, and the last one; at least 1.
    pub every: usize,
    /// Whether to give up rather than replace pictures of other settings or games.
    pub refuses_old: bool,
    /// How frames are named as pictures; there are none when `None`.
    pub names: Option<FrameNames>,
    pub films: Films,
    pub picture: PictureSettings,
}

impl RenderJob {
    /// Whether MP4 is wanted, and ffmpeg makes it.
    pub fn is_by_ffmpeg(&self) -> bool {
        self.films.formats.contains(&FilmFormat::Mp4) && self.films.ffmpeg.is_some()
    }

    /// The format of its pictures.
    pub fn format(&self) -> PictureFormat {
        self.names.as_ref().map_or(PictureFormat::Png, FrameNames::format)
    }

    /// How pictures are named that shards make, even where films alone are wanted.
    pub fn names_of_shards(&self) -> FrameNames {
        self.names.clone().unwrap_or(FrameNames::new(PictureFormat::Png))
    }
}

/// What films are wanted of each game.
#[derive(Clone, Debug, Default)]
pub struct Films {
    pub formats: Vec<FilmFormat>,
    /// Who makes MP4; the encoder inside where there is none.
    pub ffmpeg: Option<Ffmpeg>,
}

/// What of a job is done.
pub enum Task {
    /// All that is not there yet.
    Whole,
    /// All but pictures: they are there, and as they should be. Those that only films want go.
    Merge,
    /// The pictures of a shard.
    Shard(ShardTask),
}

/// A shard under way.
pub struct ShardTask {
    pub shard: Shard,
    /// What earlier runs of the shard have told of its pictures.
    pub sums: Sums,
    /// Where this one tells it.
    pub ledger: Ledger,
}

/// A job under way.
pub struct Run<'a> {
    pub job: &'a RenderJob,
    pub script: Script,
    pub progress: &'a dyn Progress,
    pub pool: &'a ThreadPool,
    pub fingerprints: Fingerprints<'a>,
    pub task: Task,
    /// How frames are named as pictures while it is under way; there are none when `None`.
    pub names: Option<FrameNames>,
    /// Whether a game could not be rendered, so that others are not begun or gone on with.
    pub has_failed: AtomicBool,
}

impl<'a> Run<'a> {
    /// A job whose pieces and board take such room, on the threads of `pool`.
    pub fn new(
        job: &'a RenderJob,
        task: Task,
        bodies: Bodies,
        pool: &'a ThreadPool,
        progress: &'a dyn Progress,
    ) -> Run<'a> {
        let reach = job.showing.reach(&job.picture.config);
        let names = match task {
            Task::Whole | Task::Merge => job.names.clone(),
            Task::Shard(_) => Some(job.names_of_shards()),
        };
        Run {
            job,
            script: job.showing.script(&job.picture.config, bodies),
            progress,
            pool,
            fingerprints: Fingerprints::new(&job.picture, reach),
            task,
            names,
            has_failed: AtomicBool::new(false),
        }
    }

    /// Whether no more is to be rendered.
    pub fn is_over(&self) -> bool {
        self.progress.is_cancelled() || self.has_failed.load(Ordering::Relaxed)
    }

    /// Where a picture is noted that does not tell itself what it is.
    pub fn ledger(&self) -> Option<&Ledger> {
        match &self.task {
            Task::Shard(task) if !self.job.format().is_sealed() => Some(&task.ledger),
            _ => None,
        }
    }
}
