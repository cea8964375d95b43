//! Whole games, as numbered pictures and films in folders.

use std::fs;
use std::iter::Enumerate;
use std::panic::resume_unwind;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;

use rayon::ThreadPool;

use super::batch::{Batch, Entries, Entry, VariationPart, folder_names, game_folder};
use super::desk::Desk;
use super::fingerprint::Fingerprints;
use super::game::{Line, Rendered};
use super::input::Input;
use super::report::{Report, ReportLine, Status, VariationLine};
use super::room::check_room;
use super::run::{RenderJob, Run};
use super::shared::Shared;
use super::studio::Studio;
use super::{JobError, Progress, nothing_selected};
use crate::config::Config;
use crate::output::{FilmFormat, FolderLock, film_name, prepare_inside, remove_temporaries};
use crate::timeline::Bodies;
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

/// Renders games into pictures; each gets a manifest, each file a report.
///
/// All input is looked through before the first picture, and nothing is written if any of it cannot be read
/// at all. Games that can be played only in part are rendered in part. What an earlier run has finished stays, as far as it
/// would come out the same; other numbered pictures in a game's folder are removed, and its variations; where only some
/// frames are wanted, only those are.
///
/// # Errors
/// Input that cannot be read, output that cannot be written, a folder that another run writes to, or a selection without
/// games.
pub fn render(job: &RenderJob, progress: &dyn Progress) -> Result<Summary, JobError> {
    let config = &job.picture.config;
    let batches = survey(job, progress)?;
    say_films(job, progress);
    let reach = job.showing.reach(config);
    let mut studios = vec![Studio::new(&job.picture, reach)?];
    let bodies = studios[0].bodies().clone();
    for batch in &batches {
        keep_out(job, &job.out.join(&batch.folder))?;
    }
    let frames = batches.iter().map(|batch| batch.frames).sum();
    check_room(job, frames)?;
    // From here on a signal ends the run in an orderly way.
    progress.begin(frames);
    let mut locks = Vec::new();
    for batch in &batches {
        let folder = prepare_inside(&job.out, &batch.folder)?;
        locks.push(FolderLock::take(&folder)?);
        remove_temporaries(&folder)?;
    }
    let pool = job.picture.pool()?;
    let fingerprints = Fingerprints::new(&job.picture, reach);
    let shared = Shared::new(fingerprints.clone());
    let most = batches.iter().map(|batch| batch.games).max().unwrap_or(1);
    for _ in 1..side_by_side(job, &pool).min(most) {
        studios.push(Studio::new(&job.picture, reach)?);
    }
    if batches.iter().map(|batch| batch.games).sum::<usize>() > 1 {
        studios = studios.into_iter().map(|studio| studio.sharing(&shared)).collect();
    }
    let run = Run {
        job,
        script: job.showing.script(config, bodies),
        progress,
        pool: &pool,
        fingerprints,
        has_failed: AtomicBool::new(false),
    };
    if job.refuses_old {
        batches.iter().try_for_each(|batch| run.keep_old(batch))?;
    }
    let mut summary = Summary::default();
    for batch in &batches {
        if !summary.cancelled {
            run.batch(batch, &mut studios, &mut summary)?;
        }
    }
    summary.rays = studios.iter().fold(RayCounts::default(), |sum, studio| sum + studio.rays());
    Ok(summary)
}

