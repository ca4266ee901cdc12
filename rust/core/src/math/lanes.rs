//! The number types of the solver: one number, or several at once.
//!
//! [`Real`] is a plain `f64`, two side by side, or several in a register. Each operation is the IEEE
//! 754 one in each lane separately (no fused multiplication, no library function unless it is exact).
//! So a lane has the same bits as the scalar, on every machine and for any numbers in the other lanes.

use std::fmt::Debug;
use std::mem::MaybeUninit;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

/// Numbers in the longest vector.
pub const LANES: usize = 8;

/// Where a number of a row lies in an array in blocks: eight rows after eight, of these number after number.
#[inline(always)]
#[must_use]
pub fn place_in_blocks(row: usize, width: usize, entry: usize) -> usize {
    (row / LANES * width + entry) * LANES + row % LANES
}

/// A boolean for each lane.
pub trait Mask: Copy + Debug + Send + 'static {
    /// False in every lane.
    const NONE: Self;
    /// Whether some lane is true.
    fn any(self) -> bool;
    /// Whether every lane is true.
    fn all(self) -> bool;
    /// The value of one lane.
    fn lane(self, lane: usize) -> bool;
    /// One bit per lane, the lowest for the first lane.
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
    + Send
    + 'static
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
    /// Numbers that a lane is made of in arrays: two of a number with a rate.
    const PARTS: usize = 1;
    /// Zero in every lane.
    const ZERO: Self;
    /// One in every lane.
    const ONE: Self;
    /// The same number in every lane.
    fn splat(value: f64) -> Self;
    /// Calls `number` for the number of each lane.
    fn from_lanes(number: impl FnMut(usize) -> f64) -> Self;
    /// The number of one lane.
    fn lane(self, lane: usize) -> f64;
    /// The same number in every lane, from its parts at the front of a slice.
    #[inline(always)]
    #[must_use]
    fn of_parts(numbers: &[f64]) -> Self {
        Self::splat(numbers[0])
    }
    /// Number `entry` of `width` of the rows from `row` on, in an array in [blocks](place_in_blocks).
    #[inline(always)]
    #[must_use]
    fn of_block(column: &[f64], row: usize, width: usize, entry: usize) -> Self {
        Self::read(&column[place_in_blocks(row, width, entry)..])
    }
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
    /// The numbers of both, alternating: a register for the first half of the lanes, then one for the
    /// second.
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
    /// The reverse of [`zip`](Self::zip): the even numbers of both, and the odd ones.
    #[inline(always)]
    #[must_use]
    fn unzip(self, other: Self) -> [Self; 2] {
        let mut numbers = [0.0; 2 * LANES];
        for lane in 0..Self::LANES {
            numbers[lane] = self.lane(lane);
            numbers[Self::LANES + lane] = other.lane(lane);
        }
        let part = |first: usize| Self::from_lanes(|lane| numbers[2 * lane + first]);
        [part(0), part(1)]
    }
    /// The numbers at the front of a slice that is long enough.
    #[inline(always)]
    #[must_use]
    fn read(values: &[f64]) -> Self {
        Self::from_lanes(|lane| values[lane])
    }
    /// Writes its numbers to the front of a slice that is long enough.
    #[inline(always)]
    fn write(self, out: &mut [MaybeUninit<f64>]) {
        for lane in 0..Self::LANES {
            out[lane] = MaybeUninit::new(self.lane(lane));
        }
    }
    /// The same to numbers that are there already.
    #[inline(always)]
    fn put(self, out: &mut [f64]) {
        for (lane, number) in out[..Self::LANES].iter_mut().enumerate() {
            *number = self.lane(lane);
        }
    }
    /// The same past the caches, if the slice is aligned for that. Code must not read or overwrite these
    /// numbers before [`fence`](Self::fence).
    #[inline(always)]
    fn stream(self, out: &mut [MaybeUninit<f64>]) {
        self.write(out);
    }
    /// Completes all writes past the caches.
    #[inline(always)]
    fn fence() {}
    /// Prefetches memory that will soon be written.
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
    fn from_lanes(mut number: impl FnMut(usize) -> f64) -> Self {
        number(0)
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
