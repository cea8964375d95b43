//! Whether a plan fits what it was made of.

use std::fs;
use std::io::ErrorKind;
use std::ops::Range;
use std::path::PathBuf;

use super::error::PlanError;
use super::file::{Head, Plan};
use super::make::{hashed, settings_of};
use crate::job::JobError;
use crate::job::batch::{Batch, folder_names};
use crate::job::fingerprint::Fingerprints;
use crate::job::input::Input;
use crate::job::run::RenderJob;

/// Makes sure that the games and settings are those of which a plan was made, where `job` is what the plan's arguments
/// stand for. All files of games must be there; those that are `read` must be the same to the last byte.
/// Films in MP4 must be made by the same program.
///
/// # Errors
/// When they are not.
pub fn check(plan: &Plan, job: &RenderJob, read: Range<usize>) -> Result<(), PlanError> {
    let Head { is_by_ffmpeg, .. } = plan.head;
    if job.is_by_ffmpeg() != is_by_ffmpeg {
        return Err(PlanError::OtherEncoder { name: plan.name.clone(), is_by_ffmpeg });
    }
    for (file, input) in plan.head.inputs.iter().enumerate() {
        let (name, shown) = (plan.name.clone(), input.path.clone());
        let path = PathBuf::from(&input.path);
        let is_same = match read.contains(&file) {
            true => hashed(&path).map(|found| found == (input.bytes, input.sha256.clone())),
            false => fs::metadata(&path).map(|data| data.len() == input.bytes),
        };
        match is_same {
            Ok(true) => {}
            Ok(false) => return Err(PlanError::Changed { name, input: shown }),
            Err(error) if error.kind() == ErrorKind::NotFound => {
                return Err(PlanError::Missing { name, input: shown });
            }
            Err(error) => return Err(PlanError::Io { name: shown, error }),
        }
    }
    let reach = job.showing.reach(&job.picture.config);
    if settings_of(&Fingerprints::new(&job.picture, reach)) != plan.head.settings {
        return Err(PlanError::OtherSettings { name: plan.name.clone() });
    }
    Ok(())
}

/// The files that have games that are rendered, as they were seen when the plan was made.
///
/// # Errors
/// When one cannot be read.
pub fn batches(plan: &Plan, job: &RenderJob) -> Result<Vec<Batch>, JobError> {
    let mut batches = Vec::new();
    for ((file, input), folder) in
        plan.head.inputs.iter().enumerate().zip(folder_names(&job.inputs))
    {
        if input.games > 0 {
            let (games, frames) = (input.games, input.frames);
            let (input, folder) = (Input::new(&job.inputs[file])?, folder.into());
            batches.push(Batch { file, input, folder, games, frames, seen: 0 });
        }
    }
    Ok(batches)
}
