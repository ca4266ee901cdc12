//! Registers of two numbers.

#[allow(clippy::wildcard_imports, reason = "names that all begin with _mm")]
use std::arch::x86_64::*;
use std::mem::MaybeUninit;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

use super::LINE;
use crate::math::lanes::{Mask, Real};

/// Two numbers, by SSE2, which every x86-64 has.
#[derive(Debug, Clone, Copy)]
#[repr(transparent)]
pub(crate) struct F64x2(__m128d);

operators!(F64x2: _mm_add_pd, _mm_sub_pd, _mm_mul_pd, _mm_div_pd);
bitwise!(F64x2, 2, __m128d: _mm_and_pd, _mm_or_pd, _mm_xor_pd, _mm_andnot_pd);
wide_mask!(M64x2, F64x2, 2, _mm_movemask_pd);

impl Real for F64x2 {
    type Mask = M64x2;
    common!(2, __m128d, _mm_set1_pd, _mm_sqrt_pd, _mm_max_pd, _mm_min_pd, _mm_stream_pd);
    #[inline(always)]
    fn zip(self, other: Self) -> [Self; 2] {
        // SAFETY: the contract of the type.
        unsafe { [Self(_mm_unpacklo_pd(self.0, other.0)), Self(_mm_unpackhi_pd(self.0, other.0))] }
    }
    #[inline(always)]
    fn unzip(self, other: Self) -> [Self; 2] {
        // With two numbers in a register both are the same.
        self.zip(other)
    }
    /// SSE2 has no instruction for it: numbers below 2^52 are rounded by adding and subtracting
    /// 2^52, and lowered by 1 where that rounded up.
    #[inline(always)]
    fn floor(self) -> Self {
        let whole = Self::splat((1_u64 << 52) as f64);
        let size = self.abs();
        let rounded = ((size + whole) - whole).copysign(self);
        let lowered = Self::select(self.lt(rounded), rounded - Self::ONE, rounded);
        Self::select(size.lt(whole), lowered, self)
    }
    #[inline(always)]
    fn lt(self, other: Self) -> M64x2 {
        // SAFETY: SSE2.
        M64x2(Self(unsafe { _mm_cmplt_pd(self.0, other.0) }))
    }
    #[inline(always)]
    fn le(self, other: Self) -> M64x2 {
        // SAFETY: SSE2.
        M64x2(Self(unsafe { _mm_cmple_pd(self.0, other.0) }))
    }
    #[inline(always)]
    fn bit(self, bit: u32) -> M64x2 {
        // SAFETY: SSE2. The bit goes to the sign, and the sign to all bits of its word of 32 and
        // then to the other word of the number.
        unsafe {
            let shift = _mm_cvtsi32_si128(63 - bit.cast_signed());
            let sign = _mm_sll_epi64(_mm_castpd_si128(self.0), shift);
            let filled = _mm_srai_epi32::<31>(sign);
            M64x2(Self(_mm_castsi128_pd(_mm_shuffle_epi32::<0b11_11_01_01>(filled))))
        }
    }
    #[inline(always)]
    fn select(mask: M64x2, yes: Self, no: Self) -> Self {
        mask.0.and(yes).or(mask.0.and_not(no))
    }
}
