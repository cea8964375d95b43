//! The command `lightsquare`.

mod cli;
mod progress;
mod signals;

use std::env;
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::Path;
use std::process::ExitCode;

use anstyle::{AnsiColor, Style};
use anyhow::Context;
use lightsquare::job::{
    self, DiagramJob, JobError, Merged, PictureSettings, Plan, Progress, RenderJob, Summary,
    Verdict,
};
use lightsquare::tracer::RayCounts;

use cli::plan::{PlanArgs, PlannedArgs};
use cli::{Cli, Command, MessageArgs, RenderArgs, UsageError};
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
        Command::Render(args) if args.plan.is_some() => shard(&args, &messages),
        Command::Render(args) => {
            let job = args.into_job()?;
            let signals = Signals::watch().context("signals cannot be watched")?;
            let terminal = terminal(signals.clone());
            tell_config(&terminal, &job.picture);
            let summary = job::render(&job, &terminal);
            terminal.finish();
            Ok(rendered(&job, &summary?, &terminal, &signals))
        }
        Command::Plan(args) => plan(args, &terminal(Signals::default())),
        Command::Verify(args) => {
            let (plan, job) = planned(&args)?;
            let terminal = terminal(Signals::default());
            let verdict = job::verify(&plan, &job, &terminal);
            terminal.finish();
            verified(&verdict?, &job, &terminal)
        }
        Command::Merge(args) => {
            let (plan, job) = planned(&args)?;
            let signals = Signals::watch().context("signals cannot be watched")?;
            let terminal = terminal(signals.clone());
            let merged = job::merge(&plan, &job, &terminal);
            terminal.finish();
            match merged? {
                Merged::Incomplete(verdict) => verified(&verdict, &job, &terminal),
                Merged::Done(summary) => Ok(rendered(&job, &summary, &terminal, &signals)),
            }
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

/// Cuts a job into shards, and prints which tasks there are to start.
fn plan(args: PlanArgs, terminal: &Terminal) -> anyhow::Result<ExitCode> {
    let arguments = cli::plan::arguments_to_keep()?;
    let (output, shards) = (args.output.clone(), args.shards);
    let job = args.into_job()?;
    tell_config(terminal, &job.picture);
    let planned = job::plan(&job, arguments, &output, shards, terminal)?;
    terminal.say(&cli::table::plan(&planned));
    let all: Vec<usize> = (0..planned.shards).collect();
    print_lines(&cli::table::array(&all))?;
    Ok(ExitCode::SUCCESS)
}

/// Prints lines for another program, which may have seen enough before the last.
fn print_lines(lines: &str) -> io::Result<()> {
    match writeln!(io::stdout(), "{lines}") {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        written => written,
    }
}

/// Renders a shard. A signal ends it at once: whoever sends it will not wait, and the next one goes on from there.
fn shard(args: &RenderArgs, messages: &MessageArgs) -> anyhow::Result<ExitCode> {
    let Some(path) = &args.plan else { return Ok(ExitCode::SUCCESS) };
    Signals::watch().context("signals cannot be watched")?;
    let plan = open_plan(path)?;
    let (number, threads) = args.shard(&plan)?;
    let job = cli::plan::planned_job(&plan, threads)?;
    // Whose signals nobody takes over.
    let terminal = Terminal::new(messages.progress, messages.verbosity(), Signals::default());
    tell_config(&terminal, &job.picture);
    let summary = job::render_shard(&plan, &job, number, &terminal);
    terminal.finish();
    let Summary { frames, kept, .. } = summary?;
    terminal.say(&format!("shard {number}: {} in {}", frames_of(frames, kept), job.out.display()));
    Ok(ExitCode::SUCCESS)
}

/// A plan, and the job that it stands for.
fn planned(args: &PlannedArgs) -> anyhow::Result<(Plan, RenderJob)> {
    let plan = open_plan(&args.plan)?;
    let job = cli::plan::planned_job(&plan, &args.threads)?;
    Ok((plan, job))
}

/// Reads a plan, and goes where its paths begin.
fn open_plan(path: &Path) -> anyhow::Result<Plan> {
    let plan = Plan::read(path).map_err(JobError::from)?;
    let folder = plan.folder(path).with_context(|| path.display().to_string())?;
    let what = "is where the paths of the plan begin, and cannot be entered";
    env::set_current_dir(&folder).with_context(|| format!("{}: {what}", folder.display()))?;
    Ok(plan)
}

/// Tells what was rendered.
fn rendered(
    job: &RenderJob,
    summary: &Summary,
    terminal: &Terminal,
    signals: &Signals,
) -> ExitCode {
    terminal.detail(&rays(&summary.rays));
    let stopped = if summary.cancelled { "stopped: " } else { "" };
    let films = match summary.films {
        0 => String::new(),
        films => format!(", {}", count(films as u64, "film")),
    };
    terminal.say(&format!(
        "{stopped}{}{films} in {}; games: {} whole, {} in part, {} skipped",
        frames_of(summary.frames, summary.kept),
        job.out.display(),
        summary.rendered,
        summary.partial,
        summary.skipped,
    ));
    match signals.came().filter(|_| summary.cancelled) {
        Some(number) => ExitCode::from(128 + number),
        None => whole(summary.partial + summary.skipped == 0),
    }
}

/// So many frames, of which some were kept.
fn frames_of(frames: u64, kept: u64) -> String {
    let frames = count(frames, "frame");
    match kept {
        0 => frames,
        1 => format!("{frames} (1 of them was there)"),
        _ => format!("{frames} ({kept} of them were there)"),
    }
}

/// Tells what pictures of a plan are missing.
fn verified(verdict: &Verdict, job: &RenderJob, terminal: &Terminal) -> anyhow::Result<ExitCode> {
    let (frames, out) = (count(verdict.frames, "frame"), job.out.display());
    if verdict.faults.is_empty() {
        terminal.say(&format!("all is there: {frames} in {out}"));
        return Ok(ExitCode::SUCCESS);
    }
    print_lines(&cli::table::verdict(verdict))?;
    let shards = verdict.shards().len() as u64;
    terminal.say(&format!(
        "{} of {frames} in {out} missing or broken, in {}",
        verdict.bad(),
        count(shards, "shard")
    ));
    Ok(ExitCode::from(INCOMPLETE))
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
