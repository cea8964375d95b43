//! How near a camera can come that still shows all of something.
//!
//! A camera with given directions sees a point at `across` and `depth` (along them) within its half
//! width when |across − x| ≤ slope · (depth − z), for its own place (x, z). For all points together
//! these are two lines in the plane of x and z, so the nearest place is where they meet: no search.

use glam::DVec3;

use super::camera::{Camera, FAR, Projection};
use crate::geometry::transform::sin_cos;

/// What remains free at the edges, as a share of half of the picture's shorter side.
const MARGIN: f64 = 0.03;

/// A point as one side of the picture sees it.
#[derive(Clone, Copy)]
struct Place {
    /// Along the picture's side.
    across: f64,
    /// Along the view axis.
    depth: f64,
}

/// The pinhole camera with the directions `axes` (right, up, forward) that shows all `points` as
/// large as can be, in the middle of a picture of `aspect` (width over height). The picture's
/// longer side covers an angle of `field` degrees.
pub fn perspective(axes: [DVec3; 3], field: f64, points: &[DVec3], aspect: f64) -> Camera {
    let (sin, cos) = sin_cos(field / 2.0);
    let longer = sin / cos;
    let slopes = [longer * aspect.min(1.0), longer / aspect.max(1.0)];
    let margin = MARGIN * slopes[0].min(slopes[1]);
    let sides = [0, 1].map(|side| {
        let place =
            |point: &DVec3| Place { across: point.dot(axes[side]), depth: point.dot(axes[2]) };
        points.iter().map(place).collect::<Vec<_>>()
    });
    let depth = |side: usize| nearest(&sides[side], slopes[side] - margin);
    let depth = depth(0).min(depth(1));
    let [x, y] = [0, 1].map(|side| centred(&sides[side], depth));
    let position = axes[0] * x + axes[1] * y + axes[2] * depth;
    Camera::new(position, axes, Projection::Perspective, slopes[0])
}

/// The camera in parallel projection that shows all `points` likewise.
pub fn parallel(axes: [DVec3; 3], points: &[DVec3], aspect: f64) -> Camera {
    let range = |axis: DVec3| {
        let along = points.iter().map(|point| point.dot(axis));
        along
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), at| (low.min(at), high.max(at)))
    };
    let [across, upwards, depth] = axes.map(range);
    let middle = |(low, high): (f64, f64)| low.midpoint(high);
    let half = |(low, high): (f64, f64)| (high - low) / 2.0;
    // Of a picture that is 2 wide.
    let margin = MARGIN * aspect.recip().min(1.0);
    let half_width = (half(across) / (1.0 - margin)).max(half(upwards) / (aspect.recip() - margin));
    let position =
        axes[0] * middle(across) + axes[1] * middle(upwards) + axes[2] * (middle(depth) - FAR);
    Camera::new(position, axes, Projection::Parallel, half_width)
}

/// The greatest depth from which all `places` are seen within `slope` to both sides.
fn nearest(places: &[Place], slope: f64) -> f64 {
    let sums = places.iter().map(|place| place.across + slope * place.depth);
    let differences = places.iter().map(|place| place.across - slope * place.depth);
    let gap = sums.fold(f64::INFINITY, f64::min) - differences.fold(f64::NEG_INFINITY, f64::max);
    gap / (2.0 * slope)
}

/// Where a camera at `depth`, before all of `places`, sees them equally far to both sides.
fn centred(places: &[Place], depth: f64) -> f64 {
    let ahead = |place: &Place| place.depth - depth;
    let mut slope = 0.0;
    loop {
        // The two that stand out most beyond `slope`, and the slope that holds just them: that of
        // the picture's middle, when they still are those.
        let left = |place: &Place| place.across + slope * ahead(place);
        let right = |place: &Place| place.across - slope * ahead(place);
        let (Some(leftmost), Some(rightmost)) = (
            places.iter().min_by(|a, b| left(a).total_cmp(&left(b))),
            places.iter().max_by(|a, b| right(a).total_cmp(&right(b))),
        ) else {
            return 0.0;
        };
        let tight = (rightmost.across - leftmost.across) / (ahead(leftmost) + ahead(rightmost));
        if tight > slope {
            slope = tight;
        } else {
            return left(leftmost).midpoint(right(rightmost));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::transform::{rotation_x, rotation_y};

    /// The corners of a box without any symmetry about the world's axes.
    fn corners() -> Vec<DVec3> {
        let pick = |bit: usize, index: usize, low, high| if index & bit == 0 { low } else { high };
        let corner = |index| {
            DVec3::new(
                pick(1, index, -3.0, 30.0),
                pick(2, index, -1.0, 7.0),
                pick(4, index, 0.0, 28.0),
            )
        };
        (0..8).map(corner).collect()
    }

    fn axes(elevation: f64, azimuth: f64) -> [DVec3; 3] {
        let turn = rotation_y(azimuth) * rotation_x(elevation);
        [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| turn.transform_vector3(axis))
    }

    /// How far from the picture's middle `points` reach to the left, right, bottom and top, in halves
    /// of its shorter side.
    fn reach(camera: &Camera, points: &[DVec3], aspect: f64) -> [f64; 4] {
        let [right, up, forward] = camera.axes();
        let half = camera.width() / 2.0 * aspect.recip().min(1.0);
        points.iter().fold([0.0; 4], |reach, point| {
            let to = *point - camera.position();
            let scale = match camera.projection() {
                Projection::Perspective => to.dot(forward) * half,
                Projection::Parallel => half,
            };
            let (x, y) = (to.dot(right) / scale, to.dot(up) / scale);
            [reach[0].max(-x), reach[1].max(x), reach[2].max(-y), reach[3].max(y)]
        })
    }

    #[test]
    fn all_is_shown_in_the_middle_and_fills_one_side_up_to_the_margin() {
        let points = corners();
        for aspect in [0.1_f64, 9.0 / 16.0, 1.0, 1.5, 16.0 / 9.0, 10.0] {
            for (elevation, azimuth) in [(45.0, 25.0), (20.0, -70.0), (90.0, 0.0), (35.0, 180.0)] {
                let axes = axes(elevation, azimuth);
                let whole = [aspect.max(1.0), aspect.recip().max(1.0)];
                for camera in
                    [perspective(axes, 26.0, &points, aspect), parallel(axes, &points, aspect)]
                {
                    let [left, right, bottom, top] = reach(&camera, &points, aspect);
                    assert!((left - right).abs() < 1e-9, "{left} {right}");
                    assert!((bottom - top).abs() < 1e-9, "{bottom} {top}");
                    let free = (whole[0] - left).min(whole[1] - top);
                    assert!((free - MARGIN).abs() < 1e-9, "{aspect}: {free} is free");
                }
            }
        }
    }
}
