//! Machines: names in, reduced inertias, moments and motions out.

use std::time::{Duration, Instant};

use assur::SolveError;
use assur::dynamics::{
    FluctuationTarget, Mean, ReducedTable, RunOptions, SteadyOptions, TabulatedMachine, Variable,
};
use assur::ode::Method;
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;

use crate::error;
use crate::gate::{self, guard};
use crate::mechanism::Mechanism;
use crate::parts::{self, BodyParts, LoadParts, MotorParts, TableParts, WatchParts};
use crate::run::{Calls, Run, broken, unsteady};
use crate::spread::spread;

type Flat<'py> = PyReadonlyArray1<'py, f64>;
type Array<'py> = Bound<'py, PyArray1<f64>>;
/// Mass matrices, their derivatives, moments, potential energies, statuses.
type Arrays<'py> = (Array<'py>, Array<'py>, Array<'py>, Array<'py>, Bound<'py, PyArray1<u8>>);

/// Positions below which a call is not to be interrupted.
const SMALL: usize = 20_000;

/// Where a machine's inertia and loads come from.
enum Inner {
    Mechanism(Py<Mechanism>, assur::dynamics::Machine),
    Tables(TabulatedMachine),
}

/// A mechanism with bodies and loads, or tables of inertia and moment; and motors.
#[pyclass(frozen, module = "assur._core")]
pub(crate) struct Machine(Inner);

#[pymethods]
impl Machine {
    /// Without a mechanism the first two tables are inertia and moment.
    #[new]
    fn new(
        py: Python<'_>,
        mechanism: Option<Py<Mechanism>>,
        bodies: Vec<BodyParts>,
        loads: Vec<LoadParts>,
        gravity: [f64; 2],
        tables: Vec<TableParts>,
        motors: Vec<MotorParts>,
    ) -> PyResult<Self> {
        let tables = guard(|| tables.into_iter().map(parts::table).collect::<PyResult<_>>())?;
        let motors = guard(|| motors.into_iter().map(parts::motor).collect::<PyResult<_>>())?;
        let Some(mechanism) = mechanism else {
            return Ok(Self(Inner::Tables(TabulatedMachine { tables, motors })));
        };
        let own = &mechanism.bind(py).get().inner;
        let inner = guard(|| {
            let bodies =
                bodies.into_iter().map(|one| parts::body(own, one)).collect::<PyResult<_>>()?;
            let loads =
                loads.into_iter().map(|one| parts::load(own, one)).collect::<PyResult<_>>()?;
            Ok(assur::dynamics::Machine { bodies, loads, gravity, tables, motors })
        })?;
        Ok(Self(Inner::Mechanism(mechanism, inner)))
    }

