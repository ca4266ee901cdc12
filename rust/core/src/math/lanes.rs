//! The number types of the solver: one number, or several at once.
//!
//! [`Real`] is a plain `f64`, or several as [`Lanes`] or in a register. Each operation is the IEEE 754 one in
//! each lane separately (no fused multiplication, no library function but exact ones). A lane
//! therefore has the same bits as the scalar, on every machine and whatever the other lanes hold.

use std::fmt::Debug;
use std::mem::MaybeUninit;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

/// Numbers in the longest vector.
pub const LANES: usize = 8;

/// A boolean for each lane.
pub trait Mask: Copy + Debug {
    /// False in every lane.
    const NONE: Self;
    /// Whether some lane is true.
    fn any(self) -> bool;
    /// Whether every lane is true.
    fn all(self) -> bool;
    /// The value of one lane.
    fn lane(self, lane: usize) -> bool;
    /// One bit per lane, that of the first lane the last.
    fn bits(self) -> u32;
    /// Lane-wise and.
    #[must_use]
    fn and(self, other: Self) -> Self;
    /// Lane-wise or.
    #[must_use]
    fn or(self, other: Self) -> Self;
    /// Lane-wise not.
    #[must_use]
    fn not(self) -> Self;
}

/// A number, or a vector of numbers.
pub trait Real:
    Copy
    + Debug
    + Default
    + PartialEq
    + Add<Output = Self>
    + AddAssign
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// Result of a comparison.
    type Mask: Mask;
    /// Number of lanes.
    const LANES: usize;
    /// Zero in every lane.
    const ZERO: Self;
    /// One in every lane.
    const ONE: Self;
    /// The same number in every lane.
    fn splat(value: f64) -> Self;
    /// Calls `of` for the number of each lane.
    fn from_lanes(of: impl FnMut(usize) -> f64) -> Self;
    /// The number of one lane.
    fn lane(self, lane: usize) -> f64;
    /// Square root.
    #[must_use]
    fn sqrt(self) -> Self;
    /// Absolute value.
    #[must_use]
    fn abs(self) -> Self;
    /// `self` where it is greater than `other`, else `other` (also where either is NaN).
    #[must_use]
    fn max(self, other: Self) -> Self;
    /// `self` where it is less than `other`, else `other`.
    #[must_use]
    fn min(self, other: Self) -> Self;
    /// Greatest integer not above it.
    #[must_use]
    fn floor(self) -> Self;
    /// Magnitude of `self` with the sign of `sign`.
    #[must_use]
    fn copysign(self, sign: Self) -> Self;
    /// Whether `self` < `other`.
    fn lt(self, other: Self) -> Self::Mask;
    /// Whether `self` ≤ `other`.
    fn le(self, other: Self) -> Self::Mask;
    /// Whether it is finite.
    #[inline(always)]
    fn finite(self) -> Self::Mask {
        self.abs().lt(Self::splat(f64::INFINITY))
    }
    /// Whether a bit of the representation is set (0: the last of the significand).
    fn bit(self, bit: u32) -> Self::Mask;
    /// `yes` where the mask is true, else `no`.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;
    /// The numbers of both in turn: those of the first lanes, then those of the last.
    #[inline(always)]
    #[must_use]
    fn zip(self, other: Self) -> [Self; 2] {
        let mut numbers = [0.0; 2 * LANES];
        for lane in 0..Self::LANES {
            numbers[2 * lane] = self.lane(lane);
            numbers[2 * lane + 1] = other.lane(lane);
        }
        let half = |first: usize| Self::from_lanes(|lane| numbers[first + lane]);
        [half(0), half(Self::LANES)]
    }
    /// Writes its numbers to the front of a slice that is long enough.
    #[inline(always)]
    fn write(self, out: &mut [MaybeUninit<f64>]) {
        for lane in 0..Self::LANES {
            out[lane] = MaybeUninit::new(self.lane(lane));
        }
    }
    /// Asks for memory that will soon be written.
    #[inline(always)]
    fn prefetch(_numbers: &[MaybeUninit<f64>]) {}
}

impl Mask for bool {
    const NONE: Self = false;
    #[inline(always)]
    fn any(self) -> bool {
        self
    }
    #[inline(always)]
    fn all(self) -> bool {
        self
    }
    #[inline(always)]
    fn lane(self, _: usize) -> bool {
        self
    }
    #[inline(always)]
    fn bits(self) -> u32 {
        self.into()
    }
    #[inline(always)]
    fn and(self, other: Self) -> Self {
        self & other
    }
    #[inline(always)]
    fn or(self, other: Self) -> Self {
        self | other
    }
    #[inline(always)]
    fn not(self) -> Self {
        !self
    }
}

