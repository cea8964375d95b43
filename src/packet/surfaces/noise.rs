//! Gradient noise for packets of points, on the lattice of [`scene::noise`](crate::scene): the same hash of the
//! same cells, bit for bit, and so the same patterns.

use std::ops::BitXor;

use glam::{DVec3, Vec3};

use crate::lanes::{F32x8, Mask8, Simd, U32x8, Vec3x8};
use crate::scene::noise::{AXES, MIX, PAIR};

/// Noise that is asked at places far from its origin, stretched.
pub struct Wave {
    /// Units of noise a unit of the points.
    scale: Vec3,
    /// Where the points' origin lies: in which cell, and where in it. (In one number of 32 bits little would
    /// be left for the place in the cell.)
    cell: [u32; 3],
    within: Vec3,
}

impl Wave {
    /// Noise at `scale · point + offset`; offsets are below 2³⁰.
    pub fn new(scale: DVec3, offset: DVec3) -> Wave {
        let cell = offset.floor();
        Wave {
            scale: scale.as_vec3(),
            cell: cell.to_array().map(|cell| cell as i32 as u32),
            within: (offset - cell).as_vec3(),
        }
    }

    /// Smooth, within −1 to 1, mean 0. (A function for itself: it is large, and asked in many places.)
    #[inline(never)]
    pub fn at<S: Simd>(&self, points: &Vec3x8<S>, lanes: Mask8<S>) -> F32x8<S> {
        S::run(
            #[inline(always)]
            || self.noise(*points, lanes),
        )
    }

    #[inline(always)]
    fn noise<S: Simd>(&self, points: Vec3x8<S>, lanes: Mask8<S>) -> F32x8<S> {
        let places = points.times(Vec3x8::splat(self.scale)) + Vec3x8::splat(self.within);
        let floor = Vec3x8::new(places.x.floor(), places.y.floor(), places.z.floor());
        let within = Within::new(places - floor);
        let [x, y, z] = self.cell;
        let cell = [
            floor.x.to_i32() + U32x8::splat(x),
            floor.y.to_i32() + U32x8::splat(y),
            floor.z.to_i32() + U32x8::splat(z),
        ];
        // Neighbours are mostly in one cell: then its corners are hashed in lanes, not the lanes' corners.
        // What comes out differs by no more than the sign of a zero, which the sum takes away.
        let noise = match shared(cell, lanes) {
            Some(cell) => {
                let gradients = Gradients::of(cell);
                within.between(
                    #[inline(always)]
                    |corner, to| gradients.dot(corner, to),
                )
            }
            None => {
                let corners = Corners::of(cell);
                within.between(
                    #[inline(always)]
                    |corner, to| corners.slopes(corner).dot(to),
                )
            }
        };
        noise + F32x8::splat(0.0)
    }
}

/// Along each axis, whether a corner of a cell is at its end.
const ENDS: [[u32; 8]; 3] =
    [[0, 1, 0, 1, 0, 1, 0, 1], [0, 0, 1, 1, 0, 0, 1, 1], [0, 0, 0, 0, 1, 1, 1, 1]];

/// A place in a cell, seen from its two ends along each axis.
struct Within<S: Simd> {
    from: [Vec3x8<S>; 2],
    fade: Vec3x8<S>,
}

impl<S: Simd> Within<S> {
    #[inline(always)]
    fn new(from_near: Vec3x8<S>) -> Within<S> {
        let from_far = from_near - Vec3x8::grey(F32x8::splat(1.0));
        let fade = Vec3x8::new(fade(from_near.x), fade(from_near.y), fade(from_near.z));
        Within { from: [from_near, from_far], fade }
    }

    /// What lies between the numbers at the eight corners, each of which is asked for with the way from it to
    /// the place.
    #[inline(always)]
    fn between(&self, corner: impl Fn(usize, Vec3x8<S>) -> F32x8<S>) -> F32x8<S> {
        let near = self.edge(0, &corner).lerp(self.edge(2, &corner), self.fade.y);
        let far = self.edge(4, &corner).lerp(self.edge(6, &corner), self.fade.y);
        near.lerp(far, self.fade.z)
    }

