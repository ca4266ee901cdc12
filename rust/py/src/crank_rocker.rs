//! The crank-rocker with friction over flat arrays; Python checks, broadcasts and reshapes.

use assur::crank_rocker as core;
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;

use crate::metrics::same;

type Flat<'py> = PyReadonlyArray1<'py, f64>;
type Array<'py> = Bound<'py, PyArray1<f64>>;

/// Positions (8 rows), rates (8 rows) and speeds of C (2 rows), one row after another; NaN where
/// the coupler does not reach. `lengths`: crank, coupler, rocker, ground, one after another.
#[pyfunction]
pub(crate) fn crank_rocker_solve<'py>(
    py: Python<'py>,
    phi1: Flat<'py>,
    lengths: [Flat<'py>; 4],
    rates: [Flat<'py>; 2],
    printed: bool,
) -> PyResult<Array<'py>> {
    let phi1 = phi1.as_slice()?.to_vec();
    let mut columns = Vec::new();
    for column in lengths.iter().chain(&rates) {
        let column = column.as_slice()?.to_vec();
        same(phi1.len(), column.len())?;
        columns.push(column);
    }
    let assembly = if printed { core::Assembly::Printed } else { core::Assembly::Other };
    let rows = py.detach(|| {
        let count = phi1.len();
        let mut rows = vec![f64::NAN; 18 * count];
        for i in 0..count {
            let at = |column: usize| columns[column][i];
            let lengths = [at(0), at(1), at(2), at(3)];
            let found = core::position(phi1[i], lengths, assembly, [at(4), at(5)]);
            let Some((p, r)) = found else { continue };
            let numbers = [p, r.of].map(|p| {
                [p.s, p.phi3_first, p.phi3_second, p.beta, p.phi2, p.phi3, p.gamma23, p.gamma]
            });
            for (row, x) in numbers.into_iter().flatten().chain(r.v_c).enumerate() {
                rows[row * count + i] = x;
            }
        }
        rows
    });
    Ok(PyArray1::from_vec(py, rows))
}

/// The type by Grashof, as the field names it.
#[pyfunction]
pub(crate) fn crank_rocker_grashof(lengths: [f64; 4], tolerance: f64) -> &'static str {
    match core::grashof(lengths, tolerance) {
        core::Grashof::CrankRocker => "crank-rocker",
        core::Grashof::RockerCrank => "rocker-crank",
        core::Grashof::DoubleCrank => "double-crank",
        core::Grashof::DoubleRocker => "double-rocker",
        core::Grashof::TripleRocker => "triple-rocker",
        core::Grashof::ChangePoint => "change-point",
    }
}

/// The three margins, and whether the crank turns.
#[pyfunction]
pub(crate) fn crank_rocker_turns(lengths: [f64; 4]) -> ([f64; 3], bool) {
    (core::margins(lengths), core::crank_turns(lengths))
}

/// Least and greatest relative ground.
#[pyfunction]
pub(crate) fn crank_rocker_ground_range(
    coupler: f64,
    rocker: f64,
    margins: [f64; 2],
    gamma_min: f64,
) -> [f64; 2] {
    core::ground_range(coupler, rocker, margins, gamma_min)
}

/// Least and greatest transmission angle over a turn.
#[pyfunction]
pub(crate) fn crank_rocker_extremes(lengths: [f64; 4]) -> Option<[f64; 2]> {
    core::transmission_extremes(lengths)
}

/// Least transmission angle that friction allows.
#[pyfunction]
pub(crate) fn crank_rocker_least_gamma(friction: [f64; 4], rocker: f64) -> Option<f64> {
    core::least_gamma(friction, rocker)
}
