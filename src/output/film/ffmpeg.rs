//! MP4 by ffmpeg: pictures go to it through a pipe.

use std::collections::VecDeque;
use std::ffi::OsString;
use std::io::{self, BufRead, BufReader, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStderr, ChildStdin, Command, Stdio};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use super::Encode;
use super::yuv::Yuv;
use crate::output::RepeatedPicture;

/// An ffmpeg that can make MP4.
#[derive(Clone, Debug)]
pub struct Ffmpeg {
    path: PathBuf,
}

/// Why a program is no ffmpeg that can be used.
#[derive(Debug, thiserror::Error)]
pub enum FfmpegError {
    #[error("{}: cannot be started, expected ffmpeg", path.display())]
    Start {
        path: PathBuf,
        #[source]
        error: io::Error,
    },
    #[error("{}: is not ffmpeg, its -version says `{said}`", path.display())]
    Other { path: PathBuf, said: String },
    #[error("{}: this ffmpeg has no encoder libx264, expected one that has", path.display())]
    NoEncoder { path: PathBuf },
}

/// The quality: the lower the finer, 0 to 51.
const CRF: &str = "18";

/// How long it thinks.
const PRESET: &str = "veryfast";

/// How many of the lines that it says are kept.
const LINES: usize = 8;

impl std::fmt::Display for Ffmpeg {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        self.path.display().fmt(f)
    }
}

impl Ffmpeg {
    /// The program at `path`, or of that name where the system looks for programs.
    ///
    /// # Errors
    /// When it is none that can be used.
    pub fn at(path: &Path) -> Result<Ffmpeg, FfmpegError> {
        let ask = |arguments: &[&str]| {
            let asked = Command::new(path).args(arguments).stdin(Stdio::null()).output();
            asked.map_err(|error| FfmpegError::Start { path: path.to_owned(), error })
        };
        let answer = ask(&["-hide_banner", "-version"])?;
        let said = [&answer.stdout, &answer.stderr].map(|said| String::from_utf8_lossy(said));
        let first = said.iter().find_map(|said| said.lines().next()).unwrap_or_default();
        if !answer.status.success() || !first.starts_with("ffmpeg version") {
            let said = first.chars().filter(|c| !c.is_control()).take(60).collect();
            return Err(FfmpegError::Other { path: path.to_owned(), said });
        }
        let help = ask(&["-hide_banner", "-h", "encoder=libx264"])?;
        if !String::from_utf8_lossy(&help.stdout).contains("Encoder libx264 ") {
            return Err(FfmpegError::NoEncoder { path: path.to_owned() });
        }
        Ok(Ffmpeg { path: path.to_owned() })
    }

    /// Starts it, for a film of pictures of an even width and height.
    pub(super) fn film(
        &self,
        file: &Path,
        size: [u32; 2],
        fps: f64,
        stop: &Stop,
    ) -> io::Result<Pipe> {
        let [width, height] = size;
        let before = ["-hide_banner", "-loglevel", "error", "-nostdin", "-y", "-f", "rawvideo"];
        let input = [
            "-pix_fmt".to_owned(),
            "yuv420p".to_owned(),
            "-video_size".to_owned(),
            format!("{width}x{height}"),
            "-framerate".to_owned(),
            fps.to_string(),
        ];
        let after = [
            "-i",
            "pipe:0",
            "-an",
            "-c:v",
            "libx264",
            "-preset",
            PRESET,
            "-crf",
            CRF,
            "-pix_fmt",
            "yuv420p",
            "-colorspace",
            "bt709",
            "-color_primaries",
            "bt709",
            "-color_trc",
            "bt709",
            "-color_range",
            "tv",
            "-movflags",
            "+faststart",
            "-f",
            "mp4",
        ];
        // A file's name must not be taken for an option or an address.
        let mut name = OsString::from("file:");
        name.push(file);
        let mut command = Command::new(&self.path);
        command.args(before).args(input).args(after).arg(name);
        command.stdin(Stdio::piped()).stdout(Stdio::null()).stderr(Stdio::piped());
        // Ctrl-C is for us to act upon.
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut command, 0);
        let mut child = command.spawn()?;
        let said = child.stderr.take().map(|stderr| std::thread::spawn(|| last_lines(stderr)));
        let (stdin, child) = (child.stdin.take(), Arc::new(Mutex::new(child)));
        stop.ends(child.clone());
        Ok(Pipe { file: file.to_owned(), stdin, child, said, yuv: Yuv::new(size) })
    }
}

