//! The ordered distance: the root mean square distance of points at equal parts of the lengths of a curve and a
//! target, in the better direction, of a closed target from its best start.

use super::curve::{Curve, CurveSlopes};
use super::path_target::{LineTarget, SAMPLES};
use super::start::{Start, best_start};
use crate::math::polyline::{Place, Walk};

/// A curve beside a target as they match best.
pub(super) struct Ordered<'c> {
    curve: &'c Curve,
    /// Places at the middles of equal parts of the curve.
    places: Vec<Place>,
    /// From the target's points to these places.
    off: Vec<[f64; 2]>,
}

impl<'c> Ordered<'c> {
    pub(super) fn new(curve: &'c Curve, target: &LineTarget) -> Self {
        let part = curve.line.total() / SAMPLES as f64;
        let mut walk = Walk::new(&curve.line);
        let places: Vec<Place> = (0..SAMPLES).map(|k| walk.to((k as f64 + 0.5) * part)).collect();
        let points: Vec<[f64; 2]> = places.iter().map(|&place| curve.line.point(place)).collect();
        let off = if target.is_closed {
            best_start(&points, target).off(&points, target)
        } else {
            let [first, second] =
                Start::at_ends(target.line.total()).map(|start| start.off(&points, target));
            if mean_square(&second) < mean_square(&first) { second } else { first }
        };
        Self { curve, places, off }
    }

    pub(super) fn value(&self) -> f64 {
        mean_square(&self.off).sqrt()
    }

    /// The derivatives of the value; of 0 none. Where the match is best, the start adds nothing.
    pub(super) fn slopes(&self) -> CurveSlopes {
        let curve = self.curve;
        let mut slopes = CurveSlopes::new(curve);
        let scale = 1.0 / (SAMPLES as f64 * self.value());
        // A place at a part of the whole length moves along its segment as lengths change: by that part of
        // the change of all lengths, less the changes of those before it.
        let mut by_total = 0.0;
        let mut in_segment = vec![0.0; slopes.lengths.len()];
        for (k, (&place, off)) in self.places.iter().zip(&self.off).enumerate() {
            let [x, y] = off.map(|number| number * scale);
            slopes.add_place(curve, place, [x, y]);
            let [along_x, along_y] = curve.line.direction(place.segment);
            let along = x * along_x + y * along_y;
            by_total += along * (k as f64 + 0.5) / SAMPLES as f64;
            slopes.lengths[place.segment] -= along * place.part;
            in_segment[place.segment] += along;
        }
        let mut beyond = 0.0;
        for (by_length, along) in slopes.lengths.iter_mut().zip(in_segment).rev() {
            *by_length += by_total - beyond;
            beyond += along;
        }
        slopes
    }
}

fn mean_square(off: &[[f64; 2]]) -> f64 {
    off.iter().map(|[x, y]| x * x + y * y).sum::<f64>() / off.len() as f64
}
