//! Registers of eight numbers.

#[allow(clippy::wildcard_imports, reason = "names that all begin with _mm")]
use std::arch::x86_64::*;
use std::mem::MaybeUninit;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

use super::LINE;
use crate::math::lanes::{Mask, Real};

/// Eight numbers, by AVX-512 F and DQ: a value of this type exists only in functions compiled for
/// these, which are called only where [`crate::math::simd::Simd::best`] found them.
#[derive(Debug, Clone, Copy)]
#[repr(transparent)]
pub(crate) struct F64x8(__m512d);

operators!(F64x8: _mm512_add_pd, _mm512_sub_pd, _mm512_mul_pd, _mm512_div_pd);
bitwise!(F64x8, 8, __m512d: _mm512_and_pd, _mm512_or_pd, _mm512_xor_pd, _mm512_andnot_pd);

/// Lanes of [`F64x8`]: one bit each.
#[derive(Debug, Clone, Copy)]
pub(crate) struct M64x8(__mmask8);

impl Mask for M64x8 {
    const NONE: Self = Self(0);
    #[inline(always)]
    fn any(self) -> bool {
        self.0 != 0
    }
    #[inline(always)]
    fn all(self) -> bool {
        self.0 == u8::MAX
    }
    #[inline(always)]
    fn lane(self, lane: usize) -> bool {
        self.0 >> lane & 1 != 0
    }
    #[inline(always)]
    fn bits(self) -> u32 {
        self.0.into()
    }
    #[inline(always)]
    fn and(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }
    #[inline(always)]
    fn or(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
    #[inline(always)]
    fn not(self) -> Self {
        Self(!self.0)
    }
}

impl Real for F64x8 {
    type Mask = M64x8;
    common!(
        8,
        __m512d,
        _mm512_set1_pd,
        _mm512_sqrt_pd,
        _mm512_max_pd,
        _mm512_min_pd,
        _mm512_stream_pd
    );
    #[inline(always)]
    fn zip(self, other: Self) -> [Self; 2] {
        // SAFETY: the contract of the type.
        unsafe {
            let first = _mm512_setr_epi64(0, 8, 1, 9, 2, 10, 3, 11);
            let last = _mm512_setr_epi64(4, 12, 5, 13, 6, 14, 7, 15);
            [
                Self(_mm512_permutex2var_pd(self.0, first, other.0)),
                Self(_mm512_permutex2var_pd(self.0, last, other.0)),
            ]
        }
    }
    #[inline(always)]
    fn unzip(self, other: Self) -> [Self; 2] {
        // SAFETY: the contract of the type.
        unsafe {
            let even = _mm512_setr_epi64(0, 2, 4, 6, 8, 10, 12, 14);
            let odd = _mm512_setr_epi64(1, 3, 5, 7, 9, 11, 13, 15);
            [
                Self(_mm512_permutex2var_pd(self.0, even, other.0)),
                Self(_mm512_permutex2var_pd(self.0, odd, other.0)),
            ]
        }
    }
    #[inline(always)]
    fn floor(self) -> Self {
        // SAFETY: the contract of the type.
        Self(unsafe {
            _mm512_roundscale_pd::<{ _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC }>(self.0)
        })
    }
    #[inline(always)]
    fn lt(self, other: Self) -> M64x8 {
        // SAFETY: the contract of the type.
        M64x8(unsafe { _mm512_cmp_pd_mask::<_CMP_LT_OQ>(self.0, other.0) })
    }
    #[inline(always)]
    fn le(self, other: Self) -> M64x8 {
        // SAFETY: the contract of the type.
        M64x8(unsafe { _mm512_cmp_pd_mask::<_CMP_LE_OQ>(self.0, other.0) })
    }
    #[inline(always)]
    fn bit(self, bit: u32) -> M64x8 {
        // SAFETY: the contract of the type. The bit goes to the sign.
        unsafe {
            let shift = _mm_cvtsi32_si128(63 - bit.cast_signed());
            M64x8(_mm512_movepi64_mask(_mm512_sll_epi64(_mm512_castpd_si512(self.0), shift)))
        }
    }
    #[inline(always)]
    fn select(mask: M64x8, yes: Self, no: Self) -> Self {
        // SAFETY: the contract of the type.
        Self(unsafe { _mm512_mask_blend_pd(mask.0, no.0, yes.0) })
    }
}
