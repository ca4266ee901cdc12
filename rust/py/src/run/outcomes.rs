//! The outcomes of many runs: each a run, or the exception that tells why there is none.

use std::sync::Arc;
use std::sync::atomic::Ordering;

use assur::dynamics::{Imbalance, Outcome, RunError, Samples};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::exceptions::{PyIndexError, PyMemoryError};
use pyo3::prelude::*;
use pyo3::types::PyType;

use super::stop_reason::kind_of;
use super::{Array, Run, arrays, push_or_nan};
use crate::parallel_map::parallel_map;
use crate::{detach, error_map, reserve};

/// Runs whose samples are found by one thread before another pays off.
const RUNS_PER_THREAD: usize = 64;
/// Samples that take only milliseconds.
const FEW_SAMPLES: usize = 10_000;

/// What is kept of a run: it and the balance of its energies, or its error.
pub(crate) struct Kept(Result<(assur::dynamics::Run, Balance), RunError<PyErr>>);

/// The balance of energies, or the time at which one is infinite.
type Balance = Result<Imbalance, f64>;

impl Kept {
    /// Of runs of which only the ends are wanted, the rest is dropped.
    pub(crate) fn new(outcome: Outcome<PyErr>, only_ends: bool) -> Self {
        Self(outcome.map(|mut run| {
            let balance = run.imbalance();
            if only_ends {
                run.keep_end();
            } else {
                run.shrink();
            }
            (run, balance)
        }))
    }
}

/// A run, or its status and exception.
enum Entry {
    Run(Arc<assur::dynamics::Run>, Balance),
    Failed(u8, PyErr),
}

/// The outcomes of the runs of a batch, in order.
#[pyclass(frozen, module = "assur._core")]
pub(crate) struct Runs(Vec<Entry>);

/// An outcome for copies and pickles: a run, or a status and an exception.
#[derive(FromPyObject, IntoPyObject)]
enum State {
    Run(Py<Run>),
    Failed(u8, Py<PyAny>),
}

/// A run or an exception.
#[derive(IntoPyObject)]
enum Found {
    Run(Run),
    Failed(Py<PyAny>),
}

/// See [`Runs::outcomes`].
type Outcomes<'py> =
    (Vec<Array<'py>>, [Array<'py>; 4], Vec<&'static str>, Bound<'py, PyArray1<u8>>);

impl Runs {
    /// Makes the exceptions of those that failed; raises `MemoryError` where a run found no memory.
    pub(crate) fn new(py: Python<'_>, kept: Vec<Kept>) -> PyResult<Self> {
        let mut entries = Vec::with_capacity(kept.len());
        for Kept(outcome) in kept {
            entries.push(match outcome {
                Ok((run, balance)) => Entry::Run(Arc::new(run), balance),
                Err(error) => {
                    let status = error_map::run_status(&error);
                    let exception = error_map::run(error);
                    if exception.is_instance_of::<PyMemoryError>(py) {
                        return Err(exception);
                    }
                    Entry::Failed(status, exception)
                }
            });
            detach::check_signals(py, entries.len())?;
        }
        Ok(Self(entries))
    }
}

#[pymethods]
impl Runs {
    /// The outcomes of states, which `__reduce__` gives.
    #[new]
    fn from_states(py: Python<'_>, states: Vec<State>) -> Self {
        let entry = |state| match state {
            State::Run(run) => {
                let run = Arc::clone(&run.get().0);
                let balance = run.imbalance();
                Entry::Run(run, balance)
            }
            State::Failed(status, exception) => {
                Entry::Failed(status, PyErr::from_value(exception.into_bound(py)))
            }
        };
        Self(states.into_iter().map(entry).collect())
    }

    /// A run, or the exception that tells why there is none.
    fn outcome(&self, py: Python<'_>, index: usize) -> PyResult<Found> {
        match self.0.get(index) {
            Some(Entry::Run(run, _)) => Ok(Found::Run(Run(Arc::clone(run)))),
            Some(Entry::Failed(_, exception)) => {
                Ok(Found::Failed(exception.clone_ref(py).into_value(py).into_any()))
            }
            None => Err(PyIndexError::new_err("there are fewer runs")),
        }
    }

    /// Of all: the last samples without energies; the greatest imbalance, energy and potential energy, J,
    /// and the time at which an energy is infinite, s; why each ended, "failed" where there is no run; and
    /// its status. NaN where there is none.
    fn outcomes<'py>(&self, py: Python<'py>, drivers: usize) -> Outcomes<'py> {
        let mut ends = Samples::default();
        let mut balances: [Vec<f64>; 4] = Default::default();
        let (mut kinds, mut statuses) = (Vec::new(), Vec::new());
        for entry in &self.0 {
            let (last, balance, kind, status) = match entry {
                Entry::Run(run, balance) => {
                    let balance = match *balance {
                        Ok(Imbalance { worst, size, potential }) => {
                            [worst, size, potential, f64::NAN]
                        }
                        Err(t) => [f64::NAN, f64::NAN, f64::NAN, t],
                    };
                    (run.samples.last(), balance, kind_of(&run.stop_reason), 0)
                }
                Entry::Failed(status, _) => (None, [f64::NAN; 4], "failed", *status),
            };
            push_or_nan(&mut ends, last, drivers);
            for (column, number) in balances.iter_mut().zip(balance) {
                column.push(number);
            }
            kinds.push(kind);
            statuses.push(status);
        }
        let balances = balances.map(|column| PyArray1::from_vec(py, column));
        (arrays(py, ends), balances, kinds, PyArray1::from_vec(py, statuses))
    }

    /// The samples without energies at points of runs, all of the first one, then of the second; NaN
    /// outside. `indices`: of the runs.
    fn at<'py>(
        &self,
        py: Python<'py>,
        indices: Vec<usize>,
        points: PyReadonlyArray1<'py, f64>,
        drivers: usize,
    ) -> PyResult<Vec<Array<'py>>> {
        let points = reserve::copied(&points)?;
        let _room = reserve::room_for(py, points.len() * (3 * drivers + 2))?;
        let each = points.len().checked_div(indices.len()).unwrap_or(0);
        let parts = detach::run(py, points.len() < FEW_SAMPLES, |cancel| {
            let samples = |place: usize| {
                let mut samples = Samples::default();
                let run = match indices.get(place).and_then(|&index| self.0.get(index)) {
                    Some(Entry::Run(run, _)) => Some(run),
                    _ => None,
                };
                for &point in &points[place * each..(place + 1) * each] {
                    if cancel.load(Ordering::Relaxed) {
                        break;
                    }
                    push_or_nan(&mut samples, run.and_then(|run| run.at(point)), drivers);
                }
                samples
            };
            let count = if each == 0 { 0 } else { indices.len() };
            parallel_map(count, RUNS_PER_THREAD, None, cancel, &samples)
        })?;
        let mut all = Samples::default();
        for part in parts {
            all.t.extend(part.t);
            all.q.extend(part.q);
            all.speed.extend(part.speed);
            all.acceleration.extend(part.acceleration);
            all.work.extend(part.work);
        }
        Ok(arrays(py, all))
    }

    /// The type and the states of all outcomes.
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyType>, (Vec<State>,))> {
        let state = |entry: &Entry| {
            Ok(match entry {
                Entry::Run(run, _) => State::Run(Py::new(py, Run(Arc::clone(run)))?),
                Entry::Failed(status, exception) => {
                    State::Failed(*status, exception.clone_ref(py).into_value(py).into_any())
                }
            })
        };
        let states = self.0.iter().map(state).collect::<PyResult<_>>()?;
        Ok((py.get_type::<Self>(), (states,)))
    }
}
