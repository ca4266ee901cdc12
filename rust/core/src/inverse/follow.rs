//! Follows a position as values change: predicted by the Jacobian, corrected by Newton's iteration.

use super::motion::{Motion, Point};
use crate::math::inverse::invert;

/// Most corrections of a step; near its end each doubles the digits.
const CORRECTIONS: usize = 8;
/// A correction (in rad or sizes) that is the last: the error is about its square.
const SETTLED: f64 = 1.0e-9;
/// The first correction of a step is at most this part of its prediction, and so the slopes at its ends differ
/// little: the path between them has no fold.
const TRUST: f64 = 0.25;
/// A prediction at which rounding decides about the correction.
const TINY: f64 = 1.0e-7;
/// Greatest prediction, rad or sizes.
const LONGEST: f64 = 0.5;
/// The shortest step, as a part of the whole: half of the digits, which is all that a fold leaves.
const SHORTEST: f64 = 1.0e-9;
/// Most steps.
const MOST_STEPS: usize = 10_000;

/// Where following ended.
#[derive(Debug, Clone)]
pub(super) enum End {
    /// At the values.
    Reached(Point),
    /// Before them: at a fold, or where the assembly ends.
    Lost(Point),
}

impl Motion<'_> {
    /// Follows a position straight to values (rad or m). A link's angle goes the shorter way round, or the
    /// other one where that way ends.
    pub(super) fn arrive(&mut self, from: &Point, values: &[f64]) -> End {
        let targets = self.targets(values, from);
        let end = self.follow(from.clone(), &targets);
        if matches!(end, End::Reached(_)) {
            return end;
        }
        for other in self.other_way_round(&targets, from) {
            self.at(&from.q);
            let other_end = self.follow(from.clone(), &other);
            if matches!(other_end, End::Reached(_)) {
                return other_end;
            }
        }
        // Other positions are found from there.
        self.at(&from.q);
        end
    }

    /// Follows a position straight to other values.
    fn follow(&mut self, from: Point, to: &[f64]) -> End {
        let way: Vec<f64> = to.iter().zip(&from.values).map(|(to, from)| to - from).collect();
        let (mut here, mut done, mut step) = (from, 0.0, 1.0_f64);
        for _ in 0..MOST_STEPS {
            let length = step.min(1.0 - done);
            let is_last = done + length >= 1.0;
            let target: Vec<f64> = if is_last {
                to.to_vec()
            } else {
                to.iter().zip(&way).map(|(to, way)| to - way * (1.0 - done - length)).collect()
            };
            match self.step(&here, &target) {
                Some(next) if is_last => return End::Reached(next),
                Some(next) => {
                    (here, done, step) = (next, done + length, 2.0 * length);
                }
                None if length <= SHORTEST => return End::Lost(here),
                None => step = 0.5 * length,
            }
        }
        End::Lost(here)
    }

    /// A step to values near those of a position.
    fn step(&mut self, from: &Point, target: &[f64]) -> Option<Point> {
        let (first, sign) = from.newton(&self.missing(target, from))?;
        let predicted = size(&first);
        if predicted > LONGEST {
            return None;
        }
        let mut q = sum(&from.q, &first);
        let mut last = predicted;
        for round in 0..CORRECTIONS {
            let point = self.probe(&q)?;
            let (change, sign_there) = point.newton(&self.missing(target, &point))?;
            let corrected = size(&change);
            let limit = if round == 0 { TRUST * predicted } else { last };
            if sign_there != sign || corrected > limit.max(TINY) {
                return None;
            }
            q = sum(&q, &change);
            if corrected <= SETTLED {
                return self.at(&q);
            }
            last = corrected;
        }
        None
    }
}

impl Point {
    /// Newton's step by which the missing parts of values are reached, and the sign of the Jacobian's
    /// determinant; none where it is singular.
    fn newton(&self, missing: &[f64]) -> Option<(Vec<f64>, f64)> {
        let n = self.q.len();
        let mut matrix = vec![[0.0]; 2 * n * n];
        for (row, slopes) in matrix.chunks_exact_mut(2 * n).zip(self.jacobian.chunks_exact(n)) {
            for (entry, &slope) in row.iter_mut().zip(slopes) {
                entry[0] = slope;
            }
        }
        let [determinant] = invert(&mut matrix, n);
        let change = |row: usize| -> f64 {
            let inverse = &matrix[row * 2 * n + n..][..n];
            inverse.iter().zip(missing).map(|([entry], missing)| entry * missing).sum()
        };
        let step: Vec<f64> = (0..n).map(change).collect();
        let is_regular = determinant != 0.0 && step.iter().all(|change| change.is_finite());
        is_regular.then(|| (step, determinant.signum()))
    }
}

/// The greatest component.
pub(super) fn size(step: &[f64]) -> f64 {
    step.iter().fold(0.0, |most: f64, change| most.max(change.abs()))
}

fn sum(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a + b).collect()
}
