//! Gradient noise (K. Perlin, *Improving Noise*, 2002), on a lattice of hashed gradients.

use glam::{DVec3, I64Vec3};

/// What the coordinates of a lattice point are multiplied by in its hash.
pub const AXES: [u64; 3] = [0x9E37_79B9_7F4A_7C15, 0xC2B2_AE3D_27D4_EB4F, 0x1656_67B1_9E37_79F9];

/// What two numbers are multiplied by in their [`hash`].
pub const PAIR: [u64; 2] = [AXES[0], AXES[1]];

/// What mixes the bits of hashes.
pub const MIX: u64 = 0xD6E8_FEB8_6659_FD93;

/// Noise at `point`: smooth, 0 at whole-numbered points, within −1 to 1, mean 0.
pub fn perlin(point: DVec3) -> f64 {
    let cell = point.floor();
    let within = point - cell;
    let fade = within * within * within * (within * (within * 6.0 - 15.0) + 10.0);
    let corner = |x: f64, y: f64, z: f64| {
        let offset = DVec3::new(x, y, z);
        gradient((cell + offset).as_i64vec3()).dot(within - offset)
    };
    let mix = |a: f64, b: f64, t: f64| a + (b - a) * t;
    let along_x = |y, z| mix(corner(0.0, y, z), corner(1.0, y, z), fade.x);
    let along_y = |z| mix(along_x(0.0, z), along_x(1.0, z), fade.y);
    mix(along_y(0.0), along_y(1.0), fade.z)
}

/// The sum of `octaves` of noise, each twice as fine and half as strong as the one before.
pub fn fractal(point: DVec3, octaves: u32) -> f64 {
    let mut sum = 0.0;
    let mut scale = 1.0;
    for _ in 0..octaves {
        sum += perlin(point * scale) / scale;
        scale *= 2.0;
    }
    sum
}

/// Whole numbers, mixed.
pub fn hash(a: u64, b: u64) -> u64 {
    let mut hash = a.wrapping_mul(PAIR[0]) ^ b.wrapping_mul(PAIR[1]).rotate_left(17);
    for _ in 0..2 {
        hash ^= hash >> 32;
        hash = hash.wrapping_mul(MIX);
    }
    hash ^ hash >> 32
}

/// One of the twelve directions to the middles of a cube's edges, by a hash of the lattice point.
fn gradient(point: I64Vec3) -> DVec3 {
    let [x, y, z] = point.to_array();
    let mut hash = (x as u64).wrapping_mul(AXES[0])
        ^ (y as u64).wrapping_mul(AXES[1])
        ^ (z as u64).wrapping_mul(AXES[2]);
    hash ^= hash >> 32;
    hash = hash.wrapping_mul(MIX);
    hash ^= hash >> 32;
    let sign = |bit: u64| if hash & bit == 0 { 1.0 } else { -1.0 };
    match (hash >> 8) % 3 {
        0 => DVec3::new(sign(1), sign(2), 0.0),
        1 => DVec3::new(sign(1), 0.0, sign(2)),
        _ => DVec3::new(0.0, sign(1), sign(2)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_is_bounded_continuous_and_zero_on_the_lattice() {
        assert_eq!(perlin(DVec3::new(3.0, -2.0, 7.0)), 0.0);
        let mut last = perlin(DVec3::ZERO);
        for step in 1..20_000 {
            let t = f64::from(step) * 0.01;
            let value = perlin(DVec3::new(t, 0.37 * t - 5.0, -0.71 * t));
            assert!(value.abs() <= 1.0, "{value} at {t}");
            assert!((value - last).abs() < 0.05, "a jump at {t}");
            last = value;
        }
    }

    #[test]
    fn noise_has_the_mean_zero() {
        let points = 20_000;
        let sum: f64 =
            (0..points).map(|step| perlin(DVec3::new(1.37, 2.71, -3.17) * f64::from(step))).sum();
        let mean = sum / f64::from(points);
        assert!(mean.abs() < 0.01, "{mean}");
    }
}