    /// Refers designs to the drivers, each at as many positions; `given`: the values from outside
    /// of every position.
    fn reduce<'py>(
        &self,
        py: Python<'py>,
        dimensions: Flat<'py>,
        q: Flat<'py>,
        speed: Flat<'py>,
        given: Flat<'py>,
        threads: Option<usize>,
    ) -> PyResult<Arrays<'py>> {
        let (mechanism, machine) = match &self.0 {
            Inner::Mechanism(mechanism, machine) => (mechanism, machine),
            Inner::Tables(sheet) => {
                let q = q.as_slice()?;
                return guard(|| Ok(arrays(py, &[sheet.reduce(q)])));
            }
        };
        let mechanism = &mechanism.get().inner;
        let drivers = mechanism.q0().len();
        let [dimensions, q, speed, given] =
            [&dimensions, &q, &speed, &given].map(|a| a.as_slice().map(<[f64]>::to_vec));
        let (dimensions, q, speed, given) = (dimensions?, q?, speed?, given?);
        let each = mechanism.dimensions().len();
        let designs = dimensions.len() / each;
        let whole = |all: &[f64]| designs > 0 && all.len().is_multiple_of(designs);
        let fits = dimensions.len().is_multiple_of(each)
            && q.len() == speed.len()
            && [&q, &given].iter().all(|all| whole(all))
            && (q.len() / designs.max(1)).is_multiple_of(drivers);
        if !fits {
            return Err(error::solve(SolveError::Shape("the arrays do not fit".into())));
        }
        let part = |all: &[f64], design: usize| {
            let own = all.len() / designs;
            all[design * own..(design + 1) * own].to_vec()
        };
        let all = gate::run(py, q.len() <= SMALL, |cancel| {
            let one = |design: usize| {
                let [dimensions, q, speed, given] =
                    [&dimensions, &q, &speed, &given].map(|all| part(all, design));
                machine.reduce(mechanism, &dimensions, &q, &speed, &given, cancel)
            };
            spread(designs, 1, threads, cancel, &one)
        })?;
        Ok(arrays(py, &all))
    }

    /// A motion along the time or (`along_q`) the coordinate; `functions`: those of loads and
    /// motors, then of events.
    #[allow(clippy::too_many_arguments, reason = "what is asked of a run")]
    fn run(
        &self,
        py: Python<'_>,
        dimensions: Vec<f64>,
        along_q: bool,
        start: (f64, Vec<f64>, Vec<f64>),
        end: f64,
        low_order: bool,
        tolerances: (f64, Option<[f64; 2]>),
        limits: (f64, u64, Option<f64>),
        breaks: Vec<f64>,
        watches: Vec<WatchParts>,
        functions: (Vec<Py<PyAny>>, Vec<Py<PyAny>>),
    ) -> PyResult<Run> {
        let own = match &self.0 {
            Inner::Mechanism(mechanism, _) => Some(&mechanism.get().inner),
            Inner::Tables(_) => None,
        };
        let watches =
            watches.into_iter().map(|one| parts::watch(own, one)).collect::<PyResult<Vec<_>>>()?;
        let (t, q, speed) = start;
        let (max_step, max_steps, seconds) = limits;
        let task = RunOptions {
            along: if along_q { Variable::Coordinate } else { Variable::Time },
            t,
            q: &q,
            speed: &speed,
            end,
            method: method(low_order),
            relative: tolerances.0,
            absolute: tolerances.1,
            max_step,
            max_steps,
            deadline: deadline(seconds),
            breaks: &breaks,
            events: &watches,
            flywheel: 0.0,
        };
        let made = called(py, functions, |calls| match &self.0 {
            Inner::Mechanism(mechanism, machine) => {
                machine.run(&mechanism.get().inner, &dimensions, &task, calls)
            }
            Inner::Tables(sheet) => sheet.run(&task, calls),
        })?;
        made.map(Run::new).map_err(broken)
    }

    /// The periodic motion from `q` over `span`, with a flywheel or one for a fluctuation
    /// (`wanted`); `mean`: what the mean speed is. A period along the coordinate; multiplier,
    /// moment, work of the motors, flywheel, least and greatest speed.
    #[allow(clippy::too_many_arguments, reason = "what is asked of it")]
    fn steady(
        &self,
        py: Python<'_>,
        dimensions: Vec<f64>,
        places: [f64; 2],
        speed: Option<f64>,
        mean: &str,
        low_order: bool,
        relative: f64,
        limits: (u64, Option<f64>),
        breaks: Vec<f64>,
        flywheel: f64,
        wanted: Option<f64>,
        functions: Vec<Py<PyAny>>,
    ) -> PyResult<(Run, Vec<f64>)> {
        let [q, span] = places;
        let mean = if mean == "period" { Mean::Period } else { Mean::Extremes };
        let search = SteadyOptions {
            q,
            span,
            speed,
            mean,
            method: method(low_order),
            relative,
            max_steps: limits.0,
            deadline: deadline(limits.1),
            breaks: &breaks,
            flywheel,
        };
        let wanted = wanted.map(|fluctuation| FluctuationTarget { fluctuation, mean });
        let made = called(py, (functions, Vec::new()), |calls| match &self.0 {
            Inner::Mechanism(mechanism, machine) => {
                machine.steady(&mechanism.get().inner, &dimensions, &search, wanted, calls)
            }
            Inner::Tables(sheet) => sheet.steady(&search, wanted, calls),
        })?;
        let steady = made.map_err(unsteady)?;
        let [least, greatest] = steady.extremes();
        let numbers = vec![
            steady.multiplier,
            steady.moment,
            steady.drive,
            steady.flywheel,
            least.at,
            least.value,
            greatest.at,
            greatest.value,
        ];
        Ok((Run::new(steady.run), numbers))
    }
}

/// Does something with functions, which need Python's lock all the time; then signals are heard.
fn called<T: Send>(
    py: Python<'_>,
    functions: (Vec<Py<PyAny>>, Vec<Py<PyAny>>),
    work: impl FnOnce(&mut Calls) -> T + Send,
) -> PyResult<T> {
    let mut calls = Calls::new(functions.0, functions.1);
    let done = guard(|| {
        Ok(if calls.are_many() { work(&mut calls) } else { py.detach(|| work(&mut calls)) })
    })?;
    calls.signal.map_or(Ok(done), Err)
}

fn method(low_order: bool) -> Method {
    if low_order { Method::DormandPrince54 } else { Method::DormandPrince853 }
}

fn deadline(seconds: Option<f64>) -> Option<Instant> {
    let wait = seconds.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok())?;
    Instant::now().checked_add(wait)
}

fn arrays<'py>(py: Python<'py>, all: &[ReducedTable]) -> Arrays<'py> {
    let array = |of: fn(&ReducedTable) -> &[f64]| {
        PyArray1::from_vec(py, all.iter().flat_map(|rows| of(rows).iter().copied()).collect())
    };
    let statuses = all.iter().flat_map(|rows| rows.status.iter().map(|&one| one as u8));
    (
        array(|r| &r.inertia),
        array(|r| &r.d_inertia),
        array(|r| &r.moment),
        array(|r| &r.potential),
        PyArray1::from_vec(py, statuses.collect()),
    )
}
