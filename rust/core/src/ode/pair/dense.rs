//! Dense output: the state inside a step.
//!
//! y(θ) = y₀ + θ(F₀ + (1−θ)(F₁ + θ(F₂ + (1−θ)(F₃ + …)))), θ = (t − t₀)/h, with F₀ = y₁ − y₀,
//! F₁ = h f₀ − F₀, F₂ = F₀ − h f₁ − F₁ (the Hermite cubic) and the others sums of the stages
//! (Hairer, Nørsett & Wanner I, II.6; the form is that of DOPRI5 and DOP853).

use std::collections::TryReserveError;

use super::stages::{Block, Stages};
use super::tableau::HERMITE_ROWS;

/// Least rows of a step: y₀ and the Hermite cubic.
pub(crate) const LEAST_ROWS: usize = 1 + HERMITE_ROWS;

/// A step cut to less than this part of it is a cubic to rounding: its fourth derivative contributes
/// 1e-12 of what it contributes to the whole step, by 1/384.
const CUBIC_WITHIN: f64 = 1.0e-3;

/// The continuous extension of one step.
#[derive(Debug)]
pub(in crate::ode) struct Interpolant {
    n: usize,
    /// y₀, then F₀, F₁, …: n numbers each.
    rows: Vec<f64>,
    sum: Vec<Block>,
}

impl Interpolant {
    pub(in crate::ode) fn new(stages: &Stages, n: usize) -> Self {
        let rows = 1 + stages.tableau.extension_rows();
        Self { n, rows: vec![0.0; rows * n], sum: stages.rates(0).to_vec() }
    }

    /// Sets the polynomial of a step whose stages are all evaluated.
    pub(in crate::ode) fn set(&mut self, stages: &Stages, y: &[Block], new: &[Block], h: f64) {
        let n = self.n;
        let (first, last) = (stages.rates(0), stages.rates(stages.tableau.stages));
        let flat = |b: &'_ [Block], i: usize| b.as_flattened()[i];
        for i in 0..n {
            let (y0, y1) = (flat(y, i), flat(new, i));
            let change = y1 - y0;
            let second = h * flat(first, i) - change;
            self.rows[i] = y0;
            self.rows[n + i] = change;
            self.rows[2 * n + i] = second;
            self.rows[3 * n + i] = change - h * flat(last, i) - second;
        }
        for (r, row) in stages.tableau.extension.iter().enumerate() {
            stages.weighted_sum(row, &mut self.sum);
            let at = (LEAST_ROWS + r) * n;
            for (out, sum) in self.rows[at..at + n].iter_mut().zip(self.sum.as_flattened()) {
                *out = h * sum;
            }
        }
    }

    /// Takes the polynomial of a step that was found elsewhere; `number`: of a row and a component.
    pub(in crate::ode) fn give(&mut self, number: impl Fn(usize, usize) -> f64) {
        for (row, numbers) in self.rows.chunks_exact_mut(self.n).enumerate() {
            for (component, out) in numbers.iter_mut().enumerate() {
                *out = number(row, component);
            }
        }
    }

    /// Writes the state at θ.
    pub(in crate::ode) fn at(&self, theta: f64, y: &mut [f64]) {
        evaluate(&self.rows, self.n, theta, y);
    }

    /// Moves a state from one θ to another, adding the change of the polynomial.
    pub(in crate::ode) fn shift(&self, from: f64, to: f64, y: &mut [f64]) {
        for (i, y) in y.iter_mut().enumerate() {
            let [start, end] = [from, to].map(|theta| component(&self.rows, self.n, theta, i));
            *y += end - start;
        }
    }

    /// Writes the rates at θ of a step of width h.
    pub(in crate::ode) fn slope(&self, theta: f64, h: f64, rates: &mut [f64]) {
        for (i, rate) in rates.iter_mut().enumerate() {
            *rate = component_slope(&self.rows, self.n, theta, i) / h;
        }
    }

