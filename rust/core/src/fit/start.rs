//! Where a fit starts: random designs that move, placed where they are most alike the target.

use std::f64::consts::TAU;
use std::ops::Range;
use std::sync::atomic::AtomicBool;

use super::assign::{assign, coordinate, missed};
use super::course::Course;
use super::multipliers::Multipliers;
use super::place::{Placed, Placer};
use super::point::Point;
use super::problem::{Problem, TRAVEL_POSITIONS, Travel, is_solved};
use super::target::{FitTarget, Freedom, Timing, within_half_turn};
use super::turned::turn_bodies;
use crate::batch::request::Motion;
use crate::description::dimension::Dimension;
use crate::description::error::SolveError;
use crate::math::random::Random;

/// Random lengths of a mechanism that can be placed anywhere in any size, and how far its points lie apart.
const LENGTHS: [f64; 2] = [0.1, 1.5];
const SPREAD: f64 = 0.7;
const LINK_SPREAD: f64 = 1.5;
/// How far a number without bounds is from the drawing's: lengths by a factor, coordinates in sizes of the drawing.
const FACTOR: f64 = 3.0;

/// A point goes elsewhere if that is so many positions away.
const FAR: f64 = 2.0;

/// A start, and its assembly.
pub(super) type Start = (usize, Point);

/// Makes the starts of a problem.
pub(super) struct Starts<'p> {
    problem: Problem<'p>,
    placer: Option<Placer>,
    kinds: Vec<Dimension>,
}

impl<'p> Starts<'p> {
    pub(super) fn new(problem: Problem<'p>) -> Self {
        let kinds = problem.mechanism.dimensions().iter().map(|(_, kind)| kind).collect();
        Self { problem, placer: Placer::new(&problem), kinds }
    }

    /// The random designs of these indices, in one assembly, that move; evaluated.
    pub(super) fn make(
        &self,
        indices: Range<u64>,
        assembly: usize,
        cancel: &AtomicBool,
    ) -> Result<Vec<Start>, SolveError> {
        let problem = self.problem;
        let designs: Vec<Vec<f64>> = indices.map(|index| self.random(index)).collect();
        let mut dimensions = vec![0.0; designs.len() * self.kinds.len()];
        for (design, x) in designs.iter().enumerate() {
            problem.variables.write(x, &mut dimensions, (design, designs.len()));
        }
        let motion = problem.curves(&dimensions, assembly, cancel)?;
        let mut starts = vec![];
        for (design, x) in designs.into_iter().enumerate() {
            let rows = design * TRAVEL_POSITIONS..(design + 1) * TRAVEL_POSITIONS;
            let moves = motion.status[rows.clone()].iter().copied().all(is_solved);
            if problem.travel == Travel::WholeTurn && !moves {
                continue;
            }
            match &self.placer {
                Some(placer) => {
                    let course = Course::new(&motion, &rows, &problem.targets[0]);
                    let Some(course) = course else { continue };
                    let placed = placer.place(&course, problem.simd).into_iter();
                    starts.extend(placed.filter_map(|placed| self.placed(placed, &x, assembly)));
                }
                None => starts.push((assembly, self.unplaced(&motion, &rows, x))),
            }
        }
        self.evaluate(starts, cancel)
    }

    fn evaluate(
        &self,
        mut starts: Vec<Start>,
        cancel: &AtomicBool,
    ) -> Result<Vec<Start>, SolveError> {
        for assembly in 0..self.problem.assemblies.len() {
            let of = starts.iter_mut().filter(|start| start.0 == assembly);
            let mut points: Vec<&mut Point> = of.map(|start| &mut start.1).collect();
            if points.is_empty() {
                continue;
            }
            turn_bodies(&self.problem, &mut points, assembly, cancel)?;
            self.problem.evaluate(&mut points, (assembly, TRAVEL_POSITIONS), cancel)?;
        }
        starts.retain(|start| start.1.value.is_finite());
        Ok(starts)
    }

    /// Random values of the variables.
    fn random(&self, index: u64) -> Vec<f64> {
        let random = &mut Random::new(self.problem.seed, index);
        let drawing = self.problem.variables.values(self.problem.mechanism.drawing());
        let size = self.problem.mechanism.linkage().size();
        let each = self.problem.variables.each.iter().enumerate();
        each.map(|(place, one)| {
            let Some(&(dimension, _)) = one.moves.first() else { return 0.0 };
            let kind = self.kinds[dimension];
            let [low, high] = one.bounds;
            let is_angle = !kind.is_length();
            let is_bar = matches!(kind, Dimension::Length { .. });
            if self.placer.is_some() {
                return match kind {
                    Dimension::Length { .. } => random.log_between(LENGTHS[0], LENGTHS[1]),
                    Dimension::GroundX { .. } | Dimension::GroundY { .. } => {
                        random.between(-SPREAD, SPREAD)
                    }
                    _ if is_angle => random.between(-std::f64::consts::PI, std::f64::consts::PI),
                    _ => random.between(-LINK_SPREAD, LINK_SPREAD),
                };
            }
            if low.is_finite() && high.is_finite() {
                return if is_bar && low > 0.0 && index.is_multiple_of(2) {
                    random.log_between(low, high)
                } else {
                    random.between(low, high)
                };
            }
            let drawn = drawing.as_ref().map_or(0.0, |x| x[place]);
            let value = if is_bar {
                drawn * random.log_between(1.0 / FACTOR, FACTOR)
            } else if is_angle {
                random.between(-std::f64::consts::PI, std::f64::consts::PI)
            } else {
                drawn + size * random.between(-1.0, 1.0)
            };
            value.clamp(low, high)
        })
        .collect()
    }

