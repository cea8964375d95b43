//! Eight numbers at once.
//!
//! [`F32x8`], [`U32x8`] and [`Mask8`] have eight lanes that know nothing of each other. How they are held is
//! a matter of the processor, chosen when the program runs ([`dispatch`]): [`Avx2`] where there is one, else
//! [`Plain`]. All give the same bits: there is no fused multiplication, no approximate reciprocal, and
//! functions that have no instruction are made of those that have ([`math`]).
//!
//! What works on lanes is generic over [`Simd`] and marked `#[inline(always)]`, since a function that stands for
//! itself is compiled for any processor. Where one has to stand for itself (recursion, or too large), its body goes
//! into [`Simd::run`].

#[cfg(any(test, not(target_arch = "x86_64")))]
mod arrays;
#[cfg(target_arch = "x86_64")]
mod avx2;
pub mod math;
#[cfg(target_arch = "x86_64")]
mod sse2;
mod vector;

#[cfg(target_arch = "x86_64")]
pub use avx2::Avx2;
pub use vector::{Rows, Vec3x8};

/// What needs no choice: every processor of a kind has it.
#[cfg(target_arch = "x86_64")]
pub type Plain = sse2::Sse2;
#[cfg(not(target_arch = "x86_64"))]
pub type Plain = arrays::Arrays;

use std::ops::{Add, AddAssign, BitAnd, BitOr, BitXor, Div, Mul, Neg, Not, Shl, Shr, Sub};
use std::sync::OnceLock;

/// How many lanes there are.
pub const LANES: usize = 8;

/// A way to hold and count with eight lanes.
///
/// Methods other than [`Simd::run`] may use instructions that only some processors have: a type is named as a
/// parameter by [`dispatch`] alone.
pub trait Simd: Copy + Send + Sync + 'static {
    /// Eight floating-point numbers, whole numbers, or answers.
    type F: Copy;
    type U: Copy;
    type M: Copy;

    /// Runs `body` with all instructions of this way allowed.
    fn run<R>(body: impl FnOnce() -> R) -> R;

    fn f_splat(x: f32) -> Self::F;
    fn f_load(x: &[f32; 8]) -> Self::F;
    fn f_store(x: Self::F) -> [f32; 8];
    fn f_add(a: Self::F, b: Self::F) -> Self::F;
    fn f_sub(a: Self::F, b: Self::F) -> Self::F;
    fn f_mul(a: Self::F, b: Self::F) -> Self::F;
    fn f_div(a: Self::F, b: Self::F) -> Self::F;
    /// `a < b ? a : b`, and so `b` where either is no number.
    fn f_min(a: Self::F, b: Self::F) -> Self::F;
    /// `a > b ? a : b`, and so `b` where either is no number.
    fn f_max(a: Self::F, b: Self::F) -> Self::F;
    fn f_sqrt(a: Self::F) -> Self::F;
    fn f_floor(a: Self::F) -> Self::F;
    fn f_lt(a: Self::F, b: Self::F) -> Self::M;
    fn f_le(a: Self::F, b: Self::F) -> Self::M;
    fn f_eq(a: Self::F, b: Self::F) -> Self::M;
    fn f_select(mask: Self::M, yes: Self::F, no: Self::F) -> Self::F;
    fn f_bits(a: Self::F) -> Self::U;
    /// Towards zero; what is no `i32` becomes the least one.
    fn f_to_i32(a: Self::F) -> Self::U;
    fn f_gather(table: &[f32], index: Self::U) -> Self::F;
    /// The least and the greatest number of all lanes, which must be numbers.
    #[inline(always)]
    fn f_range(a: Self::F) -> [f32; 2] {
        let numbers = Self::f_store(a);
        let [mut least, mut greatest] = [numbers[0]; 2];
        for number in numbers {
            least = if number < least { number } else { least };
            greatest = if number > greatest { number } else { greatest };
        }
        [least, greatest]
    }

    fn u_splat(x: u32) -> Self::U;
    fn u_load(x: &[u32; 8]) -> Self::U;
    fn u_store(x: Self::U) -> [u32; 8];
    fn u_add(a: Self::U, b: Self::U) -> Self::U;
    fn u_sub(a: Self::U, b: Self::U) -> Self::U;
    fn u_mul(a: Self::U, b: Self::U) -> Self::U;
    /// The upper halves of the products.
    fn u_mul_high(a: Self::U, b: Self::U) -> Self::U;
    fn u_and(a: Self::U, b: Self::U) -> Self::U;
    fn u_or(a: Self::U, b: Self::U) -> Self::U;
    fn u_xor(a: Self::U, b: Self::U) -> Self::U;
    /// Shifts by less than 32.
    fn u_shl(a: Self::U, by: u32) -> Self::U;
    fn u_shr(a: Self::U, by: u32) -> Self::U;
    /// Shifts lane by lane; by 32 and more all bits are lost.
    fn u_shl_each(a: Self::U, by: Self::U) -> Self::U;
    fn u_shr_each(a: Self::U, by: Self::U) -> Self::U;
    /// The sign is shifted in.
    fn u_shr_signed(a: Self::U, by: u32) -> Self::U;
    /// The lowest bit becomes the highest.
    fn u_reverse_bits(a: Self::U) -> Self::U;
    /// All bits that are set in any lane.
    #[inline(always)]
    fn u_or_lanes(a: Self::U) -> u32 {
        let [a, b, c, d, e, f, g, h] = Self::u_store(a);
        a | b | c | d | e | f | g | h
    }
    fn u_eq(a: Self::U, b: Self::U) -> Self::M;
    fn u_select(mask: Self::M, yes: Self::U, no: Self::U) -> Self::U;
    fn u_as_floats(a: Self::U) -> Self::F;
    /// As signed numbers, rounded to nearest.
    fn i32_to_f(a: Self::U) -> Self::F;
    fn u_gather(table: &[u32], index: Self::U) -> Self::U;

    fn m_and(a: Self::M, b: Self::M) -> Self::M;
    fn m_or(a: Self::M, b: Self::M) -> Self::M;
    fn m_and_not(a: Self::M, b: Self::M) -> Self::M;
    fn m_bits(a: Self::M) -> u8;
    fn m_from_bits(bits: u8) -> Self::M;
}

