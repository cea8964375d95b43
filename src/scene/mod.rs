//! What a picture shows, ready to be traced: bodies with materials, lights and a camera.
//!
//! A [`Stage`] holds what stays from frame to frame (set, board, clock, lights); with a
//! [`crate::timeline::Frame`] it makes a [`Scene`]. Here squares and pieces end: the tracer knows
//! bodies alone.

mod board;
mod camera;
mod clock;
mod mapping;
mod material;
mod models;
mod noise;
mod stage;
mod texture;

pub use camera::Camera;
pub use mapping::Mapping;
pub use material::{Material, MaterialError, Rgb, Surface};
pub use stage::Stage;
pub use texture::{Noise, Texture};

use crate::config::Light;
use crate::geometry::Placed;

/// A solid in its place, with what it is made of.
#[derive(Clone)]
pub struct Object {
    pub body: Placed,
    pub surface: Surface,
}

/// Everything that a picture depends on, but its size and sampling.
#[derive(Clone)]
pub struct Scene {
    pub objects: Vec<Object>,
    pub lights: Vec<Light>,
    pub camera: Camera,
    /// The colour of a ray that meets nothing.
    pub background: Rgb,
    /// How often a ray may be reflected or refracted; beyond it is black.
    pub max_depth: u32,
    /// The least share of a pixel's colour, 0 to 1, that a ray is followed for.
    pub min_weight: f64,
    /// How far a ray sees; beyond it is the background.
    pub max_distance: f64,
    /// Refractive index of all that is transparent.
    pub snell_index: f64,
}
