//! The vector registers of x86-64 as [`Real`]: two, four or eight numbers.
//!
//! Every operation is one or a few instructions, without a branch and without memory, so that code
//! generic over [`Real`] stays in registers. The portable [`super::pair::Pair`] gives the same
//! bits.

#![allow(unsafe_code, reason = "instructions beyond the baseline; see the contract of each type")]

#[allow(clippy::wildcard_imports, reason = "seventy names that all begin with _mm")]
use std::arch::x86_64::*;
use std::mem::MaybeUninit;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

use super::lanes::{Mask, Real};

/// Numbers in a line of the cache.
const LINE: usize = 8;

/// The operators of a register type.
macro_rules! operators {
    ($name:ident: $add:ident, $sub:ident, $mul:ident, $div:ident) => {
        impl Add for $name {
            type Output = Self;
            #[inline(always)]
            fn add(self, other: Self) -> Self {
                // SAFETY: the contract of the type.
                Self(unsafe { $add(self.0, other.0) })
            }
        }

        impl AddAssign for $name {
            #[inline(always)]
            fn add_assign(&mut self, other: Self) {
                *self = *self + other;
            }
        }

        impl Sub for $name {
            type Output = Self;
            #[inline(always)]
            fn sub(self, other: Self) -> Self {
                // SAFETY: the contract of the type.
                Self(unsafe { $sub(self.0, other.0) })
            }
        }

        impl Mul for $name {
            type Output = Self;
            #[inline(always)]
            fn mul(self, other: Self) -> Self {
                // SAFETY: the contract of the type.
                Self(unsafe { $mul(self.0, other.0) })
            }
        }

        impl Div for $name {
            type Output = Self;
            #[inline(always)]
            fn div(self, other: Self) -> Self {
                // SAFETY: the contract of the type.
                Self(unsafe { $div(self.0, other.0) })
            }
        }

        impl Neg for $name {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                self.xor(Self::splat(-0.0))
            }
        }

        impl PartialEq for $name {
            fn eq(&self, other: &Self) -> bool {
                (0..Self::LANES).all(|lane| self.lane(lane) == other.lane(lane))
            }
        }

        impl Default for $name {
            #[inline(always)]
            fn default() -> Self {
                Self::ZERO
            }
        }
    };
}

/// The operations of [`Real`] that all register types have in one form.
macro_rules! common {
    (
        $lanes:literal, $register:ty,
        $splat:ident, $sqrt:ident, $max:ident, $min:ident, $stream:ident
    ) => {
        const LANES: usize = $lanes;
        const ZERO: Self = Self::constant(0.0);
        const ONE: Self = Self::constant(1.0);
        #[inline(always)]
        fn splat(value: f64) -> Self {
            // SAFETY: the contract of the type.
            Self(unsafe { $splat(value) })
        }
        #[inline(always)]
        fn from_lanes(mut of: impl FnMut(usize) -> f64) -> Self {
            let mut numbers = [0.0; $lanes];
            for lane in 0..$lanes {
                numbers[lane] = of(lane);
            }
            // SAFETY: a register is as many numbers side by side.
            Self(unsafe { std::mem::transmute::<[f64; $lanes], $register>(numbers) })
        }
        #[inline(always)]
        fn lane(self, lane: usize) -> f64 {
            // SAFETY: a register is as many numbers side by side.
            let numbers = unsafe { std::mem::transmute::<$register, [f64; $lanes]>(self.0) };
            numbers[lane]
        }
        #[inline(always)]
        fn write(self, out: &mut [MaybeUninit<f64>]) {
            type Numbers = [MaybeUninit<f64>; $lanes];
            // SAFETY: a register is as many numbers side by side.
            let numbers = unsafe { std::mem::transmute::<$register, Numbers>(self.0) };
            out[..$lanes].copy_from_slice(&numbers);
        }
        #[inline(always)]
        fn stream(self, out: &mut [MaybeUninit<f64>]) {
            let out = &mut out[..$lanes];
            if out.as_ptr().addr().is_multiple_of(std::mem::align_of::<$register>()) {
                // SAFETY: the slice has the length and alignment of the register. The caller calls
                // `fence` before anyone reads or writes these numbers again.
                unsafe { $stream(out.as_mut_ptr().cast(), self.0) };
            } else {
                self.write(out);
            }
        }
        #[inline(always)]
        fn fence() {
            // SAFETY: a fence touches no memory.
            unsafe { _mm_sfence() };
        }
        #[inline(always)]
        fn prefetch(numbers: &[MaybeUninit<f64>]) {
            for line in numbers.chunks(LINE) {
                // SAFETY: a prefetch touches no memory that the program sees.
                unsafe { _mm_prefetch::<_MM_HINT_ET0>(line.as_ptr().cast()) };
            }
        }
        #[inline(always)]
        fn sqrt(self) -> Self {
            // SAFETY: the contract of the type.
            Self(unsafe { $sqrt(self.0) })
        }
        #[inline(always)]
        fn abs(self) -> Self {
            Self::splat(-0.0).and_not(self)
        }
        #[inline(always)]
        fn max(self, other: Self) -> Self {
            // SAFETY: the contract of the type. The second operand where either is NaN.
            Self(unsafe { $max(self.0, other.0) })
        }
        #[inline(always)]
        fn min(self, other: Self) -> Self {
            // SAFETY: the contract of the type. The second operand where either is NaN.
            Self(unsafe { $min(self.0, other.0) })
        }
        #[inline(always)]
        fn copysign(self, sign: Self) -> Self {
            let bit = Self::splat(-0.0);
            bit.and_not(self).or(bit.and(sign))
        }
    };
}

