//! From a job to a plan: what there is to do, what that takes, and where it is cut.

use std::cell::LazyCell;
use std::env;
use std::fs;
use std::io;
use std::path::{Component, Path, PathBuf};

use sha2::{Digest, Sha256};

use super::cut::{Cutter, Seam};
use super::error::PlanError;
use super::file::{Head, Plan, PlannedInput};
use crate::job::batch::{Batch, Entry};
use crate::job::estimate::measure;
use crate::job::fingerprint::Fingerprints;
use crate::job::input::read_through;
use crate::job::records::{Records, has_shards};
use crate::job::render::{keep_out, survey};
use crate::job::room::check_room;
use crate::job::run::RenderJob;
use crate::job::share::Place;
use crate::job::studio::bodies;
use crate::job::subject::keep_files;
use crate::job::{Estimate, JobError, Progress};
use crate::output::{OutputError, prepare_file};
use crate::text::shown;
use crate::timeline::Script;

/// As many tasks as Slurm's arrays have room for, with its usual settings.
pub const MOST_SHARDS: usize = 1000;

/// So many seconds of work a shard is to have, where nobody says how many there are to be.
const SHARE: f64 = 300.0;

/// What a plan came to.
#[derive(Clone, Debug)]
pub struct PlanSummary {
    pub shards: usize,
    /// Frames of the smallest shard and of the largest one.
    pub smallest: u64,
    pub largest: u64,
    /// Shards that begin within a line of play, and those of them that begin within a move.
    pub within_lines: usize,
    pub within_moves: usize,
    /// What one machine would take for all.
    pub estimate: Estimate,
    /// What the cuts cost more than that at most, in seconds of one machine: a whole picture each, which the machine might
    /// have had to make there anyway.
    pub cost: f64,
}

/// Makes a plan of `job`, which `arguments` stand for, and writes it to `output`. Where nobody says how many `shards`,
/// there are as many as have some minutes of work each, by a quick measurement.
///
/// # Errors
/// As for rendering, as far as they show before the first picture; input that is no file.
pub fn plan(
    job: &RenderJob,
    arguments: Vec<String>,
    output: &Path,
    shards: Option<usize>,
    progress: &dyn Progress,
) -> Result<PlanSummary, JobError> {
    refuse_unfit(job, output)?;
    let batches = survey(job, progress)?;
    keep_out(job, &batches)?;
    check_room(job, batches.iter().map(|batch| batch.frames).sum())?;
    let estimate = measure(job, &batches)?;
    let suits = (estimate.seconds / SHARE).ceil().clamp(1.0, MOST_SHARDS as f64) as usize;
    let most = usize::try_from(estimate.frames).unwrap_or(usize::MAX).max(1);
    let shards = shards.unwrap_or(suits.min(most));

    let reach = job.showing.reach(&job.picture.config);
    let settings = settings_of(&Fingerprints::new(&job.picture, reach));
    let script = job.showing.script(&job.picture.config, bodies(&job.picture)?);
    let mut inputs = job.inputs.iter().map(|path| input(path)).collect::<Result<Vec<_>, _>>()?;
    for batch in &batches {
        (inputs[batch.file].games, inputs[batch.file].frames) = (batch.games, batch.frames);
    }
    let Cuts { begins, seams, end } = cut(job, &batches, &script, estimate.frames, shards)?;
    let failed = |error| OutputError { path: output.to_owned(), error };
    prepare_file(output)?;
    let folder = way(output).map_err(failed)?;
    let folder = folder.to_str().ok_or_else(|| PlanError::Name(shown(&folder)))?.to_owned();
    let head = Head {
        folder,
        arguments,
        is_by_ffmpeg: job.is_by_ffmpeg(),
        settings,
        inputs,
        frames: estimate.frames,
        shards,
        end,
        ..Head::default()
    };
    let plan = Plan::new(output, head, &begins).map_err(failed)?;
    if let Some(folder) = has_shards(&job.out)
        && Records::new(&job.out, &plan.head.id).refuse_others().is_err()
    {
        return Err(PlanError::NotMerged { folder }.into());
    }
    plan.write(output)?;
    if !job.films.formats.is_empty() && !job.format().is_exact() {
        progress.say(
            "films are made of exact pictures: merging will trace them anew, all on one machine",
        );
    }

    let sizes = || plan.shards.iter().map(|shard| shard.frames);
    let count = |seam| seams.iter().filter(|found| **found == seam).count();
    let within_lines = count(Seam::Position) + count(Seam::Frame);
    let more = (estimate.whole_seconds - estimate.other_seconds).max(0.0);
    Ok(PlanSummary {
        shards,
        smallest: sizes().min().unwrap_or(0),
        largest: sizes().max().unwrap_or(0),
        within_lines,
        within_moves: if job.showing.animate { count(Seam::Frame) } else { 0 },
        estimate,
        cost: within_lines as f64 * more,
    })
}

