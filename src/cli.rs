//! The command line: from arguments to typed jobs.

use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use clap::{Args, ColorChoice, CommandFactory, FromArgMatches, Parser, Subcommand, ValueEnum};
use lightsquare::config::{Config, MAX_SIDE};
use lightsquare::game::{Moment, Selection};
use lightsquare::job::{DiagramJob, InspectJob, PictureSettings, RenderJob, Subject};
use lightsquare::notation::Placement;
use lightsquare::timeline::Film;
use lightsquare::tracer::Antialiasing;

use crate::progress::{ProgressMode, Verbosity};

/// Reads chess games (PGN), replays them and ray-traces them into numbered pictures.
#[derive(Parser)]
#[command(version, propagate_version = true, max_term_width = 100)]
pub struct Cli {
    #[command(subcommand)]
    pub command: Command,
    #[command(flatten)]
    pub messages: MessageArgs,
}

/// Reads the arguments; whoever asks for help, or gives a wrong one, is answered at once.
pub fn parse() -> Cli {
    // Answers are coloured before the arguments are read, so this one is looked for alone.
    let given: Vec<String> = std::env::args().collect();
    let asked = |when: &str| {
        given.iter().any(|argument| *argument == format!("--color={when}"))
            || given.windows(2).any(|pair| pair[0] == "--color" && pair[1] == when)
    };
    let choice = match (asked("always"), asked("never")) {
        (true, _) => ColorChoice::Always,
        (_, true) => ColorChoice::Never,
        _ => ColorChoice::Auto,
    };
    let matches = Cli::command().color(choice).get_matches();
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
    /// Render games, each into a folder of numbered pictures
    #[command(after_help = RENDER_EXAMPLES)]
    Render(RenderArgs),
    /// Render one position
    #[command(after_help = DIAGRAM_EXAMPLES)]
    Diagram(DiagramArgs),
    /// Say what files hold: a line a game, or every position
    #[command(after_help = INSPECT_EXAMPLES)]
    Inspect(InspectArgs),
}

