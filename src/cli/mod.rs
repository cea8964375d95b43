//! The command line: from arguments to typed jobs.

mod film;
mod marks;
mod picture;
pub mod plan;
mod preset;
mod print;
mod subject;
pub mod table;
mod thesis;
mod values;
mod wanted;

use std::path::{Path, PathBuf};

use anyhow::bail;
use clap::{Args, ColorChoice, CommandFactory, FromArgMatches, Parser, Subcommand, ValueEnum};
use lightsquare::config::{Config, Look, Shading};
use lightsquare::game::{Letters, Moment};
use lightsquare::job::{
    BenchJob, DiagramJob, ExportJob, InspectJob, Listing, PictureSettings, RenderJob,
};
use lightsquare::output::{FORMATS, PictureFormat};

use crate::progress::{ProgressMode, Verbosity};
use film::FilmArgs;
use marks::DrawnArgs;
use picture::PictureArgs;
use plan::{PlanArgs, PlannedArgs};
use print::PrintArgs;
use subject::SubjectArgs;
use values::{every, plies, runs, shard, threads};
use wanted::WantedArgs;

/// Reads chess games (PGN), replays them and ray-traces them into pictures and films.
#[derive(Parser)]
#[command(version, propagate_version = true, max_term_width = 100, after_help = THESIS_LINE)]
pub struct Cli {
    #[command(subcommand)]
    pub command: Command,
    #[command(flatten)]
    pub messages: MessageArgs,
}

const THESIS_LINE: &str = "\
The form of the thesis of 2008 works too, with its set, look and camera:
  lightsquare -config config.ini -output a.bmp -AA 2 -ssrays 3 -cpu 2 -whiteplayer KE1PE2
              -blackplayer KE8";

/// The job that a line in the form of the thesis asks for; `None` for a command of today.
///
/// # Errors
/// An option that is none, a value that it cannot have, settings that cannot be read.
pub fn thesis_job() -> anyhow::Result<Option<DiagramJob>> {
    let given = arguments();
    given.get(1..).filter(|given| thesis::is_meant(given)).map(thesis::job).transpose()
}

fn arguments() -> Vec<String> {
    std::env::args_os().map(|argument| argument.to_string_lossy().into_owned()).collect()
}

/// Reads the arguments; whoever asks for help, or gives a wrong one, is answered at once.
pub fn parse() -> Cli {
    // Answers are coloured before the arguments are read, so this one is looked for alone.
    let given = arguments();
    let asked = |when: &str| {
        given.iter().any(|argument| *argument == format!("--color={when}"))
            || given.windows(2).any(|pair| pair[0] == "--color" && pair[1] == when)
    };
    let choice = match (asked("always"), asked("never")) {
        (true, _) => ColorChoice::Always,
        (_, true) => ColorChoice::Never,
        _ => ColorChoice::Auto,
    };
    let mut command = Cli::command().color(choice);
    let matches = command.get_matches_mut();
    plan::refuse_beside_plan(&mut command, &matches);
    let cli = Cli::from_arg_matches(&matches).unwrap_or_else(|error| error.exit());
    match cli.messages.color {
        ColorMode::Auto => {}
        ColorMode::Always => anstream::ColorChoice::Always.write_global(),
        ColorMode::Never => anstream::ColorChoice::Never.write_global(),
    }
    cli
}

