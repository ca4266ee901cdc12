//! Steps toward a boundary of the domain: a dead point, or a position where friction locks the machine.
//!
//! Bisection would find a boundary too, but the widths and the number of its steps are arbitrary. Here the
//! widths follow from the state.

use super::callbacks::Callbacks;
use super::error::RunError;
use super::model::{MAX_CONDITION, ReducedModel};
use super::stick_slip::Phase;
use super::system::RunSystem;
use super::variable::Variable;
use crate::ode::system::{Attempt, Fault, System};

/// A step toward a dead point leaves this part of the remaining time.
const STEP_LEAVES: f64 = 0.25;
/// The least inverse condition at which steps aim, a little inside the positions that are rejected; and
/// the part of it that is near enough. (With several drivers it ends the motion.)
const NEAREST: f64 = 1.1 / MAX_CONDITION;
const NEAR_ENOUGH: f64 = 0.9999;
/// Step back to find how a condition changes, as a part of its inverse square: that is about the
/// remaining coordinate in its unit.
const NEAR_PART: f64 = 1.0e-3;
/// Steps over a distance of less than this many tolerances are narrow.
const CREEPS: f64 = 16.0;
/// A step toward a position that friction locks leaves this part of the distance; the distance is known
/// to half of that part.
const LOCK_LEAVES: f64 = 0.02;
/// Most halvings of that distance: nearer to the lock the step itself is halved.
const LOCK_HALVINGS: u32 = 20;

impl<S: ReducedModel, O: Callbacks> RunSystem<'_, S, O> {
    /// Width of the next step toward a boundary ahead, 0 if it is reached.
    pub(super) fn aim_at_boundary(
        &mut self,
        x: f64,
        y: &[f64],
        last: Attempt,
    ) -> Result<Option<f64>, RunError<O::Error>> {
        let Attempt { h, refused, has_left_domain } = last;
        self.locks_ahead = refused.is_some() && (self.locks_ahead || self.equation.is_locked);
        if self.is_about_to_lock(x, y, h)? {
            return Ok(Some(0.0));
        }
        if !has_left_domain {
            return Ok(None);
        }
        if let (true, Some(refused)) = (self.locks_ahead, refused) {
            return self.aim_at_lock(x, y, refused - x);
        }
        if self.along == Variable::Coordinate || self.phase == Phase::Stick {
            return Ok(None);
        }
        let n = self.drivers;
        Ok(self.aim_at_dead_point(&y[..n], &y[n..2 * n]))
    }

    /// The inverse condition falls like the square root of the remaining coordinates, and so like the
    /// remaining time: the driver turns back at a dead point while the mechanism moves on.
    fn aim_at_dead_point(&mut self, q: &[f64], speed: &[f64]) -> Option<f64> {
        let beside = |t: f64| -> Vec<f64> { q.iter().zip(speed).map(|(q, v)| q + t * v).collect() };
        let here = self.equation.model.inverse_condition(q);
        let back = NEAR_PART * here * here / self.fastest(speed);
        let before = self.equation.model.inverse_condition(&beside(-back));
        let falls = (before - here) * (before + here) / back;
        let is_ahead = falls > 0.0 && falls.is_finite();
        if !is_ahead {
            return None;
        }
        let remaining = 2.0 * here * here / falls;
        let end = NEAREST / here;
        if end < NEAR_ENOUGH {
            let width = remaining * (1.0 - end.max(STEP_LEAVES));
            return Some(width);
        }
        let rejection = self.equation.model.dead_point_beside(q)?;
        self.equation.rejected = Some((rejection, q.to_vec()));
        Some(0.0)
    }

    /// Whether friction locks the machine within the tolerance of its coordinate, checked where a step
    /// moves it by little more than that. The acceleration grows without bound there, and the last steps
    /// would be rounding.
    fn is_about_to_lock(&mut self, x: f64, y: &[f64], h: f64) -> Result<bool, RunError<O::Error>> {
        let is_in_time = self.along == Variable::Time;
        let within = self.tolerance;
        let way = if is_in_time { y[1] * h } else { h };
        let is_slipping =
            matches!(self.phase, Phase::Slip(_)) && self.equation.model.has_friction();
        if !is_slipping || way == 0.0 || way.abs() > CREEPS * within {
            return Ok(false);
        }
        let (mut there, mut rates) = ([y[0], y[1], y[2]], [0.0; 3]);
        let ahead = within.copysign(way);
        if is_in_time {
            there[0] += ahead;
        }
        let x = if is_in_time { x } else { x + ahead };
        match self.rates(x, &there, &mut rates) {
            Err(Fault::Error(error)) => Err(error),
            // The run ends as locked.
            Err(Fault::OutOfDomain) => Ok(self.equation.is_locked),
            Ok(()) => Ok(false),
        }
    }

    /// Bisects the distance to a lock along the motion with the rates of this state; `most`: the distance
    /// to the rejected step. The motion itself is not singular there.
    fn aim_at_lock(
        &mut self,
        x: f64,
        y: &[f64],
        most: f64,
    ) -> Result<Option<f64>, RunError<O::Error>> {
        let mut rates = [[0.0; 3]; 2];
        let [rates_here, ahead] = &mut rates;
        match self.rates(x, y, rates_here) {
            Ok(()) => {}
            Err(Fault::OutOfDomain) => return Ok(None),
            Err(Fault::Error(error)) => return Err(error),
        }
        let is_in_time = self.along == Variable::Time;
        let [mut low, mut high] = [0.0, most];
        for _ in 0..LOCK_HALVINGS {
            // Backward both are negative.
            if high.abs() - low.abs() <= 0.5 * LOCK_LEAVES * high.abs() {
                break;
            }
            // It may take 40 ms to find that friction has no solution.
            if self.cancelled() {
                return Ok(None);
            }
            let middle = 0.5 * (low + high);
            let mut there: [f64; 3] = std::array::from_fn(|i| y[i] + middle * rates_here[i]);
            if is_in_time {
                there[0] += 0.5 * middle * middle * rates_here[1];
            }
            let bound = match self.rates(x + middle, &there, ahead) {
                Ok(()) => &mut low,
                Err(Fault::OutOfDomain) if self.equation.is_locked => &mut high,
                Err(Fault::OutOfDomain) => return Ok(None),
                Err(Fault::Error(error)) => return Err(error),
            };
            *bound = middle;
        }
        let is_on_the_way = high != most && low != 0.0;
        let width = (1.0 - LOCK_LEAVES) * low.abs();
        Ok(is_on_the_way.then_some(width))
    }
}
