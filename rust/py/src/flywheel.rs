//! Flywheels of many tables. Python checks, broadcasts and reshapes the arrays.

use std::sync::atomic::AtomicBool;

use assur::Hint;
use assur::dynamics::{Cycle, EndCondition, Flywheel, Mean, TableError};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::exceptions::PyBaseException;
use pyo3::prelude::*;

use crate::convert::word::{Word, Words};
use crate::parallel_map::parallel_map;
use crate::{detach, error, error_map, reserve};

type Flat<'py> = PyReadonlyArray1<'py, f64>;
type Array<'py> = Bound<'py, PyArray1<f64>>;
type Outcome = Result<Flywheel, TableError>;

/// Tables per thread; up to this number one thread does all.
const TABLES_PER_THREAD: usize = 64;
/// Rows of all tables up to which the work takes some ten milliseconds: too short for a signal.
const FEW_ROWS: usize = 32_768;
/// Numbers of a spline and of the data computed from it, per number of its table.
const SPLINES: usize = 8;

/// The task for each table.
#[derive(Clone, Copy)]
enum Task {
    /// The flywheel for a fluctuation at a mean speed.
    Fluctuation,
    /// The motion with a flywheel at a mean speed.
    MeanSpeed,
    /// The motion with a flywheel from an initial speed.
    InitialSpeed,
}

impl Words for Task {
    const WHAT: &'static str = "task";
    const KNOWN: &'static [(&'static str, Self)] = &[
        ("fluctuation", Self::Fluctuation),
        ("mean speed", Self::MeanSpeed),
        ("initial speed", Self::InitialSpeed),
    ];
}

impl Task {
    fn solve(
        self,
        turn: Cycle,
        [first, second]: [f64; 2],
        mean: Mean,
        cancel: &AtomicBool,
    ) -> Outcome {
        match self {
            Self::Fluctuation => Flywheel::for_fluctuation(turn, first, second, mean, cancel),
            Self::MeanSpeed => Flywheel::for_mean_speed(turn, first, second, mean, cancel),
            Self::InitialSpeed => Flywheel::for_initial_speed(turn, first, second, cancel),
        }
    }
}

/// A quantity over the coordinate, or over the time.
#[derive(Clone, Copy)]
enum Curve {
    Speed,
    Time,
    Coordinate,
    Moment,
    Inertia,
    Work,
}

impl Words for Curve {
    const WHAT: &'static str = "quantity";
    const KNOWN: &'static [(&'static str, Self)] = &[
        ("speed", Self::Speed),
        ("time", Self::Time),
        ("coordinate", Self::Coordinate),
        ("moment", Self::Moment),
        ("inertia", Self::Inertia),
        ("work", Self::Work),
    ];
}

impl Curve {
    fn at(self, flywheel: &Flywheel, x: f64) -> f64 {
        match self {
            Self::Speed => flywheel.speed(x),
            Self::Time => flywheel.time(x),
            Self::Coordinate => flywheel.angle(x),
            Self::Moment => flywheel.cycle.moment(x),
            Self::Inertia => flywheel.cycle.inertia(x),
            Self::Work => flywheel.cycle.work(x),
        }
    }
}

/// Numbers of the flywheels of several tables; `greatest` and `least` are extreme speeds.
#[derive(IntoPyObject)]
pub(crate) struct FlywheelNumbers<'py> {
    inertia: Array<'py>,
    speed0: Array<'py>,
    motor_moment: Array<'py>,
    greatest_at: Array<'py>,
    greatest: Array<'py>,
    least_at: Array<'py>,
    least: Array<'py>,
    period: Array<'py>,
}

/// The flywheels of several tables with the same angles.
#[pyclass(frozen, module = "assur._core")]
pub(crate) struct Flywheels(Vec<Outcome>);

