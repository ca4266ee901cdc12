//! Work space of the checked path and of the iteration for groups above class II, with the results
//! that the branch checks.

use super::closing::Closing;
use crate::math::derivatives::DerivativeTables;
use crate::math::lanes::Real;
use crate::math::vector::Vector;
use crate::plan::plan::Plan;

#[derive(Debug, Clone)]
pub(crate) struct Workspace<R: Real = f64, const G: usize = 1> {
    /// Matrix, inverse and right-hand side of a group above class II.
    pub(crate) matrix: Vec<[R; G]>,
    /// Jets of the guides along the edges of a group.
    pub(crate) guides: Vec<[Vector<R>; G]>,
    /// Jets of the chords of a group's loops.
    pub(crate) chords: Vec<[Vector<R>; G]>,
    /// 1/length of every chord of known length.
    pub(crate) inv_length: Vec<[R; G]>,
    /// Whether the caller wants the rotation of each class; used for bars that no step needs.
    pub(crate) angle_wanted: Vec<bool>,
    /// Determinant of every group's matrix at the solution (with analogues only).
    pub(crate) determinants: Vec<[R; G]>,
    /// Determinant of that matrix in the last Newton round; its sign distinguishes branches.
    pub(crate) det_sign: Vec<[R; G]>,
    /// Greatest change of an unknown (rad, or relative to the scale) in the first Newton step of
    /// any group.
    pub(crate) first_step: [R; G],
    /// Greatest sum of the changes in the later steps.
    pub(crate) later_steps: [R; G],
    /// How the dyad that was solved last closes, on the checked path.
    pub(crate) closings: [Closing<R>; G],
}

impl<R: Real, const G: usize> Workspace<R, G> {
    pub(super) fn new(plan: &Plan, derivatives: &DerivativeTables) -> Self {
        let len = derivatives.len();
        let edges = plan.groups().map(|group| group.edges.len()).max().unwrap_or(0);
        let loops = plan.groups().map(|group| group.loops.len()).max().unwrap_or(0);
        Self {
            matrix: vec![[R::ZERO; G]; plan.matrix_size()],
            guides: vec![[Vector::ZERO; G]; edges * len],
            chords: vec![[Vector::ZERO; G]; loops * len],
            inv_length: vec![[R::ONE; G]; loops],
            angle_wanted: vec![true; plan.classes],
            determinants: vec![[R::ZERO; G]; plan.groups().count()],
            det_sign: vec![[R::ZERO; G]; plan.groups().count()],
            first_step: [R::ZERO; G],
            later_steps: [R::ZERO; G],
            closings: [Closing::CLOSED; G],
        }
    }
}
