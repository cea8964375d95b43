//! The chessboard: squares in a frame, and the table that it may lie on.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::measures::{DEPTH, FRAME, HALF, MIDDLE, SQUARE};
use super::{Joinery, Material, MaterialError, Materials, Object, Readers, Rgb, Surface, Texture};
use crate::assets::normals;
use crate::config::{Config, Edge, Scheme};
use crate::geometry::transform::{rotation_y, translation};
use crate::geometry::{
    Bounds, ControlPoint, Csg, Cuboid, CurveError, Normals, Outline, Plane, Prism,
};

/// What the slab lacks at its edges, so that its sides lie within the outer squares and take
/// their colours.
const RIM: f64 = 1e-3;

/// How far a plain base lies below the squares.
const STEP: f64 = 0.12;

/// The board, its squares first, and the table if there is one; coordinates, where they are asked for, for their
/// `readers`.
///
/// # Errors
/// When `scheme` names a material that is not there.
pub fn board(
    scheme: &Scheme,
    materials: &Materials,
    readers: Readers,
) -> Result<Vec<Object>, MaterialError> {
    let squares = [materials.material(&scheme.dark)?, materials.material(&scheme.light)?];
    let mut frame = materials.material(&scheme.frame)?;
    let inlay = scheme.inlay.as_ref().map(|name| materials.material(name)).transpose()?;
    if scheme.coordinates {
        let inks = inlay.as_ref().map_or(&squares[..], std::slice::from_ref);
        frame = lettered(frame, inks, readers);
    }
    let mut objects = match scheme.edge {
        Edge::Step => stepped(squares, frame),
        Edge::Moulded => vec![moulded(squares, frame, inlay, materials.config)],
    };
    if let Some(table) = &scheme.table {
        let plane = Plane::new(DVec3::Y * -DEPTH, DVec3::Y);
        objects.push(Object::standing(plane, materials.surface(table)?));
    }
    Ok(objects)
}

/// A slab of squares on a block.
fn stepped(squares: [Material; 2], frame: Material) -> Vec<Object> {
    let squares =
        Surface::Chequer { origin: DVec2::splat(-SQUARE / 2.0), side: SQUARE, materials: squares };
    vec![
        Object::standing(block(HALF - RIM, -2.0 * STEP, 0.0), squares),
        Object::standing(block(HALF + FRAME, -DEPTH, -STEP), Surface::Uniform(frame)),
    ]
}

/// A frame with coordinates, in the colour of what stands off it most.
fn lettered(frame: Material, inks: &[Material], readers: Readers) -> Material {
    let ground = frame.texture.mean();
    let inks = inks.iter().map(|material| material.texture.mean());
    let ink = inks.max_by(|a, b| a.distance(ground).total_cmp(&b.distance(ground)));
    let ink = ink.unwrap_or(Rgb::ONE);
    let ground = Box::new(frame.texture);
    Material { texture: Texture::Lettered { ground, ink, readers }, ..frame }
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

/// Squares and a frame of mouldings in one body: a bar with the moulding's section, crossed with
/// itself.
fn moulded(
    [dark, light]: [Material; 2],
    frame: Material,
    inlay: Option<Material>,
    config: &Config,
) -> Object {
    let has_inlay = inlay.is_some();
    let inlay = inlay.unwrap_or(frame.clone());
    // The section is a constant that makes a bar, as a test sees to.
    let bar = section(config.render.subdivisions, normals(config));
    let bar = Csg::leaf(bar.expect("the moulding makes a bar"));
    let other = bar.clone().placed(translation(DVec3::Y * APART) * rotation_y(90.0));
    let body = bar.and(other).placed(translation(MIDDLE));
    let joinery = Joinery::new([dark, light, frame, inlay], has_inlay);
    // A hair within, where nothing is rounded.
    let level = HALF + FRAME - ROUND - 1e-3;
    let roof = [-level, level].map(|half| DVec2::new(MIDDLE.x + half, MIDDLE.z + half));
    Object { roof: Some(roof), ..Object::standing(body, Surface::Board(Arc::new(joinery))) }
}

/// How much higher one of the bars lies: their tops must not be the same plane, where other renderers
/// cannot choose between them.
const APART: f64 = 1e-3;

/// How far inwards the moulding reaches: from there on the top is level.
const ROUND: f64 = 0.66;

/// The moulding from the bottom of the board to its top: distance from the outer edge, height, and
/// whether it is a corner.
const MOULDING: [(f64, f64, bool); 8] = [
    (0.0, -DEPTH, true),
    (0.0, -1.28, true),
    (0.1, -1.2, true),
    (0.12, -0.98, false),
    (0.3, -0.42, false),
    (0.36, -0.2, true),
    (0.46, -0.04, false),
    (ROUND, 0.0, true),
];

fn section(subdivisions: u32, normals: Normals) -> Result<Prism, CurveError> {
    let half = HALF + FRAME;
    let right = MOULDING
        .map(|(inwards, y, corner)| ControlPoint { at: DVec2::new(half - inwards, y), corner });
    let left = right.map(|point| ControlPoint { at: point.at * DVec2::new(-1.0, 1.0), ..point });
    let outline = Outline::new(right.into_iter().chain(left.into_iter().rev()).collect())?;
    // Its ends lie beyond the other bar's sides.
    Prism::new(&outline, subdivisions, normals, -half - 1.0, half + 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_moulding_makes_a_bar() {
        for subdivisions in 0..=7 {
            assert!(section(subdivisions, Normals::Smooth).is_ok());
        }
    }
}