    /// What lies between a corner and the next one along x.
    #[inline(always)]
    fn edge(&self, first: usize, corner: &impl Fn(usize, Vec3x8<S>) -> F32x8<S>) -> F32x8<S> {
        let (y, z) = (self.from[first >> 1 & 1].y, self.from[first >> 2].z);
        let near = corner(first, Vec3x8::new(self.from[0].x, y, z));
        near.lerp(corner(first + 1, Vec3x8::new(self.from[1].x, y, z)), self.fade.x)
    }
}

#[inline(always)]
fn fade<S: Simd>(t: F32x8<S>) -> F32x8<S> {
    let inner = t * (t * F32x8::splat(6.0) - F32x8::splat(15.0)) + F32x8::splat(10.0);
    t * t * t * inner
}

/// The cell of all `lanes` where they have one in common.
#[inline(always)]
fn shared<S: Simd>(cell: [U32x8<S>; 3], lanes: Mask8<S>) -> Option<[U32x8<S>; 3]> {
    let first = lanes.bits().trailing_zeros() as usize % 8;
    let [x, y, z] = cell;
    let one = [
        U32x8::splat(x.store()[first]),
        U32x8::splat(y.store()[first]),
        U32x8::splat(z.store()[first]),
    ];
    let are_there = x.eq(one[0]) & y.eq(one[1]) & z.eq(one[2]);
    if lanes.but(are_there).any() { None } else { Some(one) }
}

/// The gradients at the corners of one cell.
struct Gradients([[f32; 8]; 3]);

impl Gradients {
    #[inline(always)]
    fn of<S: Simd>([x, y, z]: [U32x8<S>; 3]) -> Gradients {
        let [right, above, behind] = ENDS;
        let x = Wide::product(x + U32x8::load(&right), AXES[0]);
        let y = Wide::product(y + U32x8::load(&above), AXES[1]);
        let z = Wide::product(z + U32x8::load(&behind), AXES[2]);
        let [x, y, z] = Slopes::of(x ^ y ^ z).components();
        Gradients([x.store(), y.store(), z.store()])
    }

    #[inline(always)]
    fn dot<S: Simd>(&self, corner: usize, to: Vec3x8<S>) -> F32x8<S> {
        let Gradients([x, y, z]) = self;
        F32x8::splat(x[corner]) * to.x
            + F32x8::splat(y[corner]) * to.y
            + F32x8::splat(z[corner]) * to.z
    }
}

/// What is hashed of the corners of cells: by axis, the products of both ends.
struct Corners<S: Simd>([[Wide<S>; 2]; 3]);

impl<S: Simd> Corners<S> {
    #[inline(always)]
    fn of([x, y, z]: [U32x8<S>; 3]) -> Corners<S> {
        let [x, y, z] =
            [Wide::product(x, AXES[0]), Wide::product(y, AXES[1]), Wide::product(z, AXES[2])];
        Corners([[x, x.plus(AXES[0])], [y, y.plus(AXES[1])], [z, z.plus(AXES[2])]])
    }

    #[inline(always)]
    fn slopes(&self, corner: usize) -> Slopes<S> {
        let Corners([x, y, z]) = self;
        Slopes::of(x[corner & 1] ^ y[corner >> 1 & 1] ^ z[corner >> 2])
    }
}

/// Gradients: one of the twelve directions to the middles of a cube's edges.
struct Slopes<S: Simd> {
    /// The axis that it does not go along, as thirds of 2³²: z, y, x. (A little more than a third each, so that the
    /// highest bits tell.)
    missing: U32x8<S>,
    /// The lowest bit is the sign of the first of the other two, the next one that of the second.
    signs: U32x8<S>,
}

