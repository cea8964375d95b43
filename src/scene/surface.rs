//! What bodies are made of, from place to place.

use std::sync::Arc;

use glam::DVec2;

use super::{Joinery, Material, Place};

/// What a body is made of.
#[derive(Clone, Debug, PartialEq)]
pub enum Surface {
    /// One material all over.
    Uniform(Material),
    /// Squares of two materials in the plane of x and z of the body's own space.
    Chequer {
        /// (x, z) of a square's corner.
        origin: DVec2,
        /// The squares' width.
        side: f64,
        /// Where the sum of column and row is even, and where it is odd.
        materials: [Material; 2],
    },
    /// A chessboard in its frame.
    Board(Arc<Joinery>),
}

impl Surface {
    /// The material at a place in the body's own space, and the place as it sees it.
    pub fn material(&self, place: Place) -> (&Material, Place) {
        let point = place.point;
        let material = match self {
            Surface::Board(joinery) => return joinery.material(place),
            Surface::Uniform(material) => material,
            Surface::Chequer { origin, side, materials } => {
                let cell = ((DVec2::new(point.x, point.z) - origin) / side).floor();
                &materials[usize::from((cell.x + cell.y).rem_euclid(2.0) >= 1.0)]
            }
        };
        (material, place)
    }

    /// Its materials.
    pub fn materials(&self) -> &[Material] {
        match self {
            Surface::Uniform(material) => std::slice::from_ref(material),
            Surface::Chequer { materials, .. } => materials,
            Surface::Board(joinery) => &joinery.materials,
        }
    }

    /// Whether anything is seen through it.
    pub fn is_transparent(&self) -> bool {
        self.materials().iter().any(|material| material.finish.transparency > 0.0)
    }
}
