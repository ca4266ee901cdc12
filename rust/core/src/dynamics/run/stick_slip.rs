//! Stick and slip: a machine with friction, or with loads that act in one sense of its motion, moves in
//! one sense, or rests while they hold it.

use super::callbacks::Callbacks;
use super::equation::Equation;
use super::error::RunError;
use super::model::ReducedModel;
use crate::dynamics::friction::motion::SlidingState;
use crate::ode::system::Fault;

/// How a machine with friction moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Phase {
    /// It has neither friction nor loads that depend on the sense of the motion.
    Smooth,
    /// It slides in this sense, +1 or −1.
    Slip(f64),
    /// It rests.
    Stick,
}

/// A change of the phase.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Change {
    /// Friction holds it.
    Stick,
    /// It begins to slide.
    Slip,
    /// It reverses without a rest.
    Turn,
}

impl<S: ReducedModel, O: Callbacks> Equation<'_, S, O> {
    /// The accelerations with which friction would let it begin to slide forward and backward from rest:
    /// infinite the other way where it locks.
    fn accelerations_from_rest(
        &mut self,
        t: f64,
        q: f64,
    ) -> Result<[f64; 2], Fault<RunError<O::Error>>> {
        self.turn_to(q, 1.0);
        self.set_configuration(&[q])?;
        self.apply_loads(t, &[q], &[0.0])?;
        let mut both = [f64::NEG_INFINITY, f64::INFINITY];
        for (acceleration_from_rest, sense) in both.iter_mut().zip([1.0, -1.0]) {
            if sense < 0.0 && self.model.has_stations() {
                self.turn_to(q, sense);
                self.set_configuration(&[q])?;
                self.apply_loads(t, &[q], &[0.0])?;
            }
            let state = SlidingState { speed: 0.0, sense, is_static: true };
            match self.accelerate_with_friction(q, state) {
                Ok(acceleration) => *acceleration_from_rest = acceleration,
                Err(Fault::OutOfDomain) if self.is_locked => {}
                Err(fault) => return Err(fault),
            }
        }
        self.is_locked = false;
        self.friction = 0.0;
        Ok(both)
    }

    /// The margin by which the loads exceed the friction that holds the machine at rest; below 0 it stays at
    /// rest.
    pub(crate) fn slip_margin(&mut self, t: f64, q: f64) -> Result<f64, RunError<O::Error>> {
        match self.accelerations_from_rest(t, q) {
            Ok([forward, backward]) => Ok(forward.max(-backward)),
            Err(Fault::OutOfDomain) => Ok(f64::NAN),
            Err(Fault::Error(error)) => Err(error),
        }
    }

    /// The phase that begins at rest.
    pub(crate) fn phase_from_rest(&mut self, t: f64, q: f64) -> Result<Phase, RunError<O::Error>> {
        Ok(match self.accelerations_from_rest(t, q) {
            // Where it could start in both senses friction is negligible: the loads decide.
            Ok([forward, backward]) if forward > 0.0 && forward >= -backward => Phase::Slip(1.0),
            Ok([_, backward]) if backward < 0.0 => Phase::Slip(-1.0),
            Ok(_) => Phase::Stick,
            Err(Fault::OutOfDomain) => Phase::Slip(1.0),
            Err(Fault::Error(error)) => return Err(error),
        })
    }

    /// The phase at the start of a run.
    pub(crate) fn first_phase(
        &mut self,
        t: f64,
        q: f64,
        speed: f64,
    ) -> Result<Phase, RunError<O::Error>> {
        if !self.model.has_friction() && !self.model.has_ways() {
            return Ok(Phase::Smooth);
        }
        let phase =
            if speed == 0.0 { self.phase_from_rest(t, q)? } else { Phase::Slip(speed.signum()) };
        let Phase::Slip(sense) = phase else { return Ok(phase) };
        self.turn_to(q, sense);
        let state = SlidingState { speed, sense, is_static: false };
        let begun = self
            .set_configuration(&[q])
            .and_then(|()| self.apply_loads(t, &[q], &[speed]))
            .and_then(|()| self.accelerate_with_friction(q, state));
        match begun {
            Err(Fault::OutOfDomain) if self.is_locked => Err(RunError::Locked { q }),
            Err(Fault::OutOfDomain) => Err(self.no_initial_position(&[q])),
            Err(Fault::Error(error)) => Err(error),
            Ok(_) => Ok(phase),
        }
    }

    /// The phase that follows another, at rest after a slip, or as friction no longer holds; and the change.
    pub(crate) fn next_phase(
        &mut self,
        before: Phase,
        t: f64,
        q: f64,
    ) -> Result<(Phase, Change), RunError<O::Error>> {
        let phase = match before {
            // The event is where the margin is zero, to rounding: it slides on.
            Phase::Stick => match self.accelerations_from_rest(t, q) {
                Ok([forward, backward]) => {
                    Phase::Slip(if forward >= -backward { 1.0 } else { -1.0 })
                }
                Err(Fault::Error(error)) => return Err(error),
                Err(Fault::OutOfDomain) => Phase::Slip(1.0),
            },
            _ => self.phase_from_rest(t, q)?,
        };
        if let Phase::Slip(sense) = phase {
            self.turn_to(q, sense);
        }
        let change = match (before, phase) {
            (_, Phase::Stick) => Change::Stick,
            (Phase::Stick, _) => Change::Slip,
            _ => Change::Turn,
        };
        Ok((phase, change))
    }
}
