//! The arithmetic of one step.
//!
//! Components are stored in blocks of four, so that sums over stages use vector instructions for
//! any number of equations. The unused components of the last block are zero and stay zero.

use super::estimate::{Estimate, in_tolerances};
use super::tableau::{Row, Tableau};
use crate::ode::system::{Fault, System};

/// Components of a block: two SSE2 registers, or one of AVX2.
const LANES: usize = 4;

/// Four components of a state.
pub(in crate::ode) type Block = [f64; LANES];

/// Number of blocks that hold `n` components.
pub(in crate::ode) fn blocks(n: usize) -> usize {
    n.div_ceil(LANES)
}

/// Why a step could not be evaluated.
#[derive(Debug)]
pub(in crate::ode) enum Refusal<E> {
    /// A stage is outside the domain.
    OutOfDomain,
    /// Rates at a stage are NaN or infinite.
    NotFinite { t: f64, component: usize },
    /// An error of the system that ends the run.
    System(E),
}

/// Tolerances of all components.
#[derive(Debug)]
pub(in crate::ode) struct Scale {
    relative: Vec<Block>,
    absolute: Vec<Block>,
    /// The size of a typical state in tolerances if they are relative; 0 if not. A state that begins at zero
    /// does not show it.
    pub usual_size: f64,
}

impl Scale {
    /// One tolerance for each component, or one for all.
    pub(in crate::ode) fn new(relative: &[f64], absolute: &[f64], n: usize) -> Self {
        let to_blocks = |list: &[f64]| {
            let mut tolerances = vec![[1.0; LANES]; blocks(n)];
            let all = tolerances.as_flattened_mut().iter_mut();
            all.zip(list.iter().cycle().take(n)).for_each(|(to, from)| *to = *from);
            tolerances
        };
        let greatest = relative.iter().fold(0.0_f64, |most, &part| most.max(part));
        let usual_size = if greatest > 0.0 { 1.0 / greatest } else { 0.0 };
        Self { relative: to_blocks(relative), absolute: to_blocks(absolute), usual_size }
    }

    /// The absolute and the relative tolerance of a component.
    pub(in crate::ode) fn of(&self, component: usize) -> [f64; 2] {
        [&self.absolute, &self.relative].map(|list| list.as_flattened()[component])
    }

    /// Σ (eᵢ / (aᵢ + rᵢ max(|yᵢ|, |zᵢ|)))² (Hairer, Nørsett & Wanner I, eq. II.4.10 and 4.11).
    pub(in crate::ode) fn square_sum(&self, e: &[Block], y: &[Block], z: &[Block]) -> f64 {
        let mut total = 0.0;
        let tolerances = self.absolute.iter().zip(&self.relative);
        for (((e, (a, r)), y), z) in e.iter().zip(tolerances).zip(y).zip(z) {
            for l in 0..LANES {
                let ratio = in_tolerances(e[l], [a[l], r[l]], y[l], z[l]);
                total += ratio * ratio;
            }
        }
        total
    }
}

/// The stages of a step.
#[derive(Debug)]
pub(in crate::ode) struct Stages {
    pub tableau: &'static Tableau,
    n: usize,
    blocks: usize,
    /// Rates at all stages.
    k: Vec<Block>,
    /// The state at the stage evaluated last.
    argument: Vec<Block>,
    /// Estimated errors.
    error: Vec<Block>,
    estimate: Estimate,
    /// Evaluations of the right-hand side.
    pub evaluations: u64,
    /// Stages of the attempted step, from the first on, whose rates are given.
    given: usize,
}

impl Stages {
    pub(in crate::ode) fn new(tableau: &'static Tableau, n: usize) -> Self {
        let blocks = blocks(n);
        Self {
            tableau,
            n,
            blocks,
            k: vec![[0.0; LANES]; tableau.all_stages() * blocks],
            argument: vec![[0.0; LANES]; blocks],
            error: vec![[0.0; LANES]; blocks],
            estimate: Estimate::default(),
            evaluations: 0,
            given: 0,
        }
    }

