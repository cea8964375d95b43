//! Pictures on their way to disk: encoded and written beside the tracing of those that follow.

use std::path::PathBuf;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use rayon::{Scope, ThreadPool};

use super::Progress;
use super::records::Ledger;
use crate::output::{OutputError, PictureFormat, RepeatedPicture};

/// A picture that is to be written.
pub struct Sheet<'a> {
    pub path: PathBuf,
    pub picture: Arc<RepeatedPicture>,
    /// What it says of itself: keywords and texts.
    pub texts: Vec<(&'static str, String)>,
    pub fingerprint: String,
    /// Where its CRC-32 is to be told, if that is wanted.
    pub crc32: Option<&'a OnceLock<u32>>,
}

/// Where sheets wait until a thread of the pool has nothing to trace.
pub struct Desk<'a> {
    progress: &'a dyn Progress,
    pool: &'a ThreadPool,
    format: PictureFormat,
    /// Where those that are written are noted, if that is wanted.
    ledger: Option<&'a Ledger>,
    /// How many sheets may wait.
    room: usize,
    waiting: AtomicUsize,
    written: AtomicU64,
    failed: Mutex<Option<OutputError>>,
}

/// Sheets beyond those that the threads have in hand: enough that no thread waits for a picture, and no more
/// than memory has room for.
const SPARE: usize = 2;

impl<'a> Desk<'a> {
    /// For sheets that are written in one format by the threads of `pool`. Where there is but one, none waits.
    pub fn new(
        progress: &'a dyn Progress,
        pool: &'a ThreadPool,
        format: PictureFormat,
        ledger: Option<&'a Ledger>,
    ) -> Desk<'a> {
        Desk {
            progress,
            pool,
            format,
            ledger,
            room: Desk::room(pool.current_num_threads()),
            waiting: AtomicUsize::new(0),
            written: AtomicU64::new(0),
            failed: Mutex::default(),
        }
    }

    /// How many sheets may wait where so many threads write.
    pub fn room(threads: usize) -> usize {
        if threads > 1 { threads + SPARE } else { 0 }
    }

    /// Has a sheet written by the end of `scope`, which is one of the pool; at once if too many wait. Once one could not
    /// be written, no more are taken.
    pub fn take<'scope>(&'scope self, sheet: Sheet<'scope>, scope: &Scope<'scope>) {
        if self.has_failed() {
            return;
        }
        if self.waiting.load(Ordering::Relaxed) >= self.room {
            return self.pool.install(|| self.write(&sheet));
        }
        self.waiting.fetch_add(1, Ordering::Relaxed);
        scope.spawn(move |_| {
            self.write(&sheet);
            self.waiting.fetch_sub(1, Ordering::Relaxed);
        });
    }

    fn write(&self, sheet: &Sheet) {
        let Sheet { path, picture, texts, fingerprint, crc32 } = sheet;
        let written = picture.write(path, self.format, texts).and_then(|()| {
            let Some(told) = crc32 else { return Ok(()) };
            let crc32 = picture.crc32(self.format);
            let crc32 = crc32.map_err(|error| OutputError { path: path.clone(), error })?;
            told.get_or_init(|| crc32);
            self.ledger.map_or(Ok(()), |ledger| ledger.add(path, fingerprint, crc32))
        });
        match written {
            Ok(()) => {
                self.written.fetch_add(1, Ordering::Relaxed);
                self.progress.frame_done();
            }
            Err(error) => {
                let mut failed = self.failed.lock().unwrap_or_else(PoisonError::into_inner);
                failed.get_or_insert(error);
            }
        }
    }

    /// Whether a sheet could not be written.
    pub fn has_failed(&self) -> bool {
        self.failed.lock().unwrap_or_else(PoisonError::into_inner).is_some()
    }

    /// How many sheets were written, and what went wrong if anything did.
    pub fn close(self) -> (u64, Result<(), OutputError>) {
        let failed = self.failed.into_inner().unwrap_or_else(PoisonError::into_inner);
        (self.written.into_inner(), failed.map_or(Ok(()), Err))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::DynamicImage;
    use std::collections::BTreeSet;
    use std::fs;
    use std::path::Path;

    /// Counts frames.
    struct Counter(AtomicU64);

    impl Progress for Counter {
        fn begin(&self, _: u64) {}
        fn game(&self, _: &str) {}
        fn frame_done(&self) {
            self.0.fetch_add(1, Ordering::Relaxed);
        }
        fn say(&self, _: &str) {}
        fn detail(&self, _: &str) {}
        fn is_cancelled(&self) -> bool {
            false
        }
    }

    fn sheet(path: PathBuf) -> Sheet<'static> {
        let picture = Arc::new(RepeatedPicture::new(DynamicImage::new_rgb8(40, 30)));
        Sheet { path, picture, texts: Vec::new(), fingerprint: String::new(), crc32: None }
    }

    /// Hands sheets in on so many threads: what came of it, and the frames that progress was told of.
    fn written(threads: usize, paths: &[PathBuf]) -> (u64, Result<(), OutputError>, u64) {
        let progress = Counter(AtomicU64::new(0));
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let desk = Desk::new(&progress, &pool, PictureFormat::Png, None);
        pool.in_place_scope(|scope| {
            for path in paths {
                desk.take(sheet(path.clone()), scope);
                assert!(desk.waiting.load(Ordering::Relaxed) <= desk.room);
            }
        });
        let (count, outcome) = desk.close();
        (count, outcome, progress.0.into_inner())
    }

    fn files(folder: &Path) -> BTreeSet<PathBuf> {
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect()
    }

    #[test]
    fn all_sheets_are_written_whatever_the_number_of_threads() {
        for threads in [1, 2, 5] {
            let folder = tempfile::tempdir().unwrap();
            let paths: Vec<_> =
                (0..40).map(|index| folder.path().join(index.to_string())).collect();
            let (count, outcome, told) = written(threads, &paths);
            assert!(outcome.is_ok());
            assert_eq!([count, told], [40, 40], "{threads}");
            assert_eq!(files(folder.path()), paths.into_iter().collect(), "{threads}");
        }
    }

    #[test]
    fn a_sheet_that_cannot_be_written_stops_those_behind_it_alone() {
        for threads in [1, 3] {
            let folder = tempfile::tempdir().unwrap();
            let name = |index: usize| match index {
                5 => "none/5".to_owned(),
                _ => index.to_string(),
            };
            let paths: Vec<_> = (0..40).map(|index| folder.path().join(name(index))).collect();
            let (count, outcome, told) = written(threads, &paths);
            assert_eq!(outcome.unwrap_err().path, paths[5]);
            assert_eq!(count, told);
            let files = files(folder.path());
            assert_eq!(files.len() as u64, count);
            assert!(paths[..5].iter().all(|path| files.contains(path)), "{threads}");
            // With more threads some may have been in hand.
            assert!(threads > 1 || count == 5, "{count}");
        }
    }
}
