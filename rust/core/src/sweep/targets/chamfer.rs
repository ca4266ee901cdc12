//! The Chamfer distance of a curve and a target line: the mean distance from the target to the curve plus that from
//! the curve to the target, both by length.

use super::curve::{Curve, CurveSlopes};
use super::feet::{Foot, feet};
use super::path_target::LineTarget;
use crate::sweep::metric::Positions;

/// The distances, found once for the value and its slopes.
pub(super) struct Chamfer<'c> {
    curve: &'c Curve,
    /// From the target's samples, each for an equal part of it, to the curve.
    to_curve: Vec<Foot<2>>,
    /// From the curve's corners, each for half of both segments that meet there, to the target.
    to_target: Vec<Foot<2>>,
}

impl<'c> Chamfer<'c> {
    pub(super) fn new(curve: &'c Curve, target: &LineTarget, positions: &Positions<'_>) -> Self {
        let to_curve = feet(&curve.line, &target.samples, positions);
        let to_target = feet(&target.line, &curve.points, positions);
        Self { curve, to_curve, to_target }
    }

    pub(super) fn value(&self) -> f64 {
        let sum: f64 = self.to_curve.iter().map(|foot| foot.square.sqrt()).sum();
        sum / self.to_curve.len() as f64 + self.mean_to_target()
    }

    /// The mean distance from the curve to the target; of a point at rest its distance.
    fn mean_to_target(&self) -> f64 {
        let total = self.curve.line.total();
        if total == 0.0 {
            return self.to_target.first().map_or(f64::NAN, |foot| foot.square.sqrt());
        }
        let by_segment = |segment: usize| self.curve.line.length(segment) * self.at_middle(segment);
        (0..self.curve.line.len()).map(by_segment).sum::<f64>() / total
    }

    /// The mean of the distances at both ends of a segment of the curve.
    fn at_middle(&self, segment: usize) -> f64 {
        let ends = self.curve.line.ends(segment);
        let [start, end] = ends.map(|corner| self.to_target[corner].square.sqrt());
        0.5 * (start + end)
    }

    /// The derivatives of the value. The parts of the length that corners stand for depend on the curve, too.
    pub(super) fn slopes(&self) -> CurveSlopes {
        let mut slopes = CurveSlopes::new(self.curve);
        for foot in &self.to_curve {
            let weight = 1.0 / self.to_curve.len() as f64;
            slopes.add_place(self.curve, foot.place, unit(foot.off, weight));
        }
        let total = self.curve.line.total();
        if total == 0.0 {
            if let Some(foot) = self.to_target.first() {
                slopes.add_corner(0, unit(foot.off, -1.0));
            }
            return slopes;
        }
        let mean = self.mean_to_target();
        for segment in 0..self.curve.line.len() {
            let half = 0.5 * self.curve.line.length(segment) / total;
            for corner in self.curve.line.ends(segment) {
                // The corner is the point, its foot on the target stands still.
                slopes.add_corner(corner, unit(self.to_target[corner].off, -half));
            }
            slopes.lengths[segment] += (self.at_middle(segment) - mean) / total;
        }
        slopes
    }
}

/// The unit vector along another times a number; none along zero: at its least value a distance has no slope.
fn unit([x, y]: [f64; 2], factor: f64) -> [f64; 2] {
    let length = (x * x + y * y).sqrt();
    if length > 0.0 { [factor * x / length, factor * y / length] } else { [0.0; 2] }
}
