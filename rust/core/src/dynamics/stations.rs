//! Where loads that follow other coordinates are not smooth over the only driver: where a coordinate
//! passes a knot of a table over it, and where it turns back.

use super::kinematics::SolvedPose;
use super::machine::Machine;
use super::measure::{Measure, Over};
use super::tables::table::Table;
use crate::math::derivatives::DerivativeTables;
use crate::math::root::all_roots::{Sample, all_roots};
use crate::math::root::itp::itp;
use crate::math::tolerance::ANALOGUE_PER_CONDITION_SQUARED;
use crate::plan::mechanism::Mechanism;
use crate::query::evaluator::{Evaluator, Queries};
use crate::state::status::Status;

/// Distance of the positions (rad, or of the size) between which the coordinates are followed: the search
/// adds positions where the coordinates are not cubics.
pub(crate) const STEP: f64 = std::f64::consts::TAU / 64.0;
/// Least and greatest number of such steps in a range.
const MIN_STEPS: f64 = 4.0;
const MAX_STEPS: f64 = 1.0e6;
/// A coordinate nearer than this to a knot (rad, or of the size) is at the knot.
const AT_KNOT: f64 = 1.0e-13;
/// A station nearer than this to an end of a range (rad, or of the size; relative beyond 1) is in the range.
const AT_END: f64 = 1.0e-13;
/// Where a coordinate turns back at a knot, it is at the knot to rounding up to this distance (rad, or of
/// the size).
const BESIDE_TURN: f64 = 1.0e-5;
/// Width to which a station is located, in u of its coordinate or unit.
const WIDTH_ULPS: f64 = 4.0;

/// Positions between which coordinates are followed over a range; `unit` is that of the driver.
pub(crate) fn nodes_of([from, to]: [f64; 2], unit: f64) -> Vec<f64> {
    // A root at an end lies between positions.
    let [low, high] = [from.min(to) - STEP * unit, from.max(to) + STEP * unit];
    let steps = ((high - low) / (STEP * unit)).ceil().clamp(MIN_STEPS, MAX_STEPS);
    let parts = std::iter::successors(Some(0.0), |&part| (part < steps).then_some(part + 1.0));
    parts.map(|part| low + (high - low) * (part / steps)).collect()
}

/// Whether a station is in a range, or at an end of it to rounding.
pub(crate) fn within(q: f64, [from, to]: [f64; 2], unit: f64) -> bool {
    let [low, high] = [from.min(to), from.max(to)];
    let slack = AT_END * low.abs().max(high.abs()).max(unit);
    (low - slack..=high + slack).contains(&q)
}

/// A coordinate that loads follow, and the tables over it.
struct Coordinate<'m> {
    measure: Measure,
    tables: Vec<&'m Table>,
}

impl Machine {
    /// The stations of a design with one driver between two coordinates, ends included, ascending; empty
    /// with several drivers.
    #[must_use]
    pub fn stations(&self, mechanism: &Mechanism, dimensions: &[f64], range: [f64; 2]) -> Vec<f64> {
        if mechanism.q0().len() != 1 {
            return Vec::new();
        }
        let derivatives = DerivativeTables::new(1, 2);
        let queries = Queries::Any;
        let mut evaluator =
            Evaluator::new(mechanism, dimensions, &derivatives, queries, self.needs_angles());
        self.stations_of(&mut evaluator, &derivatives, range)
    }

    /// The first table over another coordinate that does not cover a position of a design: its ends, and
    /// the value there.
    #[must_use]
    pub fn uncovered(
        &self,
        mechanism: &Mechanism,
        dimensions: &[f64],
        q: &[f64],
    ) -> Option<([f64; 2], f64)> {
        let derivatives = DerivativeTables::new(mechanism.q0().len(), 1);
        let queries = Queries::Listed(q);
        let mut evaluator =
            Evaluator::new(mechanism, dimensions, &derivatives, queries, self.needs_angles());
        evaluator.solve(q).ok()?;
        let pose = SolvedPose::new(evaluator.position(), &derivatives);
        self.over.iter().find_map(|over| {
            let (table, at) = (over.table()?, over.measure.at(&pose, q));
            table.at(at).is_nan().then(|| (table.range(), at))
        })
    }

