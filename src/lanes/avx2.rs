//! Lanes in the registers of AVX2.

use std::arch::x86_64::*;

use super::Simd;

/// Named by [`super::dispatch`] where the processor has AVX2.
#[derive(Clone, Copy)]
pub struct Avx2;

/// Functions of one intrinsic or few. SAFETY: `Avx2` is a parameter only where AVX2 was found.
macro_rules! by {
    ($($name:ident($($arg:ident: $type:ty),*) -> $result:ty = $body:expr;)*) => {$(
        #[inline(always)]
        fn $name($($arg: $type),*) -> $result {
            // SAFETY: see above.
            #[allow(unused_unsafe)]
            unsafe { $body }
        }
    )*};
}

impl Simd for Avx2 {
    type F = __m256;
    type U = __m256i;
    type M = __m256;

    #[inline(always)]
    fn run<R>(body: impl FnOnce() -> R) -> R {
        #[target_feature(enable = "avx2")]
        unsafe fn with_avx2<R>(body: impl FnOnce() -> R) -> R {
            body()
        }
        // SAFETY: `Avx2` is a parameter only where AVX2 was found.
        unsafe { with_avx2(body) }
    }

    by! {
        f_splat(x: f32) -> __m256 = _mm256_set1_ps(x);
        f_load(x: &[f32; 8]) -> __m256 = _mm256_loadu_ps(x.as_ptr());
        f_add(a: __m256, b: __m256) -> __m256 = _mm256_add_ps(a, b);
        f_sub(a: __m256, b: __m256) -> __m256 = _mm256_sub_ps(a, b);
        f_mul(a: __m256, b: __m256) -> __m256 = _mm256_mul_ps(a, b);
        f_div(a: __m256, b: __m256) -> __m256 = _mm256_div_ps(a, b);
        f_min(a: __m256, b: __m256) -> __m256 = _mm256_min_ps(a, b);
        f_max(a: __m256, b: __m256) -> __m256 = _mm256_max_ps(a, b);
        f_sqrt(a: __m256) -> __m256 = _mm256_sqrt_ps(a);
        f_floor(a: __m256) -> __m256 = _mm256_floor_ps(a);
        f_lt(a: __m256, b: __m256) -> __m256 = _mm256_cmp_ps::<_CMP_LT_OQ>(a, b);
        f_le(a: __m256, b: __m256) -> __m256 = _mm256_cmp_ps::<_CMP_LE_OQ>(a, b);
        f_eq(a: __m256, b: __m256) -> __m256 = _mm256_cmp_ps::<_CMP_EQ_OQ>(a, b);
        f_select(mask: __m256, yes: __m256, no: __m256) -> __m256 = _mm256_blendv_ps(no, yes, mask);
        f_bits(a: __m256) -> __m256i = _mm256_castps_si256(a);
        f_to_i32(a: __m256) -> __m256i = _mm256_cvttps_epi32(a);
        f_range(a: __m256) -> [f32; 2] = {
            let (low, high) = (_mm256_castps256_ps128(a), _mm256_extractf128_ps::<1>(a));
            let (least, greatest) = (_mm_min_ps(low, high), _mm_max_ps(low, high));
            let least = _mm_min_ps(least, _mm_movehl_ps(least, least));
            let greatest = _mm_max_ps(greatest, _mm_movehl_ps(greatest, greatest));
            let least = _mm_min_ss(least, _mm_shuffle_ps::<1>(least, least));
            let greatest = _mm_max_ss(greatest, _mm_shuffle_ps::<1>(greatest, greatest));
            [_mm_cvtss_f32(least), _mm_cvtss_f32(greatest)]
        };
        u_splat(x: u32) -> __m256i = _mm256_set1_epi32(x as i32);
        u_load(x: &[u32; 8]) -> __m256i = _mm256_loadu_si256(x.as_ptr().cast());
        u_add(a: __m256i, b: __m256i) -> __m256i = _mm256_add_epi32(a, b);
        u_sub(a: __m256i, b: __m256i) -> __m256i = _mm256_sub_epi32(a, b);
        u_mul(a: __m256i, b: __m256i) -> __m256i = _mm256_mullo_epi32(a, b);
        u_and(a: __m256i, b: __m256i) -> __m256i = _mm256_and_si256(a, b);
        u_or(a: __m256i, b: __m256i) -> __m256i = _mm256_or_si256(a, b);
        u_xor(a: __m256i, b: __m256i) -> __m256i = _mm256_xor_si256(a, b);
        u_shl(a: __m256i, by: u32) -> __m256i = _mm256_sll_epi32(a, _mm_cvtsi32_si128(by as i32));
        u_shr(a: __m256i, by: u32) -> __m256i = _mm256_srl_epi32(a, _mm_cvtsi32_si128(by as i32));
        u_shr_signed(a: __m256i, by: u32) -> __m256i =
            _mm256_sra_epi32(a, _mm_cvtsi32_si128(by as i32));
        u_shl_each(a: __m256i, by: __m256i) -> __m256i = _mm256_sllv_epi32(a, by);
        u_shr_each(a: __m256i, by: __m256i) -> __m256i = _mm256_srlv_epi32(a, by);
        u_eq(a: __m256i, b: __m256i) -> __m256 = _mm256_castsi256_ps(_mm256_cmpeq_epi32(a, b));
        u_as_floats(a: __m256i) -> __m256 = _mm256_castsi256_ps(a);
        i32_to_f(a: __m256i) -> __m256 = _mm256_cvtepi32_ps(a);
        m_and(a: __m256, b: __m256) -> __m256 = _mm256_and_ps(a, b);
        m_or(a: __m256, b: __m256) -> __m256 = _mm256_or_ps(a, b);
        m_and_not(a: __m256, b: __m256) -> __m256 = _mm256_andnot_ps(b, a);
        m_bits(a: __m256) -> u8 = _mm256_movemask_ps(a) as u8;
    }

