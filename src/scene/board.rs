//! The chessboard: squares in a frame, and the table that it may lie on.

use std::sync::Arc;

use glam::{DAffine3, DVec2, DVec3};

use super::material::{Material, MaterialError, Materials};
use super::noise::hash;
use super::texture::Place;
use super::{Object, Surface};
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

/// Where in the frame the inlay begins and ends, from the squares on.
const INLAY: [f64; 2] = [0.0, 0.16];

/// The board, and the table if there is one.
///
/// # Errors
/// When `scheme` names a material that is not there.
pub fn board(scheme: &Scheme, materials: &Materials) -> Result<Vec<Object>, MaterialError> {
    let mut objects = match scheme.edge {
        Edge::Step => stepped(scheme, materials)?,
        Edge::Moulded => vec![moulded(scheme, materials)?],
    };
    if let Some(table) = &scheme.table {
        let plane = Plane::new(DVec3::Y * -DEPTH, DVec3::Y);
        objects.push(Object::standing(plane, materials.surface(table)?));
    }
    Ok(objects)
}

/// A slab of squares on a block.
fn stepped(scheme: &Scheme, materials: &Materials) -> Result<Vec<Object>, MaterialError> {
    let squares = Surface::Chequer {
        origin: DVec2::splat(-SQUARE / 2.0),
        side: SQUARE,
        materials: [materials.material(&scheme.dark)?, materials.material(&scheme.light)?],
    };
    Ok(vec![
        Object::standing(block(HALF - RIM, -2.0 * STEP, 0.0), squares),
        Object::standing(block(HALF + FRAME, -DEPTH, -STEP), materials.surface(&scheme.frame)?),
    ])
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
fn moulded(scheme: &Scheme, materials: &Materials) -> Result<Object, MaterialError> {
    let inlay = scheme.inlay.as_ref().unwrap_or(&scheme.frame);
    let joinery = Joinery {
        materials: [
            materials.material(&scheme.dark)?,
            materials.material(&scheme.light)?,
            materials.material(&scheme.frame)?,
            materials.material(inlay)?,
        ],
        has_inlay: scheme.inlay.is_some(),
    };
    let body = match section() {
        Ok(bar) => {
            let bar = Csg::leaf(bar);
            bar.clone().and(bar.placed(rotation_y(90.0))).placed(translation(MIDDLE))
        }
        // The section is a constant that makes a bar, as a test sees to.
        Err(_) => Csg::leaf(block(HALF + FRAME, -DEPTH, 0.0)),
    };
    Ok(Object::standing(body, Surface::Board(Arc::new(joinery))))
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
    /// The material at a place of the world, and the place as the piece of wood has it.
    pub fn material(&self, place: Place) -> (&Material, Place) {
        let [dark, light, frame, inlay] = &self.materials;
        let from_middle = place.point - MIDDLE;
        let (dx, dz) = (from_middle.x.abs(), from_middle.z.abs());
        let beyond = dx.max(dz) - HALF;
        let cut = |part: u64, turned: bool| {
            let turn = if turned { rotation_y(90.0) } else { DAffine3::IDENTITY };
            Place { point: turn.transform_vector3(from_middle), seed: hash(place.seed, part) }
        };
        if beyond >= 0.0 {
            // The grain of mouldings goes along them; they meet in mitres.
            let along_x = dz > dx;
            let side = if along_x { from_middle.z } else { from_middle.x };
            let part = 64 + 2 * u64::from(along_x) + u64::from(side > 0.0);
            let is_inlay = self.has_inlay && INLAY[0] <= beyond && beyond < INLAY[1];
            return (if is_inlay { inlay } else { frame }, cut(part, along_x));
        }
        let cell = ((place.point / SQUARE) + 0.5).floor();
        let (file, rank) = (cell.x as u64, cell.z as u64);
        let square = 8 * rank + file;
        let material = if (file + rank) % 2 == 0 { dark } else { light };
        (material, cut(square, (file + rank) % 2 == 0))
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
