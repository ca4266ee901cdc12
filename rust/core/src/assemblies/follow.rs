//! Follows many solutions at once, a register of them at a time, at the processor's best level.

use super::homotopy::Homotopy;
use super::paths::{Paths, Tightness};
use crate::batch::dispatch::{Entry, ForLevel, Task, at_level};
use crate::math::lanes::Real;
use crate::math::simd::Simd;
use crate::math::vector::Vector;

/// Where paths ended.
pub(super) struct Ends {
    pub points: Vec<Vec<Vector>>,
    /// How far each path came.
    pub at: Vec<f64>,
    /// The last Newton step, if points were refined.
    pub last: Vec<f64>,
}

/// Follows solutions at s = 0 to `end`.
pub(super) fn follow(
    homotopy: &Homotopy,
    starts: &[Vec<Vector>],
    tightness: Tightness,
    end: f64,
    simd: Simd,
) -> Ends {
    at_level(simd, Follow { homotopy, starts, tightness, end, rounds: 0 })
}

/// Newton's iteration at s = 1.
pub(super) fn refine(homotopy: &Homotopy, points: &[Vec<Vector>], rounds: usize) -> Ends {
    let tightness = Tightness::LOOSE;
    at_level(Simd::default(), Follow { homotopy, starts: points, tightness, end: 1.0, rounds })
}

struct Follow<'f> {
    homotopy: &'f Homotopy,
    starts: &'f [Vec<Vector>],
    tightness: Tightness,
    end: f64,
    /// Rounds of Newton's iteration at the end, in place of the way there; 0: follow it.
    rounds: usize,
}

/// Newton's iteration as a task.
struct Refine<'p, 'h, R: Real> {
    paths: &'p mut Paths<'h, R>,
    rounds: usize,
    last: R,
}

impl<R: Real> Task<R> for Refine<'_, '_, R> {
    #[inline(always)]
    fn run(&mut self) {
        self.last = self.paths.refine(self.rounds);
    }
}

impl ForLevel for Follow<'_> {
    type Output = Ends;

    fn run<L: Entry, const G: usize>(self) -> Ends {
        let lanes = L::Register::LANES;
        let mut ends = Ends { points: Vec::new(), at: Vec::new(), last: Vec::new() };
        for block in self.starts.chunks(lanes) {
            let mut paths: Paths<'_, L::Register> =
                Paths::new(self.homotopy, self.tightness, self.end);
            // Lanes beyond the last path repeat it.
            let start_of = |lane: usize| &block[lane.min(block.len() - 1)];
            for (i, component) in paths.point.iter_mut().enumerate() {
                *component = Vector::new(
                    Real::from_lanes(|lane| start_of(lane)[i].x),
                    Real::from_lanes(|lane| start_of(lane)[i].y),
                );
            }
            let mut last = L::Register::ZERO;
            if self.rounds == 0 {
                L::call(&mut paths);
            } else {
                let mut task = Refine { paths: &mut paths, rounds: self.rounds, last };
                L::call(&mut task);
                last = task.last;
            }
            for lane in 0..block.len() {
                let component =
                    |x: &Vector<L::Register>| Vector::new(x.x.lane(lane), x.y.lane(lane));
                ends.points.push(paths.point.iter().map(component).collect());
                ends.at.push(paths.at.lane(lane));
                ends.last.push(last.lane(lane));
            }
        }
        ends
    }
}
