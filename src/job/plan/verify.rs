//! Whether all pictures of a plan are there, and whole.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use rayon::prelude::*;

use super::check::{batches, check};
use super::file::{Place, Plan, PlanError};
use super::part::Witness;
use super::records::{Records, Sums};
use crate::job::batch::{Batch, Entry};
use crate::job::crew::{Summary, with_crew};
use crate::job::run::{RenderJob, Run, Task};
use crate::job::{JobError, Progress};

/// What there is of a plan's pictures.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Verdict {
    pub frames: u64,
    /// In the order of the plan.
    pub faults: Vec<Fault>,
    /// Whether it was told to stop.
    pub cancelled: bool,
}

/// Pictures that are not as they should be, one behind the other.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    pub shard: usize,
    /// Within the folder of all output.
    pub folder: PathBuf,
    /// The numbers in the names of the first and of the last.
    pub first: usize,
    pub last: usize,
    pub missing: Missing,
}

/// What is wrong with a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Missing {
    /// There is none.
    Missing,
    /// It is not whole, or another one than it should be.
    Broken,
}

impl Verdict {
    /// The numbers of shards that are not done, in their order.
    pub fn shards(&self) -> Vec<usize> {
        let mut shards: Vec<usize> = self.faults.iter().map(|fault| fault.shard).collect();
        shards.sort_unstable();
        shards.dedup();
        shards
    }

    /// How many pictures are not as they should be.
    pub fn bad(&self) -> u64 {
        self.faults.iter().map(|fault| (fault.last - fault.first + 1) as u64).sum()
    }
}

/// Looks at all pictures of a plan, where `job` is what its arguments stand for. Nothing is written.
///
/// # Errors
/// A plan that does not fit what it was made of, output of another plan, input that cannot be read.
pub fn verify(plan: &Plan, job: &RenderJob, progress: &dyn Progress) -> Result<Verdict, JobError> {
    check(plan, job, 0..=plan.head.inputs.len())?;
    let records = Records::new(&job.out, &plan.head.id);
    records.refuse_others()?;
    let batches = batches(plan, job)?;
    let mut verdict = Verdict::default();
    with_crew(job, Task::Verify, 1, progress, |run, _| {
        progress.begin(plan.head.frames);
        for batch in &batches {
            let look = Look { plan, run, batch, records: &records, told: Mutex::default() };
            verdict.faults.extend(look.faults()?);
        }
        Ok(Summary::default())
    })?;
    verdict.frames = plan.head.frames;
    verdict.cancelled = progress.is_cancelled();
    Ok(verdict)
}

/// A look at the pictures of one file of games.
struct Look<'a> {
    plan: &'a Plan,
    run: &'a Run<'a>,
    batch: &'a Batch,
    records: &'a Records,
    /// What the last few shards have told.
    told: Mutex<BTreeMap<usize, Arc<Sums>>>,
}

/// So many shards may have a part of the games that are looked at at once, or nearly.
const KEPT: usize = 8;

impl Look<'_> {
    /// What a shard has told of its pictures, where they do not tell themselves.
    fn sums(&self, shard: usize) -> Arc<Sums> {
        if self.run.job.format().is_sealed() {
            return Arc::default();
        }
        let mut told = self.told.lock().unwrap_or_else(PoisonError::into_inner);
        let sums = told.entry(shard).or_insert_with(|| Arc::new(self.records.sums(shard))).clone();
        while told.len() > KEPT {
            // Games come in their order, or nearly.
            told.pop_first();
        }
        sums
    }

    fn faults(&self) -> Result<Vec<Fault>, JobError> {
        let Look { plan, run, batch, .. } = self;
        let games = batch.entries(run.job, &run.script)?;
        let games = games.take_while(|_| !run.is_over()).enumerate();
        let (frames, mut found) = run
            .pool
            .install(|| {
                games
                    .par_bridge()
                    .map(|(place, entry)| {
                        let entry = entry?;
                        Ok((entry.frames(), vec![(place, self.of_game(&entry)?)]))
                    })
                    .try_reduce(
                        || (0, Vec::new()),
                        |(frames, mut found), (more, others)| {
                            found.extend(
                                others.into_iter().filter(|(_, faults)| !faults.is_empty()),
                            );
                            Ok((frames + more, found))
                        },
                    )
            })
            .map_err(|error: JobError| error)?;
        if frames != batch.frames && !run.is_over() {
            let (name, expected) = (plan.name.clone(), batch.frames);
            return Err(PlanError::Misfit { name, found: frames, expected }.into());
        }
        found.sort_unstable_by_key(|(place, _)| *place);
        Ok(found.into_iter().flat_map(|(_, faults)| faults).collect())
    }

    /// What is wrong with pictures of one game.
    fn of_game(&self, entry: &Entry) -> Result<Vec<Fault>, JobError> {
        let Look { plan, run, batch, .. } = self;
        let place = |frame| Place { file: batch.file, game: entry.game.number, frame };
        let mut faults: Vec<Fault> = Vec::new();
        let mut before = 0;
        for line in entry.lines(batch) {
            if line.is_filmed(run)? {
                let frames = line.part.count() as u64;
                (0..frames).for_each(|_| run.progress.frame_done());
                before += frames;
                continue;
            }
            let layout = line.lay_out(run)?;
            let inside = line.inside();
            let frames = layout.planned.len() as u64;
            let mut begin = 0;
            // Shard by shard: each has records of its own.
            while begin < frames {
                let number = plan.shard_of(place(before + begin));
                let end = plan.shard(number)?.of(batch.file, entry.game.number, u64::MAX).end;
                let end = (end - before).min(frames);
                let sums = self.sums(number);
                let witness = Witness::new(run.job, &inside, &sums);
                let pictures = layout.planned[begin as usize..end as usize].par_iter();
                let missing: Vec<_> = pictures
                    .filter(|_| !run.is_over())
                    .filter_map(|planned| {
                        run.progress.frame_done();
                        let is_good = witness.vouches(&planned.row);
                        (!is_good).then(|| {
                            let path = planned.row.file().map(|file| layout.folder.join(file));
                            (planned.number, what(path.as_deref()))
                        })
                    })
                    .collect();
                for (picture, missing) in missing {
                    let fault = Fault {
                        shard: number,
                        folder: inside.clone(),
                        first: picture,
                        last: picture,
                        missing,
                    };
                    add(&mut faults, fault);
                }
                begin = end;
            }
            before += frames;
        }
        Ok(faults)
    }
}

/// What is wrong with a picture for which nobody vouches.
fn what(path: Option<&Path>) -> Missing {
    match path.is_some_and(|path| path.symlink_metadata().is_ok()) {
        true => Missing::Broken,
        false => Missing::Missing,
    }
}

/// Adds a picture, to those before it if it follows them.
fn add(faults: &mut Vec<Fault>, fault: Fault) {
    match faults.last_mut() {
        Some(last)
            if last.last + 1 == fault.first
                && (last.shard, &last.folder, last.missing)
                    == (fault.shard, &fault.folder, fault.missing) =>
        {
            last.last = fault.last;
        }
        _ => faults.push(fault),
    }
}
