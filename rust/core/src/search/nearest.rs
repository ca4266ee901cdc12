//! The nearest points of a polyline to given points.

use crate::batch::dispatch::{Entry, Task};
use crate::math::lanes::{LANES, Mask, Real};
use crate::math::vector::Vector;

/// Segments of a polyline that are passed over together where they are too far away.
const GROUP: usize = 8;
/// What a distance must exceed a bound by, so that rounding passes over nothing that is nearer.
const CERTAINLY: f64 = 1.0 + 1e-9;

/// Segments from corner to corner.
#[derive(Debug, Clone, Default)]
pub(crate) struct Polyline {
    pub segments: Vec<Segment>,
    /// A circle around each group of segments: its centre and radius.
    circles: Vec<(Vector, f64)>,
}

/// A segment: its start, its vector, and the inverse of its length squared (0 without a length).
#[derive(Debug, Clone, Copy)]
pub(crate) struct Segment {
    pub start: Vector,
    pub vector: Vector,
    inverse: f64,
}

impl Polyline {
    /// The polyline through corners.
    pub(crate) fn through(corners: &[Vector]) -> Self {
        let mut line = Self::default();
        line.set(corners.windows(2).map(|ends| [ends[0], ends[1]]));
        line
    }

    /// Makes it of segments with these ends.
    pub(crate) fn set(&mut self, segments: impl Iterator<Item = [Vector; 2]>) {
        self.segments.clear();
        self.segments.extend(segments.map(|[start, end]| {
            let vector = end - start;
            let square = vector.norm2();
            let inverse = if square > 0.0 { 1.0 / square } else { 0.0 };
            Segment { start, vector, inverse }
        }));
        self.circles.clear();
        self.circles.extend(self.segments.chunks(GROUP).map(|group| {
            let centre = group[group.len() / 2].start;
            let radius = |segment: &Segment| {
                let off = segment.start - centre;
                off.norm2().max((off + segment.vector).norm2())
            };
            (centre, group.iter().map(radius).fold(0.0, f64::max).sqrt())
        }));
    }
}

/// Points, x and y apart, in full registers.
#[derive(Debug, Clone, Default)]
pub(crate) struct Points {
    pub x: Vec<f64>,
    pub y: Vec<f64>,
    pub count: usize,
}

impl Points {
    /// Makes it of these points; registers are filled up with zeros.
    pub(crate) fn set(&mut self, x: impl Iterator<Item = f64>, y: impl Iterator<Item = f64>) {
        self.x.clear();
        self.x.extend(x);
        self.y.clear();
        self.y.extend(y);
        self.count = self.x.len();
        let width = self.count.next_multiple_of(LANES);
        self.x.resize(width, 0.0);
        self.y.resize(width, 0.0);
    }

    /// One of them.
    pub(crate) fn get(&self, index: usize) -> Vector {
        Vector::new(self.x[index], self.y[index])
    }
}

/// For each point the nearest one of a polyline: segment and part of it.
#[derive(Debug, Clone, Default)]
pub(crate) struct Feet {
    squares: Vec<f64>,
    segments: Vec<f64>,
    parts: Vec<f64>,
}

impl Feet {
    /// The segment on which the foot of a point lies.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "it is the index of a segment"
    )]
    pub(crate) fn segment(&self, index: usize) -> usize {
        self.segments[index] as usize
    }

    /// The part of the segment before the foot.
    pub(crate) fn part(&self, index: usize) -> f64 {
        self.parts[index]
    }

    /// The square of the distance from point to foot.
    pub(crate) fn square(&self, index: usize) -> f64 {
        self.squares[index]
    }
}

/// Finds the feet of all points. Of segments that are as near the first one counts.
pub(crate) fn nearest<L: Entry>(points: &Points, line: &Polyline, feet: &mut Feet) {
    for numbers in [&mut feet.squares, &mut feet.segments, &mut feet.parts] {
        numbers.resize(points.x.len(), 0.0);
    }
    L::call(&mut Nearest { points, line, feet });
}

struct Nearest<'n> {
    points: &'n Points,
    line: &'n Polyline,
    feet: &'n mut Feet,
}

/// The feet of some points: squares of distances, segments, parts.
type Best<R> = [R; 3];

impl<R: Real> Task<R> for Nearest<'_> {
    #[inline(always)]
    fn run(&mut self) {
        // Points one after another are neighbours: so the group that was nearest bounds the distances.
        let mut likely = 0;
        for first in (0..self.points.x.len()).step_by(R::LANES) {
            let (x, y) = (R::read(&self.points.x[first..]), R::read(&self.points.y[first..]));
            let point = Vector::new(x, y);
            let mut bound = [R::splat(f64::INFINITY), R::ZERO, R::ZERO];
            self.visit(likely, point, &mut bound);
            let mut best = [R::splat(f64::INFINITY), R::ZERO, R::ZERO];
            let mut reach = bound[0].sqrt();
            for (group, &(centre, radius)) in self.line.circles.iter().enumerate() {
                let from = point - Vector::splat(centre);
                let far = (reach + R::splat(radius)) * R::splat(CERTAINLY);
                if (far * far).lt(from.norm2()).all() {
                    continue;
                }
                self.visit(group, point, &mut best);
                reach = best[0].min(bound[0]).sqrt();
            }
            best[0].put(&mut self.feet.squares[first..]);
            best[1].put(&mut self.feet.segments[first..]);
            best[2].put(&mut self.feet.parts[first..]);
            likely = self.feet.segment(first) / GROUP;
        }
    }
}

impl Nearest<'_> {
    /// Tries the segments of a group.
    #[inline(always)]
    fn visit<R: Real>(&self, group: usize, point: Vector<R>, best: &mut Best<R>) {
        let segments = self.line.segments.chunks(GROUP).nth(group).unwrap_or_default();
        let mut number = R::splat((group * GROUP) as f64);
        for segment in segments {
            let vector = Vector::<R>::splat(segment.vector);
            let from = point - Vector::splat(segment.start);
            let part = from.dot(vector) * R::splat(segment.inverse);
            let part = part.max(R::ZERO).min(R::ONE);
            let square = (from - vector.scale(part)).norm2();
            let nearer = square.lt(best[0]);
            for (best, new) in best.iter_mut().zip([square, number, part]) {
                *best = R::select(nearer, new, *best);
            }
            number += R::ONE;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;
    use crate::state::kernel::baseline::Baseline;

    #[test]
    fn no_place_of_the_line_is_nearer() {
        let random = &mut Random::new(3, 0);
        let corners: Vec<Vector> =
            (0..30).map(|_| Vector::new(random.normal(), random.normal())).collect();
        let line = Polyline::through(&corners);
        let mut points = Points::default();
        let numbers: Vec<f64> = (0..26).map(|_| random.normal()).collect();
        points.set(numbers[..13].iter().copied(), numbers[13..].iter().copied());
        let mut feet = Feet::default();
        nearest::<Baseline>(&points, &line, &mut feet);
        for index in 0..13 {
            let segment = line.segments[feet.segment(index)];
            let foot = segment.start + segment.vector.scale(feet.part(index));
            let square = (foot - points.get(index)).norm2();
            assert!((square - feet.square(index)).abs() < 1e-14);
            for segment in &line.segments {
                for step in 0..=200 {
                    let place = segment.start + segment.vector.scale(f64::from(step) / 200.0);
                    assert!((place - points.get(index)).norm2() > square - 1e-14);
                }
            }
        }
    }
}