    /// Ends the polynomial at θ with a more accurate state, and with the rates there: after the part
    /// `to` of the step's width h. Returns the new width of the polynomial.
    ///
    /// The differences, of the size of its own error, are added as the cubic in θ/θ₁ that begins at zero
    /// with slope zero: the start and its rates stay. Divided by θ₁³ it would lose its digits where θ₁ is
    /// small; there the cubic through both ends is all of the step.
    pub(in crate::ode) fn end_at(
        &mut self,
        theta: f64,
        [h, to]: [f64; 2],
        y: &[f64],
        rates: &[f64],
    ) -> f64 {
        let n = self.n;
        if theta < CUBIC_WITHIN {
            for i in 0..n {
                let rate = (self.rows[n + i] + self.rows[2 * n + i]) / h;
                let change = y[i] - self.rows[i];
                let second = to * rate - change;
                self.rows[n + i] = change;
                self.rows[2 * n + i] = second;
                self.rows[3 * n + i] = change - to * rates[i] - second;
            }
            self.rows[LEAST_ROWS * n..].fill(0.0);
            return to;
        }
        for i in 0..n {
            let error = y[i] - component(&self.rows, n, theta, i);
            let slope = theta * (h * rates[i] - component_slope(&self.rows, n, theta, i));
            // a θ² + b θ³ = (a + b) (θ − θ (1 − θ)) − b θ² (1 − θ).
            let a = (3.0 * error - slope) / (theta * theta);
            let b = (slope - 2.0 * error) / (theta * theta * theta);
            self.rows[n + i] += a + b;
            self.rows[2 * n + i] -= a + b;
            self.rows[3 * n + i] -= b;
        }
        h
    }
}

/// One component of y(θ).
#[inline]
fn component(rows: &[f64], n: usize, theta: f64, i: usize) -> f64 {
    let count = rows.len() / n;
    let mut inner = 0.0;
    for row in (1..count).rev() {
        let factor = if row % 2 == 1 { theta } else { 1.0 - theta };
        inner = (rows[row * n + i] + inner) * factor;
    }
    rows[i] + inner
}

/// Its derivative by θ.
fn component_slope(rows: &[f64], n: usize, theta: f64, i: usize) -> f64 {
    let count = rows.len() / n;
    let (mut inner, mut slope) = (0.0, 0.0);
    for row in (1..count).rev() {
        let (factor, sign) = if row % 2 == 1 { (theta, 1.0) } else { (1.0 - theta, -1.0) };
        let sum = rows[row * n + i] + inner;
        slope = slope * factor + sum * sign;
        inner = sum * factor;
    }
    slope
}

fn evaluate(rows: &[f64], n: usize, theta: f64, y: &mut [f64]) {
    // The states of machines with one driver, which most runs are of.
    if let (3, (rows, [])) = (n, rows.as_chunks::<3>()) {
        y[..3].copy_from_slice(&together(rows, theta));
        return;
    }
    for (i, y) in y.iter_mut().enumerate().take(n) {
        *y = component(rows, n, theta, i);
    }
}

/// [`component`] for all of a fixed number of them at once.
fn together<const N: usize>(rows: &[[f64; N]], theta: f64) -> [f64; N] {
    let mut inner = [0.0; N];
    for (row, numbers) in rows.iter().enumerate().skip(1).rev() {
        let factor = if row % 2 == 1 { theta } else { 1.0 - theta };
        for i in 0..N {
            inner[i] = (numbers[i] + inner[i]) * factor;
        }
    }
    std::array::from_fn(|i| rows[0][i] + inner[i])
}

/// Dense output of a run: the state at any t.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct DenseOutput {
    pub(crate) n: usize,
    /// Numbers stored per step.
    pub(crate) stride: usize,
    pub(crate) starts: Vec<f64>,
    /// Full widths; a step cut by an event ends earlier.
    pub(crate) widths: Vec<f64>,
    pub(crate) ends: Vec<f64>,
    pub(crate) rows: Vec<f64>,
}

impl DenseOutput {
    pub(in crate::ode) fn push(
        &mut self,
        interpolant: &Interpolant,
        start: f64,
        width: f64,
        end: f64,
    ) -> Result<(), TryReserveError> {
        self.n = interpolant.n;
        self.stride = interpolant.rows.len();
        for list in [&mut self.starts, &mut self.widths, &mut self.ends] {
            list.try_reserve(1)?;
        }
        self.rows.try_reserve(interpolant.rows.len())?;
        self.starts.push(start);
        self.widths.push(width);
        self.ends.push(end);
        self.rows.extend_from_slice(&interpolant.rows);
        Ok(())
    }

