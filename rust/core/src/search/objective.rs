//! How far the curve of a packed linkage is from a target, with its derivatives.
//!
//! F = Chamfer distance + γ · mean square of ordered distances + κ · difference of moments + barriers. Lengths are those of the target's
//! frame, where its root mean square radius is 1.
//!
//! - Chamfer distance: mean distance from samples of the target to the curve, plus mean distance from the
//!   curve (each position with its share of the length) to the target. A distance r counts as
//!   √(r² + ε²) − ε, which is smooth.
//! - Difference of moments: the distance of both centroids, and the difference of the root mean square radii, both
//!   smooth in the same way.
//! - Ordered distance: from samples of the target at equal parts of its length to the places of the curve at the same
//!   parts of its own.

use std::f64::consts::TAU;

use super::limits::Limits;
use super::moments::Moments;
use super::nearest::{Feet, Points, Polyline, nearest};
use super::normal::{ByPositions, Normal, assemble};
use super::target::Target;
use crate::batch::dispatch::Entry;
use crate::math::vector::Vector;
use crate::population::adjoint::{Jacobian, jacobian};
use crate::population::course::{Angles, Course, sweep};
use crate::population::packed::PackedLinkage;

/// Weight of the ordered distance. Without it, strokes that the curve covers more often than the target go unseen.
const ORDERED: f64 = 0.5;
/// Weight of the distance of the curve's centroid from the target's and of the difference of their radii: without it, a
/// curve that lies on the target's lines may be off it once both are normalised.
const MOMENTS: f64 = 0.5;
/// A linkage to be scored: of an open target with the arc on which it draws it.
#[derive(Debug, Clone)]
pub(crate) struct Candidate {
    pub linkage: PackedLinkage,
    /// The crank's turn over the target, rad: a whole turn for a closed one.
    pub arc: f64,
    /// The objective.
    pub value: f64,
}

/// How finely it is scored.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Fineness {
    /// Positions on the arc and on the rest of the turn.
    pub positions: (usize, usize),
    /// Samples of the target.
    pub samples: usize,
    /// ε; `None`: the ordered distance alone.
    pub epsilon: Option<f64>,
}

/// A target with what is asked of a linkage, at some fineness.
#[derive(Debug, Clone)]
pub(crate) struct Objective<'t> {
    target: &'t Target,
    limits: Limits,
    fineness: Fineness,
    samples: Points,
}

/// Memory of an evaluation, and what the last one found.
#[derive(Debug, Clone, Default)]
pub(crate) struct Workspace {
    angles: Angles,
    /// For which arc and positions the angles are set.
    set_for: Option<(f64, (usize, usize))>,
    course: Course,
    curve: Points,
    line: Polyline,
    /// Lengths of the curve before each of its positions.
    lengths: Vec<f64>,
    to_curve: Feet,
    to_target: Feet,
    weights: Vec<f64>,
    jacobian: Jacobian,
    by_positions: ByPositions,
    /// Derivatives of the objective by the lengths of the curve's segments.
    by_lengths: Vec<f64>,
    /// Evaluations of objectives so far.
    pub evaluations: u64,
}

impl Workspace {
    /// The positions that were found last.
    pub(crate) fn course(&self) -> &Course {
        &self.course
    }
}

impl<'t> Objective<'t> {
    pub(crate) fn new(target: &'t Target, limits: Limits, fineness: Fineness) -> Self {
        let mut samples = Points::default();
        let points = target.samples(fineness.samples);
        samples.set(points.iter().map(|point| point.x), points.iter().map(|point| point.y));
        Self { target, limits, fineness, samples }
    }

    /// The target's limits on a linkage.
    pub(crate) fn limits(&self) -> &Limits {
        &self.limits
    }

    /// Whether the arc is a number to be found.
    pub(crate) fn has_arc(&self) -> bool {
        !self.target.is_closed
    }

    /// The objective of a linkage, infinite if it breaks a limit.
    pub(crate) fn value<L: Entry>(
        &self,
        linkage: &PackedLinkage,
        arc: f64,
        work: &mut Workspace,
    ) -> f64 {
        work.evaluations += 1;
        let positions = self.fineness.positions;
        if work.set_for != Some((arc, positions)) {
            work.angles.set::<L>(arc, self.target.is_closed, positions);
            work.set_for = Some((arc, positions));
        }
        let most = self.limits.apex_cosine;
        if !sweep::<L>(linkage, &work.angles, (0, most), &mut work.course) {
            return f64::INFINITY;
        }
        let mut value = self.limits.barriers(linkage, &work.course);
        if value.is_infinite() {
            return value;
        }
        self.measure_curve(linkage.len() - 1, work);
        if let Some(epsilon) = self.fineness.epsilon {
            value += self.chamfer::<L>(epsilon, work) + moments_off(epsilon, work);
        }
        value += self.ordered(work);
        if value.is_finite() { value } else { f64::INFINITY }
    }

