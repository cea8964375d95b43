//! Films: one file of many pictures, each for its time.
//!
//! It is known beforehand how long each picture stands. So each format makes whole steps of its own of these times, and
//! none of them drifts: every step ends as near as it can to where it should.

mod apng;
mod ffmpeg;
mod gif;
#[cfg(feature = "h264")]
mod h264;
mod patch;
#[cfg(feature = "webp")]
mod webp;
mod yuv;

pub use ffmpeg::{Ffmpeg, FfmpegError, Stop};

use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use image::DynamicImage;
use tempfile::NamedTempFile;

use super::{OutputError, RepeatedPicture, temporary};

/// What a film may be written as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FilmFormat {
    Gif,
    Apng,
    Webp,
    Mp4,
}

/// The formats by the endings of their files.
pub const FILM_FORMATS: [(&str, FilmFormat); 4] = [
    ("gif", FilmFormat::Gif),
    ("apng", FilmFormat::Apng),
    ("webp", FilmFormat::Webp),
    ("mp4", FilmFormat::Mp4),
];

impl FilmFormat {
    /// The ending of its files.
    pub fn ending(self) -> &'static str {
        FILM_FORMATS.iter().find(|(_, format)| *format == self).map_or("gif", |(ending, _)| ending)
    }

    /// Whether the program can write it with no other program.
    pub fn is_built_in(self) -> bool {
        match self {
            FilmFormat::Gif | FilmFormat::Apng => true,
            FilmFormat::Webp => cfg!(feature = "webp"),
            FilmFormat::Mp4 => cfg!(feature = "h264"),
        }
    }

    /// The size that pictures of `size` have in it: MP4's are even, and lose their last column or row.
    pub fn size(self, [width, height]: [u32; 2]) -> [u32; 2] {
        match self {
            FilmFormat::Mp4 => [width & !1, height & !1],
            _ => [width, height],
        }
    }

    /// Checks that it can have pictures of `size`, where MP4 is made by ffmpeg or not.
    ///
    /// # Errors
    /// What it can have, in words.
    pub fn check(self, [width, height]: [u32; 2], has_ffmpeg: bool) -> Result<(), String> {
        let (least, longer, shorter) = match self {
            FilmFormat::Gif => (1, 65_535, 65_535),
            FilmFormat::Apng => (1, 1 << 30, 1 << 30),
            FilmFormat::Webp => (1, 16_383, 16_383),
            FilmFormat::Mp4 if has_ffmpeg => (16, 16_384, 16_384),
            // OpenH264's limits.
            FilmFormat::Mp4 => (16, 3840, 2160),
        };
        let sides = [width.min(height), width.max(height)];
        if sides[0] >= least && sides[0] <= shorter && sides[1] <= longer {
            return Ok(());
        }
        let inside = if self == FilmFormat::Mp4 && !has_ffmpeg { " without ffmpeg" } else { "" };
        let name = self.ending();
        let most = format!("{longer}x{shorter}");
        Err(format!(
            "expected a size from {least}x{least} to {most} for {name}{inside}, found {width}x{height}"
        ))
    }
}

/// What is known of a film before its first picture.
#[derive(Clone, Debug, Default)]
pub struct Cut {
    /// Width and height of its pictures.
    pub size: [u32; 2],
    /// Pictures a second, where the format has no times of its own.
    pub fps: f64,
    /// Whether its pictures have transparent parts.
    pub is_transparent: bool,
    /// When each picture ends, in seconds from the beginning; never before the one before it.
    pub ends: Vec<f64>,
}

