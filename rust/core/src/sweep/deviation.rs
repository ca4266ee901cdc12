//! How straight, or how round, the best part of a path is.

use super::metric::{Metric, Need, Positions};
use crate::batch::outputs::Quantity;
use crate::math::vector::Vector;

/// Distances by running sums differ from others by no more than this part of the size of the path: a
/// stretch that is a thousandth of it has moments to nine digits, and a direction to as many.
const RUNNING_SUMS: f64 = 1.0e-6;

/// Points that are summed or compared at once.
const SIDE_BY_SIDE: usize = 4;

/// What the path is compared with.
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
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Deviation {
    /// Index of the joint.
    pub joint: usize,
    /// What its path is compared with.
    pub shape: Shape,
    /// Number of consecutive positions.
    pub count: usize,
    /// Whether the first position follows the last.
    pub is_closed: bool,
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
        let count = self.count;
        if count == 0 || points.len() < count {
            return f64::NAN;
        }
        let starts = if self.is_closed { points.len() } else { points.len() - count + 1 };
        let mut path: Vec<Vector> = points.iter().map(|&[x, y]| Vector::new(x, y)).collect();
        path.extend_from_within(..starts + count - 1 - points.len());
        // Three points show where the best stretch is likely to be, and which are worse.
        let size = if self.is_relative { diagonal(points) } else { 1.0 };
        let bounds: Vec<f64> = match self.shape {
            Shape::Line => path.windows(count).map(|stretch| of_three(stretch) / size).collect(),
            Shape::Circle => vec![0.0; starts],
        };
        let likely =
            (0..starts).fold(0, |best, at| if bounds[at] < bounds[best] { at } else { best });
        let mut least = self.greatest(&path[likely..likely + count], f64::INFINITY);
        let sums = RunningSums::of(&path);
        for ((start, stretch), &bound) in path.windows(count).enumerate().zip(&bounds) {
            let few_points = || off_line_of_sums(stretch, sums.moments(start, count)) / size;
            let is_line = self.shape == Shape::Line;
            if bound < least && !(is_line && few_points() > least + sums.rounding / size) {
                let found = self.greatest(stretch, least);
                least = if found < least { found } else { least };
            }
        }
        if least == f64::INFINITY { f64::NAN } else { least }
    }
}

impl Deviation {
    /// The greatest distance of a stretch; infinite if it is not below `least`.
    fn greatest(&self, stretch: &[Vector], least: f64) -> f64 {
        let moments = Moments::of(stretch);
        match self.shape {
            Shape::Line => self.off_line(stretch, moments, least),
            Shape::Circle => self.off_circle(stretch, moments, least),
        }
    }

    /// The greatest distance from the line of least squares; infinite if it is not below `least`.
    fn off_line(&self, stretch: &[Vector], moments: Moments, least: f64) -> f64 {
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
        farthest(stretch, least * length, |point| axis.cross(point - middle)) / length
    }

    /// The same from the circle of least squares.
    fn off_circle(&self, stretch: &[Vector], moments: Moments, least: f64) -> f64 {
        let Moments { middle, squares: [xx, xy, yy] } = moments;
        let mut cubic = Vector::ZERO;
        for &point in stretch {
            let from_middle = point - middle;
            cubic += from_middle.scale(from_middle.norm2());
        }
        let centre = Vector::new(yy * cubic.x - xy * cubic.y, xx * cubic.y - xy * cubic.x)
            .scale(0.5 / (xx * yy - xy * xy));
        let radius = (centre.norm2() + (xx + yy) / stretch.len() as f64).sqrt();
        let length = if self.is_relative { radius } else { 1.0 };
        let distance = |point: Vector| (point - middle - centre).norm() - radius;
        farthest(stretch, least * length, distance) / length
    }
}

/// The mean of some points, and the sums of squares and products about it: xx, xy, yy.
#[derive(Clone, Copy)]
struct Moments {
    middle: Vector,
    squares: [f64; 3],
}

impl Moments {
    fn of(stretch: &[Vector]) -> Self {
        // About a point among them, squares are hardly greater than about the mean.
        let origin = stretch[stretch.len() / 2];
        let sums = sums(stretch, |point| {
            let Vector { x, y } = point - origin;
            [x, y, x * x, x * y, y * y]
        });
        Self::about(origin, sums, stretch.len())
    }

