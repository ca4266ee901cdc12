//! Positions of rest for Python.

use assur::FirstFailure;
use assur::dynamics::{Equilibria, Equilibrium};
use numpy::PyArray1;
use pyo3::exceptions::PyBaseException;
use pyo3::prelude::*;

use crate::error_map;

/// Coordinates, whether stable, stiffnesses, frequencies; ends of indifferent intervals; jumps;
/// whether the search was cut short, and whether no position has a moment; the exception of a range without
/// positions.
pub(crate) type Found<'py> = (
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<bool>>,
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<f64>>,
    Vec<[f64; 2]>,
    Vec<f64>,
    bool,
    bool,
    Option<Py<PyBaseException>>,
);

pub(crate) fn arrays<'py>(py: Python<'py>, equilibria: &Equilibria) -> Found<'py> {
    let column = |entry: fn(&Equilibrium) -> f64| {
        PyArray1::from_vec(py, equilibria.isolated.iter().map(entry).collect())
    };
    let failure = equilibria.failure.clone().map(|failure| {
        let first = FirstFailure { row: 0, failure, count: 1 };
        error_map::first_failure(&first, &[], 1).into_value(py)
    });
    (
        column(|equilibrium| equilibrium.q),
        PyArray1::from_vec(
            py,
            equilibria.isolated.iter().map(|equilibrium| equilibrium.is_stable).collect(),
        ),
        column(|equilibrium| equilibrium.stiffness),
        column(|equilibrium| equilibrium.frequency),
        equilibria.indifferent.clone(),
        equilibria.jumps.clone(),
        equilibria.is_incomplete,
        equilibria.is_empty,
        failure,
    )
}
