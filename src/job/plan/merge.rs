//! What shards have rendered, as one machine would have left it.

use super::check::batches;
use super::file::Plan;
use super::verify::{Verdict, verify};
use crate::job::crew::Summary;
use crate::job::records::Records;
use crate::job::render::render_batches;
use crate::job::run::{RenderJob, Task};
use crate::job::{JobError, Progress};

/// What came of merging.
#[derive(Clone, Debug)]
pub enum Merged {
    /// Films, manifests and reports are there.
    Done(Summary),
    /// Pictures are missing, so that nothing was written.
    Incomplete(Verdict),
}

/// Makes films, manifests and reports of all pictures of a plan, if they are there and whole, and takes away what only
/// shards needed. `job` is what the plan's arguments stand for.
///
/// # Errors
/// Those of [`verify`], and of rendering.
pub fn merge(plan: &Plan, job: &RenderJob, progress: &dyn Progress) -> Result<Merged, JobError> {
    let verdict = verify(plan, job, progress)?;
    if verdict.cancelled {
        return Ok(Merged::Done(Summary { cancelled: true, ..Summary::default() }));
    }
    if !verdict.faults.is_empty() {
        return Ok(Merged::Incomplete(verdict));
    }
    let batches = batches(plan, job)?;
    let summary =
        render_batches(job, &batches, Task::Merge, progress, |summary| match summary.cancelled {
            true => Ok(()),
            false => Ok(Records::new(&job.out, &plan.head.id).remove()?),
        })?;
    Ok(Merged::Done(summary))
}
