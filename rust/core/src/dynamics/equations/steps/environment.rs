//! The time and the step widths of one environment with error control.

use super::failures::has_failed;
use crate::ode::control::{Control, MIN_STEP, fitted, spacing};
use crate::ode::pair::estimate::Estimate;
use crate::ode::pair::tableau::Tableau;
use crate::state::status::Status;

/// Most attempted steps in a time `dt`, on average: the tolerance of a machine that needs more asks for a
/// shorter `dt`.
const MOST_ATTEMPTS: u64 = 10_000;
/// Least width of a step, in `dt`: a narrower one brings an environment no nearer to where it ends.
const LEAST_WIDTH: f64 = 1e-12;

/// The time that all environments of a call step through.
#[derive(Debug, Clone, Copy)]
pub(super) struct Span {
    /// From the start, with its sign.
    whole: f64,
    first_width: f64,
    least_width: f64,
    most_attempts: u64,
}

impl Span {
    pub(super) fn new(dt: f64, steps: u64) -> Self {
        let whole = dt * steps as f64;
        Self {
            whole,
            first_width: dt,
            least_width: (LEAST_WIDTH * dt.abs()).max(MIN_STEP * spacing(whole)),
            most_attempts: steps.saturating_mul(MOST_ATTEMPTS),
        }
    }

    /// Whether steps of a width bring environments on.
    pub(super) fn allows(&self, width: f64) -> bool {
        width >= self.least_width
    }

    /// How long it is.
    pub(super) fn duration(&self) -> f64 {
        self.whole.abs()
    }
}

/// An environment underway.
#[derive(Debug, Clone, Copy)]
pub(super) struct Environment {
    /// Its place among those of its chunk.
    pub row: usize,
    /// Time since the start, and at the end of the attempted step.
    t: f64,
    t_new: f64,
    /// Width proposed for the next step.
    width: f64,
    attempts: u64,
    /// Why a step could not be made, and where it ended, if that is still ahead.
    refused: Option<(u8, f64)>,
    control: Control,
    estimate: Estimate,
}

impl Environment {
    pub(super) fn new(row: usize, span: &Span, pair: &Tableau) -> Self {
        Self {
            row,
            t: 0.0,
            t_new: 0.0,
            width: span.first_width,
            attempts: 0,
            refused: None,
            control: Control::new(pair),
            estimate: Estimate::default(),
        }
    }

    /// The width of the next step, at most `widest`, or the status with which the environment ends.
    pub(super) fn plan(&mut self, span: &Span, widest: f64) -> Result<f64, u8> {
        if self.attempts >= span.most_attempts {
            return Err(Status::NotConverged as u8);
        }
        self.attempts += 1;
        if !span.allows(widest) {
            return Err(Status::BadInput as u8);
        }
        let proposed = self.width.abs().min(widest).copysign(self.width);
        let (h, is_last) = fitted(span.whole - self.t, proposed);
        if !is_last && !span.allows(h.abs()) {
            return Err(self.refused.map_or(Status::NotConverged as u8, |(status, _)| status));
        }
        self.t_new = if is_last { span.whole } else { self.t + h };
        Ok(h)
    }

    /// Goes on from an attempted step with this status, and these mean squares of the error estimates of a unit
    /// step; returns whether it is accepted.
    pub(super) fn conclude(
        &mut self,
        span: &Span,
        (h, status): (f64, u8),
        (fine, coarse): (f64, Option<f64>),
    ) -> bool {
        if has_failed(status) {
            self.refused = Some((status, self.t_new));
            self.width = h * self.control.factor_after_refusal();
            return false;
        }
        let error = self.estimate.error(fine, coarse, h);
        if error > 1.0 {
            self.width = h * self.control.factor_after_reject(error);
            return false;
        }
        self.t = self.t_new;
        self.estimate.accept();
        // A speed that was too high says nothing of what is ahead.
        self.refused = self
            .refused
            .filter(|&(status, t)| status != Status::BadInput as u8 && (t - self.t) * h > 0.0);
        if !self.has_arrived(span) {
            self.width = h * self.control.factor_after_accept(error);
        }
        true
    }

    /// Whether a step from here has been refused for what is ahead.
    pub(super) fn is_near_an_end(&self) -> bool {
        self.refused.is_some()
    }

    /// Whether it has come to the end.
    pub(super) fn has_arrived(&self, span: &Span) -> bool {
        self.t == span.whole
    }
}
