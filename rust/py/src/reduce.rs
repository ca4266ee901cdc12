//! The machine referred to its drivers, for Python.

use assur::dynamics::{DrivenPositions, Machine, ReducedTable, Variation};
use assur::{FirstFailure, Mechanism, SolveError, Status};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::exceptions::PyBaseException;
use pyo3::prelude::*;

use crate::parallel_map::parallel_map;
use crate::{detach, error_map, reserve};

type Flat<'py> = PyReadonlyArray1<'py, f64>;
type Array<'py> = Bound<'py, PyArray1<f64>>;
/// Mass matrices, their derivatives, moments, potential energies, statuses; the exception of the
/// first position that failed.
pub(crate) type Arrays<'py> = (
    Array<'py>,
    Array<'py>,
    Array<'py>,
    Array<'py>,
    Bound<'py, PyArray1<u8>>,
    Option<Py<PyBaseException>>,
);

/// Positions up to which a call need not check for signals.
const FEW_POSITIONS: usize = 20_000;

/// See `Machine.reduce`; the inputs are dimensions, coordinates, speeds and values of functions.
pub(crate) fn reduce<'py>(
    py: Python<'py>,
    (mechanism, machine, variations): (&Mechanism, &Machine, &[Variation<'_>]),
    inputs: [&Flat<'py>; 4],
    sense: &[f64],
    threads: Option<usize>,
    report: &[usize],
) -> PyResult<Arrays<'py>> {
    let drivers = mechanism.q0().len();
    let numbers: usize = inputs.iter().map(|array| array.as_array().len()).sum();
    let _room =
        reserve::room_for(py, numbers + drivers * drivers * drivers * inputs[1].as_array().len())?;
    let [dimensions, q, speed, callback_values] =
        inputs.map(|array| array.as_slice().map(<[f64]>::to_vec));
    let (dimensions, q, speed, callback_values) = (dimensions?, q?, speed?, callback_values?);
    let size = mechanism.dimensions().len();
    let designs = dimensions.len() / size;
    let divides = |all: &[f64]| designs > 0 && all.len().is_multiple_of(designs);
    let fits = dimensions.len().is_multiple_of(size)
        && q.len() == speed.len()
        && [&q, &callback_values].iter().all(|all| divides(all))
        && (q.len() / designs.max(1)).is_multiple_of(drivers);
    if !fits {
        return Err(error_map::solve(SolveError::Shape("the arrays do not fit".into())));
    }
    let part_of = |all: &[f64], design: usize| {
        let share = all.len() / designs;
        all[design * share..(design + 1) * share].to_vec()
    };
    let all = detach::run(py, q.len() <= FEW_POSITIONS, |cancel| {
        let reduce_design = |design: usize| {
            let [q, speed, callback_values] =
                [&q, &speed, &callback_values].map(|all| part_of(all, design));
            let values: Vec<f64> =
                (0..size).map(|index| dimensions[index * designs + design]).collect();
            let positions =
                DrivenPositions { q: &q, speed: &speed, sense, external: &callback_values };
            machine.of(variations, design).reduce(mechanism, &values, positions, cancel)
        };
        parallel_map(designs, 1, threads, cancel, &reduce_design)
    })?;
    let positions = q.len() / drivers;
    let count = all.iter().map(|rows| rows.status.iter().filter(|&&s| failed(s)).count()).sum();
    let first = all.iter().enumerate().find_map(|(design, rows)| {
        let (row, failure) = rows.failure.clone()?;
        Some(FirstFailure { row: design * (positions / designs) + row, failure, count })
    });
    let failure =
        first.map(|first| error_map::first_failure(&first, report, positions).into_value(py));
    Ok(arrays(py, &all, failure))
}

/// Whether a status is above `NearSingular`, which still has analogues.
fn failed(status: Status) -> bool {
    status as u8 > Status::NearSingular as u8
}

pub(crate) fn arrays<'py>(
    py: Python<'py>,
    all: &[ReducedTable],
    failure: Option<Py<PyBaseException>>,
) -> Arrays<'py> {
    let array = |column: fn(&ReducedTable) -> &[f64]| {
        PyArray1::from_vec(py, all.iter().flat_map(|rows| column(rows).iter().copied()).collect())
    };
    let statuses = all.iter().flat_map(|rows| rows.status.iter().map(|&status| status as u8));
    (
        array(|r| &r.inertia),
        array(|r| &r.d_inertia),
        array(|r| &r.moment),
        array(|r| &r.potential),
        PyArray1::from_vec(py, statuses.collect()),
        failure,
    )
}