    /// From sums of coordinates, squares and products about a point.
    fn about(origin: Vector, [x, y, xx, xy, yy]: [f64; 5], count: usize) -> Self {
        let from_origin = Vector::new(x, y).scale(1.0 / count as f64);
        let Vector { x: mean_x, y: mean_y } = from_origin;
        let squares = [xx - x * mean_x, xy - x * mean_y, yy - y * mean_y];
        Self { middle: origin + from_origin, squares }
    }

    /// The direction of the line of least squares, that of the greater moment: tan 2α = 2 xy/(xx − yy).
    fn axis(&self) -> Vector {
        let [xx, xy, yy] = self.squares;
        let half = 0.5 * (xx - yy);
        let radius = (half * half + xy * xy).sqrt();
        let axis = if half > 0.0 {
            Vector::new(radius + half, xy)
        } else {
            Vector::new(xy, radius - half)
        };
        if axis == Vector::ZERO { Vector::ONE } else { axis.scale(1.0 / axis.norm()) }
    }
}

/// How far some of the first, middle and last point of a stretch are from any line, at least: half of
/// the least altitude of their triangle (a little less, for rounding).
fn of_three(stretch: &[Vector]) -> f64 {
    let from = stretch[0];
    let (a, b) = (stretch[stretch.len() / 2] - from, stretch[stretch.len() - 1] - from);
    let twice_area = a.cross(b);
    let altitude2 = twice_area * twice_area / a.norm2().max(b.norm2()).max((b - a).norm2());
    // The triangle may be a point.
    (0.5 - 1.0e-9) * altitude2.max(0.0).sqrt()
}

/// How far the ends and the middle of a stretch are from a line.
fn off_line_of_sums(stretch: &[Vector], moments: Moments) -> f64 {
    let (middle, axis) = (moments.middle, moments.axis());
    let last = stretch.len() - 1;
    let few = [0, last / 2, last].map(|at| axis.cross(stretch[at] - middle).abs());
    few[0].max(few[1]).max(few[2])
}

/// Running sums of coordinates, squares and products about the first point of a path.
struct RunningSums {
    origin: Vector,
    sums: Vec<[f64; 5]>,
    /// How far a distance by these may be off.
    rounding: f64,
}

impl RunningSums {
    fn of(path: &[Vector]) -> Self {
        let origin = path.first().copied().unwrap_or(Vector::ZERO);
        let mut sum = [0.0; 5];
        let mut size = 0.0;
        let mut sums = Vec::with_capacity(path.len() + 1);
        sums.push(sum);
        for &point in path {
            let Vector { x, y } = point - origin;
            for (sum, term) in sum.iter_mut().zip([x, y, x * x, x * y, y * y]) {
                *sum += term;
            }
            sums.push(sum);
            size = if x.abs() + y.abs() > size { x.abs() + y.abs() } else { size };
        }
        Self { origin, sums, rounding: RUNNING_SUMS * size }
    }

    fn moments(&self, start: usize, count: usize) -> Moments {
        let (from, to) = (&self.sums[start], &self.sums[start + count]);
        let sums = std::array::from_fn(|k| to[k] - from[k]);
        Moments::about(self.origin, sums, count)
    }
}

/// The diagonal of the box around some points: no stretch is longer.
fn diagonal(points: &[[f64; 2]]) -> f64 {
    let mut ends = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
    for &[x, y] in points {
        ends[0] = [ends[0][0].min(x), ends[0][1].min(y)];
        ends[1] = [ends[1][0].max(x), ends[1][1].max(y)];
    }
    Vector::new(ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]).norm()
}

/// Sums over all points, [`SIDE_BY_SIDE`] at once: one addition need not wait for the last.
fn sums<const N: usize>(points: &[Vector], terms: impl Fn(Vector) -> [f64; N]) -> [f64; N] {
    let mut some = [[0.0; SIDE_BY_SIDE]; N];
    let (whole, rest) = points.as_chunks::<SIDE_BY_SIDE>();
    for points in whole {
        for (lane, &point) in points.iter().enumerate() {
            for (some, term) in some.iter_mut().zip(terms(point)) {
                some[lane] += term;
            }
        }
    }
    for (lane, &point) in rest.iter().enumerate() {
        for (some, term) in some.iter_mut().zip(terms(point)) {
            some[lane] += term;
        }
    }
    some.map(|lanes| lanes.iter().sum())
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