impl Cut {
    /// How long each picture stands, in steps of which there are `rate` a second. Those that would stand for
    /// less than `least` steps stand for none, and leave their time to the next; the last one always stands. The
    /// sum is the film's length, to the nearest step.
    fn steps(&self, rate: f64, least: u64) -> Vec<u64> {
        let mut steps: Vec<u64> = Vec::with_capacity(self.ends.len());
        let mut begin = 0;
        for end in &self.ends {
            let end = (end * rate).round() as u64;
            let long = end.saturating_sub(begin);
            let stands = long >= least.max(1);
            steps.push(if stands { long } else { 0 });
            begin += steps[steps.len() - 1];
        }
        if let (Some(0), Some(end)) = (steps.last(), self.ends.last()) {
            let rest = ((end * rate).round() as u64).saturating_sub(begin);
            let before = steps.iter_mut().rev().find(|steps| **steps > 0).map_or(0, std::mem::take);
            let last = steps.len() - 1;
            steps[last] = (before + rest).max(least).max(1);
        }
        steps
    }
}

/// Puts pictures into a file; all are RGBA in a transparent film, and RGB in others.
trait Encode {
    /// Adds the next picture, for `steps`, at least 1.
    fn add(&mut self, picture: &Arc<RepeatedPicture>, steps: u64) -> io::Result<()>;

    /// Writes what is left to be written.
    fn finish(self: Box<Self>) -> io::Result<()>;
}

/// A film that is written, under a temporary name until it is whole.
pub struct FilmWriter {
    path: PathBuf,
    file: NamedTempFile,
    encoder: Box<dyn Encode>,
    is_transparent: bool,
    steps: std::vec::IntoIter<u64>,
}

impl FilmWriter {
    /// For a film of at least one picture; MP4 is made by `ffmpeg` where there is one, which `stop` can end.
    ///
    /// # Errors
    /// When the file cannot be made.
    pub fn new(
        path: &Path,
        format: FilmFormat,
        cut: &Cut,
        ffmpeg: Option<&Ffmpeg>,
        stop: &Stop,
    ) -> Result<FilmWriter, OutputError> {
        let begun = || -> io::Result<FilmWriter> {
            format.check(cut.size, ffmpeg.is_some()).map_err(io::Error::other)?;
            let file = temporary(path)?;
            let (steps, encoder): (_, Box<dyn Encode>) = match (format, ffmpeg) {
                (FilmFormat::Gif, _) => {
                    let steps = cut.steps(gif::RATE, gif::LEAST);
                    (steps, Box::new(gif::Gif::new(file.reopen()?, cut)?))
                }
                (FilmFormat::Apng, _) => {
                    let steps = cut.steps(apng::RATE, 1);
                    let encoder = apng::Apng::new(file.reopen()?, cut, &steps)?;
                    (steps, Box::new(encoder))
                }
                #[cfg(feature = "webp")]
                (FilmFormat::Webp, _) => {
                    (cut.steps(webp::RATE, 1), Box::new(webp::Webp::new(file.reopen()?, cut.size)?))
                }
                (FilmFormat::Mp4, Some(ffmpeg)) => {
                    let size = format.size(cut.size);
                    let encoder = ffmpeg.film(file.path(), size, cut.fps, stop)?;
                    (cut.steps(cut.fps, 1), Box::new(encoder))
                }
                #[cfg(feature = "h264")]
                (FilmFormat::Mp4, None) => {
                    let encoder = h264::H264::new(file.reopen()?, format.size(cut.size), cut.fps)?;
                    (cut.steps(cut.fps, 1), Box::new(encoder))
                }
                #[cfg(not(all(feature = "webp", feature = "h264")))]
                _ => return Err(io::ErrorKind::Unsupported.into()),
            };
            let steps = steps.into_iter();
            let is_transparent = cut.is_transparent;
            Ok(FilmWriter { path: path.to_owned(), file, encoder, is_transparent, steps })
        };
        begun().map_err(|error| OutputError { path: path.to_owned(), error })
    }

