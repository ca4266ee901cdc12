//! Control of the step width.

use libm::pow;

use super::pair::stages::{Block, Refusal, Scale, Stages};
use super::pair::tableau::Tableau;
use super::system::System;

/// Fraction of the width that would just meet the tolerance, so that few steps are rejected.
const SAFETY: f64 = 0.9;
/// Least ratio of a width to the one before.
const MIN_FACTOR: f64 = 0.2;
/// Greatest ratio of a width to the one before.
const MAX_FACTOR: f64 = 8.0;
/// Least error used in the control: smaller ones are mostly rounding and chance and predict nothing.
const MIN_ERROR: f64 = 1e-4;
/// Exponent β of the previous error (0.04 for DOPRI5 in Hairer's program). A greater one smooths
/// the widths where stability limits them, a smaller one gives wider steps elsewhere.
const BETA: f64 = 0.04;

/// Proportional-integral control, h·SAFETY·eₙ^(0.75β − 1/p)·eₙ₋₁^β (Gustafsson, Control
/// theoretic techniques for stepsize selection in explicit Runge-Kutta methods, ACM TOMS 17
/// (1991); Hairer & Wanner II, IV.2, eq. 2.43).
#[derive(Debug, Clone, Copy)]
pub(crate) struct Control {
    power: f64,
    previous_error: f64,
    rejected: bool,
}

impl Control {
    pub(crate) fn new(tableau: &Tableau) -> Self {
        let power = 1.0 / f64::from(tableau.order) - 0.75 * BETA;
        Self { power, previous_error: MIN_ERROR, rejected: false }
    }

    /// Ratio of the next width to that of an accepted step.
    pub(crate) fn factor_after_accept(&mut self, error: f64) -> f64 {
        let factor = SAFETY * pow(error, -self.power) * pow(self.previous_error, BETA);
        // No growth directly after a rejected step.
        let limit = if self.rejected { 1.0 } else { MAX_FACTOR };
        self.previous_error = error.max(MIN_ERROR);
        self.rejected = false;
        factor.clamp(MIN_FACTOR, limit)
    }

    /// Ratio of the next width to that of a step with too large an error.
    pub(crate) fn factor_after_reject(&mut self, error: f64) -> f64 {
        self.rejected = true;
        (SAFETY * pow(error, -self.power)).clamp(MIN_FACTOR, 1.0)
    }

    /// Ratio of the next width to that of a step that could not be evaluated.
    pub(crate) fn factor_after_refusal(&mut self) -> f64 {
        self.rejected = true;
        0.5
    }
}

/// A step goes to the end of its smooth interval if that widens it by at most this factor, so that no
/// sliver remains (Hairer's programs).
const LAST_STEP_STRETCH: f64 = 1.01;
/// The last steps of a smooth interval, up to this many, are made equal instead of leaving a narrow
/// one at its end: the same number of steps with smaller errors.
const EQUAL_STEPS: f64 = 4.0;
/// Least width of a step, in spacings of t: the stages of a narrower one coincide.
pub(crate) const MIN_STEP: f64 = 4.0;

/// The width of the next step, of which `remaining` is left and `proposed` would meet the tolerance, and whether
/// it is the last.
pub(crate) fn fitted(remaining: f64, proposed: f64) -> (f64, bool) {
    let steps_left = (remaining / (proposed * LAST_STEP_STRETCH)).ceil();
    if steps_left <= 1.0 {
        (remaining, true)
    } else if steps_left <= EQUAL_STEPS {
        (remaining / steps_left, false)
    } else {
        (proposed, false)
    }
}

/// Approximate distance from a number to the next.
pub(crate) fn spacing(t: f64) -> f64 {
    (t.abs() * f64::EPSILON).max(f64::MIN_POSITIVE)
}

/// Width of the first step (Hairer, Nørsett & Wanner I, II.4, "starting step size"): first one with
/// an error of about 0.01 in Euler's method, then one from the second derivative that this step
/// shows. Their formula adds numbers of different units, and so depends on the unit of t. Here its unit
/// is the time in which the state changes by itself. At most `limit`; `direction` is its sign. `probe` is
/// workspace.
pub(super) fn first_width<S: System>(
    stages: &mut Stages,
    system: &mut S,
    scale: &Scale,
    (t, y): (f64, &[Block]),
    (limit, direction): (f64, f64),
    probe: &mut [Block],
) -> Result<f64, S::Error> {
    /// A change by less than this many tolerances up to `limit` does not determine the width; and the part of
    /// `limit` that is then the unit.
    const NEGLIGIBLE: (f64, f64) = (1e-5, 1e-4);
    /// Euler's step as a part of the unit.
    const EULER: f64 = 0.01;
    let norm = |e: &[Block]| scale.square_sum(e, y, y).sqrt();
    let (d0, d1) = (norm(y).max(scale.usual_size), norm(stages.rates(0)));
    let unit = d0 / d1;
    let shows = d1 * limit >= NEGLIGIBLE.0 && unit > 0.0 && unit.is_finite();
    let unit = if shows { unit } else { NEGLIGIBLE.1 * limit };
    let euler = (EULER * unit).min(limit);
    let rates = stages.rates(0);
    for ((p, y), k) in probe.iter_mut().zip(y).zip(rates) {
        *p = std::array::from_fn(|l| y[l] + direction * euler * k[l]);
    }
    let spare = stages.tableau.stages;
    match stages.evaluate(system, spare, t + direction * euler, probe) {
        Ok(()) => {}
        Err(Refusal::System(error)) => return Err(error),
        // Near a domain boundary: start narrower and let the step control find the width.
        Err(_) => return Ok(1e-3 * euler),
    }
    for ((p, f1), f0) in probe.iter_mut().zip(stages.rates(spare)).zip(stages.rates(0)) {
        *p = std::array::from_fn(|l| (f1[l] - f0[l]) / euler);
    }
    let d2 = norm(probe);
    let largest = (d1 * unit).max(d2 * unit * unit);
    let order = f64::from(stages.tableau.order);
    let by_slope = if largest <= 1e-15 { euler } else { unit * pow(0.01 / largest, 1.0 / order) };
    let width = by_slope.min(100.0 * euler).min(limit);
    Ok(if width > 0.0 { width } else { euler })
}
