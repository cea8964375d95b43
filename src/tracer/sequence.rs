//! Numbers for samples: even over every square of numbers, and of no pattern.
//!
//! Sobol's sequence in two dimensions, scrambled as Owen does, by hashes (B. Burley, *Practical
//! Hash-based Owen Scrambling*, 2020). A number depends on the pixel, the sample's index and what it
//! is for, on nothing else.

use crate::lanes::{F32x8, Simd, U32x8};

const SCRAMBLING: [u32; 4] = [0x6C50_B47C, 0xB82F_1E52, 0xC7AF_E638, 0x8D22_F6E6];

const MIXING: [u32; 2] = [0x7FEB_352D, 0x846C_A68B];

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

/// The numbers of eight samples.
#[derive(Clone, Copy)]
pub struct Sequences<S: Simd> {
    pixel: U32x8<S>,
    index: U32x8<S>,
}

impl<S: Simd> Sequences<S> {
    /// For samples of pixels by number.
    #[inline(always)]
    pub fn new(x: U32x8<S>, y: U32x8<S>, index: U32x8<S>) -> Sequences<S> {
        let y = y + U32x8::splat(0x9E37_79B9);
        Sequences { pixel: mix8(x ^ mix8(y)), index }
    }

    /// The same numbers as [`Sequence::pair`], rounded down to 24 bits.
    #[inline(always)]
    pub fn pair(&self, purpose: u32) -> (F32x8<S>, F32x8<S>) {
        let seed = mix8(self.pixel ^ U32x8::splat(purpose.wrapping_mul(0x85EB_CA6B)));
        let index = scrambled8(self.index.reverse_bits(), seed).reverse_bits();
        let first = scrambled8(index, mix8(seed ^ U32x8::splat(1)));
        // Bit i of the reversed number is the sum of all bits j whose row of Pascal's triangle is odd at i:
        // those that have all bits of i.
        let mut second = index;
        for (step, lacking) in [0x5555_5555, 0x3333_3333, 0x0F0F_0F0F, 0x00FF_00FF, 0x0000_FFFF]
            .into_iter()
            .enumerate()
        {
            second = second ^ ((second >> (1 << step)) & U32x8::splat(lacking));
        }
        let second = scrambled8(second, mix8(seed ^ U32x8::splat(2)));
        (number8(first), number8(second))
    }
}

/// Of reversed bits a number from 0 to below 1.
#[inline(always)]
fn number8<S: Simd>(reversed: U32x8<S>) -> F32x8<S> {
    (reversed.reverse_bits() >> 8).i32_to_f32() * F32x8::splat(1.0 / 16_777_216.0)
}

/// [`mix`] in lanes.
#[inline(always)]
fn mix8<S: Simd>(bits: U32x8<S>) -> U32x8<S> {
    let mut x = bits;
    for factor in MIXING {
        x = (x ^ (x >> 16)) * U32x8::splat(factor);
    }
    x ^ (x >> 16)
}

/// [`scrambled`] in lanes, of numbers whose bits are reversed, and so are those of the result.
#[inline(always)]
fn scrambled8<S: Simd>(reversed: U32x8<S>, seed: U32x8<S>) -> U32x8<S> {
    let mut x = reversed + seed;
    for factor in SCRAMBLING {
        x = x ^ (x * U32x8::splat(factor));
    }
    x
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
    for factor in SCRAMBLING {
        x ^= x.wrapping_mul(factor);
    }
    x.reverse_bits()
}

fn mix(bits: u32) -> u32 {
    let mut x = bits;
    for factor in MIXING {
        x = (x ^ x >> 16).wrapping_mul(factor);
    }
    x ^ x >> 16
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::{Plain, Task, dispatch};

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
    fn eight_at_once_are_the_same_numbers() {
        struct Pairs([u32; 8], u32);
        impl Task for Pairs {
            type Output = [[f32; 8]; 2];

            #[inline(always)]
            fn run<S: Simd>(self) -> [[f32; 8]; 2] {
                let x = U32x8::<S>::load(&self.0);
                let pair = Sequences::new(x, x * U32x8::splat(7), x >> 3).pair(self.1);
                [pair.0.store(), pair.1.store()]
            }
        }
        for step in 0..500 {
            let x = std::array::from_fn(|lane| 37 * step + lane as u32);
            let pairs = dispatch(Pairs(x, step));
            assert_eq!(pairs, Pairs(x, step).run::<Plain>());
            for (lane, x) in x.into_iter().enumerate() {
                let (first, second) = Sequence::new(x, 7 * x, x >> 3).pair(step);
                for (found, exact) in [(pairs[0][lane], first), (pairs[1][lane], second)] {
                    let less = exact - f64::from(found);
                    assert!((0.0..1.0 / 16_777_216.0).contains(&less), "{x}, {step}: {less}");
                }
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
