//! A request for steps in time.

use crate::description::error::SolveError;
use crate::dynamics::variation::Variation;
use crate::ode::{LEAST_RELATIVE, Method};

/// How environments step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum StepMethod {
    /// The classical Runge-Kutta method of order 4 (W. Kutta 1901), one step in each `dt`.
    Even,
    /// An embedded pair, with steps as wide as its tolerances allow within the whole time, `dt` the first
    /// that it tries.
    Controlled {
        /// The pair.
        pair: Method,
        /// Relative tolerance of the speeds; also the absolute tolerance of the coordinates, in rad or as a
        /// part of the mechanism's size.
        relative: f64,
        /// Absolute tolerances of coordinates and speeds, if they are given.
        absolute: Option<[f64; 2]>,
    },
}

impl StepMethod {
    /// Refuses tolerances that no step meets.
    pub(super) fn check(self) -> Result<(), SolveError> {
        let Self::Controlled { relative, absolute, .. } = self else { return Ok(()) };
        let is_absolute = absolute.is_none_or(|[of_q, of_speed]| of_q > 0.0 && of_speed > 0.0);
        if is_absolute && (LEAST_RELATIVE..1.0).contains(&relative) {
            return Ok(());
        }
        Err(SolveError::Shape(format!(
            "tolerances {relative:e} and {absolute:?}: the relative one must be from {LEAST_RELATIVE:.1e} to below 1, \
             absolute ones above 0"
        )))
    }
}

/// Environments, each a state of a design, and the steps that they make.
#[derive(Debug, Clone, Copy)]
pub struct StepRequest<'a> {
    /// Dimensions: the first of every design, then the second of every design, and so on.
    pub dimensions: &'a [f64],
    /// Assembly signs, +1 or −1 for every dyad with two solutions.
    pub signs: &'a [i8],
    /// Coordinates and speeds of the drivers: designs × environments × drivers.
    pub q: &'a [f64],
    /// See `q`.
    pub speed: &'a [f64],
    /// Efforts of the drivers, N·m or N, in that layout, or one for all.
    pub effort: &'a [f64],
    /// Whether the motors act, too.
    pub has_motors: bool,
    /// Numbers of bodies, loads and motors that differ from machine to machine. May be empty.
    pub variations: &'a [Variation<'a>],
    /// Time of a step, s.
    pub dt: f64,
    /// Number of steps.
    pub steps: u64,
    /// How they are made.
    pub method: StepMethod,
    /// Whether an environment that cannot go on keeps its last state; else it has NaN.
    pub holds: bool,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn checked(relative: f64, absolute: Option<[f64; 2]>) -> bool {
        let pair = Method::DormandPrince54;
        StepMethod::Controlled { pair, relative, absolute }.check().is_ok()
    }

    #[test]
    fn tolerances_that_no_step_meets_are_refused() {
        assert!(StepMethod::Even.check().is_ok());
        assert!(checked(1e-6, None) && checked(1e-6, Some([1e-9, f64::INFINITY])));
        for relative in [0.0, -1e-6, 1.0, f64::NAN] {
            assert!(!checked(relative, None), "{relative}");
        }
        for absolute in [[0.0, 1.0], [1.0, -1.0], [f64::NAN, 1.0]] {
            assert!(!checked(1e-6, Some(absolute)), "{absolute:?}");
        }
    }
}