/// What can be done in either way.
pub trait Task {
    type Output;

    /// To be marked `#[inline(always)]`.
    fn run<S: Simd>(self) -> Self::Output;
}

/// The environment variable that forbids [`Avx2`], by any value.
pub const PLAIN: &str = "LIGHTSQUARE_PLAIN";

/// Whether lanes are held in AVX2's registers: the processor has it, and the environment does not
/// forbid it ([`PLAIN`]).
pub fn has_avx2() -> bool {
    static HAS: OnceLock<bool> = OnceLock::new();
    *HAS.get_or_init(|| {
        #[cfg(target_arch = "x86_64")]
        let has = std::arch::is_x86_feature_detected!("avx2");
        #[cfg(not(target_arch = "x86_64"))]
        let has = false;
        has && std::env::var_os(PLAIN).is_none()
    })
}

/// Does a task in the quickest way that the processor has.
pub fn dispatch<T: Task>(task: T) -> T::Output {
    #[cfg(target_arch = "x86_64")]
    if has_avx2() {
        return Avx2::run(
            #[inline(always)]
            || task.run::<Avx2>(),
        );
    }
    Plain::run(
        #[inline(always)]
        || task.run::<Plain>(),
    )
}

/// Eight floating-point numbers.
#[derive(Clone, Copy)]
pub struct F32x8<S: Simd>(S::F);

/// Eight whole numbers.
#[derive(Clone, Copy)]
pub struct U32x8<S: Simd>(S::U);

/// Eight answers.
#[derive(Clone, Copy)]
pub struct Mask8<S: Simd>(S::M);

macro_rules! binary {
    ($type:ident, $($trait:ident $method:ident $function:ident),*) => {$(
        impl<S: Simd> $trait for $type<S> {
            type Output = $type<S>;

            #[inline(always)]
            fn $method(self, other: $type<S>) -> $type<S> {
                $type(S::$function(self.0, other.0))
            }
        }
    )*};
}

binary!(F32x8, Add add f_add, Sub sub f_sub, Mul mul f_mul, Div div f_div);
binary!(U32x8, Add add u_add, Sub sub u_sub, Mul mul u_mul);
binary!(U32x8, BitAnd bitand u_and, BitOr bitor u_or, BitXor bitxor u_xor);
binary!(U32x8, Shl shl u_shl_each, Shr shr u_shr_each);
binary!(Mask8, BitAnd bitand m_and, BitOr bitor m_or);

impl<S: Simd> AddAssign for F32x8<S> {
    #[inline(always)]
    fn add_assign(&mut self, other: F32x8<S>) {
        *self = *self + other;
    }
}

impl<S: Simd> Neg for F32x8<S> {
    type Output = F32x8<S>;

