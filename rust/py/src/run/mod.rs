//! Runs of machines for Python: calls functions, returns arrays.

pub(crate) mod batch;
pub(crate) mod calls;
pub(crate) mod options;
pub(crate) mod outcomes;
mod state;
pub(crate) mod steady_numbers;
mod stop_reason;

use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Instant;

use assur::dynamics::{Callbacks, Imbalance, Sample, Samples};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyFloat, PyTuple, PyType};

use self::state::{EventState, RunState};
use self::stop_reason::StopReasonState;
use crate::detach::{self, SIGNAL_INTERVAL, catch_panic};
use crate::error::{Class, Fields, exception};
use crate::reserve;

/// Points of a run that take only milliseconds.
const FEW_POINTS: usize = 10_000;

type Array<'py> = Bound<'py, PyArray1<f64>>;

/// Python functions of (t, q, speed), and checks for signals.
pub(crate) struct PythonCallbacks {
    loads: Vec<Py<PyAny>>,
    events: Vec<Py<PyAny>>,
    last_check: Instant,
    refusals: usize,
    /// The exception of a signal handler, or `MemoryError`.
    pub(crate) signal: Option<PyErr>,
}

impl PythonCallbacks {
    pub(crate) fn new(loads: Vec<Py<PyAny>>, events: Vec<Py<PyAny>>) -> Self {
        Self {
            loads,
            events,
            last_check: Instant::now(),
            refusals: reserve::refusals(),
            signal: None,
        }
    }

    /// Whether the run calls functions, so that the work must hold the GIL.
    pub(crate) fn need_gil(&self) -> bool {
        !(self.loads.is_empty() && self.events.is_empty())
    }
}

/// Converts to a number by the rules of the package, which reject text and dates.
fn number(object: &Bound<'_, PyAny>) -> PyResult<f64> {
    if let Ok(float) = object.cast_exact::<PyFloat>() {
        return Ok(float.value());
    }
    let real_number = object.py().import("assur._arrays")?.getattr("real_number")?;
    real_number.call1((object, "it"))?.extract()
}

fn call(
    py: Python<'_>,
    function: &Py<PyAny>,
    what: &str,
    (t, q, speed): (f64, &[f64], &[f64]),
) -> PyResult<f64> {
    let result = match (q, speed) {
        (&[q], &[speed]) => function.call1(py, (t, q, speed))?,
        _ => function.call1(py, (t, PyTuple::new(py, q)?, PyTuple::new(py, speed)?))?,
    };
    let result = result.bind(py);
    match number(result) {
        Ok(number) if number.is_finite() => Ok(number),
        rejected => {
            let name = function.bind(py).getattr("__name__").map_or_else(
                |_| function.bind(py).repr().map_or_else(|_| "?".into(), |text| text.to_string()),
                |name| name.to_string(),
            );
            let shown = result.repr()?;
            let message = format!(
                "the {what} {name}(t, q, speed) gave {shown} at t = {t}, q = {}: a finite number is needed",
                q.iter().map(f64::to_string).collect::<Vec<_>>().join(", ")
            );
            let fields = Fields { q: Some(q), t: Some(t), ..Fields::default() };
            let kind = rejected.is_ok().then_some("not_finite");
            Err(exception(Class::Input, kind, &message, None, &fields))
        }
    }
}

impl Callbacks for PythonCallbacks {
    type Error = PyErr;

    fn count(&self) -> usize {
        self.loads.len()
    }

    fn numbers(
        &mut self,
        t: f64,
        q: &[f64],
        speed: &[f64],
        numbers: &mut [f64],
    ) -> Result<(), PyErr> {
        Python::attach(|py| {
            for (number, function) in numbers.iter_mut().zip(&self.loads) {
                *number = call(py, function, "load", (t, q, speed))?;
            }
            Ok(())
        })
    }

    fn event(&mut self, which: usize, t: f64, q: &[f64], speed: &[f64]) -> Result<f64, PyErr> {
        Python::attach(|py| match self.events.get(which) {
            Some(function) => call(py, function, "event", (t, q, speed)),
            None => Ok(f64::NAN),
        })
    }

