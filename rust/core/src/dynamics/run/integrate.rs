//! Integrates the equation of motion into a run.

use super::callbacks::Callbacks;
use super::dead_point::Tail;
use super::equation::Equation;
use super::error::{RunError, check_counts};
use super::model::ReducedModel;
use super::options::{EventKind, RunOptions};
use super::sample::Samples;
use super::stick_slip::Change;
use super::system::{Ended, RunSystem};
use super::table_cursor::{MAX_COORDINATE, MAX_KNOTS, same_within};
use super::tabulated::TabulatedMachine;
use super::tolerances::tolerances;
use super::trajectory::{EventRecord, Run, StopReason, sample_at};
use super::variable::Variable;
use crate::description::error::Hint;
use crate::dynamics::tables::table::Table;
use crate::math::room::has_room;
use crate::ode::error::Error as IntegratorError;
use crate::ode::integrator::Integrator;
use crate::ode::options::{Options, Output};
use crate::ode::solution::{End, Solution};
use crate::ode::system::{Crossing, System};
use crate::query::evaluator::NearMiss;
use crate::query::failure::{Failure, Reason};
use crate::state::status::{Rejection, Status};

impl TabulatedMachine {
    /// Integrates the motion of the tabulated machine.
    ///
    /// # Errors
    ///
    /// Those of [`crate::dynamics::Machine::run`].
    pub fn run<O: Callbacks>(
        &self,
        options: &RunOptions<'_>,
        callbacks: O,
    ) -> Result<Run, RunError<O::Error>> {
        options.check(1, &self.motors)?;
        self.check()?;
        let mut model = self;
        run(Equation::new(&mut model, callbacks, &self.tables, &self.motors, 1), options, &[1.0])
    }

    /// Checks that there are tables of inertia and moment, the first two.
    pub(crate) fn check<E>(&self) -> Result<(), RunError<E>> {
        check_counts(&[("tables of inertia and moment", 2, self.tables.len().min(2))])
    }
}

/// Integrates the motion; `sizes`: for each driver, the size that its tolerance is relative to.
pub(crate) fn run<'a, S: ReducedModel, O: Callbacks>(
    equation: Equation<'a, S, O>,
    options: &RunOptions<'a>,
    sizes: &[f64],
) -> Result<Run, RunError<O::Error>> {
    let (mut system, prepared) = prepare(equation, options, sizes)?;
    let mut integrator = Integrator::new(options.method, system.len());
    let ode_options = prepared.options(options);
    let [from, to] = prepared.range;
    let solution = integrator.run(&mut system, from, &prepared.start, to, &ode_options);
    conclude(system, options, &prepared, solution, |_| Vec::new())
}

/// What the integrator needs of a run.
pub(crate) struct Prepared {
    /// Where it begins, and where it is to end.
    pub range: [f64; 2],
    /// Its initial state.
    pub start: Vec<f64>,
    /// The table at whose end it ends.
    clipped: Option<usize>,
    tolerances: [Vec<f64>; 2],
    breaks: Vec<f64>,
    crossings: Vec<Crossing>,
    max_step: f64,
    max_change: Vec<f64>,
}

impl Prepared {
    /// The options of the integrator.
    pub(crate) fn options(&self, options: &RunOptions<'_>) -> Options<'_> {
        let [relative, absolute] = &self.tolerances;
        Options {
            relative,
            absolute,
            first_step: None,
            max_step: self.max_step,
            max_change: &self.max_change,
            max_steps: options.max_steps,
            breaks: &self.breaks,
            events: &self.crossings,
            output: Output::Dense,
        }
    }
}

/// The system of a run, and what the integrator needs.
type Set<'a, S, O> = (RunSystem<'a, S, O>, Prepared);

