//! Polylines in the plane, or in more dimensions: their lengths, and their nearest places to points.

use super::lanes::Real;

/// A place of a polyline: on a segment, after a part of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Place {
    pub segment: usize,
    pub part: f64,
}

/// Segments from corner to corner.
#[derive(Debug, Clone)]
pub(crate) struct Polyline<const D: usize> {
    segments: Vec<Segment<D>>,
    /// The length before the end of each segment.
    lengths: Vec<f64>,
    corners: usize,
}

/// A segment: its start, its vector, and the inverse of its length squared (0 without a length).
#[derive(Debug, Clone, Copy)]
struct Segment<const D: usize> {
    start: [f64; D],
    vector: [f64; D],
    inverse: f64,
}

impl<const D: usize> Segment<D> {
    fn between([start, end]: [[f64; D]; 2]) -> Self {
        let mut vector = end;
        for (end, start) in vector.iter_mut().zip(start) {
            *end -= start;
        }
        let square = square(vector);
        let inverse = if square > 0.0 { 1.0 / square } else { 0.0 };
        Self { start, vector, inverse }
    }
}

impl<const D: usize> Polyline<D> {
    /// Through all corners in order, and back to the first if it is closed. A single corner is a segment
    /// without a length.
    pub(crate) fn through(corners: &[[f64; D]], is_closed: bool) -> Self {
        let mut segments: Vec<Segment<D>> =
            corners.windows(2).map(|ends| Segment::between([ends[0], ends[1]])).collect();
        if let (&[first, ..], true) = (corners, is_closed || corners.len() == 1) {
            segments.push(Segment::between([corners[corners.len() - 1], first]));
        }
        let mut total = 0.0;
        let add = |segment: &Segment<D>| {
            total += square(segment.vector).sqrt();
            total
        };
        let lengths = segments.iter().map(add).collect();
        Self { segments, lengths, corners: corners.len() }
    }

    /// Number of segments.
    pub(crate) fn len(&self) -> usize {
        self.segments.len()
    }

    /// The corners at both ends of a segment.
    pub(crate) fn ends(&self, segment: usize) -> [usize; 2] {
        [segment, if segment + 1 == self.corners { 0 } else { segment + 1 }]
    }

    /// The unit vector along a segment; zero without a length.
    pub(crate) fn direction(&self, segment: usize) -> [f64; D] {
        let vector = self.segments[segment].vector;
        let length = square(vector).sqrt();
        if length > 0.0 { vector.map(|number| number / length) } else { [0.0; D] }
    }

    /// The length of all segments.
    pub(crate) fn total(&self) -> f64 {
        self.lengths.last().copied().unwrap_or(0.0)
    }

    /// The length of a segment.
    pub(crate) fn length(&self, segment: usize) -> f64 {
        self.lengths[segment] - self.before(segment)
    }

    /// The length before a segment.
    fn before(&self, segment: usize) -> f64 {
        if segment > 0 { self.lengths[segment - 1] } else { 0.0 }
    }

    /// The length before a segment ends.
    pub(crate) fn before_end(&self, segment: usize) -> f64 {
        self.lengths[segment]
    }

    /// The point at a place.
    pub(crate) fn point(&self, place: Place) -> [f64; D] {
        let Segment { start, vector, .. } = self.segments[place.segment];
        std::array::from_fn(|k| start[k] + place.part * vector[k])
    }

