//! What a job renders: its games and variations, read and cut to what is wanted, each with its folder.

use std::ffi::OsStr;
use std::ops::Range;
use std::path::{Path, PathBuf};

use super::input::Input;
use super::run::RenderJob;
use super::{JobError, MAX_FRAMES, Progress, say_missing, say_problems, say_variations};
use crate::game::{Absent, Game, Problem, Variation, Wanted, WantedGames};
use crate::notation::Color;
use crate::output::slug;
use crate::text::printable;
use crate::timeline::{Script, Timeline};

/// A file of games, and what of it is to be rendered. It is read twice: to see what there is, before the first picture, and
/// again game by game, so that it may be of any length.
pub struct Batch {
    /// Which of the job's files it is, counted from 0.
    pub file: usize,
    pub input: Input,
    /// Where its pictures go, within the folder of all output.
    pub folder: PathBuf,
    /// At most so many of its games are rendered: the first that are wanted.
    pub games: usize,
    pub frames: u64,
    /// How many games were seen, wanted or not.
    pub seen: usize,
}

/// A game, and what of it is rendered.
pub struct Entry {
    pub game: Game,
    /// Nothing where nothing of it can be shown.
    pub part: Option<Part>,
    pub variations: Vec<VariationPart>,
}

/// The part of a game that is shown: its first and last position, in half-moves, and which of the frames
/// between them.
pub struct Part {
    pub first: usize,
    pub last: usize,
    /// They are counted as in the whole.
    pub frames: Range<usize>,
    /// Of these frames every so manyth from the first on, and the last one.
    pub every: usize,
}

impl Part {
    /// The frames that are shown, each with the number in its name.
    pub fn frames(&self) -> impl Iterator<Item = (usize, usize)> + Clone + '_ {
        let Range { start, end } = self.frames;
        let wanted = self
            .frames
            .clone()
            .filter(move |index| (index - start).is_multiple_of(self.every) || index + 1 == end);
        wanted.map(move |index| (index, start + (index - start).div_ceil(self.every)))
    }

    pub fn count(&self) -> usize {
        match self.frames.len() {
            0 => 0,
            frames => (frames - 1).div_ceil(self.every) + 1,
        }
    }
}

/// A variation that is shown.
pub struct VariationPart {
    /// Where it is found in its game.
    pub path: Vec<usize>,
    /// Its folder within the game's.
    pub folder: PathBuf,
    pub part: Part,
}

impl Entry {
    /// Variations of which no move could be played.
    pub fn unplayable(&self) -> Vec<&Variation> {
        let mut found = Vec::new();
        let mut open: Vec<&Variation> = self.game.variations.iter().collect();
        while let Some(variation) = open.pop() {
            if variation.plies.is_empty() {
                found.push(variation);
            }
            open.extend(&variation.variations);
        }
        found
    }

    /// The frames of the game and of its variations.
    pub fn frames(&self) -> u64 {
        let variations = self.variations.iter().map(|variation| &variation.part);
        self.part.iter().chain(variations).map(|part| part.count() as u64).sum()
    }
}

/// One folder name a file: its own without the endings of games and of what is compressed, with a number where that is
/// taken. Names that some file systems take for the same are the same here.
pub fn folder_names(inputs: &[PathBuf]) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for input in inputs {
        let name = input.file_name().filter(|_| input != Path::new("-"));
        let name = name.map_or("stdin".into(), OsStr::to_string_lossy);
        let stem = match without_endings(&name) {
            // A name that leads elsewhere, or hides, is none.
            "" | "." | ".." => "games".to_owned(),
            name if name.starts_with('.') => format!("games{}", printable(name)),
            name => printable(name),
        };
        let is_free = |name: &String| !names.iter().any(|known| is_same(known, name));
        let numbered = (2..).map(|number| format!("{stem}-{number}"));
        let free = std::iter::once(stem.clone()).chain(numbered).find(is_free);
        names.push(free.unwrap_or(stem));
    }
    names
}

fn is_same(a: &str, b: &str) -> bool {
    a.to_lowercase() == b.to_lowercase()
}

/// `games.pgn.zst` is `games`; of another name the last ending goes.
fn without_endings(name: &str) -> &str {
    let name = ["zst", "gz", "bz2"]
        .iter()
        .find_map(|ending| name.strip_suffix(ending)?.strip_suffix('.'))
        .unwrap_or(name);
    match name.rsplit_once('.') {
        Some((stem, _)) if !stem.is_empty() => stem,
        _ => name,
    }
}

impl Batch {
    /// Sees what `job` wants of its file, and tells what could not be read. There may be nothing; as many games are taken at
    /// most as the batch has now.
    ///
    /// # Errors
    /// Input that cannot be read, frames or a camera's path that a game does not have.
    pub fn survey(
        self,
        job: &RenderJob,
        script: &Script,
        progress: &dyn Progress,
    ) -> Result<Batch, JobError> {
        let (file, room) = (&self.input.name, self.games);
        let mut entries = self.entries(job, script)?;
        let (mut games, mut frames) = (0, 0);
        for entry in &mut entries {
            let entry = entry?;
            let Entry { game, part, .. } = &entry;
            say_problems(file, game, progress);
            if part.is_some() && job.variations {
                say_variations(&game.variations, file, game.number, progress);
            }
            games += 1;
            frames += entry.frames();
        }
        let seen = entries.games.seen();
        drop(entries);
        // A single file without any is an error of its own; and one that was not read to its end misses nothing.
        if games < room && (games > 0 || job.inputs.len() > 1) {
            say_missing(file, job.wanted.numbers.as_ref(), seen, progress);
        }
        Ok(Batch { games, frames, seen, ..self })
    }