    #[inline(always)]
    fn neg(self) -> F32x8<S> {
        (self.bits() ^ U32x8::splat(1 << 31)).as_floats()
    }
}

impl<S: Simd> Shl<u32> for U32x8<S> {
    type Output = U32x8<S>;

    #[inline(always)]
    fn shl(self, by: u32) -> U32x8<S> {
        U32x8(S::u_shl(self.0, by))
    }
}

impl<S: Simd> Shr<u32> for U32x8<S> {
    type Output = U32x8<S>;

    #[inline(always)]
    fn shr(self, by: u32) -> U32x8<S> {
        U32x8(S::u_shr(self.0, by))
    }
}

impl<S: Simd> Not for Mask8<S> {
    type Output = Mask8<S>;

    #[inline(always)]
    fn not(self) -> Mask8<S> {
        Mask8::all_lanes().but(self)
    }
}

impl<S: Simd> F32x8<S> {
    #[inline(always)]
    pub fn splat(x: f32) -> F32x8<S> {
        F32x8(S::f_splat(x))
    }

    #[inline(always)]
    pub fn load(x: &[f32; 8]) -> F32x8<S> {
        F32x8(S::f_load(x))
    }

    /// The first eight of `x`; where there are fewer, the last one again. There must be one.
    #[inline(always)]
    pub fn load_some(x: &[f32]) -> F32x8<S> {
        match x.first_chunk() {
            Some(eight) => F32x8::load(eight),
            None => {
                let mut eight = [x[x.len() - 1]; 8];
                eight[..x.len()].copy_from_slice(x);
                F32x8::load(&eight)
            }
        }
    }

    #[inline(always)]
    pub fn store(self) -> [f32; 8] {
        S::f_store(self.0)
    }

    /// The lesser one; `other` where either is no number.
    #[inline(always)]
    pub fn min(self, other: F32x8<S>) -> F32x8<S> {
        F32x8(S::f_min(self.0, other.0))
    }

    /// The greater one; `other` where either is no number.
    #[inline(always)]
    pub fn max(self, other: F32x8<S>) -> F32x8<S> {
        F32x8(S::f_max(self.0, other.0))
    }

    #[inline(always)]
    pub fn clamp(self, low: f32, high: f32) -> F32x8<S> {
        self.max(F32x8::splat(low)).min(F32x8::splat(high))
    }

    #[inline(always)]
    pub fn abs(self) -> F32x8<S> {
        (self.bits() & U32x8::splat(!(1 << 31))).as_floats()
    }

    #[inline(always)]
    pub fn sqrt(self) -> F32x8<S> {
        F32x8(S::f_sqrt(self.0))
    }

    #[inline(always)]
    pub fn recip(self) -> F32x8<S> {
        F32x8::splat(1.0) / self
    }

    /// Of numbers that an `i32` can hold.
    #[inline(always)]
    pub fn floor(self) -> F32x8<S> {
        F32x8(S::f_floor(self.0))
    }

    #[inline(always)]
    pub fn lerp(self, other: F32x8<S>, share: F32x8<S>) -> F32x8<S> {
        self + (other - self) * share
    }

    /// The size of this number with the sign of another.
    #[inline(always)]
    pub fn with_sign_of(self, other: F32x8<S>) -> F32x8<S> {
        let sign = U32x8::splat(1 << 31);
        ((self.bits() & U32x8::splat(!(1 << 31))) | (other.bits() & sign)).as_floats()
    }

    #[inline(always)]
    pub fn lt(self, other: F32x8<S>) -> Mask8<S> {
        Mask8(S::f_lt(self.0, other.0))
    }

    #[inline(always)]
    pub fn le(self, other: F32x8<S>) -> Mask8<S> {
        Mask8(S::f_le(self.0, other.0))
    }

    #[inline(always)]
    pub fn gt(self, other: F32x8<S>) -> Mask8<S> {
        other.lt(self)
    }

    #[inline(always)]
    pub fn ge(self, other: F32x8<S>) -> Mask8<S> {
        other.le(self)
    }

    #[inline(always)]
    pub fn eq(self, other: F32x8<S>) -> Mask8<S> {
        Mask8(S::f_eq(self.0, other.0))
    }

    #[inline(always)]
    pub fn bits(self) -> U32x8<S> {
        U32x8(S::f_bits(self.0))
    }

    /// Towards zero, as signed numbers; what is none becomes the least one.
    #[inline(always)]
    pub fn to_i32(self) -> U32x8<S> {
        U32x8(S::f_to_i32(self.0))
    }

