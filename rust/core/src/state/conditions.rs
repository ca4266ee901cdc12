//! Whether one position, or several at once, close, and how far rounding limits their accuracy.

use crate::math::lanes::{Mask, Real};
use crate::plan::plan::Plan;

/// Conditions are squared: squares need no roots.
#[derive(Debug, Clone)]
pub(crate) struct Conditions<R: Real = f64, const G: usize = 1> {
    /// Square of the greatest coordinate or arm in the chain to each point, to which its rounding
    /// error is relative.
    pub(crate) coordinate_scale2: Vec<[R; G]>,
    /// Product of the conditions of the dyads and groups that each point depends on.
    pub(crate) of_point: Vec<[R; G]>,
    /// The same for each class.
    pub(crate) of_class: Vec<[R; G]>,
    /// The same for each slide.
    pub(crate) of_slide: Vec<[R; G]>,
    /// Condition of all that each dyad with a sign depends on.
    pub(crate) upstream: Vec<[R; G]>,
    /// The greatest condition in the position.
    pub(crate) greatest: [R; G],
    /// A lower bound of the inverse of each dyad's condition (on the unchecked path only).
    pub(crate) bounds: Vec<[R; G]>,
    /// The same for everything that the present dyad depends on.
    pub(crate) bound: [R; G],
    /// By how much each dyad closes (relative to the scale), negative where it does not.
    pub(crate) margin: Vec<[R; G]>,
    /// Lanes where a dyad does not close.
    pub(crate) open: [R::Mask; G],
    /// Lanes that failed or are singular; the caller solves each again as a single position.
    pub(crate) needs_scalar: [R::Mask; G],
}

impl<R: Real, const G: usize> Conditions<R, G> {
    pub(super) fn new(plan: &Plan) -> Self {
        Self {
            coordinate_scale2: vec![[R::ZERO; G]; plan.points],
            of_point: vec![[R::ONE; G]; plan.points],
            of_class: vec![[R::ONE; G]; plan.classes],
            of_slide: vec![[R::ONE; G]; plan.slide_links.len()],
            upstream: vec![[R::ONE; G]; plan.signs()],
            greatest: [R::ONE; G],
            bounds: vec![[R::ONE; G]; plan.dyads().count()],
            bound: [R::ONE; G],
            margin: vec![[R::ZERO; G]; plan.dyads().count()],
            open: [R::Mask::NONE; G],
            needs_scalar: [R::Mask::NONE; G],
        }
    }
}