    /// A smooth interval begins: earlier estimates do not apply to it.
    pub(in crate::ode) fn begin_interval(&mut self) {
        self.estimate = Estimate::default();
    }

    /// Rates of a stage.
    pub(in crate::ode) fn rates(&self, stage: usize) -> &[Block] {
        &self.k[stage * self.blocks..(stage + 1) * self.blocks]
    }

    /// Gives the rates of the stages below `count` of the next step, found together with those of other runs,
    /// and the state at the last stage before its end. Component by component they have the bits that
    /// [`Self::evaluate`] would find.
    pub(in crate::ode) fn give(
        &mut self,
        count: usize,
        rate: impl Fn(usize, usize) -> f64,
        argument: impl Fn(usize) -> f64,
    ) {
        self.given = count;
        for stage in 1..count {
            let range = stage * self.blocks..(stage + 1) * self.blocks;
            let rates = &mut self.k[range].as_flattened_mut()[..self.n];
            for (component, out) in rates.iter_mut().enumerate() {
                *out = rate(stage, component);
            }
        }
        let state = &mut self.argument.as_flattened_mut()[..self.n];
        for (component, out) in state.iter_mut().enumerate() {
            *out = argument(component);
        }
    }

    /// Gives the rates at the new state of an accepted step whose other stages nobody asks for.
    pub(in crate::ode) fn give_end(&mut self, rates: &[f64]) {
        let end = self.tableau.stages * self.blocks;
        self.k[end..end + self.blocks].as_flattened_mut()[..self.n].copy_from_slice(rates);
    }

    /// The next step has no stages given.
    pub(in crate::ode) fn forget_given(&mut self) {
        self.given = 0;
    }

    /// Whether the rates of a stage are given.
    pub(in crate::ode) fn is_given(&self, stage: usize) -> bool {
        stage < self.given
    }

    /// Evaluates the rates of a stage at a state.
    #[inline]
    pub(in crate::ode) fn evaluate<S: System>(
        &mut self,
        system: &mut S,
        stage: usize,
        t: f64,
        y: &[Block],
    ) -> Result<(), Refusal<S::Error>> {
        self.evaluations += 1;
        if self.is_given(stage) {
            return Ok(());
        }
        let range = stage * self.blocks..(stage + 1) * self.blocks;
        let rates = &mut self.k[range].as_flattened_mut()[..self.n];
        match system.rates(t, &y.as_flattened()[..self.n], rates) {
            Ok(()) => {}
            Err(Fault::OutOfDomain) => return Err(Refusal::OutOfDomain),
            Err(Fault::Error(error)) => return Err(Refusal::System(error)),
        }
        match rates.iter().position(|rate| !rate.is_finite()) {
            None => Ok(()),
            Some(component) => Err(Refusal::NotFinite { t, component }),
        }
    }

    /// Evaluates the stages of a step and the new state. The first stage must be evaluated already.
    pub(in crate::ode) fn advance<S: System>(
        &mut self,
        system: &mut S,
        t: f64,
        y: &[Block],
        h: f64,
        new: &mut [Block],
    ) -> Result<(), Refusal<S::Error>> {
        for stage in 1..self.tableau.stages {
            self.stage(system, stage, t, y, h)?;
        }
        combine(self.tableau.b(), &self.k, h, y, new);
        Ok(())
    }

    /// Evaluates the stages of the continuous extension. The rates at the new state must be
    /// evaluated already.
    pub(in crate::ode) fn extend<S: System>(
        &mut self,
        system: &mut S,
        t: f64,
        y: &[Block],
        h: f64,
    ) -> Result<(), Refusal<S::Error>> {
        for stage in self.tableau.stages + 1..self.tableau.all_stages() {
            self.stage(system, stage, t, y, h)?;
        }
        Ok(())
    }