/// How much is said, and how.
#[derive(Args)]
#[command(next_help_heading = "Messages")]
pub struct MessageArgs {
    /// Say nothing but errors
    #[arg(short, long, global = true)]
    quiet: bool,
    /// Say more: the settings that are used, what was done
    #[arg(short, long, global = true, conflicts_with = "quiet")]
    verbose: bool,
    /// When to colour messages
    #[arg(long, global = true, value_name = "WHEN", default_value = "auto")]
    color: ColorMode,
    /// How to show progress
    #[arg(long, global = true, value_name = "HOW", default_value = "auto")]
    pub progress: ProgressMode,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum ColorMode {
    Auto,
    Always,
    Never,
}

#[derive(Subcommand)]
pub enum Command {
    /// Render games, each into a folder of numbered pictures, films, or both
    #[command(after_help = format!("{RENDER_EXAMPLES}\n\n{}", wanted::EXAMPLES))]
    Render(RenderArgs),
    /// Cut the rendering of games into shards, for many machines
    #[command(after_help = format!("{}\n\n{}", plan::PLAN_EXAMPLES, wanted::EXAMPLES))]
    Plan(PlanArgs),
    /// Say which pictures of a plan are missing or broken
    #[command(after_help = plan::VERIFY_EXAMPLES)]
    Verify(PlannedArgs),
    /// Make films and reports of a plan's pictures, once all are there
    #[command(after_help = plan::MERGE_EXAMPLES)]
    Merge(PlannedArgs),
    /// Render one position
    #[command(after_help = DIAGRAM_EXAMPLES)]
    Diagram(DiagramArgs),
    /// Say what files hold: a line a game, every position, or what is said of the moves
    #[command(after_help = format!("{INSPECT_EXAMPLES}\n\n{}", wanted::EXAMPLES))]
    Inspect(InspectArgs),
    /// Write the scene of one position for another renderer
    #[command(after_help = EXPORT_EXAMPLES)]
    Export(ExportArgs),
    /// Measure the thesis's picture at the thesis's three settings, and a game
    #[command(after_help = BENCH_EXAMPLES)]
    Bench(BenchArgs),
}

const RENDER_EXAMPLES: &str = "\
Examples:
  lightsquare render games/opera-1858.pgn
  lightsquare render games/*.pgn --size 640x360 --out pictures
  lightsquare render games/opera-1858.pgn --for wide --no-frames
  lightsquare render games/opera-1858.pgn --size 720x720 --film gif --film mp4 --animate
  lightsquare render games/opera-1858.pgn --from 12w --to end --animate --orbit 90
  curl -s https://example.org/games.pgn | lightsquare render - --select 1:3,10
  lightsquare render --plan plan.jsonl --shard 7

Exit codes: 0 all done; 1 failed; 2 wrong usage; 3 done, but some game was not rendered whole
(report.jsonl says which); 130 and 143 after Ctrl-C and SIGTERM.";

const DIAGRAM_EXAMPLES: &str = "\
Examples:
  lightsquare diagram games/opera-1858.pgn --at 17w -o mate.png
  lightsquare diagram --fen '8/8/8/3k4/8/8/4P3/4K3 w - - 0 1' -o ending.png
  lightsquare diagram games/opera-1858.pgn --at 9w --camera top --coordinates --width 80mm
  lightsquare diagram games/opera-1858.pgn --at 9w --arrows Gc3b5,Rb5d7 --squares Rd7
  lightsquare diagram --white KE1PE2 --black KD5 -o - | display -";

const INSPECT_EXAMPLES: &str = "\
Examples:
  lightsquare inspect games/*.pgn
  lightsquare inspect games/opera-1858.pgn --positions | cut -f 4
  lightsquare inspect games/*.pgn --notes > notes.tsv
  lightsquare inspect base.pgn --player Kasparov --tag 'Date<1990' --checkmate

In the table of --notes times are seconds, evals pawns or #moves to mate, and - is nothing; the main
line's variation is -, others are named by the moves that begin them (12w-nf3/13b-e5).";

const EXPORT_EXAMPLES: &str = "\
Examples:
  lightsquare export --format pov games/opera-1858.pgn --at 17w -o scene.pov
  povray +Iscene.pov +W1000 +H600 -A

lightsquare's own picture of it: lightsquare diagram --aa none with the same options. With --plain
both agree but for single pixels at edges; without it POV-Ray has wood and marble of its own.";

const BENCH_EXAMPLES: &str = "\
Examples:
  lightsquare bench
  lightsquare bench --cpu 2 --runs 7 --json
  lightsquare bench --plies 0";

/// What is rendered of which games, and how.
#[derive(Args)]
pub struct GamesArgs {
    /// Files of games in PGN, packed ones (zstd, gzip, bzip2) too; - is the standard input
    #[arg(required_unless_present = "print_config", value_name = "PGN")]
    inputs: Vec<PathBuf>,
    /// Letters of the pieces: english, german, french, czech, …; auto finds those of a whole game
    #[arg(long, value_name = "LANGUAGE", default_value = "auto")]
    letters: Letters,
    /// First position: after a move (17w, 17b), after so many half-moves, or start
    #[arg(long, value_name = "MOVE", default_value = "start")]
    from: Moment,
    /// Last position, likewise, or end
    #[arg(long, value_name = "MOVE", default_value = "end")]
    to: Moment,
    /// This position alone, likewise
    #[arg(long, value_name = "MOVE", conflicts_with_all = ["from", "to"])]
    at: Option<Moment>,
    /// Of the positions every Nth from the first on, and the last one
    #[arg(
        long,
        value_name = "N",
        default_value = "1",
        value_parser = every,
        conflicts_with_all = ["timed", "title", "result", "frames", "variations"]
    )]
    every: usize,
    /// Render variations too, each in a folder of its own within its game's, named by its first move
    #[arg(long, conflicts_with = "frames")]
    variations: bool,
    #[command(flatten)]
    wanted: WantedArgs,
    #[command(flatten)]
    film: FilmArgs,
    #[command(flatten)]
    picture: PictureArgs,
}

#[derive(Args)]
#[command(mut_arg("inputs", |inputs| inputs.required_unless_present_any(["print_config", "plan"])))]
pub struct RenderArgs {
    #[command(flatten)]
    games: GamesArgs,
    /// Folder for the pictures
    #[arg(short, long, value_name = "DIR", default_value = "out")]
    out: PathBuf,
    /// Give up rather than replace pictures of other settings or another game
    #[arg(long)]
    no_replace: bool,
    /// Say how many games and frames there are, and about how many bytes and how long they will take; render nothing
    #[arg(long)]
    pub estimate: bool,
    /// Render a shard of a plan, which says all else
    #[arg(long, value_name = "FILE", help_heading = "Many machines")]
    pub plan: Option<PathBuf>,
    /// Which one, counted from 0 [default: SLURM_ARRAY_TASK_ID of the environment]
    #[arg(long, value_name = "N", help_heading = "Many machines", requires = "plan", value_parser = shard)]
    shard: Option<usize>,
}

#[derive(Args)]
pub struct DiagramArgs {
    #[command(flatten)]
    subject: SubjectArgs,
    /// The picture's file, .png, .jpg, .bmp, .tiff or .webp; - is the standard output, as PNG
    #[arg(short, long, value_name = "FILE", default_value = "out/diagram.png")]
    output: PathBuf,
    #[command(flatten)]
    picture: PictureArgs,
    #[command(flatten)]
    drawn: DrawnArgs,
    #[command(flatten)]
    print: PrintArgs,
}

#[derive(Args)]
pub struct ExportArgs {
    #[command(flatten)]
    subject: SubjectArgs,
    /// The renderer that is to read it
    #[arg(long, value_name = "NAME", default_value = "pov")]
    format: ExportFormat,
    /// The scene's file; - is the standard output. Pictures on bodies stand beside it
    #[arg(short, long, value_name = "FILE", default_value = "out/scene.pov")]
    output: PathBuf,
    #[command(flatten)]
    picture: PictureArgs,
}

#[derive(Clone, Copy, ValueEnum)]
enum ExportFormat {
    /// POV-Ray 3.7.
    Pov,
}

#[derive(Args)]
pub struct BenchArgs {
    /// Threads, from 1 to 1024
    #[arg(long, value_name = "N", default_value = "1", value_parser = threads)]
    cpu: usize,
    /// How often each of the thesis's settings is rendered, from 1 to 1000; the quickest counts
    #[arg(long, value_name = "N", default_value = "3", value_parser = runs)]
    runs: usize,
    /// Half-moves of the game that are rendered, once, from 0 to 1000; it has 87
    #[arg(long, value_name = "N", default_value = "4", value_parser = plies)]
    plies: usize,
    /// Write JSON instead of tables
    #[arg(long)]
    pub json: bool,
}

#[derive(Args)]
pub struct InspectArgs {
    /// Files of games in PGN, packed ones (zstd, gzip, bzip2) too; - is the standard input
    #[arg(required = true, value_name = "PGN")]
    inputs: Vec<PathBuf>,
    /// Letters of the pieces: english, german, french, czech, …; auto finds those of a whole game
    #[arg(long, value_name = "LANGUAGE", default_value = "auto")]
    letters: Letters,
    /// A tab-separated row for every position: game, ply, san, fen, white, black
    #[arg(long, conflicts_with = "notes")]
    positions: bool,
    /// A tab-separated row for the start and every move, those of variations too, with what
    /// comments and glyphs say: game, variation, ply, san, clk, emt, eval, csl, cal, nags
    #[arg(long)]
    notes: bool,
    /// Say how many games and frames `render` would make of them with its defaults, and about how many bytes and
    /// how long they would take; `render --estimate` takes other settings too
    #[arg(long, conflicts_with_all = ["positions", "notes"])]
    pub estimate: bool,
    #[command(flatten)]
    wanted: WantedArgs,
}

impl MessageArgs {
    pub fn verbosity(&self) -> Verbosity {
        match (self.quiet, self.verbose) {
            (true, _) => Verbosity::Quiet,
            (_, true) => Verbosity::Verbose,
            _ => Verbosity::Normal,
        }
    }
}

impl GamesArgs {
    fn into_job(self, out: PathBuf, refuses_old: bool) -> anyhow::Result<RenderJob> {
        if out == Path::new("-") {
            bail!(UsageError("--out: expected a folder, found `-`".to_owned()));
        }
        let picture = self.settings()?;
        Ok(RenderJob {
            names: self.film.names(&picture.config)?,
            films: self.film.films(&picture.config)?,
            inputs: self.inputs,
            out,
            wanted: self.wanted.into_wanted()?,
            letters: self.letters,
            from: self.at.unwrap_or(self.from),
            to: self.at.unwrap_or(self.to),
            variations: self.variations,
            showing: self.film.showing(),
            frames: self.film.frames,
            every: self.every,
            refuses_old,
            picture,
        })
    }

    /// The settings, as the place that a film is for has them.
    fn settings(&self) -> anyhow::Result<PictureSettings> {
        self.picture.settings_for(self.film.preset(), Look::default())
    }
}

impl RenderArgs {
    pub fn into_job(self) -> anyhow::Result<RenderJob> {
        self.games.into_job(self.out, self.no_replace)
    }
}

impl DiagramArgs {
    pub fn into_job(self) -> anyhow::Result<DiagramJob> {
        let to_stdout = self.output == Path::new("-");
        if !to_stdout && PictureFormat::of(&self.output).is_none() {
            let name = self.output.display();
            let known: Vec<&str> = FORMATS.iter().map(|(ending, _)| *ending).collect();
            let known = known.join(", .");
            bail!(UsageError(format!("--output: expected a file of .{known}, found `{name}`")));
        }
        let (picture, dpi) = self.settings()?;
        keep_transparency("--output", &picture.config, &self.output)?;
        let (subject, drawn) = (self.subject.into_subject()?, self.drawn.into_drawn());
        Ok(DiagramJob { subject, drawn, output: self.output, picture, dpi })
    }

    /// The settings, with the size that the width on paper asks for, and the pixels an inch.
    fn settings(&self) -> anyhow::Result<(PictureSettings, Option<u32>)> {
        let mut picture = self.picture.settings(Look::default())?;
        let dpi = self.print.apply(&mut picture.config)?;
        self.drawn.show(self.picture.marks.as_ref(), &mut picture.config.marks)?;
        Ok((picture, dpi))
    }
}

impl ExportArgs {
    pub fn into_job(self) -> anyhow::Result<ExportJob> {
        let ExportFormat::Pov = self.format;
        let is_scene = self.output.extension().is_some_and(|e| e.eq_ignore_ascii_case("pov"));
        if self.output != Path::new("-") && !is_scene {
            let name = self.output.display();
            bail!(UsageError(format!("--output: expected a .pov file, found `{name}`")));
        }
        let picture = self.picture.settings(Look::Thesis)?;
        if picture.config.render.shading == Shading::Studio {
            let message = "POV-Ray's scenes are written as Phong's model has them, expected --look \
                           thesis, or Shading=phong in the settings";
            bail!(UsageError(message.to_owned()));
        }
        Ok(ExportJob { subject: self.subject.into_subject()?, output: self.output, picture })
    }
}

impl BenchArgs {
    pub fn to_job(&self) -> BenchJob {
        BenchJob { threads: Some(self.cpu), runs: self.runs, plies: self.plies }
    }
}

impl Command {
    /// The settings in force, where a command is asked to print them and do nothing else.
    pub fn config_to_print(&self) -> anyhow::Result<Option<Config>> {
        let settings = match self {
            Command::Render(args) if args.games.picture.print_config => args.games.settings()?,
            Command::Plan(args) if args.games.picture.print_config => args.games.settings()?,
            Command::Export(args) if args.picture.print_config => {
                args.picture.settings(Look::Thesis)?
            }
            Command::Diagram(args) if args.picture.print_config => args.settings()?.0,
            _ => return Ok(None),
        };
        Ok(Some(settings.config))
    }
}

impl InspectArgs {
    /// What `render` would do with the games.
    pub fn into_render_job(self) -> anyhow::Result<RenderJob> {
        let command = RenderArgs::augment_args(clap::Command::new("render"));
        let inputs = self.inputs.iter().map(|input| input.as_os_str());
        let given = ["render".as_ref(), "--".as_ref()].into_iter().chain(inputs);
        let render = RenderArgs::from_arg_matches(&command.try_get_matches_from(given)?)?;
        let games = GamesArgs { wanted: self.wanted, letters: self.letters, ..render.games };
        RenderArgs { games, ..render }.into_job()
    }

    pub fn into_job(self) -> Result<InspectJob, UsageError> {
        let listing = match (self.positions, self.notes) {
            (true, _) => Listing::Positions,
            (_, true) => Listing::Notes,
            _ => Listing::Games,
        };
        let (inputs, letters) = (self.inputs, self.letters);
        Ok(InspectJob { inputs, wanted: self.wanted.into_wanted()?, letters, listing })
    }
}

/// Refuses to write a transparent picture in a format that is not.
fn keep_transparency(flag: &str, config: &Config, output: &Path) -> Result<(), UsageError> {
    let has_alpha = PictureFormat::of(output).is_none_or(PictureFormat::has_alpha);
    if config.is_transparent() && !has_alpha {
        let name = output.display();
        return Err(UsageError(format!(
            "{flag}: expected a .png, .tiff or .webp file for a transparent picture, found `{name}`"
        )));
    }
    Ok(())
}

/// An argument that only proves wrong together with others, or on a second look.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct UsageError(String);