    /// Reads the traced joint's curve and measures its lengths.
    fn measure_curve(&self, traced: usize, work: &mut Workspace) {
        let count = work.angles.arc;
        let [x, y] = [0, 1].map(|axis| &work.course.coordinate(traced, axis)[..count]);
        work.curve.set(x.iter().copied(), y.iter().copied());
        let segments = if self.target.is_closed { count } else { count - 1 };
        let point = |t: usize| work.curve.get(if t == count { 0 } else { t });
        work.line.set((0..segments).map(|t| [point(t), point(t + 1)]));
        work.lengths.clear();
        work.lengths.push(0.0);
        let mut length = 0.0;
        for segment in &work.line.segments {
            length += segment.vector.norm();
            work.lengths.push(length);
        }
    }

    /// The Chamfer distance, with the feet that it is measured to.
    fn chamfer<L: Entry>(&self, epsilon: f64, work: &mut Workspace) -> f64 {
        nearest::<L>(&self.samples, &work.line, &mut work.to_curve);
        nearest::<L>(&work.curve, &self.target.polyline, &mut work.to_target);
        let smooth = |square: f64| (square + epsilon * epsilon).sqrt() - epsilon;
        let samples = self.samples.count;
        let to_curve: f64 = (0..samples).map(|k| smooth(work.to_curve.square(k))).sum();
        to_curve / samples as f64 + curve_distance(epsilon, work)
    }

    /// Calls a function for each sample of the target: its index, the segment of the curve on which its place lies, the
    /// part of it before, and the vector from the sample to the place.
    fn for_each_place(&self, work: &Workspace, mut see: impl FnMut(usize, usize, f64, Vector)) {
        let total = work.lengths[work.lengths.len() - 1];
        let last = work.line.segments.len() - 1;
        let mut segment = 0;
        for k in 0..self.samples.count {
            let length = total * self.length_part(k);
            while segment < last && work.lengths[segment + 1] < length {
                segment += 1;
            }
            let [from, to] = [work.lengths[segment], work.lengths[segment + 1]];
            let part = if to > from { (length - from) / (to - from) } else { 0.0 };
            let line = &work.line.segments[segment];
            let place = line.start + line.vector.scale(part);
            see(k, segment, part, place - self.samples.get(k));
        }
    }

    /// The part of the length before a sample.
    fn length_part(&self, k: usize) -> f64 {
        let count = self.samples.count;
        k as f64 / if self.target.is_closed { count } else { count - 1 } as f64
    }

    fn ordered(&self, work: &Workspace) -> f64 {
        let mut sum = 0.0;
        self.for_each_place(work, |_, _, _, off| sum += off.norm2());
        self.ordered_weight() * sum
    }

    /// The weight of a sample's ordered distance squared.
    fn ordered_weight(&self) -> f64 {
        let whole = if self.fineness.epsilon.is_some() { ORDERED } else { 1.0 };
        whole / self.samples.count as f64
    }

    /// Sets up the normal equations for the linkage that was evaluated last.
    pub(crate) fn linearize<L: Entry>(
        &self,
        linkage: &PackedLinkage,
        work: &mut Workspace,
        normal: &mut Normal,
    ) {
        let Workspace { angles, course, weights, jacobian: derivatives, .. } = work;
        jacobian::<L>(linkage, angles, course, weights, derivatives);
        self.differentiate(work);
        assemble::<L>(&mut work.by_positions, &work.jacobian, normal);
        self.limits.add_barriers(linkage, (&work.angles, &work.course), normal);
    }

    /// The objective as a function of the curve's positions.
    fn differentiate(&self, work: &mut Workspace) {
        let mut function = std::mem::take(&mut work.by_positions);
        let mut by_lengths = std::mem::take(&mut work.by_lengths);
        function.clear(work.curve.count);
        by_lengths.clear();
        by_lengths.resize(work.line.segments.len(), 0.0);
        if let Some(epsilon) = self.fineness.epsilon {
            self.differentiate_distances(epsilon, work, (&mut function, &mut by_lengths));
            differentiate_moments(epsilon, work, &mut function);
        }
        self.differentiate_places(work, (&mut function, &mut by_lengths));
        for (t, segment) in work.line.segments.iter().enumerate() {
            let length = segment.vector.norm();
            if length > 0.0 {
                function.slopes.add_length(t, segment.vector.scale(1.0 / length), by_lengths[t]);
            }
        }
        work.by_positions = function;
        work.by_lengths = by_lengths;
    }

