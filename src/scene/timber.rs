//! Timber: the rings, fibres and tone of wood that is cut from a tree of its own.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use super::noise::{hash, perlin};

/// How far a tree leans from the grain's direction: boards then show long arches.
pub const LEAN: f64 = 0.05;

/// Means of the parts of [`shade`], which they fade to where they are too fine to be seen.
pub const RING_MEAN: f64 = 0.16;

/// What is noise in timber: how far it stretches across the grain and along it, and how strong it is.
type Wind = ([f64; 2], f64);

/// What bends rings.
pub const BENDS: [Wind; 2] = [([10.0, 90.0], 1.6), ([2.3, 40.0], 0.4)];
pub const FIBRES: Wind = ([0.19, 9.0], 0.26);
/// What changes slowly.
pub const DRIFT: Wind = ([6.0, 50.0], 0.24);

/// How wide patterns are where they fade.
pub const RING_WIDTH: f64 = 1.0;
pub const FIBRE_WIDTH: f64 = 0.3;

/// Where dark late wood ends in its ring, and how wide the end is.
pub const LATE: [f64; 2] = [0.86, 0.14];

/// What is a tree's own.
pub struct Tree {
    /// From its heart to the wood that is seen.
    pub heart: DVec2,
    /// Where along the grain it lies in the noise: trees have nothing in common.
    pub along: f64,
    /// How much darker than others it is.
    pub tone: f64,
}

impl Tree {
    pub fn new(seed: u64) -> Tree {
        let [angle, distance, along, tone] = [1, 2, 3, 4].map(|step| share(hash(seed, step)));
        let (sin, cos) = libm::sincos(TAU * angle);
        Tree {
            heart: DVec2::new(cos, sin) * (9.0 + 22.0 * distance),
            along: 4000.0 * along,
            tone: 0.3 * (tone - 0.5),
        }
    }
}

/// How dark the wood is at `point` (z along the grain, in widths of a ring), 0 to 1 and about
/// [`MEAN`] on the whole. Every `seed` is another tree; `seen` widths of a ring are seen at once,
/// and what is finer fades.
pub fn shade(point: DVec3, seed: u64, seen: f64) -> f64 {
    let tree = Tree::new(seed);
    let along = point.z + tree.along;
    let (rings_left, fibres_left) = (visible(seen, RING_WIDTH), visible(seen, FIBRE_WIDTH));
    let wind = |([across, length], strength): Wind| {
        strength * perlin(DVec3::new(point.x / across, point.y / across, along / length))
    };
    let across = point.truncate() + tree.heart + DVec2::new(LEAN * point.z, 0.0);
    let radius = across.length() + wind(BENDS[0]) + wind(BENDS[1]);
    let ring = radius.floor();
    // Early wood turns slowly into dark late wood, which ends at once.
    let t = radius - ring;
    let late = t * t * (1.0 - smooth((t - LATE[0]) / LATE[1]));
    // Good years and bad ones, and now and then a very dark line.
    let year = share(hash(seed, ring as i64 as u64));
    let year = 0.2 + 0.55 * year + 0.65 * year * year * year * year;
    let rings = (late * year - RING_MEAN) * rings_left;
    let fibres = if fibres_left > 0.0 { wind(FIBRES) * fibres_left } else { 0.0 };
    (MEAN + rings + fibres + wind(DRIFT) + tree.tone).clamp(0.0, 1.0)
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
