//! The yardstick: one ray at a time in f64, every object asked, nothing skipped. It is slow and
//! obviously right; tests hold the packets' pictures against it.

mod optics;
mod phong;
mod studio;
mod world;

pub use phong::Phong;
pub use studio::Studio;
