//! Registers of four numbers.

#[allow(clippy::wildcard_imports, reason = "names that all begin with _mm")]
use std::arch::x86_64::*;
use std::mem::MaybeUninit;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

use super::LINE;
use crate::math::lanes::{Mask, Real};

/// Four numbers, by AVX2: a value of this type exists only in functions compiled for AVX2, and
/// these are called only where [`crate::math::simd::Simd::best`] found it.
#[derive(Debug, Clone, Copy)]
#[repr(transparent)]
pub(crate) struct F64x4(__m256d);

operators!(F64x4: _mm256_add_pd, _mm256_sub_pd, _mm256_mul_pd, _mm256_div_pd);
bitwise!(F64x4, 4, __m256d: _mm256_and_pd, _mm256_or_pd, _mm256_xor_pd, _mm256_andnot_pd);

/// Lanes of [`F64x4`]: all ones or all zeros.
#[derive(Debug, Clone, Copy)]
pub(crate) struct M64x4(F64x4);

impl Mask for M64x4 {
    const NONE: Self = Self(F64x4::ZERO);
    #[inline(always)]
    fn any(self) -> bool {
        self.bits() != 0
    }
    #[inline(always)]
    fn all(self) -> bool {
        self.bits() == 0b1111
    }
    #[inline(always)]
    fn lane(self, lane: usize) -> bool {
        self.bits() >> lane & 1 != 0
    }
    #[inline(always)]
    fn bits(self) -> u32 {
        // SAFETY: the contract of the type.
        unsafe { _mm256_movemask_pd(self.0.0) }.cast_unsigned()
    }
    #[inline(always)]
    fn and(self, other: Self) -> Self {
        Self(self.0.and(other.0))
    }
    #[inline(always)]
    fn or(self, other: Self) -> Self {
        Self(self.0.or(other.0))
    }
    #[inline(always)]
    fn not(self) -> Self {
        let ones = F64x4::constant(f64::from_bits(u64::MAX));
        Self(self.0.and_not(ones))
    }
}

impl Real for F64x4 {
    type Mask = M64x4;
    common!(
        4,
        __m256d,
        _mm256_set1_pd,
        _mm256_sqrt_pd,
        _mm256_max_pd,
        _mm256_min_pd,
        _mm256_stream_pd
    );
    #[inline(always)]
    fn zip(self, other: Self) -> [Self; 2] {
        // SAFETY: the contract of the type.
        unsafe {
            let even = _mm256_unpacklo_pd(self.0, other.0);
            let odd = _mm256_unpackhi_pd(self.0, other.0);
            [
                Self(_mm256_permute2f128_pd::<0x20>(even, odd)),
                Self(_mm256_permute2f128_pd::<0x31>(even, odd)),
            ]
        }
    }
    #[inline(always)]
    fn unzip(self, other: Self) -> [Self; 2] {
        // SAFETY: the contract of the type.
        unsafe {
            let first = _mm256_permute2f128_pd::<0x20>(self.0, other.0);
            let last = _mm256_permute2f128_pd::<0x31>(self.0, other.0);
            [Self(_mm256_unpacklo_pd(first, last)), Self(_mm256_unpackhi_pd(first, last))]
        }
    }
    #[inline(always)]
    fn floor(self) -> Self {
        // SAFETY: the contract of the type.
        Self(unsafe { _mm256_floor_pd(self.0) })
    }
    #[inline(always)]
    fn lt(self, other: Self) -> M64x4 {
        // SAFETY: the contract of the type.
        M64x4(Self(unsafe { _mm256_cmp_pd::<_CMP_LT_OQ>(self.0, other.0) }))
    }
    #[inline(always)]
    fn le(self, other: Self) -> M64x4 {
        // SAFETY: the contract of the type.
        M64x4(Self(unsafe { _mm256_cmp_pd::<_CMP_LE_OQ>(self.0, other.0) }))
    }
    #[inline(always)]
    fn bit(self, bit: u32) -> M64x4 {
        // SAFETY: the contract of the type. The bit goes to the sign: negative integers have it.
        unsafe {
            let shift = _mm_cvtsi32_si128(63 - bit.cast_signed());
            let sign = _mm256_sll_epi64(_mm256_castpd_si256(self.0), shift);
            let negative = _mm256_cmpgt_epi64(_mm256_setzero_si256(), sign);
            M64x4(Self(_mm256_castsi256_pd(negative)))
        }
    }
    #[inline(always)]
    fn select(mask: M64x4, yes: Self, no: Self) -> Self {
        // SAFETY: the contract of the type.
        Self(unsafe { _mm256_blendv_pd(no.0, yes.0, mask.0.0) })
    }
}
