//! Positions of rest of a machine with one driver, their stability and natural frequency.
//!
//! At rest the reduced moment M of the loads is zero. M is −dV/dq, so rest is stable where it falls
//! from + to −, and small oscillations obey J q̈ = M′ q: ω = √(−M′/J) (J. P. Den Hartog, Mechanical
//! Vibrations, 4th ed. 1956, 2.3, by energy).

use std::cell::Cell;
use std::sync::atomic::{AtomicBool, Ordering};

use super::followers::Followers;
use super::kinematics::SolvedPose;
use super::machine::Machine;
use super::motor::Motor;
use super::reduced::Reduced;
use super::run::tabulated::TabulatedMachine;
use super::stiffness::Reach;
use super::value::Numbers;
use crate::math::derivatives::DerivativeTables;
use crate::math::root::all_roots::{Root, Roots, Sample, all_roots};
use crate::math::tolerance::ANALOGUE_PER_CONDITION_SQUARED;
use crate::plan::mechanism::Mechanism;
use crate::query::evaluator::{Evaluator, Queries};
use crate::query::failure::Failure;
use crate::state::status::Status;

/// Relative error of the analogues at which a position counts as a gap: beside a dead point, or where
/// one group brings the next to a dead point, so that moments go through infinity.
const NO_DIGITS: f64 = 1.0e-2;
/// Within this part of a turn, rest at its two ends is the same: that of a moment that only touches
/// zero is located no closer.
const SAME_IN_A_TURN: f64 = 1.0e-7;
/// Rest nearer than this to an end of a range, in u of its greater end, is within the range.
const WITHIN_ULPS: f64 = 8.0;
/// Distance from a station, relative to it (or to 1), beyond its rounding.
const BESIDE: f64 = 1.0e-12;

/// Both sides of a station, beyond its rounding.
fn beside(station: f64) -> [f64; 2] {
    let step = BESIDE * station.abs().max(1.0);
    [station - step, station + step]
}

/// Where to look for rest: evenly spaced positions, to which the rows of tables are added.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EquilibriumRange {
    /// Its ends, rad or m.
    pub ends: [f64; 2],
    /// Whether it is a full turn, whose ends are the same position.
    pub is_turn: bool,
    /// Number of intervals.
    pub intervals: u32,
}

/// A position of rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Equilibrium {
    /// The coordinate, rad or m.
    pub q: f64,
    /// Whether the machine returns to it.
    pub is_stable: bool,
    /// V″, N·m/rad or N/m.
    pub stiffness: f64,
    /// rad/s; NaN where it is not stable or the machine has no inertia.
    pub frequency: f64,
}

/// The positions of rest in a range.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Equilibria {
    /// Isolated ones, ascending.
    pub isolated: Vec<Equilibrium>,
    /// Intervals in which the moment is zero to rounding.
    pub indifferent: Vec<[f64; 2]>,
    /// Where the moment changes its sign in a jump.
    pub jumps: Vec<f64>,
    /// Whether the moment varies too quickly to be searched completely.
    pub is_incomplete: bool,
    /// Why the first position of the range cannot be reached, if none can.
    pub failure: Option<Failure>,
    /// Whether no position of the range has a moment.
    pub is_empty: bool,
}

impl Machine {
    /// Finds the positions of rest of a design with one driver (with several it finds none). Dampers do not
    /// act at rest, and motors are off; loads with callbacks have no moment. Ends early once `cancel` is true.
    #[must_use]
    pub fn equilibria(
        &self,
        mechanism: &Mechanism,
        dimensions: &[f64],
        range: EquilibriumRange,
        cancel: &AtomicBool,
    ) -> Equilibria {
        if mechanism.q0().len() != 1 {
            return Equilibria { is_empty: true, ..Equilibria::default() };
        }
        let derivatives = DerivativeTables::new(1, 2);
        let torsion = self.needs_angles();
        let mut evaluator =
            Evaluator::new(mechanism, dimensions, &derivatives, Queries::Any, torsion);
        let mut machine = self.clone();
        machine.loads.retain(|load| !load.reads_velocities());
        let mut reduced = Reduced::new(1);
        let mut tables = Vec::new();
        let mut followers = Followers::default();
        let mut knots = self.stations_of(&mut evaluator, &derivatives, range.widened());
        let is_reached = Cell::new(false);
        let mut sample = |q: f64| {
            if cancel.load(Ordering::Relaxed) {
                return None;
            }
            evaluator.solve(&[q]).ok()?;
            // At the very end of a group's branch the state may be that of another position.
            if evaluator.status() as u8 > Status::Singular as u8 {
                return None;
            }
            is_reached.set(true);
            let condition = evaluator.total_condition();
            let (scale, unit) = (evaluator.position().constants.scale, evaluator.unit(0));
            let pose = SolvedPose::new(evaluator.position(), &derivatives);
            tables.clear();
            tables.extend(
                machine.tables.iter().map(|t| t.value_and_slope(q).unwrap_or([f64::NAN; 2])),
            );
            machine.add_configuration(&pose, &mut reduced);
            followers.read(machine.followed(), &pose, &[q], &[0.0]);
            let numbers = Numbers { tables: &tables, ..followers.numbers() };
            machine.add_speed_loads(&pose, &[0.0], numbers, &mut reduced);
            let reach = Reach { length: scale / unit, angle: 1.0 / unit };
            let tangent = machine.moment_slope(&pose, numbers, reach);
            let error = ANALOGUE_PER_CONDITION_SQUARED * condition * condition;
            if error > NO_DIGITS {
                return None;
            }
            let noise = error * tangent.size;
            let sample = Sample { x: q, value: reduced.moment(0), slope: tangent.slope, noise };
            Some((sample, reduced.inertia[0]))
        };
        knots = knots.into_iter().flat_map(beside).collect();
        for table in &self.tables {
            let rows_within = table.knots_within(range.widened());
            // The value at a jump is the one behind it.
            if !table.jumps().is_empty() {
                knots.extend(rows_within.iter().map(|knot| knot.next_down()));
            }
            knots.extend(rows_within);
        }
        let nodes = range.nodes(knots.into_iter());
        let roots = all_roots(&nodes, |q| sample(q).map(|pair| pair.0));
        let mut equilibria = Equilibria::of_roots(&roots, range, sample);
        if !is_reached.get() {
            let q = [range.ends[0]];
            equilibria.failure =
                evaluator.solve(&q).err().map(|rejection| evaluator.failure(rejection, &q));
        }
        equilibria
    }
}

