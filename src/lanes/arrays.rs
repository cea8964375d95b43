//! Lanes in arrays, for processors that are not x86-64.

use super::Simd;

/// Arrays of eight.
#[derive(Clone, Copy)]
pub struct Arrays;

#[derive(Clone, Copy)]
#[repr(align(32))]
pub struct Eight<T>([T; 8]);

#[inline(always)]
fn map<T: Copy, R: Copy + Default>(a: Eight<T>, f: impl Fn(T) -> R) -> Eight<R> {
    let mut result = [R::default(); 8];
    for (result, a) in result.iter_mut().zip(a.0) {
        *result = f(a);
    }
    Eight(result)
}

#[inline(always)]
fn map2<A: Copy, B: Copy, R: Copy + Default>(
    a: Eight<A>,
    b: Eight<B>,
    f: impl Fn(A, B) -> R,
) -> Eight<R> {
    let mut result = [R::default(); 8];
    for (result, (a, b)) in result.iter_mut().zip(a.0.into_iter().zip(b.0)) {
        *result = f(a, b);
    }
    Eight(result)
}

/// All bits, or none.
#[inline(always)]
fn answer(is_so: bool) -> u32 {
    if is_so { u32::MAX } else { 0 }
}

#[inline(always)]
fn choose(mask: u32, yes: u32, no: u32) -> u32 {
    yes & mask | no & !mask
}

macro_rules! by {
    ($($name:ident($($arg:ident: $type:ty),*) -> $result:ty = $body:expr;)*) => {$(
        #[inline(always)]
        fn $name($($arg: $type),*) -> $result {
            $body
        }
    )*};
}

type F = Eight<f32>;
type U = Eight<u32>;

impl Simd for Arrays {
    type F = F;
    type U = U;
    type M = U;

    by! {
        f_splat(x: f32) -> F = Eight([x; 8]);
        f_load(x: &[f32; 8]) -> F = Eight(*x);
        f_store(x: F) -> [f32; 8] = x.0;
        f_add(a: F, b: F) -> F = map2(a, b, |a, b| a + b);
        f_sub(a: F, b: F) -> F = map2(a, b, |a, b| a - b);
        f_mul(a: F, b: F) -> F = map2(a, b, |a, b| a * b);
        f_div(a: F, b: F) -> F = map2(a, b, |a, b| a / b);
        f_min(a: F, b: F) -> F = map2(a, b, |a, b| if a < b { a } else { b });
        f_max(a: F, b: F) -> F = map2(a, b, |a, b| if a > b { a } else { b });
        f_sqrt(a: F) -> F = map(a, f32::sqrt);
        f_floor(a: F) -> F = map(a, floor);
        f_lt(a: F, b: F) -> U = map2(a, b, |a, b| answer(a < b));
        f_le(a: F, b: F) -> U = map2(a, b, |a, b| answer(a <= b));
        f_eq(a: F, b: F) -> U = map2(a, b, |a, b| answer(a == b));
        f_bits(a: F) -> U = map(a, f32::to_bits);
        f_to_i32(a: F) -> U = map(a, |a| truncated(a) as u32);
        u_splat(x: u32) -> U = Eight([x; 8]);
        u_load(x: &[u32; 8]) -> U = Eight(*x);
        u_store(x: U) -> [u32; 8] = x.0;
        u_add(a: U, b: U) -> U = map2(a, b, u32::wrapping_add);
        u_sub(a: U, b: U) -> U = map2(a, b, u32::wrapping_sub);
        u_mul(a: U, b: U) -> U = map2(a, b, u32::wrapping_mul);
        u_mul_high(a: U, b: U) -> U = map2(a, b, |a, b| ((u64::from(a) * u64::from(b)) >> 32) as u32);
        u_and(a: U, b: U) -> U = map2(a, b, |a, b| a & b);
        u_or(a: U, b: U) -> U = map2(a, b, |a, b| a | b);
        u_xor(a: U, b: U) -> U = map2(a, b, |a, b| a ^ b);
        u_shl(a: U, by: u32) -> U = map(a, |a| a << by);
        u_shr(a: U, by: u32) -> U = map(a, |a| a >> by);
        u_shr_signed(a: U, by: u32) -> U = map(a, |a| (a as i32 >> by) as u32);
        u_shl_each(a: U, by: U) -> U = map2(a, by, |a, by| a.checked_shl(by).unwrap_or(0));
        u_shr_each(a: U, by: U) -> U = map2(a, by, |a, by| a.checked_shr(by).unwrap_or(0));
        u_reverse_bits(a: U) -> U = map(a, u32::reverse_bits);
        u_eq(a: U, b: U) -> U = map2(a, b, |a, b| answer(a == b));
        u_as_floats(a: U) -> F = map(a, f32::from_bits);
        i32_to_f(a: U) -> F = map(a, |a| a as i32 as f32);
        m_and(a: U, b: U) -> U = map2(a, b, |a, b| a & b);
        m_or(a: U, b: U) -> U = map2(a, b, |a, b| a | b);
        m_and_not(a: U, b: U) -> U = map2(a, b, |a, b| a & !b);
    }

    #[inline(always)]
    fn run<R>(body: impl FnOnce() -> R) -> R {
        body()
    }

    #[inline(always)]
    fn f_select(mask: U, yes: F, no: F) -> F {
        Arrays::u_as_floats(Arrays::u_select(mask, Arrays::f_bits(yes), Arrays::f_bits(no)))
    }

    #[inline(always)]
    fn u_select(mask: U, yes: U, no: U) -> U {
        let mut chosen = [0; 8];
        for (lane, chosen) in chosen.iter_mut().enumerate() {
            *chosen = choose(mask.0[lane], yes.0[lane], no.0[lane]);
        }
        Eight(chosen)
    }

    #[inline(always)]
    fn f_gather(table: &[f32], index: U) -> F {
        map(index, |index| table[(index as usize).min(table.len() - 1)])
    }

    #[inline(always)]
    fn u_gather(table: &[u32], index: U) -> U {
        map(index, |index| table[(index as usize).min(table.len() - 1)])
    }

    #[inline(always)]
    fn m_bits(a: U) -> u8 {
        let each = a.0.into_iter().enumerate();
        each.fold(0, |bits, (lane, answer)| bits | ((answer >> 31) as u8) << lane)
    }

    #[inline(always)]
    fn m_from_bits(bits: u8) -> U {
        Eight(std::array::from_fn(|lane| answer(bits >> lane & 1 == 1)))
    }
}

/// Towards zero; what is no `i32` becomes the least one, as processors have it.
#[inline(always)]
fn truncated(x: f32) -> i32 {
    if (-2_147_483_648.0..2_147_483_648.0).contains(&x) { x as i32 } else { i32::MIN }
}

#[inline(always)]
fn floor(x: f32) -> f32 {
    let near = x as i32 as f32;
    let below = if near > x { near - 1.0 } else { near };
    // What is so large has no fraction; a zero keeps its sign.
    if x.abs() < 8_388_608.0 && x != 0.0 { below } else { x }
}
