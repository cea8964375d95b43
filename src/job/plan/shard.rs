//! One shard of a plan.

use std::sync::{Mutex, PoisonError};

use super::check::{batches, check};
use super::error::PlanError;
use super::file::Plan;
use super::verify::Look;
use crate::game::Wanted;
use crate::job::batch::{Batch, Entry};
use crate::job::crew::{Summary, with_crew};
use crate::job::records::Records;
use crate::job::render::keep_out;
use crate::job::report::Report;
use crate::job::run::{RenderJob, Run, ShardTask, Task};
use crate::job::share::Shard;
use crate::job::studio::Studio;
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
    check(plan, job, shard.files())?;
    let records = Records::new(&job.out, &plan.head.id);
    // The range of games alone says where the shard ends.
    let part = |batch: Batch| {
        let wanted = job.wanted.between(shard.games(batch.file))?;
        Some((Batch { games: usize::MAX, ..batch }, wanted))
    };
    let parts: Vec<_> = batches(plan, job)?.into_iter().filter_map(part).collect();
    let games = parts.iter().map(|(batch, _)| shard.games(batch.file).len()).max().unwrap_or(0);
    let task = ShardTask { shard, sums: records.sums(number), ledger: records.ledger(number) };
    with_crew(job, Task::Shard(task), games, progress, |run, studios| {
        keep_out(job, parts.iter().map(|(batch, _)| batch))?;
        records.refuse_others()?;
        progress.begin(shard.frames);
        // Behind a merge, or over what another run has left, it is looked first: what is done already leaves nothing
        // behind, and what is another's is refused before anything is written.
        let is_new = !records.are_there() && job.out.is_dir();
        if is_new && Look::new(plan, run, &records).is_done(number, &parts)? {
            let frames = shard.frames;
            return Ok(Summary { frames, kept: frames, ..Summary::default() });
        }
        let mut locks = Vec::new();
        for (batch, _) in &parts {
            locks.push(FolderLock::share(&prepare_inside(&job.out, &batch.folder)?)?);
        }
        records.claim()?;
        // Of two plans that begin at once, one at least sees the other.
        records.refuse_others().inspect_err(|_| records.take_back())?;
        let mut summary = Summary::default();
        let report = Report::begin(&records.report(number))?;
        run.shard(shard, &parts, report, studios, &mut summary)?;
        let (found, expected) = (summary.frames, shard.frames);
        if found != expected && !summary.cancelled {
            return Err(PlanError::Misfit { name: plan.name.clone(), found, expected }.into());
        }
        Ok(summary)
    })
}

impl Run<'_> {
    /// Renders what `shard` has of the games of each file.
    fn shard(
        &self,
        shard: Shard,
        parts: &[(Batch, Wanted)],
        report: Report,
        studios: &mut [Studio],
        summary: &mut Summary,
    ) -> Result<(), JobError> {
        let report = Mutex::new(report);
        let outcome = parts.iter().try_for_each(|(batch, wanted)| {
            let has_frames =
                |entry: &Entry| !shard.of(batch.file, entry.game.number, entry.frames()).is_empty();
            let entries = batch.entries_of(self.job, &self.script, wanted)?;
            let games = entries.filter(|entry| entry.as_ref().map_or(true, has_frames));
            self.batch(batch, games, &report, studios, summary)
        });
        // It tells of all games that were begun, even where one fails.
        let written = report.into_inner().unwrap_or_else(PoisonError::into_inner).finish();
        outcome?;
        Ok(written?)
    }
}
