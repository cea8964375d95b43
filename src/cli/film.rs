//! The options of films: formats, times, frames, and how the camera goes about the board.

use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};

use anyhow::bail;
use clap::{ArgGroup, Args, ValueEnum};
use lightsquare::config::Config;
use lightsquare::job::{Films, Showing};
use lightsquare::output::{FILM_FORMATS, FORMATS, Ffmpeg, FilmFormat, FrameNames, PictureFormat};
use lightsquare::timeline::{Film, Pause};

use super::UsageError;
use super::preset::Preset;
use super::values::{degrees, fps, frames, one_of, pause, seconds};

/// Times and frames of films.
#[derive(Args)]
#[command(
    next_help_heading = "Film",
    group = ArgGroup::new("timed").multiple(true).args(["animate", "film", "preset"]),
    group = ArgGroup::new("filmed").multiple(true).args(["film", "preset"])
)]
pub struct FilmArgs {
    /// Make the frames of a film, with the moves between the positions
    #[arg(long)]
    animate: bool,
    /// Make a film, film.mp4 and the like in the game's folder; may be given again for further formats. Without
    /// --animate it goes from position to position
    #[arg(long, value_name = "FORMAT", value_parser = one_of(&FILM_FORMATS), ignore_case = true)]
    film: Vec<FilmFormat>,
    /// Make a film for a place: its format, with moves and captions, and the size, the frames a second and
    /// the captured pieces that suit it; other options are over it
    #[arg(long = "for", id = "preset", value_name = "PLACE", ignore_case = true)]
    preset: Option<Preset>,
    /// No numbered pictures, films alone
    #[arg(long, requires = "filmed", conflicts_with_all = ["format", "names"])]
    no_frames: bool,
    /// The format of numbered pictures [default: png]
    #[arg(long, value_name = "FORMAT", value_parser = one_of(&FORMATS), ignore_case = true)]
    format: Option<PictureFormat>,
    /// Names of numbered pictures, with the number as %05d or #####; the ending says the format
    /// [default: frame_%05d.png]
    #[arg(long, value_name = "PATTERN")]
    names: Option<String>,
    /// The ffmpeg that makes MP4 [default: the one that is installed, or else the encoder inside]
    #[arg(long, value_name = "PATH")]
    ffmpeg: Option<PathBuf>,
    /// Frames a second, from 1 to 240 [default: 25; that of the place]
    #[arg(
        long,
        value_name = "N",
        value_parser = fps,
        allow_negative_numbers = true,
        requires = "timed"
    )]
    fps: Option<f64>,
    /// Seconds that a move takes
    #[arg(
        long,
        value_name = "S",
        default_value = "0.6",
        value_parser = seconds,
        allow_negative_numbers = true,
        requires = "timed"
    )]
    transition: f64,
    /// Seconds that a position stands; or real, by the players' clocks in the game: 0.8 for the
    /// median, no less than 0.4, no more than 2
    #[arg(
        long,
        value_name = "S|real",
        default_value = "0.8",
        value_parser = pause,
        allow_negative_numbers = true,
        requires = "timed"
    )]
    pause: Pause,
    /// Seconds that the first position stands
    #[arg(
        long,
        value_name = "S",
        default_value = "1",
        value_parser = seconds,
        allow_negative_numbers = true,
        requires = "timed"
    )]
    first: f64,
    /// Seconds that the last position stands
    #[arg(
        long,
        value_name = "S",
        default_value = "5",
        value_parser = seconds,
        allow_negative_numbers = true,
        requires = "timed"
    )]
    last: f64,
    /// Seconds that a title stands before the game; without --animate, one picture of it
    #[arg(
        long,
        value_name = "S",
        default_value = "0",
        default_missing_value = "3",
        num_args = 0..=1,
        require_equals = true,
        value_parser = seconds
    )]
    title: f64,
    /// Seconds that the result stands behind the game; without --animate, one picture of it
    #[arg(
        long,
        value_name = "S",
        default_value = "0",
        default_missing_value = "3",
        num_args = 0..=1,
        require_equals = true,
        value_parser = seconds
    )]
    result: f64,
    /// Only these frames of each game, as in 100-250 or 7, with their names and times in the whole
    #[arg(long, value_name = "FRAMES", value_parser = frames)]
    pub frames: Option<RangeInclusive<usize>>,
    /// Turn the camera about the board by so many degrees, anticlockwise as seen from above
    #[arg(
        long,
        value_name = "DEG",
        default_value = "0",
        value_parser = degrees,
        allow_negative_numbers = true
    )]
    orbit: f64,
    /// Over what the camera turns so far
    #[arg(
        long,
        value_name = "SPAN",
        default_value = "film",
        requires = "orbit",
        ignore_case = true
    )]
    orbit_over: OrbitSpan,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum OrbitSpan {
    /// The whole film.
    Film,
    /// Each move.
    Move,
}

