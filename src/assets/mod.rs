//! What pictures are made of and no frame changes: piece sets, built in as data.

mod thesis;

pub use thesis::thesis_set;

use crate::geometry::Csg;

/// A set of chessmen, each standing on the origin, y up, in world units (4 a square).
#[derive(Clone)]
pub struct PieceSet {
    pub pawn: Csg,
    pub knight: Csg,
    pub bishop: Csg,
    pub rook: Csg,
    pub queen: Csg,
    pub king: Csg,
}
