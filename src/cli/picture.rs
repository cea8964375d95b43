//! The options that every picture has, and the settings that come of them.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use clap::{Args, ValueEnum};
use lightsquare::assets::SetName;
use lightsquare::config::{
    CAPTURED, Captured, Config, Look, ORIENTATIONS, Orientation, Quality, Sampling, ShowClock,
    VIEWS, View, unknown,
};
use lightsquare::job::PictureSettings;

use super::UsageError;
use super::marks::MarksArg;
use super::preset::Preset;
use super::values::{one_of, rays, size, threads};

/// What every picture has; the same words for every command.
#[derive(Args)]
#[command(next_help_heading = "Picture")]
pub struct PictureArgs {
    /// Settings; ./config.ini is read where there is one
    #[arg(short, long, value_name = "FILE")]
    config: Option<PathBuf>,
    /// Size in pixels, as in 1000x600
    #[arg(long, value_name = "WxH", value_parser = size, allow_hyphen_values = true)]
    size: Option<(u32, u32)>,
    /// How many rays pixels get: draft, normal, high or print; --aa and --ssrays are over it
    #[arg(long, value_name = "NAME", ignore_case = true)]
    quality: Option<QualityArg>,
    /// Antialiasing: none (0), a grid of rays in each pixel (1), or as many in those pixels that
    /// need it (2) [default: that of the quality]
    #[arg(long, value_name = "MODE", ignore_case = true)]
    aa: Option<AntialiasingMode>,
    /// Rays along one side of a pixel's grid, from 1 to 32 [default: that of the quality]
    #[arg(long, value_name = "N", value_parser = rays)]
    ssrays: Option<u32>,
    #[command(flatten)]
    pub threads: ThreadsArgs,
    /// The chessmen: staunton, thesis, or a folder with a set of one's own
    #[arg(long, value_name = "NAME|DIR", default_value = "staunton", value_parser = SetName::parse)]
    set: SetName,
    /// What pictures look like before any setting: camera, lights, materials
    /// [default: studio; thesis for export]
    #[arg(long, value_name = "NAME", ignore_case = true)]
    look: Option<LookArg>,
    /// What pieces, board and table are made of: wood, tournament, marble, glass, print, thesis, or
    /// a [Theme ...] of the settings [default: wood; thesis in the thesis's look]
    #[arg(long, value_name = "NAME")]
    theme: Option<String>,
    /// The camera; `mover` goes to the player who is to move, `follow` leans towards the moving piece,
    /// `free` and `path` are where the settings put it [default: that of the look]
    #[arg(long, value_name = "NAME", value_parser = one_of(&VIEWS), ignore_case = true)]
    camera: Option<View>,
    /// From whose side of the board the camera looks; black turns it by half a turn
    #[arg(long, value_name = "COLOR", value_parser = one_of(&ORIENTATIONS), ignore_case = true)]
    orientation: Option<Orientation>,
    /// From Black's side: --orientation black
    #[arg(long, conflicts_with = "orientation")]
    flip: bool,
    /// Where captured pieces stay: beside the board, gone, or beside it in films alone
    /// [default: films]
    #[arg(long, value_name = "WHERE", value_parser = one_of(&CAPTURED), ignore_case = true)]
    captured: Option<Captured>,
    /// Name files and ranks on the board's frame
    #[arg(long)]
    coordinates: bool,
    /// What is painted on the squares, with commas between: last-move, check, mate, drawn (squares and
    /// arrows), or all or none [default: all; none in the thesis's look]
    #[arg(long, value_name = "LIST", value_parser = MarksArg::parse)]
    pub marks: Option<MarksArg>,
    /// Put a clock with the game's times beside the board
    #[arg(long)]
    clock: bool,
    /// A strip of words below the scene: players, the move, the tournament, who stands better
    #[arg(long)]
    captions: bool,
    /// Wood and marble as plain colours
    #[arg(long)]
    plain: bool,
    /// No ground: pictures are transparent where there is neither board nor piece
    #[arg(long)]
    transparent: bool,
    /// Print the settings that are in force as a config.ini, and do nothing else
    #[arg(long)]
    pub print_config: bool,
}

/// How many hands work.
#[derive(Args)]
pub struct ThreadsArgs {
    /// Threads, from 1 to 1024 [default: one a core]
    #[arg(long, value_name = "N", value_parser = threads)]
    pub cpu: Option<usize>,
}

#[derive(Clone, Copy, ValueEnum)]
enum AntialiasingMode {
    #[value(alias = "0")]
    None,
    #[value(alias = "1")]
    Grid,
    #[value(alias = "2")]
    Adaptive,
}

#[derive(Clone, Copy, ValueEnum)]
enum QualityArg {
    Draft,
    Normal,
    High,
    Print,
}

