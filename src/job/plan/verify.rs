//! Whether all pictures of a plan are there, and whole.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use rayon::prelude::*;

use super::check::{batches, check};
use super::error::PlanError;
use super::file::Plan;
use super::part::Witness;
use crate::game::Wanted;
use crate::job::batch::{Batch, Entry};
use crate::job::layout::Layout;
use crate::job::line::Line;
use crate::job::records::{Records, Sums};
use crate::job::run::{RenderJob, Run, Task};
use crate::job::share::Place;
use crate::job::studio::bodies;
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
    pub flaw: Flaw,
}

/// What is wrong with a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flaw {
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
    check(plan, job, 0..plan.head.inputs.len())?;
    let records = Records::new(&job.out, &plan.head.id);
    records.refuse_others()?;
    let pool = job.picture.pool()?;
    let run = Run::new(job, Task::Whole, bodies(&job.picture)?, &pool, progress);
    // As shards see it.
    let run = &Run { names: Some(job.names_of_shards()), ..run };
    let look = Look::new(plan, run, &records);
    let mut verdict = Verdict { frames: plan.head.frames, ..Verdict::default() };
    progress.begin(plan.head.frames);
    for batch in &batches(plan, job)? {
        verdict.faults.extend(look.faults(batch)?);
    }
    verdict.cancelled = progress.is_cancelled();
    Ok(verdict)
}

/// A look at the pictures of a plan.
pub struct Look<'a> {
    plan: &'a Plan,
    run: &'a Run<'a>,
    records: &'a Records,
    /// What the last few shards have told.
    told: Mutex<BTreeMap<usize, Arc<Sums>>>,
}

/// So many shards may have a part of the games that are looked at at once, or nearly.
const KEPT: usize = 8;

impl<'a> Look<'a> {
    /// By a run that names pictures as shards do.
    pub fn new(plan: &'a Plan, run: &'a Run<'a>, records: &'a Records) -> Look<'a> {
        Look { plan, run, records, told: Mutex::default() }
    }

    /// Whether all pictures of a shard are there, which has some of the games that are wanted of such files. All of them are
    /// looked at, so that nothing of another's is found later.
    ///
    /// # Errors
    /// Those of [`verify`].
    pub fn is_done(&self, shard: usize, parts: &[(Batch, Wanted)]) -> Result<bool, JobError> {
        let mut is_done = true;
        for (batch, wanted) in parts {
            for entry in batch.entries_of(self.run.job, &self.run.script, wanted)? {
                let entry = entry?;
                let faults = self.run.pool.install(|| self.of_game(batch, &entry))?;
                is_done &= faults.iter().all(|fault| fault.shard != shard);
            }
        }
        Ok(is_done)
    }

    /// What is wrong with pictures of games of a file.
    fn faults(&self, batch: &Batch) -> Result<Vec<Fault>, JobError> {
        let Look { plan, run, .. } = self;
        let games = batch.entries(run.job, &run.script)?;
        let games = games.take_while(|_| !run.is_over()).enumerate();
        type Found = (u64, Vec<(usize, Vec<Fault>)>);
        let found: Result<Found, JobError> = run.pool.install(|| {
            games
                .par_bridge()
                .map(|(place, entry)| {
                    let entry = entry?;
                    let faults = self.of_game(batch, &entry)?;
                    (0..entry.frames()).for_each(|_| run.progress.frame_done());
                    let faults = Some((place, faults)).filter(|(_, faults)| !faults.is_empty());
                    Ok((entry.frames(), faults.into_iter().collect()))
                })
                .try_reduce(Found::default, |(frames, mut found), (more, others)| {
                    found.extend(others);
                    Ok((frames + more, found))
                })
        });
        let (frames, mut found) = found?;
        if frames != batch.frames && !run.is_over() {
            let (name, expected) = (plan.name.clone(), batch.frames);
            return Err(PlanError::Misfit { name, found: frames, expected }.into());
        }
        found.sort_unstable_by_key(|(place, _)| *place);
        Ok(found.into_iter().flat_map(|(_, faults)| faults).collect())
    }

    /// What is wrong with pictures of one game.
    fn of_game(&self, batch: &Batch, entry: &Entry) -> Result<Vec<Fault>, JobError> {
        let mut faults = Vec::new();
        let (file, game) = (batch.file, entry.game.number);
        let mut first = Place { file, game, frame: 0 };
        for line in entry.lines(batch) {
            if !line.is_filmed(self.run)? {
                self.of_line(&line, first, &mut faults)?;
            }
            first.frame += line.part.count() as u64;
        }
        Ok(faults)
    }

    /// Adds what is wrong with pictures of a line, of which the first frame is at `first`, shard by shard: each has records of
    /// its own.
    fn of_line(&self, line: &Line, first: Place, faults: &mut Vec<Fault>) -> Result<(), JobError> {
        let Look { plan, run, .. } = self;
        let layout = line.lay_out(run)?;
        let (inside, frames) = (line.inside(), layout.planned.len() as u64);
        let mut begin = 0;
        while begin < frames {
            let shard = plan.shard_of(Place { frame: first.frame + begin, ..first });
            let share = plan.shard(shard)?.of(first.file, first.game, u64::MAX);
            // Whatever a plan says, there is an end.
            let end = share.end.saturating_sub(first.frame).clamp(begin + 1, frames);
            let sums = self.sums(shard);
            let witness = Witness::new(run.job, &inside, &sums);
            for (picture, flaw) in self.flaws(&layout, begin as usize..end as usize, &witness) {
                let folder = inside.clone();
                add(faults, Fault { shard, folder, first: picture, last: picture, flaw });
            }
            begin = end;
        }
        Ok(())
    }

    /// Which pictures of a line, in such places, are wrong: the numbers in their names.
    fn flaws(
        &self,
        layout: &Layout,
        places: Range<usize>,
        witness: &Witness,
    ) -> Vec<(usize, Flaw)> {
        let pictures = layout.planned[places].par_iter().filter(|_| !self.run.is_over());
        let flaws = pictures.filter_map(|planned| {
            let path = planned.row.file().map(|file| layout.folder.join(file));
            (!witness.vouches(&planned.row)).then(|| (planned.number, flaw(path.as_deref())))
        });
        flaws.collect()
    }

    /// What a shard has told of its pictures, where they do not tell themselves.
    fn sums(&self, shard: usize) -> Arc<Sums> {
        if self.run.job.format().is_sealed() {
            return Arc::default();
        }
        let told = || self.told.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(sums) = told().get(&shard) {
            return sums.clone();
        }
        let sums = Arc::new(self.records.sums(shard));
        let mut told = told();
        told.insert(shard, sums.clone());
        while told.len() > KEPT {
            // Games come in their order, or nearly.
            told.pop_first();
        }
        sums
    }
}

/// What is wrong with a picture for which nobody vouches.
fn flaw(path: Option<&Path>) -> Flaw {
    match path.is_some_and(|path| path.symlink_metadata().is_ok()) {
        true => Flaw::Broken,
        false => Flaw::Missing,
    }
}

/// Adds a picture, to those before it if it follows them.
fn add(faults: &mut Vec<Fault>, fault: Fault) {
    match faults.last_mut() {
        Some(last)
            if last.last + 1 == fault.first
                && (last.shard, &last.folder, last.flaw)
                    == (fault.shard, &fault.folder, fault.flaw) =>
        {
            last.last = fault.last;
        }
        _ => faults.push(fault),
    }
}
