//! Flywheels of many tables. Python checks, broadcasts and reshapes the arrays.

use assur::Hint;
use assur::dynamics::{Cycle, EndCondition, Flywheel, Mean, TableError};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::exceptions::PyBaseException;
use pyo3::prelude::*;

use crate::parallel_map::parallel_map;
use crate::{detach, error, error_map};

type Flat<'py> = PyReadonlyArray1<'py, f64>;
type Array<'py> = Bound<'py, PyArray1<f64>>;
type Outcome = Result<Flywheel, TableError>;

/// Tables per thread; up to this number one thread does all.
const TABLES_PER_THREAD: usize = 64;

/// What to solve for each table.
#[derive(Clone, Copy)]
enum Task {
    /// The flywheel for a fluctuation at a mean speed.
    Sized(Mean),
    /// The motion with a flywheel at a mean speed.
    Driven(Mean),
    /// The motion with a flywheel from an initial speed.
    Given,
}

impl Task {
    fn of(name: &str) -> PyResult<Self> {
        Ok(match name {
            "sized extremes" => Self::Sized(Mean::Extremes),
            "sized period" => Self::Sized(Mean::Period),
            "driven extremes" => Self::Driven(Mean::Extremes),
            "driven period" => Self::Driven(Mean::Period),
            "given" => Self::Given,
            _ => return Err(error::input(&format!("no such task: {name:?}"), None)),
        })
    }

    fn solve(self, turn: Cycle, [first, second]: [f64; 2]) -> Outcome {
        match self {
            Self::Sized(mean) => Flywheel::for_fluctuation(turn, first, second, mean),
            Self::Driven(mean) => Flywheel::for_mean_speed(turn, first, second, mean),
            Self::Given => Flywheel::for_initial_speed(turn, first, second),
        }
    }
}

pub(crate) fn ends(name: &str) -> PyResult<EndCondition> {
    Ok(match name {
        "not-a-knot" => EndCondition::NotAKnot,
        "natural" => EndCondition::Natural,
        "clamped" => EndCondition::Clamped,
        "periodic" => EndCondition::Periodic,
        "linear" => EndCondition::Linear,
        _ => return Err(error::input(&format!("no such spline: {name:?}"), None)),
    })
}

/// The flywheels of several tables with the same angles.
#[pyclass(frozen, module = "assur._core")]
pub(crate) struct Flywheels(Vec<Outcome>);

#[pymethods]
impl Flywheels {
    /// `moment` and `inertia`: table after table. `first` and `second`: two numbers for each table;
    /// `task` sets their meaning.
    #[new]
    #[pyo3(signature = (phi, moment, inertia, spline, task, first, second, threads=None, corners=None))]
    #[allow(clippy::too_many_arguments, reason = "flat arrays")]
    fn new(
        py: Python<'_>,
        phi: Flat<'_>,
        moment: Flat<'_>,
        inertia: Flat<'_>,
        spline: &str,
        task: &str,
        first: Flat<'_>,
        second: Flat<'_>,
        threads: Option<usize>,
        corners: Option<Vec<usize>>,
    ) -> PyResult<Self> {
        let (ends, task) = (ends(spline)?, Task::of(task)?);
        let [phi, moment, inertia, first, second] =
            [&phi, &moment, &inertia, &first, &second].map(|a| a.as_slice().map(<[f64]>::to_vec));
        let (phi, moment, inertia, first, second) = (phi?, moment?, inertia?, first?, second?);
        let (count, rows) = (first.len(), phi.len());
        if second.len() != count || [&moment, &inertia].iter().any(|a| a.len() != count * rows) {
            return Err(error::input("the arrays do not fit", None));
        }
        let corners = corners.unwrap_or_default();
        let one = |i: usize| {
            let table = |all: &[f64]| all[i * rows..(i + 1) * rows].to_vec();
            Cycle::with_corners(&phi, &table(&moment), &table(&inertia), ends, &corners)
                .and_then(|turn| task.solve(turn, [first[i], second[i]]))
        };
        detach::run(py, count <= TABLES_PER_THREAD, |cancel| {
            parallel_map(count, TABLES_PER_THREAD, threads, cancel, &one)
        })
        .map(Self)
    }

    /// For each table: flywheel, initial speed, moment of the motor, angle and value of the
    /// greatest speed and of the least, period. NaN for a table without a flywheel.
    fn numbers<'py>(&self, py: Python<'py>) -> PyResult<Vec<Array<'py>>> {
        let columns: [fn(&Flywheel) -> f64; 8] = [
            |f| f.inertia,
            |f| f.speed0,
            |f| f.cycle.motor,
            |f| f.greatest.at,
            |f| f.greatest.value,
            |f| f.least.at,
            |f| f.least.value,
            Flywheel::period,
        ];
        let values = |column: fn(&Flywheel) -> f64| {
            self.0.iter().map(|one| one.as_ref().map_or(f64::NAN, column)).collect()
        };
        detach::catch_panic(|| {
            Ok(columns.into_iter().map(|column| PyArray1::from_vec(py, values(column))).collect())
        })
    }

    /// Why a table has no flywheel.
    fn problem(&self, index: usize) -> Option<String> {
        self.0.get(index)?.as_ref().err().map(Hint::with_hint)
    }

    /// The exception of a table without a flywheel. `place`: its name at the beginning of the
    /// message; `design`: its index in the batch.
    fn failure(
        &self,
        py: Python<'_>,
        index: usize,
        place: &str,
        design: Option<Vec<usize>>,
    ) -> Option<Py<PyBaseException>> {
        let error = self.0.get(index)?.as_ref().err()?;
        Some(error_map::table(error, place, design).into_value(py))
    }

    /// A quantity of every table at the same number of angles, table after table.
    fn curve<'py>(&self, py: Python<'py>, what: &str, places: Flat<'py>) -> PyResult<Array<'py>> {
        let quantity: fn(&Flywheel, f64) -> f64 = match what {
            "speed" => Flywheel::speed,
            "time" => Flywheel::time,
            "angle" => Flywheel::angle,
            "moment" => |f, phi| f.cycle.moment(phi),
            "inertia" => |f, phi| f.cycle.inertia(phi),
            "work" => |f, phi| f.cycle.work(phi),
            _ => return Err(error::input(&format!("no such curve: {what:?}"), None)),
        };
        let places = places.as_slice()?.to_vec();
        let per_table = places.len().checked_div(self.0.len()).unwrap_or(0).max(1);
        let values = detach::map(py, places.len(), |i| {
            let (x, one) = (places[i], self.0.get(i / per_table).and_then(|one| one.as_ref().ok()));
            one.filter(|_| x.is_finite()).map_or(f64::NAN, |f| quantity(f, x))
        })?;
        Ok(PyArray1::from_vec(py, values))
    }
}