    /// The least and the greatest number of all lanes, which must be numbers.
    #[inline(always)]
    pub fn range(self) -> [f32; 2] {
        S::f_range(self.0)
    }

    /// Numbers of a table, each at its own index, which must be within it.
    #[inline(always)]
    pub fn gather(table: &[f32], index: U32x8<S>) -> F32x8<S> {
        F32x8(S::f_gather(table, index.0))
    }
}

impl<S: Simd> U32x8<S> {
    #[inline(always)]
    pub fn splat(x: u32) -> U32x8<S> {
        U32x8(S::u_splat(x))
    }

    #[inline(always)]
    pub fn load(x: &[u32; 8]) -> U32x8<S> {
        U32x8(S::u_load(x))
    }

    #[inline(always)]
    pub fn store(self) -> [u32; 8] {
        S::u_store(self.0)
    }

    /// The upper half of the product.
    #[inline(always)]
    pub fn mul_high(self, other: U32x8<S>) -> U32x8<S> {
        U32x8(S::u_mul_high(self.0, other.0))
    }

    /// Shifts signed numbers.
    #[inline(always)]
    pub fn shr_signed(self, by: u32) -> U32x8<S> {
        U32x8(S::u_shr_signed(self.0, by))
    }

    #[inline(always)]
    pub fn eq(self, other: U32x8<S>) -> Mask8<S> {
        Mask8(S::u_eq(self.0, other.0))
    }

    /// The lowest bit becomes the highest.
    #[inline(always)]
    pub fn reverse_bits(self) -> U32x8<S> {
        U32x8(S::u_reverse_bits(self.0))
    }

    /// All bits that are set in any lane.
    #[inline(always)]
    pub fn in_any_lane(self) -> u32 {
        S::u_or_lanes(self.0)
    }

    /// Of numbers less than 2³¹ apart, whether this one is less.
    #[inline(always)]
    pub fn below(self, other: U32x8<S>) -> Mask8<S> {
        ((self - other) >> 31).eq(U32x8::splat(1))
    }

    /// The same bits as floating-point numbers.
    #[inline(always)]
    pub fn as_floats(self) -> F32x8<S> {
        F32x8(S::u_as_floats(self.0))
    }

    /// Signed numbers, rounded to the nearest floating-point ones.
    #[inline(always)]
    pub fn i32_to_f32(self) -> F32x8<S> {
        F32x8(S::i32_to_f(self.0))
    }

    /// Numbers of a table, each at its own index, which must be within it.
    #[inline(always)]
    pub fn gather(table: &[u32], index: U32x8<S>) -> U32x8<S> {
        U32x8(S::u_gather(table, index.0))
    }
}

impl<S: Simd> Mask8<S> {
    #[inline(always)]
    pub fn all_lanes() -> Mask8<S> {
        Mask8(S::m_from_bits(u8::MAX))
    }

    #[inline(always)]
    pub fn no_lanes() -> Mask8<S> {
        Mask8(S::m_from_bits(0))
    }

    #[inline(always)]
    pub fn splat(answer: bool) -> Mask8<S> {
        Mask8::from_bits(if answer { u8::MAX } else { 0 })
    }

    /// The first few lanes.
    #[inline(always)]
    pub fn first(count: usize) -> Mask8<S> {
        Mask8::from_bits((0xFF_u32 >> (LANES - count.min(LANES))) as u8)
    }

    /// Lane 0 is the lowest bit.
    #[inline(always)]
    pub fn from_bits(bits: u8) -> Mask8<S> {
        Mask8(S::m_from_bits(bits))
    }

    #[inline(always)]
    pub fn bits(self) -> u8 {
        S::m_bits(self.0)
    }

    #[inline(always)]
    pub fn any(self) -> bool {
        self.bits() != 0
    }

    /// This, and not the other.
    #[inline(always)]
    pub fn but(self, other: Mask8<S>) -> Mask8<S> {
        Mask8(S::m_and_not(self.0, other.0))
    }

    #[inline(always)]
    pub fn select(self, yes: F32x8<S>, no: F32x8<S>) -> F32x8<S> {
        F32x8(S::f_select(self.0, yes.0, no.0))
    }

    #[inline(always)]
    pub fn select_words(self, yes: U32x8<S>, no: U32x8<S>) -> U32x8<S> {
        U32x8(S::u_select(self.0, yes.0, no.0))
    }

    /// The number where the answer is yes, else 0.
    #[inline(always)]
    pub fn keep(self, number: F32x8<S>) -> F32x8<S> {
        self.select(number, F32x8::splat(0.0))
    }
}