#[derive(Clone, Copy, ValueEnum)]
enum LookArg {
    /// Soft light in a room, lacquered wood.
    Studio,
    /// As in the thesis of 2008: Phong's model, hard shadows.
    Thesis,
}

impl PictureArgs {
    /// [`PictureArgs::settings`], and what suits the place that a film is for in all that was not asked for otherwise.
    pub fn settings_for(
        &self,
        place: Option<Preset>,
        look: Look,
    ) -> anyhow::Result<PictureSettings> {
        let mut settings = self.settings(look)?;
        if let Some(place) = place {
            let config = &mut settings.config;
            (config.width, config.height) = self.size.unwrap_or(place.size());
            let view = self.camera.or(place.camera());
            config.camera.view = view.unwrap_or(config.camera.view);
            config.captured = self.captured.or(place.captured()).unwrap_or(config.captured);
            config.captions.show = true;
        }
        Ok(settings)
    }

    /// The settings: flags over the file, the file over the look.
    /// The look is `look` where none is named.
    pub fn settings(&self, look: Look) -> anyhow::Result<PictureSettings> {
        let look = match self.look {
            Some(LookArg::Studio) => Look::Studio,
            Some(LookArg::Thesis) => Look::Thesis,
            None => look,
        };
        let config_file = config_file(self.config.as_deref());
        let mut config = read_config(Config::new(look), config_file.as_deref())?;
        if let Some(theme) = &self.theme {
            let words: Vec<String> = theme.split_whitespace().map(str::to_lowercase).collect();
            let name = words.join(" ");
            if !config.themes.contains_key(&name) {
                let known = config.themes.keys().map(String::as_str);
                bail!(UsageError(format!("--theme: {}", unknown("theme", theme, known))));
            }
            config.theme = name;
        }
        if let Some((width, height)) = self.size {
            (config.width, config.height) = (width, height);
        }
        if let Some(quality) = self.quality {
            let quality = match quality {
                QualityArg::Draft => Quality::Draft,
                QualityArg::Normal => Quality::Normal,
                QualityArg::High => Quality::High,
                QualityArg::Print => Quality::Print,
            };
            quality.apply(&mut config.render);
        }
        if let Some(mode) = self.aa {
            config.render.sampling = match mode {
                AntialiasingMode::None => Sampling::None,
                AntialiasingMode::Grid => Sampling::Grid,
                AntialiasingMode::Adaptive => Sampling::Adaptive,
            };
        }
        config.camera.view = self.camera.unwrap_or(config.camera.view);
        config.camera.orientation = self.orientation.unwrap_or(config.camera.orientation);
        if self.flip {
            config.camera.orientation = Orientation::Black;
        }
        if config.camera.view == View::Path && config.camera.path.is_empty() {
            let message =
                "--camera: `path` needs a section [CameraPath] in the settings, and there is none";
            bail!(UsageError(message.to_owned()));
        }
        config.captured = self.captured.unwrap_or(config.captured);
        config.render.rays = self.ssrays.unwrap_or(config.render.rays);
        if self.coordinates {
            config.parts.coordinates = Some(true);
        }
        if let Some(marks) = &self.marks {
            marks.apply(&mut config.marks);
        }
        if self.clock {
            config.clock.show = ShowClock::Game;
        }
        config.captions.show |= self.captions;
        config.render.plain |= self.plain;
        if self.transparent {
            (config.parts.background, config.parts.table) = (Some(None), Some(None));
        }
        let set = self.set.clone();
        Ok(PictureSettings { config, config_file, set, threads: self.threads.cpu })
    }
}

/// More bytes than any settings need.
const LARGEST: u64 = 1 << 20;

/// The file of settings: the one that is named, or `./config.ini` where there is one.
pub fn config_file(named: Option<&Path>) -> Option<PathBuf> {
    let here = Path::new("config.ini");
    named.or_else(|| here.is_file().then_some(here)).map(Path::to_owned)
}

/// Reads a file of settings over those of `base`, if there is one.
pub fn read_config(base: Config, file: Option<&Path>) -> anyhow::Result<Config> {
    let Some(path) = file else {
        return Ok(base);
    };
    if path.is_dir() {
        bail!("{}: is a folder, expected a config.ini", path.display());
    }
    let mut bytes = Vec::new();
    File::open(path)
        .and_then(|file| file.take(LARGEST + 1).read_to_end(&mut bytes))
        .with_context(|| format!("{}: cannot be read", path.display()))?;
    if bytes.len() as u64 > LARGEST {
        bail!("{}: is longer than {LARGEST} bytes, expected a config.ini", path.display());
    }
    let folder = path.parent().unwrap_or(Path::new(""));
    base.with(&String::from_utf8_lossy(&bytes), folder).with_context(|| path.display().to_string())
}
