//! Whole games, as numbered pictures in folders.

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};

use super::captions::GameCaptions;
use super::report::{FrameRow, Manifest, ReportLine, Status, tags, texts};
use super::studio::{PictureSettings, Studio};
use super::{JobError, MAX_FRAMES, Progress, say_missing, say_problems, shown};
use crate::game::{Absent, Game, Moment, Problem, Selection, Source, printable, shortened};
use crate::notation::Color;
use crate::output::{
    frame_name, prepare_folder, remove_frames, slug, write_json, write_json_lines, write_png,
};
use crate::scene::Reach;
use crate::timeline::{Film, Timeline};
use crate::tracer::RayCounts;

/// Which games to render, how, and where to.
#[derive(Clone, Debug)]
pub struct RenderJob {
    /// Files of games; `-` is the standard input.
    pub inputs: Vec<PathBuf>,
    /// The folder that gets one folder a file, each with one folder a game.
    pub out: PathBuf,
    /// All games when `None`.
    pub selection: Option<Selection>,
    /// The first position and the last one.
    pub from: Moment,
    pub to: Moment,
    /// Frames between the positions; one picture a position when `None`.
    pub film: Option<Film>,
    /// How far the camera turns about the board over each game, in degrees.
    pub orbit: f64,
    pub picture: PictureSettings,
}

/// What a job did.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Summary {
    pub rendered: usize,
    pub partial: usize,
    pub skipped: usize,
    /// Pictures that were written.
    pub frames: u64,
    pub rays: RayCounts,
    /// Whether the job was told to stop.
    pub cancelled: bool,
}

/// A file of games, read and cut to what is wanted.
struct Batch {
    file: String,
    folder: PathBuf,
    games: Vec<(Game, Option<Part>)>,
}

/// The part of a game that is shown: its first and last position, in half-moves.
struct Part {
    first: usize,
    last: usize,
    frames: usize,
}

/// Renders games into pictures; each gets a manifest, each file a report.
///
/// All input is read before the first picture, and nothing is written if any of it cannot be read
/// at all. Games that can be played only in part are rendered in part. Numbered pictures of an
/// earlier run in a game's folder are removed.
///
/// # Errors
/// Input that cannot be read, output that cannot be written, or a selection without games.
pub fn render(job: &RenderJob, progress: &dyn Progress) -> Result<Summary, JobError> {
    let mut batches = Vec::new();
    for (input, name) in job.inputs.iter().zip(folder_names(&job.inputs)) {
        batches.push(read_batch(job, input, job.out.join(name), progress)?);
    }
    let reach = Reach { moves: job.film.is_some(), orbit: job.orbit };
    let studio = Studio::new(&job.picture, reach)?;
    let mut run = Run { job, progress, studio, summary: Summary::default() };
    for batch in &batches {
        keep_out(job, &batch.folder)?;
        prepare_folder(&batch.folder)?;
    }
    let parts = batches.iter().flat_map(|batch| &batch.games).filter_map(|(_, part)| part.as_ref());
    progress.begin(parts.map(|part| part.frames as u64).sum());
    for batch in &batches {
        if !run.summary.cancelled {
            run.batch(batch)?;
        }
    }
    run.summary.rays = run.studio.rays();
    Ok(run.summary)
}

/// Refuses to write into a folder that holds what is read: a game, the settings, a picture, a set.
fn keep_out(job: &RenderJob, folder: &Path) -> Result<(), JobError> {
    let Ok(folder) = fs::canonicalize(folder) else {
        return Ok(());
    };
    let of_pictures = job.picture.inputs();
    let mut inputs = job.inputs.iter().chain(&of_pictures);
    let lies_within =
        |input: &&PathBuf| fs::canonicalize(input).is_ok_and(|input| input.starts_with(&folder));
    match inputs.find(lies_within) {
        Some(input) => Err(JobError::InputInOutput { path: input.clone() }),
        None => Ok(()),
    }
}

/// One folder name a file: its own without the ending, with a number where that is taken.
fn folder_names(inputs: &[PathBuf]) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for input in inputs {
        let stem = input.file_stem().filter(|_| input != Path::new("-"));
        let stem = stem.map_or("stdin".into(), OsStr::to_string_lossy);
        // A name that leads elsewhere is none.
        let stem = match stem.as_ref() {
            "." | ".." => "games".to_owned(),
            name => printable(name),
        };
        let numbered = (2..).map(|number| format!("{stem}-{number}"));
        let free = std::iter::once(stem.clone()).chain(numbered).find(|name| !names.contains(name));
        names.push(free.unwrap_or(stem));
    }
    names
}

fn read_batch(
    job: &RenderJob,
    input: &Path,
    folder: PathBuf,
    progress: &dyn Progress,
) -> Result<Batch, JobError> {
    let file = shown(input);
    let mut games = Vec::new();
    let mut seen = 0;
    for game in Source::open(input)?.games() {
        let mut game = game?;
        seen += 1;
        if job.selection.as_ref().is_some_and(|selection| !selection.contains(game.number)) {
            continue;
        }
        let part = part(job, &mut game);
        say_problems(&file, &game, progress);
        if let Some(Part { frames, .. }) = part
            && frames > MAX_FRAMES
        {
            return Err(JobError::TooLong { file, game: game.number, frames });
        }
        games.push((game, part));
    }
    if games.is_empty() {
        return Err(JobError::NothingSelected { file, games: seen });
    }
    say_missing(&file, job.selection.as_ref(), seen, progress);
    Ok(Batch { file, folder, games })
}

