//! From a frame to a picture: the stage, the tracer and its threads.

use std::path::PathBuf;

use image::RgbImage;
use serde::Serialize;

use super::JobError;
use crate::assets::thesis_set;
use crate::config::Config;
use crate::scene::Stage;
use crate::timeline::Frame;
use crate::tracer::{self, Antialiasing, RayCounts};

/// Steps of subdivision for the curves of pieces, as in the thesis.
const SUBDIVISIONS: u32 = 4;

/// What all pictures of a job have in common.
#[derive(Clone, Debug)]
pub struct PictureSettings {
    pub config: Config,
    /// Where `config` was read, if not built in.
    pub config_file: Option<PathBuf>,
    pub antialiasing: Antialiasing,
    /// The number of threads; as many as the machine has cores when `None`.
    pub threads: Option<usize>,
}

/// [`PictureSettings`] as they stand in a manifest, without what changes no picture.
#[derive(Serialize)]
pub(super) struct SettingsRecord<'a> {
    version: &'static str,
    config_file: Option<&'a PathBuf>,
    antialiasing_rays_per_side: u32,
    #[serde(flatten)]
    config: &'a Config,
}

/// Makes pictures of frames.
pub(super) struct Studio<'a> {
    settings: &'a PictureSettings,
    stage: Stage,
    threads: rayon::ThreadPool,
    rays: RayCounts,
}

impl<'a> Studio<'a> {
    pub fn new(settings: &'a PictureSettings) -> Result<Studio<'a>, JobError> {
        let threads = settings.threads.unwrap_or(0);
        Ok(Studio {
            settings,
            stage: Stage::new(&settings.config, thesis_set(SUBDIVISIONS)?),
            threads: rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .map_err(|error| JobError::Threads { threads, error })?,
            rays: RayCounts::default(),
        })
    }

    pub fn picture(&mut self, frame: &Frame) -> RgbImage {
        let scene = self.stage.scene(frame);
        let Config { width, height, .. } = self.settings.config;
        let mode = self.settings.antialiasing;
        let (picture, rays) = self.threads.install(|| tracer::render(&scene, width, height, mode));
        self.rays = self.rays + rays;
        picture
    }

    /// All rays so far.
    pub fn rays(&self) -> RayCounts {
        self.rays
    }

    pub fn record(&self) -> SettingsRecord<'a> {
        SettingsRecord {
            version: env!("CARGO_PKG_VERSION"),
            config_file: self.settings.config_file.as_ref(),
            antialiasing_rays_per_side: self.settings.antialiasing.rays_per_side(),
            config: &self.settings.config,
        }
    }
}
