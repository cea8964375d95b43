//! Whether a piece that was built can stand on a square.

use glam::DVec3;

use crate::geometry::{Bounds, Csg, Interval, Ray, Solid};

/// Where the top of a piece may be, and how far its foot may be off the ground, in its heights.
const TOP: (f64, f64) = (0.9, 1.1);
const FOOT: f64 = 0.02;

/// Rays across a piece, from above and from below.
const ACROSS: u32 = 41;

/// What keeps `piece`, in units of its own height, from standing on a square that reaches `half` to
/// each side.
pub fn fault(piece: &Csg, half: f64) -> Option<String> {
    let Bounds { min, max } = piece.bounds();
    let mut found = Bounds::EMPTY;
    for index in 0..ACROSS * ACROSS {
        // Off the axes, where walls of boxes lie.
        let share = |step: u32| (f64::from(step) + 0.49) / f64::from(ACROSS);
        let x = min.x + (max.x - min.x) * share(index % ACROSS);
        let z = min.z + (max.z - min.z) * share(index / ACROSS);
        for (y, direction) in [(max.y + 1.0, DVec3::NEG_Y), (min.y - 1.0, DVec3::Y)] {
            let ray = Ray { origin: DVec3::new(x, y, z), direction };
            let hit = piece.nearest(&ray, Interval::AHEAD);
            found = hit.map_or(found, |hit| found.union(Bounds::of([ray.at(hit.t)])));
        }
    }
    let Bounds { min, max } = found;
    if max.y < min.y {
        return Some("its parts leave nothing, expected a body".to_owned());
    }
    if !(TOP.0..=TOP.1).contains(&max.y) {
        return Some(format!("its top is at y = {:.3}, expected 1", max.y));
    }
    if min.y.abs() > FOOT {
        return Some(format!("its foot is at y = {:.3}, expected 0", min.y));
    }
    let reach = [min.x, min.z, max.x, max.z].map(f64::abs).into_iter().fold(0.0, f64::max);
    (reach > half).then(|| {
        format!(
            "it reaches {reach:.3} heights from its axis, expected up to {half:.3}: half a square"
        )
    })
}
