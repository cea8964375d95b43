//! One line of play, a game's or a variation's, as pictures and films in a folder.

use std::borrow::Cow;
use std::collections::BTreeSet;
use std::ops::Range;
use std::path::{Path, PathBuf};

use super::JobError;
use super::batch::{Batch, Entry, Part, VariationPart, game_folder};
use super::captions::GameCaptions;
use super::layout::{Layout, Planned};
use super::reels::Reels;
use super::report::{FrameRow, Manifest, tags, texts};
use super::run::{Films, RenderJob, Run, Task};
use super::shots::Shots;
use super::studio::Studio;
use crate::game::Game;
use crate::notation::Color;
use crate::output::{
    Earlier, FilmFormat, FrameNames, film_name, manifest_name, prepare_inside, remove_file,
    remove_temporaries, write_json,
};
use crate::text::shortened;
use crate::timeline::{Script, Timeline};

/// What is rendered into one folder.
pub struct Line<'a> {
    /// The file of the game, as messages show it.
    pub file: &'a str,
    /// The game, or what becomes of it where the variation is played.
    pub game: Cow<'a, Game>,
    pub part: &'a Part,
    /// The game's folder, within that of all output.
    pub folder: PathBuf,
    /// The variation's folder within it, where this is one.
    pub variation: Option<&'a Path>,
    /// All variations of the game that are rendered.
    pub variations: &'a [VariationPart],
}

impl Entry {
    /// The lines of a game that are rendered: its own, and those of its variations.
    pub fn lines<'a>(&'a self, batch: &'a Batch) -> impl Iterator<Item = Line<'a>> {
        let Entry { game, part, variations } = self;
        let folder = batch.folder.join(game_folder(game));
        let line = move |game, part, variation| {
            let (file, folder) = (batch.input.name.as_str(), folder.clone());
            Line { file, game, part, folder, variation, variations }
        };
        let main = part.as_ref().map(|part| line(Cow::Borrowed(game), part, None));
        let others = variations.iter().filter_map(move |VariationPart { path, folder, part }| {
            let game = game.with_variation(path)?;
            Some(line(Cow::Owned(game), part, Some(folder.as_path())))
        });
        main.into_iter().chain(others)
    }
}

/// The films of a line: those that are there, and those that are to be made.
pub struct FilmsWanted {
    kept: Vec<FilmFormat>,
    pub missing: Vec<FilmFormat>,
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

impl Line<'_> {
    /// Renders what is not there yet; tells in `rendered` how far it came, even if it fails.
    pub fn render(
        &self,
        run: &Run,
        studio: &mut Studio,
        rendered: &mut Rendered,
    ) -> Result<(), JobError> {
        let job = run.job;
        let (wanted, names) = (job.frames.as_ref(), job.names.as_ref());
        let is_merge = matches!(run.task, Task::Merge);
        if is_merge {
            self.told(run)?;
        }
        remove_temporaries(&prepare_inside(&job.out, &self.inside())?)?;
        run.progress.game(&self.players());
        let mut layout = self.lay_out(run)?;
        let fingerprint = fingerprint(run, &layout.planned);
        let earlier = Earlier::read(&layout.folder, wanted);
        layout.keep(run, |row| {
            row.file().is_some_and(|file| {
                is_merge || earlier.vouches(file, job.format(), row.fingerprint())
            })
        });
        // Those of shards were just held against their files.
        layout.sum(run, |file| earlier.crc32(file).filter(|_| !is_merge));
        let films = self.films(run, &earlier, &fingerprint);
        let spent: Vec<PathBuf> = layout.spent(run);
        let mut kept = self.folders_within();
        kept.extend(films.kept.iter().map(|format| film_name(*format, wanted)));
        let kept_frames = layout.planned.iter().filter(|planned| planned.is_kept);
        kept.extend(kept_frames.filter_map(|planned| planned.row.file()).map(str::to_owned));
        kept.extend(spent.iter().filter_map(|path| Some(path.file_name()?.to_str()?.to_owned())));
        earlier.remove(names, |name| kept.contains(name))?;
        self.write_manifest(run, &layout, &fingerprint, &job.films.formats, |_, _| true)?;
        earlier.remove_manifests()?;
        if self.make(run, studio, &layout, &fingerprint, films, rendered)? {
            spent.iter().try_for_each(|path| remove_file(path))?;
        }
        Ok(())
    }