/// Sets up the system of a run.
pub(crate) fn prepare<'a, S: ReducedModel, O: Callbacks>(
    mut equation: Equation<'a, S, O>,
    options: &RunOptions<'a>,
    sizes: &[f64],
) -> Result<Set<'a, S, O>, RunError<O::Error>> {
    equation.flywheel = options.flywheel;
    equation.begin(options.q[0], options.speed)?;
    let (from, end) = match options.along {
        Variable::Time => (options.t, options.end),
        Variable::Coordinate => (options.q[0], options.end),
    };
    let (mut to, mut clipped) = match options.along {
        Variable::Time => (end, None),
        Variable::Coordinate => clip_to_tables(equation.tables, from, end),
    };
    let mut stations = Vec::new();
    match (options.along, options.q) {
        (Variable::Time, &[q]) => equation.begin_in_time(q, options.speed[0])?,
        (Variable::Coordinate, _) => {
            stations = stations_between(equation.model, [from, to])?;
            if let Some((end, which)) = equation.first_uncovered([from, to], &stations) {
                (to, clipped) = (end, Some(which));
                stations.retain(|&station| (station - end) * (to - from).signum() < 0.0);
            }
            equation.begin_along([from, to], &stations)?;
        }
        _ => {}
    }
    let mut system = RunSystem::new(equation, options, sizes[0]);
    system.store_initial_energy(options)?;
    if let (&[q], &[speed]) = (options.q, options.speed) {
        system.phase = system.equation.first_phase(options.t, q, speed)?;
    }
    let breaks = match options.along {
        Variable::Time => options.breaks.to_vec(),
        Variable::Coordinate => {
            let knots = [options.breaks, &stations].concat();
            breaks_of(system.equation.tables, &knots, [from, to], sizes[0])?
        }
    };
    let tolerances = tolerances(&mut system, options, sizes)?;
    let crossings = system.crossings();
    // Wide steps of a smooth motion could skip over an angle's event.
    let has_angle_events =
        options.events.iter().any(|event| matches!(event.kind, EventKind::Angle(..)));
    let (mut max_step, mut max_change) = (options.max_step, Vec::new());
    if has_angle_events && options.along == Variable::Coordinate {
        max_step = max_step.min(ANGLE_EVENT_STEP * sizes[0]);
    } else if has_angle_events || sizes.len() > 1 {
        // With several drivers each position is solved from the one before.
        let largest = if has_angle_events { ANGLE_EVENT_STEP } else { SEVERAL_DRIVERS_STEP };
        max_change.extend(sizes.iter().map(|size| largest * size));
    }
    if system.friction_event().is_some() && system.equation.callbacks.count() > 0 {
        // While the machine rests, only these steps find loads that move it.
        max_step = max_step.min((to - from).abs() / STEPS_AT_REST);
    }
    let start = RunSystem::<S, O>::initial_state(options);
    let range = [from, to];
    let prepared =
        Prepared { range, start, clipped, tolerances, breaks, crossings, max_step, max_change };
    Ok((system, prepared))
}

/// The run of a solution; `energies`: those of its samples that are known, and NaN.
pub(crate) fn conclude<S: ReducedModel, O: Callbacks>(
    system: RunSystem<'_, S, O>,
    options: &RunOptions<'_>,
    prepared: &Prepared,
    solution: Result<Solution, IntegratorError<RunError<O::Error>>>,
    energies: impl FnOnce(&Samples) -> Vec<[f64; 2]>,
) -> Result<Run, RunError<O::Error>> {
    let [from, _] = prepared.range;
    let solution = solution.map_err(|error| RunError::of_integrator(error, options.along, from))?;
    // Samples are made from the record, and Python's arrays from the samples.
    let steps = solution.dense.ends().len();
    if !has_room(COPIES * (3 * options.q.len() + 4) * (steps + 2)) {
        return Err(RunError::OutOfMemory { steps });
    }
    Ok(assemble_run(system, options, (from, prepared.clipped), solution, energies))
}

