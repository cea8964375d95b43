//! Games that are rendered side by side, each by a studio of its own.

use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;

use rayon::ThreadPool;

use super::batch::{Batch, Entry, game_folder};
use super::desk::Desk;
use super::line::Rendered;
use super::report::{Report, ReportLine, Status, VariationLine};
use super::run::{RenderJob, Run, Task};
use super::shared::Shared;
use super::studio::Studio;
use super::{JobError, Progress};
use crate::config::Config;
use crate::tracer::RayCounts;

/// What a job did.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Summary {
    pub rendered: usize,
    pub partial: usize,
    pub skipped: usize,
    /// Pictures that are there, or went into films.
    pub frames: u64,
    /// Those of them that an earlier run has left.
    pub kept: u64,
    /// Films that are there.
    pub films: usize,
    pub rays: RayCounts,
    /// Whether the job was told to stop.
    pub cancelled: bool,
}

impl Summary {
    /// Adds what was done by another, but its rays.
    fn add(&mut self, other: Summary) {
        self.rendered += other.rendered;
        self.partial += other.partial;
        self.skipped += other.skipped;
        self.frames += other.frames;
        self.kept += other.kept;
        self.films += other.films;
        self.cancelled |= other.cancelled;
    }
}

/// Has `work` done by all who are needed for so many games.
///
/// # Errors
/// Settings of which no picture can be made, threads that cannot be started, and those of `work`.
pub fn with_crew(
    job: &RenderJob,
    task: Task,
    games: usize,
    progress: &dyn Progress,
    work: impl FnOnce(&Run, &mut [Studio]) -> Result<Summary, JobError>,
) -> Result<Summary, JobError> {
    let reach = job.showing.reach(&job.picture.config);
    let mut studios = vec![Studio::new(&job.picture, reach)?];
    let pool = job.picture.pool()?;
    let run = Run::new(job, task, studios[0].bodies().clone(), &pool, progress);
    let shared = Shared::new(run.fingerprints.clone());
    for _ in 1..side_by_side(job, &pool).min(games) {
        studios.push(Studio::new(&job.picture, reach)?);
    }
    if games > 1 {
        studios = studios.into_iter().map(|studio| studio.sharing(&shared)).collect();
    }
    let summary = work(&run, &mut studios)?;
    let rays = studios.iter().fold(RayCounts::default(), |sum, studio| sum + studio.rays());
    Ok(Summary { rays, ..summary })
}

/// How many bytes of memory a pixel takes while its game is traced, and in a picture that waits to be written.
const TRACED: usize = 300;
const PICTURE: usize = 3;

/// Memory for games that are rendered side by side.
const MEMORY: usize = 1 << 30;

/// How many games are rendered at once: as many as there are threads, and as have room.
fn side_by_side(job: &RenderJob, pool: &ThreadPool) -> usize {
    let Config { width, height, .. } = job.picture.config;
    let threads = pool.current_num_threads();
    let bytes_a_pixel = TRACED + Desk::room(threads) * PICTURE;
    let room = MEMORY / (bytes_a_pixel * (width as usize * height as usize).max(1));
    threads.min(room).max(1)
}

/// Stops the others when who holds it breaks down.
struct StopsOthers<'a>(&'a AtomicBool);

impl Drop for StopsOthers<'_> {
    fn drop(&mut self) {
        if thread::panicking() {
            self.0.store(true, Ordering::Relaxed);
        }
    }
}

/// What those who render the games of one file share.
struct Shift<'a, I> {
    batch: &'a Batch,
    /// The games that are to come.
    queue: Mutex<I>,
    report: &'a Mutex<Report>,
}

