//! Obstacles, which throw a machine back.

use super::callbacks::Callbacks;
use super::error::RunError;
use super::model::ReducedModel;
use super::stick_slip::Phase;
use super::system::RunSystem;
use crate::ode::system::{Action, Fault, System};

/// A hit with less than this part of the speed of the hardest one leaves the machine at the obstacle: the
/// next way there and back would be shorter than steps are.
const STAYS: f64 = 1.0e-3;
/// The same for a rebound by less than this many tolerances of the coordinate.
const LEAST_REBOUND: f64 = 1.0e4;

impl<S: ReducedModel, O: Callbacks> RunSystem<'_, S, O> {
    /// Throws the machine back from an obstacle; ends the run where it stays there.
    pub(super) fn rebound(
        &mut self,
        restitution: f64,
        t: f64,
        y: &mut [f64],
    ) -> Result<Action, RunError<O::Error>> {
        let before = y[1];
        if before.abs() <= STAYS * self.hardest_hit {
            return Ok(Action::Stop);
        }
        self.hardest_hit = self.hardest_hit.max(before.abs());
        let lost = match self.equation.set_configuration(&y[..1]) {
            Ok(()) => {
                let reduced = &self.equation.reduced;
                reduced.kinetic(&[before]) - reduced.kinetic(&[restitution * before])
            }
            Err(Fault::OutOfDomain) => 0.0,
            Err(Fault::Error(error)) => return Err(error),
        };
        y[1] = -restitution * before;
        y[2] -= lost;
        if restitution == 0.0 {
            return Ok(Action::Stop);
        }
        if self.phase != Phase::Smooth {
            self.phase = self.equation.first_phase(t, y[0], y[1])?;
        }
        let mut rates = [0.0; 3];
        if let Err(Fault::Error(error)) = self.rates(t, y, &mut rates) {
            return Err(error);
        }
        // The way before it turns back to the obstacle, if it does.
        let way = y[1] * y[1] / (2.0 * rates[1].abs());
        let turns_back = rates[1] * y[1] < 0.0;
        let smallest_way = LEAST_REBOUND * self.tolerance;
        Ok(if turns_back && way < smallest_way { Action::Stop } else { Action::Restart })
    }
}
