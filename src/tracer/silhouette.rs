//! Where in a picture there may be anything at all.

use glam::DVec3;

use super::plane::Spot;
use crate::geometry::{Bounds, Solid};
use crate::scene::{Camera, Projection, Scene};

/// Tiles of a picture, and which of them may show a body.
pub struct Silhouette {
    columns: usize,
    /// By tile, row by row.
    may_show: Vec<bool>,
}

/// A tile's width and height in pixels.
const TILE: u32 = 8;

impl Silhouette {
    /// Of `scene` in a picture of `size`: all that lies within the projected box of any body.
    pub fn new(scene: &Scene, size: [u32; 2]) -> Silhouette {
        let [columns, rows] = size.map(|side| side.div_ceil(TILE) as usize);
        let mut silhouette = Silhouette { columns, may_show: vec![false; columns * rows] };
        for object in &scene.objects {
            let seen = extent(&scene.camera, object.body.bounds(), size);
            let Some([left, top, right, bottom]) = seen else {
                silhouette.may_show.fill(true);
                break;
            };
            let tiles = |low: f64, high: f64, count: usize| {
                // A hair more, for rounding.
                let [low, high] = [low - 0.1, high + 0.1].map(|at| at / f64::from(TILE));
                let index = |at: f64| at.floor().clamp(0.0, count as f64) as usize;
                index(low)..index(high + 1.0)
            };
            for row in tiles(top, bottom, rows) {
                let tiles = tiles(left, right, columns);
                silhouette.may_show[row * columns..][tiles].fill(true);
            }
        }
        silhouette
    }

    /// Of something that may be anywhere.
    pub fn everywhere([width, height]: [u32; 2]) -> Silhouette {
        let [columns, rows] = [width, height].map(|side| side.div_ceil(TILE) as usize);
        Silhouette { columns, may_show: vec![true; columns * rows] }
    }

    /// How many pixels of a picture of `size` show nothing.
    pub fn empty(&self, [width, height]: [u32; 2]) -> u64 {
        let row = |y: u32| (0..width).filter(|x| !self.may_show([*x, y])).count() as u64;
        (0..height).map(row).sum()
    }

    /// Whether a pixel may show a body.
    pub fn may_show(&self, [x, y]: Spot) -> bool {
        self.may_show[(y / TILE) as usize * self.columns + (x / TILE) as usize]
    }
}

/// The left, upper, right and lower end of what `bounds` fill of a picture of `size`, in pixels; `None` where
/// that is not known.
fn extent(camera: &Camera, bounds: Bounds, [width, height]: [u32; 2]) -> Option<[f64; 4]> {
    if !bounds.is_finite() || camera.has_lens() {
        return None;
    }
    let pixel = camera.width() / f64::from(width);
    let [right, up, forward] = camera.axes();
    let place = |corner: DVec3| {
        let from_camera = corner - camera.position();
        let depth = match camera.projection() {
            Projection::Perspective => from_camera.dot(forward),
            Projection::Parallel => 1.0,
        };
        let scale = pixel * depth;
        (depth > 1e-3).then(|| {
            [
                f64::from(width) / 2.0 + from_camera.dot(right) / scale,
                f64::from(height) / 2.0 - from_camera.dot(up) / scale,
            ]
        })
    };
    let mut extent = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
    for corner in bounds.corners() {
        let [x, y] = place(corner)?;
        extent = [extent[0].min(x), extent[1].min(y), extent[2].max(x), extent[3].max(y)];
    }
    Some(extent)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::Pose;

    /// What a ray through a pixel meets lies within the tiles that are marked.
    #[test]
    fn nothing_is_seen_outside() {
        let bounds = Bounds { min: DVec3::new(-1.0, 0.0, 3.0), max: DVec3::new(2.0, 5.0, 4.0) };
        let pose = Pose { position: DVec3::new(10.0, 9.0, -20.0), ..Pose::default() };
        let pose = Pose { look_at: DVec3::new(0.0, 2.0, 0.0), z_rot: 20.0, ..pose };
        let camera = Camera::free(&pose);
        let [left, top, right, bottom] = extent(&camera, bounds, [200, 100]).unwrap();
        let mut seen = 0;
        for (x, y) in (0..200).flat_map(|x| (0..100).map(move |y| (x, y))) {
            let (x, y) = (f64::from(x) + 0.5, f64::from(y) + 0.5);
            let ray = camera.ray(x, y, 200, 100);
            if bounds.clip(&ray, crate::geometry::Interval::AHEAD).is_some() {
                assert!(x >= left && x <= right && y >= top && y <= bottom, "{x}, {y}");
                seen += 1;
            }
        }
        assert!(seen > 100, "{seen}");
        assert_eq!(extent(&camera, Bounds::EVERYTHING, [200, 100]), None);
    }
}
