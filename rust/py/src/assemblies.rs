//! All assemblies for Python.

use std::sync::atomic::AtomicBool;

use assur::{Assemblies, SolveError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::detach;
use crate::parallel_map::parallel_map;

/// Positions for which another thread pays off.
const MIN_PER_THREAD: usize = 16;

/// An assembly: signs, angles of classes, values of slides, coordinates of joints.
#[derive(FromPyObject, IntoPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct AssemblyNumbers {
    pub(crate) signs: Vec<i8>,
    pub(crate) class_angles: Vec<f64>,
    pub(crate) slides: Vec<f64>,
    pub(crate) joints: Vec<(f64, f64)>,
    pub(crate) angles: Vec<f64>,
    pub(crate) is_double: bool,
}

/// The assemblies of a position; numbers of complex ones; paths that did not lead to an assembly.
#[derive(IntoPyObject)]
pub(crate) struct Found<'py> {
    assemblies: Bound<'py, PyList>,
    complex_count: Vec<usize>,
    failures: Vec<String>,
    is_complete: bool,
}

impl<'py> Found<'py> {
    fn of(py: Python<'py>, all: Assemblies) -> PyResult<Bound<'py, PyDict>> {
        let is_complete = all.is_complete();
        let numbers = Self {
            assemblies: detach::listed(py, all.found.into_iter().map(AssemblyNumbers::from))?,
            complex_count: all.complex_counts,
            failures: all.failures.iter().map(ToString::to_string).collect(),
            is_complete,
        };
        numbers.into_pyobject(py)
    }

    /// The assemblies of many positions: making objects of Python takes longer than finding them.
    pub(crate) fn of_all(py: Python<'py>, all: Vec<Assemblies>) -> PyResult<Bound<'py, PyList>> {
        detach::make_objects(py, || {
            let list = PyList::empty(py);
            for position in all {
                list.append(Self::of(py, position)?)?;
                detach::check_signals(py, list.len())?;
            }
            Ok(list)
        })
    }
}

impl From<assur::Assembly> for AssemblyNumbers {
    fn from(assembly: assur::Assembly) -> Self {
        Self {
            signs: assembly.signs,
            class_angles: assembly.class_angles,
            slides: assembly.slides,
            joints: assembly.joints.into_iter().map(|[x, y]| (x, y)).collect(),
            angles: assembly.angles,
            is_double: assembly.is_double,
        }
    }
}

impl From<AssemblyNumbers> for assur::Assembly {
    fn from(assembly: AssemblyNumbers) -> Self {
        Self {
            signs: assembly.signs,
            class_angles: assembly.class_angles,
            slides: assembly.slides,
            joints: assembly.joints.into_iter().map(|(x, y)| [x, y]).collect(),
            angles: assembly.angles,
            is_double: assembly.is_double,
        }
    }
}

/// The assemblies of designs at positions.
pub(crate) struct Question<'q> {
    pub(crate) mechanism: &'q assur::Mechanism,
    /// The first dimension of every design, then the second.
    pub(crate) dimensions: &'q [f64],
    pub(crate) q: &'q [f64],
    pub(crate) per_design: bool,
}

impl Question<'_> {
    /// Number of designs, and of positions of each.
    pub(crate) fn shape(&self) -> [usize; 2] {
        let (size, drivers) = (self.mechanism.dimensions().len(), self.mechanism.q0().len());
        let designs = self.dimensions.len().checked_div(size).unwrap_or(1);
        let positions = self.q.len() / drivers / if self.per_design { designs.max(1) } else { 1 };
        [designs, positions]
    }

    /// Finds them; stops once `cancel` is true.
    pub(crate) fn answer(
        &self,
        threads: Option<usize>,
        cancel: &AtomicBool,
    ) -> Result<Vec<Assemblies>, SolveError> {
        let [designs, positions] = self.shape();
        let drivers = self.mechanism.q0().len();
        let assemblies_at = |index: usize| {
            let (design, position) = (index / positions, index % positions);
            let values: Vec<f64> =
                self.dimensions.chunks_exact(designs.max(1)).map(|column| column[design]).collect();
            let row = if self.per_design { index } else { position };
            let q = &self.q[row * drivers..][..drivers];
            self.mechanism.assemblies(&values, q, Some(cancel))
        };
        let count = designs * positions;
        parallel_map(count, MIN_PER_THREAD, threads, cancel, &assemblies_at).into_iter().collect()
    }
}
