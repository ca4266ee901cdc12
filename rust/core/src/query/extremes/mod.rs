//! Extremes of a coordinate of the motion, or of a derivative of it, over all of an assembly's
//! intervals.

mod beside;
mod continued;
mod curve;
mod ends;
mod graded;
mod hermite;
mod node_values;
pub(crate) mod tracked;
mod window;
mod zero_lengths;

use std::sync::atomic::{AtomicBool, Ordering};

use curve::Curve;
use tracked::{Tracked, ValueAt};
use window::Window;

use super::evaluator::{Evaluator, Queries};
use super::limits::finder::{LimitsFinder, Tables};
use crate::description::error::SolveError;
use crate::math::derivatives::{DerivativeTables, MAX_ORDER};
use crate::plan::mechanism::Mechanism;

impl Mechanism {
    /// The least and the greatest value of a derivative of order 0 to 3 of a coordinate, over all
    /// intervals or the one that contains `within`; `None` if the assembly does not exist there. At a dead
    /// point derivatives are infinite, and so is the angle of a link that goes round.
    ///
    /// # Errors
    ///
    /// Those of [`LimitsFinder`], and an order above 3; [`SolveError::Interrupted`] once `cancel` is
    /// true.
    pub fn extremes(
        &self,
        dimensions: &[f64],
        signs: &[i8],
        (tracked, order): (Tracked, usize),
        within: Option<f64>,
        cancel: Option<&AtomicBool>,
    ) -> Result<Option<[ValueAt; 2]>, SolveError> {
        let mut extremes: Option<[ValueAt; 2]> = None;
        let is_length = matches!(tracked, Tracked::Slide(slide) if self.linkage().slides[slide].length)
            && order == 0;
        self.over_intervals((dimensions, signs), (tracked, order), cancel, |curve, window| {
            if within.is_some_and(|q| !window.holds(q)) {
                return;
            }
            for mut candidate in curve.candidates(window) {
                if is_length {
                    // Extrapolated to a dead point it may be negative by rounding.
                    candidate.value = candidate.value.max(0.0);
                }
                extremes = Some(match extremes {
                    None => [candidate; 2],
                    Some([least, greatest]) => [
                        if candidate.value < least.value { candidate } else { least },
                        if candidate.value > greatest.value { candidate } else { greatest },
                    ],
                });
            }
        })?;
        Ok(extremes)
    }

    /// Stretches of q over which a derivative of order 0 to 3 of a coordinate is at least `level`, or
    /// at most.
    ///
    /// # Errors
    ///
    /// Those of [`Mechanism::extremes`].
    pub fn stretches_beyond(
        &self,
        dimensions: &[f64],
        signs: &[i8],
        (tracked, order): (Tracked, usize),
        (level, at_least): (f64, bool),
        cancel: Option<&AtomicBool>,
    ) -> Result<Vec<[f64; 2]>, SolveError> {
        let mut all_stretches = Vec::new();
        let sign = if at_least { 1.0 } else { -1.0 };
        self.over_intervals((dimensions, signs), (tracked, order), cancel, |curve, window| {
            let mut pieces = curve.stretches(window, |value| sign * (value - level));
            if window.is_period {
                join(&mut pieces, window.ends());
            }
            all_stretches.extend(pieces);
        })?;
        Ok(all_stretches)
    }

    /// Hands every interval of an assembly to `visit`.
    fn over_intervals(
        &self,
        (dimensions, signs): (&[f64], &[i8]),
        (tracked, order): (Tracked, usize),
        cancel: Option<&AtomicBool>,
        mut visit: impl FnMut(&mut Curve<'_>, &Window),
    ) -> Result<(), SolveError> {
        if order > MAX_ORDER {
            return Err(SolveError::Order(order));
        }
        let tables = Tables::default();
        let limits = LimitsFinder::new(self, signs, &tables, cancel)?.limits(dimensions)?;
        // An extreme is a root of the next derivative, found with its slope. Kernels end at
        // `MAX_ORDER`; the general formulas serve any order.
        let highest = order + 2;
        let general;
        let mechanism = if highest > MAX_ORDER {
            general = self.clone().with_general_kernels();
            &general
        } else {
            self
        };
        let derivatives = DerivativeTables::new(1, highest);
        let evaluator = Evaluator::with_signs(
            mechanism,
            (dimensions, signs),
            &derivatives,
            Queries::Any,
            matches!(tracked, Tracked::Link(_)),
            cancel,
        );
        let mut curve = Curve { evaluator, tracked, order, beside: Vec::new(), cancel };
        let turns = limits.period.map_or(1.0, f64::from);
        for interval in &limits.intervals {
            let mut window = Window::of(self, &curve.evaluator, interval, turns);
            curve.beside.clear();
            curve.find_zero_lengths(&mut window);
            visit(&mut curve, &window);
        }
        let interrupted = cancel.is_some_and(|cancel| cancel.load(Ordering::Relaxed));
        if interrupted { Err(SolveError::Interrupted) } else { Ok(()) }
    }
}

/// Joins the first and the last stretch if they are one, over the end of a period.
fn join(stretches: &mut Vec<[f64; 2]>, [from, to]: [f64; 2]) {
    if let [[first, _], .., [_, last]] = stretches[..]
        && first == from
        && last == to
        && let Some([start, _]) = stretches.pop()
    {
        stretches[0][0] = start - (to - from);
    }
}
