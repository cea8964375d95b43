//! The chessboard: a chequered slab on a base, and the table that it may lie on.

use glam::{DVec2, DVec3};

use super::material::{MaterialError, Materials};
use super::{Material, Object, Rgb, Side, Surface, Texture};
use crate::config::Board;
use crate::geometry::{Bounds, Cuboid, Plane};

/// Width of a square in world units.
pub const SQUARE: f64 = 4.0;

/// The board's middle; its surface is y = 0, and a1's middle is the origin.
pub const MIDDLE: DVec3 = DVec3::new(3.5 * SQUARE, 0.0, 3.5 * SQUARE);

/// Half of the playing surface's width.
pub const HALF: f64 = 4.0 * SQUARE;

/// What the slab lacks at its edges, so that its sides lie within the outer squares and take
/// their colours.
const RIM: f64 = 1e-3;

/// How far the base reaches beyond the squares, and how far it lies below them.
pub const FRAME: f64 = 2.2;
const STEP: f64 = 0.12;

/// How far the table lies below the squares.
pub const DEPTH: f64 = 1.6;

/// The slab of squares, the base beneath, and the table if there is one; coordinates, where they are
/// asked for, for a viewer who has the side `near` before him.
pub fn board(
    board: &Board,
    materials: &Materials,
    near: Side,
) -> Result<Vec<Object>, MaterialError> {
    let squares = Surface::Chequer {
        origin: DVec2::splat(-SQUARE / 2.0),
        side: SQUARE,
        materials: [materials.material(&board.dark)?, materials.material(&board.light)?],
    };
    let mut frame = materials.surface(&board.frame)?;
    if board.coordinates {
        frame = lettered(frame, &squares, near);
    }
    let mut objects = vec![
        Object::standing(block(HALF - RIM, -2.0 * STEP, 0.0), squares),
        Object::standing(block(HALF + FRAME, -DEPTH, -STEP), frame),
    ];
    if let Some(table) = &board.table {
        let plane = Plane::new(DVec3::Y * -DEPTH, DVec3::Y);
        objects.push(Object::standing(plane, materials.surface(table)?));
    }
    Ok(objects)
}

/// A frame with coordinates, in the colour of those squares that stand off it more.
fn lettered(frame: Surface, squares: &Surface, near: Side) -> Surface {
    frame.map(|Material { finish, texture }| {
        let ground = texture.mean();
        let inks = squares.materials().iter().map(|square| square.texture.mean());
        let ink = inks.max_by(|a, b| a.distance(ground).total_cmp(&b.distance(ground)));
        let ink = ink.unwrap_or(Rgb::ONE);
        Material { finish, texture: Texture::Lettered { ground: Box::new(texture), ink, near } }
    })
}

/// What the board fills, without the table.
pub fn bounds() -> Bounds {
    let Cuboid { min, max } = block(HALF + FRAME, -DEPTH, 0.0);
    Bounds { min, max }
}

/// A flat square block round the board's middle.
fn block(half_width: f64, bottom: f64, top: f64) -> Cuboid {
    let half = DVec3::new(half_width, 0.0, half_width);
    Cuboid { min: MIDDLE - half + DVec3::Y * bottom, max: MIDDLE + half + DVec3::Y * top }
}
