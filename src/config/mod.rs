//! `config.ini` in the thesis's format, as typed and range-checked settings.

mod ini;
mod keys;
mod nearest;

pub use keys::MAX_SIDE;
use nearest::nearest;

use glam::DVec3;
use serde::Serialize;

/// What a `config.ini` says; `Default` is what the program does without one.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Config {
    /// Size of the picture in pixels, each side 1 to [`MAX_SIDE`].
    pub width: u32,
    pub height: u32,
    /// What a ray sees that meets nothing; each channel 0 to 1, as it is written to the picture.
    pub background: DVec3,
    /// Refractive index of all transparent materials.
    pub snell_index: f64,
    pub lights: Vec<Light>,
    pub camera: Camera,
}

/// A point light without falloff.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Light {
    /// In world units: 4 a square, a1 at the origin, y up.
    pub position: DVec3,
    /// Intensity of each channel, from 0 up.
    pub color: DVec3,
}

/// Where the camera stands and what it looks at.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Camera {
    /// In world units.
    pub position: DVec3,
    /// In world units; another point than `position`.
    pub look_at: DVec3,
    /// In degrees, **twice** the true angle from the left edge of the picture to the right: the
    /// thesis halves it twice, and its files mean it so.
    pub fov: f64,
    /// Roll about the view axis in degrees; positive turns a ray from x towards y in camera
    /// space, so the picture turns clockwise.
    pub z_rot: f64,
}

impl Default for Config {
    fn default() -> Config {
        Config {
            width: 1000,
            height: 600,
            background: DVec3::ZERO,
            snell_index: 1.0,
            lights: vec![
                Light { position: DVec3::new(0.0, 150.0, -50.0), color: DVec3::splat(0.8) },
                Light { position: DVec3::new(90.0, 90.0, 20.0), color: DVec3::splat(0.5) },
            ],
            camera: Camera {
                position: DVec3::new(45.0, 15.0, -30.0),
                look_at: DVec3::new(14.0, 0.0, 14.0),
                fov: 90.0,
                z_rot: 0.0,
            },
        }
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

fn listed(faults: &[Fault]) -> String {
    let lines: Vec<String> = faults
        .iter()
        .map(|fault| match fault.line {
            0 => fault.message.clone(),
            line => format!("line {line}: {}", fault.message),
        })
        .collect();
    lines.join("\n  ")
}

impl Config {
    /// Reads the text of a `config.ini`; what it does not mention keeps its default.
    ///
    /// Names of sections and keys count without their case; a `;` or `#` at the
    /// beginning of a line or behind a blank begins a comment.
    ///
    /// # Errors
    /// Every line that cannot be used: no section or key of that name, a value out of its range,
    /// something said twice, and lights that `LightCount` promises but no section describes.
    pub fn parse(text: &str) -> Result<Config, ConfigError> {
        let (document, mut faults) = ini::read(text);
        let config = keys::interpret(&document, &mut faults);
        if faults.is_empty() {
            Ok(config)
        } else {
            faults.sort_by_key(|fault| fault.line);
            Err(ConfigError { faults })
        }
    }
}
