//! The materials that need no section.
//!
//! The thesis's look keeps the thesis's wood; the studio's woods are cut from trees.

use std::collections::BTreeMap;

use glam::DVec3;

use super::material::POLISHED;
use super::{Axis, Coat, Finish, Look, Material, Texture};

const SATIN: Coat = Coat { coat: 1.4, roughness: 0.3, metal: false };
const MATT: Coat = Coat { coat: 1.0, roughness: 1.0, metal: false };
const STONE: Coat = Coat { coat: 1.5, roughness: 0.05, metal: false };
const CLEAR: Coat = Coat { coat: 1.5, roughness: 0.0, metal: false };
const METAL: Coat = Coat { coat: 1.5, roughness: 0.15, metal: true };

const DULL: Finish = Finish { diffuse: 0.7, specular: 0.15, shininess: 30.0, ..POLISHED };

/// The materials that `look` begins with, by name.
pub fn materials(look: Look) -> BTreeMap<String, Material> {
    let kinds = match look {
        Look::Thesis => [
            wood([[0.36, 0.2, 0.1], [0.27, 0.14, 0.07]], 14.0, Axis::Z),
            wood([[0.91, 0.8, 0.6], [0.84, 0.7, 0.47]], 9.0, Axis::Y),
            wood([[0.38, 0.23, 0.14], [0.28, 0.16, 0.09]], 9.0, Axis::Y),
            marble([[0.9, 0.89, 0.86], [0.5, 0.51, 0.54]]),
            marble([[0.1, 0.11, 0.11], [0.45, 0.46, 0.44]]),
        ],
        Look::Studio => [
            satin(timber([0x4d3221, 0x2f1c10], 0.22, Axis::Z)),
            timber([0xead2a4, 0xd2af70], 0.12, Axis::Y),
            satin(timber([0x8a5d3d, 0x57361f], 0.21, Axis::Z)),
            marble([[0.93, 0.92, 0.89], [0.72, 0.72, 0.73]]),
            marble([[0.14, 0.15, 0.155], [0.3, 0.31, 0.31]]),
        ],
    };
    let [frame, boxwood, walnut, white_marble, black_marble] = kinds;
    let materials = [
        ("white", plain(rgb([0.91, 0.81, 0.63]))),
        ("black", plain(rgb([0.24, 0.18, 0.15]))),
        ("light", square([0.86, 0.74, 0.54])),
        ("dark", square([0.42, 0.26, 0.15])),
        ("frame", Material { finish: DULL, ..frame }),
        ("boxwood", boxwood),
        ("walnut", walnut),
        ("maple", satin(timber([0xc6a87d, 0xa6834f], 0.24, Axis::Z))),
        ("oak", satin(timber([0xa98257, 0x8a6238], 0.45, Axis::Z))),
        ("ebony", timber([0x2b201b, 0x1c1410], 0.14, Axis::Y)),
        ("rosewood", timber([0x6b3020, 0x401a10], 0.16, Axis::Y)),
        ("white-marble", white_marble),
        ("black-marble", black_marble),
        ("glass", glass([0.8, 0.95, 0.9], 0.85)),
        ("smoked-glass", glass([0.3, 0.22, 0.16], 0.45)),
        ("brass", Material { coat: METAL, ..plain(hex(0xd9b265)) }),
        ("ivory", plain(hex(0xefe6cf))),
        ("green", satin(plain(hex(0x4f7a5a)))),
        ("buff", satin(plain(hex(0xdcd3b2)))),
        ("paper", matt(0xffffff)),
        ("ink", matt(0x36363a)),
        ("chalk", matt(0xf7f5f0)),
        ("pale-grey", matt(0xe9e9e6)),
        ("mid-grey", matt(0x9c9fa3)),
        ("slate", matt(0x59585a)),
        ("graphite", matt(0x3a3b40)),
        ("frosted-glass", satin(plain(hex(0xc4c8cb)))),
        ("slate-glass", satin(plain(hex(0x6f757b)))),
        ("jet", plain(hex(0x2a2a2c))),
        ("honed-white-marble", honed([[0.9, 0.89, 0.86], [0.66, 0.66, 0.68]])),
        ("honed-black-marble", honed([[0.25, 0.26, 0.26], [0.42, 0.43, 0.42]])),
        ("serpentine", honed([[0.16, 0.2, 0.18], [0.26, 0.31, 0.28]])),
    ];
    materials.map(|(name, material)| (name.to_owned(), material)).into()
}

fn rgb(color: [f64; 3]) -> DVec3 {
    color.into()
}

/// A colour as pages of the web write it.
fn hex(color: u32) -> DVec3 {
    let [_, red, green, blue] = color.to_be_bytes();
    DVec3::new(red.into(), green.into(), blue.into()) / 255.0
}

/// A polished material of one colour.
fn plain(color: DVec3) -> Material {
    Material { color, ..Material::default() }
}

fn matt(color: u32) -> Material {
    Material { finish: DULL, coat: MATT, ..plain(hex(color)) }
}

/// The same, duller: for what pieces stand on.
fn satin(material: Material) -> Material {
    Material { coat: SATIN, ..material }
}

fn square(color: [f64; 3]) -> Material {
    let finish =
        Finish { diffuse: 0.7, specular: 0.2, shininess: 80.0, reflectivity: 0.25, ..POLISHED };
    Material { finish, ..satin(plain(rgb(color))) }
}

fn wood(colors: [[f64; 3]; 2], size: f64, grain: Axis) -> Material {
    let second_color = rgb(colors[1]);
    Material { texture: Texture::Wood, second_color, size, grain, ..plain(rgb(colors[0])) }
}

fn timber(colors: [u32; 2], size: f64, grain: Axis) -> Material {
    let second_color = hex(colors[1]);
    Material { texture: Texture::Timber, second_color, size, grain, ..plain(hex(colors[0])) }
}

fn marble(colors: [[f64; 3]; 2]) -> Material {
    let finish = Finish { reflectivity: 0.06, specular: 0.5, shininess: 90.0, ..POLISHED };
    Material {
        finish,
        coat: STONE,
        texture: Texture::Marble,
        second_color: rgb(colors[1]),
        size: 3.0,
        octaves: 5,
        ..plain(rgb(colors[0]))
    }
}

/// Marble for boards: dull, with fainter and wider veins.
fn honed(colors: [[f64; 3]; 2]) -> Material {
    Material { coat: SATIN, size: 4.5, octaves: 4, ..marble(colors) }
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
    Material { finish, coat: CLEAR, ..plain(rgb(color)) }
}
