//! What a job would take, from a few of its pictures.

use std::time::{Duration, Instant};

use super::batch::{Batch, Entry, Part};
use super::captions::GameCaptions;
use super::render::survey;
use super::run::RenderJob;
use super::shots::Shots;
use super::studio::Studio;
use super::{JobError, Progress};
use crate::game::Game;
use crate::timeline::{Script, Timeline};

/// What there is to be rendered, and what that takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    pub games: usize,
    pub frames: u64,
    /// Of pictures; of films it is not known.
    pub bytes: f64,
    pub seconds: f64,
    /// Seconds of a frame that is rendered whole, and of one that follows another.
    pub whole_seconds: f64,
    pub other_seconds: f64,
    pub threads: usize,
}

/// So many games are looked into, spread over all of them.
const SAMPLES: usize = 3;

/// For so long frames of one of them are rendered, and at least so many that differ from the one before.
const BUDGET: Duration = Duration::from_millis(1500);
const FEWEST: u32 = 4;

/// What frames of one game took.
#[derive(Default)]
struct Sample {
    /// The first, which is rendered whole.
    first: Duration,
    /// Those that follow and differ, which reuse what stood still.
    others: Duration,
    others_count: u32,
    /// Of all frames of the game those that differ from the one before.
    share: f64,
    bytes: usize,
    count: u32,
}

/// Measures a few frames of `job`, and writes nothing.
///
/// # Errors
/// As for rendering, as far as they show before the first picture.
pub fn estimate(job: &RenderJob, progress: &dyn Progress) -> Result<Estimate, JobError> {
    measure(job, &survey(job, progress)?)
}

/// Measures a few frames of what is wanted of files that were looked through.
///
/// # Errors
/// As for [`estimate`].
pub fn measure(job: &RenderJob, batches: &[Batch]) -> Result<Estimate, JobError> {
    let games = batches.iter().map(|batch| batch.games).sum();
    let frames = batches.iter().map(|batch| batch.frames).sum();
    let pool = job.picture.pool()?;
    let mut studio = Studio::new(&job.picture, job.showing.reach(&job.picture.config))?;
    let script = job.showing.script(&job.picture.config, studio.bodies().clone());
    let mut samples = Vec::new();
    for Entry { game, part, .. } in sampled(batches, games, job, &script)? {
        if let Some(part) = &part {
            samples.push(pool.install(|| sample(job, &script, &mut studio, &game, part))?);
        }
    }
    let number = (samples.len() as f64).max(1.0);
    let whole = samples.iter().map(|sample| sample.first.as_secs_f64()).sum::<f64>() / number;
    let others = samples.iter().map(|sample| sample.others.as_secs_f64()).sum::<f64>();
    let counted: u32 = samples.iter().map(|sample| sample.others_count).sum();
    let other = if counted > 0 { others / f64::from(counted) } else { whole };
    let share = samples.iter().map(|sample| sample.share).sum::<f64>() / number;
    let bytes = samples.iter().map(|sample| sample.bytes as f64).sum::<f64>();
    let encoded = f64::from(samples.iter().map(|sample| sample.count).sum::<u32>().max(1));
    let first = (games as f64).min(frames as f64);
    Ok(Estimate {
        games,
        frames,
        bytes: if job.names.is_some() { bytes / encoded * frames as f64 } else { 0.0 },
        seconds: first * whole + (frames as f64 - first) * share * other,
        whole_seconds: whole,
        other_seconds: other,
        threads: pool.current_num_threads(),
    })
}

/// A few games, from the whole length of all files.
fn sampled(
    batches: &[Batch],
    games: usize,
    job: &RenderJob,
    script: &Script,
) -> Result<Vec<Entry>, JobError> {
    let wanted: Vec<usize> =
        (0..SAMPLES).map(|sample| games * (2 * sample + 1) / (2 * SAMPLES)).collect();
    let mut found = Vec::new();
    let mut before = 0;
    for batch in batches {
        for (place, entry) in (before..).zip(batch.entries(job, script)?) {
            let entry = entry?;
            if wanted.contains(&place) {
                found.push(entry);
            }
            if wanted.last() == Some(&place) {
                return Ok(found);
            }
        }
        before += batch.games;
    }
    Ok(found)
}

/// Renders frames from the middle of `part` on.
fn sample(
    job: &RenderJob,
    script: &Script,
    studio: &mut Studio,
    game: &Game,
    part: &Part,
) -> Result<Sample, JobError> {
    let mut sample = Sample::default();
    let Ok(timeline) = Timeline::new(game, part.first, part.last, script) else {
        return Ok(sample);
    };
    let captions = GameCaptions::new(game, job.picture.config.captions);
    let Part { first, last, every, ref frames } = *part;
    let compared = frames.start..frames.end.min(frames.start + MOST_COMPARED);
    let compared = Part { first, last, frames: compared, every };
    let shots = Shots::of(&job.picture, &timeline, &captions, &compared, script.film.fps);
    let differ = shots.begins;
    sample.share = differ.len() as f64 / compared.count().max(1) as f64;
    let begun = Instant::now();
    let mut frames = differ.iter().copied().skip(differ.len() / 2);
    while let Some(index) = frames.next() {
        let start = Instant::now();
        let frame = timeline.frame(index);
        let coming = frames.clone().map(|index| timeline.frame(index));
        let picture = studio.picture(&frame, captions.of(&frame).as_ref(), coming);
        if job.names.is_some() {
            sample.bytes += picture.bytes(job.format()).map_err(JobError::Write)?;
        }
        sample.count += 1;
        if sample.count == 1 {
            sample.first = start.elapsed();
        } else {
            sample.others += start.elapsed();
            sample.others_count += 1;
        }
        if begun.elapsed() > BUDGET && sample.others_count >= FEWEST {
            break;
        }
    }
    Ok(sample)
}

/// So many frames of a game are compared.
const MOST_COMPARED: usize = 10_000;