impl Real for f64 {
    type Mask = bool;
    const LANES: usize = 1;
    const ZERO: Self = 0.0;
    const ONE: Self = 1.0;
    #[inline(always)]
    fn splat(value: f64) -> Self {
        value
    }
    #[inline(always)]
    fn from_lanes(mut of: impl FnMut(usize) -> f64) -> Self {
        of(0)
    }
    #[inline(always)]
    fn lane(self, _: usize) -> f64 {
        self
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.sqrt()
    }
    #[inline(always)]
    fn abs(self) -> Self {
        self.abs()
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        if self > other { self } else { other }
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        if self < other { self } else { other }
    }
    #[inline(always)]
    fn floor(self) -> Self {
        self.floor()
    }
    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        self.copysign(sign)
    }
    #[inline(always)]
    fn lt(self, other: Self) -> bool {
        self < other
    }
    #[inline(always)]
    fn le(self, other: Self) -> bool {
        self <= other
    }
    #[inline(always)]
    fn bit(self, bit: u32) -> bool {
        self.to_bits() >> bit & 1 != 0
    }
    #[inline(always)]
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }
}

/// Some numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lanes<const N: usize = LANES>(pub [f64; N]);

impl<const N: usize> Default for Lanes<N> {
    fn default() -> Self {
        Self([0.0; N])
    }
}

/// Some booleans: words with all bits set or none.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LaneMask<const N: usize = LANES>([u64; N]);

impl<const N: usize> LaneMask<N> {
    #[inline(always)]
    fn each(of: impl Fn(usize) -> bool) -> Self {
        let mut out = [0; N];
        for lane in 0..N {
            out[lane] = if of(lane) { u64::MAX } else { 0 };
        }
        Self(out)
    }
}

impl<const N: usize> Mask for LaneMask<N> {
    const NONE: Self = Self([0; N]);
    #[inline(always)]
    fn any(self) -> bool {
        let mut some = 0;
        for lane in 0..N {
            some |= self.0[lane];
        }
        some != 0
    }
    #[inline(always)]
    fn all(self) -> bool {
        let mut every = u64::MAX;
        for lane in 0..N {
            every &= self.0[lane];
        }
        every != 0
    }
    #[inline(always)]
    fn lane(self, lane: usize) -> bool {
        self.0[lane] != 0
    }
    #[inline(always)]
    fn bits(self) -> u32 {
        let mut bits = 0;
        for lane in 0..N {
            bits |= u32::from(self.0[lane] != 0) << lane;
        }
        bits
    }
    #[inline(always)]
    fn and(mut self, other: Self) -> Self {
        for lane in 0..N {
            self.0[lane] &= other.0[lane];
        }
        self
    }
    #[inline(always)]
    fn or(mut self, other: Self) -> Self {
        for lane in 0..N {
            self.0[lane] |= other.0[lane];
        }
        self
    }
    #[inline(always)]
    fn not(mut self) -> Self {
        for lane in 0..N {
            self.0[lane] = !self.0[lane];
        }
        self
    }
}

impl<const N: usize> Lanes<N> {
    #[inline(always)]
    fn each(of: impl Fn(usize) -> f64) -> Self {
        let mut out = [0.0; N];
        for lane in 0..N {
            out[lane] = of(lane);
        }
        Self(out)
    }
}

impl<const N: usize> Add for Lanes<N> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self::each(|i| self.0[i] + other.0[i])
    }
}

impl<const N: usize> AddAssign for Lanes<N> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<const N: usize> Sub for Lanes<N> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self::each(|i| self.0[i] - other.0[i])
    }
}

impl<const N: usize> Mul for Lanes<N> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self::each(|i| self.0[i] * other.0[i])
    }
}

impl<const N: usize> Div for Lanes<N> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        Self::each(|i| self.0[i] / other.0[i])
    }
}

impl<const N: usize> Neg for Lanes<N> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::each(|i| -self.0[i])
    }
}

impl<const N: usize> Real for Lanes<N> {
    type Mask = LaneMask<N>;
    const LANES: usize = N;
    const ZERO: Self = Self([0.0; N]);
    const ONE: Self = Self([1.0; N]);
    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self([value; N])
    }
    #[inline(always)]
    fn from_lanes(mut of: impl FnMut(usize) -> f64) -> Self {
        let mut out = [0.0; N];
        for lane in 0..N {
            out[lane] = of(lane);
        }
        Self(out)
    }
    #[inline(always)]
    fn lane(self, lane: usize) -> f64 {
        self.0[lane]
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self::each(|i| self.0[i].sqrt())
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self::each(|i| self.0[i].abs())
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self::each(|i| if self.0[i] > other.0[i] { self.0[i] } else { other.0[i] })
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self::each(|i| if self.0[i] < other.0[i] { self.0[i] } else { other.0[i] })
    }
    #[inline(always)]
    fn floor(self) -> Self {
        Self::each(|i| self.0[i].floor())
    }
    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        Self::each(|i| self.0[i].copysign(sign.0[i]))
    }
    #[inline(always)]
    fn lt(self, other: Self) -> LaneMask<N> {
        LaneMask::each(|i| self.0[i] < other.0[i])
    }
    #[inline(always)]
    fn le(self, other: Self) -> LaneMask<N> {
        LaneMask::each(|i| self.0[i] <= other.0[i])
    }
    #[inline(always)]
    fn bit(self, bit: u32) -> LaneMask<N> {
        LaneMask::each(|i| self.0[i].to_bits() >> bit & 1 != 0)
    }
    #[inline(always)]
    fn select(mask: LaneMask<N>, yes: Self, no: Self) -> Self {
        Self::each(|i| {
            f64::from_bits(yes.0[i].to_bits() & mask.0[i] | no.0[i].to_bits() & !mask.0[i])
        })
    }
}
