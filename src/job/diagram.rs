//! A single position as one picture.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use super::report::texts;
use super::studio::{PictureSettings, Studio};
use super::{JobError, Progress, say_problems, shown};
use crate::game::{Game, Moment, Source};
use crate::notation::Placement;
use crate::output::{encode_png, prepare_folder, write_png};
use crate::timeline::{Frame, Timeline};
use crate::tracer::RayCounts;

/// Which position to render, and where to.
#[derive(Clone, Debug)]
pub struct DiagramJob {
    pub subject: Subject,
    /// The picture's file; `-` is the standard output.
    pub output: PathBuf,
    pub picture: PictureSettings,
}

/// Where a diagram's position comes from.
#[derive(Clone, Debug)]
pub enum Subject {
    /// Pieces on squares, and their FEN for the picture's own text.
    Placement { placement: Placement, fen: String },
    /// A position of a game.
    Game { file: PathBuf, number: usize, at: Moment },
}

/// What a diagram took.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DiagramSummary {
    pub rays: RayCounts,
    /// Whether the whole game could be read, where it comes from one.
    pub is_whole: bool,
}

/// Renders one position; a picture for the standard output goes to `stdout`.
///
/// # Errors
/// A game or position that is not there, or output that cannot be written.
pub fn diagram(
    job: &DiagramJob,
    progress: &dyn Progress,
    stdout: &mut dyn Write,
) -> Result<DiagramSummary, JobError> {
    let shot = read(&job.subject, progress)?;
    refuse_input_as_output(job)?;
    let mut studio = Studio::new(&job.picture)?;
    let to_stdout = job.output == Path::new("-");
    let folder = job.output.parent().filter(|folder| !folder.as_os_str().is_empty());
    if let (false, Some(folder)) = (to_stdout, folder) {
        prepare_folder(folder)?;
    }
    let picture = studio.picture(&shot.frame);
    if to_stdout {
        encode_png(&picture, &shot.texts, stdout).map_err(JobError::Write)?;
    } else {
        write_png(&job.output, &picture, &shot.texts)?;
        progress.say(&format!("{} is written", shown(&job.output)));
    }
    Ok(DiagramSummary { rays: studio.rays(), is_whole: shot.is_whole })
}

fn refuse_input_as_output(job: &DiagramJob) -> Result<(), JobError> {
    let place = |path: &Path| fs::canonicalize(path).ok();
    match &job.subject {
        Subject::Game { file, .. }
            if place(file).is_some_and(|f| place(&job.output) == Some(f)) =>
        {
            Err(JobError::OutputIsInput { path: job.output.clone() })
        }
        _ => Ok(()),
    }
}

/// What to show, and what the picture says of itself.
struct Shot {
    frame: Frame,
    texts: Vec<(&'static str, String)>,
    is_whole: bool,
}

fn read(subject: &Subject, progress: &dyn Progress) -> Result<Shot, JobError> {
    let (file, number, at) = match subject {
        Subject::Placement { placement, fen } => {
            let frame = Frame::still(*placement);
            return Ok(Shot { frame, texts: vec![("FEN", fen.clone())], is_whole: true });
        }
        Subject::Game { file, number, at } => (file, *number, *at),
    };
    let name = shown(file);
    let mut games = 0;
    for game in Source::open(file)?.games() {
        let game = game?;
        games = game.number;
        if game.number == number {
            say_problems(&name, &game, progress);
            return shot(name, &game, at);
        }
    }
    Err(JobError::NothingSelected { file: name, games })
}

fn shot(file: String, game: &Game, at: Moment) -> Result<Shot, JobError> {
    if !game.start_is_known {
        return Err(JobError::NoPosition { file, game: game.number });
    }
    let ply = at.ply(game).map_err(|_| JobError::NoSuchMoment {
        file,
        game: game.number,
        moment: at,
        start: game.moment_name(0),
        end: game.moment_name(game.plies.len()),
    })?;
    let frame = Timeline::new(game, ply, ply, None, 0.0).frame(0);
    Ok(Shot { texts: texts(game, &frame), frame, is_whole: game.is_whole() })
}
