//! A single position as a scene for another renderer.

use std::io::Write;
use std::path::{Path, PathBuf};

use super::studio::{PictureSettings, stage};
use super::subject::{Subject, keep_inputs};
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
    let scene = stage(&job.picture)?.scene(&shot.frame);
    let config = &job.picture.config;
    let stem = job.output.file_stem().map_or("scene".into(), |stem| stem.to_string_lossy());
    // POV-Ray reads plain names alone.
    let is_plain = |letter: char| letter.is_ascii_alphanumeric() || letter == '_';
    let plain: String = stem.chars().map(|c| if is_plain(c) { c } else { '-' }).collect();
    let written = pov(&scene, config.width, config.height, &plain);
    if job.output == Path::new("-") {
        if !written.bitmaps.is_empty() {
            return Err(JobError::BitmapsOnStdout);
        }
        stdout.write_all(written.text.as_bytes()).map_err(JobError::Write)?;
        return Ok(shot.is_whole);
    }
    let beside = |name: &str| job.output.with_file_name(name);
    keep_inputs(&job.subject, &job.picture, &job.output)?;
    for (name, _) in &written.bitmaps {
        keep_inputs(&job.subject, &job.picture, &beside(name))?;
    }
    prepare_file(&job.output)?;
    // The scene first: where it cannot be written, nothing is left beside it.
    write_text(&job.output, &written.text)?;
    for (name, bitmap) in &written.bitmaps {
        write_png(&beside(name), bitmap.picture(), &[])?;
    }
    progress.say(&format!("{} is written", shown(&job.output)));
    let folder = job.output.parent().filter(|folder| !folder.as_os_str().is_empty());
    let folder = folder.map_or(String::new(), |folder| format!(" in {}", shown(folder)));
    progress.detail(&format!(
        "its picture{folder}: povray '+I{stem}.pov' +W{} +H{} -A",
        config.width, config.height
    ));
    Ok(shot.is_whole)
}