impl<S: Simd> Slopes<S> {
    /// By the sum of the products.
    #[inline(always)]
    fn of(sum: Wide<S>) -> Slopes<S> {
        let folded = Wide { low: sum.low ^ sum.high, high: sum.high };
        let Wide { low, high } = folded.times(MIX);
        let low = low ^ high;
        // The hash but for its lowest byte modulo 3 is that of the sum of its digits to base 2¹⁶ or 2⁸.
        let digits = (high & U32x8::splat(0xFFFF)) + (high >> 16) + (low >> 8);
        Slopes { missing: digits * U32x8::splat(0x5555_5556), signs: low }
    }

    #[inline(always)]
    fn dot(&self, to: Vec3x8<S>) -> F32x8<S> {
        let first = self.is_x_missing().select(to.y, to.x);
        let second = self.is_z_missing().select(to.y, to.z);
        self.signed(first, 0) + self.signed(second, 1)
    }

    /// Its components.
    #[inline(always)]
    fn components(&self) -> [F32x8<S>; 3] {
        let (one, none) = (F32x8::splat(1.0), F32x8::splat(0.0));
        let (first, second) = (self.signed(one, 0), self.signed(one, 1));
        let (no_x, no_z) = (self.is_x_missing(), self.is_z_missing());
        let y = no_x.select(first, no_z.select(second, none));
        [no_x.select(none, first), y, no_z.select(none, second)]
    }

    #[inline(always)]
    fn is_x_missing(&self) -> Mask8<S> {
        is_negative(self.missing)
    }

    #[inline(always)]
    fn is_z_missing(&self) -> Mask8<S> {
        is_negative(self.missing - U32x8::splat(0x3000_0000))
    }

    #[inline(always)]
    fn signed(&self, number: F32x8<S>, bit: u32) -> F32x8<S> {
        (number.bits() ^ ((self.signs >> bit) << 31)).as_floats()
    }
}

#[inline(always)]
fn is_negative<S: Simd>(words: U32x8<S>) -> Mask8<S> {
    words.shr_signed(31).eq(U32x8::splat(u32::MAX))
}

/// A hash of whole numbers with signed ones, as a share from 0 to 1 ([`hash`](crate::scene::noise::hash)).
#[inline(always)]
pub fn share<S: Simd>(a: u64, b: U32x8<S>) -> F32x8<S> {
    let [by_a, by_b] = PAIR;
    let b = Wide::product(b, by_b).rotated_left(17);
    let mut hash = Wide::splat(a.wrapping_mul(by_a)) ^ b;
    for _ in 0..2 {
        hash = Wide { low: hash.low ^ hash.high, high: hash.high }.times(MIX);
    }
    (hash.high >> 8).i32_to_f32() * F32x8::splat(1.0 / (1 << 24) as f32)
}

/// Eight numbers of 64 bits.
#[derive(Clone, Copy)]
struct Wide<S: Simd> {
    low: U32x8<S>,
    high: U32x8<S>,
}

impl<S: Simd> Wide<S> {
    #[inline(always)]
    fn splat(x: u64) -> Wide<S> {
        Wide { low: U32x8::splat(x as u32), high: U32x8::splat((x >> 32) as u32) }
    }

    /// Signed numbers times another one.
    #[inline(always)]
    fn product(signed: U32x8<S>, by: u64) -> Wide<S> {
        let by = Wide::<S>::splat(by);
        let borrowed = signed.shr_signed(31) & by.low;
        let high = signed.mul_high(by.low) + signed * by.high - borrowed;
        Wide { low: signed * by.low, high }
    }

    #[inline(always)]
    fn times(self, by: u64) -> Wide<S> {
        let by = Wide::<S>::splat(by);
        let high = self.low.mul_high(by.low) + self.low * by.high + self.high * by.low;
        Wide { low: self.low * by.low, high }
    }