/// What is said last, as far as it is text.
fn last_lines(stderr: ChildStderr) -> Vec<String> {
    let mut lines = VecDeque::new();
    let mut reader = BufReader::new(stderr);
    let mut line = Vec::new();
    // No line is longer than a screen.
    while let Ok(1..) = reader.by_ref().take(4096).read_until(b'\n', &mut line) {
        let text = String::from_utf8_lossy(&line);
        let text: String = text.trim().chars().filter(|c| !c.is_control()).collect();
        if !text.is_empty() {
            lines.push_back(text);
        }
        if lines.len() > LINES {
            lines.pop_front();
        }
        line.clear();
    }
    lines.into()
}

/// An ffmpeg at work.
pub struct Pipe {
    file: PathBuf,
    stdin: Option<ChildStdin>,
    child: Arc<Mutex<Child>>,
    said: Option<JoinHandle<Vec<String>>>,
    yuv: Yuv,
}

impl Pipe {
    /// Waits for its end; what it said last, if it has failed.
    fn end(&mut self) -> io::Result<()> {
        drop(self.stdin.take());
        // Whoever wants to stop it needs the lock meanwhile.
        let status = loop {
            match locked(&self.child).try_wait()? {
                Some(status) => break status,
                None => std::thread::sleep(LOOK),
            }
        };
        let said = self.said.take().and_then(|said| said.join().ok()).unwrap_or_default();
        if status.success() {
            return Ok(());
        }
        let said = if said.is_empty() { String::new() } else { format!(": {}", said.join("; ")) };
        Err(io::Error::other(format!("ffmpeg failed ({status}){said}")))
    }
}

fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// How long it is waited between two looks at a program that is to end.
const LOOK: Duration = Duration::from_millis(2);

/// Stops what makes a film.
#[derive(Clone, Default)]
pub struct Stop(Arc<Mutex<Stopping>>);

#[derive(Default)]
struct Stopping {
    is_wanted: bool,
    child: Option<Arc<Mutex<Child>>>,
}

impl Stop {
    /// A program at work, which is killed when it is to stop.
    fn ends(&self, child: Arc<Mutex<Child>>) {
        locked(&self.0).child = Some(child);
    }

    /// Nothing more is wanted of the film.
    pub fn now(&self) {
        let mut stopping = locked(&self.0);
        stopping.is_wanted = true;
        if let Some(child) = &stopping.child {
            // It may have ended by itself.
            let _ = locked(child).kill();
        }
    }

    pub fn is_wanted(&self) -> bool {
        locked(&self.0).is_wanted
    }
}

impl Encode for Pipe {
    fn add(&mut self, picture: &Arc<RepeatedPicture>, steps: u64) -> io::Result<()> {
        self.yuv.read(picture.picture());
        for _ in 0..steps {
            let written = self.stdin.as_mut().map(|pipe| pipe.write_all(self.yuv.bytes()));
            if let Some(Err(_)) = written {
                // Its own words say more than that it has gone.
                self.end()?;
                return Err(io::Error::other("ffmpeg ended before the film did"));
            }
        }
        Ok(())
    }

    fn finish(mut self: Box<Self>) -> io::Result<()> {
        self.end()?;
        if std::fs::metadata(&self.file)?.len() == 0 {
            return Err(io::Error::other("ffmpeg ended without having written anything"));
        }
        Ok(())
    }
}

impl Drop for Pipe {
    /// A film that is not finished is nobody's.
    fn drop(&mut self) {
        if self.said.is_some() {
            let _ = locked(&self.child).kill();
            let _ = self.end();
        }
    }
}