    /// Both halves of the Chamfer distance: a distance r of weight w has the slope w r / √(r² + ε²).
    fn differentiate_distances(
        &self,
        epsilon: f64,
        work: &Workspace,
        (function, by_lengths): (&mut ByPositions, &mut [f64]),
    ) {
        let softened = |square: f64| (square + epsilon * epsilon).sqrt();
        let mut add = |place: (usize, f64), weight: f64, off: Vector, along: Vector| {
            let [x, y] = [weight * along.x, weight * along.y];
            let second = [x * along.x, x * along.y, y * along.y];
            function.add(place, along.scale(weight * off.dot(along)), second);
        };
        let count = work.curve.count;
        let share = 1.0 / self.samples.count as f64;
        for k in 0..self.samples.count {
            let (from, part) = (work.to_curve.segment(k), work.to_curve.part(k));
            let segment = &work.line.segments[from];
            let off = segment.start + segment.vector.scale(part) - self.samples.get(k);
            let weight = share / softened(work.to_curve.square(k));
            add((from, part), weight, off, direction(off, part, segment.vector));
        }
        let total = work.lengths[work.lengths.len() - 1];
        let whole = curve_distance(epsilon, work);
        let segments = work.line.segments.len();
        let own = |segment: usize| work.lengths[segment + 1] - work.lengths[segment];
        for t in 0..count {
            let before = if t > 0 {
                own(t - 1)
            } else if self.target.is_closed {
                own(segments - 1)
            } else {
                0.0
            };
            let after = if t < segments { own(t) } else { 0.0 };
            let share = 0.5 * (before + after) / total;
            let segment = &self.target.polyline.segments[work.to_target.segment(t)];
            let part = work.to_target.part(t);
            let off = work.curve.get(t) - segment.start - segment.vector.scale(part);
            let weight = share / softened(work.to_target.square(t));
            add((t, 0.0), weight, off, direction(off, part, segment.vector));
        }
        let distance =
            |t: usize| softened(work.to_target.square(if t == count { 0 } else { t })) - epsilon;
        for (t, slope) in by_lengths.iter_mut().enumerate() {
            *slope += (0.5 * (distance(t) + distance(t + 1)) - whole) / total;
        }
    }

    /// The ordered distance. A place moves along the curve as lengths before it change: with α = (s L − ℓ) / l, l the
    /// length of its segment and ℓ that before it, l dα = s dL − dℓ − α dl. That counts in the slopes alone.
    fn differentiate_places(
        &self,
        work: &Workspace,
        (function, by_lengths): (&mut ByPositions, &mut [f64]),
    ) {
        let weight = 2.0 * self.ordered_weight();
        // The sum of the slopes by all lengths, and of those by lengths from a segment on that are behind.
        let (mut everywhere, mut passed, mut reached) = (0.0, 0.0, 0);
        self.for_each_place(work, |k, from, part, off| {
            function.add((from, part), off.scale(weight), [weight, 0.0, weight]);
            while reached < from {
                reached += 1;
                by_lengths[reached] += passed;
            }
            let length = work.lengths[from + 1] - work.lengths[from];
            if length > 0.0 {
                let slope = weight * off.dot(work.line.segments[from].vector) / length;
                everywhere += slope * (self.length_part(k) - 1.0);
                by_lengths[from] += slope * (1.0 - part);
                passed += slope;
            }
        });
        for slope in &mut by_lengths[reached + 1..] {
            *slope += passed;
        }
        for slope in by_lengths {
            *slope += everywhere;
        }
    }
}

/// The mean distance from the curve to the target.
fn curve_distance(epsilon: f64, work: &Workspace) -> f64 {
    let count = work.curve.count;
    let smooth = |square: f64| (square + epsilon * epsilon).sqrt() - epsilon;
    let distance = |t: usize| smooth(work.to_target.square(if t == count { 0 } else { t }));
    let mut sum = 0.0;
    let mut before = distance(0);
    for (t, ends) in work.lengths.windows(2).enumerate() {
        let next = distance(t + 1);
        sum += 0.5 * (before + next) * (ends[1] - ends[0]);
        before = next;
    }
    sum / work.lengths[work.lengths.len() - 1]
}