    fn cancelled(&mut self) -> bool {
        if self.signal.is_some() {
            return true;
        }
        if let Err(out_of_memory) = reserve::check(self.refusals) {
            self.signal = Some(out_of_memory);
            return true;
        }
        if self.last_check.elapsed() < SIGNAL_INTERVAL {
            return false;
        }
        self.last_check = Instant::now();
        #[allow(
            clippy::redundant_closure_for_method_calls,
            reason = "the method by itself is not general over the lifetime"
        )]
        let checked = Python::attach(|py| py.check_signals());
        self.signal = checked.err();
        self.signal.is_some()
    }
}

/// A run of a machine.
#[pyclass(frozen, module = "assur._core")]
pub(crate) struct Run(Arc<assur::dynamics::Run>);

impl Run {
    pub(crate) fn new(run: assur::dynamics::Run) -> Self {
        Self(Arc::new(run))
    }
}

#[pymethods]
impl Run {
    /// The run of a state, which `__reduce__` gives.
    #[new]
    fn from_state(state: &Bound<'_, PyAny>) -> PyResult<Self> {
        catch_panic(|| state::run(state).map(Self::new))
    }

    /// At the ends of steps: time, coordinates, speeds, accelerations, work, kinetic and potential
    /// energy.
    fn arrays<'py>(&self, py: Python<'py>) -> PyResult<Vec<Array<'py>>> {
        let energy = |which: usize| self.0.energies.iter().map(|pair| pair[which]).collect();
        catch_panic(|| {
            let mut arrays = arrays(py, self.0.samples.clone());
            arrays.push(PyArray1::from_vec(py, energy(0)));
            arrays.push(PyArray1::from_vec(py, energy(1)));
            Ok(arrays)
        })
    }

    /// The samples without energies at given times, or coordinates for a run over the coordinate; NaN
    /// outside the run.
    fn at<'py>(
        &self,
        py: Python<'py>,
        points: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<Vec<Array<'py>>> {
        let samples = &self.0.samples;
        let points = reserve::copied(&points)?;
        let drivers = samples.q.len() / samples.len().max(1);
        let _room = reserve::room_for(py, points.len() * (3 * drivers + 2))?;
        let all = detach::run(py, points.len() < FEW_POINTS, |cancel| {
            let mut all = Samples::default();
            for &point in points.iter().take_while(|_| !cancel.load(Ordering::Relaxed)) {
                push_or_nan(&mut all, self.0.at(point), drivers);
            }
            all
        })?;
        Ok(arrays(py, all))
    }

    /// The greatest imbalance, energy and potential energy, J; and the time at which an energy is
    /// infinite, s, if one is.
    fn imbalance(&self) -> (f64, f64, f64, Option<f64>) {
        match self.0.imbalance() {
            Ok(Imbalance { worst, size, potential }) => (worst, size, potential, None),
            Err(t) => (f64::NAN, f64::NAN, f64::NAN, Some(t)),
        }
    }

    /// The run's type and its state.
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyType>, (RunState<'py>,))> {
        catch_panic(|| Ok((py.get_type::<Self>(), (state::state(py, &self.0),))))
    }

    /// Events of the run.
    #[getter]
    fn events(&self) -> Vec<EventState> {
        self.0.events.iter().cloned().map(EventState::from).collect()
    }

    /// Why the run ended.
    #[getter]
    fn ending(&self) -> StopReasonState {
        self.0.stop_reason.clone().into()
    }

    /// Statistics of the integration.
    #[getter]
    fn statistics<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let statistics = &self.0.statistics;
        let dict = PyDict::new(py);
        dict.set_item("steps", statistics.steps)?;
        dict.set_item("rejected", statistics.rejected)?;
        dict.set_item("evaluations", statistics.evaluations)?;
        dict.set_item("restarts", statistics.restarts)?;
        dict.set_item("smallest_step", statistics.smallest)?;
        dict.set_item("largest_step", statistics.largest)?;
        Ok(dict)
    }
}

/// Adds a sample, or one of NaN.
fn push_or_nan(samples: &mut Samples, sample: Option<Sample>, drivers: usize) {
    let nan = || {
        let nan = vec![f64::NAN; drivers];
        let (q, speed, acceleration) = (nan.clone(), nan.clone(), nan);
        Sample { t: f64::NAN, q, speed, acceleration, work: f64::NAN }
    };
    samples.push(&sample.unwrap_or_else(nan));
}

fn arrays(py: Python<'_>, moments: Samples) -> Vec<Array<'_>> {
    let Samples { t, q, speed, acceleration, work } = moments;
    [t, q, speed, acceleration, work].map(|list| PyArray1::from_vec(py, list)).into()
}
