//! Matrices that carry points from one space to another.
//!
//! Angles are in degrees. Sines come from `libm`, never from the platform, so that every machine
//! builds the same matrices to the bit.

use glam::{DAffine3, DMat3, DVec3};

/// The turn about the x axis that takes y towards z.
pub fn rotation_x(degrees: f64) -> DAffine3 {
    let (sin, cos) = sin_cos(degrees);
    turn(DVec3::X, DVec3::new(0.0, cos, sin), DVec3::new(0.0, -sin, cos))
}

/// The turn about the y axis that takes x towards z: anticlockwise, seen from above a board with
/// its a-file on the left.
pub fn rotation_y(degrees: f64) -> DAffine3 {
    let (sin, cos) = sin_cos(degrees);
    turn(DVec3::new(cos, 0.0, sin), DVec3::Y, DVec3::new(-sin, 0.0, cos))
}

/// The turn about the z axis that takes x towards y.
pub fn rotation_z(degrees: f64) -> DAffine3 {
    let (sin, cos) = sin_cos(degrees);
    turn(DVec3::new(cos, sin, 0.0), DVec3::new(-sin, cos, 0.0), DVec3::Z)
}

/// The move by `by`.
pub fn translation(by: DVec3) -> DAffine3 {
    DAffine3::from_translation(by)
}

/// The stretch by `factor` in all directions, about the origin.
pub fn scale(factor: f64) -> DAffine3 {
    DAffine3::from_scale(DVec3::splat(factor))
}

/// Sine and cosine of an angle in degrees, the same on every machine.
pub fn sin_cos(degrees: f64) -> (f64, f64) {
    libm::sincos(degrees.to_radians())
}

fn turn(x: DVec3, y: DVec3, z: DVec3) -> DAffine3 {
    DAffine3::from_mat3(DMat3::from_cols(x, y, z))
}
