//! A single position as one picture.

use std::io;
use std::path::{Path, PathBuf};

use super::studio::{PictureSettings, Studio};
use super::{JobError, shown};
use crate::game::{Moment, Source};
use crate::notation::Placement;
use crate::output::{encode_png, prepare_folder, write_png};
use crate::timeline::Frame;
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
    /// Pieces on squares; with the text that they were read from, for the picture's own text.
    Placement { placement: Placement, fen: String },
    /// A position of a game.
    Game { file: PathBuf, number: usize, at: Moment },
}

/// Renders one position and counts its rays.
///
/// # Errors
/// A game or position that is not there, or output that cannot be written.
pub fn diagram(job: &DiagramJob) -> Result<RayCounts, JobError> {
    let (placement, texts) = read(&job.subject)?;
    let mut studio = Studio::new(&job.picture)?;
    let to_stdout = job.output == Path::new("-");
    let folder = job.output.parent().filter(|folder| !folder.as_os_str().is_empty());
    if let (false, Some(folder)) = (to_stdout, folder) {
        prepare_folder(folder)?;
    }
    let picture = studio.picture(&Frame::still(placement));
    if to_stdout {
        encode_png(&picture, &texts, io::stdout().lock()).map_err(JobError::Write)?;
    } else {
        write_png(&job.output, &picture, &texts)?;
    }
    Ok(studio.rays())
}

type Texts = Vec<(&'static str, String)>;

fn read(subject: &Subject) -> Result<(Placement, Texts), JobError> {
    match subject {
        Subject::Placement { placement, fen } => Ok((*placement, vec![("FEN", fen.clone())])),
        Subject::Game { file, number, at } => {
            let name = shown(file);
            let mut games = 0;
            for game in Source::open(file)?.games() {
                let game = game?;
                games = game.number;
                if game.number != *number {
                    continue;
                }
                let first_problem = game.problems.first();
                if let (false, Some(problem)) = (game.start_is_known, first_problem) {
                    return Err(JobError::NoPosition {
                        file: name,
                        game: *number,
                        problem: problem.to_string(),
                    });
                }
                let ply = at.ply(&game).ok_or(JobError::NoSuchMoment {
                    file: name,
                    game: *number,
                    moment: *at,
                    plies: game.plies.len(),
                })?;
                let row = super::report::FrameRow::new(String::new(), &game, &still(ply, &game));
                return Ok((game.placement(ply), row.texts(&game)));
            }
            Err(JobError::NothingSelected { file: name, games })
        }
    }
}

fn still(ply: usize, game: &crate::game::Game) -> Frame {
    Frame { ply, ..Frame::still(game.placement(ply)) }
}
