//! How far the path of a joint is from a target.

use super::chamfer::Chamfer;
use super::curve::{Curve, CurveSlopes};
use super::feet::{effort, feet};
use super::ordered::Ordered;
use super::path_target::{Frame, LineTarget, SAMPLES, points_in_frame};
use crate::batch::request::Quantity;
use crate::sweep::metric::{Metric, Need, Positions, Slopes};

/// How the distance of a path from a target is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PathDistance {
    /// The root of the mean squared distance of the target's points from the path.
    Points,
    /// The mean distance from the target's line to the path plus that from the path to the line.
    Chamfer,
    /// The root of the mean squared distance of points at equal parts of both lengths, in the better direction; of a
    /// closed target from its best start.
    Ordered,
}

/// The distance of a joint's path from a target, over the target's root mean square distance from its centroid.
///
/// The path is a polyline through the positions in order, closed where the motion [returns](Positions::returns).
#[derive(Debug, Clone)]
pub struct PathError {
    joint: usize,
    frame: Frame,
    target: Target,
}

#[derive(Debug, Clone)]
enum Target {
    Points(Vec<[f64; 2]>),
    Chamfer(LineTarget),
    Ordered(LineTarget),
}

impl PathError {
    /// Of a joint by its index. `is_closed`: whether the target's line leads back from its last point to the
    /// first; without a word, if these are the same. Single points make no line.
    ///
    /// # Errors
    ///
    /// The reason why the points make no target.
    pub fn new(
        joint: usize,
        points: &[[f64; 2]],
        distance: PathDistance,
        is_closed: Option<bool>,
    ) -> Result<Self, String> {
        let line = || LineTarget::new(points, is_closed);
        let (frame, target) = match distance {
            PathDistance::Points => {
                let (frame, points) = points_in_frame(points)?;
                (frame, Target::Points(points))
            }
            PathDistance::Chamfer => {
                let (frame, line) = line()?;
                (frame, Target::Chamfer(line))
            }
            PathDistance::Ordered => {
                let (frame, line) = line()?;
                (frame, Target::Ordered(line))
            }
        };
        Ok(Self { joint, frame, target })
    }

    /// The path of the joint, in the target's frame. What has an order and two ends is passed once, from the first
    /// position to the last.
    fn curve(&self, positions: &Positions<'_>) -> Curve {
        let all = positions.values.first().copied().unwrap_or(&[]);
        let points = all.as_chunks::<2>().0.iter().map(|&point| self.frame.enter(point));
        let is_open = matches!(&self.target, Target::Ordered(line) if !line.is_closed);
        Curve::new(points.collect(), positions.returns && !is_open)
    }
}

impl Metric for PathError {
    fn needs(&self) -> Vec<Need> {
        vec![Need { quantity: Quantity::Joint(self.joint), order: 0 }]
    }

    fn of(&self, positions: &Positions<'_>) -> f64 {
        let curve = self.curve(positions);
        if curve.points.is_empty() {
            return f64::NAN;
        }
        match &self.target {
            Target::Points(points) => {
                let feet = feet(&curve.line, points, positions);
                let sum: f64 = feet.iter().map(|foot| foot.square).sum();
                (sum / points.len() as f64).sqrt()
            }
            Target::Chamfer(target) => Chamfer::new(&curve, target, positions).value(),
            Target::Ordered(target) => Ordered::new(&curve, target).value(),
        }
    }

    fn asks_return(&self) -> bool {
        true
    }

    fn effort(&self) -> usize {
        match &self.target {
            Target::Points(points) => effort(points.len()),
            Target::Chamfer(target) | Target::Ordered(target) => {
                effort(SAMPLES + target.line.len())
            }
        }
    }

    fn with_slopes(&self) -> Option<&dyn Slopes> {
        Some(self)
    }
}

impl Slopes for PathError {
    fn slopes(&self, positions: &Positions<'_>) -> Vec<Vec<f64>> {
        let curve = self.curve(positions);
        let slopes = match &self.target {
            Target::Points(points) => {
                let feet = feet(&curve.line, points, positions);
                let sum: f64 = feet.iter().map(|foot| foot.square).sum();
                let count = points.len() as f64;
                // d√m = dm / 2√m: of 0 none.
                let scale = 1.0 / (count * (sum / count).sqrt());
                let mut slopes = CurveSlopes::new(&curve);
                for foot in feet {
                    slopes.add_place(&curve, foot.place, foot.off.map(|off| off * scale));
                }
                slopes
            }
            Target::Chamfer(target) => Chamfer::new(&curve, target, positions).slopes(),
            Target::Ordered(target) => Ordered::new(&curve, target).slopes(),
        };
        let by_points = slopes.by_points(&curve);
        vec![by_points.as_flattened().iter().map(|slope| slope / self.frame.radius).collect()]
    }
}
