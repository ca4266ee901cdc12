//! Deviation of the best part of a path from a line or a circle.

use super::course::Course;
use super::line_bounds::LineBounds;
use super::metric::{Metric, Need, Positions};
use super::moments::{Moments, SIDE_BY_SIDE};
use crate::batch::request::Quantity;
use crate::math::vector::Vector;

/// Products of a part and a number of positions that should be whole may fall short by less than this.
const WHOLE: f64 = 1.0e-9;

/// The shape with which the path is compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    /// The line with the least squares of distances.
    Line,
    /// The circle of least squares of Kåsa (*A circle fitting procedure and its error analysis*, IEEE
    /// Transactions on Instrumentation and Measurement 25, 1976).
    Circle,
}

/// The greatest distance of a joint's path from a line or circle, over the consecutive positions
/// where it is least, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Deviation {
    /// Index of the joint.
    pub joint: usize,
    /// The shape with which its path is compared.
    pub shape: Shape,
    /// The part of the positions that are consecutive: more than 0, at most 1. Where the motion
    /// [returns](Positions::returns) they pass from the last to the first.
    pub part: f64,
    /// Whether it is divided by the length along the line, or by the radius.
    pub is_relative: bool,
}

impl Metric for Deviation {
    fn needs(&self) -> Vec<Need> {
        vec![Need { quantity: Quantity::Joint(self.joint), order: 0 }]
    }

    fn of(&self, positions: &Positions<'_>) -> f64 {
        let all = positions.values.first().copied().unwrap_or(&[]);
        let points = all.as_chunks::<2>().0;
        let count = self.count(points.len(), positions.returns);
        if count < self.least_count() {
            return f64::NAN;
        }
        let starts = if positions.returns { points.len() } else { points.len() - count + 1 };
        let mut path = Vec::with_capacity(starts + count - 1);
        path.extend(points.iter().map(|&[x, y]| Vector::new(x, y)));
        path.extend_from_within(..starts + count - 1 - points.len());
        let bounds = (self.shape == Shape::Line).then(|| LineBounds::of(&path, count));
        let size = if self.is_relative { diagonal(points) } else { 1.0 };
        // Three points show the likely place of the best stretch, and stretches that are worse.
        let [of_three2, of_sums2] =
            bounds.as_ref().map_or([&[][..]; 2], |bounds| [bounds.of_three(), bounds.of_sums()]);
        let likely = (0..of_three2.len())
            .fold(0, |best, at| if of_three2[at] < of_three2[best] { at } else { best });
        let mut best_distance = self.greatest(&path[likely..likely + count], f64::INFINITY);
        for (start, stretch) in path.windows(count).enumerate() {
            if positions.is_cancelled() {
                return f64::NAN;
            }
            let is_worse = bounds.as_ref().is_some_and(|bounds| {
                let (limit, slack) = (best_distance * size, best_distance * size + bounds.rounding);
                of_three2[start] >= limit * limit || of_sums2[start] > slack * slack
            });
            if !is_worse {
                let distance = self.greatest(stretch, best_distance);
                best_distance = if distance < best_distance { distance } else { best_distance };
            }
        }
        if best_distance == f64::INFINITY { f64::NAN } else { best_distance }
    }

    fn asks_return(&self) -> bool {
        true
    }

    fn check(&self, course: &Course<'_>) -> Result<(), String> {
        if !(self.part > 0.0 && self.part <= 1.0) {
            return Err(format!("part is {}: more than 0 and at most 1 is needed", self.part));
        }
        let (all, minimum) = (course.count(), self.least_count());
        let count = self.count(all, course.turn.is_some());
        if count >= minimum {
            return Ok(());
        }
        let part = self.part;
        Err(format!(
            "part={part} of {all} positions are {count}: too few, {minimum} are needed at least"
        ))
    }
}

