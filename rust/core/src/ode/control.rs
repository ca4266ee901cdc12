//! How wide a step is.

use libm::pow;

use super::stages::{Block, Refusal, Scale, Stages};
use super::system::System;
use super::tableau::Tableau;

/// Part of the step that would just meet the tolerance, so that few steps are in vain.
const SAFETY: f64 = 0.9;
/// Part of its width that is left of a step at the least.
const LEAST: f64 = 0.2;
/// By how much a step grows at the most.
const MOST: f64 = 8.0;
/// Smaller errors say little of the ones to come: they are mostly rounding and luck.
const LEAST_ERROR: f64 = 1e-4;
/// Weight β of the error before the last one (0.04 for DOPRI5 in Hairer's program). More of it
/// calms the widths where stability holds them, less makes them wider where it does not.
const MEMORY: f64 = 0.04;

/// Proportional-integral control, h·SAFETY·eₙ^(0.75β − 1/p)·eₙ₋₁^β (Gustafsson, Control
/// theoretic techniques for stepsize selection in explicit Runge-Kutta methods, ACM TOMS 17
/// (1991); Hairer & Wanner II, IV.2, eq. 2.43).
#[derive(Debug)]
pub(super) struct Control {
    power: f64,
    before: f64,
    rejected: bool,
}

impl Control {
    pub(super) fn new(tableau: &Tableau) -> Self {
        let power = 1.0 / f64::from(tableau.order) - 0.75 * MEMORY;
        Self { power, before: LEAST_ERROR, rejected: false }
    }

    /// By how much the next step is wider than one that was good.
    pub(super) fn accepted(&mut self, error: f64) -> f64 {
        let growth = SAFETY * pow(error, -self.power) * pow(self.before, MEMORY);
        // A step that has just failed is no reason to grow.
        let most = if self.rejected { 1.0 } else { MOST };
        self.before = error.max(LEAST_ERROR);
        self.rejected = false;
        growth.clamp(LEAST, most)
    }

    /// By how much a step is to shrink after too large an error.
    pub(super) fn rejected(&mut self, error: f64) -> f64 {
        self.rejected = true;
        (SAFETY * pow(error, -self.power)).clamp(LEAST, 1.0)
    }

    /// By how much a step is to shrink that met something not there.
    pub(super) fn refused(&mut self) -> f64 {
        self.rejected = true;
        0.5
    }
}

/// Width of a first step (Hairer, Nørsett & Wanner I, II.4, "starting step size"): one that makes
/// an error of 0.01 in Euler's formula, and then one by the second derivative it shows. Not wider
/// than `most`; `way` is its sign. `probe` is work space.
pub(super) fn first_width<S: System>(
    stages: &mut Stages,
    system: &mut S,
    scale: &Scale,
    (t, y): (f64, &[Block]),
    (most, way): (f64, f64),
    probe: &mut [Block],
) -> Result<f64, S::Error> {
    /// A size below which nothing can be said of a problem's own width, and the width then.
    const NOTHING: (f64, f64) = (1e-5, 1e-6);
    let size = |e: &[Block]| scale.square_sum(e, y, y).sqrt();
    let (d0, d1) = (size(y), size(stages.rates(0)));
    let euler = if d0 < NOTHING.0 || d1 < NOTHING.0 { NOTHING.1 } else { 0.01 * d0 / d1 };
    let euler = euler.min(most);
    let rates = stages.rates(0);
    for ((p, y), k) in probe.iter_mut().zip(y).zip(rates) {
        *p = std::array::from_fn(|l| y[l] + way * euler * k[l]);
    }
    let spare = stages.tableau.stages;
    match stages.evaluate(system, spare, t + way * euler, probe) {
        Ok(()) => {}
        Err(Refusal::System(error)) => return Err(error),
        // Near an edge: begin with less, the steps will find out.
        Err(_) => return Ok(1e-3 * euler),
    }
    for ((p, f1), f0) in probe.iter_mut().zip(stages.rates(spare)).zip(stages.rates(0)) {
        *p = std::array::from_fn(|l| (f1[l] - f0[l]) / euler);
    }
    let d2 = size(probe);
    let largest = d1.max(d2);
    let order = f64::from(stages.tableau.order);
    let own = if largest <= 1e-15 {
        NOTHING.1.max(1e-3 * euler)
    } else {
        pow(0.01 / largest, 1.0 / order)
    };
    let width = own.min(100.0 * euler).min(most);
    Ok(if width > 0.0 { width } else { euler })
}