/// What to show of a game; why nothing is added to its problems.
fn part(job: &RenderJob, game: &mut Game) -> Option<Part> {
    if !game.start_is_known {
        return None;
    }
    let end = game.plies.len();
    let first = job.from.ply(game).map_err(|absent| ("--from", job.from, absent));
    let last = match job.to.ply(game) {
        // A film that is to go on longer than the game ends with it.
        Err(Absent::BehindTheEnd) => Ok(end),
        other => other.map_err(|absent| ("--to", job.to, absent)),
    };
    let (flag, moment, clause) = match (first, last) {
        (Ok(first), Ok(last)) if first <= last => {
            let moves = last - first;
            let frames = job.film.map_or(moves + 1, |film| film.frames(moves));
            return Some(Part { first, last, frames });
        }
        (Ok(_), Ok(last)) => ("--from", job.from, format!("is behind {}", game.moment_name(last))),
        (Err((flag, moment, Absent::BeforeTheStart)), _)
        | (_, Err((flag, moment, Absent::BeforeTheStart))) => {
            (flag, moment, format!("is before the start, the first move is {}", game.first_move()))
        }
        (Err((flag, moment, _)), _) | (_, Err((flag, moment, _))) => {
            (flag, moment, format!("is behind the end, {}", game.moment_name(end)))
        }
    };
    game.problems.push(Problem {
        line: game.line,
        token: format!("{flag} {moment}"),
        what: clause,
        loses_moves: false,
    });
    None
}

/// A job under way.
struct Run<'a> {
    job: &'a RenderJob,
    progress: &'a dyn Progress,
    studio: Studio<'a>,
    summary: Summary,
}

impl Run<'_> {
    /// Renders the games of a file; the report tells of all that were begun, even where one fails.
    fn batch(&mut self, batch: &Batch) -> Result<(), JobError> {
        let mut report = Vec::new();
        let mut outcome = Ok(());
        for (game, part) in &batch.games {
            if self.summary.cancelled || outcome.is_err() {
                break;
            }
            let Some(part) = part else {
                self.summary.skipped += 1;
                report.push(ReportLine::new(game, Status::Skipped, 0, None));
                continue;
            };
            let name = game_folder(game);
            let before = self.summary.frames;
            outcome = self.game(batch, &batch.folder.join(&name), game, part);
            let status = match outcome {
                Ok(()) if self.summary.cancelled => Status::Stopped,
                Ok(()) if game.is_whole() => Status::Rendered,
                Ok(()) => Status::Partial,
                Err(_) => Status::Stopped,
            };
            match status {
                Status::Rendered => self.summary.rendered += 1,
                _ => self.summary.partial += 1,
            }
            let frames = (self.summary.frames - before) as usize;
            report.push(ReportLine::new(game, status, frames, Some(name)));
        }
        let written = write_json_lines(&batch.folder.join("report.jsonl"), &report);
        outcome?;
        Ok(written?)
    }

    /// Renders a part of a game and writes its manifest.
    fn game(
        &mut self,
        batch: &Batch,
        folder: &Path,
        game: &Game,
        part: &Part,
    ) -> Result<(), JobError> {
        prepare_folder(folder)?;
        remove_frames(folder)?;
        let players = [Color::White, Color::Black].map(|color| shortened(game.player(color), 60));
        self.progress.game(&players.join(" – "));
        let timeline = Timeline::new(game, part.first, part.last, self.job.film, self.job.orbit);
        let captions = GameCaptions::new(game, self.job.picture.config.captions);
        let mut rows = Vec::new();
        for index in 0..timeline.frames() {
            if self.progress.is_cancelled() {
                self.summary.cancelled = true;
                break;
            }
            let frame = timeline.frame(index);
            let picture = self.studio.picture(&frame, captions.of(&frame).as_ref());
            let name = frame_name(index);
            write_png(&folder.join(&name), &picture, &texts(game, &frame), None)?;
            rows.push(FrameRow::new(name, game, &frame));
            self.progress.frame_done();
            self.summary.frames += 1;
        }
        let manifest = Manifest {
            file: &batch.file,
            game: game.number,
            line: game.line,
            tags: tags(game),
            unread_tags: &game.unread_tags,
            result: &game.result,
            problems: &game.problems,
            settings: self.studio.record(),
            film: self.job.film,
            orbit: self.job.orbit,
            frames: rows,
        };
        Ok(write_json(&folder.join("game.json"), &manifest)?)
    }
}

/// `0001-morphy-paul-duke-karl`: the number, and the players as far as they are known.
fn game_folder(game: &Game) -> String {
    let mut name = format!("{:04}", game.number);
    for (color, unknown) in [(Color::White, "white"), (Color::Black, "black")] {
        let player = slug(game.player(color));
        name.push('-');
        name.push_str(if player.is_empty() { unknown } else { &player });
    }
    name
}
