//! Whole games, as numbered pictures in folders.

use std::path::{Path, PathBuf};

use super::report::{FrameRow, Manifest, ReportLine, Status, problems, tags};
use super::studio::{PictureSettings, Studio};
use super::{JobError, Progress, shown};
use crate::game::{Game, Moment, Problem, Selection, Source};
use crate::notation::Color;
use crate::output::{prepare_folder, slug, write_json, write_json_lines, write_png};
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
    games: Vec<(Game, Plan)>,
}

enum Plan {
    Show(Timeline),
    Skip,
}

/// Renders games into pictures; each gets a manifest, each file a report.
///
/// All input is read before the first picture, and nothing is written if any of it cannot be read
/// at all. Games that can be played only in part are rendered in part.
///
/// # Errors
/// Input that cannot be read, output that cannot be written, or a selection without games.
pub fn render(job: &RenderJob, progress: &dyn Progress) -> Result<Summary, JobError> {
    let mut batches = Vec::new();
    for (input, name) in job.inputs.iter().zip(folder_names(&job.inputs)) {
        batches.push(read_batch(job, input, job.out.join(name), progress)?);
    }
    let mut run =
        Run { job, progress, studio: Studio::new(&job.picture)?, summary: Summary::default() };
    for batch in &batches {
        prepare_folder(&batch.folder)?;
    }
    let plans = batches.iter().flat_map(|batch| &batch.games);
    progress.begin(plans.map(|(_, plan)| plan.frames() as u64).sum());
    for batch in &batches {
        run.batch(batch)?;
    }
    run.summary.rays = run.studio.rays();
    Ok(run.summary)
}

impl Plan {
    fn frames(&self) -> usize {
        match self {
            Plan::Show(timeline) => timeline.frames(),
            Plan::Skip => 0,
        }
    }
}

/// One folder name a file: its own without the ending, with a number where that is taken.
fn folder_names(inputs: &[PathBuf]) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for input in inputs {
        let stem = match input.file_stem() {
            Some(_) if input == Path::new("-") => "stdin".to_owned(),
            Some(stem) => stem.to_string_lossy().into_owned(),
            None => "games".to_owned(),
        };
        let mut name = stem.clone();
        let mut number = 2;
        while names.contains(&name) {
            name = format!("{stem}-{number}");
            number += 1;
        }
        names.push(name);
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
        let plan = plan(job, &mut game);
        for problem in &game.problems {
            progress.warn(&format!("{file}: game {}, {problem}", game.number));
        }
        games.push((game, plan));
    }
    if games.is_empty() {
        return Err(JobError::NothingSelected { file, games: seen });
    }
    Ok(Batch { file, folder, games })
}

/// What to show of a game; why not is added to its problems.
fn plan(job: &RenderJob, game: &mut Game) -> Plan {
    if !game.start_is_known {
        return Plan::Skip;
    }
    // A film that is to go on longer than the game ends with it.
    let last = job.to.ply(game).unwrap_or(game.plies.len());
    match job.from.ply(game).filter(|first| *first <= last) {
        Some(first) => Plan::Show(Timeline::new(game, first, last, job.film, job.orbit)),
        None => {
            game.problems.push(Problem {
                line: game.line,
                token: job.from.to_string(),
                what: format!("is no position up to the last one, after {last} half-moves"),
                loses_moves: false,
            });
            Plan::Skip
        }
    }
}

/// A job under way.
struct Run<'a> {
    job: &'a RenderJob,
    progress: &'a dyn Progress,
    studio: Studio<'a>,
    summary: Summary,
}

impl Run<'_> {
    fn batch(&mut self, batch: &Batch) -> Result<(), JobError> {
        let mut report = Vec::new();
        for (game, plan) in &batch.games {
            if self.summary.cancelled {
                break;
            }
            let (status, frames, folder) = match plan {
                Plan::Skip => (Status::Skipped, 0, None),
                Plan::Show(timeline) => {
                    let name = game_folder(game);
                    let frames = self.game(batch, &batch.folder.join(&name), game, timeline)?;
                    let whole = game.is_whole() && !self.summary.cancelled;
                    let status = if whole { Status::Rendered } else { Status::Partial };
                    (status, frames, Some(name))
                }
            };
            match status {
                Status::Rendered => self.summary.rendered += 1,
                Status::Partial => self.summary.partial += 1,
                Status::Skipped => self.summary.skipped += 1,
            }
            report.push(ReportLine::new(game, status, frames, folder));
        }
        Ok(write_json_lines(&batch.folder.join("report.jsonl"), &report)?)
    }

    /// Renders the frames of a game and writes its manifest; gives the number of pictures.
    fn game(
        &mut self,
        batch: &Batch,
        folder: &Path,
        game: &Game,
        timeline: &Timeline,
    ) -> Result<usize, JobError> {
        prepare_folder(folder)?;
        let players = [Color::White, Color::Black].map(|color| game.player(color));
        self.progress.game(&players.join(" – "));
        let mut rows = Vec::with_capacity(timeline.frames());
        let mut shown_last = None;
        for index in 0..timeline.frames() {
            if self.progress.is_cancelled() {
                self.summary.cancelled = true;
                break;
            }
            let frame = timeline.frame(index);
            let row = FrameRow::new(format!("frame_{index:05}.png"), game, &frame);
            // A pause is one picture many times over.
            let picture = match shown_last.take() {
                Some((last, picture)) if frame.shows_the_same(&last) => picture,
                _ => self.studio.picture(&frame),
            };
            write_png(&folder.join(&row.file), &picture, &row.texts(game))?;
            rows.push(row);
            self.progress.frame_done();
            self.summary.frames += 1;
            shown_last = Some((frame, picture));
        }
        let frames = rows.len();
        let manifest = Manifest {
            file: batch.file.clone(),
            game: game.number,
            line: game.line,
            tags: tags(game),
            result: &game.result,
            problems: problems(&game.problems),
            settings: &self.studio.record(),
            film: self.job.film,
            orbit: self.job.orbit,
            frames: rows,
        };
        write_json(&folder.join("game.json"), &manifest)?;
        Ok(frames)
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
