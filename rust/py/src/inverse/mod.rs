//! The inverse question for Python.

mod rows;

use std::num::NonZeroUsize;

use assur::Answers;
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;

use crate::assemblies::AssemblyNumbers;
use crate::detach::{self, catch_panic};
use crate::mechanism::Mechanism;
use crate::motion::short_calls::{FEW_ASSEMBLIES, FEW_SIGNS};
use crate::{error_map, reserve};
use rows::Rows;

/// A position: coordinates, where its assembly stands, the assembly.
type Position = (Vec<f64>, Vec<f64>, AssemblyNumbers);

type Flat<'py> = PyReadonlyArray1<'py, f64>;
type Numbers<'py> = Bound<'py, PyArray1<f64>>;
type Statuses<'py> = Bound<'py, PyArray1<u8>>;

/// A mechanism that coordinates drive in place of its drivers.
#[pyclass(frozen, module = "assur._core")]
pub(crate) struct Inverse {
    inner: assur::Inverse,
}

#[pymethods]
impl Inverse {
    /// `mechanism`: the original, driven by coordinates with these names; `bases`: for every one the dimension
    /// from which its value is measured.
    #[new]
    fn new(
        original: PyRef<'_, Mechanism>,
        mechanism: PyRef<'_, Mechanism>,
        names: Vec<String>,
        bases: Vec<Option<String>>,
    ) -> PyResult<Self> {
        catch_panic(|| {
            let mechanism = mechanism.inner.clone();
            let inverse = assur::Inverse::new(&original.inner, mechanism, &names, &bases);
            Ok(Self { inner: inverse.map_err(error_map::solve)? })
        })
    }

    /// All positions of a design at which the coordinates have these values; the paths of the search that
    /// found none, and whether no position can be missing.
    fn find(
        &self,
        py: Python<'_>,
        original: PyRef<'_, Mechanism>,
        dimensions: PyReadonlyArray1<'_, f64>,
        values: Vec<f64>,
    ) -> PyResult<(Vec<Position>, Vec<String>, bool)> {
        let dimensions = dimensions.as_slice()?.to_vec();
        let (small, original) = (self.is_quick(&original), &original.inner);
        let answers = detach::run(py, small, |cancel| {
            self.inner.find(original, &dimensions, &values, Some(cancel))
        })?;
        let Answers { found, failures, is_complete } = answers.map_err(error_map::solve)?;
        let positions =
            found.into_iter().map(|answer| (answer.q, answer.at, answer.assembly.into()));
        let failures = failures.iter().map(ToString::to_string).collect();
        Ok((positions.collect(), failures, is_complete))
    }

    /// The coordinates of all positions of designs for rows of values, NaN up to the greatest number of
    /// positions of a row; that number, the number of each row, and its status. `rows`: dimensions, values,
    /// and whether each design has its own values.
    fn find_rows<'py>(
        &self,
        py: Python<'py>,
        original: PyRef<'py, Mechanism>,
        rows: (Flat<'py>, Flat<'py>, bool),
        threads: Option<NonZeroUsize>,
    ) -> PyResult<(Numbers<'py>, usize, Bound<'py, PyArray1<i64>>, Statuses<'py>)> {
        let numbers = rows.0.as_array().len() + 8 * rows.1.as_array().len();
        let _room = reserve::room_for(py, numbers)?;
        let rows = Rows::new(&self.inner, &original.inner, rows)?;
        let small = self.is_quick(&original) && rows.count() < FEW_ASSEMBLIES;
        let found = detach::run(py, small, |cancel| rows.find(threads, cancel))?;
        let found = found.map_err(error_map::solve)?;
        let counts = PyArray1::from_vec(py, found.counts);
        let q = PyArray1::from_vec(py, found.q);
        Ok((q, found.most, counts, PyArray1::from_vec(py, found.status)))
    }

    /// The coordinates of designs that are followed along rows of values, from `start` on (for all designs or
    /// for each), and the statuses.
    fn follow<'py>(
        &self,
        py: Python<'py>,
        original: PyRef<'py, Mechanism>,
        signs: Vec<i8>,
        start: Flat<'py>,
        rows: (Flat<'py>, Flat<'py>, bool),
        threads: Option<NonZeroUsize>,
    ) -> PyResult<(Numbers<'py>, Statuses<'py>)> {
        let numbers = rows.0.as_array().len() + 4 * rows.1.as_array().len();
        let _room = reserve::room_for(py, numbers)?;
        let rows = Rows::new(&self.inner, &original.inner, rows)?;
        let start = start.as_slice()?.to_vec();
        let small = self.is_quick(&original) && rows.count() < FEW_ASSEMBLIES;
        let followed =
            detach::run(py, small, |cancel| rows.follow((&signs, &start), threads, cancel))?;
        let (q, status) = followed.map_err(error_map::solve)?;
        Ok((PyArray1::from_vec(py, q), PyArray1::from_vec(py, status)))
    }
}

impl Inverse {
    /// Whether one search takes only milliseconds at most.
    fn is_quick(&self, original: &Mechanism) -> bool {
        let (structure, signs) = (original.inner.structure(), original.inner.signs().len());
        self.inner.is_quick() && structure.class() <= 2 && signs < FEW_SIGNS
    }
}
