//! The arithmetic of one step.
//!
//! Numbers lie in blocks of four components, so that sums over stages are vector instructions for
//! any number of equations; what is over is zero and stays so.

use super::system::{Fault, System};
use super::tableau::{Row, Tableau};

/// Components of a block: two SSE2 registers, or one of AVX2.
const LANES: usize = 4;

/// Some components of a state.
pub(super) type Block = [f64; LANES];

/// How many blocks hold so many components.
pub(super) fn blocks(n: usize) -> usize {
    n.div_ceil(LANES)
}

/// Why a step cannot be made.
#[derive(Debug)]
pub(super) enum Refusal<E> {
    /// A stage is not there.
    NotThere,
    /// Rates at a stage are NaN or infinite.
    NotFinite { t: f64, component: usize },
    /// The system ends the run.
    System(E),
}

/// Tolerances of all components.
#[derive(Debug)]
pub(super) struct Scale {
    relative: Vec<Block>,
    absolute: Vec<Block>,
}

impl Scale {
    /// One tolerance for each component, or one for all.
    pub(super) fn new(relative: &[f64], absolute: &[f64], n: usize) -> Self {
        let spread = |given: &[f64]| {
            let mut spread = vec![[1.0; LANES]; blocks(n)];
            let all = spread.as_flattened_mut().iter_mut();
            all.zip(given.iter().cycle().take(n)).for_each(|(to, from)| *to = *from);
            spread
        };
        Self { relative: spread(relative), absolute: spread(absolute) }
    }

    /// Σ (eᵢ / (aᵢ + rᵢ max(|yᵢ|, |zᵢ|)))² (Hairer, Nørsett & Wanner I, eq. II.4.10 and 4.11).
    pub(super) fn square_sum(&self, e: &[Block], y: &[Block], z: &[Block]) -> f64 {
        let mut total = 0.0;
        let tolerances = self.absolute.iter().zip(&self.relative);
        for (((e, (a, r)), y), z) in e.iter().zip(tolerances).zip(y).zip(z) {
            for l in 0..LANES {
                let scale = a[l] + r[l] * y[l].abs().max(z[l].abs());
                // Without an absolute tolerance a component may rest at zero: 0/0 is no error.
                let ratio = e[l] / scale.max(f64::MIN_POSITIVE);
                total += ratio * ratio;
            }
        }
        total
    }
}

/// A fine estimate, by the width of its step, so many times the greatest before shows a solution
/// that changes within a step. The quotient of two estimates then promises too much: of a machine, a
/// step with an error of 12 tolerances was taken for one of 0.995.
const ABRUPT: f64 = 6.0;
/// The part of the fine estimate that then counts at least. Of thresholds from 2 to 12 and parts from
/// 0.05 to 0.2 these cost least (0.8 % more evaluations of 150 random machines) of those that keep
/// the energy.
const ABRUPT_PART: f64 = 0.05;
/// Steps of a stretch before which nothing is known of its solution: of a table's pieces, which have
/// but a few, the second says nothing either.
const FIRST_STEPS: u32 = 2;

/// The stages of a step.
#[derive(Debug)]
pub(super) struct Stages {
    pub tableau: &'static Tableau,
    n: usize,
    blocks: usize,
    /// Rates at all stages.
    k: Vec<Block>,
    /// The state at the stage evaluated last.
    argument: Vec<Block>,
    /// Estimated errors.
    error: Vec<Block>,
    /// Size of the fine estimate by h⁶: of the step tried, and the greatest since the stretch began,
    /// so many steps before.
    fine: f64,
    greatest: f64,
    taken: u32,
    /// How often the right-hand side was evaluated.
    pub evaluations: u64,
}

impl Stages {
    pub(super) fn new(tableau: &'static Tableau, n: usize) -> Self {
        let blocks = blocks(n);
        Self {
            tableau,
            n,
            blocks,
            k: vec![[0.0; LANES]; tableau.all_stages() * blocks],
            argument: vec![[0.0; LANES]; blocks],
            error: vec![[0.0; LANES]; blocks],
            fine: 0.0,
            greatest: 0.0,
            taken: 0,
            evaluations: 0,
        }
    }

    /// A smooth stretch begins: what was estimated before says nothing of it.
    pub(super) fn enter(&mut self) {
        (self.greatest, self.taken) = (0.0, 0);
    }

    /// Rates of a stage.
    pub(super) fn rates(&self, stage: usize) -> &[Block] {
        &self.k[stage * self.blocks..(stage + 1) * self.blocks]
    }