impl TabulatedMachine {
    /// Finds the positions of rest of a machine of tables.
    #[must_use]
    pub fn equilibria(&self, range: EquilibriumRange) -> Equilibria {
        let rotors: f64 = self.motors.iter().map(Motor::inertia).sum();
        let size = self.tables[1].size();
        let sample = |x: f64| {
            let [inertia, _] = self.tables[0].value_and_slope(x)?;
            let [value, slope] = self.tables[1].value_and_slope(x)?;
            let noise = ANALOGUE_PER_CONDITION_SQUARED * size;
            Some((Sample { x, value, slope, noise }, inertia + rotors))
        };
        let knots = self.tables[..2].iter().map(|table| table.knots_within(range.widened()));
        let roots = all_roots(&range.nodes(knots.flatten()), |q| sample(q).map(|pair| pair.0));
        Equilibria::of_roots(&roots, range, sample)
    }
}

impl EquilibriumRange {
    fn step(&self) -> f64 {
        (self.ends[1] - self.ends[0]) / f64::from(self.intervals)
    }

    /// Widened by one interval on either side: rest at an end lies between positions.
    fn widened(&self) -> [f64; 2] {
        [self.ends[0] - self.step(), self.ends[1] + self.step()]
    }

    fn nodes(&self, knots: impl Iterator<Item = f64>) -> Vec<f64> {
        let count = f64::from(self.intervals);
        let place = |i: u32| {
            let part = (f64::from(i) - 1.0) / count;
            self.ends[0] * (1.0 - part) + self.ends[1] * part
        };
        let mut nodes: Vec<f64> = (0..self.intervals + 3).map(place).chain(knots).collect();
        nodes.sort_by(f64::total_cmp);
        nodes.dedup();
        nodes
    }

    /// Distance beyond its ends within which rest still counts.
    fn slack(&self) -> f64 {
        let [low, high] = self.ends;
        if self.is_turn {
            SAME_IN_A_TURN * (high - low)
        } else {
            WITHIN_ULPS * f64::EPSILON * low.abs().max(high.abs())
        }
    }
}

impl Equilibria {
    fn of_roots(
        roots: &Roots,
        range: EquilibriumRange,
        mut sample: impl FnMut(f64) -> Option<(Sample, f64)>,
    ) -> Self {
        let ([low, high], slack) = (range.ends, range.slack());
        let is_within = |q: f64| q >= low - slack && q <= high + slack;
        let mut isolated: Vec<Equilibrium> = roots
            .isolated
            .iter()
            .filter(|root| is_within(root.at))
            .filter_map(|root| sample(root.at).map(|at| Equilibrium::new(root, at)))
            .collect();
        let turn = high - low - 2.0 * slack;
        if let [first, .., last] = &isolated[..]
            && range.is_turn
            && last.q - first.q > turn
        {
            isolated.pop();
        }
        let clip = |[a, b]: &[f64; 2]| [a.max(low), b.min(high)];
        Self {
            isolated,
            indifferent: roots.zero.iter().map(clip).filter(|[a, b]| a < b).collect(),
            jumps: roots.jumps.iter().copied().filter(|&q| is_within(q)).collect(),
            is_incomplete: roots.incomplete,
            failure: None,
            is_empty: !roots.has_values,
        }
    }
}

impl Equilibrium {
    fn new(root: &Root, (sample, inertia): (Sample, f64)) -> Self {
        let is_stable = root.signs == [1.0, -1.0];
        // Where the moment is flat, rounding may give its slope the other sign.
        let stiffness = if is_stable { (-sample.slope).max(0.0) } else { -sample.slope };
        let frequency = (stiffness / inertia).sqrt();
        let has_frequency = is_stable && inertia > 0.0;
        let frequency = if has_frequency { frequency } else { f64::NAN };
        Self { q: root.at, is_stable, stiffness, frequency }
    }
}
