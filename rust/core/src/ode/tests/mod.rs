//! Tests of whole runs, and helpers shared by the tests of the parts.

pub(crate) mod breaks;
pub(crate) mod events;
pub(crate) mod limits;
pub(crate) mod orders;
pub(crate) mod problems;
pub(crate) mod trees;

use std::convert::Infallible;

use crate::ode::*;

pub(crate) const BOTH: [Method; 2] = [Method::DormandPrince54, Method::DormandPrince853];

/// A right-hand side defined everywhere.
pub(crate) struct Smooth<F>(F);

pub(crate) fn smooth<F: Fn(f64, &[f64], &mut [f64])>(f: F) -> Smooth<F> {
    Smooth(f)
}

impl<F: Fn(f64, &[f64], &mut [f64])> System for Smooth<F> {
    type Error = Infallible;

    fn rates(&mut self, t: f64, y: &[f64], rates: &mut [f64]) -> Result<(), Fault<Infallible>> {
        (self.0)(t, y, rates);
        Ok(())
    }
}

/// y'' = −y.
pub(crate) fn oscillate(_: f64, y: &[f64], rates: &mut [f64]) {
    rates[0] = y[1];
    rates[1] = -y[0];
}

/// Kepler's problem in a plane (x, y, x', y').
pub(crate) fn kepler(_: f64, y: &[f64], rates: &mut [f64]) {
    let cube = (y[0] * y[0] + y[1] * y[1]).powf(1.5);
    rates.copy_from_slice(&[y[2], y[3], -y[0] / cube, -y[1] / cube]);
}

/// The same relative and absolute tolerance.
pub(crate) fn tolerance(value: &f64) -> Options<'_> {
    let both = std::slice::from_ref(value);
    Options { relative: both, absolute: both, ..Options::default() }
}

pub(crate) fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}
