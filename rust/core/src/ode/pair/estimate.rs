//! The error of a step from its embedded formulas.

use crate::math::lanes::Real;

/// A fine error estimate, scaled by the step width, that exceeds all earlier ones by this factor
/// shows a solution that changes within a step. The quotient of the two estimates is then too
/// optimistic: a step of a machine with an error of 12 tolerances passed as 0.995.
const ABRUPT_RATIO: f64 = 6.0;
/// Least fraction of the fine estimate that then counts as the error. Among ratios from 2 to 6 and
/// fractions from 0.05 to 0.3 this keeps the energy of all of 714 random machines within 0.98 of 10
/// rtol (0.05 that of one only within 2.0), for 0.4 % more steps; with 0.3 the last steps before a dead
/// point begin to depend on rounding.
const ABRUPT_FRACTION: f64 = 0.25;
/// Steps of a smooth interval before the estimates are compared: earlier estimates show too little of the
/// solution, and a piece of a table has only a few steps.
const WARM_UP_STEPS: u32 = 2;

/// An error in tolerances, e / (a + r max(|y|, |z|)) (Hairer, Nørsett & Wanner I, eq. II.4.10).
#[inline(always)]
pub(crate) fn in_tolerances<R: Real>(error: R, [absolute, relative]: [R; 2], y: R, z: R) -> R {
    let scale = absolute + relative * y.abs().max(z.abs());
    // Without an absolute tolerance a component may stay at zero: 0/0 must count as 0.
    error / scale.max(R::splat(f64::MIN_POSITIVE))
}

/// What the estimates of the steps of a smooth interval have shown.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Estimate {
    /// Fine error estimate divided by |h|⁶: of the attempted step, and the greatest of the accepted
    /// steps since the smooth interval began.
    fine: f64,
    greatest: f64,
    /// Number of those accepted steps.
    accepted: u32,
}

impl Estimate {
    /// Error of a step relative to the tolerance, acceptable up to 1, from the mean squares of the estimates
    /// of a unit step.
    ///
    /// With two estimates, e = e₅² / √(e₅² + 0.01 e₃²) (Hairer, Nørsett & Wanner I, II.10). This
    /// treats them as terms of a series and holds only while they change little from step to step.
    pub(crate) fn error(&mut self, fine: f64, coarse: Option<f64>, h: f64) -> f64 {
        let error = match coarse {
            None => fine.sqrt(),
            Some(_) if fine == 0.0 => 0.0,
            Some(coarse) => fine / (fine + 0.01 * coarse).sqrt(),
        };
        let fine = fine.sqrt();
        self.fine = fine / (h * h * h * h * h).abs();
        let is_abrupt = self.accepted >= WARM_UP_STEPS && self.fine > ABRUPT_RATIO * self.greatest;
        let error = if is_abrupt { error.max(ABRUPT_FRACTION * fine) } else { error };
        // An overflow gives NaN: the error is then too large, not unknown.
        if error.is_nan() { f64::INFINITY } else { error * h.abs() }
    }

    /// The step is accepted.
    pub(crate) fn accept(&mut self) {
        self.greatest = self.greatest.max(self.fine);
        self.accepted = self.accepted.saturating_add(1);
    }
}
