//! `[Material …]`: what bodies are made of.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use glam::DVec3;
use serde::{Serialize, Serializer};

use super::keys::{Key, key};
use super::values::{COLOR, Choice, File, Integer, Number, PLACE};

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

/// What a `[Material …]` section says.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Material {
    #[serde(flatten)]
    pub finish: Finish,
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
    ("marble", Texture::Marble),
    ("bitmap", Texture::Bitmap),
]);

const MAPPINGS: Choice<Mapping> = Choice(&[
    ("planar", Mapping::Planar),
    ("cylindrical", Mapping::Cylindrical),
    ("spherical", Mapping::Spherical),
]);

const AXES: Choice<Axis> = Choice(&[("x", Axis::X), ("y", Axis::Y), ("z", Axis::Z)]);

pub const KEYS: [Key<Material>; 17] = [
    key!("Ambient", Material, finish.ambient: Number(0.0, 10.0)),
    key!("Diffuse", Material, finish.diffuse: Number(0.0, 10.0)),
    key!("Specular", Material, finish.specular: Number(0.0, 10.0)),
    key!("Shininess", Material, finish.shininess: Number(1.0, 10_000.0)),
    key!("Reflectivity", Material, finish.reflectivity: Number(0.0, 1.0)),
    key!("Transparency", Material, finish.transparency: Number(0.0, 1.0)),
    key!("Texture", Material, texture: TEXTURES),
    key!("Color", Material, color: COLOR)
        .only("a texture with colours", |m| m.texture != Texture::Bitmap),
    key!("Color2", Material, second_color: COLOR)
        .only("a texture of two colours", Material::has_two_colors),
    key!("Size", Material, size: Number(1e-3, 1e6))
        .only("a texture of two colours", Material::has_two_colors),
    key!("Octaves", Material, octaves: Integer(1, 16))
        .only("a texture of noise", |m| matches!(m.texture, Texture::Wood | Texture::Marble)),
    key!("Grain", Material, grain: AXES).only("a texture of wood", |m| m.texture == Texture::Wood),
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
        matches!(self.texture, Texture::Chequer | Texture::Wood | Texture::Marble)
    }

    /// Whether anything is seen through the material.
    pub fn is_transparent(&self) -> bool {
        self.finish.transparency > 0.0
    }

    /// A polished material of one colour.
    fn plain(color: [f64; 3]) -> Material {
        Material { color: color.into(), ..Material::default() }
    }

    fn wood(colors: [[f64; 3]; 2], size: f64, grain: Axis) -> Material {
        Material {
            texture: Texture::Wood,
            second_color: colors[1].into(),
            size,
            grain,
            ..Material::plain(colors[0])
        }
    }

    fn marble(colors: [[f64; 3]; 2]) -> Material {
        let finish = Finish { reflectivity: 0.06, specular: 0.5, shininess: 90.0, ..POLISHED };
        Material {
            finish,
            texture: Texture::Marble,
            second_color: colors[1].into(),
            size: 3.0,
            octaves: 5,
            ..Material::plain(colors[0])
        }
    }

    fn glass(color: [f64; 3], transparency: f64) -> Material {
        let finish = Finish {
            ambient: 0.05,
            diffuse: 0.08,
            specular: 0.8,
            shininess: 200.0,
            reflectivity: 0.12,
            transparency,
        };
        Material { finish, ..Material::plain(color) }
    }
}

const POLISHED: Finish = Finish {
    ambient: 0.2,
    diffuse: 0.75,
    specular: 0.4,
    shininess: 60.0,
    reflectivity: 0.0,
    transparency: 0.0,
};

/// What a section of a new name starts from.
impl Default for Material {
    fn default() -> Material {
        Material {
            finish: POLISHED,
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

/// The materials that need no section: those of the thesis's look, then others to choose from.
pub fn built_in() -> BTreeMap<String, Material> {
    let square =
        Finish { diffuse: 0.7, specular: 0.2, shininess: 80.0, reflectivity: 0.25, ..POLISHED };
    let square = |color| Material { finish: square, ..Material::plain(color) };
    let matt = Finish { diffuse: 0.7, specular: 0.15, shininess: 30.0, ..POLISHED };
    let materials = [
        ("white", Material::plain([0.91, 0.81, 0.63])),
        ("black", Material::plain([0.24, 0.18, 0.15])),
        ("light", square([0.86, 0.74, 0.54])),
        ("dark", square([0.42, 0.26, 0.15])),
        (
            "frame",
            Material {
                finish: matt,
                ..Material::wood([[0.36, 0.2, 0.1], [0.27, 0.14, 0.07]], 14.0, Axis::Z)
            },
        ),
        ("boxwood", Material::wood([[0.91, 0.8, 0.6], [0.84, 0.7, 0.47]], 9.0, Axis::Y)),
        ("walnut", Material::wood([[0.38, 0.23, 0.14], [0.28, 0.16, 0.09]], 9.0, Axis::Y)),
        ("white-marble", Material::marble([[0.9, 0.89, 0.86], [0.5, 0.51, 0.54]])),
        ("black-marble", Material::marble([[0.1, 0.11, 0.11], [0.45, 0.46, 0.44]])),
        ("glass", Material::glass([0.8, 0.95, 0.9], 0.85)),
        ("smoked-glass", Material::glass([0.3, 0.22, 0.16], 0.45)),
    ];
    materials.map(|(name, material)| (name.to_owned(), material)).into()
}
