//! One shard of a plan.

use std::sync::{Mutex, PoisonError};

use super::check::{batches, check};
use super::file::{Plan, PlanError};
use super::records::Records;
use crate::job::batch::{Batch, Entry};
use crate::job::crew::{Summary, with_crew};
use crate::job::render::keep_out;
use crate::job::report::Report;
use crate::job::run::{RenderJob, ShardTask, Task};
use crate::job::{JobError, Progress};
use crate::output::{FolderLock, prepare_inside};

/// Renders shard `number` of a plan, where `job` is what the plan's arguments stand for. What is there already stays.
///
/// # Errors
/// A plan that does not fit what it was made of, output of another plan, and those of rendering.
pub fn render_shard(
    plan: &Plan,
    job: &RenderJob,
    number: usize,
    progress: &dyn Progress,
) -> Result<Summary, JobError> {
    let shard = plan.shard(number)?;
    // What others read is theirs to look at.
    check(plan, job, shard.begin.file..=shard.end.file)?;
    let records = Records::new(&job.out, &plan.head.id);
    // The range of games alone says where the shard ends.
    let part = |batch: Batch| {
        let wanted = job.wanted.between(shard.games(batch.file))?;
        Some((Batch { games: usize::MAX, ..batch }, RenderJob { wanted, ..job.clone() }))
    };
    let parts: Vec<_> = batches(plan, job)?.into_iter().filter_map(part).collect();
    let games = parts.iter().map(|(batch, _)| shard.games(batch.file).len()).max().unwrap_or(0);
    let task = Task::Shard(ShardTask { shard, sums: records.sums(number) });
    with_crew(job, task, games, progress, |run, studios| {
        for (batch, _) in &parts {
            keep_out(job, &job.out.join(&batch.folder))?;
        }
        records.claim()?;
        progress.begin(shard.frames);
        let mut locks = Vec::new();
        for (batch, _) in &parts {
            locks.push(FolderLock::share(&prepare_inside(&job.out, &batch.folder)?)?);
        }
        let report = Mutex::new(Report::begin(&records.report(number))?);
        let mut summary = Summary::default();
        let mut outcome = Ok(());
        for (batch, job) in &parts {
            let has_frames =
                |entry: &Entry| !shard.of(batch.file, entry.game.number, entry.frames()).is_empty();
            let entries = batch.entries(job, &run.script)?;
            let games = entries.filter(|entry| entry.as_ref().map_or(true, has_frames));
            outcome = run.batch(batch, games, &report, studios, &mut summary);
            if outcome.is_err() {
                break;
            }
        }
        // It tells of all games that were begun, even where one fails.
        let written = report.into_inner().unwrap_or_else(PoisonError::into_inner).finish();
        outcome?;
        written?;
        let (found, expected) = (summary.frames, shard.frames);
        if found != expected && !summary.cancelled {
            return Err(PlanError::Misfit { name: plan.name.clone(), found, expected }.into());
        }
        Ok(summary)
    })
}
