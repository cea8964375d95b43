//! The command `lightsquare`.

mod cli;
mod progress;

use std::io::{self, BufWriter, ErrorKind, Write};
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use anstyle::{AnsiColor, Style};
use anyhow::Context;
use clap::Parser;
use lightsquare::job::{self, JobError, Progress};
use lightsquare::tracer::RayCounts;
use signal_hook::consts::{SIGINT, SIGTERM};

use cli::{Cli, ColorMode, Command};
use progress::Terminal;

/// Done, but some game was not rendered whole.
const INCOMPLETE: u8 = 3;

fn main() -> ExitCode {
    let cli = Cli::parse();
    match cli.talk.color {
        ColorMode::Auto => {}
        ColorMode::Always => anstream::ColorChoice::Always.write_global(),
        ColorMode::Never => anstream::ColorChoice::Never.write_global(),
    }
    run(cli).unwrap_or_else(|error| {
        let red = Style::new().bold().fg_color(Some(AnsiColor::Red.into()));
        anstream::eprintln!("{red}error:{red:#} {error:#}");
        ExitCode::FAILURE
    })
}

fn run(cli: Cli) -> anyhow::Result<ExitCode> {
    let Cli { command, talk } = cli;
    match command {
        Command::Render(args) => {
            let job = args.into_job()?;
            let signal = watch_signals()?;
            let terminal = Terminal::new(talk.progress, talk.loudness(), signal.clone());
            tell_config(&terminal, &job.picture);
            let summary = job::render(&job, &terminal);
            terminal.finish();
            let summary = summary?;
            terminal.detail(&rays(&summary.rays));
            let stopped = if summary.cancelled { "stopped: " } else { "" };
            terminal.warn(&format!(
                "{stopped}{} frames in {}; games: {} whole, {} in part, {} skipped",
                summary.frames,
                job.out.display(),
                summary.rendered,
                summary.partial,
                summary.skipped,
            ));
            Ok(match signal.load(Ordering::Relaxed) {
                0 if summary.partial + summary.skipped > 0 => ExitCode::from(INCOMPLETE),
                0 => ExitCode::SUCCESS,
                number => ExitCode::from(128 + number as u8),
            })
        }
        Command::Diagram(args) => {
            let job = args.into_job()?;
            let terminal = Terminal::new(talk.progress, talk.loudness(), Arc::default());
            tell_config(&terminal, &job.picture);
            terminal.detail(&rays(&job::diagram(&job)?));
            Ok(ExitCode::SUCCESS)
        }
        Command::Inspect(args) => {
            let mut out = BufWriter::new(io::stdout().lock());
            match job::inspect(&args.into_job(), &mut out) {
                // Whoever reads has seen enough.
                Err(JobError::Write(error)) if error.kind() == ErrorKind::BrokenPipe => {
                    Ok(ExitCode::SUCCESS)
                }
                outcome => {
                    out.flush().ok();
                    Ok(match outcome? {
                        0 => ExitCode::SUCCESS,
                        _ => ExitCode::from(INCOMPLETE),
                    })
                }
            }
        }
    }
}

/// The number of the first signal that asks to stop will stand in what this gives.
fn watch_signals() -> anyhow::Result<Arc<AtomicUsize>> {
    let signal = Arc::new(AtomicUsize::new(0));
    for number in [SIGINT, SIGTERM] {
        signal_hook::flag::register_usize(number, signal.clone(), number as usize)
            .context("signals cannot be watched")?;
    }
    Ok(signal)
}

fn tell_config(terminal: &Terminal, picture: &job::PictureSettings) {
    terminal.detail(&match &picture.config_file {
        Some(path) => format!("settings from {}", path.display()),
        None => "settings are the built-in ones".to_owned(),
    });
}

fn rays(counts: &RayCounts) -> String {
    let RayCounts { primary, shadow, reflected } = counts;
    format!("rays: {primary} primary, {shadow} shadow, {reflected} reflected")
}