/// By how much the moments of the curve are off those of the target, which are 0 and 1.
fn moments_off(epsilon: f64, work: &Workspace) -> f64 {
    let moments = Moments::of(&work.line, &work.lengths);
    let smooth = |square: f64| (square + epsilon * epsilon).sqrt() - epsilon;
    let excess = moments.radius - 1.0;
    MOMENTS * (smooth(moments.centroid.norm2()) + smooth(excess * excess))
}

fn differentiate_moments(epsilon: f64, work: &Workspace, function: &mut ByPositions) {
    let moments = Moments::of(&work.line, &work.lengths);
    let [x, y, radius] = &mut function.whole;
    let excess = moments.radius - 1.0;
    let weight = |square: f64| MOMENTS / (square + epsilon * epsilon).sqrt();
    let square = moments.centroid.norm2();
    (x.weight, x.residual) = (weight(square), moments.centroid.x);
    (y.weight, y.residual) = (weight(square), moments.centroid.y);
    (radius.weight, radius.residual) = (weight(excess * excess), excess);
    let slopes = [&mut x.slopes, &mut y.slopes, &mut radius.slopes];
    moments.differentiate(&work.line, &work.lengths, slopes);
}

/// The direction in which a distance changes: across the segment where its foot lies within, else along
/// the distance itself.
fn direction(off: Vector, part: f64, segment: Vector) -> Vector {
    if part > 0.0 && part < 1.0 {
        return segment.left().scale(1.0 / segment.norm());
    }
    let distance = off.norm();
    if distance > 0.0 { off.scale(1.0 / distance) } else { Vector::ZERO }
}

/// The arc of a closed target.
pub(crate) const WHOLE_TURN: f64 = TAU;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;
    use crate::population::random::RandomLinkages;
    use crate::state::kernel::baseline::Baseline;

    const LIMITS: Limits = Limits {
        apex_cosine: 0.995,
        apex_barrier: 0.9,
        frame: 20.0,
        frame_barrier: 0.8,
        arc: [1.62, 6.2],
    };

    /// Gradients are those of differences: of open and closed targets, with all barriers up.
    #[test]
    fn gradients_are_slopes() {
        let corners = [[0.0, 0.0], [2.0, 0.5], [1.0, 2.0], [0.2, 1.0]];
        let wanted = RandomLinkages { joints: [6, 12], most_cosine: 0.97 };
        let (mut work, mut normal) = (Workspace::default(), Normal::default());
        let mut course = Course::default();
        let mut checked = 0;
        for index in 0..60 {
            let target = Target::new(&corners, index % 2 == 0).expect("a path");
            let epsilon = [Some(0.05), None][index / 2 % 2];
            let fineness = Fineness { positions: (64, 32), samples: 64, epsilon };
            let objective = Objective::new(&target, LIMITS, fineness);
            let random = &mut Random::new(5, index as u64);
            let mut linkage = wanted.make::<Baseline>(random, &mut course);
            if !linkage.prune() {
                continue;
            }
            linkage.transform(Vector::new(3.0, 1.0), Vector::new(-1.5, -2.0), index % 3 == 0);
            let arc = if objective.has_arc() { 3.0 } else { WHOLE_TURN };
            let value = objective.value::<Baseline>(&linkage, arc, &mut work);
            if value.is_infinite() {
                continue;
            }
            objective.linearize::<Baseline>(&linkage, &mut work, &mut normal);
            let gradient: Vec<f64> = (0..normal.count).map(|number| normal.slope(number)).collect();
            let size = gradient.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            let step = 1e-6;
            let mut errors = vec![];
            for number in 0..2 * linkage.len() + usize::from(objective.has_arc()) {
                let mut values = [-2.0, -1.0, 1.0, 2.0].map(|times: f64| {
                    let mut moved = linkage.clone();
                    let mut moved_arc = arc;
                    if number < 2 * linkage.len() {
                        moved.numbers[number / 2][number % 2] += times * step;
                    } else {
                        moved_arc += times * step;
                    }
                    objective.value::<Baseline>(&moved, moved_arc, &mut work)
                });
                values[0] = (values[0] - values[3]) / 12.0 + (values[2] - values[1]) * 2.0 / 3.0;
                errors.push((values[0] / step - gradient[number]).abs() / size);
            }
            // A sample may lie where the nearest segment changes: there the slope jumps.
            errors.sort_by(f64::total_cmp);
            assert!(errors[errors.len() - 1] < 1e-6, "{index}: {errors:?}");
            checked += 1;
        }
        assert!(checked > 20, "{checked}");
    }
}
