//! The nearest places of a polyline to many points, side by side.

use crate::batch::dispatch::{Entry, ForLevel, Task, at_level};
use crate::math::lanes::{LANES, Real};
use crate::math::polyline::{Place, Polyline};
use crate::math::simd::Simd;
use crate::sweep::metric::Positions;

/// Points between two checks whether the caller has cancelled the work.
const POINTS: usize = 8 * LANES;

/// Pairs of a point and a segment in the time that a position takes.
const PAIRS: usize = 4;

/// The [effort](crate::sweep::Metric::effort) of so many points or segments beside each position.
pub(super) fn effort(count: usize) -> usize {
    count.div_ceil(PAIRS)
}

/// The nearest place of a polyline to a point.
#[derive(Debug, Clone, Copy)]
pub(super) struct Foot<const D: usize> {
    pub place: Place,
    /// From the point to the place.
    pub off: [f64; D],
    /// Its square.
    pub square: f64,
}

/// The feet of all points, of fewer if the work is cancelled.
pub(super) fn feet<const D: usize>(
    line: &Polyline<D>,
    points: &[[f64; D]],
    positions: &Positions<'_>,
) -> Vec<Foot<D>> {
    let mut feet = Vec::with_capacity(points.len());
    for points in points.chunks(POINTS) {
        if positions.is_cancelled() {
            break;
        }
        at_level(Simd::best(), &mut Search { line, points, feet: &mut feet });
    }
    feet
}

struct Search<'s, const D: usize> {
    line: &'s Polyline<D>,
    points: &'s [[f64; D]],
    feet: &'s mut Vec<Foot<D>>,
}

impl<const D: usize> ForLevel for &mut Search<'_, D> {
    type Output = ();

    fn run<L: Entry, const G: usize>(mut self) {
        L::call(&mut self);
    }
}

impl<R: Real, const D: usize> Task<R> for &mut Search<'_, D> {
    #[inline(always)]
    fn run(&mut self) {
        for few in self.points.chunks(R::LANES) {
            // Lanes beyond the last point repeat it.
            let point = std::array::from_fn(|k| {
                R::from_lanes(|lane| few[if lane < few.len() { lane } else { few.len() - 1 }][k])
            });
            let [_, segment, part] = self.line.nearest(point);
            for (lane, point) in few.iter().enumerate() {
                #[allow(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "it is the index of a segment"
                )]
                let place = Place { segment: segment.lane(lane) as usize, part: part.lane(lane) };
                let mut off = self.line.point(place);
                for (off, point) in off.iter_mut().zip(point) {
                    *off -= point;
                }
                let square = off.iter().map(|number| number * number).sum();
                self.feet.push(Foot { place, off, square });
            }
        }
    }
}