    #[inline(always)]
    fn plus(self, by: u64) -> Wide<S> {
        let by = Wide::<S>::splat(by);
        let low = self.low + by.low;
        let all = U32x8::splat(u32::MAX);
        let carry = ((self.low & by.low) | ((self.low | by.low) & (low ^ all))) >> 31;
        Wide { low, high: self.high + by.high + carry }
    }

    /// By 1 to 31 bits.
    #[inline(always)]
    fn rotated_left(self, by: u32) -> Wide<S> {
        Wide {
            low: self.low << by | self.high >> (32 - by),
            high: self.high << by | self.low >> (32 - by),
        }
    }
}

impl<S: Simd> BitXor for Wide<S> {
    type Output = Wide<S>;

    #[inline(always)]
    fn bitxor(self, other: Wide<S>) -> Wide<S> {
        Wide { low: self.low ^ other.low, high: self.high ^ other.high }
    }
}

/// A sum of octaves of noise, each twice as fine and half as strong as the one before.
pub struct Fractal {
    octaves: Vec<Wave>,
}

impl Fractal {
    /// Noise at `scale · point + offset`.
    pub fn new(scale: DVec3, offset: DVec3, octaves: u32) -> Fractal {
        let finer = |octave| f64::from(1_u32 << octave);
        let wave = |octave| Wave::new(scale * finer(octave), offset * finer(octave));
        Fractal { octaves: (0..octaves).map(wave).collect() }
    }

    #[inline(always)]
    pub fn at<S: Simd>(&self, points: Vec3x8<S>, lanes: Mask8<S>) -> F32x8<S> {
        let mut sum = F32x8::splat(0.0);
        let mut strength = 1.0;
        for octave in &self.octaves {
            sum += octave.at(&points, lanes) * F32x8::splat(strength);
            strength *= 0.5;
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::{Plain, Task, dispatch};
    use crate::scene::noise::{hash, perlin};

    /// Noise at eight points, when all of them or each alone is asked for.
    struct Ask<'a>(&'a Wave, [DVec3; 8]);

    impl Task for Ask<'_> {
        type Output = [[f32; 8]; 2];

        #[inline(always)]
        fn run<S: Simd>(self) -> [[f32; 8]; 2] {
            let Ask(wave, points) = self;
            let points = Vec3x8::<S>::load(&points);
            let alone = std::array::from_fn(|lane| {
                wave.at(&points, Mask8::from_bits(1 << lane)).store()[lane]
            });
            [wave.at(&points, Mask8::all_lanes()).store(), alone]
        }
    }

    #[test]
    fn noise_is_that_of_the_same_lattice() {
        let offsets = [DVec3::ZERO, DVec3::new(-3.25, 2e8 + 0.5, -7270.125)];
        for (step, offset) in (0..4000).flat_map(|step| offsets.map(|offset| (step, offset))) {
            let wave = Wave::new(DVec3::ONE, offset);
            let points = std::array::from_fn(|lane| {
                let t = f64::from(step - 2000) + 0.01 * lane as f64;
                DVec3::new(0.37 * t, -0.71 * t, 0.13 * t).as_vec3().as_dvec3()
            });
            let found = dispatch(Ask(&wave, points));
            assert_eq!(found, Ask(&wave, points).run::<Plain>());
            assert_eq!(found[0].map(f32::to_bits), found[1].map(f32::to_bits));
            for (found, point) in found[0].into_iter().zip(points) {
                let exact = perlin(point + offset);
                assert!((f64::from(found) - exact).abs() < 3e-6 * (1.0 + point.length() * 0.05));
            }
        }
    }

    #[test]
    fn shares_are_those_of_hashes() {
        for number in (-1000_i32..1000).chain([i32::MIN, i32::MAX]) {
            let seed = hash(7, number as i64 as u64);
            let found = share(seed, U32x8::<Plain>::splat(number as u32)).store()[0];
            let exact = hash(seed, number as i64 as u64) as f64 / 2_f64.powi(64);
            assert!((f64::from(found) - exact).abs() < 1e-7, "{number}: {found} is not {exact}");
        }
    }
}
