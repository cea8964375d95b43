//! Functions that processors have no instruction for, made of multiplications and additions: the same bits
//! everywhere. Errors are a few units in the last place, unless said.

use super::{F32x8, Mask8, Simd, U32x8};

/// A polynomial by its coefficients, that of the highest power first.
#[inline(always)]
fn polynomial<S: Simd, const N: usize>(x: F32x8<S>, coefficients: [f32; N]) -> F32x8<S> {
    let mut sum = F32x8::splat(coefficients[0]);
    for coefficient in &coefficients[1..] {
        sum = sum * x + F32x8::splat(*coefficient);
    }
    sum
}

/// Sine and cosine of an angle in turns (1 is all round), to 1e-6; of angles below a million.
#[inline(always)]
pub fn sin_cos_turns<S: Simd>(turns: F32x8<S>) -> (F32x8<S>, F32x8<S>) {
    let quarter = (turns * F32x8::splat(4.0) + F32x8::splat(0.5)).floor();
    // Within an eighth of a turn of a quarter, Taylor's series are short.
    let angle = (turns - quarter * F32x8::splat(0.25)) * F32x8::splat(std::f32::consts::TAU);
    let square = angle * angle;
    let sin =
        angle * polynomial(square, [1.0 / 362_880.0, -1.0 / 5040.0, 1.0 / 120.0, -1.0 / 6.0, 1.0]);
    let cos = polynomial(square, [1.0 / 40_320.0, -1.0 / 720.0, 1.0 / 24.0, -0.5, 1.0]);
    let quarter = quarter.to_i32();
    let is_odd = (quarter & U32x8::splat(1)).eq(U32x8::splat(1));
    let (a, b) = (is_odd.select(cos, sin), is_odd.select(sin, cos));
    (flipped(a, quarter), flipped(b, quarter + U32x8::splat(1)))
}

/// With the other sign in the third and fourth quarter of a turn.
#[inline(always)]
fn flipped<S: Simd>(number: F32x8<S>, quarter: U32x8<S>) -> F32x8<S> {
    (number.bits() ^ ((quarter & U32x8::splat(2)) << 30)).as_floats()
}

/// The logarithm to base 2 of a positive number that is not denormal.
#[inline(always)]
pub fn log2<S: Simd>(x: F32x8<S>) -> F32x8<S> {
    // The mantissa between the roots of a half and of two.
    let root_half = U32x8::splat(std::f32::consts::FRAC_1_SQRT_2.to_bits());
    let from_root = x.bits() - root_half;
    let exponent = from_root.shr_signed(23);
    let mantissa = (x.bits() - (exponent << 23)).as_floats();
    let one = F32x8::splat(1.0);
    let s = (mantissa - one) / (mantissa + one);
    // 2 artanh s is the logarithm.
    let series = polynomial(s * s, [1.0 / 9.0, 1.0 / 7.0, 1.0 / 5.0, 1.0 / 3.0, 1.0]);
    exponent.i32_to_f32() + s * series * F32x8::splat(2.0 * std::f32::consts::LOG2_E)
}

/// Two to the power of `x`, which is taken to be within −126 and 126.
#[inline(always)]
pub fn exp2<S: Simd>(x: F32x8<S>) -> F32x8<S> {
    let x = x.clamp(-126.0, 126.0);
    let whole = (x + F32x8::splat(0.5)).floor();
    let rest = (x - whole) * F32x8::splat(std::f32::consts::LN_2);
    let power = polynomial(
        rest,
        [1.0 / 5040.0, 1.0 / 720.0, 1.0 / 120.0, 1.0 / 24.0, 1.0 / 6.0, 0.5, 1.0, 1.0],
    );
    (power.bits() + (whole.to_i32() << 23)).as_floats()
}

/// A number from 0 up to a power; 0 stays 0 when the power is positive. The relative error grows with the
/// result's logarithm: 1e-6 where that is 10.
#[inline(always)]
pub fn pow<S: Simd>(x: F32x8<S>, power: F32x8<S>) -> F32x8<S> {
    let least = F32x8::splat(f32::MIN_POSITIVE);
    x.ge(least).keep(exp2(log2(x.max(least)) * power))
}

/// The error function, to 1e-6 (M. Abramowitz, I. Stegun, *Handbook of Mathematical Functions*, 7.1.26).
#[inline(always)]
pub fn erf<S: Simd>(x: F32x8<S>) -> F32x8<S> {
    let one = F32x8::splat(1.0);
    let size = x.abs();
    let t = one / (one + F32x8::splat(0.327_591_1) * size);
    let sum =
        t * polynomial(t, [1.061_405_4, -1.453_152_1, 1.421_413_8, -0.284_496_72, 0.254_829_6]);
    let bell = exp2(-(size * size) * F32x8::splat(std::f32::consts::LOG2_E));
    (one - sum * bell).with_sign_of(x)
}

