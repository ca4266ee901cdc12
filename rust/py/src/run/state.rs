//! Runs as arrays and numbers, for copies and pickles.

use assur::dynamics::{EventRecord, PartsError, Run, RunParts, Sample, Samples, Tail, Variable};
use assur::ode::Statistics;
use numpy::{PyArray1, PyArrayMethods};
use pyo3::prelude::*;

use super::stop_reason::StopReasonState;
use crate::error;

type Array<'py> = Bound<'py, PyArray1<f64>>;

/// All numbers of a run.
#[derive(FromPyObject, IntoPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct RunState<'py> {
    samples: SamplesState<'py>,
    kinetic: Array<'py>,
    potential: Array<'py>,
    events: Vec<EventState>,
    stop_reason: StopReasonState,
    statistics: StatisticsState,
    along_q: bool,
    sign: f64,
    starts: Array<'py>,
    widths: Array<'py>,
    ends: Array<'py>,
    rows: Array<'py>,
    tail: Option<TailState>,
}

#[derive(FromPyObject, IntoPyObject)]
#[pyo3(from_item_all)]
struct SamplesState<'py> {
    t: Array<'py>,
    q: Array<'py>,
    speed: Array<'py>,
    acceleration: Array<'py>,
    work: Array<'py>,
}

#[derive(FromPyObject, IntoPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct EventState {
    event: usize,
    t: f64,
    q: Vec<f64>,
    speed: Vec<f64>,
}

#[derive(FromPyObject, IntoPyObject)]
#[pyo3(from_item_all)]
struct StatisticsState {
    steps: u64,
    rejected: u64,
    evaluations: u64,
    restarts: u64,
    stiff: u64,
    smallest: Option<f64>,
    largest: Option<f64>,
}

#[derive(FromPyObject, IntoPyObject)]
#[pyo3(from_item_all)]
struct TailState {
    t: f64,
    q: Vec<f64>,
    speed: Vec<f64>,
    acceleration: Vec<f64>,
    work: f64,
    dead_point: f64,
    sign: f64,
    unit: f64,
    root: f64,
    b: f64,
    slope: f64,
}

/// The state of a run.
pub(crate) fn state<'py>(py: Python<'py>, run: &Run) -> RunState<'py> {
    let parts = run.parts();
    let array = |numbers: Vec<f64>| PyArray1::from_vec(py, numbers);
    let energy = |which: usize| array(parts.energies.iter().map(|pair| pair[which]).collect());
    RunState {
        kinetic: energy(0),
        potential: energy(1),
        samples: SamplesState {
            t: array(parts.samples.t),
            q: array(parts.samples.q),
            speed: array(parts.samples.speed),
            acceleration: array(parts.samples.acceleration),
            work: array(parts.samples.work),
        },
        events: parts.events.into_iter().map(EventState::from).collect(),
        stop_reason: StopReasonState::from(parts.stop_reason),
        statistics: StatisticsState::from(parts.statistics),
        along_q: parts.along == Variable::Coordinate,
        sign: parts.sign,
        starts: array(parts.starts),
        widths: array(parts.widths),
        ends: array(parts.ends),
        rows: array(parts.rows),
        tail: parts.tail.map(TailState::from),
    }
}

/// The run of a state. Raises `InputError` for anything else.
pub(crate) fn run(state: &Bound<'_, PyAny>) -> PyResult<Run> {
    let refuse =
        |why: String| error::input(&format!("this is not the state of a run: {why}"), None);
    let parts = || state.extract::<RunState<'_>>()?.parts();
    let parts = parts().map_err(|why| refuse(why.to_string()))?;
    Run::from_parts(parts).map_err(|why: PartsError| refuse(why.to_string()))
}

impl RunState<'_> {
    fn parts(self) -> PyResult<RunParts> {
        let samples = Samples {
            t: numbers(&self.samples.t)?,
            q: numbers(&self.samples.q)?,
            speed: numbers(&self.samples.speed)?,
            acceleration: numbers(&self.samples.acceleration)?,
            work: numbers(&self.samples.work)?,
        };
        let (kinetic, potential) = (numbers(&self.kinetic)?, numbers(&self.potential)?);
        if kinetic.len() != potential.len() {
            return Err(error::input("its energies do not fit", None));
        }
        Ok(RunParts {
            samples,
            energies: kinetic.into_iter().zip(potential).map(|(k, p)| [k, p]).collect(),
            events: self.events.into_iter().map(EventRecord::from).collect(),
            stop_reason: self.stop_reason.reason()?,
            statistics: self.statistics.into(),
            along: if self.along_q { Variable::Coordinate } else { Variable::Time },
            sign: self.sign,
            starts: numbers(&self.starts)?,
            widths: numbers(&self.widths)?,
            ends: numbers(&self.ends)?,
            rows: numbers(&self.rows)?,
            tail: self.tail.map(Tail::from),
        })
    }
}

fn numbers(array: &Array<'_>) -> PyResult<Vec<f64>> {
    Ok(array.try_readonly()?.as_array().to_vec())
}

impl From<EventRecord> for EventState {
    fn from(EventRecord { event, t, q, speed }: EventRecord) -> Self {
        Self { event, t, q, speed }
    }
}

impl From<EventState> for EventRecord {
    fn from(EventState { event, t, q, speed }: EventState) -> Self {
        Self { event, t, q, speed }
    }
}

impl From<Statistics> for StatisticsState {
    fn from(all: Statistics) -> Self {
        let Statistics { steps, rejected, evaluations, restarts, stiff, smallest, largest } = all;
        Self { steps, rejected, evaluations, restarts, stiff, smallest, largest }
    }
}

impl From<StatisticsState> for Statistics {
    fn from(all: StatisticsState) -> Self {
        let StatisticsState { steps, rejected, evaluations, restarts, stiff, smallest, largest } =
            all;
        Self { steps, rejected, evaluations, restarts, stiff, smallest, largest }
    }
}

impl From<Tail> for TailState {
    fn from(tail: Tail) -> Self {
        let Tail { last, dead_point, sign, unit, root, b, slope } = tail;
        let Sample { t, q, speed, acceleration, work } = last;
        Self { t, q, speed, acceleration, work, dead_point, sign, unit, root, b, slope }
    }
}

impl From<TailState> for Tail {
    fn from(state: TailState) -> Self {
        let TailState { t, q, speed, acceleration, work, dead_point, sign, unit, root, b, slope } =
            state;
        let last = Sample { t, q, speed, acceleration, work };
        Self { last, dead_point, sign, unit, root, b, slope }
    }
}