    pub(crate) fn stations_of(
        &self,
        evaluator: &mut Evaluator<'_>,
        derivatives: &DerivativeTables,
        range: [f64; 2],
    ) -> Vec<f64> {
        let mut stations: Vec<f64> = self
            .coordinates()
            .iter()
            .flat_map(|coordinate| coordinate.stations(evaluator, derivatives, range))
            .collect();
        stations.sort_unstable_by(f64::total_cmp);
        stations.dedup();
        stations
    }

    fn coordinates(&self) -> Vec<Coordinate<'_>> {
        let mut all: Vec<Coordinate<'_>> = Vec::new();
        let curves = self.over.iter().filter_map(|over: &Over| Some((over.measure, over.table()?)));
        for (measure, table) in curves {
            match all.iter_mut().find(|coordinate| coordinate.measure == measure) {
                Some(coordinate) => coordinate.tables.push(table),
                None => all.push(Coordinate { measure, tables: vec![table] }),
            }
        }
        for &measure in &self.ways {
            if all.iter().all(|coordinate| coordinate.measure != measure) {
                all.push(Coordinate { measure, tables: Vec::new() });
            }
        }
        // The direction of a driver is the sense of the motion.
        all.retain(|coordinate| {
            !(coordinate.tables.is_empty() && matches!(coordinate.measure, Measure::Driver(_)))
        });
        all
    }
}

impl Coordinate<'_> {
    fn stations(
        &self,
        evaluator: &mut Evaluator<'_>,
        derivatives: &DerivativeTables,
        [from, to]: [f64; 2],
    ) -> Vec<f64> {
        let unit = evaluator.unit(0);
        let nodes = nodes_of([from, to], unit);
        let size = if matches!(self.measure, Measure::Slide(_)) {
            evaluator.position().constants.scale
        } else {
            1.0
        };
        let mut passed: Vec<[f64; 2]> = Vec::new();
        let mut at = |q: f64| {
            evaluator.solve(&[q]).ok()?;
            if evaluator.status() as u8 > Status::Singular as u8 {
                return None;
            }
            let condition = evaluator.total_condition();
            let pose = SolvedPose::new(evaluator.position(), derivatives);
            let (rate, second) = (self.measure.rate(&pose, 0), self.measure.second_rate(&pose));
            let noise = ANALOGUE_PER_CONDITION_SQUARED * condition * condition * size / unit;
            passed.push([q, self.measure.at(&pose, &[q])]);
            Some(Sample { x: q, value: rate, slope: second, noise })
        };
        let turns = all_roots(&nodes, &mut at);
        passed.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]));
        let mut stations: Vec<f64> = turns.isolated.iter().map(|root| root.at).collect();
        stations.extend(turns.jumps);
        stations.extend(turns.zero.into_iter().flatten());
        // Where it turns back: the coordinate, and its value.
        let turned: Vec<[f64; 2]> = turns
            .isolated
            .iter()
            .filter_map(|root| passed.iter().find(|pair| pair[0] == root.at).copied())
            .collect();
        // From one of these positions to the next the coordinate is monotone.
        for pair in passed.windows(2) {
            let ([a, from], [b, to]) = (pair[0], pair[1]);
            let near = AT_KNOT * size.max(from.abs());
            let within = [from.min(to) - near, from.max(to) + near];
            for knot in self.tables.iter().flat_map(|table| table.knots_within(within)) {
                let beside = BESIDE_TURN * unit;
                let touches = turned.iter().any(|&[at, value]| {
                    (value - knot).abs() <= near && at >= a - beside && at <= b + beside
                });
                if touches {
                    // The place where it turns back is a station already.
                } else if (from - knot).abs() <= near {
                    stations.push(a);
                } else if (to - knot).abs() <= near {
                    stations.push(b);
                } else {
                    let sign = (from - knot).signum();
                    let width = WIDTH_ULPS * f64::EPSILON * a.abs().max(b.abs()).max(unit);
                    let distance = |q: f64| {
                        evaluator.solve(&[q]).map_err(|_| ())?;
                        let pose = SolvedPose::new(evaluator.position(), derivatives);
                        Ok::<_, ()>(sign * (self.measure.at(&pose, &[q]) - knot))
                    };
                    let ends = ((a, sign * (from - knot)), (b, sign * (to - knot)));
                    // Between them the mechanism may not be possible.
                    stations.extend(itp(ends.0, ends.1, width, |far| far <= 0.0, distance));
                }
            }
        }
        stations.retain(|&q| within(q, [from, to], unit));
        stations
    }
}