/// Bitwise operations of a register type, and a constant.
macro_rules! bitwise {
    ($name:ident, $lanes:literal, $register:ty: $and:ident, $or:ident, $xor:ident, $and_not:ident) => {
        impl $name {
            const fn constant(value: f64) -> Self {
                // SAFETY: a register is as many numbers side by side.
                Self(unsafe { std::mem::transmute::<[f64; $lanes], $register>([value; $lanes]) })
            }
            #[inline(always)]
            fn and(self, other: Self) -> Self {
                // SAFETY: the contract of the type.
                Self(unsafe { $and(self.0, other.0) })
            }
            #[inline(always)]
            fn or(self, other: Self) -> Self {
                // SAFETY: the contract of the type.
                Self(unsafe { $or(self.0, other.0) })
            }
            #[inline(always)]
            fn xor(self, other: Self) -> Self {
                // SAFETY: the contract of the type.
                Self(unsafe { $xor(self.0, other.0) })
            }
            /// The bits of `other` that are not in `self`.
            #[inline(always)]
            fn and_not(self, other: Self) -> Self {
                // SAFETY: the contract of the type.
                Self(unsafe { $and_not(self.0, other.0) })
            }
        }
    };
}

/// A mask whose lanes are all ones or all zeros.
macro_rules! wide_mask {
    ($mask:ident, $name:ident, $lanes:literal, $movemask:ident) => {
        #[doc = concat!("Lanes of [`", stringify!($name), "`]: all ones or all zeros.")]
        #[derive(Debug, Clone, Copy)]
        pub(crate) struct $mask($name);

        impl Mask for $mask {
            const NONE: Self = Self($name::ZERO);
            #[inline(always)]
            fn any(self) -> bool {
                self.bits() != 0
            }
            #[inline(always)]
            fn all(self) -> bool {
                self.bits() == (1 << $lanes) - 1
            }
            #[inline(always)]
            fn lane(self, lane: usize) -> bool {
                self.bits() >> lane & 1 != 0
            }
            #[inline(always)]
            fn bits(self) -> u32 {
                // SAFETY: the contract of the type.
                unsafe { $movemask(self.0.0) }.cast_unsigned()
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
                let ones = $name::constant(f64::from_bits(u64::MAX));
                Self(self.0.and_not(ones))
            }
        }
    };
}

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

/// Four numbers, by AVX2: a value of this type exists only in functions compiled for AVX2, and
/// these are called only where [`super::simd::Simd::best`] found it.
#[derive(Debug, Clone, Copy)]
#[repr(transparent)]
pub(crate) struct F64x4(__m256d);

operators!(F64x4: _mm256_add_pd, _mm256_sub_pd, _mm256_mul_pd, _mm256_div_pd);
bitwise!(F64x4, 4, __m256d: _mm256_and_pd, _mm256_or_pd, _mm256_xor_pd, _mm256_andnot_pd);
wide_mask!(M64x4, F64x4, 4, _mm256_movemask_pd);

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

/// Eight numbers, by AVX-512 F and DQ: a value of this type exists only in functions compiled for
/// these, which are called only where [`super::simd::Simd::best`] found them.
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

#[cfg(test)]
mod tests {
    use std::cmp::Ordering;

    use super::*;

