//! The search for a linkage that draws a path, for Python.

use std::num::NonZeroUsize;
use std::sync::{Mutex, MutexGuard};

use assur::{FoundLinkage, SearchRequest, Simd};
use numpy::PyReadonlyArray2;
use pyo3::prelude::*;

use crate::detach;
use crate::error;

/// A linkage: names and places of its joints, the traced one last; its links; the crank's turn over the path; the
/// objective.
type Linkage = (Vec<(String, f64, f64)>, Vec<(String, Vec<String>)>, f64, f64);

/// A search in progress. Calls are slices of a tenth of a second or so: what a signal interrupts goes on with the
/// next call.
#[pyclass(frozen, module = "assur._core")]
pub(crate) struct PathSearch {
    inner: Mutex<assur::PathSearch>,
}

#[pymethods]
impl PathSearch {
    /// `limits`: the least apex angle, rad; the greatest distance of a joint from the path's centroid, in its root mean
    /// square radii; the least arc of the crank, rad; the price of a joint.
    #[new]
    fn new(
        points: PyReadonlyArray2<'_, f64>,
        is_closed: bool,
        joints: usize,
        limits: [f64; 4],
        seed: u64,
        threads: Option<NonZeroUsize>,
    ) -> PyResult<Self> {
        detach::catch_panic(|| {
            let points: Vec<[f64; 2]> =
                points.as_array().rows().into_iter().map(|at| [at[0], at[1]]).collect();
            let [least_apex, frame, least_arc, joint_price] = limits;
            let request = SearchRequest {
                is_closed,
                joints,
                least_apex,
                frame,
                least_arc,
                joint_price,
                seed,
                threads,
                simd: Simd::allowed(),
            };
            let inner = assur::PathSearch::new(&points, request);
            let inner = inner.ok_or_else(|| error::input("the points are no path", None))?;
            Ok(Self { inner: Mutex::new(inner) })
        })
    }

    /// Makes the candidates that evolution starts from.
    fn start(&self, py: Python<'_>) -> PyResult<()> {
        detach::run(py, false, |cancel| self.lock().map(|mut search| search.start(cancel)))?
    }

    /// A round of evolution: on islands as long as they are apart, then of all together. `False` if there is nothing
    /// that could evolve.
    fn round(&self, py: Python<'_>, is_apart: bool) -> PyResult<bool> {
        detach::run(py, false, |cancel| {
            self.lock().map(|mut search| search.round(is_apart, cancel))
        })?
    }

    /// The candidates, the best of them refined once more, best first.
    fn finish(&self, py: Python<'_>) -> PyResult<Vec<Linkage>> {
        let found =
            detach::run(py, false, |cancel| self.lock().map(|mut search| search.finish(cancel)))??;
        Ok(found.into_iter().map(parts).collect())
    }

    /// The least objective so far; infinite without candidates.
    fn best(&self) -> PyResult<f64> {
        Ok(self.lock()?.best())
    }

    /// Linkages that were evaluated so far.
    #[getter]
    fn evaluations(&self) -> PyResult<u64> {
        Ok(self.lock()?.evaluations())
    }
}

impl PathSearch {
    fn lock(&self) -> PyResult<MutexGuard<'_, assur::PathSearch>> {
        self.inner.lock().map_err(|_| error::internal("a search was left in disorder", "search"))
    }
}

fn parts(found: FoundLinkage) -> Linkage {
    let FoundLinkage { description, arc, value } = found;
    let joints = description.joints.into_iter().map(|(name, [x, y])| (name, x, y)).collect();
    (joints, description.links, arc, value)
}
