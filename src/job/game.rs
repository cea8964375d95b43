//! One line of play, a game's or a variation's, as pictures and films in a folder.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use rayon::prelude::*;

use super::JobError;
use super::batch::{Part, VariationPart};
use super::captions::GameCaptions;
use super::desk::{Desk, Sheet};
use super::reels::Reels;
use super::report::{FrameRow, Manifest, tags, texts};
use super::run::{Films, Run};
use super::shots::Shots;
use super::studio::Studio;
use crate::game::Game;
use crate::notation::Color;
use crate::output::{
    Earlier, FINGERPRINT, FilmFormat, FrameNames, PictureFormat, RepeatedPicture, film_name,
    is_whole, manifest_name, prepare_inside, remove_temporaries, write_json,
};
use crate::text::shortened;
use crate::timeline::Timeline;

/// What is rendered into one folder.
pub struct Line<'a> {
    /// The file of the game, as messages show it.
    pub file: &'a str,
    pub game: &'a Game,
    pub part: &'a Part,
    /// The game's folder, within that of all output.
    pub folder: &'a Path,
    /// The variation's folder within it, where this is one.
    pub variation: Option<&'a Path>,
    /// All variations of the game that are rendered.
    pub variations: &'a [VariationPart],
}

/// What came of it.
#[derive(Default)]
pub struct Rendered {
    /// Pictures that are there now, or went into films.
    pub frames: u64,
    /// Those of them that were there before.
    pub kept: u64,
    /// Films that are there now.
    pub films: usize,
    pub is_cancelled: bool,
}

impl Rendered {
    /// Adds what came of another line of the same game.
    pub fn add(&mut self, other: &Rendered) {
        self.frames += other.frames;
        self.kept += other.kept;
        self.films += other.films;
        self.is_cancelled |= other.is_cancelled;
    }
}

/// A picture that is to be there in the end.
struct Planned {
    /// Its frame, counted as in the whole.
    index: usize,
    row: FrameRow,
    is_kept: bool,
}