impl Run<'_> {
    /// Renders games of a file, as many at once as there are `studios`.
    ///
    /// # Errors
    /// Of the first game that could not be rendered; others that were begun are in the report too.
    pub fn batch(
        &self,
        batch: &Batch,
        games: impl Iterator<Item = Result<Entry, JobError>> + Send,
        report: &Mutex<Report>,
        studios: &mut [Studio],
        summary: &mut Summary,
    ) -> Result<(), JobError> {
        let first = report.lock().unwrap_or_else(PoisonError::into_inner).lines();
        let shift = Shift { batch, queue: Mutex::new((first..).zip(games)), report };
        let mut outcome = Ok(());
        thread::scope(|scope| {
            let workers: Vec<_> = studios
                .iter_mut()
                .map(|studio| scope.spawn(|| self.work(&shift, studio)))
                .collect();
            for worker in workers {
                let (part, ended) = worker.join().unwrap_or_else(|panic| resume_unwind(panic));
                summary.add(part);
                if outcome.is_ok() {
                    outcome = ended;
                }
            }
        });
        outcome
    }

    /// Renders game after game until there is none left.
    fn work(
        &self,
        shift: &Shift<impl Iterator<Item = (usize, Result<Entry, JobError>)>>,
        studio: &mut Studio,
    ) -> (Summary, Result<(), JobError>) {
        let mut summary = Summary::default();
        let _stops_others = StopsOthers(&self.has_failed);
        while !self.is_over() {
            let next = shift.queue.lock().unwrap_or_else(PoisonError::into_inner).next();
            let Some((place, entry)) = next else { break };
            let outcome = entry.and_then(|entry| {
                let (line, outcome) = self.entry(shift.batch, &entry, studio, &mut summary);
                let mut report = shift.report.lock().unwrap_or_else(PoisonError::into_inner);
                report.add(place, line).map_err(JobError::from).and(outcome)
            });
            if outcome.is_err() {
                self.has_failed.store(true, Ordering::Relaxed);
                return (summary, outcome);
            }
        }
        summary.cancelled |= self.progress.is_cancelled();
        (summary, Ok(()))
    }

    /// Renders a game and its variations: its line of the report, and what went wrong if anything did.
    fn entry(
        &self,
        batch: &Batch,
        entry: &Entry,
        studio: &mut Studio,
        summary: &mut Summary,
    ) -> (ReportLine, Result<(), JobError>) {
        let Entry { game, part, .. } = entry;
        if part.is_none() {
            summary.skipped += 1;
            return (ReportLine::new(game, Status::Skipped, 0, None), Ok(()));
        }
        let mut all = Rendered::default();
        let mut outcome = Ok(());
        let mut is_whole = true;
        let mut lines = Vec::new();
        let mut before = 0;
        for line in entry.lines(batch) {
            if all.is_cancelled || outcome.is_err() {
                break;
            }
            let mut rendered = Rendered::default();
            outcome = match &self.task {
                Task::Whole | Task::Merge => line.render(self, studio, &mut rendered),
                Task::Shard(task) => {
                    let share = task.shard.of(batch.file, game.number, entry.frames());
                    let places = line.places(before, share);
                    before += line.part.count() as u64;
                    if places.is_empty() {
                        continue;
                    }
                    line.render_share(self, task, places, studio, &mut rendered)
                }
            };
            is_whole &= line.game.is_whole();
            if let Some(name) = line.variation {
                lines.push(VariationLine::new(&line.game, name, rendered.frames));
            }
            all.add(&rendered);
        }
        if self.job.variations {
            let unplayable = entry.unplayable();
            is_whole &= unplayable.is_empty();
            lines.extend(unplayable.into_iter().map(VariationLine::unplayable));
        }
        let status = match outcome {
            Ok(()) if all.is_cancelled => Status::Stopped,
            Ok(()) if is_whole => Status::Rendered,
            Ok(()) => Status::Partial,
            Err(_) => Status::Stopped,
        };
        match status {
            Status::Rendered => summary.rendered += 1,
            _ => summary.partial += 1,
        }
        summary.frames += all.frames;
        summary.kept += all.kept;
        summary.films += all.films;
        let name = game_folder(game);
        let line = ReportLine::new(game, status, all.frames, Some(name)).with(lines);
        let line = match self.task {
            Task::Shard(_) => line.of_shard(batch),
            Task::Whole | Task::Merge => line,
        };
        (line, outcome)
    }
}
