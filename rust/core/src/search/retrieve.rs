//! Starts of a search: the curves of random linkages that are most alike a target, but for a similarity.

use std::f64::consts::TAU;

use super::limits::Limits;
use super::objective::{Candidate, WHOLE_TURN};
use super::target::Target;
use crate::batch::dispatch::{Entry, Task};
use crate::math::lanes::{LANES, Real};
use crate::math::random::Random;
use crate::math::vector::Vector;
use crate::population::course::{Angles, Course, sweep};
use crate::population::packed::{PackedLinkage, Placement};
use crate::population::random::RandomLinkages;

/// Positions of a turn, and samples of a curve at equal lengths.
const POSITIONS: usize = 12 * LANES;
const SAMPLES: usize = 15 * LANES;
/// Joints of a linkage whose curves are compared: the last ones that move.
const TRACED: usize = 3;
/// Samples of an open target, and the samples of a curve from one of these to the next: a quarter of the
/// curve to the whole of it.
const OPEN_POINTS: usize = 16;
const OPEN_STEPS: [usize; 5] = [2, 3, 4, 6, 8];
/// The same of a closed target.
const CLOSED_POINTS: usize = SAMPLES / 2;
const CLOSED_STEPS: [usize; 1] = [2];

/// Ways to go along a curve: as it is, mirrored, and both backwards.
const WAYS: usize = 4;

/// The curve of a joint, twice over.
#[derive(Debug, Clone, Default)]
struct Curve {
    x: Vec<f64>,
    y: Vec<f64>,
    /// The crank's angle, growing.
    angles: Vec<f64>,
}

/// What a target is compared by.
pub(super) struct Retrieval<'t> {
    target: &'t Target,
    limits: Limits,
    points: Vec<Vector>,
    mean: Vector,
    steps: &'static [usize],
}

/// Where a curve is most alike the target.
#[derive(Debug, Clone, Copy)]
struct Match {
    /// Part of the target's square radius that the similarity leaves.
    left: f64,
    start: usize,
    step: usize,
    way: usize,
    by: Vector,
    mean: Vector,
}

/// Memory of a retrieval.
#[derive(Debug, Default)]
pub(super) struct RetrievalMemory {
    course: Course,
    curve: Curve,
    sums: Vec<f64>,
}

impl<'t> Retrieval<'t> {
    pub(super) fn new(target: &'t Target, limits: Limits) -> Self {
        let (count, steps): (_, &[usize]) = if target.is_closed {
            (CLOSED_POINTS, &CLOSED_STEPS)
        } else {
            (OPEN_POINTS, &OPEN_STEPS)
        };
        let mut points = target.samples(count);
        let sum = points.iter().fold(Vector::ZERO, |sum, &point| sum + point);
        let mean = sum.scale(1.0 / count as f64);
        for point in &mut points {
            *point = *point - mean;
        }
        Self { target, limits, points, mean, steps }
    }

    /// The most alike curve of each of the last joints of random linkage `index`, as candidates whose value is
    /// what a similarity leaves.
    pub(super) fn candidates<L: Entry>(
        &self,
        wanted: &RandomLinkages,
        (seed, index): (u64, u64),
        memory: &mut RetrievalMemory,
    ) -> Vec<Candidate> {
        let random = &mut Random::new(seed, index);
        let linkage = wanted.make::<L>(random, &mut memory.course);
        let mut angles = Angles::default();
        angles.set::<L>(TAU, true, (POSITIONS, 0));
        sweep::<L>(&linkage, &angles, (0, 1.0), &mut memory.course);
        let moving = |joint: &usize| !matches!(linkage.placements[*joint], Placement::Pivot);
        (2..linkage.len())
            .rev()
            .filter(moving)
            .take(TRACED)
            .filter_map(|joint| {
                if !memory.curve.read(&memory.course, joint) {
                    return None;
                }
                let found = self.compare::<L>(&memory.curve, &mut memory.sums)?;
                self.candidate(&linkage, joint, &memory.curve, found)
            })
            .collect()
    }

    /// The place of a curve that is most alike the target.
    fn compare<L: Entry>(&self, curve: &Curve, sums: &mut Vec<f64>) -> Option<Match> {
        let mut best: Option<Match> = None;
        let count = self.points.len() as f64;
        let own: f64 = self.points.iter().map(|point| point.norm2()).sum();
        for &step in self.steps {
            sums.clear();
            sums.resize((3 + 2 * WAYS) * SAMPLES, 0.0);
            L::call(&mut Products { points: &self.points, curve, step, sums });
            let sum = |which: usize, start: usize| sums[which * SAMPLES + start];
            for start in 0..SAMPLES {
                let mean = Vector::new(sum(0, start), sum(1, start)).scale(1.0 / count);
                let radius2 = sum(2, start) - count * mean.norm2();
                let arc = curve.angles[start + self.reach(step)] - curve.angles[start];
                let is_short = !self.target.is_closed && arc < self.limits.arc[0];
                if is_short || radius2 < 1e-6 * sum(2, start) {
                    continue;
                }
                for way in 0..WAYS {
                    let product = Vector::new(sum(3 + 2 * way, start), sum(4 + 2 * way, start));
                    let left = 1.0 - product.norm2() / (own * radius2);
                    if best.is_none_or(|best| left < best.left) {
                        let by = product.scale(1.0 / radius2);
                        best = Some(Match { left, start, step, way, by, mean });
                    }
                }
            }
        }
        best
    }

