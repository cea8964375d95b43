//! What all pictures of a job have in common.

use std::path::PathBuf;

use serde::Serialize;

use super::JobError;
use crate::assets::SetName;
use crate::config::{Config, ShowClock};
use crate::text::{printable, shown};
use crate::timeline::Frame;

/// What all pictures of a job have in common.
#[derive(Clone, Debug)]
pub struct PictureSettings {
    pub config: Config,
    /// Where `config` was read, if not built in.
    pub config_file: Option<PathBuf>,
    pub set: SetName,
    /// The number of threads; as many as the machine has cores when `None`.
    pub threads: Option<usize>,
}

impl PictureSettings {
    /// The files that are read for pictures, if they are there.
    pub(super) fn inputs(&self) -> Vec<PathBuf> {
        self.config_file.iter().cloned().chain(self.drawn_files()).collect()
    }

    /// Those of them that have something in them that is drawn.
    pub(super) fn drawn_files(&self) -> Vec<PathBuf> {
        self.config.bitmaps().into_iter().cloned().chain(self.set.files()).collect()
    }

    /// These as they stand in a manifest.
    pub(super) fn record(&self) -> SettingsRecord {
        SettingsRecord {
            version: env!("CARGO_PKG_VERSION"),
            config_file: self.config_file.as_deref().map(shown),
            set: printable(&self.set.to_string()),
            config: self.config.in_use(),
        }
    }

    /// Starts the threads on which pictures are made.
    pub(super) fn pool(&self) -> Result<rayon::ThreadPool, JobError> {
        let threads = self.threads.unwrap_or(0);
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.map_err(|error| JobError::Threads { threads, error })
    }
}

/// [`PictureSettings`] as they stand in a manifest, without the number of threads, and what is not used.
#[derive(Serialize)]
pub(super) struct SettingsRecord {
    version: &'static str,
    config_file: Option<String>,
    set: String,
    #[serde(flatten)]
    config: Config,
}

/// What of a frame can be seen in the scene.
pub(super) fn shown_of(settings: &PictureSettings, frame: &Frame) -> Frame {
    let dials = frame.dials.clone().filter(|_| settings.config.clock.show == ShowClock::Game);
    Frame { dials, ..frame.clone() }
}
