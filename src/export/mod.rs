//! A scene as another renderer's text.

mod pov;

pub use pov::{PovScene, pov};
