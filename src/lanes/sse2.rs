//! Lanes in pairs of the registers that every x86-64 processor has.

use std::arch::x86_64::*;

use super::Simd;

/// What every x86-64 processor can do.
#[derive(Clone, Copy)]
pub struct Sse2;

#[derive(Clone, Copy)]
pub struct F(__m128, __m128);

#[derive(Clone, Copy)]
pub struct U(__m128i, __m128i);

/// Functions that do the same to both halves. SAFETY: SSE2 is part of x86-64.
macro_rules! halves {
    ($($name:ident($($arg:ident: $type:ty),*) -> $result:ident = $body:expr;)*) => {$(
        #[inline(always)]
        fn $name($($arg: $type),*) -> $result {
            #[allow(unused_unsafe)]
            #[inline(always)]
            fn half($($arg: <$type as Halves>::Half),*) -> <$result as Halves>::Half {
                // SAFETY: see above.
                unsafe { $body }
            }
            $result(half($($arg.0),*), half($($arg.1),*))
        }
    )*};
}

trait Halves {
    type Half;
}

impl Halves for F {
    type Half = __m128;
}

impl Halves for U {
    type Half = __m128i;
}

#[inline(always)]
fn choose(mask: __m128, yes: __m128, no: __m128) -> __m128 {
    // SAFETY: SSE2 is part of x86-64.
    unsafe { _mm_or_ps(_mm_and_ps(mask, yes), _mm_andnot_ps(mask, no)) }
}

/// Below and above the even lanes of the products of whole numbers stand the odd ones.
#[inline(always)]
fn products(a: __m128i, b: __m128i) -> (__m128i, __m128i) {
    // SAFETY: SSE2 is part of x86-64.
    unsafe {
        let odd = _mm_mul_epu32(_mm_srli_epi64::<32>(a), _mm_srli_epi64::<32>(b));
        (_mm_mul_epu32(a, b), odd)
    }
}

impl Simd for Sse2 {
    type F = F;
    type U = U;
    type M = F;

    #[inline(always)]
    fn run<R>(body: impl FnOnce() -> R) -> R {
        body()
    }

    halves! {
        f_add(a: F, b: F) -> F = _mm_add_ps(a, b);
        f_sub(a: F, b: F) -> F = _mm_sub_ps(a, b);
        f_mul(a: F, b: F) -> F = _mm_mul_ps(a, b);
        f_div(a: F, b: F) -> F = _mm_div_ps(a, b);
        f_min(a: F, b: F) -> F = _mm_min_ps(a, b);
        f_max(a: F, b: F) -> F = _mm_max_ps(a, b);
        f_sqrt(a: F) -> F = _mm_sqrt_ps(a);
        f_floor(a: F) -> F = {
            let near = _mm_cvtepi32_ps(_mm_cvttps_epi32(a));
            let below = _mm_sub_ps(near, _mm_and_ps(_mm_cmpgt_ps(near, a), _mm_set1_ps(1.0)));
            // What is so large has no fraction; a zero keeps its sign.
            let size = _mm_andnot_ps(_mm_set1_ps(-0.0), a);
            let has_fraction = _mm_cmplt_ps(size, _mm_set1_ps(8_388_608.0));
            let floor = choose(has_fraction, below, a);
            _mm_or_ps(floor, _mm_and_ps(_mm_cmpeq_ps(floor, _mm_setzero_ps()), _mm_and_ps(a, _mm_set1_ps(-0.0))))
        };
        f_lt(a: F, b: F) -> F = _mm_cmplt_ps(a, b);
        f_le(a: F, b: F) -> F = _mm_cmple_ps(a, b);
        f_eq(a: F, b: F) -> F = _mm_cmpeq_ps(a, b);
        f_select(mask: F, yes: F, no: F) -> F = choose(mask, yes, no);
        f_bits(a: F) -> U = _mm_castps_si128(a);
        f_to_i32(a: F) -> U = _mm_cvttps_epi32(a);
        u_add(a: U, b: U) -> U = _mm_add_epi32(a, b);
        u_sub(a: U, b: U) -> U = _mm_sub_epi32(a, b);
        u_mul(a: U, b: U) -> U = {
            let (even, odd) = products(a, b);
            let low = _mm_set1_epi64x(0xFFFF_FFFF);
            _mm_or_si128(_mm_and_si128(even, low), _mm_slli_epi64::<32>(odd))
        };
        u_mul_high(a: U, b: U) -> U = {
            let (even, odd) = products(a, b);
            _mm_or_si128(_mm_srli_epi64::<32>(even), _mm_andnot_si128(_mm_set1_epi64x(0xFFFF_FFFF), odd))
        };
        u_and(a: U, b: U) -> U = _mm_and_si128(a, b);
        u_or(a: U, b: U) -> U = _mm_or_si128(a, b);
        u_xor(a: U, b: U) -> U = _mm_xor_si128(a, b);
        u_eq(a: U, b: U) -> F = _mm_castsi128_ps(_mm_cmpeq_epi32(a, b));
        u_select(mask: F, yes: U, no: U) -> U = {
            let chosen = choose(mask, _mm_castsi128_ps(yes), _mm_castsi128_ps(no));
            _mm_castps_si128(chosen)
        };
        u_as_floats(a: U) -> F = _mm_castsi128_ps(a);
        i32_to_f(a: U) -> F = _mm_cvtepi32_ps(a);
        m_and(a: F, b: F) -> F = _mm_and_ps(a, b);
        m_or(a: F, b: F) -> F = _mm_or_ps(a, b);
        m_and_not(a: F, b: F) -> F = _mm_andnot_ps(b, a);
        u_reverse_bits(a: U) -> U = {
            let mut a = a;
            for (by, low) in [(1, 0x5555_5555_u32), (2, 0x3333_3333), (4, 0x0F0F_0F0F)] {
                let (low, by) = (_mm_set1_epi32(low as i32), _mm_cvtsi32_si128(by));
                let upper = _mm_and_si128(_mm_srl_epi32(a, by), low);
                a = _mm_or_si128(upper, _mm_sll_epi32(_mm_and_si128(a, low), by));
            }
            // Bytes within halves of words, and then these.
            let bytes = _mm_or_si128(_mm_srli_epi16::<8>(a), _mm_slli_epi16::<8>(a));
            _mm_or_si128(_mm_srli_epi32::<16>(bytes), _mm_slli_epi32::<16>(bytes))
        };
    }

