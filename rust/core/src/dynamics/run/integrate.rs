//! Makes a run.

use super::callbacks::Outside;
use super::dead_point::Tail;
use super::equation::Equation;
use super::error::{Broken, counted};
use super::model::{Moving, Sheet, Source};
use super::options::{Along, Occasion, Task};
use super::sample::Moments;
use super::system::{Ended, Way};
use super::table_cursor::TOGETHER;
use super::tolerances::tolerances;
use super::trajectory::{Ending, Happened, Run, moment};
use crate::dynamics::machine::Machine;
use crate::dynamics::tables::table::Table;
use crate::math::derivatives::Jets;
use crate::ode::error::Error;
use crate::ode::integrator::Integrator;
use crate::ode::options::{Keep, Options};
use crate::ode::solution::{End, Solution};
use crate::ode::system::System;
use crate::plan::mechanism::Mechanism;
use crate::query::evaluator::NearMiss;
use crate::state::status::Status;

/// What a run cannot be made for.
pub type RunError<E> = Error<Broken<E>>;

impl Machine {
    /// Makes a run of a design of the mechanism.
    ///
    /// # Errors
    ///
    /// What cannot be begun, and where there is nothing to be accelerated.
    pub fn run<O: Outside>(
        &self,
        mechanism: &Mechanism,
        dimensions: &[f64],
        task: &Task<'_>,
        outside: O,
    ) -> Result<Run, RunError<O::Error>> {
        let drivers = mechanism.q0().len();
        task.check(drivers, &self.motors).map_err(Error::System)?;
        let needed = mechanism.dimensions().len();
        counted(&[("dimensions", needed, dimensions.len())]).map_err(Error::System)?;
        let jets = Jets::new(drivers, 2);
        let source = Moving::new(self, mechanism, dimensions, &jets);
        let sizes: Vec<f64> = (0..task.q.len()).map(|driver| source.unit(driver)).collect();
        let equation = Equation::new(source, outside, &self.tables, &self.motors, task.q.len());
        run(equation, task, &sizes)
    }
}

impl Sheet {
    /// Makes a run.
    ///
    /// # Errors
    ///
    /// As of [`Machine::run`].
    pub fn run<O: Outside>(&self, task: &Task<'_>, outside: O) -> Result<Run, RunError<O::Error>> {
        task.check(1, &self.motors).map_err(Error::System)?;
        self.check().map_err(Error::System)?;
        run(Equation::new(self, outside, &self.tables, &self.motors, 1), task, &[1.0])
    }

    /// Inertia and moment are its first two tables.
    pub(crate) fn check<E>(&self) -> Result<(), Broken<E>> {
        counted(&[("tables of inertia and moment", 2, self.tables.len().min(2))])
    }
}

/// Makes it; `sizes`: what a coordinate's tolerance is a part of.
pub(crate) fn run<S: Source, O: Outside>(
    mut equation: Equation<'_, S, O>,
    task: &Task<'_>,
    sizes: &[f64],
) -> Result<Run, RunError<O::Error>> {
    equation.flywheel = task.flywheel;
    equation.begin(task.q[0], task.speed).map_err(Error::System)?;
    let mut way = Way::new(equation, task);
    way.begin(task).map_err(Error::System)?;
    let (from, end) = match task.along {
        Along::Time => (task.t, task.end),
        Along::Coordinate => (task.q[0], task.end),
    };
    let (to, clipped) = match task.along {
        Along::Time => (end, None),
        Along::Coordinate => clip(way.equation.tables, from, end),
    };
    let breaks = match task.along {
        Along::Time => task.breaks.to_vec(),
        Along::Coordinate => {
            breaks_of(way.equation.tables, task.breaks, [from, to]).map_err(Error::System)?
        }
    };
    let [relative, absolute] = tolerances(&mut way, task, sizes).map_err(Error::System)?;
    let crossings = way.crossings();
    // A smooth motion in wide steps does not show what the mechanism does on the way.
    let looks = task.watches.iter().any(|w| matches!(w.occasion, Occasion::Angle(..)));
    let (mut max_step, mut max_change) = (task.max_step, Vec::new());
    if looks && task.along == Along::Coordinate {
        max_step = max_step.min(LOOK);
    } else if looks || sizes.len() > 1 {
        // With several drivers positions are followed from one to the next.
        let most = if looks { LOOK } else { STRIDE };
        max_change.extend(sizes.iter().map(|size| most * size));
    }
    let options = Options {
        relative: &relative,
        absolute: &absolute,
        first_step: None,
        max_step,
        max_change: &max_change,
        max_steps: task.max_steps,
        breaks: &breaks,
        events: &crossings,
        keep: Keep::Path,
    };
    let mut integrator = Integrator::new(task.method, way.len());
    let start = Way::<S, O>::start(task);
    let solution = integrator.run(&mut way, from, &start, to, &options)?;
    Ok(finish(way, task, from, solution, clipped))
}

/// Where a run along the coordinate must end, as a table does, and which.
fn clip(tables: &[Table], from: f64, end: f64) -> (f64, Option<usize>) {
    let mut clipped = (end, None);
    if from == end {
        return clipped;
    }
    for (which, table) in tables.iter().enumerate() {
        let [first, last] = table.range();
        let limit = if end > from { last } else { first };
        if table.period().is_none() && (clipped.0 - limit) * (end - from).signum() > 0.0 {
            clipped = (limit, Some(which));
        }
    }
    clipped
}