const RENDER_EXAMPLES: &str = "\
Examples:
  lightsquare render games/opera-1858.pgn
  lightsquare render games/*.pgn --size 640x360 --out pictures
  lightsquare render games/opera-1858.pgn --from 12w --to end --animate --orbit 90
  curl -s https://example.org/games.pgn | lightsquare render - --select 1:3,10

Exit codes: 0 all done; 1 failed; 2 wrong usage; 3 done, but some game was not rendered whole
(report.jsonl says which); 130 and 143 after Ctrl-C and SIGTERM.";

const DIAGRAM_EXAMPLES: &str = "\
Examples:
  lightsquare diagram games/opera-1858.pgn --at 17w -o mate.png
  lightsquare diagram --fen '8/8/8/3k4/8/8/4P3/4K3 w - - 0 1' -o ending.png
  lightsquare diagram --white KE1PE2 --black KD5 -o - | display -";

const INSPECT_EXAMPLES: &str = "\
Examples:
  lightsquare inspect games/*.pgn
  lightsquare inspect games/opera-1858.pgn --positions | cut -f 4";

#[derive(Args)]
pub struct RenderArgs {
    /// Files of games in PGN; - is the standard input
    #[arg(required = true, value_name = "PGN")]
    inputs: Vec<PathBuf>,
    /// Folder for the pictures
    #[arg(short, long, value_name = "DIR", default_value = "out")]
    out: PathBuf,
    /// Numbers of games in their file, as in 3, 5-9 or 1:3,10
    #[arg(long, value_name = "GAMES")]
    select: Option<Selection>,
    /// First position: after a move (17w, 17b), after so many half-moves, or start
    #[arg(long, value_name = "MOVE", default_value = "start")]
    from: Moment,
    /// Last position, likewise, or end
    #[arg(long, value_name = "MOVE", default_value = "end")]
    to: Moment,
    /// Make the frames of a film, with the moves between the positions
    #[arg(long)]
    animate: bool,
    /// Frames a second, from 1 to 240
    #[arg(long, value_name = "N", default_value = "25", value_parser = fps, allow_negative_numbers = true, requires = "animate")]
    fps: f64,
    /// Seconds that a move takes
    #[arg(long, value_name = "S", default_value = "0.6", value_parser = seconds, allow_negative_numbers = true, requires = "animate")]
    transition: f64,
    /// Seconds that a position stands
    #[arg(long, value_name = "S", default_value = "0.8", value_parser = seconds, allow_negative_numbers = true, requires = "animate")]
    pause: f64,
    /// Seconds that the first position stands
    #[arg(long, value_name = "S", default_value = "1", value_parser = seconds, allow_negative_numbers = true, requires = "animate")]
    first: f64,
    /// Seconds that the last position stands
    #[arg(long, value_name = "S", default_value = "5", value_parser = seconds, allow_negative_numbers = true, requires = "animate")]
    last: f64,
    /// Turn the camera about the board by so many degrees over each game
    #[arg(long, value_name = "DEG", default_value = "0", value_parser = degrees, allow_negative_numbers = true)]
    orbit: f64,
    #[command(flatten)]
    picture: PictureArgs,
}

#[derive(Args)]
pub struct DiagramArgs {
    /// A file of games in PGN; - is the standard input
    #[arg(value_name = "PGN", required_unless_present_any = ["fen", "white", "black"])]
    input: Option<PathBuf>,
    /// The game's number in its file
    #[arg(long, value_name = "GAME", default_value = "1", value_parser = game_number, conflicts_with_all = ["fen", "white", "black"])]
    select: usize,
    /// The position: after a move (17w, 17b), after so many half-moves, start or end
    #[arg(long, value_name = "MOVE", default_value = "end", conflicts_with_all = ["fen", "white", "black"])]
    at: Moment,
    /// A position as FEN, or the board part of one; it need not be legal
    #[arg(long, value_name = "FEN", value_parser = fen, conflicts_with_all = ["input", "white", "black"])]
    fen: Option<FenArg>,
    /// White's pieces in the thesis's letters K D V S J P, as in KE1PE2
    #[arg(long, value_name = "PIECES", conflicts_with = "input")]
    white: Option<String>,
    /// Black's pieces, likewise
    #[arg(long, value_name = "PIECES", conflicts_with = "input")]
    black: Option<String>,
    /// The picture's file; - is the standard output
    #[arg(short, long, value_name = "FILE", default_value = "out/diagram.png")]
    output: PathBuf,
    #[command(flatten)]
    picture: PictureArgs,
}

#[derive(Args)]
pub struct InspectArgs {
    /// Files of games in PGN; - is the standard input
    #[arg(required = true, value_name = "PGN")]
    inputs: Vec<PathBuf>,
    /// Numbers of games in their file, as in 3, 5-9 or 1:3,10
    #[arg(long, value_name = "GAMES")]
    select: Option<Selection>,
    /// A tab-separated row for every position: game, ply, san, fen, white, black
    #[arg(long)]
    positions: bool,
}

/// What every picture has; the same words for every command.
#[derive(Args)]
struct PictureArgs {
    /// Settings; ./config.ini is read where there is one
    #[arg(short, long, value_name = "FILE", help_heading = "Picture")]
    config: Option<PathBuf>,
    /// Size in pixels, as in 1000x600
    #[arg(long, value_name = "WxH", value_parser = size, allow_hyphen_values = true, help_heading = "Picture")]
    size: Option<(u32, u32)>,
    /// Antialiasing: none (0), or a grid of rays in each pixel (1)
    #[arg(long, value_name = "MODE", default_value = "grid", help_heading = "Picture")]
    aa: AntialiasingMode,
    /// Rays along one side of a pixel's grid, from 1 to 32
    #[arg(long, value_name = "N", default_value = "2", value_parser = rays, help_heading = "Picture")]
    ssrays: u32,
    /// Threads, from 1 to 1024 [default: one a core]
    #[arg(long, value_name = "N", value_parser = threads, help_heading = "Picture")]
    cpu: Option<usize>,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum AntialiasingMode {
    #[value(alias = "0")]
    None,
    #[value(alias = "1")]
    Grid,
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

impl RenderArgs {
    pub fn into_job(self) -> anyhow::Result<RenderJob> {
        if self.out == Path::new("-") {
            bail!(UsageError("--out: expected a folder, found `-`".to_owned()));
        }
        let film = Film {
            fps: self.fps,
            transition: self.transition,
            pause: self.pause,
            first: self.first,
            last: self.last,
        };
        Ok(RenderJob {
            inputs: self.inputs,
            out: self.out,
            selection: self.select,
            from: self.from,
            to: self.to,
            film: self.animate.then_some(film),
            orbit: self.orbit,
            picture: self.picture.into_settings()?,
        })
    }
}

impl DiagramArgs {
    pub fn into_job(self) -> anyhow::Result<DiagramJob> {
        if let Some(ending) = self.output.extension().filter(|e| !e.eq_ignore_ascii_case("png")) {
            let ending = ending.to_string_lossy();
            bail!(UsageError(format!(
                "--output: pictures are PNG, found `.{ending}`, expected `.png`"
            )));
        }
        let subject = match (self.input, self.fen) {
            (Some(file), _) => Subject::Game { file, number: self.select, at: self.at },
            (None, Some(FenArg(placement, fen))) => Subject::Placement { placement, fen },
            (None, None) => {
                let [white, black] =
                    [&self.white, &self.black].map(|text| text.as_deref().unwrap_or_default());
                let placement = Placement::parse(white, black)
                    .map_err(|error| UsageError(format!("--white or --black: {error}")))?;
                Subject::Placement { fen: placement.board_fen(), placement }
            }
        };
        Ok(DiagramJob { subject, output: self.output, picture: self.picture.into_settings()? })
    }
}

impl InspectArgs {
    pub fn into_job(self) -> InspectJob {
        InspectJob { inputs: self.inputs, selection: self.select, positions: self.positions }
    }
}

impl PictureArgs {
    fn into_settings(self) -> anyhow::Result<PictureSettings> {
        let here = PathBuf::from("config.ini");
        let config_file = self.config.or_else(|| here.is_file().then_some(here));
        let mut config = config_file.as_deref().map(read_config).transpose()?.unwrap_or_default();
        if let Some((width, height)) = self.size {
            (config.width, config.height) = (width, height);
        }
        Ok(PictureSettings {
            config,
            config_file,
            antialiasing: match self.aa {
                AntialiasingMode::None => Antialiasing::None,
                AntialiasingMode::Grid => Antialiasing::Grid(self.ssrays),
            },
            threads: self.cpu,
        })
    }
}

/// An argument that only proves wrong together with others, or on a second look.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct UsageError(String);

fn read_config(path: &Path) -> anyhow::Result<Config> {
    if path.is_dir() {
        bail!("{}: is a folder, expected a config.ini", path.display());
    }
    let bytes =
        std::fs::read(path).with_context(|| format!("{}: cannot be read", path.display()))?;
    Config::parse(&String::from_utf8_lossy(&bytes)).with_context(|| path.display().to_string())
}

fn size(text: &str) -> Result<(u32, u32), String> {
    let side = |text: &str| text.parse().ok().filter(|side| (1..=MAX_SIDE).contains(side));
    text.split_once(['x', 'X', '×'])
        .and_then(|(width, height)| Some((side(width)?, side(height)?)))
        .ok_or_else(|| {
            format!("expected WIDTHxHEIGHT in pixels, each from 1 to {MAX_SIDE}, as in 1000x600")
        })
}

fn number(text: &str, min: f64, max: f64) -> Result<f64, String> {
    text.parse()
        .ok()
        .filter(|number| (min..=max).contains(number))
        .ok_or_else(|| format!("expected a number from {min} to {max}"))
}

fn whole_number(text: &str, min: usize, max: usize) -> Result<usize, String> {
    text.parse()
        .ok()
        .filter(|number| (min..=max).contains(number))
        .ok_or_else(|| format!("expected a whole number from {min} to {max}"))
}

fn game_number(text: &str) -> Result<usize, String> {
    whole_number(text, 1, 1_000_000_000)
}

fn rays(text: &str) -> Result<u32, String> {
    whole_number(text, 1, 32).map(|rays| rays as u32)
}

fn threads(text: &str) -> Result<usize, String> {
    whole_number(text, 1, 1024)
}

fn fps(text: &str) -> Result<f64, String> {
    number(text, 1.0, 240.0)
}

fn seconds(text: &str) -> Result<f64, String> {
    number(text, 0.0, 3600.0)
}

fn degrees(text: &str) -> Result<f64, String> {
    number(text, -36_000.0, 36_000.0)
}

/// A placement with the FEN that it was read from.
#[derive(Clone)]
struct FenArg(Placement, String);

fn fen(text: &str) -> Result<FenArg, String> {
    Placement::from_fen(text).map(|placement| FenArg(placement, text.to_owned())).map_err(|error| {
        format!(
            "{error}, expected a FEN such as 8/8/8/3k4/8/8/4P3/4K3 w - - 0 1, or its board part"
        )
    })
}