    #[inline(always)]
    fn f_splat(x: f32) -> F {
        // SAFETY: SSE2 is part of x86-64.
        unsafe { F(_mm_set1_ps(x), _mm_set1_ps(x)) }
    }

    #[inline(always)]
    fn f_load(x: &[f32; 8]) -> F {
        // SAFETY: SSE2 is part of x86-64, and there are eight.
        unsafe { F(_mm_loadu_ps(x.as_ptr()), _mm_loadu_ps(x.as_ptr().add(4))) }
    }

    #[inline(always)]
    fn f_store(x: F) -> [f32; 8] {
        let mut stored = [0.0; 8];
        // SAFETY: SSE2 is part of x86-64, and there is room for eight.
        unsafe {
            _mm_storeu_ps(stored.as_mut_ptr(), x.0);
            _mm_storeu_ps(stored.as_mut_ptr().add(4), x.1);
        }
        stored
    }

    #[inline(always)]
    fn f_gather(table: &[f32], index: U) -> F {
        let mut found = [0.0; 8];
        for (found, index) in found.iter_mut().zip(Sse2::u_store(index)) {
            *found = table[(index as usize).min(table.len() - 1)];
        }
        Sse2::f_load(&found)
    }

    #[inline(always)]
    fn u_splat(x: u32) -> U {
        // SAFETY: SSE2 is part of x86-64.
        unsafe { U(_mm_set1_epi32(x as i32), _mm_set1_epi32(x as i32)) }
    }

    #[inline(always)]
    fn u_load(x: &[u32; 8]) -> U {
        // SAFETY: SSE2 is part of x86-64, and there are eight.
        unsafe { U(_mm_loadu_si128(x.as_ptr().cast()), _mm_loadu_si128(x.as_ptr().add(4).cast())) }
    }

    #[inline(always)]
    fn u_store(x: U) -> [u32; 8] {
        let mut stored = [0; 8];
        // SAFETY: SSE2 is part of x86-64, and there is room for eight.
        unsafe {
            _mm_storeu_si128(stored.as_mut_ptr().cast(), x.0);
            _mm_storeu_si128(stored.as_mut_ptr().add(4).cast(), x.1);
        }
        stored
    }

    #[inline(always)]
    fn u_gather(table: &[u32], index: U) -> U {
        let mut found = [0; 8];
        for (found, index) in found.iter_mut().zip(Sse2::u_store(index)) {
            *found = table[(index as usize).min(table.len() - 1)];
        }
        Sse2::u_load(&found)
    }

    #[inline(always)]
    fn u_shl(a: U, by: u32) -> U {
        // SAFETY: SSE2 is part of x86-64.
        unsafe {
            let by = _mm_cvtsi32_si128(by as i32);
            U(_mm_sll_epi32(a.0, by), _mm_sll_epi32(a.1, by))
        }
    }

    #[inline(always)]
    fn u_shr(a: U, by: u32) -> U {
        // SAFETY: SSE2 is part of x86-64.
        unsafe {
            let by = _mm_cvtsi32_si128(by as i32);
            U(_mm_srl_epi32(a.0, by), _mm_srl_epi32(a.1, by))
        }
    }

    #[inline(always)]
    fn u_shr_signed(a: U, by: u32) -> U {
        // SAFETY: SSE2 is part of x86-64.
        unsafe {
            let by = _mm_cvtsi32_si128(by as i32);
            U(_mm_sra_epi32(a.0, by), _mm_sra_epi32(a.1, by))
        }
    }

    #[inline(always)]
    fn u_shl_each(a: U, by: U) -> U {
        let mut shifted = Sse2::u_store(a);
        for (number, by) in shifted.iter_mut().zip(Sse2::u_store(by)) {
            *number = if by < 32 { *number << by } else { 0 };
        }
        Sse2::u_load(&shifted)
    }

    #[inline(always)]
    fn u_shr_each(a: U, by: U) -> U {
        let mut shifted = Sse2::u_store(a);
        for (number, by) in shifted.iter_mut().zip(Sse2::u_store(by)) {
            *number = if by < 32 { *number >> by } else { 0 };
        }
        Sse2::u_load(&shifted)
    }

    #[inline(always)]
    fn m_bits(a: F) -> u8 {
        // SAFETY: SSE2 is part of x86-64.
        unsafe { (_mm_movemask_ps(a.0) | _mm_movemask_ps(a.1) << 4) as u8 }
    }

    #[inline(always)]
    fn m_from_bits(bits: u8) -> F {
        // SAFETY: SSE2 is part of x86-64.
        unsafe {
            let set = _mm_set1_epi32(i32::from(bits));
            let (low, high) = (_mm_setr_epi32(1, 2, 4, 8), _mm_setr_epi32(16, 32, 64, 128));
            F(
                _mm_castsi128_ps(_mm_cmpeq_epi32(_mm_and_si128(set, low), low)),
                _mm_castsi128_ps(_mm_cmpeq_epi32(_mm_and_si128(set, high), high)),
            )
        }
    }
}