    /// Forgets all steps; their memory is kept.
    pub(in crate::ode) fn clear(&mut self) {
        for list in [&mut self.starts, &mut self.widths, &mut self.ends, &mut self.rows] {
            list.clear();
        }
    }

    /// A copy without room for more.
    ///
    /// # Errors
    ///
    /// It does not fit in memory.
    pub(in crate::ode) fn copied(&self) -> Result<Self, TryReserveError> {
        let copied = |list: &[f64]| -> Result<Vec<f64>, TryReserveError> {
            let mut copy = Vec::new();
            copy.try_reserve_exact(list.len())?;
            copy.extend_from_slice(list);
            Ok(copy)
        };
        let (starts, widths) = (copied(&self.starts)?, copied(&self.widths)?);
        let (ends, rows) = (copied(&self.ends)?, copied(&self.rows)?);
        Ok(Self { n: self.n, stride: self.stride, starts, widths, ends, rows })
    }

    /// Gives back the memory that it does not need.
    pub(crate) fn shrink(&mut self) {
        for list in [&mut self.starts, &mut self.widths, &mut self.ends, &mut self.rows] {
            list.shrink_to_fit();
        }
    }

    /// Ends of the steps.
    pub fn ends(&self) -> &[f64] {
        &self.ends
    }

    /// Passes the end, the state and the rates of each step to `visit`, as [`DenseOutput::at`] and
    /// [`DenseOutput::slope`] give them.
    pub fn each_end(&self, mut visit: impl FnMut(f64, &[f64], &[f64])) {
        let (mut y, mut rates) = (vec![0.0; self.n], vec![0.0; self.n]);
        let steps = self.starts.iter().zip(&self.widths).zip(&self.ends);
        for (((start, width), &end), rows) in steps.zip(self.rows.chunks_exact(self.stride.max(1)))
        {
            let theta = (end - start) / width;
            let n = self.n;
            for (i, (y, rate)) in y.iter_mut().zip(&mut rates).enumerate() {
                if theta == 1.0 {
                    // Few steps are cut; at the end of a full step all other terms are zero.
                    *y = rows[i] + rows[n + i];
                    *rate = (rows[n + i] - (rows[2 * n + i] + rows[3 * n + i])) / width;
                    continue;
                }
                *y = component(rows, self.n, theta, i);
                *rate = component_slope(rows, self.n, theta, i) / width;
            }
            visit(end, &y, &rates);
        }
    }

    /// Writes the state at t, before any change by an event there. Returns whether t is within the
    /// run; if not, the state is NaN.
    pub fn at(&self, t: f64, y: &mut [f64]) -> bool {
        y.fill(f64::NAN);
        let Some((theta, _, rows)) = self.locate(t).filter(|_| y.len() == self.n) else {
            return false;
        };
        evaluate(rows, self.n, theta, y);
        true
    }

    /// Writes the rates at t in the same direction. At the end of a step they are those of the
    /// right-hand side; inside, one order less accurate than the state.
    pub fn slope(&self, t: f64, rates: &mut [f64]) -> bool {
        rates.fill(f64::NAN);
        let Some((theta, width, rows)) = self.locate(t).filter(|_| rates.len() == self.n) else {
            return false;
        };
        for (i, rate) in rates.iter_mut().enumerate() {
            *rate = component_slope(rows, self.n, theta, i) / width;
        }
        true
    }

    /// The step that contains t: θ, its width and its rows.
    fn locate(&self, t: f64) -> Option<(f64, f64, &[f64])> {
        let (&from, &width) = (self.starts.first()?, self.widths.first()?);
        let direction = width.signum();
        let step = self.ends.partition_point(|end| (end - t) * direction < 0.0);
        let (&start, &width) = (self.starts.get(step)?, self.widths.get(step)?);
        let rows = self.rows.chunks_exact(self.stride).nth(step)?;
        ((t - from) * direction >= 0.0).then(|| ((t - start) / width, width, rows))
    }
}
