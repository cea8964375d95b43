//! `[Material …]`: what bodies are made of.

use std::path::{Path, PathBuf};

use glam::DVec3;
use serde::{Serialize, Serializer};

use super::keys::{Key, key};
use super::values::{COLOR, Choice, File, Integer, Number, PLACE, YES_NO};

/// How a surface answers light: the constants of Phong's model (Turek 2008, 2.3), and how much of
/// a mirror and of a window it is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Finish {
    /// Share of the texture's colour that is seen without any light, 0 to 10.
    pub ambient: f64,
    /// Share of the texture's colour that each light scatters, 0 to 10.
    pub diffuse: f64,
    /// Strength of the highlight, in the light's own colour, 0 to 10.
    pub specular: f64,
    /// Exponent of the highlight, 1 to 10,000: the higher, the smaller and sharper.
    pub shininess: f64,
    /// Share of the mirror image that is added, 0 to 1.
    pub reflectivity: f64,
    /// Share of what is seen through the surface that is added, 0 to 1; shadows lose as much.
    pub transparency: f64,
}

/// How a surface answers the studio's light: a coloured ground under a clear coat, a metal, or glass.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Coat {
    /// Refractive index of the clear coat (Fresnel's reflection), 1 (none) to 3; of glass it is that
    /// of all that is transparent instead.
    pub coat: f64,
    /// How far the mirror image is blurred, 0 (polished) to 1 (matt).
    pub roughness: f64,
    /// Whether the colour is that of the mirror, and nothing lies under it.
    pub metal: bool,
}

/// What a `[Material …]` section says.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Material {
    #[serde(flatten)]
    pub finish: Finish,
    #[serde(flatten)]
    pub coat: Coat,
    pub texture: Texture,
    /// The colour, or the first of two; of a chequer that of the squares which have their sum of
    /// column and row even.
    pub color: DVec3,
    /// The second colour of a texture with two.
    pub second_color: DVec3,
    /// World units: a chequer's square, or what one unit of noise is stretched over.
    pub size: f64,
    /// How many octaves of noise are added up, 1 to 16.
    pub octaves: u32,
    /// The direction that wood grows in.
    pub grain: Axis,
    /// The picture of a bitmap texture.
    #[serde(serialize_with = "lossy")]
    pub bitmap: PathBuf,
    pub mapping: Mapping,
    /// World units: a corner of a chequer or of a bitmap's planar copy, the middle of the foot of
    /// a cylinder, the middle of a sphere.
    pub origin: DVec3,
    /// World units: the bitmap's width in planar mapping, otherwise where its left edge points.
    pub u: DVec3,
    /// World units: the bitmap's height in planar mapping, the axis and height of a cylinder, the
    /// upper pole of a sphere.
    pub v: DVec3,
}

/// What gives a surface its colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Texture {
    Plain,
    Chequer,
    Wood,
    Timber,
    Marble,
    Bitmap,
}

/// How a bitmap is laid on a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Mapping {
    Planar,
    Cylindrical,
    Spherical,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Axis {
    X,
    Y,
    Z,
}

/// A path as text, whatever it holds.
fn lossy<S: Serializer>(path: &Path, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(&path.to_string_lossy())
}

const TEXTURES: Choice<Texture> = Choice(&[
    ("plain", Texture::Plain),
    ("chequer", Texture::Chequer),
    ("wood", Texture::Wood),
    ("timber", Texture::Timber),
    ("marble", Texture::Marble),
    ("bitmap", Texture::Bitmap),
]);

const MAPPINGS: Choice<Mapping> = Choice(&[
    ("planar", Mapping::Planar),
    ("cylindrical", Mapping::Cylindrical),
    ("spherical", Mapping::Spherical),
]);

const AXES: Choice<Axis> = Choice(&[("x", Axis::X), ("y", Axis::Y), ("z", Axis::Z)]);

pub const KEYS: [Key<Material>; 20] = [
    key!("Ambient", Material, finish.ambient: Number(0.0, 10.0)),
    key!("Diffuse", Material, finish.diffuse: Number(0.0, 10.0)),
    key!("Specular", Material, finish.specular: Number(0.0, 10.0)),
    key!("Shininess", Material, finish.shininess: Number(1.0, 10_000.0)),
    key!("Reflectivity", Material, finish.reflectivity: Number(0.0, 1.0)),
    key!("Transparency", Material, finish.transparency: Number(0.0, 1.0)),
    key!("Coat", Material, coat.coat: Number(1.0, 3.0)),
    key!("Roughness", Material, coat.roughness: Number(0.0, 1.0)),
    key!("Metal", Material, coat.metal: YES_NO),
    key!("Texture", Material, texture: TEXTURES),
    key!("Color", Material, color: COLOR)
        .only("a texture with colours", |m| m.texture != Texture::Bitmap),
    key!("Color2", Material, second_color: COLOR)
        .only("a texture of two colours", Material::has_two_colors),
    key!("Size", Material, size: Number(1e-3, 1e6))
        .only("a texture of two colours", Material::has_two_colors),
    key!("Octaves", Material, octaves: Integer(1, 16))
        .only("a texture of noise", |m| matches!(m.texture, Texture::Wood | Texture::Marble)),
    key!("Grain", Material, grain: AXES)
        .only("a texture of wood", |m| matches!(m.texture, Texture::Wood | Texture::Timber)),
    key!("Bitmap", Material, bitmap: File)
        .only("a texture from a bitmap", |m| m.texture == Texture::Bitmap),
    key!("Mapping", Material, mapping: MAPPINGS)
        .only("a texture from a bitmap", |m| m.texture == Texture::Bitmap),
    key!("Origin", Material, origin: PLACE)
        .only("a chequer or a bitmap", |m| matches!(m.texture, Texture::Chequer | Texture::Bitmap)),
    key!("U", Material, u: PLACE).only("a texture from a bitmap", |m| m.texture == Texture::Bitmap),
    key!("V", Material, v: PLACE).only("a texture from a bitmap", |m| m.texture == Texture::Bitmap),
];

impl Material {
    fn has_two_colors(&self) -> bool {
        !matches!(self.texture, Texture::Plain | Texture::Bitmap)
    }

    /// Whether anything is seen through the material.
    pub fn is_transparent(&self) -> bool {
        self.finish.transparency > 0.0
    }
}

/// What a section of a new name starts from.
impl Default for Material {
    fn default() -> Material {
        Material {
            finish: POLISHED,
            coat: Coat::default(),
            texture: Texture::Plain,
            color: DVec3::splat(0.8),
            second_color: DVec3::splat(0.2),
            size: 4.0,
            octaves: 1,
            grain: Axis::Y,
            bitmap: PathBuf::new(),
            mapping: Mapping::Planar,
            origin: DVec3::ZERO,
            u: DVec3::X,
            v: DVec3::Y,
        }
    }
}

pub(super) const POLISHED: Finish = Finish {
    ambient: 0.2,
    diffuse: 0.75,
    specular: 0.4,
    shininess: 60.0,
    reflectivity: 0.0,
    transparency: 0.0,
};

/// Lacquer.
impl Default for Coat {
    fn default() -> Coat {
        Coat { coat: 1.5, roughness: 0.1, metal: false }
    }
}
