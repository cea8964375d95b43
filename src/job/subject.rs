//! What a single picture shows.

use std::fs;
use std::path::{Path, PathBuf};

use super::captions::{self, GameCaptions};
use super::report::texts;
use super::settings::PictureSettings;
use super::studio::bodies;
use super::{JobError, Progress, Showing, say_problems};
use crate::caption::Content;
use crate::game::{Game, Letters, Moment, Source};
use crate::notation::Placement;
use crate::text::shown;
use crate::timeline::{Frame, Timeline};

/// Where a position comes from.
#[derive(Clone, Debug)]
pub enum Subject {
    /// Pieces on squares, and their FEN for the picture's own text.
    Placement { placement: Placement, fen: String },
    /// A position of a game.
    Game { file: PathBuf, letters: Letters, number: usize, at: Moment },
}

/// What to show, and what the picture says of itself.
pub(super) struct Shot {
    pub frame: Frame,
    pub texts: Vec<(&'static str, String)>,
    /// What a caption says; `None` where nothing is known.
    pub content: Option<Content>,
    /// Whether the whole game could be read, where it comes from one.
    pub is_whole: bool,
}

impl Subject {
    /// Reads the position.
    pub(super) fn read(
        &self,
        settings: &PictureSettings,
        progress: &dyn Progress,
    ) -> Result<Shot, JobError> {
        let (file, letters, number, at) = match self {
            Subject::Placement { placement, fen } => {
                return Ok(Shot {
                    frame: Frame::of_fen(*placement, fen, &bodies(settings)?),
                    texts: vec![("FEN", fen.clone())],
                    content: captions::of_fen(fen, settings.config.captions),
                    is_whole: true,
                });
            }
            Subject::Game { file, letters, number, at } => (file, *letters, *number, *at),
        };
        let name = shown(file);
        let source = Source::open(file)?.with_letters(letters);
        let mut games = source.games_where(|head| head.number == number);
        let found = games.next().transpose()?;
        if let Some(game) = &found {
            say_problems(&name, game, progress);
        }
        match found.filter(|game| game.number == number) {
            Some(game) => shot(name, &game, at, settings),
            None => Err(JobError::NothingSelected { file: name, games: games.seen() }),
        }
    }
}

/// Refuses to write over what is read: the game, the settings, the pictures of materials, the set.
pub(super) fn keep_inputs(
    subject: &Subject,
    settings: &PictureSettings,
    output: &Path,
) -> Result<(), JobError> {
    match subject {
        Subject::Game { file, .. } => keep_files([file], settings, output),
        Subject::Placement { .. } => keep_files([], settings, output),
    }
}

/// Refuses to write over files of `games`, or what is read for pictures.
pub(super) fn keep_files<'a>(
    games: impl IntoIterator<Item = &'a PathBuf>,
    settings: &PictureSettings,
    output: &Path,
) -> Result<(), JobError> {
    let place = |path: &Path| fs::canonicalize(path).ok();
    let of_pictures = settings.inputs();
    let target = place(output);
    let mut inputs = games.into_iter().map(PathBuf::as_path);
    let is_target = |input: &Path| place(input) == target;
    if target.is_some()
        && (inputs.any(is_target) || of_pictures.iter().any(|input| is_target(input)))
    {
        return Err(JobError::OutputIsInput { path: output.to_owned() });
    }
    Ok(())
}

fn shot(
    file: String,
    game: &Game,
    at: Moment,
    settings: &PictureSettings,
) -> Result<Shot, JobError> {
    if !game.start_is_known {
        return Err(JobError::NoPosition { file, game: game.number });
    }
    let ply = at.ply(game).map_err(|_| JobError::NoSuchMoment {
        file: file.clone(),
        game: game.number,
        moment: at,
        start: game.moment_name(0),
        end: game.moment_name(game.plies.len()),
    })?;
    let config = &settings.config;
    let showing = Showing::default();
    let script = showing.script(config, bodies(settings)?);
    // Of the whole game: a camera's path goes through all of it.
    let timeline = Timeline::new(game, 0, game.plies.len(), &script);
    let timeline = timeline.map_err(|error| JobError::Path { file, game: game.number, error })?;
    let frame = timeline.frame(ply);
    let content = GameCaptions::new(game, config.captions).of(&frame);
    Ok(Shot { texts: texts(game, &frame), content, frame, is_whole: game.is_whole() })
}
