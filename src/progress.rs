//! How far a job is, on stderr: a bar on a terminal, a plain line now and then elsewhere.

use std::fmt;
use std::io::Write;
use std::sync::Mutex;
use std::time::{Duration, Instant};

use clap::ValueEnum;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use lightsquare::job::Progress;

use crate::signals::Signals;

/// Between two plain lines.
const EVERY: Duration = Duration::from_secs(5);

/// How progress is shown.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ProgressMode {
    /// A bar on a terminal, a line now and then elsewhere.
    Auto,
    /// A line now and then.
    Plain,
    /// Nothing.
    None,
}

/// How much is said beside results and errors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verbosity {
    /// Not even progress and warnings.
    Quiet,
    Normal,
    /// Details too.
    Verbose,
}

/// The terminal's side of a job.
pub struct Terminal {
    bar: ProgressBar,
    verbosity: Verbosity,
    /// When to say the next plain line, where plain lines are wanted.
    plain: Option<Mutex<Plain>>,
    signals: Signals,
}

struct Plain {
    next: Instant,
    game: String,
}

impl Terminal {
    pub fn new(mode: ProgressMode, verbosity: Verbosity, signals: Signals) -> Terminal {
        let on_terminal = std::io::IsTerminal::is_terminal(&std::io::stderr());
        let talks = verbosity != Verbosity::Quiet && mode != ProgressMode::None;
        let bar = talks && on_terminal && mode == ProgressMode::Auto;
        let plain = talks && !bar;
        let target = if bar { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
        Terminal {
            bar: ProgressBar::with_draw_target(Some(0), target).with_style(style()),
            verbosity,
            plain: plain
                .then(|| Mutex::new(Plain { next: Instant::now() + EVERY, game: String::new() })),
            signals,
        }
    }

    /// Takes the bar away, so that what comes after stands on a line of its own.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }

    fn print(&self, text: &str) {
        // There is nobody left to tell when stderr cannot be written.
        self.bar.suspend(|| writeln!(anstream::stderr(), "{text}").ok());
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
        self.signals.take_over();
        self.bar.set_length(frames);
        self.bar.reset();
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
        self.print(&format!(
            "{done} of {all} frames, {rate:.1} a second, about {left:.0} s left: {}",
            plain.game
        ));
    }

    fn say(&self, text: &str) {
        if self.verbosity != Verbosity::Quiet {
            self.print(text);
        }
    }

    fn detail(&self, text: &str) {
        if self.verbosity == Verbosity::Verbose {
            self.print(text);
        }
    }

    fn is_cancelled(&self) -> bool {
        self.signals.came().is_some()
    }
}