    /// For a point in each lane the square of its distance from the nearest place, the segment of that place
    /// and the part of it before: the first of equally near ones.
    #[inline(always)]
    pub(crate) fn nearest<R: Real>(&self, point: [R; D]) -> [R; 3] {
        let mut best = [R::splat(f64::INFINITY), R::ZERO, R::ZERO];
        let mut number = R::ZERO;
        for segment in &self.segments {
            let mut along = R::ZERO;
            for k in 0..D {
                along += (point[k] - R::splat(segment.start[k])) * R::splat(segment.vector[k]);
            }
            let part = (along * R::splat(segment.inverse)).max(R::ZERO).min(R::ONE);
            let mut square = R::ZERO;
            for k in 0..D {
                let from = point[k] - R::splat(segment.start[k]);
                let off = from - part * R::splat(segment.vector[k]);
                square += off * off;
            }
            let nearer = square.lt(best[0]);
            for (best, new) in best.iter_mut().zip([square, number, part]) {
                *best = R::select(nearer, new, *best);
            }
            number += R::ONE;
        }
        best
    }
}

fn square<const D: usize>(vector: [f64; D]) -> f64 {
    vector.iter().map(|number| number * number).sum()
}

/// Walks along a polyline to places at given lengths, in rising order.
#[derive(Debug, Clone)]
pub(crate) struct Walk<'l, const D: usize> {
    line: &'l Polyline<D>,
    segment: usize,
}

impl<'l, const D: usize> Walk<'l, D> {
    /// From the start of a line.
    pub(crate) fn new(line: &'l Polyline<D>) -> Self {
        Self { line, segment: 0 }
    }

    /// The place at a length, not less than that before.
    pub(crate) fn to(&mut self, length: f64) -> Place {
        let line = self.line;
        while self.segment + 1 < line.len() && line.before_end(self.segment) < length {
            self.segment += 1;
        }
        let (before, own) = (line.before(self.segment), line.length(self.segment));
        let part = if own > 0.0 { ((length - before) / own).clamp(0.0, 1.0) } else { 0.0 };
        Place { segment: self.segment, part }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;

    #[test]
    fn no_place_of_the_line_is_nearer() {
        let random = &mut Random::new(3, 0);
        let mut point = || -> [f64; 3] { std::array::from_fn(|_| random.normal()) };
        let corners: Vec<[f64; 3]> = (0..7).map(|_| point()).collect();
        for is_closed in [false, true] {
            let line = Polyline::through(&corners, is_closed);
            assert_eq!(line.len(), if is_closed { 7 } else { 6 });
            for _ in 0..13 {
                let point = point();
                let [least, segment, part] = line.nearest(point);
                let off = |place: Place| {
                    let on = line.point(place);
                    (0..3).map(|k| (on[k] - point[k]).powi(2)).sum::<f64>()
                };
                #[allow(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "it is the index of a segment"
                )]
                let segment = segment as usize;
                assert!((off(Place { segment, part }) - least).abs() < 1e-14);
                for segment in 0..line.len() {
                    for step in 0..=200 {
                        let place = Place { segment, part: f64::from(step) / 200.0 };
                        assert!(off(place) > least - 1e-14);
                    }
                }
            }
        }
    }

    #[test]
    fn a_walk_round_a_square() {
        let corners = [[0.0, 0.0], [2.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];
        let line = Polyline::through(&corners, true);
        assert_eq!(line.lengths, [2.0, 2.0, 4.0, 6.0, 8.0]);
        assert_eq!(line.ends(4), [4, 0]);
        assert_eq!([1, 2, 3].map(|k| line.direction(k)), [[0.0, 0.0], [0.0, 1.0], [-1.0, 0.0]]);
        let mut walk = Walk::new(&line);
        let points = [0.0, 1.0, 2.5, 7.0, 8.0].map(|length| line.point(walk.to(length)));
        assert_eq!(points, [[0.0, 0.0], [1.0, 0.0], [2.0, 0.5], [0.0, 1.0], [0.0, 0.0]]);
    }

    #[test]
    fn one_corner_is_a_place() {
        let line = Polyline::through(&[[1.0, 1.0]], false);
        assert_eq!(line.ends(0), [0, 0]);
        assert_eq!(line.nearest([4.0, 5.0]), [25.0, 0.0, 0.0]);
        assert_eq!(line.point(Walk::new(&line).to(0.0)), [1.0, 1.0]);
    }
}
