//! What pictures are made of and no frame changes: piece sets, as data, bitmaps, and letters.

mod bitmap;
mod font;
mod set;

pub use bitmap::{Beyond, Bitmap, BitmapError};
pub use font::{BOLD, REGULAR};
pub use set::{PieceSet, SetError, SetName, piece_set};

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

use crate::config::{self, Config};
use crate::geometry::Normals;

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
    #[error(transparent)]
    Set(#[from] SetError),
    #[error(transparent)]
    Bitmap(#[from] BitmapError),
}

impl Assets {
    /// Builds the set as `config` wants its curves, and reads the pictures of the materials
    /// that it uses.
    ///
    /// # Errors
    /// A set or a picture that cannot be read.
    pub fn load(config: &Config, set: &SetName) -> Result<Assets, AssetError> {
        let bitmaps = config
            .bitmaps()
            .into_iter()
            .map(|path| Ok((path.clone(), Arc::new(Bitmap::open(path, config.render.filter)?))))
            .collect::<Result<_, BitmapError>>()?;
        Ok(Assets { set: piece_set(set, config.render.subdivisions, normals(config))?, bitmaps })
    }
}

/// How curves are to be shaded.
pub fn normals(config: &Config) -> Normals {
    match config.render.normals {
        config::Normals::Flat => Normals::Flat,
        config::Normals::Smooth => Normals::Smooth,
    }
}