    /// Numbers that meet every rule of IEEE 754.
    const NUMBERS: [f64; 16] = [
        0.0,
        -0.0,
        1.5,
        -2.5,
        0.3,
        -0.3,
        4503599627370495.5,
        -4503599627370497.0,
        1e300,
        -1e-310,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::NAN,
        3.0,
        -1.0,
        6755399441055745.0,
    ];

    /// Compares every operation of a register with that of a single number, bit by bit.
    #[inline(always)]
    fn compare<R: Real>() {
        for i in 0..NUMBERS.len() {
            for j in 0..NUMBERS.len() {
                let number = |at: usize, lane: usize| NUMBERS[(at + lane) % NUMBERS.len()];
                let (x, y) =
                    (R::from_lanes(|lane| number(i, lane)), R::from_lanes(|lane| number(j, lane)));
                let mut written = [MaybeUninit::new(0.0); 16];
                let (first, last) = written.split_at_mut(R::LANES);
                let [before, after] = x.zip(y);
                before.write(first);
                after.write(last);
                for lane in 0..R::LANES {
                    let zipped = if lane < R::LANES / 2 { before } else { after };
                    let at = 2 * lane % R::LANES;
                    assert_eq!(zipped.lane(at).to_bits(), number(i, lane).to_bits());
                    assert_eq!(zipped.lane(at + 1).to_bits(), number(j, lane).to_bits());
                    // SAFETY: all were initialised.
                    let pair = [0, 1].map(|k| unsafe { written[2 * lane + k].assume_init() });
                    assert_eq!(
                        pair.map(f64::to_bits),
                        [zipped.lane(at), zipped.lane(at + 1)].map(f64::to_bits)
                    );
                }
                for lane in 0..R::LANES {
                    let (a, b) = (number(i, lane), number(j, lane));
                    assert_eq!(R::splat(a).lane(lane).to_bits(), a.to_bits());
                    let pairs = [
                        (x + y, a + b),
                        (x - y, a - b),
                        (x * y, a * b),
                        (x / y, a / b),
                        (-x, -a),
                        (x.sqrt(), a.sqrt()),
                        (x.abs(), a.abs()),
                        (x.max(y), Real::max(a, b)),
                        (x.min(y), Real::min(a, b)),
                        (x.floor(), a.floor()),
                        (x.copysign(y), a.copysign(b)),
                        (R::select(x.lt(y), x, y), if a < b { a } else { b }),
                    ];
                    for (index, (ours, theirs)) in pairs.into_iter().enumerate() {
                        let same = ours.lane(lane).to_bits() == theirs.to_bits();
                        let nan = ours.lane(lane).is_nan() && theirs.is_nan();
                        assert!(same || nan, "operation {index} of {a} and {b}");
                    }
                    let masks = [
                        (x.lt(y), a < b),
                        (x.lt(y), x.lt(y).bits() >> lane & 1 != 0),
                        (x.le(y), a <= b),
                        (x.finite(), a.is_finite()),
                        (x.bit(0), a.to_bits() & 1 != 0),
                        (x.bit(1), a.to_bits() & 2 != 0),
                        (x.lt(y).not(), a.partial_cmp(&b) != Some(Ordering::Less)),
                        (x.lt(y).or(x.le(R::ZERO)), a < b || a <= 0.0),
                        (x.lt(y).and(x.le(R::ZERO)), a < b && a <= 0.0),
                    ];
                    for (index, (ours, theirs)) in masks.into_iter().enumerate() {
                        assert_eq!(ours.lane(lane), theirs, "mask {index} of {a} and {b}");
                        let lanes = || (0..R::LANES).map(|lane| ours.lane(lane));
                        assert_eq!(
                            (ours.any(), ours.all()),
                            (lanes().any(|x| x), lanes().all(|x| x))
                        );
                    }
                }
            }
        }
    }

    #[target_feature(enable = "avx2")]
    fn avx2() {
        compare::<F64x4>();
    }

    #[target_feature(enable = "avx512f,avx512vl,avx512dq")]
    fn avx512() {
        compare::<F64x8>();
    }

    #[test]
    fn registers_do_what_single_numbers_do() {
        use crate::math::simd::Simd;
        compare::<F64x2>();
        for (simd, run) in [(Simd::Avx2, avx2 as unsafe fn()), (Simd::Avx512, avx512)] {
            if Simd::best() < simd {
                println!("{}: skipped, this processor has no such instructions", simd.name());
                continue;
            }
            // SAFETY: the processor has these instructions.
            unsafe { run() };
        }
    }
}
