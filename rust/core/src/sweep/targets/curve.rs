//! The curve of a joint: a polyline through its positions, and derivatives by these.

use crate::math::polyline::{Place, Polyline};

/// A polyline through positions.
#[derive(Debug)]
pub(super) struct Curve {
    pub points: Vec<[f64; 2]>,
    pub line: Polyline<2>,
}

impl Curve {
    /// Through points, and back to the first if it is closed.
    pub(super) fn new(points: Vec<[f64; 2]>, is_closed: bool) -> Self {
        let line = Polyline::through(&points, is_closed);
        Self { points, line }
    }
}

/// The derivatives of a number by the points of a curve, and by the lengths of its segments.
#[derive(Debug)]
pub(super) struct CurveSlopes {
    points: Vec<[f64; 2]>,
    pub lengths: Vec<f64>,
}

impl CurveSlopes {
    /// All zero.
    pub(super) fn new(curve: &Curve) -> Self {
        let lengths = vec![0.0; curve.line.len()];
        Self { points: vec![[0.0; 2]; curve.points.len()], lengths }
    }

    /// Adds the derivative by a corner.
    pub(super) fn add_corner(&mut self, corner: usize, [x, y]: [f64; 2]) {
        self.points[corner][0] += x;
        self.points[corner][1] += y;
    }

    /// Adds the derivative by a place that keeps its part of its segment.
    pub(super) fn add_place(&mut self, curve: &Curve, place: Place, [x, y]: [f64; 2]) {
        let [start, end] = curve.line.ends(place.segment);
        let (before, after) = (1.0 - place.part, place.part);
        self.add_corner(start, [before * x, before * y]);
        self.add_corner(end, [after * x, after * y]);
    }

    /// The derivatives by the points alone, those by lengths included.
    pub(super) fn by_points(mut self, curve: &Curve) -> Vec<[f64; 2]> {
        for segment in 0..self.lengths.len() {
            let [start, end] = curve.line.ends(segment);
            let [x, y] = curve.line.direction(segment).map(|number| number * self.lengths[segment]);
            self.add_corner(start, [-x, -y]);
            self.add_corner(end, [x, y]);
        }
        self.points
    }
}
