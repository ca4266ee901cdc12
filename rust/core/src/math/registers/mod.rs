//! The vector registers of x86-64 as [`Real`]: four or eight numbers.
//!
//! One file for each family; the macros here write their common parts. Every operation is one or a few
//! instructions, without a branch and without memory, so that code generic over [`Real`] stays in registers.
//! The portable [`super::pair::Pair`] gives the same bits.

#![allow(unsafe_code, reason = "instructions beyond the baseline; see the contract of each type")]

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

/// The operations of [`Real`] that have the same form in all register types.
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
        fn from_lanes(mut number: impl FnMut(usize) -> f64) -> Self {
            let mut numbers = [0.0; $lanes];
            for lane in 0..$lanes {
                numbers[lane] = number(lane);
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
        fn read(values: &[f64]) -> Self {
            let mut numbers = [0.0; $lanes];
            numbers.copy_from_slice(&values[..$lanes]);
            // SAFETY: a register is as many numbers side by side.
            Self(unsafe { std::mem::transmute::<[f64; $lanes], $register>(numbers) })
        }
        #[inline(always)]
        fn write(self, out: &mut [MaybeUninit<f64>]) {
            type Numbers = [MaybeUninit<f64>; $lanes];
            // SAFETY: a register is as many numbers side by side.
            let numbers = unsafe { std::mem::transmute::<$register, Numbers>(self.0) };
            out[..$lanes].copy_from_slice(&numbers);
        }
        #[inline(always)]
        fn put(self, out: &mut [f64]) {
            // SAFETY: a register is as many numbers side by side.
            let numbers = unsafe { std::mem::transmute::<$register, [f64; $lanes]>(self.0) };
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

pub(crate) mod avx2;
pub(crate) mod avx512;
#[cfg(test)]
mod tests;