/// Refuses input that cannot be read again, and output that cannot be written.
fn refuse_unfit(job: &RenderJob, output: &Path) -> Result<(), JobError> {
    // Of what is not there, or is a folder, reading tells.
    let is_stream = |input: &&PathBuf| {
        let is_other = |data: fs::Metadata| !data.is_file() && !data.is_dir();
        *input == Path::new("-") || fs::metadata(input).is_ok_and(is_other)
    };
    if let Some(stream) = job.inputs.iter().find(is_stream) {
        return Err(PlanError::Stream(shown(stream)).into());
    }
    keep_files(&job.inputs, &job.picture, output)?;
    // What is there is another plan, or nothing of ours.
    if output.is_file() && matches!(Plan::read(output), Err(PlanError::NoPlan { .. })) {
        return Err(PlanError::InTheWay { name: shown(output) }.into());
    }
    if job.out.exists() && !job.out.is_dir() {
        let error = io::ErrorKind::NotADirectory.into();
        return Err(OutputError { path: job.out.clone(), error }.into());
    }
    Ok(())
}

/// What stands in a plan for all settings of pictures.
pub(super) fn settings_of(fingerprints: &Fingerprints) -> String {
    fingerprints.of(&"plan")
}

fn input(path: &Path) -> Result<PlannedInput, JobError> {
    let (bytes, sha256) = hashed(path)
        .map_err(|error| PlanError::Io { name: shown(path), error })
        .map_err(JobError::from)?;
    let text = path.to_str().ok_or_else(|| PlanError::Name(shown(path)))?;
    Ok(PlannedInput { path: text.to_owned(), bytes, sha256, games: 0, frames: 0 })
}

/// The number of bytes of a file, and their hash.
pub(super) fn hashed(path: &Path) -> io::Result<(u64, String)> {
    let mut hash = Sha256::new();
    let bytes = read_through(path, |bytes| hash.update(bytes))?;
    let text = hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect();
    Ok((bytes, text))
}

/// Where shards begin.
#[derive(Default)]
struct Cuts {
    /// After how many frames of all, and in which place.
    begins: Vec<(u64, Place)>,
    /// What all but the first begin with.
    seams: Vec<Seam>,
    /// Behind all frames.
    end: Place,
}

fn cut(
    job: &RenderJob,
    batches: &[Batch],
    script: &Script,
    frames: u64,
    shards: usize,
) -> Result<Cuts, JobError> {
    let mut cutter = Cutter::new(frames, shards);
    let mut found = Cuts::default();
    // Frames before the line in hand, and cuts whose places are not known yet.
    let mut before = 0;
    let mut cuts = vec![0];
    for batch in batches {
        for entry in batch.entries(job, script)? {
            let entry = entry?;
            let Entry { game, .. } = &entry;
            let begin = before;
            for line in entry.lines(batch) {
                let end = before + line.part.count() as u64;
                // Few lines have a cut within them.
                let laid_out = LazyCell::new(|| {
                    let indices: Vec<usize> = line.part.frames().map(|(index, _)| index).collect();
                    Some((line.timeline(script).ok()?, indices))
                });
                let ply = |at: u64| {
                    let (timeline, indices) = laid_out.as_ref()?;
                    Some(timeline.frame(*indices.get((at - before) as usize)?).ply)
                };
                let stands = |at: u64| at > before && ply(at) != ply(at - 1);
                for (at, seam) in cutter.cut(before..end, stands) {
                    cuts.push(at);
                    found.seams.push(seam);
                }
                before = end;
                let place = |at| Place { file: batch.file, game: game.number, frame: at - begin };
                let known = cuts.partition_point(|at| *at < end);
                found.begins.extend(cuts.drain(..known).map(|at| (at, place(at))));
                found.end = place(end);
            }
        }
    }
    // Of games that cannot be shown there is nothing to cut, and yet a report.
    found.begins.resize(shards, (frames, found.end));
    Ok(found)
}

/// From the folder of `output` to the one where we are.
fn way(output: &Path) -> io::Result<PathBuf> {
    let folder = output.parent().filter(|folder| !folder.as_os_str().is_empty());
    let from = fs::canonicalize(folder.unwrap_or(Path::new(".")))?;
    Ok(between(&from, &fs::canonicalize(env::current_dir()?)?))
}

/// From one absolute folder to another.
fn between(from: &Path, to: &Path) -> PathBuf {
    let (mut from, mut to) = (from.components().peekable(), to.components().peekable());
    while from.peek().is_some() && from.peek() == to.peek() {
        from.next();
        to.next();
    }
    // Another drive is reached by its name alone.
    let is_elsewhere = matches!(to.peek(), Some(Component::Prefix(_)));
    let up = from.filter(|_| !is_elsewhere).map(|_| Component::ParentDir);
    up.chain(to).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_way_from_a_folder_to_another() {
        for (from, to, expected) in [
            ("/a/b", "/a/b", ""),
            ("/a/b/plans", "/a/b", ".."),
            ("/a", "/a/b/c", "b/c"),
            ("/a/x/y", "/a/b", "../../b"),
            ("/x", "/", ".."),
        ] {
            assert_eq!(between(Path::new(from), Path::new(to)), Path::new(expected));
        }
    }
}
