//! What surfaces do with light.

use super::Texture;

/// A colour: red, green and blue, 0 to 1 where it is shown.
pub type Rgb = glam::DVec3;

/// The constants of Phong's model (Turek 2008, 2.3), and how much of a mirror the surface is.
#[derive(Clone, Debug)]
pub struct Material {
    /// Share of the texture's colour that is seen without any light.
    pub ambient: f64,
    /// Share of the texture's colour that each light scatters.
    pub diffuse: f64,
    /// Strength of the highlight, in the light's own colour.
    pub specular: f64,
    /// Exponent of the highlight: the higher, the smaller and sharper.
    pub shininess: f64,
    /// Share of the mirror image that is added, 0 to 1.
    pub reflectivity: f64,
    /// The colour at each point, in the body's own space.
    pub texture: Texture,
}

impl Material {
    /// A polished piece of one colour.
    pub fn polished(color: Rgb) -> Material {
        Material {
            ambient: 0.2,
            diffuse: 0.75,
            specular: 0.4,
            shininess: 60.0,
            reflectivity: 0.0,
            texture: Texture::Plain(color),
        }
    }
}
