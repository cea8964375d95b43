//! The chessboard: a chequered slab that reflects, on a wooden base.

use std::sync::Arc;

use glam::{DAffine3, DVec2, DVec3};

use super::{Material, Object, Texture};
use crate::geometry::{Cuboid, Placed};

/// Width of a square in world units.
pub const SQUARE: f64 = 4.0;

/// The board's middle; its surface is y = 0, and a1's middle is the origin.
pub const MIDDLE: DVec3 = DVec3::new(3.5 * SQUARE, 0.0, 3.5 * SQUARE);

/// Half of the playing surface's width.
const HALF: f64 = 4.0 * SQUARE;

/// What the slab lacks at its edges, so that its sides lie within the outer squares and take
/// their colours.
const RIM: f64 = 1e-3;

/// How far the base reaches beyond the squares, and how far it lies below them.
const FRAME: f64 = 2.2;
const STEP: f64 = 0.12;
const DEPTH: f64 = 1.6;

/// The slab of squares and the base beneath.
pub fn board() -> [Object; 2] {
    let slab = Material {
        ambient: 0.2,
        diffuse: 0.7,
        specular: 0.2,
        shininess: 80.0,
        reflectivity: 0.25,
        texture: Texture::Chequer {
            origin: DVec2::splat(-SQUARE / 2.0),
            side: SQUARE,
            colors: [DVec3::new(0.42, 0.26, 0.15), DVec3::new(0.86, 0.74, 0.54)],
        },
    };
    let base = Material {
        ambient: 0.2,
        diffuse: 0.7,
        specular: 0.15,
        shininess: 30.0,
        reflectivity: 0.0,
        texture: Texture::Wood {
            colors: [DVec3::new(0.36, 0.2, 0.1), DVec3::new(0.27, 0.14, 0.07)],
            size: 14.0,
        },
    };
    [(block(HALF - RIM, -2.0 * STEP, 0.0), slab), (block(HALF + FRAME, -DEPTH, -STEP), base)].map(
        |(cuboid, material)| Object {
            body: Placed::new(Arc::new(cuboid), DAffine3::IDENTITY),
            material,
        },
    )
}

/// A flat square block round the board's middle.
fn block(half_width: f64, bottom: f64, top: f64) -> Cuboid {
    let half = DVec3::new(half_width, 0.0, half_width);
    Cuboid { min: MIDDLE - half + DVec3::Y * bottom, max: MIDDLE + half + DVec3::Y * top }
}
