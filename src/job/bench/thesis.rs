//! The thesis's own measurement, on today's machine.

use std::time::Instant;

use serde::Serialize;

use super::BenchJob;
use crate::assets::SetName;
use crate::config::{Config, Look, Sampling};
use crate::job::JobError;
use crate::job::settings::PictureSettings;
use crate::job::studio::Studio;
use crate::notation::{Board, Placement};
use crate::scene::Reach;
use crate::timeline::Frame;
use crate::tracer::RayCounts;

/// What one of the thesis's settings took.
#[derive(Clone, Debug, Serialize)]
pub struct Measurement {
    pub setting: &'static str,
    /// Of tracing alone, the quickest run.
    pub seconds: f64,
    /// What the thesis gives for a two-core Athlon 64 X2 5000+ (Turek 2008, 5).
    pub thesis_seconds: f64,
    pub threads: usize,
    pub rays: RayCounts,
    /// Million rays of all kinds a second and thread.
    pub mrays_per_second_and_core: f64,
}

/// The thesis's three settings: name, sampling, steps of subdivision, its seconds.
const SETTINGS: [(&str, Sampling, u32, f64); 3] = [
    ("4 rays a pixel", Sampling::Grid, 4, 228.0),
    ("1 ray a pixel", Sampling::None, 4, 56.0),
    ("1 ray a pixel, 2 subdivisions", Sampling::None, 2, 31.0),
];

/// Renders the start position at 1000 × 600 from the thesis's camera, at each of its settings.
///
/// # Errors
/// When threads cannot be started.
pub fn measure(job: &BenchJob) -> Result<Vec<Measurement>, JobError> {
    let frame = Frame::still(Placement::from(&Board::default()));
    let measure = |(setting, sampling, subdivisions, thesis_seconds)| {
        let mut config = Config::new(Look::Thesis);
        (config.render.sampling, config.render.rays) = (sampling, 2);
        config.render.subdivisions = subdivisions;
        let settings = PictureSettings {
            config,
            config_file: None,
            set: SetName::Thesis,
            threads: job.threads,
        };
        let pool = settings.pool()?;
        let mut studio = Studio::new(&settings, Reach::default())?;
        let mut run = || {
            let begin = Instant::now();
            pool.install(|| studio.trace_whole(&frame));
            (begin.elapsed().as_secs_f64(), studio.rays())
        };
        let (first, rays) = run();
        let seconds = (1..job.runs).map(|_| run().0).fold(first, f64::min);
        let threads = pool.current_num_threads();
        Ok(Measurement {
            setting,
            seconds,
            thesis_seconds,
            threads,
            rays,
            mrays_per_second_and_core: rays.total() as f64 / 1e6 / seconds / threads as f64,
        })
    };
    SETTINGS.into_iter().map(measure).collect()
}
