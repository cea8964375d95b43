//! `config.ini` in the thesis's format, as typed and range-checked settings.
//!
//! A new key is a field of a settings type and a line in the table of its section.

mod camera;
mod camera_path;
mod captions;
mod checks;
mod ini;
mod keys;
mod look;
mod marks;
mod material;
mod model;
mod nearest;
mod quality;
mod sections;
mod shelf;
mod theme;
mod values;

pub use camera::{Camera, ORIENTATIONS, Orientation, Pose, VIEWS, View};
pub use camera_path::{KeyFrame, When};
pub use captions::{Captions, Tone};
pub use keys::unknown;
pub use look::Look;
pub use marks::Marks;
pub use material::{Axis, Coat, Finish, Mapping, Material, Texture};
pub use model::{Model, Shape};
pub use nearest::nearest;
pub use quality::Quality;
pub use theme::{Edge, Parts, Scheme};

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use glam::DVec3;
use serde::Serialize;

/// The longest side of a picture, in pixels.
pub const MAX_SIDE: u32 = 16_384;

/// The most rays along one side of a pixel.
pub const MAX_RAYS: u32 = 32;

/// World units that are farther than anything: a ray without an end.
pub const FARTHEST: f64 = 1e9;

/// A shorter vector, in world units, has no direction that can be relied on.
const SHORTEST: f64 = 1e-6;

/// What a `config.ini` says; `Default` is what the program does without one.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Config {
    /// Size of the picture in pixels, each side 1 to [`MAX_SIDE`].
    pub width: u32,
    pub height: u32,
    /// Refractive index of all transparent materials, 1 to 5.
    pub snell_index: f64,
    pub lights: Vec<Light>,
    pub room: Room,
    pub camera: Camera,
    pub render: Render,
    /// The name of the theme, in small letters; it is one of `themes`.
    pub theme: String,
    pub themes: BTreeMap<String, Parts>,
    /// What is not as the theme has it.
    pub parts: Parts,
    /// Which way pieces look.
    pub knights: Knights,
    pub captured: Captured,
    pub marks: Marks,
    pub clock: Clock,
    pub captions: Captions,
    pub models: Vec<Model>,
    /// By name, in small letters; every name that the other settings use is here.
    pub materials: BTreeMap<String, Material>,
}

/// A light without falloff: a point, or in the studio a softbox that faces the board's middle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Light {
    /// In world units: 4 a square, a1 at the origin, y up.
    pub position: DVec3,
    /// Intensity of each channel, from 0 up.
    pub color: DVec3,
    /// World units: the sides of a softbox, the first one level; 0 and 0 for a point.
    pub width: f64,
    pub height: f64,
}

/// What the studio has round the board.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Room {
    /// Light from the horizon, from 30° above it, and from straight above; linear, from 0 up.
    pub horizon: DVec3,
    pub sky: DVec3,
    pub zenith: DVec3,
    /// Share of the light that surfaces throw at each other, 0 to 1.
    pub bounce: f64,
    /// Whether lights are given as seen from White's side, and turn with the camera's side.
    pub turns: bool,
}

impl Default for Room {
    fn default() -> Room {
        Room {
            horizon: DVec3::new(0.072, 0.075, 0.079),
            sky: DVec3::new(0.24, 0.25, 0.262),
            zenith: DVec3::new(0.40, 0.41, 0.425),
            bounce: 0.3,
            turns: true,
        }
    }
}

/// How pictures are traced.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Render {
    pub shading: Shading,
    pub sampling: Sampling,
    /// Rays along one side of a pixel, 1 to [`MAX_RAYS`], where it gets more than one.
    pub rays: u32,
    /// 0 to 1. In the studio: the error of a pixel, of white, that adaptive sampling accepts; in
    /// Phong's pictures: how far neighbours may differ before it refines them.
    pub threshold: f64,
    /// How often a ray may be reflected or refracted, 0 to 50; beyond it Phong's
    /// pictures are black, and the studio sees its room.
    pub max_depth: u32,
    /// World units that a ray sees, 1 to [`FARTHEST`]; beyond it is the background.
    pub max_distance: f64,
    /// Steps of subdivision for the curves of pieces, 0 to 7.
    pub subdivisions: u32,
    pub normals: Normals,
    pub filter: Filter,
    /// Whether wood and marble are replaced by their mean colours.
    pub plain: bool,
}

/// How surfaces answer light.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Shading {
    /// Phong's sum, hard shadows, colours as they are written: the thesis's.
    Phong,
    /// Soft light, Fresnel's reflection, linear light through a tone curve.
    Studio,
}

/// Where in pixels rays go (the thesis's modes 0, 1 and 2).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Sampling {
    /// One, through the middle.
    None,
    /// A grid in every pixel.
    Grid,
    /// As many in those pixels that need it: in Phong's pictures where neighbours differ, in the
    /// studio until the error is small enough.
    Adaptive,
}

/// Whether curves are shaded as the polygons that they are made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Normals {
    /// Yes, as in the thesis.
    Flat,
    /// No, as the limit curves of subdivision.
    Smooth,
}

/// How bitmaps are read between and beyond their pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Filter {
    /// The nearest pixel, as in the thesis.
    Nearest,
    /// The four pixels round a point, by their distances.
    Bilinear,
    /// The same in copies of the picture at halved sizes (MIP levels), so that what is far away
    /// does not flicker.
    Mip,
}

