//! A path to draw: a polyline, moved to its centroid and scaled to a root mean square radius of 1.

use super::nearest::Polyline;
use crate::math::vector::Vector;

/// A path to draw. Corners stay as they are; samples of it lie at equal distances along it.
#[derive(Debug, Clone)]
pub(crate) struct Target {
    /// Its corners, in its own frame.
    corners: Vec<Vector>,
    /// Distance along it of each corner.
    lengths: Vec<f64>,
    /// Whether the last corner leads back to the first.
    pub is_closed: bool,
    /// Its centroid as the user gave it: of the line, not of the corners.
    pub centre: Vector,
    /// Its root mean square distance from the centroid.
    pub radius: f64,
    pub polyline: Polyline,
}

impl Target {
    /// The path through points. `None` if they are fewer than two different ones, or not finite.
    pub(crate) fn new(points: &[[f64; 2]], is_closed: bool) -> Option<Self> {
        let mut corners: Vec<Vector> = points.iter().map(|&[x, y]| Vector::new(x, y)).collect();
        corners.dedup();
        if is_closed && corners.len() > 1 {
            // The way back to the first is a segment like the others.
            corners.extend(corners.first().copied());
            corners.dedup();
        }
        let mut lengths = vec![0.0];
        let (mut first, mut second) = (Vector::ZERO, 0.0);
        let origin = *corners.first()?;
        for ends in corners.windows(2) {
            let length = (ends[1] - ends[0]).norm();
            let middle = (ends[0] + ends[1]).scale(0.5) - origin;
            first += middle.scale(length);
            second += length * (middle.norm2() + length * length / 12.0);
            lengths.push(lengths.last()? + length);
        }
        let total = *lengths.last()?;
        let mean = first.scale(1.0 / total);
        let radius = (second / total - mean.norm2()).sqrt();
        if !(radius > 0.0 && radius.is_finite()) {
            return None;
        }
        let centre = origin + mean;
        for corner in &mut corners {
            *corner = (*corner - centre).scale(1.0 / radius);
        }
        for length in &mut lengths {
            *length /= radius;
        }
        let polyline = Polyline::through(&corners);
        Some(Self { corners, lengths, is_closed, centre, radius, polyline })
    }

    /// `count` points at equal distances along it; of an open path both ends are among them.
    pub(crate) fn samples(&self, count: usize) -> Vec<Vector> {
        let total = self.lengths[self.lengths.len() - 1];
        let steps = if self.is_closed { count } else { count - 1 } as f64;
        let mut segment = 0;
        let mut samples = Vec::with_capacity(count);
        for k in 0..count {
            let length = total * k as f64 / steps;
            while segment + 2 < self.lengths.len() && self.lengths[segment + 1] < length {
                segment += 1;
            }
            let [from, to] = [self.lengths[segment], self.lengths[segment + 1]];
            let part = ((length - from) / (to - from)).min(1.0);
            let [start, end] = [self.corners[segment], self.corners[segment + 1]];
            samples.push(start + (end - start).scale(part));
        }
        samples
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_square_has_its_radius() {
        let square = [[1.0, 1.0], [3.0, 1.0], [3.0, 3.0], [1.0, 3.0]];
        let target = Target::new(&square, true).expect("a path");
        assert_eq!(target.centre, Vector::new(2.0, 2.0));
        // Over a side 1 + t², t from −1 to 1: 4/3.
        assert!((target.radius - (4.0_f64 / 3.0).sqrt()).abs() < 1e-15);
        let samples = target.samples(8);
        let middle = Vector::new(0.0, -1.0 / target.radius);
        assert!((samples[1] - middle).norm() < 1e-15);
        let open = Target::new(&square, false).expect("a path");
        assert!((open.samples(7)[6] - open.corners[3]).norm() < 1e-15);
    }

    #[test]
    fn repeated_points_are_one() {
        assert!(Target::new(&[[1.0, 2.0], [1.0, 2.0]], false).is_none());
        assert!(Target::new(&[], false).is_none());
        assert!(Target::new(&[[0.0, 0.0], [f64::NAN, 1.0]], false).is_none());
        assert!(Target::new(&[[0.0, 0.0], [0.0, 0.0], [1.0, 1.0]], true).is_some());
    }
}