    /// Evaluates the rates of a stage at a state.
    #[inline]
    pub(super) fn evaluate<S: System>(
        &mut self,
        system: &mut S,
        stage: usize,
        t: f64,
        y: &[Block],
    ) -> Result<(), Refusal<S::Error>> {
        self.evaluations += 1;
        let range = stage * self.blocks..(stage + 1) * self.blocks;
        let rates = &mut self.k[range].as_flattened_mut()[..self.n];
        match system.rates(t, &y.as_flattened()[..self.n], rates) {
            Ok(()) => {}
            Err(Fault::OutOfDomain) => return Err(Refusal::NotThere),
            Err(Fault::Error(error)) => return Err(Refusal::System(error)),
        }
        match rates.iter().position(|rate| !rate.is_finite()) {
            None => Ok(()),
            Some(component) => Err(Refusal::NotFinite { t, component }),
        }
    }

    /// The stages that make up a new state, and that state. The first one is there already.
    pub(super) fn advance<S: System>(
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

    /// The stages of the continuous extension. The rates at the new state are there already.
    pub(super) fn extend<S: System>(
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
        let mut argument = std::mem::take(&mut self.argument);
        combine(self.tableau.a[stage], &self.k, h, y, &mut argument);
        let result = self.evaluate(system, stage, t + self.tableau.c[stage] * h, &argument);
        self.argument = argument;
        result
    }

    /// Size of the error of a step: it is good if it is not above one.
    ///
    /// With two estimates, e = e₅² / √(e₅² + 0.01 e₃²) (Hairer, Nørsett & Wanner I, II.10), which
    /// takes them for the terms of a series: only while they change little from step to step.
    pub(super) fn error(&mut self, scale: &Scale, y: &[Block], new: &[Block], h: f64) -> f64 {
        let mut size = |row: Row, k: &[Block]| {
            weigh(row, k, &mut self.error);
            scale.square_sum(&self.error, y, new) / self.n as f64
        };
        let fine = size(self.tableau.error, &self.k);
        let error = match self.tableau.coarse_error {
            None => fine.sqrt(),
            Some(_) if fine == 0.0 => 0.0,
            Some(coarse) => fine / (fine + 0.01 * size(coarse, &self.k)).sqrt(),
        };
        let fine = fine.sqrt();
        self.fine = fine / (h * h * h * h * h).abs();
        let is_abrupt = self.taken >= FIRST_STEPS && self.fine > ABRUPT * self.greatest;
        let error = if is_abrupt { error.max(ABRUPT_PART * fine) } else { error };
        // What is too large for a number is just too large.
        if error.is_nan() { f64::INFINITY } else { error * h.abs() }
    }

    /// Whether stability and not accuracy holds a step, from the two last stages, which are both
    /// at its end (Shampine; Hairer & Wanner II, IV.2, eq. 2.26), by what the tolerances make of
    /// each component: a sum that nothing depends on says nothing. Only after `advance`.
    pub(super) fn is_stiff(&mut self, scale: &Scale, y: &[Block], new: &[Block], h: f64) -> bool {
        let last = self.tableau.stages - 1;
        let k = |stage: usize| &self.k[stage * self.blocks..(stage + 1) * self.blocks];
        subtract(k(last + 1), k(last), &mut self.error);
        let rates = scale.square_sum(&self.error, y, new);
        subtract(new, &self.argument, &mut self.error);
        let states = scale.square_sum(&self.error, y, new);
        states > 0.0 && h * h * rates > self.tableau.stability * self.tableau.stability * states
    }

    /// Takes the rates at the new state as those at the start of the next step.
    pub(super) fn turn_over(&mut self) {
        self.greatest = self.greatest.max(self.fine);
        self.taken = self.taken.saturating_add(1);
        let end = self.tableau.stages * self.blocks;
        self.k.copy_within(end..end + self.blocks, 0);
    }

    /// Weighted sum of the rates of the stages.
    pub(super) fn weigh(&self, row: Row, sum: &mut [Block]) {
        weigh(row, &self.k, sum);
    }
}

fn subtract(a: &[Block], b: &[Block], out: &mut [Block]) {
    for ((out, a), b) in out.iter_mut().zip(a).zip(b) {
        *out = std::array::from_fn(|l| a[l] - b[l]);
    }
}

/// Σ wⱼ kⱼ.
#[inline]
fn weigh(row: Row, k: &[Block], sum: &mut [Block]) {
    // One block is by far the most frequent, and then its number is no question.
    if let [sum] = sum {
        *sum = weigh_one(row, |stage| &k[stage]);
        return;
    }
    let blocks = sum.len();
    for (b, sum) in sum.iter_mut().enumerate() {
        *sum = weigh_one(row, |stage| &k[stage * blocks + b]);
    }
}

#[inline(always)]
fn weigh_one<'k>(row: Row, k: impl Fn(usize) -> &'k Block) -> Block {
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
    weigh(row, k, new);
    for (new, y) in new.iter_mut().zip(y) {
        for l in 0..LANES {
            new[l] = y[l] + h * new[l];
        }
    }
}
