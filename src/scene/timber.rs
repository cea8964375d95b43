//! Timber: the rings, fibres and tone of wood that is cut from a tree of its own.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use super::noise::{hash, perlin};

/// How far a tree leans from the grain's direction: boards then show long arches.
const LEAN: f64 = 0.05;

/// Means of the parts of [`shade`], which they fade to where they are too fine to be seen.
const RING_MEAN: f64 = 0.16;

/// How dark the wood is at `point` (z along the grain, in widths of a ring), 0 to 1 and about
/// [`MEAN`] on the whole. Every `seed` is another tree; `seen` widths of a ring are seen at once,
/// and what is finer fades.
pub fn shade(point: DVec3, seed: u64, seen: f64) -> f64 {
    let [angle, distance, shift, tone] = [1, 2, 3, 4].map(|step| share(hash(seed, step)));
    let (sin, cos) = libm::sincos(TAU * angle);
    let heart = DVec2::new(cos, sin) * (9.0 + 22.0 * distance);
    // Trees have nothing in common: each lies elsewhere in the noise.
    let along = point.z + 4000.0 * shift;
    let (rings_left, fibres_left) = (visible(seen, 1.0), visible(seen, 0.3));
    let wind = |across: f64, length: f64| {
        perlin(DVec3::new(point.x / across, point.y / across, along / length))
    };
    let across = point.truncate() + heart + DVec2::new(LEAN * point.z, 0.0);
    let radius = across.length() + 1.6 * wind(10.0, 90.0) + 0.4 * wind(2.3, 40.0);
    let ring = radius.floor();
    // Early wood turns slowly into dark late wood, which ends at once.
    let t = radius - ring;
    let late = t * t * (1.0 - smooth((t - 0.86) / 0.14));
    // Good years and bad ones, and now and then a very dark line.
    let year = share(hash(seed, ring as i64 as u64));
    let year = 0.2 + 0.55 * year + 0.65 * year * year * year * year;
    let rings = (late * year - RING_MEAN) * rings_left;
    let fibres = if fibres_left > 0.0 { 0.26 * wind(0.19, 9.0) * fibres_left } else { 0.0 };
    let drift = 0.24 * wind(6.0, 50.0);
    (MEAN + rings + fibres + drift + 0.3 * (tone - 0.5)).clamp(0.0, 1.0)
}

/// The mean of [`shade`].
pub const MEAN: f64 = 0.36;

/// How much is left of a pattern of `width` where `seen` is seen at once.
fn visible(seen: f64, width: f64) -> f64 {
    1.0 - smooth((seen / width - 0.25) / 0.5)
}

fn smooth(t: f64) -> f64 {
    let t = t.clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// A number from 0 to 1.
fn share(hash: u64) -> f64 {
    (hash >> 11) as f64 / (1_u64 << 53) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mean(seen: f64) -> f64 {
        let points = 200_000;
        let shade = |step: i32| {
            shade(DVec3::new(0.37, -0.71, 0.13) * f64::from(step % 977), step as u64, seen)
        };
        (0..points).map(shade).sum::<f64>() / f64::from(points)
    }

    #[test]
    fn what_is_too_fine_to_be_seen_fades_to_the_mean() {
        for seen in [0.0, 0.5, 10.0] {
            assert!((mean(seen) - MEAN).abs() < 0.01, "{seen}: {}", mean(seen));
        }
        let far = |step: i32| shade(DVec3::X * 0.1 * f64::from(step), 5, 10.0);
        for step in 0..1000 {
            assert!((far(step) - far(step + 1)).abs() < 0.02);
        }
    }

    #[test]
    fn every_seed_is_another_tree() {
        let at = |seed| shade(DVec3::new(0.4, 0.7, 0.2), seed, 0.0);
        let shades: std::collections::BTreeSet<u64> = (0..64).map(|s| at(s).to_bits()).collect();
        assert!(shades.len() > 60, "{}", shades.len());
    }
}
