//! Whole games, as numbered pictures and films in folders.

use std::fs;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};

use super::batch::{Batch, Entry, Part, folder_names, game_folder, read_batch};
use super::captions::GameCaptions;
use super::desk::{Desk, Sheet};
use super::reels::{Films, Reels};
use super::report::{FrameRow, Manifest, ReportLine, Status, VariationLine, tags, texts};
use super::shots::Shots;
use super::studio::{PictureSettings, Studio};
use super::{JobError, Progress, Showing};
use crate::config::Config;
use crate::game::{Game, Moment, Selection, shortened};
use crate::notation::Color;
use crate::output::{
    FilmFormat, FrameNames, PictureFormat, film_name, manifest_name, prepare_folder, remove_frames,
    write_json, write_json_lines,
};
use crate::timeline::{Bodies, Script, Timeline};
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
    /// Whether variations are rendered too, each in a folder of its own within its game's.
    pub variations: bool,
    pub showing: Showing,
    /// Which frames of each game, counted as in the whole; all when `None`.
    pub frames: Option<RangeInclusive<usize>>,
    /// How frames are named as pictures; there are none when `None`.
    pub names: Option<FrameNames>,
    pub films: Films,
    pub picture: PictureSettings,
}

/// What a job did.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Summary {
    pub rendered: usize,
    pub partial: usize,
    pub skipped: usize,
    /// Pictures that were written, or went into films.
    pub frames: u64,
    /// Films that were written.
    pub films: usize,
    pub rays: RayCounts,
    /// Whether the job was told to stop.
    pub cancelled: bool,
}

/// Renders games into pictures; each gets a manifest, each file a report.
///
/// All input is read before the first picture, and nothing is written if any of it cannot be read
/// at all. Games that can be played only in part are rendered in part. Numbered pictures of an
/// earlier run in a game's folder are removed, and its variations; where only some frames are wanted, only
/// those are.
///
/// # Errors
/// Input that cannot be read, output that cannot be written, or a selection without games.
pub fn render(job: &RenderJob, progress: &dyn Progress) -> Result<Summary, JobError> {
    let config = &job.picture.config;
    // How many frames there are does not depend on the room that pieces take.
    let script = job.showing.script(config, Bodies::default());
    let mut batches = Vec::new();
    for (input, name) in job.inputs.iter().zip(folder_names(&job.inputs)) {
        batches.push(read_batch(job, &script, input, job.out.join(name), progress)?);
    }
    say_films(job, progress);
    let pool = job.picture.pool()?;
    let studio = Studio::new(&job.picture, job.showing.reach(config))?;
    let script = job.showing.script(config, studio.bodies().clone());
    let mut run = Run { job, script, progress, studio, summary: Summary::default() };
    for batch in &batches {
        keep_out(job, &batch.folder)?;
        prepare_folder(&batch.folder)?;
    }
    progress.begin(batches.iter().flat_map(|batch| &batch.entries).map(Entry::frames).sum());
    for batch in &batches {
        if !run.summary.cancelled {
            pool.install(|| run.batch(batch))?;
        }
    }
    run.summary.rays = run.studio.rays();
    Ok(run.summary)
}

/// Tells of films that are smaller than their pictures, and who makes them.
fn say_films(job: &RenderJob, progress: &dyn Progress) {
    if job.films.formats.contains(&FilmFormat::Mp4) {
        progress.detail(&match &job.films.ffmpeg {
            Some(ffmpeg) => format!("mp4 by {ffmpeg}"),
            None => "mp4 by the encoder inside".to_owned(),
        });
    }
    let Config { width, height, .. } = job.picture.config;
    for format in &job.films.formats {
        let [columns, rows] = format.size([width, height]);
        if [columns, rows] != [width, height] {
            let name = film_name(*format, None);
            progress.say(&format!(
                "{name}: is {columns}x{rows} instead of {width}x{height}, its sides are even"
            ));
        }
    }
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

/// A job under way.
struct Run<'a> {
    job: &'a RenderJob,
    script: Script,
    progress: &'a dyn Progress,
    studio: Studio<'a>,
    summary: Summary,
}

