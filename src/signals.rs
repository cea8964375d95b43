//! Ctrl-C and SIGTERM: the frame in hand is finished, and what was done is reported.

use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

/// The signals that ask to stop. Until [`Signals::take_over`], and after the first one has come,
/// they end the program at once.
#[derive(Clone, Default)]
pub struct Signals {
    /// The number of the last signal that came, or 0.
    came: Arc<AtomicUsize>,
    /// Whether the next signal ends the program at once.
    deadly: Arc<AtomicBool>,
}

impl Signals {
    /// Begins to watch.
    ///
    /// # Errors
    /// What the system gives.
    pub fn watch() -> io::Result<Signals> {
        let signals = Signals::default();
        signals.deadly.store(true, Ordering::Relaxed);
        for number in [SIGINT, SIGTERM] {
            // In this order: a signal first asks whether it ends the program, then makes sure that
            // the next one does.
            flag::register_conditional_shutdown(number, 128 + number, signals.deadly.clone())?;
            flag::register(number, signals.deadly.clone())?;
            flag::register_usize(number, signals.came.clone(), number as usize)?;
        }
        Ok(signals)
    }

    /// From here on the first signal only asks to stop.
    pub fn take_over(&self) {
        self.deadly.store(false, Ordering::Relaxed);
    }

    /// The number of the signal that came.
    pub fn came(&self) -> Option<u8> {
        u8::try_from(self.came.load(Ordering::Relaxed)).ok().filter(|number| *number > 0)
    }
}