impl FilmArgs {
    /// How games are to be shown in time.
    pub fn showing(&self) -> Showing {
        let FilmArgs { transition, pause, first, last, title, result, preset, .. } = *self;
        let usual = preset.map_or(Film::default().fps, Preset::fps);
        let fps = self.fps.unwrap_or(usual);
        Showing {
            film: Film { fps, transition, pause, first, last, title, result },
            animate: self.animate || preset.is_some(),
            orbit: self.orbit,
            orbits_each_move: self.orbit_over == OrbitSpan::Move,
        }
    }

    /// The names of numbered pictures, if there are to be any.
    pub fn names(&self, config: &Config) -> anyhow::Result<Option<FrameNames>> {
        if self.no_frames {
            return Ok(None);
        }
        let names = match &self.names {
            Some(pattern) => FrameNames::parse(pattern, self.format)
                .map_err(|error| UsageError(format!("--names: {error}")))?,
            None => FrameNames::new(self.format.unwrap_or(PictureFormat::Png)),
        };
        if config.is_transparent() && !names.format().has_alpha() {
            bail!(UsageError(format!(
                "--transparent: expected a --format of png, tiff or webp, found {}",
                names.format().ending()
            )));
        }
        Ok(Some(names))
    }

    /// The films of each game, which can all be made of pictures with the settings.
    pub fn films(&self, config: &Config) -> anyhow::Result<Films> {
        let mut formats = Vec::new();
        let usual = self.preset.filter(|_| self.film.is_empty()).map(Preset::film);
        for format in self.film.iter().copied().chain(usual) {
            if !formats.contains(&format) {
                formats.push(format);
            }
        }
        let ffmpeg = self.ffmpeg(&formats)?;
        let Config { width, height, .. } = *config;
        for format in &formats {
            let name = format.ending();
            if !format.is_built_in() && (*format != FilmFormat::Mp4 || ffmpeg.is_none()) {
                let other =
                    if *format == FilmFormat::Mp4 { ", and ffmpeg is not installed" } else { "" };
                bail!(UsageError(format!("--film: this build has no {name}{other}")));
            }
            if let Err(fault) = format.check([width, height], ffmpeg.is_some()) {
                bail!(UsageError(format!("--film: {fault}")));
            }
            if *format == FilmFormat::Mp4 && config.is_transparent() {
                bail!(UsageError(
                    "--transparent: mp4 cannot be transparent, expected apng, webp or gif"
                        .to_owned()
                ));
            }
        }
        Ok(Films { formats, ffmpeg })
    }

    /// Who makes MP4, if it is asked for.
    fn ffmpeg(&self, formats: &[FilmFormat]) -> anyhow::Result<Option<Ffmpeg>> {
        match &self.ffmpeg {
            Some(path) => match Ffmpeg::at(path) {
                Ok(ffmpeg) => Ok(Some(ffmpeg)),
                Err(error) => bail!(UsageError(format!("--ffmpeg: {error}"))),
            },
            None if formats.contains(&FilmFormat::Mp4) => Ok(Ffmpeg::at(Path::new("ffmpeg")).ok()),
            None => Ok(None),
        }
    }

    /// What the place that a film is for asks of its pictures.
    pub fn preset(&self) -> Option<Preset> {
        self.preset
    }
}
