//! From a frame of the game to the bodies of a scene.

use std::sync::Arc;

use glam::DVec3;

use super::board::{MIDDLE, SQUARE, board};
use super::{Camera, Material, Object, Rgb, Scene};
use crate::assets::PieceSet;
use crate::config::{Config, Light};
use crate::geometry::transform::translation;
use crate::geometry::{Csg, Placed};
use crate::notation::{Color, Piece, Role};
use crate::timeline::{Frame, Spot};

/// Deeper mirrors than anyone sees.
const MAX_DEPTH: u32 = 5;

const WHITE_WOOD: Rgb = DVec3::new(0.91, 0.81, 0.63);
const BLACK_WOOD: Rgb = DVec3::new(0.24, 0.18, 0.15);

/// What stays the same from frame to frame: the set, the board, lights, camera and background.
pub struct Stage {
    pieces: [Arc<Csg>; 6],
    board: [Object; 2],
    lights: Vec<Light>,
    camera: Camera,
    background: Rgb,
}

impl Stage {
    /// Sets the stage as `config` says, with the pieces of `set`.
    pub fn new(config: &Config, set: PieceSet) -> Stage {
        Stage {
            pieces: [set.pawn, set.knight, set.bishop, set.rook, set.queen, set.king].map(Arc::new),
            board: board(),
            lights: config.lights.clone(),
            camera: Camera::new(&config.camera),
            background: config.background,
        }
    }

    /// What `frame` shows.
    pub fn scene(&self, frame: &Frame) -> Scene {
        let standing =
            frame.placement.iter().map(|(square, piece)| self.object(piece, Spot::on(square)));
        let moving = frame.movers.iter().map(|mover| self.object(mover.piece, mover.spot));
        Scene {
            objects: self.board.iter().cloned().chain(standing).chain(moving).collect(),
            lights: self.lights.clone(),
            camera: self.camera.orbited(MIDDLE, frame.orbit),
            background: self.background,
            max_depth: MAX_DEPTH,
        }
    }

    fn object(&self, piece: Piece, spot: Spot) -> Object {
        let solid = match piece.role {
            Role::Pawn => 0,
            Role::Knight => 1,
            Role::Bishop => 2,
            Role::Rook => 3,
            Role::Queen => 4,
            Role::King => 5,
        };
        let place = DVec3::new(spot.file, spot.height, spot.rank) * SQUARE;
        Object {
            body: Placed::new(self.pieces[solid].clone(), translation(place)),
            material: Material::polished(match piece.color {
                Color::White => WHITE_WOOD,
                Color::Black => BLACK_WOOD,
            }),
        }
    }
}