    #[inline]
    fn stage<S: System>(
        &mut self,
        system: &mut S,
        stage: usize,
        t: f64,
        y: &[Block],
        h: f64,
    ) -> Result<(), Refusal<S::Error>> {
        if self.is_given(stage) {
            self.evaluations += 1;
            return Ok(());
        }
        let mut argument = std::mem::take(&mut self.argument);
        combine(self.tableau.a[stage], &self.k, h, y, &mut argument);
        let result = self.evaluate(system, stage, t + self.tableau.c[stage] * h, &argument);
        self.argument = argument;
        result
    }

    /// Error of a step relative to the tolerance: acceptable up to 1. See [`Estimate::error`].
    pub(in crate::ode) fn error(
        &mut self,
        scale: &Scale,
        y: &[Block],
        new: &[Block],
        h: f64,
    ) -> f64 {
        let mut mean_square = |row: Row, k: &[Block]| {
            weighted_sum(row, k, &mut self.error);
            scale.square_sum(&self.error, y, new) / self.n as f64
        };
        let fine = mean_square(self.tableau.error, &self.k);
        let coarse = self.tableau.coarse_error.map(|row| mean_square(row, &self.k));
        self.error_of(fine, coarse, h)
    }

    /// The same from the mean squares of the estimates of a unit step.
    pub(in crate::ode) fn error_of(&mut self, fine: f64, coarse: Option<f64>, h: f64) -> f64 {
        self.estimate.error(fine, coarse, h)
    }

    /// Whether stability, not accuracy, limits a step, from the last two stages, both at its end
    /// (Shampine; Hairer & Wanner II, IV.2, eq. 2.26). Components are weighted by their tolerances,
    /// so that one excluded from error control does not count. Valid only directly after `advance`
    /// and the evaluation at the new state.
    pub(in crate::ode) fn is_stiff(
        &mut self,
        scale: &Scale,
        y: &[Block],
        new: &[Block],
        h: f64,
    ) -> bool {
        let last = self.tableau.stages - 1;
        let k = |stage: usize| &self.k[stage * self.blocks..(stage + 1) * self.blocks];
        subtract(k(last + 1), k(last), &mut self.error);
        let rates = scale.square_sum(&self.error, y, new);
        subtract(new, &self.argument, &mut self.error);
        let states = scale.square_sum(&self.error, y, new);
        states > 0.0 && h * h * rates > self.tableau.stability * self.tableau.stability * states
    }

    /// Uses the rates at the new state as the first stage of the next step.
    pub(in crate::ode) fn next_step(&mut self) {
        self.estimate.accept();
        let end = self.tableau.stages * self.blocks;
        self.k.copy_within(end..end + self.blocks, 0);
    }

    /// Weighted sum of the rates of the stages.
    pub(in crate::ode) fn weighted_sum(&self, row: Row, sum: &mut [Block]) {
        weighted_sum(row, &self.k, sum);
    }
}

fn subtract(a: &[Block], b: &[Block], out: &mut [Block]) {
    for ((out, a), b) in out.iter_mut().zip(a).zip(b) {
        *out = std::array::from_fn(|l| a[l] - b[l]);
    }
}

/// Σ wⱼ kⱼ.
#[inline]
fn weighted_sum(row: Row, k: &[Block], sum: &mut [Block]) {
    // A single block is by far the most frequent case and needs no index arithmetic.
    if let [sum] = sum {
        *sum = weighted_block(row, |stage| &k[stage]);
        return;
    }
    let blocks = sum.len();
    for (b, sum) in sum.iter_mut().enumerate() {
        *sum = weighted_block(row, |stage| &k[stage * blocks + b]);
    }
}

#[inline(always)]
fn weighted_block<'k>(row: Row, k: impl Fn(usize) -> &'k Block) -> Block {
    let mut total = [0.0; LANES];
    for &(stage, weight) in row {
        let k = k(stage);
        for l in 0..LANES {
            total[l] += weight * k[l];
        }
    }
    total
}

/// y + h Σ wⱼ kⱼ.
#[inline]
fn combine(row: Row, k: &[Block], h: f64, y: &[Block], new: &mut [Block]) {
    weighted_sum(row, k, new);
    for (new, y) in new.iter_mut().zip(y) {
        for l in 0..LANES {
            new[l] = y[l] + h * new[l];
        }
    }
}
