//! Newton's iteration for the law of friction, and the path from no friction to full friction.

use nalgebra::DVector;

use super::problem::FrictionProblem;

/// Steps of the iteration. It converges to the second order between the kinks of the law.
const MAX_STEPS: usize = 50;
/// A step below this part of the friction is rounding.
const LAST_STEP: f64 = 1.0e-13;
/// The same for a step that does not become shorter, where friction is that sensitive.
const STALLED: f64 = 1.0e-4;
/// Steps as parts of the path: the first, the shortest and the longest.
const FIRST: f64 = 0.25;
const SHORTEST: f64 = 1.0e-9;
/// Most steps of the whole path, rejected ones included; a kink takes some 60. Where forces are so great that
/// the law drowns in their rounding, the path would otherwise go on in the shortest steps.
const MOST_STEPS: usize = 10_000;
/// Greatest distance of a step from a combination of both tangents, relative to the longer one.
const MOST_CORRECTION: f64 = 0.1;
/// Greatest turn of the tangent over a step, relative to the step, unless the step is this part of the
/// friction.
const MOST_TURN: f64 = 0.5;
const SHORT: f64 = 1.0e-3;

impl FrictionProblem<'_> {
    /// The solution near a start; `scale` multiplies all coefficients. `None` if the iteration does not
    /// converge.
    pub(super) fn newton(&self, start: &[f64], scale: f64) -> Option<Vec<f64>> {
        let mut friction = start.to_vec();
        let smallest = LAST_STEP * self.size();
        let mut last = f64::INFINITY;
        for _ in 0..MAX_STEPS {
            let residual = self.residual(&friction, scale);
            let step = self.jacobian(&friction, scale).lu().solve(&residual)?;
            let mut size = 0.0_f64;
            for (friction, step) in friction.iter_mut().zip(step.iter()) {
                *friction -= step;
                size = size.max(friction.abs());
            }
            let change = step.amax();
            if !change.is_finite() {
                return None;
            }
            if change <= smallest.max(LAST_STEP * size) {
                return Some(friction);
            }
            // Near locking, rounding keeps steps from becoming shorter; the law is still met.
            if change >= last && change <= STALLED * size {
                let missed = self.residual(&friction, scale).amax();
                return (missed <= LAST_STEP * (size + self.size())).then_some(friction);
            }
            last = change;
        }
        None
    }

    /// The only solution of a contraction.
    pub(super) fn only(&self) -> Option<Vec<f64>> {
        let start = vec![0.0; self.pairs.len()];
        self.newton(&start, 1.0).or_else(|| {
            // Newton's iteration may go back and forth across a kink; this iteration cannot.
            let mut friction = start;
            for _ in 0..100_000 {
                let residual = self.residual(&friction, 1.0);
                for (friction, residual) in friction.iter_mut().zip(residual.iter()) {
                    *friction -= residual;
                }
                if residual.amax() <= LAST_STEP * self.size() {
                    return Some(friction);
                }
            }
            None
        })
    }

    /// Follows the solution from no friction while all coefficients grow to `goal` times their values.
    /// Returns the end of the path, and the solution there.
    pub(super) fn follow(&self, goal: f64) -> (f64, Vec<f64>) {
        let mut friction = vec![0.0; self.pairs.len()];
        let (mut at, mut step) = (0.0, FIRST);
        for _ in 0..MOST_STEPS {
            if at >= goal || self.is_cancelled() {
                break;
            }
            let next = (at + step).min(goal);
            match self.advance(&friction, at, next) {
                Some(solution) => {
                    friction = solution;
                    at = next;
                    step *= 2.0;
                }
                None if step > SHORTEST => step *= 0.5,
                None => break,
            }
        }
        (at, friction)
    }

    /// A step of the path: along the tangent, then corrected.
    ///
    /// Between the kinks of the law the path is smooth, and at a kink its direction changes at once. So the
    /// step must be nearly a combination of both tangents. The determinant is 1 without friction and 0 where
    /// the path turns back: it is positive on the path, but not on the branch behind. At a kink it may jump
    /// from one sign to the other: there the path turns back, though the law is not singular, and only a short
    /// step shows this.
    fn advance(&self, from: &[f64], at: f64, next: f64) -> Option<Vec<f64>> {
        let (first, _) = self.tangent(from, at, next - at)?;
        let start: Vec<f64> = from.iter().zip(first.iter()).map(|(a, b)| a + b).collect();
        let solution = self.newton(&start, next)?;
        let (second, determinant) = self.tangent(&solution, next, next - at)?;
        let way = DVector::from_fn(from.len(), |row, _| solution[row] - from[row]);
        let (turn, rest) = (&first - &second, &way - &second);
        let part = (rest.dot(&turn) / turn.norm_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        let missed = (rest - &turn * part).amax();
        let limit = MOST_CORRECTION * first.amax().max(second.amax());
        let is_near = missed <= limit.max(1e-9 * self.size());
        // A long step that turns so far may have jumped to another path.
        let is_smooth = turn.amax() <= MOST_TURN * first.amax().max(second.amax());
        let greatest = from.iter().fold(self.size(), |most, friction| most.max(friction.abs()));
        let is_short = way.amax() <= SHORT * greatest;
        // Between the same faces it may have crossed another one; then one of its tangents shows it.
        let back: Vec<f64> = solution.iter().zip(second.iter()).map(|(a, b)| a - b).collect();
        let is_smooth =
            is_smooth && [&start, &solution, &back].iter().all(|at| self.is_same_face(from, at));
        (is_near && (is_smooth || is_short) && determinant > 0.0).then_some(solution)
    }

    /// The step along the tangent while the coefficients grow by `growth`, and the determinant of the law
    /// there.
    fn tangent(&self, friction: &[f64], scale: f64, growth: f64) -> Option<(DVector<f64>, f64)> {
        // ∂(residual)/∂(scale) equals the friction without feedback.
        let rate = (self.residual(friction, 1.0) - self.residual(friction, 0.0)) * -growth;
        let factors = self.jacobian(friction, scale).lu();
        Some((factors.solve(&rate)?, factors.determinant()))
    }
}
