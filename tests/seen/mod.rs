//! Where cameras see things.

use glam::DVec3;
use lightsquare::scene::{Camera, Projection};

/// How far `point` is from the middle of a picture of the shape `aspect`, 1 at its edges.
pub fn beyond(camera: &Camera, point: DVec3, aspect: f64) -> f64 {
    let [right, up, forward] = camera.axes();
    let to = point - camera.position();
    let depth = match camera.projection() {
        Projection::Perspective => to.dot(forward),
        Projection::Parallel => 1.0,
    };
    let half = camera.width() / 2.0 * depth;
    (to.dot(right) / half).abs().max((to.dot(up) / half * aspect).abs())
}
