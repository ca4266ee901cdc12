//! Makes a run.

use super::callbacks::Callbacks;
use super::dead_point::Tail;
use super::equation::Equation;
use super::error::{RunError, counted};
use super::model::{MechanismModel, ReducedModel, TabulatedMachine};
use super::options::{EventKind, RunOptions, Variable};
use super::sample::Samples;
use super::system::{Ended, RunSystem};
use super::table_cursor::TOGETHER;
use super::tolerances::tolerances;
use super::trajectory::{EventRecord, Run, StopReason, moment};
use crate::dynamics::machine::Machine;
use crate::dynamics::tables::table::Table;
use crate::math::derivatives::DerivativeTables;
use crate::ode::error::Error;
use crate::ode::integrator::Integrator;
use crate::ode::options::{Options, Output};
use crate::ode::solution::{End, Solution};
use crate::ode::system::System;
use crate::plan::mechanism::Mechanism;
use crate::query::evaluator::NearMiss;
use crate::state::status::Status;

/// What a run cannot be made for.
pub type IntegrationError<E> = Error<RunError<E>>;

impl Machine {
    /// Makes a run of a design of the mechanism.
    ///
    /// # Errors
    ///
    /// What cannot be begun, and where there is nothing to be accelerated.
    pub fn run<O: Callbacks>(
        &self,
        mechanism: &Mechanism,
        dimensions: &[f64],
        task: &RunOptions<'_>,
        outside: O,
    ) -> Result<Run, IntegrationError<O::Error>> {
        let drivers = mechanism.q0().len();
        task.check(drivers, &self.motors).map_err(Error::System)?;
        let needed = mechanism.dimensions().len();
        counted(&[("dimensions", needed, dimensions.len())]).map_err(Error::System)?;
        let jets = DerivativeTables::new(drivers, 2);
        let source = MechanismModel::new(self, mechanism, dimensions, &jets);
        let sizes: Vec<f64> = (0..task.q.len()).map(|driver| source.unit(driver)).collect();
        let equation = Equation::new(source, outside, &self.tables, &self.motors, task.q.len());
        run(equation, task, &sizes)
    }
}

impl TabulatedMachine {
    /// Makes a run.
    ///
    /// # Errors
    ///
    /// As of [`Machine::run`].
    pub fn run<O: Callbacks>(
        &self,
        task: &RunOptions<'_>,
        outside: O,
    ) -> Result<Run, IntegrationError<O::Error>> {
        task.check(1, &self.motors).map_err(Error::System)?;
        self.check().map_err(Error::System)?;
        run(Equation::new(self, outside, &self.tables, &self.motors, 1), task, &[1.0])
    }

    /// Inertia and moment are its first two tables.
    pub(crate) fn check<E>(&self) -> Result<(), RunError<E>> {
        counted(&[("tables of inertia and moment", 2, self.tables.len().min(2))])
    }
}

/// Makes it; `sizes`: what a coordinate's tolerance is a part of.
pub(crate) fn run<S: ReducedModel, O: Callbacks>(
    mut equation: Equation<'_, S, O>,
    task: &RunOptions<'_>,
    sizes: &[f64],
) -> Result<Run, IntegrationError<O::Error>> {
    equation.flywheel = task.flywheel;
    equation.begin(task.q[0], task.speed).map_err(Error::System)?;
    let mut way = RunSystem::new(equation, task);
    way.begin(task).map_err(Error::System)?;
    let (from, end) = match task.along {
        Variable::Time => (task.t, task.end),
        Variable::Coordinate => (task.q[0], task.end),
    };
    let (to, clipped) = match task.along {
        Variable::Time => (end, None),
        Variable::Coordinate => clip(way.equation.tables, from, end),
    };
    let breaks = match task.along {
        Variable::Time => task.breaks.to_vec(),
        Variable::Coordinate => {
            breaks_of(way.equation.tables, task.breaks, [from, to]).map_err(Error::System)?
        }
    };
    let [relative, absolute] = tolerances(&mut way, task, sizes).map_err(Error::System)?;
    let crossings = way.crossings();
    // A smooth motion in wide steps does not show what the mechanism does on the way.
    let looks = task.watches.iter().any(|w| matches!(w.occasion, EventKind::Angle(..)));
    let (mut max_step, mut max_change) = (task.max_step, Vec::new());
    if looks && task.along == Variable::Coordinate {
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
        output: Output::Dense,
    };
    let mut integrator = Integrator::new(task.method, way.len());
    let start = RunSystem::<S, O>::start(task);
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
) -> Result<Vec<f64>, RunError<E>> {
    let count: f64 = tables.iter().map(|table| table.knots_in((to - from).abs())).sum();
    let far = from.abs().max(to.abs());
    // Beyond a table's own accuracy knots are none.
    if count > MOST_KNOTS || (!tables.is_empty() && far > FARTHEST) {
        return Err(RunError::ManyKnots { most: MOST_KNOTS, from, to });
    }
    let range = [from.min(to), from.max(to)];
    let mut breaks = given.to_vec();
    breaks.extend(tables.iter().flat_map(|table| table.knots_within(range)));
    breaks.sort_unstable_by(f64::total_cmp);
    breaks.dedup_by(|a, b| (*a - *b).abs() <= TOGETHER * b.abs().max(1.0));
    Ok(breaks)
}