/// How far (rad, or of the size) a step goes where angles of the mechanism are looked at.
const LOOK: f64 = 0.1;
/// The same with several drivers, where nothing is.
const STRIDE: f64 = 1.0;
/// Knots on a way along the coordinate, at most: they are all known beforehand.
const MOST_KNOTS: f64 = 1.0e7;
/// Coordinates beyond this have no place in a table.
const FARTHEST: f64 = 1.0e9;

/// Knots of tables between two coordinates, with breaks that are given; knots of several tables at
/// one place are one.
pub(crate) fn breaks_of<E>(
    tables: &[Table],
    given: &[f64],
    [from, to]: [f64; 2],
) -> Result<Vec<f64>, Broken<E>> {
    let count: f64 = tables.iter().map(|table| table.knots_in((to - from).abs())).sum();
    let far = from.abs().max(to.abs());
    // Beyond a table's own accuracy knots are none.
    if count > MOST_KNOTS || (!tables.is_empty() && far > FARTHEST) {
        return Err(Broken::ManyKnots { most: MOST_KNOTS, from, to });
    }
    let range = [from.min(to), from.max(to)];
    let mut breaks = given.to_vec();
    breaks.extend(tables.iter().flat_map(|table| table.knots_within(range)));
    breaks.sort_unstable_by(f64::total_cmp);
    breaks.dedup_by(|a, b| (*a - *b).abs() <= TOGETHER * b.abs().max(1.0));
    Ok(breaks)
}

/// Nothing is beyond: why, and where that was found.
fn edge<S: Source, O: Outside>(equation: &mut Equation<'_, S, O>) -> Ending {
    let (status, q) = equation.refused.take().unwrap_or((Status::Singular, Vec::new()));
    if let (Status::NearSingular, &[at]) = (status, &q[..])
        && let Some(NearMiss { dyad, miss, q }) = equation.source.near_miss(at)
    {
        return Ending::NearChangePoint { dyad, miss, q };
    }
    Ending::Edge(status, q)
}

fn finish<S: Source, O: Outside>(
    mut way: Way<'_, S, O>,
    task: &Task<'_>,
    from: f64,
    solution: Solution,
    clipped: Option<usize>,
) -> Run {
    let Solution { end, events, event_states, path, statistics, y: y_end, .. } = solution;
    let (along, sign, len) = (way.along, way.sign, way.len());
    let read = |x: f64, y: &[f64]| moment(along, sign, x, y, &vec![f64::NAN; len]);
    let happened = |(event, y): (&crate::ode::solution::Event, &[f64])| {
        let watch = way.watch(event.index)?;
        let own = read(event.t, y);
        Some(Happened { watch, t: own.t, q: own.q, speed: own.speed })
    };
    let events = events.iter().zip(event_states.chunks_exact(len)).filter_map(happened).collect();
    let last_work = y_end[len - 1];
    let ending = match (end, way.ended) {
        (End::Reached, _) => clipped.map_or(Ending::Reached, Ending::TableEnds),
        (End::Cancelled { .. }, Some(Ended::Late)) => Ending::Late,
        (End::Cancelled { .. }, _) => Ending::Cancelled,
        (_, Some(Ended::Table(which))) => Ending::TableEnds(which),
        (_, Some(Ended::Motor(which))) => Ending::MotorTableEnds(which),
        (_, Some(Ended::Dead)) => edge(&mut way.equation),
        (End::Event { index, .. }, _) => way.watch(index).map_or(Ending::Stalled, Ending::Event),
        (End::Edge { t } | End::Stalled { t }, _)
            if along == Along::Coordinate && way.is_dead(&[t], last_work) =>
        {
            edge(&mut way.equation)
        }
        (End::Edge { .. }, _) if way.equation.is_near_miss() => edge(&mut way.equation),
        (End::Edge { .. }, _) if along == Along::Coordinate => Ending::Rest,
        (End::Edge { .. }, _) => edge(&mut way.equation),
        (End::StepLimit { stiff, .. }, _) => Ending::StepLimit(stiff),
        (End::Stalled { .. }, _) => Ending::Stalled,
    };
    let mut moments = Moments::default();
    let (mut y, mut rates) = (vec![0.0; len], vec![0.0; len]);
    if path.at(from, &mut y) && path.slope(from, &mut rates) {
        moments.read(along, sign, from, &y, &rates);
    } else {
        // A run of no length has its rates too.
        let start = Way::<S, O>::start(task);
        if way.rates(from, &start, &mut rates).is_err() {
            rates.fill(f64::NAN);
        }
        moments.read(along, sign, from, &start, &rates);
    }
    path.each_end(|x, y, rates| moments.read(along, sign, x, y, rates));
    let tail = match (&ending, moments.last()) {
        (Ending::Edge(..), Some(last)) if last.q.len() == 1 => {
            let fold = way.equation.source.fold(last.q[0], last.speed[0]);
            fold.and_then(|fold| Tail::of(&last, fold))
        }
        _ => None,
    };
    // Backward: with several drivers each place is reached from the one before.
    let mut energies = vec![[f64::NAN; 2]; moments.len()];
    for (index, pair) in energies.iter_mut().enumerate().rev() {
        let (q, speed) = moments.state(index);
        if way.equation.find(q[0]) && way.equation.place(q).is_ok() {
            let reduced = &way.equation.reduced;
            *pair = [reduced.kinetic(speed), reduced.potential];
        }
    }
    if let (Some(tail), Some(&energy)) = (&tail, energies.last()) {
        moments.push(&tail.end());
        energies.push(energy);
    }
    Run { moments, energies, events, ending, statistics, along, sign, path, tail }
}
