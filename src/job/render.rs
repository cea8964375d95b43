//! Whole games, as numbered pictures and films in folders.

use std::fs;
use std::sync::{Mutex, PoisonError};

use super::batch::{Batch, Entry, folder_names};
use super::crew::{Summary, with_crew};
use super::input::Input;
use super::plan::PlanError;
use super::records::has_shards;
use super::report::Report;
use super::room::check_room;
use super::run::{RenderJob, Run, Task};
use super::{JobError, Progress, nothing_selected};
use crate::config::Config;
use crate::output::{FilmFormat, FolderLock, film_name, prepare_inside, remove_temporaries};
use crate::timeline::Bodies;

/// Renders games into pictures; each gets a manifest, each file a report.
///
/// All input is looked through before the first picture, and nothing is written if any of it cannot be read
/// at all. Games that can be played only in part are rendered in part. What an earlier run has finished stays, as far as it
/// would come out the same; other numbered pictures in a game's folder are removed, and its variations; where only some
/// frames are wanted, only those are.
///
/// # Errors
/// Input that cannot be read, output that cannot be written, a folder that another run writes to, or that has shards of a
/// plan, or a selection without games.
pub fn render(job: &RenderJob, progress: &dyn Progress) -> Result<Summary, JobError> {
    if let Some(folder) = has_shards(&job.out) {
        return Err(PlanError::NotMerged { folder }.into());
    }
    let batches = survey(job, progress)?;
    render_batches(job, &batches, Task::Whole, progress, |_| Ok(()))
}

/// Renders what is wanted of files that were looked through, as [`render`] does; then does what is to be done `at_end`,
/// while nobody else may write there.
///
/// # Errors
/// As for [`render`].
pub fn render_batches(
    job: &RenderJob,
    batches: &[Batch],
    task: Task,
    progress: &dyn Progress,
    at_end: impl FnOnce(&Summary) -> Result<(), JobError>,
) -> Result<Summary, JobError> {
    say_films(job, progress);
    let games = batches.iter().map(|batch| batch.games).sum();
    with_crew(job, task, games, progress, |run, studios| {
        keep_out(job, batches)?;
        let frames = batches.iter().map(|batch| batch.frames).sum();
        check_room(job, frames)?;
        // From here on a signal ends the run in an orderly way.
        progress.begin(frames);
        let mut locks = Vec::new();
        for batch in batches {
            let folder = prepare_inside(&job.out, &batch.folder)?;
            locks.push(FolderLock::take(&folder)?);
            remove_temporaries(&folder)?;
        }
        if job.refuses_old {
            batches.iter().try_for_each(|batch| run.keep_old(batch))?;
        }
        let mut summary = Summary::default();
        for batch in batches {
            if summary.cancelled {
                break;
            }
            let report = Mutex::new(Report::anew(&job.out.join(&batch.folder))?);
            let entries = batch.entries(job, &run.script)?;
            let outcome = run.batch(batch, entries, &report, studios, &mut summary);
            // It tells of all games that were begun, even where one fails.
            let written = report.into_inner().unwrap_or_else(PoisonError::into_inner).finish();
            outcome?;
            written?;
        }
        at_end(&summary)?;
        Ok(summary)
    })
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
    for (file, (path, folder)) in job.inputs.iter().zip(folder_names(&job.inputs)).enumerate() {
        if room == 0 {
            break;
        }
        let input = Input::new(path)?;
        let batch = Batch { file, input, folder: folder.into(), games: room, frames: 0, seen: 0 };
        let batch = batch.survey(job, &script, progress)?;
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

/// Refuses to write into folders that hold what is read: a game, the settings, a picture, a set.
///
/// # Errors
/// When they do.
pub fn keep_out<'a>(
    job: &RenderJob,
    batches: impl IntoIterator<Item = &'a Batch>,
) -> Result<(), JobError> {
    let of_pictures = job.picture.inputs();
    let inputs = job.inputs.iter().chain(&of_pictures);
    let inputs: Vec<_> =
        inputs.filter_map(|input| Some((fs::canonicalize(input).ok()?, input))).collect();
    for batch in batches {
        let Ok(folder) = fs::canonicalize(job.out.join(&batch.folder)) else { continue };
        if let Some((_, input)) = inputs.iter().find(|(place, _)| place.starts_with(&folder)) {
            return Err(JobError::InputInOutput { path: (*input).clone() });
        }
    }
    Ok(())
}

impl Run<'_> {
    /// Refuses to replace what is of other settings or other games, before anything is written.
    fn keep_old(&self, batch: &Batch) -> Result<(), JobError> {
        for entry in batch.entries(self.job, &self.script)? {
            let entry: Entry = entry?;
            entry.lines(batch).try_for_each(|line| line.keep_old(self))?;
        }
        Ok(())
    }
}
