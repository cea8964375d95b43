//! What pictures are made of and no frame changes: piece sets, built in as data, and bitmaps.

mod bitmap;
mod thesis;

pub use bitmap::{Beyond, Bitmap, BitmapError};
pub use thesis::thesis_set;

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

use serde::Serialize;

use crate::config::{self, Config};
use crate::geometry::{Csg, CurveError, Normals};

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

/// Which set of chessmen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum SetName {
    /// The thesis's: plain turnings, a cross, a knight cut out of a box.
    #[default]
    Thesis,
}

/// All that a scene takes from elsewhere.
#[derive(Clone)]
pub struct Assets {
    pub set: PieceSet,
    /// The pictures of materials, by the paths in their settings.
    pub bitmaps: BTreeMap<PathBuf, Arc<Bitmap>>,
}

/// Why assets cannot be had.
#[derive(Debug, thiserror::Error)]
pub enum AssetError {
    #[error("the piece set cannot be built")]
    Set(#[from] CurveError),
    #[error(transparent)]
    Bitmap(#[from] BitmapError),
}

impl Assets {
    /// Builds the set as `config` wants its curves, and reads the pictures of the materials
    /// that it uses.
    ///
    /// # Errors
    /// A picture that cannot be read.
    pub fn load(config: &Config, set: SetName) -> Result<Assets, AssetError> {
        let SetName::Thesis = set;
        let normals = match config.render.normals {
            config::Normals::Flat => Normals::Flat,
            config::Normals::Smooth => Normals::Smooth,
        };
        let bitmaps = config
            .bitmaps()
            .into_iter()
            .map(|path| Ok((path.clone(), Arc::new(Bitmap::open(path, config.render.filter)?))))
            .collect::<Result<_, BitmapError>>()?;
        Ok(Assets { set: thesis_set(config.render.subdivisions, normals)?, bitmaps })
    }
}
