//! A shard's part of a line of play.
//!
//! Others may write to the same folders meanwhile, even the same shard. So pictures alone are written, each whole under its
//! own name, and nothing is removed; manifests, films and the report are for whoever merges.

use std::ops::Range;
use std::path::Path;
use std::sync::OnceLock;

use crate::job::JobError;
use crate::job::line::{Line, Rendered};
use crate::job::records::{Sums, holds};
use crate::job::reels::Reels;
use crate::job::report::FrameRow;
use crate::job::run::{RenderJob, Run, ShardTask};
use crate::job::studio::Studio;
use crate::output::{Earlier, is_whole, prepare_inside};

/// Who tells which pictures of a folder are what they should be.
pub struct Witness<'a> {
    job: &'a RenderJob,
    /// The folder within that of all output.
    inside: &'a Path,
    /// What its shard has told.
    sums: &'a Sums,
    /// What manifests say, once there are some and somebody asks.
    earlier: OnceLock<Earlier>,
}

impl<'a> Witness<'a> {
    pub fn new(job: &'a RenderJob, inside: &'a Path, sums: &'a Sums) -> Witness<'a> {
        Witness { job, inside, sums, earlier: OnceLock::new() }
    }

    /// Whether the picture of `row` is there, is whole, and somebody tells that it is the right one: itself, its shard, or a
    /// manifest.
    pub fn vouches(&self, row: &FrameRow) -> bool {
        let Some(file) = row.file() else { return false };
        let (out, inside, fingerprint) = (&self.job.out, self.inside.join(file), row.fingerprint());
        let format = self.job.format();
        if format.is_sealed() {
            return is_whole(&out.join(&inside), format, fingerprint);
        }
        if let Some(told) = self.sums.get(&*inside.to_string_lossy()) {
            return holds(told, out, fingerprint);
        }
        let read = || Earlier::read(&out.join(self.inside), self.job.frames.as_ref());
        self.earlier.get_or_init(read).vouches(file, format, fingerprint)
    }
}

impl Line<'_> {
    /// The places of its pictures that belong to the `share` of a shard, where so many of the game's come `before` it.
    pub fn places(&self, before: u64, share: Range<u64>) -> Range<usize> {
        let place = |at: u64| at.saturating_sub(before).min(self.part.count() as u64) as usize;
        place(share.start)..place(share.end)
    }

    /// Renders those of its pictures that come in such places and are not there yet; tells in `rendered` how far it came,
    /// even if it fails. Where films alone are wanted, and all pictures of the line, it is the films that are made.
    pub fn render_share(
        &self,
        run: &Run,
        task: &ShardTask,
        places: Range<usize>,
        studio: &mut Studio,
        rendered: &mut Rendered,
    ) -> Result<(), JobError> {
        let (job, inside) = (run.job, self.inside());
        let told = self.told(run)?;
        prepare_inside(&job.out, &inside)?;
        run.progress.game(&self.players());
        if job.names.is_none() && told.is_some_and(|films| films.missing.is_empty()) {
            places.clone().for_each(|_| run.progress.frame_done());
            rendered.kept = places.len() as u64;
            rendered.frames = rendered.kept;
            return Ok(());
        }
        if job.names.is_none() && places == (0..self.part.count()) {
            return self.render_films(run, studio, rendered);
        }
        let mut layout = self.lay_out_part(run, places, run.names.as_ref())?;
        let witness = Witness::new(job, &inside, &task.sums);
        layout.keep(run, |row| witness.vouches(row));
        let traced = layout.trace(run, studio, &mut Reels::none(run.progress), job.format());
        rendered.kept = layout.planned.iter().filter(|planned| planned.is_kept).count() as u64;
        rendered.frames = rendered.kept + traced.frames;
        rendered.is_cancelled = traced.is_cancelled;
        Ok(traced.outcome?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::game::{Game, Scanner};
    use crate::job::batch::Part;
    use std::borrow::Cow;
    use std::path::PathBuf;

    #[test]
    fn a_share_of_a_game_is_told_to_its_lines() {
        let scanned = Scanner::new("1. e4 *".as_bytes()).next().unwrap().unwrap();
        let part = Part { first: 0, last: 1, frames: 0..10, every: 1 };
        let line = Line {
            file: "x.pgn",
            game: Cow::Owned(Game::read(scanned, 1)),
            part: &part,
            folder: PathBuf::new(),
            variation: None,
            variations: &[],
        };
        for (before, share, expected) in [
            (0, 0..10, 0..10),
            (0, 4..100, 4..10),
            (20, 0..25, 0..5),
            (20, 25..40, 5..10),
            (20, 0..20, 0..0),
            (20, 30..40, 10..10),
        ] {
            assert_eq!(line.places(before, share.clone()), expected, "{share:?} after {before}");
        }
    }
}
