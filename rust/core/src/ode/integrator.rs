//! The integrator: a method and its workspace.

use super::event::EventTracker;
use super::options::Method;
use super::pair::dense::{DenseOutput, Interpolant};
use super::pair::stages::{Block, Stages, blocks};

/// An integrator of systems of n equations, with its workspace. It can be reused for any number of
/// runs.
#[derive(Debug)]
pub struct Integrator {
    pub(super) n: usize,
    pub(super) stages: Stages,
    pub(super) interpolant: Interpolant,
    pub(super) tracker: EventTracker,
    /// The state of the run.
    pub(super) y: Vec<Block>,
    /// The state at the end of the attempted step.
    pub(super) new: Vec<Block>,
    /// The state at an event, after and before its change by [`super::System::on_event`].
    pub(super) state: Vec<Block>,
    pub(super) event_state: Vec<Block>,
    /// The rates there.
    pub(super) event_rates: Vec<f64>,
    /// Room for the steps of the next run.
    pub(super) spare: DenseOutput,
}

impl Integrator {
    /// Creates an integrator for a method and a number of equations.
    pub fn new(method: Method, n: usize) -> Self {
        let stages = Stages::new(method.tableau(), n);
        let interpolant = Interpolant::new(&stages, n);
        let zero = vec![Block::default(); blocks(n)];
        Self {
            n,
            stages,
            interpolant,
            tracker: EventTracker::default(),
            y: zero.clone(),
            new: zero.clone(),
            state: zero.clone(),
            event_state: zero,
            event_rates: vec![0.0; n],
            spare: DenseOutput::default(),
        }
    }
}