    /// Makes films alone of the line in its folder, beside others who may do the same: nothing is removed.
    pub fn render_films(
        &self,
        run: &Run,
        studio: &mut Studio,
        rendered: &mut Rendered,
    ) -> Result<(), JobError> {
        let job = run.job;
        let layout = self.lay_out_part(run, 0..self.part.count(), None)?;
        let fingerprint = fingerprint(run, &layout.planned);
        let earlier = Earlier::read(&layout.folder, job.frames.as_ref());
        let films = self.films(run, &earlier, &fingerprint);
        // It tells of films that are there, and not of those that are to come: one of that name may be another's.
        if self.make(run, studio, &layout, &fingerprint, films, rendered)? {
            self.write_manifest(run, &layout, &fingerprint, &job.films.formats, |_, _| true)?;
        }
        Ok(())
    }

    /// What a manifest tells of the films of the line, if there is one.
    ///
    /// # Errors
    /// When manifests tell of something in its folder that would be replaced or removed: what is of other settings, of
    /// another game, or of more of it.
    pub fn told(&self, run: &Run) -> Result<Option<FilmsWanted>, JobError> {
        let RenderJob { out, frames, names, films, .. } = run.job;
        let folder = out.join(self.inside());
        let earlier = Earlier::read(&folder, frames.as_ref());
        if !earlier.is_any() {
            return Ok(None);
        }
        let other = |name: &str| Err(JobError::WouldReplace { path: folder.join(name) });
        let layout = self.lay_out_part(run, 0..self.part.count(), names.as_ref())?;
        let fingerprint = fingerprint(run, &layout.planned);
        let film = |format: &FilmFormat| film_name(*format, frames.as_ref());
        let ours: Vec<String> = films.formats.iter().map(film).collect();
        if earlier.is_other(&fingerprint, &ours) {
            return other(&manifest_name(frames.as_ref()));
        }
        let films = self.films(run, &earlier, &fingerprint);
        let names = run.job.names_of_shards();
        let mut ours = self.folders_within();
        ours.extend(films.kept.iter().map(film));
        // What nobody tells of, shards have written.
        ours.extend(layout.planned.iter().filter_map(|Planned { number, row, .. }| {
            let name = names.name(*number);
            (!earlier.tells(&name) || earlier.has_frame(&name, row.fingerprint())).then_some(name)
        }));
        match earlier.first_old(Some(&names), |name| ours.contains(name))? {
            Some(name) => other(&name),
            None => Ok(earlier.is_told().then_some(films)),
        }
    }

    /// Whether films alone are wanted of it, and all are there: then its pictures may be gone.
    ///
    /// # Errors
    /// When there are films of something else.
    pub fn is_filmed(&self, run: &Run) -> Result<bool, JobError> {
        let told = self.told(run)?;
        Ok(run.job.names.is_none() && told.is_some_and(|films| films.missing.is_empty()))
    }

    /// Which films of the whole with that fingerprint are there.
    fn films(&self, run: &Run, earlier: &Earlier, fingerprint: &str) -> FilmsWanted {
        let RenderJob { films, frames, .. } = run.job;
        let name = |format: &FilmFormat| film_name(*format, frames.as_ref());
        let is_made = |format: &FilmFormat| earlier.has_film(&name(format), fingerprint);
        let (kept, missing) = films.formats.iter().copied().partition(is_made);
        FilmsWanted { kept, missing }
    }

    /// Makes pictures and films that are missing; whether all are there then. If not, the manifest tells which are.
    fn make(
        &self,
        run: &Run,
        studio: &mut Studio,
        layout: &Layout,
        fingerprint: &str,
        films: FilmsWanted,
        rendered: &mut Rendered,
    ) -> Result<bool, JobError> {
        let (job, planned) = (run.job, &layout.planned);
        let shots = if films.missing.is_empty() {
            Shots::default()
        } else {
            let Layout { timeline, captions, .. } = layout;
            Shots::of(&job.picture, timeline, captions, self.part, run.script.film.fps)
        };
        let missing = Films { formats: films.missing, ffmpeg: job.films.ffmpeg.clone() };
        let file = |format| layout.folder.join(film_name(format, job.frames.as_ref()));
        let mut reels = Reels::begin(&missing, shots, run.progress, file)?;
        let traced = layout.trace(run, studio, &mut reels, job.format());
        rendered.kept = planned.iter().filter(|planned| planned.is_kept).count() as u64;
        rendered.frames = rendered.kept + traced.frames;
        rendered.is_cancelled = traced.is_cancelled;
        let (made, filming) = reels.end(traced.is_cancelled || traced.outcome.is_err());
        // A film that was waited for may have been told to stop.
        rendered.is_cancelled |= made.len() < missing.formats.len() && run.is_over();
        let made: Vec<FilmFormat> = films.kept.into_iter().chain(made).collect();
        rendered.films = made.len();
        traced.outcome?;
        let is_all = traced.reached == planned.len() && made.len() == job.films.formats.len();
        // Sums of pictures are known now.
        let is_summed = !job.format().is_sealed() && traced.frames > 0;
        if !is_all || is_summed {
            let is_there = |place, planned: &Planned| place < traced.reached || planned.is_kept;
            self.write_manifest(run, layout, fingerprint, &made, is_there)?;
        }
        filming?;
        Ok(is_all)
    }