    /// Adds the next picture, as long as the [`Cut`] has it.
    ///
    /// # Errors
    /// When it cannot be encoded or written.
    pub fn add(&mut self, picture: &Arc<RepeatedPicture>) -> Result<(), OutputError> {
        let added = match self.steps.next() {
            None | Some(0) => Ok(()),
            Some(steps) => self.encoder.add(&self.of_kind(picture), steps),
        };
        added.map_err(|error| OutputError { path: self.path.clone(), error })
    }

    /// A picture of the film's kind: opaque ones, such as titles, may be among others.
    fn of_kind(&self, picture: &Arc<RepeatedPicture>) -> Arc<RepeatedPicture> {
        let found = picture.picture();
        match (self.is_transparent, found) {
            (true, DynamicImage::ImageRgba8(_)) | (false, DynamicImage::ImageRgb8(_)) => {
                picture.clone()
            }
            (true, _) => Arc::new(RepeatedPicture::new(found.to_rgba8().into())),
            (false, _) => Arc::new(RepeatedPicture::new(found.to_rgb8().into())),
        }
    }

    /// Whether all pictures are there.
    pub fn is_whole(&self) -> bool {
        self.steps.len() == 0
    }

    /// Gives the film its name.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn finish(self) -> Result<(), OutputError> {
        let FilmWriter { path, file, encoder, .. } = self;
        let finished = || {
            encoder.finish()?;
            file.persist(&path).map_err(|error| error.error)?;
            Ok(())
        };
        finished().map_err(|error| OutputError { path: path.clone(), error })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn cut(ends: Vec<f64>) -> Cut {
        Cut { size: [4, 4], fps: 25.0, is_transparent: false, ends }
    }

    #[test]
    fn sizes_are_what_formats_can_have() {
        let fits = |format: FilmFormat, size, has_ffmpeg| format.check(size, has_ffmpeg).is_ok();
        assert!(
            fits(FilmFormat::Mp4, [3840, 2160], false)
                && fits(FilmFormat::Mp4, [1080, 1920], false)
        );
        assert!(
            !fits(FilmFormat::Mp4, [2400, 2400], false)
                && fits(FilmFormat::Mp4, [2400, 2400], true)
        );
        assert!(
            !fits(FilmFormat::Mp4, [15, 100], true) && !fits(FilmFormat::Webp, [16_384, 2], true)
        );
        assert!(fits(FilmFormat::Gif, [1, 65_535], false) && fits(FilmFormat::Apng, [1, 1], false));
    }

    #[test]
    fn pictures_that_are_too_short_leave_their_time_to_others() {
        let at = |fps: f64, frames: usize| {
            cut((1..=frames).map(|frame| frame as f64 / fps).collect()).steps(100.0, 2)
        };
        assert_eq!(at(25.0, 3), [4, 4, 4]);
        assert_eq!(at(30.0, 4), [3, 4, 3, 3]);
        assert_eq!(at(50.0, 3), [2, 2, 2]);
        assert_eq!(at(60.0, 6), [2, 0, 3, 2, 0, 3]);
        assert_eq!(at(100.0, 4), [0, 2, 0, 2]);
        // The last one is always seen.
        assert_eq!(at(100.0, 5), [0, 2, 0, 0, 3]);
        assert_eq!(at(240.0, 1), [2]);
        assert_eq!(cut(vec![0.5, 0.5, 1.0]).steps(25.0, 1), [13, 0, 12]);
    }

    proptest! {
        #[test]
        fn the_steps_are_as_long_as_the_film(
            mut ends in proptest::collection::vec(0.0..100.0_f64, 1..50),
            rate in 1.0..1000.0_f64,
            least in 1..4_u64,
        ) {
            ends.sort_by(f64::total_cmp);
            let whole = (ends[ends.len() - 1] * rate).round() as u64;
            let steps = cut(ends).steps(rate, least);
            prop_assert_eq!(steps.iter().sum::<u64>(), whole.max(least));
            prop_assert!(steps.iter().all(|steps| *steps == 0 || *steps >= least));
            prop_assert!(steps.last() >= Some(&least));
        }
    }
}