    /// The games of the file that are rendered, one after the other.
    ///
    /// # Errors
    /// Input that cannot be read.
    pub fn entries<'a>(
        &'a self,
        job: &'a RenderJob,
        script: &'a Script,
    ) -> Result<Entries<'a>, JobError> {
        self.entries_of(job, script, &job.wanted)
    }

    /// The same, of those games that are wanted here.
    ///
    /// # Errors
    /// Input that cannot be read.
    pub fn entries_of<'a>(
        &'a self,
        job: &'a RenderJob,
        script: &'a Script,
        wanted: &'a Wanted,
    ) -> Result<Entries<'a>, JobError> {
        let games = self.input.open()?.with_letters(job.letters).wanted(wanted);
        Ok(Entries { job, script, file: &self.input.name, games, left: self.games })
    }
}

/// Games that are rendered, each cut to what is wanted of it.
pub struct Entries<'a> {
    job: &'a RenderJob,
    script: &'a Script,
    file: &'a str,
    games: WantedGames<'a>,
    /// How many more there may be.
    left: usize,
}

impl Iterator for Entries<'_> {
    type Item = Result<Entry, JobError>;

    fn next(&mut self) -> Option<Result<Entry, JobError>> {
        self.left = self.left.checked_sub(1)?;
        let game = match self.games.next()? {
            Ok(game) => game,
            Err(error) => return Some(Err(error.into())),
        };
        Some(self.entry(game))
    }
}

impl Entries<'_> {
    fn entry(&self, mut game: Game) -> Result<Entry, JobError> {
        let Entries { job, script, file, .. } = self;
        let part = span(job, &mut game).map(|span| part(job, script, &game, span, file));
        let part = part.transpose()?;
        let variations = match &part {
            Some(part) if job.variations => variations(job, script, &game, part, file)?,
            _ => Vec::new(),
        };
        Ok(Entry { game, part, variations })
    }
}

/// The part of a game between two positions, with the frames that are wanted of it.
fn part(
    job: &RenderJob,
    script: &Script,
    game: &Game,
    [first, last]: [usize; 2],
    file: &str,
) -> Result<Part, JobError> {
    let (file, number) = (file.to_owned(), game.number);
    let frames = match Timeline::count(game, first, last, script) {
        Ok(frames) => frames,
        Err(error) => return Err(JobError::Path { file, game: number, error }),
    };
    if frames > MAX_FRAMES {
        return Err(JobError::TooLong { file, game: number, frames });
    }
    let frames = match &job.frames {
        None => 0..frames,
        Some(wanted) if *wanted.end() < frames => *wanted.start()..*wanted.end() + 1,
        Some(wanted) => {
            let wanted = format!("{} to {}", wanted.start(), wanted.end());
            return Err(JobError::NoSuchFrames { file, game: number, last: frames - 1, wanted });
        }
    };
    Ok(Part { first, last, frames, every: job.every })
}

/// The variations that begin within the part of a game that is shown, each from the position before its
/// first move on.
fn variations(
    job: &RenderJob,
    script: &Script,
    game: &Game,
    shown: &Part,
    file: &str,
) -> Result<Vec<VariationPart>, JobError> {
    let mut parts = Vec::new();
    for branch in game.branches() {
        let Some((variation, line)) =
            game.variation(&branch.path).zip(game.with_variation(&branch.path))
        else {
            continue;
        };
        // Nested ones go where the one that they belong to goes.
        let outermost = game.variations.get(branch.path[0]).map_or(0, |variation| variation.ply);
        if !(shown.first..shown.last).contains(&outermost) {
            continue;
        }
        let part = part(job, script, &line, [variation.ply, line.plies.len()], file)?;
        parts.push(VariationPart {
            path: branch.path,
            folder: branch.names.iter().collect(),
            part,
        });
    }
    Ok(parts)
}

/// The first and the last position to show of a game, in half-moves; why none is added to its problems.
fn span(job: &RenderJob, game: &mut Game) -> Option<[usize; 2]> {
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
            return Some([first, last]);
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
    let flag = if job.from == job.to { "--at" } else { flag };
    game.problems.push(Problem {
        line: game.line,
        token: format!("{flag} {moment}"),
        what: clause,
        loses_moves: false,
    });
    None
}

/// `0001-morphy-paul-duke-karl`: the number, and the players as far as they are known.
pub fn game_folder(game: &Game) -> String {
    let mut name = format!("{:04}", game.number);
    for (color, unknown) in [(Color::White, "white"), (Color::Black, "black")] {
        let player = slug(game.player(color));
        name.push('-');
        name.push_str(if player.is_empty() { unknown } else { &player });
    }
    name
}
