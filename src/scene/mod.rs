//! What a picture shows, ready to be traced: bodies with materials, lights and a camera.
//!
//! A [`Stage`] holds what stays from frame to frame (set, board, lights); with a
//! [`crate::timeline::Frame`] it makes a [`Scene`]. Here squares and pieces end: the tracer knows
//! bodies alone.

mod board;
mod camera;
mod material;
mod noise;
mod stage;
mod texture;

pub use camera::Camera;
pub use material::{Material, Rgb};
pub use stage::Stage;
pub use texture::Texture;

use crate::config::Light;
use crate::geometry::Placed;

/// A solid in its place, with what it is made of.
#[derive(Clone)]
pub struct Object {
    pub body: Placed,
    pub material: Material,
}

/// Everything that a picture depends on, but its size and sampling.
#[derive(Clone)]
pub struct Scene {
    pub objects: Vec<Object>,
    pub lights: Vec<Light>,
    pub camera: Camera,
    /// The colour of a ray that meets nothing.
    pub background: Rgb,
    /// How often a ray may be reflected; beyond it is black.
    pub max_depth: u32,
}