    #[inline(always)]
    fn f_store(x: __m256) -> [f32; 8] {
        let mut stored = [0.0; 8];
        // SAFETY: AVX2 was found, and there is room for eight.
        unsafe { _mm256_storeu_ps(stored.as_mut_ptr(), x) };
        stored
    }

    #[inline(always)]
    fn u_store(x: __m256i) -> [u32; 8] {
        let mut stored = [0; 8];
        // SAFETY: AVX2 was found, and there is room for eight.
        unsafe { _mm256_storeu_si256(stored.as_mut_ptr().cast(), x) };
        stored
    }

    #[inline(always)]
    fn f_gather(table: &[f32], index: __m256i) -> __m256 {
        let index = checked(index, table.len());
        // SAFETY: AVX2 was found, and all indices are within the table.
        unsafe { _mm256_i32gather_ps::<4>(table.as_ptr(), index) }
    }

    #[inline(always)]
    fn u_gather(table: &[u32], index: __m256i) -> __m256i {
        let index = checked(index, table.len());
        // SAFETY: AVX2 was found, and all indices are within the table.
        unsafe { _mm256_i32gather_epi32::<4>(table.as_ptr().cast(), index) }
    }

    #[inline(always)]
    fn u_mul_high(a: __m256i, b: __m256i) -> __m256i {
        // SAFETY: AVX2 was found.
        unsafe {
            let even = _mm256_srli_epi64::<32>(_mm256_mul_epu32(a, b));
            let odd = _mm256_mul_epu32(_mm256_srli_epi64::<32>(a), _mm256_srli_epi64::<32>(b));
            _mm256_blend_epi32::<0b1010_1010>(even, odd)
        }
    }

    #[inline(always)]
    fn u_reverse_bits(a: __m256i) -> __m256i {
        // SAFETY: AVX2 was found.
        unsafe {
            // Bytes from last to first, and their halves by tables of four bits reversed.
            let swap = _mm_setr_epi8(3, 2, 1, 0, 7, 6, 5, 4, 11, 10, 9, 8, 15, 14, 13, 12);
            let upper = _mm_setr_epi8(
                0, -128, 64, -64, 32, -96, 96, -32, 16, -112, 80, -48, 48, -80, 112, -16,
            );
            let lower = _mm_setr_epi8(0, 8, 4, 12, 2, 10, 6, 14, 1, 9, 5, 13, 3, 11, 7, 15);
            let upper = _mm256_broadcastsi128_si256(upper);
            let lower = _mm256_broadcastsi128_si256(lower);
            let swapped = _mm256_shuffle_epi8(a, _mm256_broadcastsi128_si256(swap));
            let half = _mm256_set1_epi8(0x0F);
            let low = _mm256_and_si256(swapped, half);
            let high = _mm256_and_si256(_mm256_srli_epi16::<4>(swapped), half);
            _mm256_or_si256(_mm256_shuffle_epi8(upper, low), _mm256_shuffle_epi8(lower, high))
        }
    }

    #[inline(always)]
    fn u_or_lanes(a: __m256i) -> u32 {
        // SAFETY: AVX2 was found.
        unsafe {
            let four = _mm_or_si128(_mm256_castsi256_si128(a), _mm256_extracti128_si256::<1>(a));
            let two = _mm_or_si128(four, _mm_shuffle_epi32::<0b01_00_11_10>(four));
            let one = _mm_or_si128(two, _mm_shuffle_epi32::<0b10_11_00_01>(two));
            _mm_cvtsi128_si32(one) as u32
        }
    }

    #[inline(always)]
    fn u_select(mask: __m256, yes: __m256i, no: __m256i) -> __m256i {
        // SAFETY: AVX2 was found.
        unsafe { _mm256_blendv_epi8(no, yes, _mm256_castps_si256(mask)) }
    }

    #[inline(always)]
    fn m_from_bits(bits: u8) -> __m256 {
        // SAFETY: AVX2 was found.
        unsafe {
            let each = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
            let set = _mm256_and_si256(_mm256_set1_epi32(i32::from(bits)), each);
            _mm256_castsi256_ps(_mm256_cmpeq_epi32(set, each))
        }
    }
}

/// Indices that are within a table of `length` entries: others become its last.
#[inline(always)]
fn checked(index: __m256i, length: usize) -> __m256i {
    assert!(length > 0, "nothing can be taken from an empty table");
    let last = (length - 1).min(i32::MAX as usize) as i32;
    // SAFETY: AVX2 was found.
    unsafe { _mm256_min_epu32(index, _mm256_set1_epi32(last)) }
}