/// Clips the end of a run along the coordinate to its tables; returns it and the table that ends.
fn clip_to_tables(tables: &[Table], from: f64, end: f64) -> (f64, Option<usize>) {
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

/// Copies of a sample in memory at once: one here, and two in Python's arrays.
const COPIES: usize = 3;
/// Least number of steps of a run with friction and functions among the loads.
const STEPS_AT_REST: f64 = 1000.0;
/// Spacings of the coordinate within which a motion that slows down is at rest: its last steps are parts of
/// the rest of the way, some hundredths with the tightest tolerance.
const REST_WITHIN: f64 = 1.0e3;
/// Largest step (rad, or of the size) with events on angles of the mechanism.
const ANGLE_EVENT_STEP: f64 = 0.1;
/// The same with several drivers and no such events.
const SEVERAL_DRIVERS_STEP: f64 = 1.0;
/// Longest motion along the coordinate (rad, or sizes) with loads that follow other coordinates.
const MOST_FOLLOWED: f64 = 1.0e5;

/// The stations between two coordinates, beyond the rounding of these.
pub(crate) fn stations_between<S: ReducedModel, E>(
    model: &mut S,
    [from, to]: [f64; 2],
) -> Result<Vec<f64>, RunError<E>> {
    if !model.has_stations() {
        return Ok(Vec::new());
    }
    let unit = model.unit(0);
    let is_long = (to - from).abs() > MOST_FOLLOWED * unit;
    let is_far = is_long || from.abs().max(to.abs()) > MAX_COORDINATE * unit;
    if is_far {
        model.ignore_reversals();
    }
    if is_far && model.has_stations() {
        return Err(RunError::TooManyKnots { most: MAX_KNOTS, from, to });
    }
    let mut inner_stations = model.stations([from.min(to), from.max(to)]);
    let is_at = |q: f64, end: f64| (q - end).abs() <= same_within(end, unit);
    inner_stations.retain(|&q| !is_at(q, from) && !is_at(q, to));
    Ok(inner_stations)
}

/// Knots of tables between two coordinates, together with given breaks; knots of several tables
/// that coincide count once. `unit` is that of the coordinate.
pub(crate) fn breaks_of<E>(
    tables: &[Table],
    extra: &[f64],
    [from, to]: [f64; 2],
    unit: f64,
) -> Result<Vec<f64>, RunError<E>> {
    let count: f64 = tables.iter().map(|table| table.knots_in((to - from).abs())).sum();
    let far = from.abs().max(to.abs());
    // Beyond this coordinate rounding exceeds the accuracy of the knots.
    if count > MAX_KNOTS || (!tables.is_empty() && far > MAX_COORDINATE * unit) {
        return Err(RunError::TooManyKnots { most: MAX_KNOTS, from, to });
    }
    let range = [from.min(to), from.max(to)];
    let mut breaks = extra.to_vec();
    breaks.extend(tables.iter().flat_map(|table| table.knots_within(range)));
    breaks.sort_unstable_by(f64::total_cmp);
    breaks.dedup_by(|a, b| (*a - *b).abs() <= same_within(*b, unit));
    Ok(breaks)
}

/// Why a motion cannot be continued, and where.
fn edge_reason<S: ReducedModel, O: Callbacks>(equation: &mut Equation<'_, S, O>) -> StopReason {
    let failure = equation.failure();
    let Some((rejection, q)) = equation.rejected.take() else { return StopReason::DeadPoint };
    if let (Rejection::NearMiss { .. }, &[at]) = (rejection, &q[..])
        && let Some(NearMiss { dyad, miss, q }) = equation.model.near_miss(at)
    {
        return StopReason::NearChangePoint { dyad, miss, q };
    }
    match failure {
        Some(Failure {
            reason: Reason::ZeroLength { slide } | Reason::NegativeLength { slide, .. },
            ..
        }) => StopReason::ZeroLength(slide),
        Some(failure) if matches!(failure.status, Status::Lost | Status::NotConverged) => {
            StopReason::Lost(failure.with_hint())
        }
        _ => StopReason::DeadPoint,
    }
}

/// Whether a run along the coordinate comes to rest within the rounding of the coordinate: no step remains,
/// rejected or accepted.
fn is_about_to_rest<S: ReducedModel, O: Callbacks>(
    system: &mut RunSystem<'_, S, O>,
    q: f64,
    y: &[f64],
) -> bool {
    let mut rates = [0.0; 3];
    let slows = system.rates(q, y, &mut rates).is_ok() && rates[0] * system.sign < 0.0;
    slows && y[0] <= REST_WITHIN * f64::EPSILON * (q * rates[0]).abs()
}

fn assemble_run<S: ReducedModel, O: Callbacks>(
    mut system: RunSystem<'_, S, O>,
    options: &RunOptions<'_>,
    (from, clipped): (f64, Option<usize>),
    solution: Solution,
    energies: impl FnOnce(&Samples) -> Vec<[f64; 2]>,
) -> Run {
    let Solution { end, events, event_states, dense: path, statistics, y: y_end, .. } = solution;
    let (along, sign, len) = (system.along, system.sign, system.len());
    let read = |x: f64, y: &[f64]| sample_at(along, sign, x, y, &vec![f64::NAN; len]);
    let friction_event = system.friction_event();
    let mut changes = system.changes.iter();
    let record = |(event, y): (&crate::ode::solution::Event, &[f64])| {
        // After the requested events: stick, and slip.
        let index = if Some(event.index) == friction_event {
            match changes.next()? {
                Change::Stick => options.events.len(),
                Change::Slip => options.events.len() + 1,
                Change::Turn => return None,
            }
        } else {
            system.event_index(event.index)?
        };
        let sample = read(event.t, y);
        Some(EventRecord { event: index, t: sample.t, q: sample.q, speed: sample.speed })
    };
    let events = events.iter().zip(event_states.chunks_exact(len)).filter_map(record).collect();
    let last_work = y_end[len - 1];
    let stop_reason = match (end, system.ended) {
        (End::Reached, _) => clipped.map_or(StopReason::Reached, StopReason::TableEnds),
        (End::Cancelled { .. }, Some(Ended::TimeLimit)) => StopReason::TimeLimit,
        (End::Cancelled { .. }, _) => StopReason::Cancelled,
        (_, Some(Ended::Table(which))) => StopReason::TableEnds(which),
        (_, Some(Ended::Motor(which))) => StopReason::MotorTableEnds(which),
        (_, Some(Ended::DeadPoint)) => edge_reason(&mut system.equation),
        (End::Event { index, .. }, _) => {
            system.event_index(index).map_or(StopReason::Stalled, StopReason::Event)
        }
        (End::DomainBoundary { .. } | End::Stalled { .. }, _) if system.equation.is_locked => {
            StopReason::Locked
        }
        (End::DomainBoundary { t } | End::Stalled { t }, _)
            if along == Variable::Coordinate && system.is_at_dead_point(&[t], last_work) =>
        {
            edge_reason(&mut system.equation)
        }
        (End::DomainBoundary { .. }, _) if system.equation.is_near_miss() => {
            edge_reason(&mut system.equation)
        }
        (End::DomainBoundary { .. }, _) if along == Variable::Coordinate => StopReason::Rest,
        (End::Stalled { t }, _)
            if along == Variable::Coordinate && is_about_to_rest(&mut system, t, &y_end) =>
        {
            StopReason::Rest
        }
        (End::DomainBoundary { .. }, _) => edge_reason(&mut system.equation),
        (End::StepLimit { stiff, .. }, _) => StopReason::StepLimit(stiff),
        (End::Stalled { .. }, _) => StopReason::Stalled,
    };
    // The start and the steps; few runs end at a dead point.
    let mut samples = Samples::with_room(path.ends().len() + 1, system.drivers);
    let (mut y, mut rates) = (vec![0.0; len], vec![0.0; len]);
    if path.at(from, &mut y) && path.slope(from, &mut rates) {
        samples.push_state(along, sign, from, &y, &rates);
    } else {
        // A run of zero length has no dense output.
        let start = RunSystem::<S, O>::initial_state(options);
        if system.rates(from, &start, &mut rates).is_err() {
            rates.fill(f64::NAN);
        }
        samples.push_state(along, sign, from, &start, &rates);
    }
    path.each_end(|x, y, rates| samples.push_state(along, sign, x, y, rates));
    let tail = match (&stop_reason, samples.last()) {
        (StopReason::DeadPoint | StopReason::Lost(_), Some(last)) if last.q.len() == 1 => {
            let dead_point = system.equation.model.dead_point_ahead(last.q[0], last.speed[0]);
            let unit = system.equation.model.unit(0);
            dead_point.and_then(|dead_point| Tail::of(&last, dead_point, unit))
        }
        _ => None,
    };
    let mut energies = energies(&samples);
    energies.resize(samples.len(), [f64::NAN; 2]);
    // Backward: with several drivers each position is solved from its neighbour.
    for (index, pair) in energies.iter_mut().enumerate().rev() {
        if !pair.iter().any(|energy| energy.is_nan()) {
            continue;
        }
        let (q, speed) = samples.state(index);
        if system.equation.ensure_tables_at(q[0]) && system.equation.set_configuration(q).is_ok() {
            let reduced = &system.equation.reduced;
            *pair = [reduced.kinetic(speed), reduced.potential];
        }
    }
    if let (Some(tail), Some(&energy)) = (&tail, energies.last()) {
        samples.push(&tail.end());
        energies.push(energy);
    }
    Run { samples, energies, events, stop_reason, statistics, along, sign, path, tail }
}
