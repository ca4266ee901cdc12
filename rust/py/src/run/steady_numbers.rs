//! The numbers of a steady state for Python.

use assur::dynamics::{Extreme, Steady};
use pyo3::prelude::*;

/// Numbers of a steady state: the multiplier, the moment that keeps the speed, N·m, the work of the
/// motors, J, the flywheel, kg·m², and the extreme speeds.
#[derive(IntoPyObject)]
pub(crate) struct SteadyNumbers {
    multiplier: f64,
    found_moment: f64,
    motor_work: f64,
    inertia: f64,
    least: ExtremeFields,
    greatest: ExtremeFields,
}

/// An extreme value and its coordinate.
#[derive(IntoPyObject)]
struct ExtremeFields {
    at: f64,
    value: f64,
}

impl From<Extreme> for ExtremeFields {
    fn from(Extreme { at, value }: Extreme) -> Self {
        Self { at, value }
    }
}

impl SteadyNumbers {
    pub(crate) fn of(steady: &Steady) -> Self {
        let [least, greatest] = steady.extremes();
        Self {
            multiplier: steady.multiplier,
            found_moment: steady.moment,
            motor_work: steady.drive,
            inertia: steady.flywheel,
            least: least.into(),
            greatest: greatest.into(),
        }
    }
}
