//! Whether the signs of an assembly are the same all around: then they need not be traced back to the
//! drawing.

use super::design::Design;
use super::lanes::uniform::Traced;
use super::trace::BaselineTracer;

/// A design with the work space for it.
pub(crate) struct SignConstancy<'d, 'm> {
    pub design: &'d mut Design<'m>,
    /// Made for the first design that needs it.
    uniform: Option<Box<BaselineTracer>>,
}

impl<'d, 'm> SignConstancy<'d, 'm> {
    pub(crate) fn new(design: &'d mut Design<'m>) -> Self {
        Self { design, uniform: None }
    }

    /// Whether an assembly with these signs certainly never passes a change point; if false, it may.
    pub(crate) fn holds(&mut self, signs: &[f64]) -> bool {
        let Self { design, uniform } = self;
        let several = design.q0.len() > 1;
        if !(design.closed_forms && (several || design.has_one_rotary_driver())) {
            return false;
        }
        design.signs.clear();
        design.signs.extend_from_slice(signs);
        let mut traced = design.trace_in_closed_form(&[], None) == Traced::Whole;
        if !traced && !several {
            let uniform = uniform.get_or_insert_with(|| Box::new(design.uniform_tracer()));
            traced = design.trace_in_baseline_lanes(uniform, &[]) == Traced::Whole;
        }
        traced && design.has_constant_signs()
    }
}