impl Run<'_> {
    /// Renders the games of a file; the report tells of all that were begun, even where one fails.
    fn batch(&mut self, batch: &Batch) -> Result<(), JobError> {
        let mut report = Vec::new();
        let mut outcome = Ok(());
        for entry in &batch.entries {
            if self.summary.cancelled || outcome.is_err() {
                break;
            }
            let Entry { game, part, variations } = entry;
            let Some(part) = part else {
                self.summary.skipped += 1;
                report.push(ReportLine::new(game, Status::Skipped, 0, None));
                continue;
            };
            let name = game_folder(game);
            let folder = batch.folder.join(&name);
            let before = self.summary.frames;
            outcome = self.game(batch, &folder, game, part, None);
            let mut is_whole = game.is_whole();
            let mut lines = Vec::new();
            for variation in variations {
                if self.summary.cancelled || outcome.is_err() {
                    break;
                }
                let Some(line) = game.with_variation(&variation.path) else { continue };
                let before = self.summary.frames;
                let name = Some(variation.folder.as_path());
                outcome = self.game(batch, &folder, &line, &variation.part, name);
                is_whole &= line.is_whole();
                let frames = (self.summary.frames - before) as usize;
                lines.push(VariationLine::new(&line, &variation.folder, frames));
            }
            if self.job.variations {
                let unplayable = entry.unplayable();
                is_whole &= unplayable.is_empty();
                lines.extend(unplayable.into_iter().map(VariationLine::unplayable));
            }
            let status = match outcome {
                Ok(()) if self.summary.cancelled => Status::Stopped,
                Ok(()) if is_whole => Status::Rendered,
                Ok(()) => Status::Partial,
                Err(_) => Status::Stopped,
            };
            match status {
                Status::Rendered => self.summary.rendered += 1,
                _ => self.summary.partial += 1,
            }
            let frames = (self.summary.frames - before) as usize;
            report.push(ReportLine::new(game, status, frames, Some(name)).with(lines));
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
        variation: Option<&Path>,
    ) -> Result<(), JobError> {
        let folder = &variation.map_or(folder.to_owned(), |name| folder.join(name));
        prepare_folder(folder)?;
        let (wanted, names) = (self.job.frames.as_ref(), self.job.names.as_ref());
        remove_frames(folder, names, wanted)?;
        let players = [Color::White, Color::Black].map(|color| shortened(game.player(color), 60));
        self.progress.game(&players.join(" – "));
        let timeline =
            Timeline::new(game, part.first, part.last, &self.script).map_err(|error| {
                JobError::Path { file: batch.file.clone(), game: game.number, error }
            })?;
        let captions = GameCaptions::new(game, self.job.picture.config.captions);
        let (films, fps) = (&self.job.films, self.script.film.fps);
        let shots = if films.formats.is_empty() {
            Shots::default()
        } else {
            Shots::of(&self.job.picture, &timeline, &captions, part, fps)
        };
        let film = |format| folder.join(film_name(format, wanted));
        let mut reels = Reels::begin(films, shots, self.progress, film)?;
        let mut rows = Vec::new();
        let format = names.map_or(PictureFormat::Png, FrameNames::format);
        let desk = Desk::new(self.progress, format);
        let mut filmed = 0;
        rayon::in_place_scope(|scope| {
            for index in part.frames.clone() {
                self.summary.cancelled = self.progress.is_cancelled();
                if self.summary.cancelled || desk.has_failed() {
                    break;
                }
                let frame = timeline.frame(index);
                let coming = (index + 1..part.frames.end).map(|index| timeline.frame(index));
                let content = captions.of(&frame);
                let picture = self.studio.picture(&frame, content.as_ref(), coming);
                if !reels.add(index, &picture) {
                    break;
                }
                let name = names.map(|names| names.name(index));
                match &name {
                    Some(name) => {
                        let (path, texts) = (folder.join(name), texts(game, &frame));
                        desk.take(Sheet { path, picture, texts }, scope);
                    }
                    None => {
                        filmed += 1;
                        self.progress.frame_done();
                    }
                }
                rows.push(FrameRow::new(name, game, &frame));
            }
        });
        let (written, outcome) = desk.close();
        self.summary.frames += written + filmed;
        let (films, filming) = reels.end(self.summary.cancelled || outcome.is_err());
        self.summary.films += films.len();
        // A film that was waited for may have been told to stop.
        let is_short = films.len() < self.job.films.formats.len();
        self.summary.cancelled |= is_short && self.progress.is_cancelled();
        outcome?;
        let manifest = Manifest {
            file: &batch.file,
            game: game.number,
            line: game.line,
            tags: tags(game),
            unread_tags: &game.unread_tags,
            variation: variation.map(|name| name.to_string_lossy().into_owned()),
            result: &game.result,
            problems: &game.problems,
            settings: self.studio.record(),
            film: self.job.showing.animate.then_some(self.job.showing.film),
            orbit: self.job.showing.orbit,
            orbits_each_move: self.job.showing.orbits_each_move,
            films: films.into_iter().map(|format| film_name(format, wanted)).collect(),
            frames: rows,
        };
        write_json(&folder.join(manifest_name(wanted)), &manifest)?;
        Ok(filming?)
    }
}
