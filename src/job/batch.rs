//! What a job renders: its games and variations, read and cut to what is wanted, each with its folder.

use std::ffi::OsStr;
use std::ops::Range;
use std::path::{Path, PathBuf};

use super::render::RenderJob;
use super::{JobError, MAX_FRAMES, Progress, say_missing, say_problems, say_variations, shown};
use crate::game::{Absent, Game, Problem, Source, Variation, printable};
use crate::notation::Color;
use crate::output::slug;
use crate::timeline::{Script, Timeline};

/// A file of games.
pub struct Batch {
    pub file: String,
    pub folder: PathBuf,
    pub entries: Vec<Entry>,
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
    pub frames: Range<usize>,
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
        self.part.iter().chain(variations).map(|part| part.frames.len() as u64).sum()
    }
}

/// One folder name a file: its own without the ending, with a number where that is taken.
pub fn folder_names(inputs: &[PathBuf]) -> Vec<String> {
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

/// Reads what `job` wants of `input`, for pictures in `folder`.
///
/// # Errors
/// Input that cannot be read, a selection without games, frames or a camera's path that a game does not have.
pub fn read_batch(
    job: &RenderJob,
    script: &Script,
    input: &Path,
    folder: PathBuf,
    progress: &dyn Progress,
) -> Result<Batch, JobError> {
    let file = shown(input);
    let mut entries = Vec::new();
    let mut seen = 0;
    for game in Source::open(input)?.games() {
        let mut game = game?;
        seen += 1;
        if job.selection.as_ref().is_some_and(|selection| !selection.contains(game.number)) {
            continue;
        }
        let span = span(job, &mut game);
        say_problems(&file, &game, progress);
        let part = span.map(|span| part(job, script, &game, span, &file)).transpose()?;
        let variations = match &part {
            Some(part) if job.variations => {
                say_variations(&game.variations, &file, game.number, progress);
                variations(job, script, &game, part, &file)?
            }
            _ => Vec::new(),
        };
        entries.push(Entry { game, part, variations });
    }
    if entries.is_empty() {
        return Err(JobError::NothingSelected { file, games: seen });
    }
    say_missing(&file, job.selection.as_ref(), seen, progress);
    Ok(Batch { file, folder, entries })
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
    Ok(Part { first, last, frames })
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
