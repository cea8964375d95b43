//! The room that pieces and board take, measured on their solids.

use std::f64::consts::TAU;

use glam::DVec3;

use super::measures::{DEPTH, FRAME, HALF, SQUARE};
use crate::assets::PieceSet;
use crate::geometry::{Bounds, Csg, Interval, Ray, Solid};
use crate::timeline::{Bodies, Envelope, SLICE};

/// Rays towards the axis: so many heights a slice, and so many directions.
const HEIGHTS: u32 = 3;
const DIRECTIONS: u32 = 48;

/// What is added for what lies between the rays, in squares.
const MARGIN: f64 = 0.012;

/// The room that the pieces of `set` take, and the board.
pub fn bodies(set: &PieceSet) -> Bodies {
    Bodies {
        envelopes: set.men().map(envelope),
        edge: (HALF + FRAME) / SQUARE,
        table: -DEPTH / SQUARE,
    }
}

/// What `piece` fills when it is turned about its axis.
fn envelope(piece: &Csg) -> Envelope {
    let Bounds { min, max } = piece.bounds();
    let outside = [min.x, min.z, max.x, max.z].map(f64::abs).into_iter().fold(1.0, f64::max) * 2.0;
    let slices = (max.y / (SLICE * SQUARE)).ceil().max(1.0) as u32;
    let radius = |slice: u32| {
        let rays = (0..HEIGHTS * DIRECTIONS).map(|index| {
            let step = f64::from(index / DIRECTIONS) / f64::from(HEIGHTS - 1);
            let height = (f64::from(slice) + step.clamp(0.01, 0.99)) * SLICE * SQUARE;
            let (sin, cos) =
                libm::sincos(TAU * (f64::from(index % DIRECTIONS) + 0.5) / f64::from(DIRECTIONS));
            let direction = DVec3::new(-cos, 0.0, -sin);
            let origin = DVec3::Y * height - direction * outside;
            let hit = piece.nearest(&Ray { origin, direction }, Interval::up_to(outside));
            hit.map_or(0.0, |hit| outside - hit.t)
        });
        rays.fold(0.0, f64::max) / SQUARE
    };
    let radii: Vec<f64> = (0..slices).map(radius).collect();
    // The bounds may be larger than the solid.
    let top = radii.iter().rposition(|radius| *radius > 0.0).map_or(1, |top| top + 1);
    Envelope::new(radii[..top].iter().map(|radius| radius + MARGIN).collect())
}
