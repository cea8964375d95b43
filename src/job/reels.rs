//! Films on their way to disk: each is encoded by a thread of its own, beside the tracing of what follows.

use std::iter::Peekable;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, SyncSender, TrySendError, sync_channel};
use std::thread::JoinHandle;
use std::time::Duration;
use std::vec::IntoIter;

use super::Progress;
use super::run::Films;
use super::shots::Shots;

use crate::output::{FilmFormat, FilmWriter, OutputError, RepeatedPicture, Stop};

/// How many pictures may wait for a film: enough that a picture that takes long does not hold up the others, and no more
/// than memory has room for.
const WAITING: usize = 4;

/// The films of one game.
pub struct Reels<'a> {
    progress: &'a dyn Progress,
    reels: Vec<Reel>,
    /// The first frames of shots that are still to come.
    begins: Peekable<IntoIter<usize>>,
}

struct Reel {
    format: FilmFormat,
    path: PathBuf,
    pictures: SyncSender<Arc<RepeatedPicture>>,
    stop: Stop,
    thread: JoinHandle<Result<bool, OutputError>>,
}

/// How long it is waited between two looks for room, or for somebody who wants to stop.
const LOOK: Duration = Duration::from_millis(2);

impl<'a> Reels<'a> {
    /// Begins films of `shots` in files that are named for each format.
    ///
    /// # Errors
    /// When a thread cannot be started.
    pub fn begin(
        films: &Films,
        Shots { begins, cut }: Shots,
        progress: &'a dyn Progress,
        file: impl Fn(FilmFormat) -> PathBuf,
    ) -> Result<Reels<'a>, OutputError> {
        let begins = begins.into_iter().peekable();
        let mut reels = Reels { progress, reels: Vec::new(), begins };
        for format in films.formats.iter().copied() {
            let path = file(format);
            let (pictures, waiting) = sync_channel(WAITING);
            let (target, cut, ffmpeg) = (path.clone(), cut.clone(), films.ffmpeg.clone());
            let stop = Stop::default();
            let stopped = stop.clone();
            // Not every encoder can go from one thread to another.
            let begun = spawn(&path, move || {
                let writer = FilmWriter::new(&target, format, &cut, ffmpeg.as_ref(), &stopped)?;
                filled(writer, waiting, &stopped)
            });
            match begun {
                Ok(thread) => reels.reels.push(Reel { format, path, pictures, stop, thread }),
                Err(error) => {
                    let _ = reels.end(true);
                    return Err(error);
                }
            }
        }
        Ok(reels)
    }

    /// No films.
    pub fn none(progress: &'a dyn Progress) -> Reels<'a> {
        Reels { progress, reels: Vec::new(), begins: Vec::new().into_iter().peekable() }
    }

    /// Whether there are no films.
    pub fn is_empty(&self) -> bool {
        self.reels.is_empty()
    }

    /// Whether films want the picture of a frame: if a shot begins with it. Frames are asked for in their order.
    pub fn wants(&mut self, frame: usize) -> bool {
        self.begins.next_if_eq(&frame).is_some()
    }

    /// Hands a picture on that is wanted; waits while too many do. Whether all films still take pictures, and nobody
    /// wants to stop.
    pub fn add(&mut self, picture: &Arc<RepeatedPicture>) -> bool {
        self.reels.iter().all(|reel| {
            let mut next = picture.clone();
            loop {
                match reel.pictures.try_send(next) {
                    Ok(()) => return true,
                    Err(TrySendError::Disconnected(_)) => return false,
                    Err(TrySendError::Full(_)) if self.progress.is_cancelled() => return false,
                    Err(TrySendError::Full(again)) => next = again,
                }
                std::thread::sleep(LOOK);
            }
        })
    }

    /// Ends the films: those that became whole, and what went wrong if anything did. One that lacks pictures leaves no
    /// file; where the job `is_over`, or is cancelled meanwhile, what waits is not encoded.
    pub fn end(self, is_over: bool) -> (Vec<FilmFormat>, Result<(), OutputError>) {
        let (mut whole, mut outcome) = (Vec::new(), Ok(()));
        for Reel { format, path, pictures, stop, thread } in self.reels {
            drop(pictures);
            while !thread.is_finished() {
                if is_over || self.progress.is_cancelled() {
                    stop.now();
                }
                std::thread::sleep(LOOK);
            }
            let ended = thread.join().unwrap_or_else(|_| {
                let error = std::io::Error::other("its encoder broke down");
                Err(OutputError { path, error })
            });
            match ended {
                Ok(true) => whole.push(format),
                // What is told to stop may well complain.
                Err(error) if !stop.is_wanted() => outcome = outcome.and(Err(error)),
                Ok(false) | Err(_) => {}
            }
        }
        (whole, outcome)
    }
}

fn spawn(
    path: &Path,
    work: impl FnOnce() -> Result<bool, OutputError> + Send + 'static,
) -> Result<JoinHandle<Result<bool, OutputError>>, OutputError> {
    let spawned = std::thread::Builder::new().name("film".to_owned()).spawn(work);
    spawned.map_err(|error| OutputError { path: path.to_owned(), error })
}

/// Makes a film of pictures as they come; whether it became whole.
fn filled(
    mut writer: FilmWriter,
    pictures: Receiver<Arc<RepeatedPicture>>,
    stop: &Stop,
) -> Result<bool, OutputError> {
    for picture in pictures {
        if stop.is_wanted() {
            return Ok(false);
        }
        writer.add(&picture)?;
    }
    if !writer.is_whole() {
        return Ok(false);
    }
    writer.finish()?;
    Ok(true)
}
