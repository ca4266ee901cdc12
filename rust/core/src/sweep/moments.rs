//! Means and moments of some points, from which lines and circles of least squares follow.

use crate::math::vector::Vector;

/// Points that are summed or compared at once.
pub(super) const SIDE_BY_SIDE: usize = 4;

/// The mean of some points, and the sums of squares and products about it: xx, xy, yy.
#[derive(Clone, Copy)]
pub(super) struct Moments {
    pub middle: Vector,
    pub squares: [f64; 3],
}

impl Moments {
    pub(super) fn of(stretch: &[Vector]) -> Self {
        // About one of the points, squares are hardly greater than about the mean.
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
    pub(super) fn axis(&self) -> Vector {
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

/// Sums over all points, [`SIDE_BY_SIDE`] at once: one addition need not wait for the last.
fn sums<const N: usize>(points: &[Vector], terms: impl Fn(Vector) -> [f64; N]) -> [f64; N] {
    let mut lane_sums = [[0.0; SIDE_BY_SIDE]; N];
    let (whole, rest) = points.as_chunks::<SIDE_BY_SIDE>();
    for points in whole {
        for (lane, &point) in points.iter().enumerate() {
            for (lane_sums, term) in lane_sums.iter_mut().zip(terms(point)) {
                lane_sums[lane] += term;
            }
        }
    }
    for (lane, &point) in rest.iter().enumerate() {
        for (lane_sums, term) in lane_sums.iter_mut().zip(terms(point)) {
            lane_sums[lane] += term;
        }
    }
    lane_sums.map(|lanes| lanes.iter().sum())
}
