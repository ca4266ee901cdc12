//! Where on a closed target the points of a curve begin, and in which direction they go, so that the sum of squares of
//! their distances is least.
//!
//! As the start moves along the target by x, each point's partner does. Away from the target's corners the sum is
//! a parabola in x with a known curvature; where a partner passes a corner, its slope jumps.

use super::path_target::{LineTarget, SAMPLES};
use crate::batch::dispatch::{Entry, ForLevel, Task, at_level};
use crate::math::lanes::Real;
use crate::math::polyline::{Place, Walk};
use crate::math::simd::Simd;

/// Most samples about which the best start is looked for: more come close only where the start hardly matters.
const MOST: usize = 16;

/// A way to pass a target.
#[derive(Debug, Clone, Copy)]
pub(super) struct Start {
    /// The length along the target before the first point's partner.
    at: f64,
    is_reversed: bool,
}

impl Start {
    /// Those at the ends of an open target, for the middles of equal parts.
    pub(super) fn at_ends(total: f64) -> [Self; 2] {
        let half = 0.5 * total / SAMPLES as f64;
        [Self { at: half, is_reversed: false }, Self { at: total - half, is_reversed: true }]
    }

    /// Calls a function for each of so many points: its index, and the length and the place of its partner. They
    /// come in the order of the target, whose end leads to its start.
    fn for_each(self, target: &LineTarget, count: usize, mut see: impl FnMut(usize, f64, Place)) {
        let total = target.line.total();
        let mut walk = Walk::new(&target.line);
        let mut last = 0.0;
        for step in 0..count {
            let k = if self.is_reversed { count - 1 - step } else { step };
            let from_start = total * k as f64 / count as f64;
            let at = if self.is_reversed { self.at - from_start } else { self.at + from_start };
            let at = at - total * (at / total).floor();
            if at < last {
                walk = Walk::new(&target.line);
            }
            last = at;
            see(k, at, walk.to(at));
        }
    }

    /// From each partner to its point.
    pub(super) fn off(self, points: &[[f64; 2]], target: &LineTarget) -> Vec<[f64; 2]> {
        let mut off = points.to_vec();
        self.for_each(target, points.len(), |k, _, place| {
            let [x, y] = target.line.point(place);
            off[k] = [points[k][0] - x, points[k][1] - y];
        });
        off
    }
}

/// The best start.
pub(super) fn best_start(points: &[[f64; 2]], target: &LineTarget) -> Start {
    let mut tried = at_samples(points, target);
    tried.sort_by(|first, second| first.0.total_cmp(&second.0));
    // A step of the start moves no distance by more than itself.
    let step = target.line.total() / SAMPLES as f64;
    let mut best = (f64::INFINITY, tried.first().map_or(Start::at_ends(0.0)[0], |first| first.1));
    for &(sum, start) in tried.iter().take(MOST) {
        let least = sum.sqrt() - 0.5 * step * (points.len() as f64).sqrt();
        if least > 0.0 && least * least > best.0 {
            break;
        }
        let found = best_within(points, target, Start { at: start.at - 0.5 * step, ..start }, step);
        if found.0 < best.0 {
            best = found;
        }
    }
    best.1
}

/// The least sum of squares for starts from one on, and that start.
fn best_within(points: &[[f64; 2]], target: &LineTarget, from: Start, width: f64) -> (f64, Start) {
    let (mut sum, mut slope) = (0.0, 0.0);
    // How far the start moves until a partner passes a corner, and the jump of the slope there.
    let mut jumps: Vec<(f64, f64)> = Vec::new();
    from.for_each(target, points.len(), |k, length, place| {
        let off = |[x, y]: [f64; 2]| [points[k][0] - x, points[k][1] - y];
        let dot = |[x, y]: [f64; 2], [u, v]: [f64; 2]| x * u + y * v;
        let here = off(target.line.point(place));
        sum += dot(here, here);
        slope -= 2.0 * dot(here, target.line.direction(place.segment));
        let mut segment = place.segment;
        let mut way = target.line.before_end(segment) - length;
        while way < width {
            let next = target.line.ends(segment)[1];
            let corner = off(target.line.point(Place { segment: next, part: 0.0 }));
            let [before, after] =
                [segment, next].map(|segment| dot(corner, target.line.direction(segment)));
            jumps.push((way, -2.0 * (after - before)));
            segment = next;
            way += target.line.length(segment);
        }
    });
    jumps.sort_by(|first, second| first.0.total_cmp(&second.0));
    jumps.push((width, 0.0));
    let curvature = 2.0 * points.len() as f64;
    let mut best = (sum, 0.0);
    let mut at = 0.0;
    for (next, jump) in jumps {
        let step = next - at;
        let flat = -slope / curvature;
        if flat > 0.0 && flat < step {
            let least = sum - 0.5 * slope * slope / curvature;
            if least < best.0 {
                best = (least, at + flat);
            }
        }
        sum += step * (slope + 0.5 * curvature * step);
        slope += curvature * step + jump;
        at = next;
        if sum < best.0 {
            best = (sum, at);
        }
    }
    (best.0, Start { at: from.at + best.1, ..from })
}

/// The sums of squares with each sample as the start, in both directions.
fn at_samples(points: &[[f64; 2]], target: &LineTarget) -> Vec<(f64, Start)> {
    let count = target.samples.len();
    let step = target.line.total() / count as f64;
    let mut tried = Vec::with_capacity(2 * count);
    for is_reversed in [false, true] {
        let place = |k: usize| if is_reversed { count - 1 - k % count } else { k % count };
        let twice = [0, 1]
            .map(|axis| (0..2 * count).map(|k| target.samples[place(k)][axis]).collect::<Vec<_>>());
        let mut sums = vec![0.0; count];
        at_level(Simd::best(), &mut Shifts { points, twice: &twice, sums: &mut sums });
        let start = |k: usize| Start { at: (place(k) as f64 + 0.5) * step, is_reversed };
        tried.extend(sums.into_iter().enumerate().map(|(k, sum)| (sum, start(k))));
    }
    tried
}

/// The sums of squares of the distances from points to samples, for each shift of these. Their number fills
/// registers.
struct Shifts<'s> {
    points: &'s [[f64; 2]],
    /// x and y of the samples, twice one after another.
    twice: &'s [Vec<f64>; 2],
    sums: &'s mut [f64],
}

impl ForLevel for &mut Shifts<'_> {
    type Output = ();

    fn run<L: Entry, const G: usize>(mut self) {
        L::call(&mut self);
    }
}

impl<R: Real> Task<R> for &mut Shifts<'_> {
    #[inline(always)]
    fn run(&mut self) {
        for first in (0..self.sums.len()).step_by(R::LANES) {
            let mut sum = R::ZERO;
            for (k, point) in self.points.iter().enumerate() {
                let x = R::read(&self.twice[0][first + k..]) - R::splat(point[0]);
                let y = R::read(&self.twice[1][first + k..]) - R::splat(point[1]);
                sum += x * x + y * y;
            }
            sum.put(&mut self.sums[first..]);
        }
    }
}
