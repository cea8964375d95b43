//! What surfaces do with light.

use glam::DVec3;

use super::Texture;
use crate::config::{Coat, Finish};

/// A colour: red, green and blue, 0 to 1 where it is shown.
pub type Rgb = DVec3;

/// How a surface answers light, and the colour at each point in the body's own space.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// What counts in Phong's sum; its transparency counts everywhere.
    pub finish: Finish,
    /// What counts in the studio.
    pub coat: Coat,
    pub texture: Texture,
}
