//! Two registers side by side: their operations are independent, so that one need not wait for the
//! other.

use std::mem::MaybeUninit;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

use super::lanes::{LANES, Mask, Real};

/// Twice the numbers of `R`, [`LANES`] at most.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Pair<R>(pub(super) R, pub(super) R);

/// [`LANES`] numbers, for any processor.
pub type Lanes = Pair<Pair<Pair<f64>>>;

/// Lanes of a pair.
#[derive(Debug, Clone, Copy)]
pub struct PairMask<R: Real>(pub(super) R::Mask, pub(super) R::Mask);

impl<R: Real> Mask for PairMask<R> {
    const NONE: Self = Self(R::Mask::NONE, R::Mask::NONE);
    #[inline(always)]
    fn any(self) -> bool {
        self.0.or(self.1).any()
    }
    #[inline(always)]
    fn all(self) -> bool {
        self.0.and(self.1).all()
    }
    #[inline(always)]
    fn lane(self, lane: usize) -> bool {
        if lane < R::LANES { self.0.lane(lane) } else { self.1.lane(lane - R::LANES) }
    }
    #[inline(always)]
    fn bits(self) -> u32 {
        self.0.bits() | self.1.bits() << R::LANES
    }
    #[inline(always)]
    fn and(self, other: Self) -> Self {
        Self(self.0.and(other.0), self.1.and(other.1))
    }
    #[inline(always)]
    fn or(self, other: Self) -> Self {
        Self(self.0.or(other.0), self.1.or(other.1))
    }
    #[inline(always)]
    fn not(self) -> Self {
        Self(self.0.not(), self.1.not())
    }
}

impl<R: Real> Add for Pair<R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0, self.1 + other.1)
    }
}

impl<R: Real> AddAssign for Pair<R> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<R: Real> Sub for Pair<R> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0, self.1 - other.1)
    }
}

impl<R: Real> Mul for Pair<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self(self.0 * other.0, self.1 * other.1)
    }
}

impl<R: Real> Div for Pair<R> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        Self(self.0 / other.0, self.1 / other.1)
    }
}

impl<R: Real> Neg for Pair<R> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0, -self.1)
    }
}

impl<R: Real> Real for Pair<R> {
    type Mask = PairMask<R>;
    const LANES: usize = 2 * R::LANES;
    const ZERO: Self = Self(R::ZERO, R::ZERO);
    const ONE: Self = Self(R::ONE, R::ONE);
    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self(R::splat(value), R::splat(value))
    }
    #[inline(always)]
    fn from_lanes(mut number: impl FnMut(usize) -> f64) -> Self {
        let mut numbers = [0.0; LANES];
        for lane in 0..Self::LANES {
            numbers[lane] = number(lane);
        }
        Self(R::from_lanes(|lane| numbers[lane]), R::from_lanes(|lane| numbers[R::LANES + lane]))
    }
    #[inline(always)]
    fn lane(self, lane: usize) -> f64 {
        if lane < R::LANES { self.0.lane(lane) } else { self.1.lane(lane - R::LANES) }
    }
    #[inline(always)]
    fn zip(self, other: Self) -> [Self; 2] {
        let ([a, b], [c, d]) = (self.0.zip(other.0), self.1.zip(other.1));
        [Self(a, b), Self(c, d)]
    }
    #[inline(always)]
    fn unzip(self, other: Self) -> [Self; 2] {
        let ([a, b], [c, d]) = (self.0.unzip(self.1), other.0.unzip(other.1));
        [Self(a, c), Self(b, d)]
    }
    #[inline(always)]
    fn read(values: &[f64]) -> Self {
        Self(R::read(values), R::read(&values[R::LANES..]))
    }
    #[inline(always)]
    fn prefetch(numbers: &[MaybeUninit<f64>]) {
        R::prefetch(numbers);
    }
    #[inline(always)]
    fn write(self, out: &mut [MaybeUninit<f64>]) {
        let (first, last) = out.split_at_mut(R::LANES);
        self.0.write(first);
        self.1.write(last);
    }
    #[inline(always)]
    fn stream(self, out: &mut [MaybeUninit<f64>]) {
        let (first, last) = out.split_at_mut(R::LANES);
        self.0.stream(first);
        self.1.stream(last);
    }
    #[inline(always)]
    fn fence() {
        R::fence();
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt(), self.1.sqrt())
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.abs(), self.1.abs())
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self(self.0.max(other.0), self.1.max(other.1))
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self(self.0.min(other.0), self.1.min(other.1))
    }
    #[inline(always)]
    fn floor(self) -> Self {
        Self(self.0.floor(), self.1.floor())
    }
    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        Self(self.0.copysign(sign.0), self.1.copysign(sign.1))
    }
    #[inline(always)]
    fn lt(self, other: Self) -> PairMask<R> {
        PairMask(self.0.lt(other.0), self.1.lt(other.1))
    }
    #[inline(always)]
    fn le(self, other: Self) -> PairMask<R> {
        PairMask(self.0.le(other.0), self.1.le(other.1))
    }
    #[inline(always)]
    fn bit(self, bit: u32) -> PairMask<R> {
        PairMask(self.0.bit(bit), self.1.bit(bit))
    }
    #[inline(always)]
    fn select(mask: PairMask<R>, yes: Self, no: Self) -> Self {
        Self(R::select(mask.0, yes.0, no.0), R::select(mask.1, yes.1, no.1))
    }
}