    /// Refuses to replace what is of other settings or another game. What is broken is not.
    pub fn keep_old(&self, run: &Run) -> Result<(), JobError> {
        let folder = run.job.out.join(self.inside());
        if !folder.is_dir() {
            return Ok(());
        }
        let Layout { planned, .. } = self.lay_out(run)?;
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
    pub fn inside(&self) -> PathBuf {
        self.variation.map_or(self.folder.clone(), |name| self.folder.join(name))
    }

    /// Works out all its pictures; none is kept yet, and nothing is written.
    pub fn lay_out<'a>(&'a self, run: &'a Run) -> Result<Layout<'a>, JobError> {
        self.lay_out_part(run, 0..self.part.count(), run.names.as_ref())
    }

    /// Works out those of its pictures that come in such places, counted from 0, under such names.
    pub fn lay_out_part<'a>(
        &'a self,
        run: &'a Run,
        places: Range<usize>,
        names: Option<&FrameNames>,
    ) -> Result<Layout<'a>, JobError> {
        let (game, job) = (self.game.as_ref(), run.job);
        let timeline = self.timeline(&run.script)?;
        let captions = GameCaptions::new(game, job.picture.config.captions);
        let format = names.map(FrameNames::format);
        let frames = self.part.frames().skip(places.start).take(places.len());
        let planned = frames.map(|(index, number)| {
            let frame = timeline.frame(index);
            let content = captions.of(&frame);
            let rest = (texts(game, &frame), format);
            let fingerprint = run.fingerprints.picture(&frame, content.as_ref(), &rest);
            let file = names.map(|names| names.name(number));
            let row = FrameRow::new(file, fingerprint, game, &frame);
            Planned { index, number, row, is_kept: false }
        });
        let planned = planned.collect();
        let folder = job.out.join(self.inside());
        Ok(Layout { game, folder, timeline, captions, planned })
    }

    /// All its frames.
    pub fn timeline<'a>(&self, script: &'a Script) -> Result<Timeline<'a>, JobError> {
        let Part { first, last, .. } = *self.part;
        let timeline = Timeline::new(&self.game, first, last, script);
        timeline.map_err(|error| {
            let (file, game) = (self.file.to_owned(), self.game.number);
            JobError::Path { file, game, error }
        })
    }

    /// Who plays, for the bar.
    pub fn players(&self) -> String {
        let players = [Color::White, Color::Black].map(|color| self.game.player(color));
        players.map(|player| shortened(player, 60)).join(" – ")
    }

    /// Writes the manifest with such films, and those pictures that are `listed` by their place.
    fn write_manifest(
        &self,
        run: &Run,
        layout: &Layout,
        fingerprint: &str,
        films: &[FilmFormat],
        listed: impl Fn(usize, &Planned) -> bool,
    ) -> Result<(), JobError> {
        let Line { file, game, variation, .. } = self;
        let RenderJob { showing, frames, picture, .. } = run.job;
        let rows = layout.planned.iter().enumerate();
        let rows = rows.filter(|(place, planned)| listed(*place, planned));
        let manifest = Manifest {
            file,
            game: game.number,
            line: game.line,
            tags: tags(game),
            unread_tags: &game.unread_tags,
            variation: variation.map(|name| name.to_string_lossy().into_owned()),
            result: &game.result,
            problems: &game.problems,
            settings: picture.record(),
            film: showing.animate.then_some(showing.film),
            orbit: showing.orbit,
            orbits_each_move: showing.orbits_each_move,
            fingerprint,
            films: films.iter().map(|format| film_name(*format, frames.as_ref())).collect(),
            frames: rows.map(|(_, planned)| &planned.row).collect(),
        };
        Ok(write_json(&layout.folder.join(manifest_name(frames.as_ref())), &manifest)?)
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
    run.fingerprints.of(&(frames, showing.animate, showing.film, run.job.is_by_ffmpeg()))
}
