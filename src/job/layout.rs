//! What a line of play is to become: all its pictures, each with what it shows, and which of them are there.

use std::path::PathBuf;
use std::sync::Arc;

use rayon::prelude::*;

use super::captions::GameCaptions;
use super::desk::{Desk, Sheet};
use super::reels::Reels;
use super::report::{FrameRow, texts};
use super::run::{Run, Task};
use super::studio::Studio;
use crate::game::Game;
use crate::output::{FINGERPRINT, OutputError, PictureFormat, RepeatedPicture, crc32_of};
use crate::timeline::Timeline;

/// A line of play, laid out frame by frame.
pub struct Layout<'a> {
    pub game: &'a Game,
    /// Where its pictures go.
    pub folder: PathBuf,
    pub timeline: Timeline<'a>,
    pub captions: GameCaptions<'a>,
    pub planned: Vec<Planned>,
}

/// A picture that is to be there in the end.
pub struct Planned {
    /// Its frame, counted as in the whole.
    pub index: usize,
    /// The one in its name.
    pub number: usize,
    pub row: FrameRow,
    /// Whether it is there already.
    pub is_kept: bool,
}

/// How far the tracing of a line came.
pub struct Traced {
    /// So many of its pictures, from the first on, were traced, kept or passed over.
    pub reached: usize,
    /// Pictures that were written, and those that went into films alone.
    pub frames: u64,
    pub is_cancelled: bool,
    pub outcome: Result<(), OutputError>,
}

impl Layout<'_> {
    /// Says of each picture whether it is kept.
    pub fn keep(&mut self, run: &Run, is_there: impl Fn(&FrameRow) -> bool + Sync) {
        run.pool.install(|| {
            let planned = self.planned.par_iter_mut();
            planned.for_each(|Planned { row, is_kept, .. }| *is_kept = is_there(row));
        });
    }

    /// Says of each picture that is kept what sum its file has, as is `told` or found, where it does not tell itself.
    pub fn sum(&self, run: &Run, told: impl Fn(&str) -> Option<u32> + Sync) {
        let kept = || self.planned.par_iter().filter(|planned| planned.is_kept);
        if run.job.format().is_sealed() {
            return;
        }
        run.pool.install(|| {
            kept().for_each(|Planned { row, .. }| {
                let Some(file) = row.file() else { return };
                let found = || crc32_of(&self.folder.join(file)).ok();
                if let Some(crc32) = told(file).or_else(found) {
                    row.crc32().get_or_init(|| crc32);
                }
            });
        });
    }

    /// Traces the pictures that are not kept, or that films want.
    pub fn trace(
        &self,
        run: &Run,
        studio: &mut Studio,
        reels: &mut Reels,
        format: PictureFormat,
    ) -> Traced {
        let progress = run.progress;
        let desk = Desk::new(progress, run.pool, format, run.ledger());
        let is_written = |planned: &Planned| !planned.is_kept && planned.row.file().is_some();
        let is_traced = |planned: &&Planned| is_written(planned) || !reels.is_empty();
        let coming: Vec<usize> =
            self.planned.iter().filter(is_traced).map(|planned| planned.index).collect();
        let mut coming = &coming[..];
        let (mut reached, mut filmed, mut is_cancelled) = (0, 0, false);
        run.pool.in_place_scope(|scope| {
            for planned in &self.planned {
                let Planned { index, row, .. } = planned;
                let is_written = is_written(planned);
                is_cancelled = run.is_over();
                if is_cancelled || desk.has_failed() {
                    break;
                }
                coming = coming.strip_prefix(&[*index]).unwrap_or(coming);
                let is_filmed = reels.wants(*index);
                if is_written || is_filmed {
                    let picture = self.read(run, planned).unwrap_or_else(|| {
                        let frame = self.timeline.frame(*index);
                        let content = self.captions.of(&frame);
                        let coming = coming.iter().map(|index| self.timeline.frame(*index));
                        run.pool.install(|| studio.picture(&frame, content.as_ref(), coming))
                    });
                    if is_filmed && !reels.add(&picture) {
                        break;
                    }
                    if let Some(file) = row.file().filter(|_| is_written) {
                        let fingerprint = row.fingerprint().to_owned();
                        let mut texts = texts(self.game, &self.timeline.frame(*index));
                        texts.push((FINGERPRINT, fingerprint.clone()));
                        let path = self.folder.join(file);
                        let crc32 = Some(row.crc32()).filter(|_| !format.is_sealed());
                        desk.take(Sheet { path, picture, texts, fingerprint, crc32 }, scope);
                    }
                }
                if !is_written {
                    progress.frame_done();
                }
                filmed += u64::from(row.file().is_none());
                reached += 1;
            }
        });
        let (written, outcome) = desk.close();
        Traced { reached, frames: written + filmed, is_cancelled, outcome }
    }

    /// A picture that is there, as its file has it, if that loses nothing.
    fn read(&self, run: &Run, planned: &Planned) -> Option<Arc<RepeatedPicture>> {
        let kept = planned.row.file().filter(|_| planned.is_kept);
        let path =
            kept.map_or_else(|| self.spent_by(run, planned), |file| Some(self.folder.join(file)));
        let path = path.filter(|_| run.job.format().is_exact())?;
        Some(Arc::new(RepeatedPicture::new(image::open(path).ok()?)))
    }

    /// The pictures of shards that only films want.
    pub fn spent(&self, run: &Run) -> Vec<PathBuf> {
        self.planned.iter().filter_map(|planned| self.spent_by(run, planned)).collect()
    }

    fn spent_by(&self, run: &Run, planned: &Planned) -> Option<PathBuf> {
        let is_spent = matches!(run.task, Task::Merge) && run.names.is_none();
        is_spent.then(|| self.folder.join(run.job.names_of_shards().name(planned.number)))
    }
}
