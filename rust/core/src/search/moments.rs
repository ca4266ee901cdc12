//! The centroid and the root mean square radius of a curve, with their derivatives.

use super::nearest::Polyline;
use super::slopes::Slopes;
use crate::math::vector::Vector;

/// The moments of a curve's line.
#[derive(Debug, Clone, Copy)]
pub(super) struct Moments {
    pub centroid: Vector,
    /// The root mean square distance from the centroid.
    pub radius: f64,
    /// Mean of the squares of distances from the origin.
    mean_square: f64,
    length: f64,
}

/// Three times the mean square of distances from the origin over a segment from `a` to `b`.
fn square_sum(a: Vector, b: Vector) -> f64 {
    a.norm2() + a.dot(b) + b.norm2()
}

impl Moments {
    /// The moments of a line; `lengths` are those before each of its ends.
    pub(super) fn of(line: &Polyline, lengths: &[f64]) -> Self {
        let (mut first, mut second) = (Vector::ZERO, 0.0);
        for (segment, ends) in line.segments.iter().zip(lengths.windows(2)) {
            let (a, b) = (segment.start, segment.start + segment.vector);
            first += (a + b).scale(ends[1] - ends[0]);
            second += square_sum(a, b) * (ends[1] - ends[0]);
        }
        let length = lengths[lengths.len() - 1];
        let (centroid, mean_square) = (first.scale(0.5 / length), second / (3.0 * length));
        let radius = (mean_square - centroid.norm2()).max(0.0).sqrt();
        Self { centroid, radius, mean_square, length }
    }

    /// The derivatives of the centroid's x and y and of the radius by the ends of the line's segments.
    pub(super) fn differentiate(&self, line: &Polyline, lengths: &[f64], out: [&mut Slopes; 3]) {
        let Self { centroid, radius, mean_square, length } = *self;
        let [by_x, by_y, by_radius] = out;
        for (t, (segment, ends)) in line.segments.iter().zip(lengths.windows(2)).enumerate() {
            let own = ends[1] - ends[0];
            if own <= 0.0 {
                continue;
            }
            let (a, b) = (segment.start, segment.start + segment.vector);
            let along = segment.vector.scale(1.0 / own);
            let share = own / length;
            let off = (a + b).scale(0.5) - centroid;
            let half = Vector::new(0.5 * share, 0.0);
            by_x.add_ends(t, [half, half]);
            by_x.add_length(t, along, off.x / length);
            by_y.add_ends(t, [half.left(), half.left()]);
            by_y.add_length(t, along, off.y / length);
            // 2 R dR = d(mean square) − 2 centroid · d(centroid)
            let by_end = |near: Vector, far: Vector| {
                ((near.scale(2.0) + far).scale(1.0 / 3.0) - centroid).scale(0.5 * share / radius)
            };
            by_radius.add_ends(t, [by_end(a, b), by_end(b, a)]);
            let excess = square_sum(a, b) / 3.0 - mean_square - 2.0 * centroid.dot(off);
            by_radius.add_length(t, along, 0.5 * excess / (radius * length));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points at equal distances along the line are the other way to the moments. (Derivatives are tested with
    /// those of the objective.)
    #[test]
    fn moments_are_those_of_many_points() {
        let corners =
            [[1.0, 2.0], [3.0, 2.5], [2.0, 4.0], [-1.0, 3.0]].map(|[x, y]| Vector::new(x, y));
        let line = Polyline::through(&corners);
        let mut lengths = vec![0.0];
        let mut points = vec![];
        for ends in corners.windows(2) {
            let length = (ends[1] - ends[0]).norm();
            lengths.push(lengths[lengths.len() - 1] + length);
            let count = (length * 2e4).round();
            let part = |k: f64| (k + 0.5) / count;
            points.extend(
                (0..20_000 * 4)
                    .map(f64::from)
                    .take_while(|&k| k < count)
                    .map(|k| ends[0] + (ends[1] - ends[0]).scale(part(k))),
            );
        }
        let moments = Moments::of(&line, &lengths);
        let count = points.len() as f64;
        let centroid =
            points.iter().fold(Vector::ZERO, |sum, &point| sum + point).scale(1.0 / count);
        let square = points.iter().map(|&point| (point - centroid).norm2()).sum::<f64>() / count;
        assert!((moments.centroid - centroid).norm() < 1e-4);
        assert!((moments.radius - square.sqrt()).abs() < 1e-4);
    }
}