/// The function of each lane that is asked for, one after the other; for what is rare. Others are 0.
#[inline(always)]
pub fn one_by_one<S: Simd>(
    x: F32x8<S>,
    lanes: Mask8<S>,
    function: impl Fn(usize, f32) -> f32,
) -> F32x8<S> {
    let (x, lanes) = (x.store(), lanes.bits());
    let mut found = [0.0; 8];
    for (lane, found) in found.iter_mut().enumerate() {
        if lanes >> lane & 1 == 1 {
            *found = function(lane, x[lane]);
        }
    }
    F32x8::load(&found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::arrays::Arrays;
    use crate::lanes::{Plain, Task, Vec3x8, dispatch};

    /// All that a test does to eight numbers, in either way.
    struct All([f32; 8]);

    impl Task for All {
        type Output = Vec<[u32; 8]>;

        #[inline(always)]
        fn run<S: Simd>(self) -> Vec<[u32; 8]> {
            let x = F32x8::<S>::load(&self.0);
            let (sin, cos) = sin_cos_turns(x);
            let positive = x.abs() + F32x8::splat(1e-3);
            let words = x.bits();
            let table: Vec<f32> = (0..100_u8).map(f32::from).collect();
            let vector = Vec3x8::new(x, sin, cos).normalized();
            [
                sin,
                cos,
                log2(positive),
                exp2(x),
                pow(positive, F32x8::splat(2.4)),
                erf(x),
                x.floor(),
                x.min(sin),
                x.max(-x),
                x / sin,
                positive.sqrt(),
                vector.x,
                x.to_i32().i32_to_f32(),
                x.lt(sin).select(x, sin),
                F32x8::gather(&table, words & U32x8::splat(63)),
            ]
            .map(|found| found.bits().store())
            .into_iter()
            .chain([
                words.mul_high(words).store(),
                (words * words).store(),
                words.shr_signed(7).store(),
                [words.in_any_lane(); 8],
                words.reverse_bits().store(),
                (words >> (words & U32x8::splat(63))).store(),
                (words << (words & U32x8::splat(63))).store(),
                [u32::from((x.le(sin) & !x.eq(cos)).bits()); 8],
            ])
            .collect()
        }
    }

    fn numbers() -> impl Iterator<Item = [f32; 8]> {
        let odd = [0.0, -0.0, 1.0, -1.0, 0.5, -7.25, 100.0, -0.3];
        let many = (0..4000).map(|step: i32| {
            std::array::from_fn(|lane| (step as f32 - 2000.0) * 0.0137 + lane as f32 * 0.31)
        });
        std::iter::once(odd).chain(many)
    }

    #[test]
    fn all_ways_give_the_same_bits() {
        for x in numbers() {
            let plain = All(x).run::<Plain>();
            assert_eq!(dispatch(All(x)), plain, "{x:?}");
            assert_eq!(All(x).run::<Arrays>(), plain, "{x:?}");
        }
    }

    #[test]
    fn functions_are_near_libms() {
        for x in numbers() {
            let lanes = F32x8::<Plain>::load(&x);
            let (sin, cos) = sin_cos_turns(lanes);
            let positive = lanes.abs() + F32x8::splat(1e-3);
            let power = pow(positive, F32x8::splat(2.4));
            let found = [sin, cos, log2(positive), exp2(lanes), erf(lanes), power];
            let found = found.map(F32x8::store);
            let positive = positive.store();
            for (lane, x) in x.into_iter().enumerate() {
                let (x, positive) = (f64::from(x), f64::from(positive[lane]));
                let (sin, cos) = libm::sincos(x * std::f64::consts::TAU);
                let exact = [
                    sin,
                    cos,
                    libm::log2(positive),
                    libm::exp2(x),
                    libm::erf(x),
                    libm::pow(positive, 2.4),
                ];
                for (index, exact) in exact.into_iter().enumerate() {
                    let error = (f64::from(found[index][lane]) - exact).abs();
                    assert!(error < 2e-6 * exact.abs().max(1.0), "{index} of {x}: {error}");
                }
            }
        }
    }

    #[test]
    fn nothing_to_a_power_is_nothing() {
        let zero = F32x8::<Plain>::splat(0.0);
        assert_eq!(pow(zero, F32x8::splat(0.4)).store(), [0.0; 8]);
    }
}
