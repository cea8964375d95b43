//! Numbers for samples: even over every square of numbers, and of no pattern.
//!
//! Sobol's sequence in two dimensions, scrambled as Owen does, by hashes (B. Burley, *Practical
//! Hash-based Owen Scrambling*, 2020). A number depends on the pixel, the sample's index and what it
//! is for, on nothing else.

/// The numbers of one sample of a pixel.
#[derive(Clone, Copy, Debug)]
pub struct Sequence {
    pixel: u32,
    index: u32,
}

impl Sequence {
    /// For sample `index` of the pixel at (`x`, `y`).
    pub fn new(x: u32, y: u32, index: u32) -> Sequence {
        Sequence { pixel: mix(x ^ mix(y.wrapping_add(0x9E37_79B9))), index }
    }

    /// Two numbers, each from 0 to below 1; every `purpose` has its own.
    pub fn pair(&self, purpose: u32) -> (f64, f64) {
        let seed = mix(self.pixel ^ purpose.wrapping_mul(0x85EB_CA6B));
        let index = scrambled(self.index, seed);
        let number = |bits: u32| f64::from(bits) / 4_294_967_296.0;
        let first = scrambled(index.reverse_bits(), mix(seed ^ 1));
        let second = scrambled(second_dimension(index), mix(seed ^ 2));
        (number(first), number(second))
    }
}

/// The second dimension of Sobol's sequence: bit j of the index adds column j of Pascal's triangle
/// modulo 2.
fn second_dimension(index: u32) -> u32 {
    let (mut rest, mut column, mut sum) = (index, 1_u32 << 31, 0);
    while rest != 0 {
        if rest & 1 == 1 {
            sum ^= column;
        }
        column ^= column >> 1;
        rest >>= 1;
    }
    sum
}

/// Owen's scrambling: each bit is turned over or not, by a hash of the bits above it.
fn scrambled(bits: u32, seed: u32) -> u32 {
    let mut x = bits.reverse_bits().wrapping_add(seed);
    for factor in [0x6C50_B47C, 0xB82F_1E52, 0xC7AF_E638, 0x8D22_F6E6] {
        x ^= x.wrapping_mul(factor);
    }
    x.reverse_bits()
}

fn mix(bits: u32) -> u32 {
    let mut x = bits;
    for factor in [0x7FEB_352D, 0x846C_A68B] {
        x = (x ^ x >> 16).wrapping_mul(factor);
    }
    x ^ x >> 16
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of 16 samples one lies in each cell of every way to cut the square into 16 equal rectangles.
    #[test]
    fn samples_fill_the_square_evenly() {
        for (pixel, purpose) in [(0, 0), (1, 0), (7, 3), (123, 9)] {
            let pairs: Vec<(f64, f64)> =
                (0..16).map(|index| Sequence::new(pixel, 5, index).pair(purpose)).collect();
            for columns in [1, 2, 4, 8, 16] {
                let cell = |&(u, v): &(f64, f64)| {
                    assert!((0.0..1.0).contains(&u) && (0.0..1.0).contains(&v));
                    let rows = 16 / columns;
                    (u * f64::from(columns)) as i32 * rows + (v * f64::from(rows)) as i32
                };
                let cells: std::collections::BTreeSet<i32> = pairs.iter().map(cell).collect();
                assert_eq!(cells.len(), 16, "{pixel}, {purpose}: {columns} columns");
            }
        }
    }

    #[test]
    fn purposes_and_pixels_have_nothing_in_common() {
        let of = |x, purpose| Sequence::new(x, 0, 0).pair(purpose);
        let all: Vec<(f64, f64)> =
            (0..40).flat_map(|x| (0..10).map(move |purpose| of(x, purpose))).collect();
        let mean = all.iter().map(|(u, v)| (u - 0.5) * (v - 0.5)).sum::<f64>() / 400.0;
        assert!(mean.abs() < 0.015, "{mean}");
        let different: std::collections::BTreeSet<u64> =
            all.iter().map(|(u, _)| u.to_bits()).collect();
        assert_eq!(different.len(), 400);
    }
}
