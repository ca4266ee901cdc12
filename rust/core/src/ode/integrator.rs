//! The integrator: a method and its work space.

use super::dense::Interpolant;
use super::event::EventTracker;
use super::options::Method;
use super::stages::{Block, Stages, blocks};

/// An integrator of systems of n equations, with all its work space. It can be used for any number
/// of runs, one after another.
#[derive(Debug)]
pub struct Integrator {
    pub(super) n: usize,
    pub(super) stages: Stages,
    pub(super) interpolant: Interpolant,
    pub(super) watch: EventTracker,
    /// The state of the run.
    pub(super) y: Vec<Block>,
    /// The state at the end of the step tried.
    pub(super) new: Vec<Block>,
    /// The states at an event: what is made of it, and as it was met.
    pub(super) state: Vec<Block>,
    pub(super) met: Vec<Block>,
}

impl Integrator {
    /// For a method and a number of equations.
    pub fn new(method: Method, n: usize) -> Self {
        let stages = Stages::new(method.tableau(), n);
        let interpolant = Interpolant::new(&stages, n);
        let zero = vec![Block::default(); blocks(n)];
        Self {
            n,
            stages,
            interpolant,
            watch: EventTracker::default(),
            y: zero.clone(),
            new: zero.clone(),
            state: zero.clone(),
            met: zero,
        }
    }
}
