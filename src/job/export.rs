//! A single position as a scene for another renderer.

use std::io::Write;
use std::path::{Path, PathBuf};

use super::studio::{PictureSettings, stage};
use super::subject::Subject;
use super::{JobError, Progress, shown};
use crate::export::pov;
use crate::output::{prepare_file, write_png, write_text};

/// Which position to write down, and where to.
#[derive(Clone, Debug)]
pub struct ExportJob {
    pub subject: Subject,
    /// The scene's file; `-` is the standard output.
    pub output: PathBuf,
    pub picture: PictureSettings,
}

/// Writes the scene of one position for POV-Ray, with its pictures beside it; a scene for the
/// standard output goes to `stdout`. Gives whether the whole game could be read, where it comes
/// from one.
///
/// # Errors
/// A game or position that is not there, output that cannot be written, or pictures that have no
/// place beside the standard output.
pub fn export(
    job: &ExportJob,
    progress: &dyn Progress,
    stdout: &mut dyn Write,
) -> Result<bool, JobError> {
    let shot = job.subject.read(progress)?;
    job.subject.is_not(&job.output)?;
    let scene = stage(&job.picture)?.scene(&shot.frame);
    let config = &job.picture.config;
    let to_stdout = job.output == Path::new("-");
    let stem = job.output.file_stem().filter(|_| !to_stdout);
    let name = stem.map_or("scene".into(), |stem| stem.to_string_lossy());
    let written = pov(&scene, config.width, config.height, &name);
    if to_stdout {
        if !written.bitmaps.is_empty() {
            return Err(JobError::BitmapsOnStdout);
        }
        stdout.write_all(written.text.as_bytes()).map_err(JobError::Write)?;
        return Ok(shot.is_whole);
    }
    prepare_file(&job.output)?;
    for (name, bitmap) in &written.bitmaps {
        write_png(&job.output.with_file_name(name), bitmap.picture(), &[])?;
    }
    write_text(&job.output, &written.text)?;
    progress.say(&format!(
        "{} is written; povray +I{name}.pov +W{} +H{} -A makes its picture",
        shown(&job.output),
        config.width,
        config.height
    ));
    Ok(shot.is_whole)
}
