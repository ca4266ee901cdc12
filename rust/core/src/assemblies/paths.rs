//! Follows solutions of a system along its path, one in each lane: steps by Runge and Kutta's method
//! of fourth order, corrected by Newton's (A. J. Sommese and C. W. Wampler, *The Numerical Solution of
//! Systems of Polynomials*, 2005, ch. 2).

use super::homotopy::Homotopy;
use super::linear::{select, solve};
use crate::batch::dispatch::Task;
use crate::math::lanes::{Mask, Real};
use crate::math::vector::Vector;

/// The first step, and the shortest.
const FIRST: f64 = 0.0625;
const SHORTEST: f64 = 1.0e-13;
/// Newton's corrections of a step.
const CORRECTIONS: usize = 3;
/// The next step aims at this part of the greatest first correction; the limits of its change.
const AIM: f64 = 0.2;
const LEAST_CHANGE: f64 = 0.2;
const MOST_CHANGE: f64 = 3.0;
/// The last correction of a step, relative to the solution: the error is about its square.
const LAST_CORRECTION: f64 = 1.0e-6;
/// Most steps of a path.
const MAX_STEPS: usize = 5000;

/// How near solutions stay to their predictions: the first correction of a step, relative to the
/// solution. A tight bound keeps a path from jumping to another.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tightness(pub f64);

impl Tightness {
    /// As a rule.
    pub(super) const LOOSE: Self = Self(1.0e-3);
    /// Where a path jumped to another with loose steps.
    pub(super) const TIGHT: Self = Self(1.0e-6);
}

/// One solution in each lane, on its way.
pub(super) struct Paths<'h, R: Real> {
    homotopy: &'h Homotopy,
    tightness: Tightness,
    /// Components of x, then of y.
    pub point: Vec<Vector<R>>,
    /// The progress of each.
    pub at: R,
    /// Where paths end.
    pub end: f64,
    size: usize,
    matrix: Vec<Vector<R>>,
    trial: Vec<Vector<R>>,
    sum: Vec<Vector<R>>,
    /// X and Y with their constant.
    full: [Vec<Vector<R>>; 2],
    gradient: [Vec<Vector<R>>; 2],
}

impl<'h, R: Real> Paths<'h, R> {
    pub(super) fn new(homotopy: &'h Homotopy, tightness: Tightness, end: f64) -> Self {
        let n = homotopy.variables;
        let size = 2 * n;
        let full = vec![Vector::ONE; n + 1];
        Self {
            homotopy,
            tightness,
            point: vec![Vector::ZERO; size],
            at: R::ZERO,
            end,
            size,
            matrix: vec![Vector::ZERO; size * (size + 1)],
            trial: vec![Vector::ZERO; size],
            sum: vec![Vector::ZERO; size],
            full: [full.clone(), full],
            gradient: [vec![Vector::ZERO; n + 1], vec![Vector::ZERO; n + 1]],
        }
    }

    /// The equations linear at the trial point; on the right their rates along the path, or their
    /// values.
    #[inline(always)]
    fn linearise(&mut self, s: R, rates: bool) {
        let (n, size) = (self.homotopy.variables, self.size);
        let width = size + 1;
        for i in 0..n {
            self.full[0][i + 1] = self.trial[i];
            self.full[1][i + 1] = self.trial[n + i];
        }
        let [x, y] = &self.full;
        let [to_x, to_y] = &mut self.gradient;
        let twice = s + s;
        for (k, form) in self.homotopy.forms.iter().enumerate() {
            to_x.fill(Vector::ZERO);
            to_y.fill(Vector::ZERO);
            let mut rate = Vector::ZERO;
            for entry in form {
                let [a, b, c] = on_lanes(entry.factor);
                let factor = a + (b + c.scale(s)).scale(s);
                let (x, y) = (x[entry.row], y[entry.column]);
                to_x[entry.row] += factor * y;
                to_y[entry.column] += factor * x;
                if rates {
                    rate += (b + c.scale(twice)) * (x * y);
                }
            }
            let row = &mut self.matrix[k * width..][..width];
            row[..n].copy_from_slice(&to_x[1..]);
            row[n..size].copy_from_slice(&to_y[1..]);
            row[size] = rate;
            if !rates {
                let mut value = Vector::ZERO;
                for (x, to_x) in x.iter().zip(to_x.iter()) {
                    value += *x * *to_x;
                }
                row[size] = value;
            }
        }
        let mut k = self.homotopy.forms.len();
        for side in 0..2 {
            for factors in &self.homotopy.rows[side] {
                let row = &mut self.matrix[k * width..][..width];
                row.fill(Vector::ZERO);
                let mut right = Vector::ZERO;
                for (i, factor) in factors.iter().enumerate() {
                    let [a, b, c] = on_lanes(*factor);
                    let value = a + (b + c.scale(s)).scale(s);
                    if i > 0 {
                        row[side * n + i - 1] = value;
                    }
                    let coefficient = if rates { b + c.scale(twice) } else { value };
                    right += coefficient * self.full[side][i];
                }
                row[size] = right;
                k += 1;
            }
        }
        solve(&mut self.matrix, size);
    }

