//! The command `lightsquare`.

mod cli;
mod progress;
mod signals;

use std::io::{self, BufWriter, ErrorKind, Write};
use std::process::ExitCode;

use anstyle::{AnsiColor, Style};
use anyhow::Context;
use lightsquare::job::{self, DiagramJob, JobError, PictureSettings, Progress};
use lightsquare::tracer::RayCounts;

use cli::{Cli, Command, UsageError};
use progress::{ProgressMode, Terminal, Verbosity};
use signals::Signals;

const WRONG_USAGE: u8 = 2;

/// Done, but some game was not rendered or read whole.
const INCOMPLETE: u8 = 3;

fn main() -> ExitCode {
    run().unwrap_or_else(|error| {
        let red = Style::new().bold().fg_color(Some(AnsiColor::Red.into()));
        // When stderr cannot be written the exit code alone must tell.
        let _ = writeln!(anstream::stderr(), "{red}error:{red:#} {error:#}");
        if error.is::<UsageError>() { ExitCode::from(WRONG_USAGE) } else { ExitCode::FAILURE }
    })
}

fn run() -> anyhow::Result<ExitCode> {
    if let Some(job) = cli::thesis_job()? {
        let signals = Signals::default();
        return diagram(&job, &Terminal::new(ProgressMode::Auto, Verbosity::Normal, signals));
    }
    let Cli { command, messages } = cli::parse();
    let terminal = |signals| Terminal::new(messages.progress, messages.verbosity(), signals);
    if let Some(config) = command.config_to_print()? {
        write!(io::stdout(), "{}", config.to_ini())?;
        return Ok(ExitCode::SUCCESS);
    }
    match command {
        Command::Render(args) if args.estimate => {
            let estimate = job::estimate(&args.into_job()?, &terminal(Signals::default()))?;
            writeln!(io::stdout(), "{}", cli::table::estimate(&estimate))?;
            Ok(ExitCode::SUCCESS)
        }
        Command::Render(args) => {
            let job = args.into_job()?;
            let signals = Signals::watch().context("signals cannot be watched")?;
            let terminal = terminal(signals.clone());
            tell_config(&terminal, &job.picture);
            let summary = job::render(&job, &terminal);
            terminal.finish();
            let summary = summary?;
            terminal.detail(&rays(&summary.rays));
            let stopped = if summary.cancelled { "stopped: " } else { "" };
            let films = match summary.films {
                0 => String::new(),
                films => format!(", {}", count(films as u64, "film")),
            };
            let kept = match summary.kept {
                0 => String::new(),
                kept => format!(" ({kept} of them were there)"),
            };
            terminal.say(&format!(
                "{stopped}{}{kept}{} in {}; games: {} whole, {} in part, {} skipped",
                count(summary.frames, "frame"),
                films,
                job.out.display(),
                summary.rendered,
                summary.partial,
                summary.skipped,
            ));
            Ok(match signals.came().filter(|_| summary.cancelled) {
                Some(number) => ExitCode::from(128 + number),
                None => whole(summary.partial + summary.skipped == 0),
            })
        }
        Command::Diagram(args) => diagram(&args.into_job()?, &terminal(Signals::default())),
        Command::Export(args) => {
            let job = args.into_job()?;
            let terminal = terminal(Signals::default());
            tell_config(&terminal, &job.picture);
            Ok(whole(job::export(&job, &terminal, &mut io::stdout().lock())?))
        }
        Command::Bench(args) => {
            let measurements = job::bench(&args.to_job())?;
            let mut out = io::stdout().lock();
            if args.json {
                writeln!(out, "{}", serde_json::to_string_pretty(&measurements)?)?;
            } else {
                write!(out, "{}", cli::table::pictures(&measurements.pictures))?;
                write!(out, "{}", cli::table::games(&measurements.games))?;
            }
            Ok(ExitCode::SUCCESS)
        }
        Command::Inspect(args) if args.estimate => {
            let estimate = job::estimate(&args.into_render_job()?, &terminal(Signals::default()))?;
            writeln!(io::stdout(), "{}", cli::table::estimate(&estimate))?;
            Ok(ExitCode::SUCCESS)
        }
        Command::Inspect(args) => {
            let job = args.into_job()?;
            let terminal = terminal(Signals::default());
            let mut out = BufWriter::new(io::stdout().lock());
            match job::inspect(&job, &terminal, &mut out) {
                // Whoever reads has seen enough.
                Err(JobError::Write(error)) if error.kind() == ErrorKind::BrokenPipe => {
                    Ok(ExitCode::SUCCESS)
                }
                outcome => Ok(whole(outcome? == 0)),
            }
        }
    }
}

fn diagram(job: &DiagramJob, terminal: &Terminal) -> anyhow::Result<ExitCode> {
    tell_config(terminal, &job.picture);
    let summary = job::diagram(job, terminal, &mut io::stdout().lock())?;
    terminal.detail(&rays(&summary.rays));
    Ok(whole(summary.is_whole))
}

fn count(number: u64, what: &str) -> String {
    let ending = if number == 1 { "" } else { "s" };
    format!("{number} {what}{ending}")
}

fn whole(is_whole: bool) -> ExitCode {
    if is_whole { ExitCode::SUCCESS } else { ExitCode::from(INCOMPLETE) }
}

fn tell_config(terminal: &Terminal, picture: &PictureSettings) {
    terminal.detail(&match &picture.config_file {
        Some(path) => format!("settings from {}", path.display()),
        None => "settings are the built-in ones".to_owned(),
    });
}

fn rays(counts: &RayCounts) -> String {
    let RayCounts { primary, shadow, reflected, refracted } = counts;
    format!(
        "rays: {primary} primary, {shadow} shadow, {reflected} reflected, {refracted} refracted"
    )
}
