//! A single position as a scene for another renderer.

use std::io::Write;
use std::path::{Path, PathBuf};

use super::settings::PictureSettings;
use super::studio::stage;
use super::subject::{Subject, keep_inputs};
use super::{JobError, Progress, Showing};
use crate::export::pov;
use crate::output::{Content, encode_png, prepare_file, write_together};
use crate::text::shown;

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
    let shot = job.subject.read(&job.picture, progress)?;
    let scene =
        stage(&job.picture, Showing::default().reach(&job.picture.config))?.scene(&shot.frame);
    let config = &job.picture.config;
    let stem = job.output.file_stem().map_or("scene".into(), |stem| stem.to_string_lossy());
    let written = pov(&scene, config.width, config.height, &plain(&stem));
    if job.output == Path::new("-") {
        if !written.bitmaps.is_empty() {
            return Err(JobError::BitmapsOnStdout);
        }
        stdout.write_all(written.text.as_bytes()).map_err(JobError::Write)?;
        return Ok(shot.is_whole);
    }
    let text = |out: &mut dyn Write| out.write_all(written.text.as_bytes());
    let pictures: Vec<_> = written
        .bitmaps
        .iter()
        .map(|(name, bitmap)| {
            let encode =
                |out: &mut dyn Write| encode_png(&bitmap.picture().clone().into(), &[], None, out);
            (job.output.with_file_name(name), encode)
        })
        .collect();
    let mut files: Vec<(PathBuf, Content)> = vec![(job.output.clone(), &text)];
    files.extend(pictures.iter().map(|(path, encode)| (path.clone(), encode as Content)));
    for (path, _) in &files {
        keep_inputs(&job.subject, &job.picture, path)?;
    }
    prepare_file(&job.output)?;
    write_together(&files)?;
    progress.say(&format!("{} is written", shown(&job.output)));
    let folder = job.output.parent().filter(|folder| !folder.as_os_str().is_empty());
    let folder = folder.map_or(String::new(), |folder| format!(" in {}", shown(folder)));
    progress.detail(&format!(
        "its picture{folder}: povray '+I{stem}.pov' +W{} +H{} -A",
        config.width, config.height
    ));
    Ok(shot.is_whole)
}

/// `name` in letters, digits and hyphens of ASCII, which every program reads; other names stay other.
fn plain(name: &str) -> String {
    let written = |letter: char| match letter {
        '-' => "-".to_owned(),
        _ if letter.is_ascii_alphanumeric() => letter.to_string(),
        _ => format!("_{:x}", u32::from(letter)),
    };
    name.chars().map(written).collect()
}

#[cfg(test)]
mod tests {
    use super::plain;

    #[test]
    fn plain_names_differ_where_names_do() {
        let names = ["scene-1", "a b", "a_b", "a_20b", "ä", "ö", "q\"uote", "back\\slash"];
        let plain: std::collections::BTreeSet<String> = names.into_iter().map(plain).collect();
        assert_eq!(plain.len(), names.len());
        assert!(plain.contains("scene-1") && plain.iter().all(|name| name.is_ascii()));
    }
}
