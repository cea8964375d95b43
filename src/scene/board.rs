//! The chessboard: squares in a frame, and the table that it may lie on.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::material::{Material, MaterialError, Materials};
use super::noise::hash;
use super::texture::Place;
use super::{Object, Rgb, Side, Surface, Texture};
use crate::config::{Edge, Scheme};
use crate::geometry::transform::{rotation_y, translation};
use crate::geometry::{
    Bounds, ControlPoint, Csg, Cuboid, CurveError, Normals, Outline, Plane, Prism,
};

/// Width of a square in world units.
pub const SQUARE: f64 = 4.0;

/// The board's middle; its surface is y = 0, and a1's middle is the origin.
pub const MIDDLE: DVec3 = DVec3::new(3.5 * SQUARE, 0.0, 3.5 * SQUARE);

/// Half of the playing surface's width.
pub const HALF: f64 = 4.0 * SQUARE;

/// What the slab lacks at its edges, so that its sides lie within the outer squares and take
/// their colours.
const RIM: f64 = 1e-3;

/// How far the frame reaches beyond the squares.
pub const FRAME: f64 = 2.2;

/// How far a plain base lies below the squares.
const STEP: f64 = 0.12;

/// How far the table lies below the squares.
pub const DEPTH: f64 = 1.6;

/// How wide the inlay between squares and frame is.
const INLAY: f64 = 0.16;

/// The board, and the table if there is one; coordinates, where they are asked for, for a viewer who
/// has the side `near` before him.
///
/// # Errors
/// When `scheme` names a material that is not there.
pub fn board(
    scheme: &Scheme,
    materials: &Materials,
    near: Side,
) -> Result<Vec<Object>, MaterialError> {
    let squares = [materials.material(&scheme.dark)?, materials.material(&scheme.light)?];
    let mut frame = materials.material(&scheme.frame)?;
    let inlay = scheme.inlay.as_ref().map(|name| materials.material(name)).transpose()?;
    if scheme.coordinates {
        let inks = inlay.as_ref().map_or(&squares[..], std::slice::from_ref);
        frame = lettered(frame, inks, near);
    }
    let mut objects = match scheme.edge {
        Edge::Step => stepped(squares, frame),
        Edge::Moulded => vec![moulded(squares, frame, inlay)],
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
fn lettered(frame: Material, inks: &[Material], near: Side) -> Material {
    let ground = frame.texture.mean();
    let inks = inks.iter().map(|material| material.texture.mean());
    let ink = inks.max_by(|a, b| a.distance(ground).total_cmp(&b.distance(ground)));
    let ink = ink.unwrap_or(Rgb::ONE);
    Material { texture: Texture::Lettered { ground: Box::new(frame.texture), ink, near }, ..frame }
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
fn moulded([dark, light]: [Material; 2], frame: Material, inlay: Option<Material>) -> Object {
    let has_inlay = inlay.is_some();
    let inlay = inlay.unwrap_or(frame.clone());
    let body = match section() {
        Ok(bar) => {
            let bar = Csg::leaf(bar);
            bar.clone().and(bar.placed(rotation_y(90.0))).placed(translation(MIDDLE))
        }
        // The section is a constant that makes a bar, as a test sees to.
        Err(_) => Csg::leaf(block(HALF + FRAME, -DEPTH, 0.0)),
    };
    let joinery = Joinery { materials: [dark, light, frame, inlay], has_inlay };
    Object::standing(body, Surface::Board(Arc::new(joinery)))
}

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
    (0.66, 0.0, true),
];

fn section() -> Result<Prism, CurveError> {
    let half = HALF + FRAME;
    let right = MOULDING
        .map(|(inwards, y, corner)| ControlPoint { at: DVec2::new(half - inwards, y), corner });
    let left = right.map(|point| ControlPoint { at: point.at * DVec2::new(-1.0, 1.0), ..point });
    let outline = Outline::new(right.into_iter().chain(left.into_iter().rev()).collect())?;
    Prism::new(&outline, 4, Normals::Smooth, -half, half)
}

/// What the parts of a moulded board are made of: each square and each side of the frame from a
/// piece of its own.
#[derive(Clone, Debug)]
pub struct Joinery {
    /// Dark squares, light squares, frame, inlay.
    pub materials: [Material; 4],
    has_inlay: bool,
}

impl Joinery {
    /// How wide the line between squares and frame is, 0 where there is none.
    pub fn inlay_width(&self) -> f64 {
        if self.has_inlay { INLAY } else { 0.0 }
    }

    /// The material at a place of the world, and the place as the piece of wood has it.
    pub fn material(&self, place: Place) -> (&Material, Place) {
        let [dark, light, frame, inlay] = &self.materials;
        let cut = |part: u64, middle: DVec3, turned: bool| {
            let DVec3 { x, y, z } = place.point - middle;
            let point = if turned { DVec3::new(-z, y, x) } else { DVec3::new(x, y, z) };
            Place { point, seed: hash(place.seed, part), ..place }
        };
        let from_middle = place.point - MIDDLE;
        let (dx, dz) = (from_middle.x.abs(), from_middle.z.abs());
        let beyond = dx.max(dz) - HALF;
        if beyond >= 0.0 {
            // The grain of mouldings goes along them; they meet in mitres.
            let along_x = dz > dx;
            let side = if along_x { from_middle.z } else { from_middle.x };
            let part = 64 + 2 * u64::from(along_x) + u64::from(side > 0.0);
            let axis = if along_x { DVec3::Z } else { DVec3::X };
            let middle = MIDDLE + axis * (HALF + FRAME / 2.0) * side.signum();
            return (
                if beyond < self.inlay_width() { inlay } else { frame },
                cut(part, middle, along_x),
            );
        }
        let cell = (place.point / SQUARE + 0.5).floor();
        let (file, rank) = (cell.x as u64, cell.z as u64);
        let is_dark = (file + rank) % 2 == 0;
        let middle = DVec3::new(cell.x, 0.0, cell.z) * SQUARE;
        // The dark squares' grain goes across the light squares'.
        (if is_dark { dark } else { light }, cut(8 * rank + file, middle, is_dark))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_moulding_makes_a_bar() {
        assert!(section().is_ok());
    }
}