impl Line<'_> {
    /// Renders what is not there yet; tells in `rendered` how far it came, even if it fails.
    pub fn render(
        &self,
        run: &Run,
        studio: &mut Studio,
        rendered: &mut Rendered,
    ) -> Result<(), JobError> {
        let Line { game, part, .. } = self;
        let (job, progress) = (run.job, run.progress);
        let (wanted, names) = (job.frames.as_ref(), job.names.as_ref());
        let folder = prepare_inside(&job.out, &self.inside())?;
        remove_temporaries(&folder)?;
        let players = [Color::White, Color::Black].map(|color| shortened(game.player(color), 60));
        progress.game(&players.join(" – "));
        let timeline = self.timeline(run)?;
        let captions = GameCaptions::new(game, job.picture.config.captions);

        let mut planned = self.planned(run, &timeline, &captions);
        let fingerprint = fingerprint(run, &planned);
        let earlier = Earlier::read(&folder, wanted);
        let format = names.map_or(PictureFormat::Png, FrameNames::format);
        run.pool.install(|| {
            planned.par_iter_mut().for_each(|Planned { row, is_kept, .. }| {
                *is_kept = row.file().is_some_and(|file| {
                    earlier.has_frame(file, row.fingerprint())
                        && is_whole(&folder.join(file), format, row.fingerprint())
                });
            });
        });
        let film = |format: FilmFormat| film_name(format, wanted);
        let is_made = |format: &FilmFormat| earlier.has_film(&film(*format), &fingerprint);
        let (kept_films, films): (Vec<_>, Vec<_>) =
            job.films.formats.iter().copied().partition(is_made);

        let mut kept = self.folders_within();
        kept.extend(kept_films.iter().map(|format| film(*format)));
        let kept_frames = planned.iter().filter(|planned| planned.is_kept);
        kept.extend(kept_frames.filter_map(|planned| planned.row.file()).map(str::to_owned));
        earlier.remove(names, |name| kept.contains(name))?;
        let manifest = |films: &[FilmFormat], rows: Vec<&FrameRow>| {
            let films = films.iter().map(|format| film(*format)).collect();
            let path = folder.join(manifest_name(wanted));
            write_json(&path, &self.manifest(run, &fingerprint, films, rows))
        };
        manifest(&job.films.formats, planned.iter().map(|planned| &planned.row).collect())?;
        earlier.remove_manifests()?;

        let films = Films { formats: films, ffmpeg: job.films.ffmpeg.clone() };
        let shots = if films.formats.is_empty() {
            Shots::default()
        } else {
            Shots::of(&job.picture, &timeline, &captions, part, run.script.film.fps)
        };
        let mut reels = Reels::begin(&films, shots, progress, |format| folder.join(film(format)))?;
        let desk = Desk::new(progress, run.pool, format);
        let has_films = !films.formats.is_empty();
        let is_traced = |planned: &&Planned| !planned.is_kept || has_films;
        let (mut reached, mut filmed) = (0, 0);
        run.pool.in_place_scope(|scope| {
            for (place, Planned { index, row, is_kept }) in planned.iter().enumerate() {
                rendered.is_cancelled = run.is_over();
                if rendered.is_cancelled || desk.has_failed() {
                    break;
                }
                let is_filmed = reels.wants(*index);
                if !is_kept || is_filmed {
                    let read = row.file().filter(|_| *is_kept && format.is_exact());
                    let read = read.and_then(|file| image::open(folder.join(file)).ok());
                    let picture = match read {
                        Some(picture) => Arc::new(RepeatedPicture::new(picture)),
                        None => {
                            let coming = planned[place + 1..].iter().filter(is_traced);
                            let coming = coming.map(|planned| timeline.frame(planned.index));
                            let frame = timeline.frame(*index);
                            let content = captions.of(&frame);
                            run.pool.install(|| studio.picture(&frame, content.as_ref(), coming))
                        }
                    };
                    if is_filmed && !reels.add(&picture) {
                        break;
                    }
                    if let Some(file) = row.file().filter(|_| !is_kept) {
                        let mut texts = texts(game, &timeline.frame(*index));
                        texts.push((FINGERPRINT, row.fingerprint().to_owned()));
                        desk.take(Sheet { path: folder.join(file), picture, texts }, scope);
                    }
                }
                if *is_kept || row.file().is_none() {
                    progress.frame_done();
                }
                filmed += u64::from(row.file().is_none());
                reached += 1;
            }
        });
        let (written, outcome) = desk.close();
        let is_there = |(place, planned): &(usize, &Planned)| *place < reached || planned.is_kept;
        rendered.kept = planned.iter().filter(|planned| planned.is_kept).count() as u64;
        rendered.frames = rendered.kept + written + filmed;
        let (made, filming) = reels.end(rendered.is_cancelled || outcome.is_err());
        // A film that was waited for may have been told to stop.
        rendered.is_cancelled |= made.len() < films.formats.len() && run.is_over();
        let made: Vec<FilmFormat> = kept_films.into_iter().chain(made).collect();
        rendered.films = made.len();
        outcome?;
        if reached < planned.len() || made.len() < job.films.formats.len() {
            let rows = planned.iter().enumerate().filter(is_there);
            manifest(&made, rows.map(|(_, planned)| &planned.row).collect())?;
        }
        Ok(filming?)
    }

    /// Refuses to replace what is of other settings or another game. What is broken is not.
    pub fn keep_old(&self, run: &Run) -> Result<(), JobError> {
        let folder = run.job.out.join(self.inside());
        if !folder.is_dir() {
            return Ok(());
        }
        let timeline = self.timeline(run)?;
        let captions = GameCaptions::new(self.game, run.job.picture.config.captions);
        let planned = self.planned(run, &timeline, &captions);
        let fingerprint = fingerprint(run, &planned);
        let earlier = Earlier::read(&folder, run.job.frames.as_ref());
        let mut ours = self.folders_within();
        let films = run.job.films.formats.iter();
        let films = films.map(|format| film_name(*format, run.job.frames.as_ref()));
        ours.extend(films.filter(|film| earlier.has_film(film, &fingerprint)));
        let rows = planned.iter().map(|planned| &planned.row);
        let frames = rows.filter_map(|row| Some((row.file()?, row.fingerprint())));
        let frames = frames.filter(|(file, fingerprint)| earlier.has_frame(file, fingerprint));
        ours.extend(frames.map(|(file, _)| file.to_owned()));
        match earlier.first_old(run.job.names.as_ref(), |name| ours.contains(name))? {
            Some(name) => Err(JobError::WouldReplace { path: folder.join(name) }),
            None => Ok(()),
        }
    }

    /// Its folder within that of all output.
    fn inside(&self) -> PathBuf {
        self.variation.map_or(self.folder.to_owned(), |name| self.folder.join(name))
    }

    fn timeline<'a>(&self, run: &'a Run) -> Result<Timeline<'a>, JobError> {
        let Part { first, last, .. } = *self.part;
        Timeline::new(self.game, first, last, &run.script).map_err(|error| JobError::Path {
            file: self.file.to_owned(),
            game: self.game.number,
            error,
        })
    }

    /// All pictures of the line.
    fn planned(&self, run: &Run, timeline: &Timeline, captions: &GameCaptions) -> Vec<Planned> {
        let names = run.job.names.as_ref();
        let format = names.map(FrameNames::format);
        let planned = self.part.frames().map(|(index, number)| {
            let frame = timeline.frame(index);
            let content = captions.of(&frame);
            let rest = (texts(self.game, &frame), format);
            let fingerprint = run.fingerprints.picture(&frame, content.as_ref(), &rest);
            let file = names.map(|names| names.name(number));
            let row = FrameRow::new(file, fingerprint, self.game, &frame);
            Planned { index, row, is_kept: false }
        });
        planned.collect()
    }

    fn manifest<'a>(
        &'a self,
        run: &'a Run,
        fingerprint: &'a str,
        films: Vec<String>,
        frames: Vec<&'a FrameRow>,
    ) -> Manifest<'a> {
        let Line { file, game, variation, .. } = self;
        let showing = &run.job.showing;
        Manifest {
            file,
            game: game.number,
            line: game.line,
            tags: tags(game),
            unread_tags: &game.unread_tags,
            variation: variation.map(|name| name.to_string_lossy().into_owned()),
            result: &game.result,
            problems: &game.problems,
            settings: run.job.picture.record(),
            film: showing.animate.then_some(showing.film),
            orbit: showing.orbit,
            orbits_each_move: showing.orbits_each_move,
            fingerprint,
            films,
            frames,
        }
    }

    /// The folders of variations directly within this one.
    fn folders_within(&self) -> BTreeSet<String> {
        let here = self.variation.unwrap_or(Path::new(""));
        let within = self.variations.iter().filter_map(|part| part.folder.strip_prefix(here).ok());
        let first = within.filter_map(|path| path.components().next());
        first.map(|name| name.as_os_str().to_string_lossy().into_owned()).collect()
    }
}

/// Of the whole: of what a film is made of.
fn fingerprint(run: &Run, planned: &[Planned]) -> String {
    let frames: Vec<_> = planned.iter().map(|planned| planned.row.shows()).collect();
    let showing = &run.job.showing;
    let is_by_ffmpeg =
        run.job.films.formats.contains(&FilmFormat::Mp4) && run.job.films.ffmpeg.is_some();
    run.fingerprints.of(&(frames, showing.animate, showing.film, is_by_ffmpeg))
}