impl Deviation {
    /// Number of consecutive positions, of all.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to a length")]
    fn count(&self, all: usize, returns: bool) -> usize {
        let steps = if returns { all } else { all.saturating_sub(1) };
        let count = (self.part * steps as f64 + WHOLE).floor() as usize + 1;
        count.min(all)
    }

    /// One more than lie on any line or circle.
    fn least_count(&self) -> usize {
        match self.shape {
            Shape::Line => 3,
            Shape::Circle => 4,
        }
    }

    /// The greatest distance of a stretch; infinite if it is not below `limit`.
    fn greatest(&self, stretch: &[Vector], limit: f64) -> f64 {
        let moments = Moments::of(stretch);
        match self.shape {
            Shape::Line => self.off_line(stretch, moments, limit),
            Shape::Circle => self.off_circle(stretch, moments, limit),
        }
    }

    /// The greatest distance from the line of least squares; infinite if it is not below `limit`.
    fn off_line(&self, stretch: &[Vector], moments: Moments, limit: f64) -> f64 {
        let (axis, middle) = (moments.axis(), moments.middle);
        let length = if self.is_relative {
            let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
            for &point in stretch {
                let along = axis.dot(point - middle);
                (low, high) = (low.min(along), high.max(along));
            }
            high - low
        } else {
            1.0
        };
        farthest(stretch, limit * length, |point| axis.cross(point - middle)) / length
    }

    /// The same for the circle of least squares; points on a line give an infinitely large one.
    fn off_circle(&self, stretch: &[Vector], moments: Moments, limit: f64) -> f64 {
        let Moments { middle, squares: [xx, xy, yy] } = moments;
        let determinant = xx * yy - xy * xy;
        if determinant == 0.0 {
            let from_line = Self { is_relative: false, ..*self };
            let scale = if self.is_relative { 0.0 / (xx + yy) } else { 1.0 };
            return scale * from_line.off_line(stretch, moments, f64::INFINITY);
        }
        let mut cubic = Vector::ZERO;
        for &point in stretch {
            let from_middle = point - middle;
            cubic += from_middle.scale(from_middle.norm2());
        }
        let centre = Vector::new(yy * cubic.x - xy * cubic.y, xx * cubic.y - xy * cubic.x)
            .scale(0.5 / determinant);
        let mean_square = (xx + yy) / stretch.len() as f64;
        let radius = (centre.norm2() + mean_square).sqrt();
        let length = if self.is_relative { radius } else { 1.0 };
        // |p − c| − r = (|p|² − 2 p·c − (r² − |c|²))/(|p − c| + r): the difference itself loses the
        // distance where the radius is large.
        let distance = |point: Vector| {
            let from_middle = point - middle;
            let power = from_middle.norm2() - 2.0 * from_middle.dot(centre) - mean_square;
            power / ((from_middle - centre).norm() + radius)
        };
        farthest(stretch, limit * length, distance) / length
    }
}

/// The diagonal of the box around some points, an upper bound of the length of a stretch.
fn diagonal(points: &[[f64; 2]]) -> f64 {
    let mut ends = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
    for &[x, y] in points {
        ends[0] = [ends[0][0].min(x), ends[0][1].min(y)];
        ends[1] = [ends[1][0].max(x), ends[1][1].max(y)];
    }
    Vector::new(ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]).norm()
}

/// The greatest size of a distance; infinite if one is found that is not below a limit.
fn farthest(stretch: &[Vector], limit: f64, distance: impl Fn(Vector) -> f64) -> f64 {
    let mut most = [0.0_f64; SIDE_BY_SIDE];
    let mut is_below = true;
    // The ends are often the farthest.
    for points in stretch.rchunks(SIDE_BY_SIDE) {
        for (most, &point) in most.iter_mut().zip(points) {
            let size = distance(point).abs();
            // NaN is not below.
            is_below &= size < limit;
            *most = if size > *most { size } else { *most };
        }
        if !is_below {
            return f64::INFINITY;
        }
    }
    most.into_iter().fold(0.0, f64::max)
}
