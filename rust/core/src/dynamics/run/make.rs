//! Makes a run.

use super::equation::{Broken, Equation};
use super::outcome::{Ending, Happened, Run, moment};
use super::outside::Outside;
use super::reader::TOGETHER;
use super::source::{Moving, Sheet, Source};
use super::tail::Tail;
use super::task::{Along, Task};
use super::way::{Ended, Way};
use crate::dynamics::machine::Machine;
use crate::dynamics::table::Table;
use crate::mechanism::Mechanism;
use crate::motion::Status;
use crate::ode::{End, Error, Integrator, Keep, Options, Solution};
use crate::plan::jet::Jets;

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
        let jets = Jets::new(mechanism.q0().len(), 2);
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
        run(Equation::new(self, outside, &self.tables, &self.motors, 1), task, &[1.0])
    }
}

/// `sizes`: what a coordinate's tolerance is a part of.
fn run<S: Source, O: Outside>(
    mut equation: Equation<'_, S, O>,
    task: &Task<'_>,
    sizes: &[f64],
) -> Result<Run, RunError<O::Error>> {
    equation.flywheel = task.flywheel;
    equation.begin(task.q[0], task.speed).map_err(Error::System)?;
    let mut way = Way::new(equation, task);
    way.begin(task);
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
        Along::Coordinate => breaks_of(way.equation.tables, task.breaks, [from, to]),
    };
    let [relative, absolute] = tolerances(&mut way, task, sizes).map_err(Error::System)?;
    let crossings = way.crossings();
    let options = Options {
        relative: &relative,
        absolute: &absolute,
        first_step: None,
        max_step: task.max_step,
        max_steps: task.max_steps,
        breaks: &breaks,
        events: &crossings,
        keep: Keep::Path,
    };
    let mut integrator = Integrator::new(task.method, way.len());
    let start = Way::<S, O>::start(task);
    let solution = integrator.run(&mut way, from, &start, to, &options)?;
    finish(way, task, from, solution, clipped)
}

/// Where a run along the coordinate must end, as a table does, and which.
fn clip(tables: &[Table], from: f64, end: f64) -> (f64, Option<usize>) {
    let mut clipped = (end, None);
    for (which, table) in tables.iter().enumerate() {
        let [first, last] = table.range();
        let limit = if end > from { last } else { first };
        if table.period().is_none() && (clipped.0 - limit) * (end - from).signum() > 0.0 {
            clipped = (limit, Some(which));
        }
    }
    clipped
}

/// Knots of tables between two coordinates, with breaks that are given; knots of several tables at
/// one place are one.
pub(super) fn breaks_of(tables: &[Table], given: &[f64], [from, to]: [f64; 2]) -> Vec<f64> {
    let range = [from.min(to), from.max(to)];
    let mut breaks = given.to_vec();
    breaks.extend(tables.iter().flat_map(|table| table.knots_within(range)));
    breaks.sort_unstable_by(f64::total_cmp);
    breaks.dedup_by(|a, b| (*a - *b).abs() <= TOGETHER * b.abs().max(1.0));
    breaks
}

/// A run of one driver along its coordinate.
pub(super) fn finish_run<S: Source, O: Outside>(
    equation: Equation<'_, S, O>,
    task: &Task<'_>,
) -> Result<Run, RunError<O::Error>> {
    run(equation, task, &[1.0])
}

/// Relative and absolute tolerances of the state.
fn tolerances<S: Source, O: Outside>(
    way: &mut Way<'_, S, O>,
    task: &Task<'_>,
    sizes: &[f64],
) -> Result<[Vec<f64>; 2], Broken<O::Error>> {
    let (n, relative) = (task.q.len(), task.relative);
    if task.along == Along::Coordinate {
        let speed = task.speed[0].abs();
        let of_speed = task.absolute.map_or(relative * speed * 1e-3, |[_, of_speed]| of_speed);
        let absolute = vec![2.0 * of_speed * speed, relative / speed, f64::INFINITY];
        return Ok([vec![relative, relative, 0.0], absolute]);
    }
    let mut absolute = Vec::with_capacity(2 * n + 1);
    match task.absolute {
        Some([of_q, of_speed]) => {
            absolute.extend(std::iter::repeat_n(of_q, n));
            absolute.extend(std::iter::repeat_n(of_speed, n));
        }
        None => {
            absolute.extend(sizes.iter().map(|size| relative * size));
            absolute.extend(typical_speeds(way, task, sizes)?.iter().map(|v| relative * v));
        }
    }
    absolute.push(f64::INFINITY);
    // An angle counts turns: its size says nothing.
    let relative = [vec![0.0; n], vec![relative; n], vec![0.0]].concat();
    Ok([relative, absolute])
}