    /// The solution of the linear equations.
    #[inline(always)]
    fn solved(&self, i: usize) -> Vector<R> {
        self.matrix[i * (self.size + 1) + self.size]
    }

    /// A Newton step of the trial point in some lanes; returns its size relative to the point.
    #[inline(always)]
    fn correct(&mut self, s: R, lanes: R::Mask) -> R {
        self.linearise(s, false);
        let (mut step2, mut size2) = (R::ZERO, R::ONE);
        for i in 0..self.size {
            let step = self.solved(i);
            step2 += step.norm2();
            size2 += self.trial[i].norm2();
            self.trial[i] = select(lanes, self.trial[i] - step, self.trial[i]);
        }
        (step2 / size2).sqrt()
    }

    /// Newton's iteration at the end of the path; returns the size of the last step.
    #[inline(always)]
    pub(super) fn refine(&mut self, rounds: usize) -> R {
        self.trial.copy_from_slice(&self.point);
        let mut last = R::ZERO;
        for _ in 0..rounds {
            last = self.correct(R::splat(self.end), R::Mask::NONE.not());
        }
        self.point.copy_from_slice(&self.trial);
        last
    }

    /// A step of fourth order from the point to the trial point.
    #[inline(always)]
    fn predict(&mut self, s: R, step: R) {
        let half = R::splat(0.5) * step;
        let sixth = step / R::splat(6.0);
        self.trial.copy_from_slice(&self.point);
        self.sum.copy_from_slice(&self.point);
        for (at, weight, ahead) in [
            (s, sixth, half),
            (s + half, sixth + sixth, half),
            (s + half, sixth + sixth, step),
            (s + step, sixth, R::ZERO),
        ] {
            self.linearise(at, true);
            for i in 0..self.size {
                let rate = self.solved(i);
                self.sum[i] = self.sum[i] - rate.scale(weight);
                self.trial[i] = self.point[i] - rate.scale(ahead);
            }
        }
        self.trial.copy_from_slice(&self.sum);
    }
}

impl<R: Real> Task<R> for Paths<'_, R> {
    #[inline(always)]
    fn run(&mut self) {
        let end = R::splat(self.end);
        let mut step = R::splat(FIRST);
        for _ in 0..MAX_STEPS {
            let rest = end - self.at;
            let is_last = rest.le(step);
            let length = R::select(is_last, rest, step);
            let active = R::ZERO.lt(rest).and(R::splat(SHORTEST).lt(step));
            if !active.any() {
                break;
            }
            let next = R::select(is_last, end, self.at + length);
            self.predict(self.at, length);
            let first = self.correct(next, active);
            let mut good = active.and(first.le(R::splat(self.tightness.0)));
            let mut last = first;
            for _ in 1..CORRECTIONS {
                let open = good.and(last.le(R::splat(LAST_CORRECTION)).not());
                if !open.any() {
                    break;
                }
                last = R::select(open, self.correct(next, open), last);
            }
            good = good.and(last.le(R::splat(LAST_CORRECTION)));
            for (point, trial) in self.point.iter_mut().zip(&self.trial) {
                *point = select(good, *trial, *point);
            }
            self.at = R::select(good, next, self.at);
            // The error is of fifth order in the step; the fourth root is on the safe side.
            let ratio = R::splat(AIM * self.tightness.0) / first;
            let change = ratio.sqrt().sqrt().max(R::splat(LEAST_CHANGE)).min(R::splat(MOST_CHANGE));
            let safe = R::select(good, change, change.min(R::splat(0.5)));
            step = R::select(active, safe * length, step);
        }
    }
}

/// The same factor on every lane. (Through `map` it would not be compiled with the level's
/// instructions.)
#[inline(always)]
fn on_lanes<R: Real>([a, b, c]: [Vector; 3]) -> [Vector<R>; 3] {
    [Vector::splat(a), Vector::splat(b), Vector::splat(c)]
}