/// Nothing is beyond: why, and where that was found.
fn edge<S: ReducedModel, O: Callbacks>(equation: &mut Equation<'_, S, O>) -> StopReason {
    let (status, q) = equation.refused.take().unwrap_or((Status::Singular, Vec::new()));
    if let (Status::NearSingular, &[at]) = (status, &q[..])
        && let Some(NearMiss { dyad, miss, q }) = equation.source.near_miss(at)
    {
        return StopReason::NearChangePoint { dyad, miss, q };
    }
    StopReason::Edge(status, q)
}

fn finish<S: ReducedModel, O: Callbacks>(
    mut way: RunSystem<'_, S, O>,
    task: &RunOptions<'_>,
    from: f64,
    solution: Solution,
    clipped: Option<usize>,
) -> Run {
    let Solution { end, events, event_states, dense: path, statistics, y: y_end, .. } = solution;
    let (along, sign, len) = (way.along, way.sign, way.len());
    let read = |x: f64, y: &[f64]| moment(along, sign, x, y, &vec![f64::NAN; len]);
    let happened = |(event, y): (&crate::ode::solution::Event, &[f64])| {
        let watch = way.watch(event.index)?;
        let own = read(event.t, y);
        Some(EventRecord { watch, t: own.t, q: own.q, speed: own.speed })
    };
    let events = events.iter().zip(event_states.chunks_exact(len)).filter_map(happened).collect();
    let last_work = y_end[len - 1];
    let ending = match (end, way.ended) {
        (End::Reached, _) => clipped.map_or(StopReason::Reached, StopReason::TableEnds),
        (End::Cancelled { .. }, Some(Ended::Late)) => StopReason::Late,
        (End::Cancelled { .. }, _) => StopReason::Cancelled,
        (_, Some(Ended::Table(which))) => StopReason::TableEnds(which),
        (_, Some(Ended::Motor(which))) => StopReason::MotorTableEnds(which),
        (_, Some(Ended::Dead)) => edge(&mut way.equation),
        (End::Event { index, .. }, _) => {
            way.watch(index).map_or(StopReason::Stalled, StopReason::Event)
        }
        (End::DomainBoundary { t } | End::Stalled { t }, _)
            if along == Variable::Coordinate && way.is_dead(&[t], last_work) =>
        {
            edge(&mut way.equation)
        }
        (End::DomainBoundary { .. }, _) if way.equation.is_near_miss() => edge(&mut way.equation),
        (End::DomainBoundary { .. }, _) if along == Variable::Coordinate => StopReason::Rest,
        (End::DomainBoundary { .. }, _) => edge(&mut way.equation),
        (End::StepLimit { stiff, .. }, _) => StopReason::StepLimit(stiff),
        (End::Stalled { .. }, _) => StopReason::Stalled,
    };
    let mut moments = Samples::default();
    let (mut y, mut rates) = (vec![0.0; len], vec![0.0; len]);
    if path.at(from, &mut y) && path.slope(from, &mut rates) {
        moments.read(along, sign, from, &y, &rates);
    } else {
        // A run of no length has its rates too.
        let start = RunSystem::<S, O>::start(task);
        if way.rates(from, &start, &mut rates).is_err() {
            rates.fill(f64::NAN);
        }
        moments.read(along, sign, from, &start, &rates);
    }
    path.each_end(|x, y, rates| moments.read(along, sign, x, y, rates));
    let tail = match (&ending, moments.last()) {
        (StopReason::Edge(..), Some(last)) if last.q.len() == 1 => {
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