/// A thousandth of the speeds that a motion may be expected to have: those at its beginning, or
/// what its accelerations there make of them over a radian (the size, of a slide).
fn typical_speeds<S: Source, O: Outside>(
    way: &mut Way<'_, S, O>,
    task: &Task<'_>,
    sizes: &[f64],
) -> Result<Vec<f64>, Broken<O::Error>> {
    use crate::ode::Fault;
    let n = task.q.len();
    let mut accelerations = vec![0.0; n];
    let equation = &mut way.equation;
    let there = equation
        .place(task.q)
        .and_then(|()| equation.load(task.t, task.q, task.speed))
        .and_then(|()| equation.accelerations(task.q, task.speed, &mut accelerations));
    match there {
        Err(Fault::Error(error)) => return Err(error),
        // The run will end where it begins.
        Err(Fault::NotThere) => accelerations.fill(0.0),
        Ok(()) => {}
    }
    let typical = |driver: usize| {
        let own = task.speed[driver].abs();
        own.max((accelerations[driver].abs() * sizes[driver]).sqrt())
    };
    let most = (0..n).map(typical).fold(0.0, f64::max);
    // What rests in balance is measured by a size a second.
    let of =
        |driver: usize| if most > 0.0 { typical(driver).max(1e-3 * most) } else { sizes[driver] };
    Ok((0..n).map(|driver| 1e-3 * of(driver)).collect())
}

/// Nothing is beyond: why, and where that was found.
fn edge(refused: &mut Option<(Status, Vec<f64>)>) -> Ending {
    let (status, q) = refused.take().unwrap_or((Status::Singular, Vec::new()));
    Ending::Edge(status, q)
}

fn finish<S: Source, O: Outside>(
    mut way: Way<'_, S, O>,
    task: &Task<'_>,
    from: f64,
    solution: Solution,
    clipped: Option<usize>,
) -> Result<Run, RunError<O::Error>> {
    let Solution { end, events, event_states, path, statistics, y: y_end, .. } = solution;
    let (along, sign, len) = (way.along, way.sign, way.len());
    let read = |x: f64, y: &[f64]| moment(along, sign, x, y, &vec![f64::NAN; len]);
    let happened = |(event, y): (&crate::ode::Event, &[f64])| {
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
        (_, Some(Ended::Dead)) => edge(&mut way.equation.refused),
        (End::Event { index, .. }, _) => way.watch(index).map_or(Ending::Stalled, Ending::Event),
        (End::Edge { t }, _) if along == Along::Coordinate && way.has_kinetic(&[t], last_work) => {
            edge(&mut way.equation.refused)
        }
        (End::Edge { .. }, _) if along == Along::Coordinate => Ending::Rest,
        (End::Edge { .. }, _) => edge(&mut way.equation.refused),
        (End::StepLimit { stiff, .. }, _) => Ending::StepLimit(stiff),
        (End::Stalled { .. }, _) => Ending::Stalled,
    };
    let mut moments = Vec::with_capacity(path.ends().len() + 1);
    let (mut y, mut rates) = (vec![0.0; len], vec![0.0; len]);
    for &x in [from].iter().chain(path.ends()) {
        if path.at(x, &mut y) && path.slope(x, &mut rates) {
            moments.push(moment(along, sign, x, &y, &rates));
        }
    }
    if moments.is_empty() {
        moments.push(read(from, &Way::<S, O>::start(task)));
    }
    let tail = match (&ending, moments.last()) {
        (Ending::Edge(..), Some(last)) if last.q.len() == 1 => {
            let fold = way.equation.source.fold(last.q[0], last.speed[0]);
            fold.and_then(|fold| Tail::of(last, fold))
        }
        _ => None,
    };
    // Backward: with several drivers each place is reached from the one before.
    let mut energies = vec![[f64::NAN; 2]; moments.len()];
    for (pair, moment) in energies.iter_mut().zip(&moments).rev() {
        if way.equation.reader.place(way.equation.tables, moment.q[0]).is_ok()
            && way.equation.place(&moment.q).is_ok()
        {
            let reduced = &way.equation.reduced;
            *pair = [reduced.kinetic(&moment.speed), reduced.potential];
        }
    }
    if let (Some(tail), Some(&energy)) = (&tail, energies.last()) {
        moments.push(tail.end());
        energies.push(energy);
    }
    Ok(Run { moments, energies, events, ending, statistics, along, sign, path, tail })
}