/// Looks through all input: the files that have games that are wanted.
///
/// # Errors
/// When there is none, or one cannot be read.
pub fn survey(job: &RenderJob, progress: &dyn Progress) -> Result<Vec<Batch>, JobError> {
    // How many frames there are does not depend on the room that pieces take.
    let script = job.showing.script(&job.picture.config, Bodies::default());
    let mut room = job.wanted.limit.unwrap_or(usize::MAX);
    let (mut batches, mut seen) = (Vec::new(), 0);
    for (path, folder) in job.inputs.iter().zip(folder_names(&job.inputs)) {
        if room == 0 {
            break;
        }
        let input = Input::new(path)?;
        let batch = Batch::survey(job, &script, input, folder.into(), room, progress)?;
        room -= batch.games;
        seen += batch.seen;
        if batch.games > 0 {
            batches.push(batch);
        }
    }
    if batches.is_empty() {
        return Err(nothing_selected(&job.inputs, seen));
    }
    Ok(batches)
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

/// Tells of films that are smaller than their pictures, and who makes them.
fn say_films(job: &RenderJob, progress: &dyn Progress) {
    if job.films.formats.contains(&FilmFormat::Mp4) {
        progress.detail(&match &job.films.ffmpeg {
            Some(ffmpeg) => format!("mp4 by {ffmpeg}"),
            None => "mp4 by the encoder inside".to_owned(),
        });
    }
    let Config { width, height, .. } = job.picture.config;
    for format in &job.films.formats {
        let [columns, rows] = format.size([width, height]);
        if [columns, rows] != [width, height] {
            let name = film_name(*format, None);
            progress.say(&format!(
                "{name}: is {columns}x{rows} instead of {width}x{height}, its sides are even"
            ));
        }
    }
}

/// Refuses to write into a folder that holds what is read: a game, the settings, a picture, a set.
fn keep_out(job: &RenderJob, folder: &Path) -> Result<(), JobError> {
    let Ok(folder) = fs::canonicalize(folder) else {
        return Ok(());
    };
    let of_pictures = job.picture.inputs();
    let mut inputs = job.inputs.iter().chain(&of_pictures);
    let lies_within =
        |input: &&PathBuf| fs::canonicalize(input).is_ok_and(|input| input.starts_with(&folder));
    match inputs.find(lies_within) {
        Some(input) => Err(JobError::InputInOutput { path: input.clone() }),
        None => Ok(()),
    }
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
struct Shift<'a> {
    batch: &'a Batch,
    /// The games that are to come, with their places.
    queue: Mutex<Enumerate<Entries<'a>>>,
    report: Mutex<Report>,
}

impl Run<'_> {
    /// Renders the games of a file, as many at once as there are `studios`; the report tells of all that were begun, even
    /// where one fails.
    fn batch(
        &self,
        batch: &Batch,
        studios: &mut [Studio],
        summary: &mut Summary,
    ) -> Result<(), JobError> {
        let shift = Shift {
            batch,
            queue: Mutex::new(batch.entries(self.job, &self.script)?.enumerate()),
            report: Mutex::new(Report::begin(&self.job.out.join(&batch.folder))?),
        };
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
        let report = shift.report.into_inner().unwrap_or_else(PoisonError::into_inner);
        let written = report.finish();
        outcome?;
        Ok(written?)
    }

    /// Refuses to replace what is of other settings or other games, before anything is written.
    fn keep_old(&self, batch: &Batch) -> Result<(), JobError> {
        for entry in batch.entries(self.job, &self.script)? {
            let Entry { game, part, variations } = &entry?;
            let Some(part) = part else { continue };
            let (file, folder) = (&batch.input.name, &batch.folder.join(game_folder(game)));
            Line { file, game, part, folder, variation: None, variations }.keep_old(self)?;
            for VariationPart { path, folder: name, part } in variations {
                let Some(game) = &game.with_variation(path) else { continue };
                let variation = Some(name.as_path());
                Line { file, game, part, folder, variation, variations }.keep_old(self)?;
            }
        }
        Ok(())
    }

    /// Renders game after game until there is none left.
    fn work(&self, shift: &Shift, studio: &mut Studio) -> (Summary, Result<(), JobError>) {
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
        let Entry { game, part, variations } = entry;
        let Some(part) = part else {
            summary.skipped += 1;
            return (ReportLine::new(game, Status::Skipped, 0, None), Ok(()));
        };
        let name = game_folder(game);
        let folder = &batch.folder.join(&name);
        let file = &batch.input.name;
        let mut all = Rendered::default();
        let line = Line { file, game, part, folder, variation: None, variations };
        let mut outcome = line.render(self, studio, &mut all);
        let mut is_whole = game.is_whole();
        let mut lines = Vec::new();
        for VariationPart { path, folder: name, part } in variations {
            if all.is_cancelled || outcome.is_err() {
                break;
            }
            let Some(game) = &game.with_variation(path) else { continue };
            let mut rendered = Rendered::default();
            let line = Line { file, game, part, folder, variation: Some(name), variations };
            outcome = line.render(self, studio, &mut rendered);
            is_whole &= game.is_whole();
            lines.push(VariationLine::new(game, name, rendered.frames));
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
        (ReportLine::new(game, status, all.frames, Some(name)).with(lines), outcome)
    }
}