    /// Samples from the first to the last.
    fn reach(&self, step: usize) -> usize {
        step * (self.points.len() - 1)
    }

    /// A linkage moved to where its curve is most alike the target.
    fn candidate(
        &self,
        linkage: &PackedLinkage,
        joint: usize,
        curve: &Curve,
        found: Match,
    ) -> Option<Candidate> {
        let (is_mirrored, is_backwards) = (found.way % 2 == 1, found.way >= 2);
        let mut linkage = linkage.clone();
        if !linkage.trace(joint) {
            return None;
        }
        let last = found.start + self.reach(found.step);
        let [from, to] = [curve.angles[found.start], curve.angles[last]];
        let first = if is_backwards { to } else { from };
        let crank = Vector::new(linkage.numbers[1][0], linkage.numbers[1][1]);
        let turned = Vector::at_angle(first) * crank;
        linkage.numbers[1] = [turned.x, turned.y];
        linkage.sense = if is_backwards { -1.0 } else { 1.0 };
        let mean = if is_mirrored { found.mean.conj() } else { found.mean };
        linkage.transform(found.by, self.mean - found.by * mean, is_mirrored);
        let arc = if self.target.is_closed {
            WHOLE_TURN
        } else {
            (to - from).clamp(self.limits.arc[0], self.limits.arc[1])
        };
        Some(Candidate { linkage, arc, value: found.left })
    }
}

impl Curve {
    /// Samples a joint's curve at equal lengths; `false` if it is a point.
    fn read(&mut self, course: &Course, joint: usize) -> bool {
        let count = course.positions();
        let point = |t: usize| course.point(joint, t % count);
        let mut lengths = vec![0.0];
        for t in 0..count {
            lengths.push(lengths[t] + (point(t + 1) - point(t)).norm());
        }
        let total = lengths[count];
        if !(total > 0.0 && total.is_finite()) {
            return false;
        }
        for numbers in [&mut self.x, &mut self.y, &mut self.angles] {
            numbers.clear();
        }
        let mut segment = 0;
        for sample in 0..SAMPLES {
            let length = total * sample as f64 / SAMPLES as f64;
            while segment + 1 < count && lengths[segment + 1] < length {
                segment += 1;
            }
            let own = lengths[segment + 1] - lengths[segment];
            let part = if own > 0.0 { (length - lengths[segment]) / own } else { 0.0 };
            let place = point(segment) + (point(segment + 1) - point(segment)).scale(part);
            self.x.push(place.x);
            self.y.push(place.y);
            self.angles.push(TAU * (segment as f64 + part) / count as f64);
        }
        for sample in 0..SAMPLES {
            self.x.push(self.x[sample]);
            self.y.push(self.y[sample]);
            self.angles.push(self.angles[sample] + TAU);
        }
        true
    }
}

/// Sums over the points of a target, for every start on a curve: of w (x and y), |w|², and of z w̄, z w, and the same of
/// the points backwards.
struct Products<'p> {
    points: &'p [Vector],
    curve: &'p Curve,
    step: usize,
    sums: &'p mut [f64],
}

impl<R: Real> Task<R> for Products<'_> {
    #[inline(always)]
    fn run(&mut self) {
        let last = self.points.len() - 1;
        for start in (0..SAMPLES).step_by(R::LANES) {
            let mut sums = [R::ZERO; 3 + 2 * WAYS];
            for (k, &point) in self.points.iter().enumerate() {
                let sample = start + k * self.step;
                let x = R::read(&self.curve.x[sample..]);
                let y = R::read(&self.curve.y[sample..]);
                sums[0] += x;
                sums[1] += y;
                sums[2] += x * x + y * y;
                for (way, z) in [point, self.points[last - k]].into_iter().enumerate() {
                    let (u, v) = (R::splat(z.x), R::splat(z.y));
                    let [ux, vy, vx, uy] = [u * x, v * y, v * x, u * y];
                    let own = &mut sums[3 + 4 * way..];
                    own[0] += ux + vy;
                    own[1] += vx - uy;
                    own[2] += ux - vy;
                    own[3] += vx + uy;
                }
            }
            for (which, sum) in sums.into_iter().enumerate() {
                sum.put(&mut self.sums[which * SAMPLES + start..]);
            }
        }
    }
}
