//! The integrator: a method and its work space.

use super::dense::Interpolant;
use super::error::Error;
use super::event::Watch;
use super::options::{Method, Options};
use super::run::Run;
use super::solution::Solution;
use super::stages::{Block, Stages, blocks};
use super::system::System;

/// An integrator of systems of n equations, with all its work space. It can be used for any number
/// of runs, one after another.
#[derive(Debug)]
pub struct Integrator {
    pub(super) n: usize,
    pub(super) stages: Stages,
    pub(super) interpolant: Interpolant,
    pub(super) watch: Watch,
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
            watch: Watch::default(),
            y: zero.clone(),
            new: zero.clone(),
            state: zero.clone(),
            met: zero,
        }
    }

    /// Integrates from `t` with state `y` to `t_end`, which may be before `t`.
    ///
    /// How a run ended that was made but did not come to `t_end` is told by [`Solution::end`].
    ///
    /// # Errors
    ///
    /// [`Error`], if it cannot be begun, if rates are NaN or infinite, or if the system says so.
    pub fn run<S: System>(
        &mut self,
        system: &mut S,
        t: f64,
        y: &[f64],
        t_end: f64,
        options: &Options,
    ) -> Result<Solution, Error<S::Error>> {
        options.check(t, t_end, y, self.n)?;
        self.y.as_flattened_mut()[..self.n].copy_from_slice(y);
        self.stages.evaluations = 0;
        self.watch.reset(options.events);
        Run::new(self, system, (t, t_end), options).go()
    }
}
