//! Films on their way to disk: each is encoded by a thread of its own, beside the tracing of what follows.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::JoinHandle;

use crate::output::{Cut, Ffmpeg, FilmFormat, FilmWriter, OutputError, RepeatedPicture};

/// How many pictures may wait for a film: enough that a picture that takes long does not hold up the others, and no more
/// than memory has room for.
const WAITING: usize = 4;

/// What films are wanted of each game.
#[derive(Clone, Debug, Default)]
pub struct Films {
    pub formats: Vec<FilmFormat>,
    /// Who makes MP4; the encoder inside where there is none.
    pub ffmpeg: Option<Ffmpeg>,
}

/// The films of one game.
pub struct Reels {
    reels: Vec<Reel>,
}

struct Reel {
    path: PathBuf,
    pictures: SyncSender<Arc<RepeatedPicture>>,
    thread: JoinHandle<Result<bool, OutputError>>,
}

impl Reels {
    /// Begins films in files that are named for each format.
    ///
    /// # Errors
    /// When a thread cannot be started.
    pub fn begin(
        films: &Films,
        cut: &Cut,
        file: impl Fn(FilmFormat) -> PathBuf,
    ) -> Result<Reels, OutputError> {
        let begin = |format: &FilmFormat| {
            let (path, format) = (file(*format), *format);
            let (pictures, waiting) = sync_channel(WAITING);
            let (target, cut, ffmpeg) = (path.clone(), cut.clone(), films.ffmpeg.clone());
            // Not every encoder can go from one thread to another.
            let thread = spawn(&path, move || {
                filled(FilmWriter::new(&target, format, &cut, ffmpeg.as_ref())?, waiting)
            })?;
            Ok(Reel { path, pictures, thread })
        };
        Ok(Reels { reels: films.formats.iter().map(begin).collect::<Result<_, _>>()? })
    }

    /// Hands the next picture on; waits while too many do. Whether all films still take pictures.
    pub fn add(&self, picture: &Arc<RepeatedPicture>) -> bool {
        self.reels.iter().all(|reel| reel.pictures.send(picture.clone()).is_ok())
    }

    /// Ends the films: how many became whole, and what went wrong if anything did. One that lacks pictures leaves no file.
    pub fn end(self) -> (usize, Result<(), OutputError>) {
        let (mut whole, mut outcome) = (0, Ok(()));
        for Reel { path, pictures, thread } in self.reels {
            drop(pictures);
            let ended = thread.join().unwrap_or_else(|_| {
                let error = std::io::Error::other("its encoder broke down");
                Err(OutputError { path, error })
            });
            match ended {
                Ok(is_whole) => whole += usize::from(is_whole),
                Err(error) => outcome = outcome.and(Err(error)),
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
) -> Result<bool, OutputError> {
    for picture in pictures {
        writer.add(picture.picture())?;
    }
    if !writer.is_whole() {
        return Ok(false);
    }
    writer.finish()?;
    Ok(true)
}