#[pymethods]
impl Flywheels {
    /// `moment` and `inertia`: table after table. `first` and `second`: two numbers for each table,
    /// the fluctuation or the flywheel, and the mean or initial speed (`task`).
    #[new]
    #[pyo3(signature = (phi, moment, inertia, spline, task, mean, first, second, threads=None, corners=None))]
    #[allow(clippy::too_many_arguments, reason = "flat arrays")]
    fn new(
        py: Python<'_>,
        phi: Flat<'_>,
        moment: Flat<'_>,
        inertia: Flat<'_>,
        spline: Word<EndCondition>,
        task: Word<Task>,
        mean: Word<Mean>,
        first: Flat<'_>,
        second: Flat<'_>,
        threads: Option<usize>,
        corners: Option<Vec<usize>>,
    ) -> PyResult<Self> {
        let (Word(ends), Word(task), Word(mean)) = (spline, task, mean);
        let numbers: usize =
            [&phi, &moment, &inertia].iter().map(|array| array.as_array().len()).sum();
        let _room = reserve::room_for(py, SPLINES * numbers)?;
        let [phi, moment, inertia, first, second] =
            [&phi, &moment, &inertia, &first, &second].map(|a| a.as_slice().map(<[f64]>::to_vec));
        let (phi, moment, inertia, first, second) = (phi?, moment?, inertia?, first?, second?);
        let (count, rows) = (first.len(), phi.len());
        if second.len() != count || [&moment, &inertia].iter().any(|a| a.len() != count * rows) {
            return Err(error::input("the arrays do not fit", None));
        }
        let solve_table = |i: usize, cancel: &AtomicBool| {
            let table = |all: &[f64]| all[i * rows..(i + 1) * rows].to_vec();
            let (moment, inertia) = (table(&moment), table(&inertia));
            let turn = match &corners {
                Some(corners) => {
                    Cycle::with_corners(&phi, &moment, &inertia, ends, corners, cancel)
                }
                None => Cycle::new(&phi, &moment, &inertia, ends, cancel),
            };
            turn.and_then(|turn| task.solve(turn, [first[i], second[i]], mean, cancel))
        };
        let small = count <= TABLES_PER_THREAD && count.saturating_mul(rows) <= FEW_ROWS;
        detach::run(py, small, |cancel| {
            parallel_map(count, TABLES_PER_THREAD, threads, cancel, &|i| solve_table(i, cancel))
        })
        .map(Self)
    }

    /// A number of each table, NaN for one without a flywheel.
    fn numbers<'py>(&self, py: Python<'py>) -> PyResult<FlywheelNumbers<'py>> {
        let column = |number: fn(&Flywheel) -> f64| {
            let values = self.0.iter().map(|flywheel| flywheel.as_ref().map_or(f64::NAN, number));
            PyArray1::from_vec(py, values.collect())
        };
        detach::catch_panic(|| {
            Ok(FlywheelNumbers {
                inertia: column(|f| f.inertia),
                speed0: column(|f| f.speed0),
                motor_moment: column(|f| f.cycle.motor),
                greatest_at: column(|f| f.greatest.at),
                greatest: column(|f| f.greatest.value),
                least_at: column(|f| f.least.at),
                least: column(|f| f.least.value),
                period: column(Flywheel::period),
            })
        })
    }

    /// The error of a table without a flywheel.
    fn problem(&self, index: usize) -> Option<String> {
        self.0.get(index)?.as_ref().err().map(Hint::with_hint)
    }

    /// The exception of a table without a flywheel. `label`: its name at the beginning of the
    /// message; `design`: its index in the batch.
    fn failure(
        &self,
        py: Python<'_>,
        index: usize,
        label: &str,
        design: Option<Vec<usize>>,
    ) -> Option<Py<PyBaseException>> {
        let error = self.0.get(index)?.as_ref().err()?;
        Some(error_map::table(error, label, design).into_value(py))
    }

    /// A quantity of every table at the same number of coordinates or times, table after table.
    fn curve<'py>(
        &self,
        py: Python<'py>,
        quantity: Word<Curve>,
        points: Flat<'py>,
    ) -> PyResult<Array<'py>> {
        let points = points.as_slice()?.to_vec();
        let per_table = points.len().checked_div(self.0.len()).unwrap_or(0).max(1);
        let values = detach::map(py, points.len(), |i| {
            let (x, flywheel) =
                (points[i], self.0.get(i / per_table).and_then(|flywheel| flywheel.as_ref().ok()));
            flywheel.filter(|_| x.is_finite()).map_or(f64::NAN, |f| quantity.0.at(f, x))
        })?;
        Ok(PyArray1::from_vec(py, values))
    }
}
