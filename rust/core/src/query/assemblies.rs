//! The assemblies of one design at one coordinate.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::branch::design::Design;
use crate::description::error::SolveError;
use crate::math::derivatives::DerivativeTables;
use crate::plan::mechanism::Mechanism;
use crate::plan::plan::Step;
use crate::state::state::Context;
use crate::state::status::Status;

impl Mechanism {
    /// Every assembly that exists at `q`, as signs in the order of [`Mechanism::dyad_names`].
    ///
    /// The signs are those at the drawing; on the branch from there a sign may change at change
    /// points.
    ///
    /// # Errors
    ///
    /// A group above class II, slices of the wrong length, or a coordinate too far from the
    /// drawing.
    pub fn assemblies(&self, dimensions: &[f64], q: &[f64]) -> Result<Vec<Vec<i8>>, SolveError> {
        self.assemblies_unless(dimensions, q, None)
    }

    /// [`Mechanism::assemblies`], stopping once `cancel` is true: each dyad may double their
    /// number.
    ///
    /// # Errors
    ///
    /// Those of [`Mechanism::assemblies`], and [`SolveError::Interrupted`].
    pub fn assemblies_unless(
        &self,
        dimensions: &[f64],
        q: &[f64],
        cancel: Option<&AtomicBool>,
    ) -> Result<Vec<Vec<i8>>, SolveError> {
        let is_cancelled = || cancel.is_some_and(|flag| flag.load(Ordering::Relaxed));
        self.require_closed_form()?;
        let count = self.plan().signs();
        self.check(dimensions, q, &vec![1; count])?;
        if self.dimensions().first_fault(dimensions).is_some() || q.len() != self.q0().len() {
            return Ok(Vec::new());
        }
        let derivatives = DerivativeTables::new(q.len(), 1);
        let mut design = Design::new(self, &vec![1; count], &derivatives);
        design.bind(dimensions);
        let scaled = design.scaled(q);
        if design.is_too_far(&scaled) {
            return Err(SolveError::CoordinateTooFar { q: q.to_vec() });
        }
        let mut state = design.state(&derivatives);
        let mut found: Vec<Vec<f64>> = vec![Vec::new()];
        // Sign by sign, so that a choice that fails early is not completed.
        for index in 0..count.max(1) {
            let choices: &[f64] = if count == 0 { &[] } else { &[1.0, -1.0] };
            let mut longer = Vec::new();
            for head in &found {
                if is_cancelled() {
                    return Err(SolveError::Interrupted);
                }
                longer.extend(choices.iter().map(|&sign| [&head[..], &[sign]].concat()));
                if choices.is_empty() {
                    longer.push(Vec::new());
                }
            }
            longer.retain(|signs| {
                if is_cancelled() {
                    return false;
                }
                let mut trial = signs.clone();
                trial.resize(count, 1.0);
                state.solve(&Context { signs: &trial, ..design.context(&derivatives) }, &scaled);
                match (state.status, state.fault) {
                    (Status::Unreachable, Some(fault)) => {
                        index + 1 < count && self.is_beyond(fault.step(), index)
                    }
                    (Status::Unreachable | Status::BadInput, _) => false,
                    _ => true,
                }
            });
            found = longer;
        }
        let at_drawing = |signs: &Vec<f64>| {
            let goes_on = !is_cancelled();
            goes_on.then(|| design.signs_at_drawing(signs, &scaled)).ok_or(SolveError::Interrupted)
        };
        found.iter().map(at_drawing).collect()
    }

    /// Whether a step comes after the dyad with this sign.
    fn is_beyond(&self, step: usize, sign_index: usize) -> bool {
        match &self.plan().steps[step] {
            Step::Dyad(dyad) => dyad.sign.is_none_or(|s| s > sign_index),
            _ => true,
        }
    }
}
