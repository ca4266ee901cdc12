//! A fit, compiled: what is asked of the solver for a block of designs.

use std::f64::consts::TAU;
use std::num::NonZeroUsize;
use std::ops::{Deref, Range};

use super::conditions::FitCondition;
use super::point::Point;
use super::target::{FitTarget, Timing};
use super::variables::{Variable, Variables};
use crate::batch::helpers::available_threads;
use crate::batch::request::{Motion, Outputs, Quantity, Series};
use crate::math::simd::Simd;
use crate::plan::mechanism::Mechanism;
use crate::state::status::Status;

/// Positions of the turn of which a curve is made: eight registers of eight lanes.
pub(super) const TRAVEL_POSITIONS: usize = 64;

/// The positions over which a design must move.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Travel {
    /// The whole turn of the driver.
    WholeTurn,
    /// From the first position of its targets to the last.
    Between,
}

/// A fit of a mechanism.
#[derive(Debug)]
pub struct FitRequest {
    /// Its dimensions where all variables are 0.
    pub base: Vec<f64>,
    /// What may change.
    pub variables: Vec<Variable>,
    /// What it is to do.
    pub targets: Vec<FitTarget>,
    /// What metrics of its travel are to be.
    pub conditions: Vec<FitCondition>,
    /// The assemblies it may have: signs, as a [`Request`](crate::Request) has them.
    pub assemblies: Vec<Vec<i8>>,
    /// Where it must move.
    pub travel: Travel,
    /// Results differ with it.
    pub seed: u64,
    /// The most threads; `None` means one per core.
    pub threads: Option<NonZeroUsize>,
    /// Level of vector instructions.
    pub simd: Simd,
}

/// A request, compiled.
#[derive(Debug)]
pub(super) struct Compiled {
    pub variables: Variables,
    pub targets: Vec<FitTarget>,
    pub assemblies: Vec<Vec<i8>>,
    pub travel: Travel,
    pub conditions: Vec<FitCondition>,
    /// The sum of squares of what targets ask for, from their means.
    pub size: f64,
    /// Bounds of all numbers of a point.
    pub bounds: Vec<[f64; 2]>,
    /// The quantities that targets read.
    pub quantities: Vec<(Quantity, usize)>,
    pub outputs: Outputs,
    pub seed: u64,
    pub threads: NonZeroUsize,
    pub simd: Simd,
}

/// A mechanism with what it is to do.
#[derive(Debug, Clone, Copy)]
pub(super) struct Problem<'p> {
    pub mechanism: &'p Mechanism,
    compiled: &'p Compiled,
}

impl Deref for Problem<'_> {
    type Target = Compiled;

    fn deref(&self) -> &Compiled {
        self.compiled
    }
}

impl Compiled {
    pub(super) fn new(request: FitRequest) -> Self {
        let FitRequest { base, variables, targets, conditions, assemblies, travel, .. } = request;
        let variables = Variables::new(base, variables);
        let mut bounds: Vec<[f64; 2]> = variables.each.iter().map(|one| one.bounds).collect();
        let mut quantities = vec![];
        for target in &targets {
            bounds.extend(target.neutral().iter().map(|_| [f64::NEG_INFINITY, f64::INFINITY]));
            for number in &target.numbers {
                if !quantities.contains(&(number.quantity, 0)) {
                    quantities.push((number.quantity, 0));
                }
            }
        }
        let outputs = outputs(quantities.iter().map(|&(quantity, _)| quantity));
        let threads = request.threads.or_else(|| NonZeroUsize::new(available_threads()));
        let size: f64 = targets.iter().map(FitTarget::size).sum();
        Self {
            variables,
            conditions,
            size: if size > 0.0 { size } else { 1.0 },
            targets,
            assemblies,
            travel,
            bounds,
            quantities,
            outputs,
            seed: request.seed,
            threads: threads.unwrap_or(NonZeroUsize::MIN),
            simd: request.simd,
        }
    }

    pub(super) fn of<'p>(&'p self, mechanism: &'p Mechanism) -> Problem<'p> {
        Problem { mechanism, compiled: self }
    }

    /// Positions of all targets.
    pub(super) fn positions(&self) -> usize {
        self.targets.iter().map(FitTarget::len).sum()
    }

    /// For each target its positions among all, and its own numbers in a point.
    pub(super) fn parts(&self) -> impl Iterator<Item = (&FitTarget, Range<usize>, usize)> {
        let (mut first, mut extra) = (0, self.variables.len());
        self.targets.iter().map(move |target| {
            let part = (target, first..first + target.len(), extra);
            first += target.len();
            extra += target.extra();
            part
        })
    }

    /// Sets the coordinates that follow from a point's numbers.
    pub(super) fn set_timing(&self, point: &mut Point) {
        for (target, positions, extra) in self.parts() {
            let (given, phase) = match &target.timing {
                Timing::Fixed(q) => (q, 0.0),
                Timing::Phase(q) => (q, point.x[extra]),
                Timing::Free { .. } => continue,
            };
            for (q, given) in point.q[positions].iter_mut().zip(given) {
                *q = given + phase;
            }
        }
    }
}

/// Positions of a turn.
pub(super) fn turn(count: usize) -> Vec<f64> {
    (0..count).map(|k| TAU * k as f64 / count as f64).collect()
}

/// Positions from the least coordinate to the greatest.
pub(super) fn between(q: &[f64], count: usize) -> Vec<f64> {
    let low = q.iter().copied().fold(f64::INFINITY, f64::min);
    let high = q.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    (0..count).map(|k| low + (high - low) * k as f64 / (count - 1) as f64).collect()
}

/// Whether a position is solved with its analogues.
pub(super) fn is_solved(status: u8) -> bool {
    status <= Status::NearSingular as u8
}

fn outputs(quantities: impl Iterator<Item = Quantity>) -> Outputs {
    let mut outputs = Outputs::default();
    for quantity in quantities {
        match quantity {
            Quantity::Joint(index) => outputs.joints.push(index),
            Quantity::Origin(index) => outputs.origins.push(index),
            Quantity::Slide(index) => outputs.slides.push(index),
            Quantity::Angle(index) => outputs.links.push(index),
            Quantity::Direction(index) => outputs.directions.push(index),
        }
    }
    outputs
}

/// The series of a quantity in a motion.
pub(super) fn series(motion: &Motion, quantity: Quantity) -> Option<&Series> {
    let (list, index) = match quantity {
        Quantity::Joint(index) => (&motion.joints, index),
        Quantity::Origin(index) => (&motion.origins, index),
        Quantity::Slide(index) => (&motion.slides, index),
        Quantity::Angle(index) => (&motion.links, index),
        Quantity::Direction(index) => (&motion.directions, index),
    };
    list.iter().find(|series| series.index == index)
}
