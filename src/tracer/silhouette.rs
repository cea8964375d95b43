//! Where in a picture there may be anything at all.

use glam::DVec3;

use super::mask::{Mask, TILE};
use crate::geometry::{Bounds, Solid};
use crate::scene::{Camera, Object, Projection};

/// The pixels of a picture of `size` in which some of `objects` may be seen: all tiles that the projected box of
/// any of them meets.
pub fn silhouette<'a>(
    camera: &Camera,
    objects: impl IntoIterator<Item = &'a Object>,
    size: [u32; 2],
) -> Mask {
    let mut mask = Mask::empty(size);
    for object in objects {
        let Some([left, top, right, bottom]) = extent(camera, object.body.bounds(), size) else {
            return Mask::full(size);
        };
        let tiles = |low: f64, high: f64, length: u32| {
            // A hair more, for rounding.
            let [low, high] = [low - 0.1, high + 0.1].map(|at| at / f64::from(TILE));
            let index = |at: f64| at.floor().clamp(0.0, f64::from(length.div_ceil(TILE))) as u32;
            index(low)..index(high + 1.0)
        };
        for row in tiles(top, bottom, size[1]) {
            tiles(left, right, size[0]).for_each(|column| mask.add_tile([column, row]));
        }
    }
    mask
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
