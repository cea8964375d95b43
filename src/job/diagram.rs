//! A single position as one picture.

use std::io::Write;
use std::path::{Path, PathBuf};

use super::settings::PictureSettings;
use super::studio::Studio;
use super::subject::{Subject, keep_inputs};
use super::{JobError, Progress, Showing};
use crate::notation::{Arrow, Circle, Square};
use crate::output::{encode_png, prepare_file, write_picture};
use crate::text::shown;
use crate::timeline::Marks;
use crate::tracer::RayCounts;

/// Which position to render, and where to.
#[derive(Clone, Debug)]
pub struct DiagramJob {
    pub subject: Subject,
    pub drawn: Drawn,
    /// The picture's file, PNG or BMP by its ending; `-` is the standard output, as PNG.
    pub output: PathBuf,
    pub picture: PictureSettings,
    /// Pixels an inch of paper, for the file to say; nothing when `None`.
    pub dpi: Option<u32>,
}

/// What is to be drawn on the board, over what the game says.
#[derive(Clone, Debug, Default)]
pub struct Drawn {
    /// Beside the game's own.
    pub circles: Vec<Circle>,
    pub arrows: Vec<Arrow>,
    /// The squares that a move left and reached, instead of the game's last one.
    pub last_move: Option<[Square; 2]>,
}

impl Drawn {
    fn add_to(&self, marks: &mut Marks) {
        marks.circles.extend(&self.circles);
        marks.arrows.extend(&self.arrows);
        if let Some(squares) = self.last_move {
            marks.last_move = squares.to_vec();
        }
    }
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
    let mut shot = job.subject.read(&job.picture, progress)?;
    job.drawn.add_to(&mut shot.frame.marks);
    keep_inputs(&job.subject, &job.picture, &job.output)?;
    let mut settings = job.picture.clone();
    // Where nothing is known there is no strip.
    settings.config.captions.show &= shot.content.is_some();
    let mut studio = Studio::new(&settings, Showing::default().reach(&settings.config))?;
    let to_stdout = job.output == Path::new("-");
    if !to_stdout {
        prepare_file(&job.output)?;
    }
    let pool = settings.pool()?;
    let picture = pool.install(|| studio.single(&shot.frame, shot.content.as_ref()));
    if to_stdout {
        encode_png(&picture, &shot.texts, job.dpi, stdout).map_err(JobError::Write)?;
    } else {
        write_picture(&job.output, &picture, &shot.texts, job.dpi)?;
        progress.say(&format!("{} is written", shown(&job.output)));
    }
    Ok(DiagramSummary { rays: studio.rays(), is_whole: shot.is_whole })
}
