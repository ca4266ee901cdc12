//! Flywheels of many tables; Python checks, broadcasts and reshapes.

use assur::dynamics::{Cycle, EndCondition, Flywheel, Mean, TableError};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;

use crate::spread::spread;
use crate::{error, gate};

type Flat<'py> = PyReadonlyArray1<'py, f64>;
type Array<'py> = Bound<'py, PyArray1<f64>>;
type One = Result<Flywheel, TableError>;

/// Tables a thread takes at once, and below which one thread does all.
const TOGETHER: usize = 64;

/// What is asked of every table.
#[derive(Clone, Copy)]
enum Task {
    /// A fluctuation at a mean speed.
    Sized(Mean),
    /// A flywheel at a mean speed.
    Driven(Mean),
    /// A flywheel with a speed at the beginning.
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
            _ => return Err(error::input(format!("no such task: {name:?}"), None)),
        })
    }

    fn solve(self, turn: Cycle, [first, second]: [f64; 2]) -> One {
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
        _ => return Err(error::input(format!("no such spline: {name:?}"), None)),
    })
}

/// The flywheels of some tables with the same angles.
#[pyclass(frozen, module = "assur._core")]
pub(crate) struct Flywheels(Vec<One>);

#[pymethods]
impl Flywheels {
    /// `moment` and `inertia`: table after table; `first` and `second`: two numbers a table, what
    /// they are is told by `task`.
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
            return Err(error::input("the arrays do not fit".into(), None));
        }
        let corners = corners.unwrap_or_default();
        let one = |i: usize| {
            let of = |all: &[f64]| all[i * rows..(i + 1) * rows].to_vec();
            Cycle::with_corners(&phi, &of(&moment), &of(&inertia), ends, &corners)
                .and_then(|turn| task.solve(turn, [first[i], second[i]]))
        };
        gate::run(py, count <= TOGETHER, |cancel| spread(count, TOGETHER, threads, cancel, &one))
            .map(Self)
    }

    /// Of every table: flywheel, speed at the beginning, motor, place and value of the greatest
    /// speed and of the least, time of a turn. NaN where there is none.
    fn numbers<'py>(&self, py: Python<'py>) -> PyResult<Vec<Array<'py>>> {
        let of: [fn(&Flywheel) -> f64; 8] = [
            |f| f.inertia,
            |f| f.speed0,
            |f| f.cycle.motor,
            |f| f.greatest.at,
            |f| f.greatest.value,
            |f| f.least.at,
            |f| f.least.value,
            Flywheel::period,
        ];
        let all = |of: fn(&Flywheel) -> f64| {
            self.0.iter().map(|one| one.as_ref().map_or(f64::NAN, of)).collect()
        };
        gate::guard(|| Ok(of.into_iter().map(|of| PyArray1::from_vec(py, all(of))).collect()))
    }

    /// Why a table has none.
    fn problem(&self, index: usize) -> Option<String> {
        self.0.get(index)?.as_ref().err().map(ToString::to_string)
    }

    /// A quantity of every table at as many places, table after table.
    fn curve<'py>(&self, py: Python<'py>, what: &str, places: Flat<'py>) -> PyResult<Array<'py>> {
        let of: fn(&Flywheel, f64) -> f64 = match what {
            "speed" => Flywheel::speed,
            "time" => Flywheel::time,
            "angle" => Flywheel::angle,
            "moment" => |f, phi| f.cycle.moment(phi),
            "inertia" => |f, phi| f.cycle.inertia(phi),
            "work" => |f, phi| f.cycle.work(phi),
            _ => return Err(error::input(format!("no such curve: {what:?}"), None)),
        };
        let places = places.as_slice()?.to_vec();
        let each = places.len().checked_div(self.0.len()).unwrap_or(0).max(1);
        let values = gate::each(py, places.len(), |i| {
            let (x, one) = (places[i], self.0.get(i / each).and_then(|one| one.as_ref().ok()));
            one.filter(|_| x.is_finite()).map_or(f64::NAN, |f| of(f, x))
        })?;
        Ok(PyArray1::from_vec(py, values))
    }
}
