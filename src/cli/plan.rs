//! Plans: from arguments to jobs, and back from a plan's own arguments.

use std::env;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

use anyhow::bail;
use clap::error::ErrorKind;
use clap::parser::ValueSource;
use clap::{ArgMatches, Args, Parser};
use lightsquare::job::{Plan, RenderJob};

use super::picture::ThreadsArgs;
use super::values::shards;
use super::{Cli, Command, GamesArgs, RenderArgs, UsageError};

pub const PLAN_EXAMPLES: &str = "\
Examples:
  lightsquare plan base.pgn --player Kasparov --animate --film mp4 --shards 40 -o plan.jsonl
  lightsquare render --plan plan.jsonl --shard 0     # and 1, 2, … 39, on any machines, in any order
  lightsquare verify plan.jsonl                      # what is missing or broken
  lightsquare merge plan.jsonl                       # films and reports

The standard output says which tasks to start: --array=0-39, as Slurm's sbatch takes it. Paths in the plan begin
where they began for `plan`, seen from the plan's own folder: keep both where all machines find them.
cluster/ has scripts for Slurm, a template for Open Job Description and a line for GNU parallel.";

pub const VERIFY_EXAMPLES: &str = "\
Example:
  tasks=$(lightsquare verify plan.jsonl | head -n 1)
  [ -z \"$tasks\" ] || sbatch \"$tasks\" array.sh plan.jsonl

The first line names the shards to send again, as Slurm's sbatch takes them: --array=2,5-7. The others, with tabs
between: shard, folder, numbers of pictures, missing or broken. Of films it is seen whether they are there.

Exit codes: 0 all pictures are there and whole; 1 failed; 2 wrong usage; 3 some are not.";

pub const MERGE_EXAMPLES: &str = "\
Example:
  lightsquare merge plan.jsonl

Exit codes: 0 all done; 1 failed; 2 wrong usage; 3 pictures are missing, and nothing was written (the standard output
says which, as verify does), or some game was not rendered whole (report.jsonl says which).";

#[derive(Args)]
pub struct PlanArgs {
    #[command(flatten)]
    pub games: GamesArgs,
    /// Folder for the pictures, where all machines find it
    #[arg(long, value_name = "DIR", default_value = "out")]
    out: PathBuf,
    /// The plan's file
    #[arg(short, long, value_name = "FILE", default_value = "plan.jsonl")]
    pub output: PathBuf,
    /// How many shards, from 1 to 1000 [default: as many as have some minutes of work each]
    #[arg(long, value_name = "N", value_parser = shards)]
    pub shards: Option<usize>,
}

/// A plan that was made.
#[derive(Args)]
pub struct PlannedArgs {
    /// The plan's file
    #[arg(value_name = "PLAN")]
    pub plan: PathBuf,
    #[command(flatten)]
    pub threads: ThreadsArgs,
}

/// What may be said of a shard; its plan says all else.
const BESIDE_PLAN: [&str; 7] = ["plan", "shard", "cpu", "quiet", "verbose", "color", "progress"];

/// Refuses options of `render` that a plan has settled.
pub fn refuse_beside_plan(command: &mut clap::Command, matches: &ArgMatches) {
    let Some(("render", given)) = matches.subcommand() else { return };
    let Some(render) = command.find_subcommand_mut("render") else { return };
    let is_given = |id: &str| given.value_source(id) == Some(ValueSource::CommandLine);
    let others = render.get_arguments().filter(|argument| {
        let id = argument.get_id().as_str();
        !BESIDE_PLAN.contains(&id) && !matches!(id, "help" | "version") && is_given(id)
    });
    let other = others.map(ToString::to_string).next().filter(|_| is_given("plan"));
    if let Some(other) = other {
        let message = format!(
            "the argument '{other}' cannot be used with '--plan <FILE>', which says all but --cpu"
        );
        render.error(ErrorKind::ArgumentConflict, message).exit();
    }
}

impl RenderArgs {
    /// The shard of `plan` that is asked for, and the threads that are to render it.
    pub fn shard(&self, plan: &Plan) -> Result<(usize, &ThreadsArgs), UsageError> {
        let of_array = || match env::var(TASK) {
            Ok(text) => text.trim().parse().map_err(|_| {
                UsageError(format!("{TASK}: expected a shard's number, found `{text}`"))
            }),
            Err(_) => {
                let message = format!("--shard: expected a shard's number, and there is no {TASK}");
                Err(UsageError(message))
            }
        };
        let shard = self.shard.map_or_else(of_array, Ok)?;
        plan.shard(shard).map_err(|error| UsageError(error.to_string()))?;
        Ok((shard, &self.games.picture.threads))
    }
}

/// Where Slurm tells a task of an array its number.
const TASK: &str = "SLURM_ARRAY_TASK_ID";

impl PlanArgs {
    pub fn into_job(self) -> anyhow::Result<RenderJob> {
        if self.output == Path::new("-") {
            bail!(UsageError("--output: expected a file, found `-`".to_owned()));
        }
        if self.output == self.out {
            let name = self.out.display();
            bail!(UsageError(format!(
                "--output: expected a file, found the folder of --out, `{name}`"
            )));
        }
        self.games.into_job(self.out, false)
    }
}

/// The job that the arguments of a plan stand for, as this machine has it, with as many threads as are asked for here.
///
/// # Errors
/// Arguments of no plan, settings that cannot be read.
pub fn planned_job(plan: &Plan, threads: &ThreadsArgs) -> anyhow::Result<RenderJob> {
    let given = ["lightsquare"].into_iter().chain(plan.arguments());
    let name = &plan.name;
    let args = match Cli::try_parse_from(given).map(|cli| cli.command) {
        Ok(Command::Plan(args)) => args,
        Ok(_) => bail!("{name}: its arguments are those of another command than plan"),
        Err(error) => {
            let error = error.to_string();
            let first = error.lines().next().unwrap_or_default();
            bail!("{name}: {}", first.strip_prefix("error: ").unwrap_or(first));
        }
    };
    let mut job = args.into_job()?;
    // Those of the machine that made the plan are its own.
    job.picture.threads = threads.cpu;
    Ok(job)
}

/// The arguments that were given, for a plan to keep.
///
/// # Errors
/// When one of them is no text.
pub fn arguments_to_keep() -> Result<Vec<String>, UsageError> {
    let given = env::args_os().skip(1);
    let text = |argument: OsString| {
        argument.into_string().map_err(|argument| {
            let argument = argument.to_string_lossy().into_owned();
            UsageError(format!("`{argument}`: cannot be written into a plan, expected UTF-8"))
        })
    };
    given.map(text).collect()
}
