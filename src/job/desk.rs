//! Pictures on their way to disk: encoded and written beside the tracing of those that follow.

use std::path::PathBuf;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use image::DynamicImage;
use rayon::Scope;

use super::Progress;
use crate::output::{OutputError, write_png};

/// A picture that is to be written.
pub struct Sheet {
    pub path: PathBuf,
    pub picture: Arc<DynamicImage>,
    /// What it says of itself: keywords and texts.
    pub texts: Vec<(&'static str, String)>,
}

/// Where sheets wait until a thread of the pool has nothing to trace.
pub struct Desk<'a> {
    progress: &'a dyn Progress,
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
    /// For sheets that are written by the current pool. Where one thread does all, none waits.
    pub fn new(progress: &'a dyn Progress) -> Desk<'a> {
        let threads = rayon::current_num_threads();
        Desk {
            progress,
            room: if threads > 1 { threads + SPARE } else { 0 },
            waiting: AtomicUsize::new(0),
            written: AtomicU64::new(0),
            failed: Mutex::default(),
        }
    }

    /// Has a sheet written by the end of `scope`; at once, by the caller, if too many wait.
    pub fn take<'scope>(&'scope self, sheet: Sheet, scope: &Scope<'scope>) {
        if self.waiting.load(Ordering::Relaxed) >= self.room {
            return self.write(&sheet);
        }
        self.waiting.fetch_add(1, Ordering::Relaxed);
        scope.spawn(move |_| {
            self.write(&sheet);
            self.waiting.fetch_sub(1, Ordering::Relaxed);
        });
    }

    fn write(&self, Sheet { path, picture, texts }: &Sheet) {
        if self.has_failed() {
            return;
        }
        match write_png(path, picture, texts, None) {
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

    /// Whether a sheet could not be written; those after it are not.
    pub fn has_failed(&self) -> bool {
        self.failed.lock().unwrap_or_else(PoisonError::into_inner).is_some()
    }

    /// How many sheets were written, and what went wrong if anything did.
    pub fn close(self) -> (u64, Result<(), OutputError>) {
        let failed = self.failed.into_inner().unwrap_or_else(PoisonError::into_inner);
        (self.written.into_inner(), failed.map_or(Ok(()), Err))
    }
}
