//! Whether pictures have room where they are to go.

use std::fs;
use std::path::Path;

use super::JobError;
use super::run::RenderJob;
use crate::config::Config;
use crate::output::PictureFormat;

/// Pixels that take a byte, at least, where pictures are compressed; most take less than two.
const PIXELS_A_BYTE: u64 = 20;

/// Refuses a job whose pictures cannot be written, since their folder has too little room for them.
///
/// # Errors
/// When that is so for certain.
pub fn check_room(job: &RenderJob, frames: u64) -> Result<(), JobError> {
    let Config { width, height, .. } = job.picture.config;
    let Some(names) = &job.names else { return Ok(()) };
    let pixels = u64::from(width) * u64::from(height);
    let least = match names.format() {
        PictureFormat::Bmp | PictureFormat::Tiff => 3 * pixels,
        PictureFormat::Png | PictureFormat::Jpeg | PictureFormat::Webp => pixels / PIXELS_A_BYTE,
    };
    let needed = frames.saturating_mul(least);
    // The folder itself may still have to be made.
    let Some(free) = job.out.ancestors().find_map(free) else { return Ok(()) };
    // What an earlier run has left there needs no more room.
    if needed > free && needed > free.saturating_add(taken(&job.out)) {
        let folder = job.out.clone();
        return Err(JobError::NoRoom { folder, frames, width, height, needed, free });
    }
    Ok(())
}

/// Bytes that can still be written to a folder, where the system tells.
fn free(folder: &Path) -> Option<u64> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    folder.is_dir().then(|| fs4::available_space(folder).ok()).flatten()
}

/// Bytes of the files in a folder and those within it.
fn taken(folder: &Path) -> u64 {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    entries
        .map(|entry| match entry.file_type() {
            Ok(kind) if kind.is_dir() => taken(&entry.path()),
            Ok(kind) if kind.is_file() => entry.metadata().map_or(0, |found| found.len()),
            _ => 0,
        })
        .sum()
}
