//! How far a job is, on stderr: a bar on a terminal, a plain line now and then elsewhere.

use std::fmt;
use std::sync::Arc;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use clap::ValueEnum;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use lightsquare::job::Progress;

/// Between two plain lines.
const EVERY: Duration = Duration::from_secs(5);

/// How progress is shown.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ProgressMode {
    Auto,
    Bar,
    Plain,
    None,
}

/// How much is said beside results and errors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Loudness {
    /// Not even progress and warnings.
    pub quiet: bool,
    /// Details too.
    pub verbose: bool,
}

/// The terminal's side of a job.
pub struct Terminal {
    bar: ProgressBar,
    loudness: Loudness,
    /// When to say the next plain line, where plain lines are wanted.
    plain: Option<Mutex<Plain>>,
    signal: Arc<AtomicUsize>,
}

struct Plain {
    next: Instant,
    game: String,
}

impl Terminal {
    /// `signal` holds the number of a signal that came, or 0.
    pub fn new(mode: ProgressMode, loudness: Loudness, signal: Arc<AtomicUsize>) -> Terminal {
        let on_terminal = std::io::IsTerminal::is_terminal(&std::io::stderr());
        let bar = match mode {
            _ if loudness.quiet => false,
            ProgressMode::Auto => on_terminal,
            ProgressMode::Bar => true,
            ProgressMode::Plain | ProgressMode::None => false,
        };
        let plain = !loudness.quiet && !bar && mode != ProgressMode::None;
        let target = if bar { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
        Terminal {
            bar: ProgressBar::with_draw_target(Some(0), target).with_style(style()),
            loudness,
            plain: plain
                .then(|| Mutex::new(Plain { next: Instant::now() + EVERY, game: String::new() })),
            signal,
        }
    }

    /// Takes the bar away, so that what comes after stands on a line of its own.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }

    fn say(&self, text: &str) {
        self.bar.suspend(|| anstream::eprintln!("{text}"));
    }
}

fn style() -> ProgressStyle {
    let template = "{bar:24} {pos}/{len} frames  {rate}  {eta} left  {wide_msg}";
    ProgressStyle::with_template(template)
        .unwrap_or_else(|_| ProgressStyle::default_bar())
        .with_key("rate", |state: &ProgressState, out: &mut dyn fmt::Write| {
            // Only what cannot be shown is lost when this fails.
            let _ = write!(out, "{:.1} a second", state.per_sec());
        })
}

impl Progress for Terminal {
    fn begin(&self, frames: u64) {
        self.bar.set_length(frames);
        self.bar.reset_elapsed();
        self.bar.reset_eta();
    }

    fn game(&self, name: &str) {
        self.bar.set_message(name.to_owned());
        if let Some(Ok(mut plain)) = self.plain.as_ref().map(Mutex::lock) {
            plain.game = name.to_owned();
        }
    }

    fn frame_done(&self) {
        self.bar.inc(1);
        let Some(Ok(mut plain)) = self.plain.as_ref().map(Mutex::lock) else {
            return;
        };
        if Instant::now() < plain.next {
            return;
        }
        plain.next = Instant::now() + EVERY;
        let (done, all) = (self.bar.position(), self.bar.length().unwrap_or(0));
        let seconds = self.bar.elapsed().as_secs_f64().max(1e-3);
        let rate = done as f64 / seconds;
        let left = (all.saturating_sub(done) as f64 / rate).ceil();
        self.say(&format!(
            "{done} of {all} frames, {rate:.1} a second, about {left:.0} s left: {}",
            plain.game
        ));
    }

    fn warn(&self, text: &str) {
        if !self.loudness.quiet {
            self.say(text);
        }
    }

    fn detail(&self, text: &str) {
        if self.loudness.verbose {
            self.say(text);
        }
    }

    fn is_cancelled(&self) -> bool {
        self.signal.load(Ordering::Relaxed) != 0
    }
}
