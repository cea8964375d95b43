//! The board's measures in world units.

use glam::DVec3;

/// Width of a square in world units.
pub const SQUARE: f64 = 4.0;

/// The board's middle; its surface is y = 0, and a1's middle is the origin.
pub const MIDDLE: DVec3 = DVec3::new(3.5 * SQUARE, 0.0, 3.5 * SQUARE);

/// Half of the playing surface's width.
pub const HALF: f64 = 4.0 * SQUARE;

/// How far the frame reaches beyond the squares.
pub const FRAME: f64 = 2.2;

/// How far the table lies below the squares.
pub const DEPTH: f64 = 1.6;