    /// A point with all numbers that belong to targets.
    fn point(&self, mut x: Vec<f64>, q: Vec<f64>) -> Point {
        for (value, [low, high]) in x.iter_mut().zip(&self.problem.bounds) {
            *value = value.clamp(*low, *high);
        }
        x.extend(self.problem.targets.iter().flat_map(FitTarget::neutral));
        let multipliers = Multipliers::new(self.problem.conditions.len(), self.problem.size);
        Point { x, q, value: f64::INFINITY, multipliers, ..Point::default() }
    }

    /// A design moved to where its curve is most alike the target.
    fn placed(&self, placed: Placed, x: &[f64], assembly: usize) -> Option<Start> {
        let problem = self.problem;
        let Placed { inner, outer, q } = placed;
        let dimensions = inner.dimensions(&problem, &problem.variables.dimensions(x))?;
        let x = problem.variables.values(&dimensions)?;
        let signs = &problem.assemblies[assembly];
        let assembly = if inner.is_mirrored {
            let is_mirror = |other: &Vec<i8>| other.iter().zip(signs).all(|(a, b)| *a == -b);
            problem.assemblies.iter().position(is_mirror)?
        } else {
            assembly
        };
        let mut point = self.point(x, q);
        let mut extra = problem.variables.len();
        if let Timing::Phase(given) = &problem.targets[0].timing {
            point.x[extra] = point.q[0] - given[0];
            extra += 1;
        }
        point.x[extra..][..outer.len()].copy_from_slice(&outer);
        Some((assembly, point))
    }

    /// A design where it is: each point of a target goes to the nearest position.
    fn unplaced(&self, motion: &Motion, rows: &Range<usize>, x: Vec<f64>) -> Point {
        let mut q = vec![0.0; self.problem.positions()];
        for (target, positions, _) in self.problem.parts() {
            let Timing::Free { is_ordered, .. } = target.timing else { continue };
            let places = assign(target, is_ordered, motion, rows);
            for (q, place) in q[positions].iter_mut().zip(places) {
                *q = coordinate(place, rows.len());
            }
        }
        self.point(x, q)
    }
}

/// Sends points that have no order to nearer positions, where there are any.
pub(super) fn send_to_nearest(
    problem: &Problem,
    points: &mut [&mut Point],
    assembly: usize,
    cancel: &AtomicBool,
) -> Result<(), SolveError> {
    let is_free = |timing: &Timing| matches!(timing, Timing::Free { is_ordered: false, .. });
    let has_own_frame = |target: &FitTarget| target.freedom != Freedom::None;
    if !problem.targets.iter().any(|target| is_free(&target.timing) && !has_own_frame(target)) {
        return Ok(());
    }
    let designs = points.len();
    let mut dimensions = vec![0.0; designs * problem.mechanism.dimensions().len()];
    for (design, point) in points.iter().enumerate() {
        problem.variables.write(&point.x, &mut dimensions, (design, designs));
    }
    let motion = problem.curves(&dimensions, assembly, cancel)?;
    for (design, point) in points.iter_mut().enumerate() {
        let rows = design * TRAVEL_POSITIONS..(design + 1) * TRAVEL_POSITIONS;
        for (target, positions, _) in problem.parts() {
            if !is_free(&target.timing) || has_own_frame(target) {
                continue;
            }
            let places = assign(target, false, &motion, &rows);
            for ((k, q), place) in point.q[positions].iter_mut().enumerate().zip(places) {
                // A place that is a step away is the one where the point is already.
                let new = coordinate(place, TRAVEL_POSITIONS);
                if within_half_turn(new - *q).abs() > FAR * coordinate(1.0, TRAVEL_POSITIONS)
                    && missed_at(target, k, &motion, &rows, *q)
                        > missed_at(target, k, &motion, &rows, new)
                {
                    *q = new;
                }
            }
        }
    }
    Ok(())
}

/// What the position of a turn that is nearest to a coordinate misses.
fn missed_at(target: &FitTarget, k: usize, motion: &Motion, rows: &Range<usize>, q: f64) -> f64 {
    let place = (q / TAU).rem_euclid(1.0) * rows.len() as f64;
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "below the rows")]
    let place = place.round() as usize % rows.len();
    missed(target, k, motion, rows.start + place)
}