/// Where knights look, and what turns with them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Knights {
    /// To the left of the picture and a little out of it; all pieces of both colours are turned so,
    /// their own +z to the viewer.
    Left,
    /// To the right and a little out of it, all pieces' own −z to the viewer.
    Right,
    /// White's to rank 8, Black's to rank 1; other pieces stand as they were made.
    Enemy,
    /// As all pieces were made: towards the h-file.
    Kingside,
}

/// Where captured pieces stay.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Captured {
    /// Beside the board in films; in other pictures they are gone.
    Films,
    /// Beside the board.
    Beside,
    /// Gone.
    Gone,
}

/// Places of captured pieces, by name.
pub const CAPTURED: [(&str, Captured); 3] =
    [("films", Captured::Films), ("beside", Captured::Beside), ("gone", Captured::Gone)];

/// The clock beside the board.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Clock {
    pub show: ShowClock,
    /// What it shows of a game without times.
    pub without_times: WithoutTimes,
    /// What the two dials show where the times are fixed, in seconds since twelve o'clock.
    pub white: u32,
    pub black: u32,
    /// The material of its case, by name.
    pub case: String,
}

/// What the clock beside the board shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum ShowClock {
    /// There is none.
    No,
    /// The times of the settings.
    Fixed,
    /// Those of the game.
    Game,
}

/// What a clock that shows the game's times shows where it has none.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum WithoutTimes {
    /// There is no clock.
    Absent,
    /// How many moves each player has made.
    Moves,
}

impl Clock {
    /// Whether pictures keep a place for it.
    pub fn has_place(&self) -> bool {
        self.show != ShowClock::No
    }

    /// The materials of its case and of its rocker.
    pub fn materials(&self) -> [&str; 2] {
        [&self.case, "brass"]
    }
}

impl Default for Config {
    fn default() -> Config {
        Config::new(Look::default())
    }
}

/// One fault of a file; a fault of the whole file stands in line 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    pub line: usize,
    pub message: String,
}

/// All faults of a file, in the order of their lines.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}", listed(faults))]
pub struct ConfigError {
    pub faults: Vec<Fault>,
}

/// So many faults are told one by one.
const TOLD: usize = 20;

fn listed(faults: &[Fault]) -> String {
    let mut lines: Vec<String> = faults
        .iter()
        .take(TOLD)
        .map(|fault| match fault.line {
            0 => fault.message.clone(),
            line => format!("line {line}: {}", fault.message),
        })
        .collect();
    if let Some(more) = faults.len().checked_sub(TOLD).filter(|more| *more > 0) {
        lines.push(format!("and {more} more"));
    }
    lines.join("\n  ")
}

impl Config {
    /// Reads the text of a `config.ini`; what it does not mention keeps the value of `self`. Files
    /// that it names are sought from `folder` on.
    ///
    /// Names of sections and keys count without their case; a `;` or `#` at the
    /// beginning of a line or behind a blank begins a comment, but not between double quotes.
    ///
    /// # Errors
    /// Every line that cannot be used: no section or key of that name, a value out of its range,
    /// something said twice, names of materials or pictures that are not there, lights and models
    /// that a count promises but no section describes.
    pub fn with(self, text: &str, folder: &Path) -> Result<Config, ConfigError> {
        let (document, mut faults) = ini::read(text);
        let config = sections::interpret(&document, self, folder, &mut faults);
        if faults.is_empty() {
            Ok(config)
        } else {
            faults.sort_by_key(|fault| fault.line);
            Err(ConfigError { faults })
        }
    }

    /// Reads the text of a `config.ini` over the default, as [`Config::with`] does.
    ///
    /// # Errors
    /// Those of [`Config::with`].
    pub fn parse(text: &str) -> Result<Config, ConfigError> {
        Config::default().with(text, Path::new(""))
    }

    /// The text of a `config.ini` that says the same, materials and all.
    pub fn to_ini(&self) -> String {
        sections::show(self)
    }

    /// Whether pictures have no background.
    pub fn is_transparent(&self) -> bool {
        self.scheme().background.is_none()
    }

    /// What all parts are made of: the theme, and what stands over it.
    pub fn scheme(&self) -> Scheme {
        self.parts_in_force().scheme()
    }

    fn parts_in_force(&self) -> Parts {
        let theme = self.themes.get(&self.theme);
        self.parts.over(theme.unwrap_or(&Parts::default()))
    }

    /// The names of the materials that are used.
    fn materials_in_use(&self) -> BTreeSet<String> {
        let parts = self.parts_in_force();
        let clock = self.clock.has_place().then(|| self.clock.materials());
        let of_parts = parts.materials().map(|(_, name)| name.as_str());
        let of_models = self.models.iter().map(|model| model.material.as_str());
        let used = of_parts.chain(clock.into_iter().flatten()).chain(of_models);
        used.map(str::to_owned).collect()
    }

    /// These settings without themes and materials that nothing is made of.
    pub fn in_use(&self) -> Config {
        let used = self.materials_in_use();
        let mut config = self.clone();
        config.themes.retain(|name, _| *name == self.theme);
        config.materials.retain(|name, _| used.contains(name));
        config
    }

    /// The pictures of the materials that are used.
    pub fn bitmaps(&self) -> BTreeSet<&PathBuf> {
        let used = self.materials_in_use();
        let materials = used.iter().filter_map(|name| self.materials.get(name));
        materials
            .filter(|material| material.texture == Texture::Bitmap)
            .map(|material| &material.bitmap)
            .collect()
    }
}
