//! State of one position of a design, or of several at once: points, orientations and slides with
//! their analogues.

use std::sync::atomic::{AtomicBool, Ordering};

use super::conditions::Conditions;
use super::pose::Pose;
use super::status::{Fault, Status};
use super::workspace::Workspace;
use crate::math::derivatives::DerivativeTables;
use crate::math::lanes::{Mask, Real};
use crate::math::tolerance::NEAR_SINGULAR_CONDITION;
use crate::math::vector::Vector;
use crate::plan::constants::DesignConstants;
use crate::plan::plan::Plan;
use crate::plan::tape::Tape;

/// Work space for one position, or for `G` lane groups of as many positions as `R` has lanes;
/// allocated once and reused.
///
/// The lane group is the innermost index, so that one lookup of a step serves all of them and their
/// operations overlap.
#[derive(Debug, Clone)]
pub(crate) struct State<R: Real = f64, const G: usize = 1> {
    /// Number of entries of a jet.
    pub(crate) len: usize,
    /// Number of lane groups in use.
    pub(crate) groups: usize,
    /// Poses of all links, with analogues.
    pub(crate) pose: Pose<R, G>,
    /// Closure and condition.
    pub(crate) conditions: Conditions<R, G>,
    pub(crate) work: Workspace<R, G>,
    /// Status of a single position (with several lanes see `needs_scalar`).
    pub status: Status,
    /// The first failure of a single position.
    pub fault: Option<Fault>,
}

/// The inputs that all positions of a design share.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Context<'a> {
    /// The compiled mechanism.
    pub plan: &'a Plan,
    /// Constants of the design.
    pub constants: &'a DesignConstants,
    /// Index tables of the analogues.
    pub derivatives: &'a DerivativeTables,
    /// Assembly signs, +1 or −1, for single positions.
    pub signs: &'a [f64],
    /// The operations to run.
    pub tape: &'a Tape,
    /// Once it is true, what is traced along a branch ends.
    pub cancel: Option<&'a AtomicBool>,
}

impl Context<'_> {
    /// Whether work along a branch is to end, without a result.
    pub(crate) fn is_cancelled(&self) -> bool {
        self.cancel.is_some_and(|cancel| cancel.load(Ordering::Relaxed))
    }
}

impl<R: Real, const G: usize> State<R, G> {
    /// Work space for a plan.
    #[must_use]
    pub(crate) fn new(plan: &Plan, derivatives: &DerivativeTables) -> Self {
        Self {
            len: derivatives.len(),
            groups: G,
            pose: Pose::new(plan, derivatives),
            conditions: Conditions::new(plan),
            work: Workspace::new(plan, derivatives),
            status: Status::Ok,
            fault: None,
        }
    }

    /// Sets, in the lane groups in use, what the unchecked path needs and all positions of a design share.
    #[inline(always)]
    pub(crate) fn prepare_unchecked(&mut self, cx: &Context<'_>) {
        let groups = self.groups.min(G);
        for &point in &cx.tape.fixed {
            let fixed = Vector::splat(cx.constants.fixed[point]);
            self.pose.points[point * self.len][..groups].fill(fixed);
        }
        self.prepare_driven_slides(cx.plan, cx.derivatives);
    }

    /// Sets the analogues of driven slides.
    #[inline(always)]
    fn prepare_driven_slides(&mut self, plan: &Plan, derivatives: &DerivativeTables) {
        let groups = self.groups.min(G);
        for driver in 0..plan.drivers.len() {
            let Some(slide) = plan.driven_slide(driver) else { continue };
            for k in 1..self.len {
                let own = derivatives.driver_of[k] == Some(driver);
                let rate = if own { R::ONE } else { R::ZERO };
                self.pose.slides[slide * self.len + k][..groups].fill(rate);
            }
        }
    }

    /// Sets, in the lane groups in use, what all positions of a design share; call it before the first of
    /// them.
    #[inline(always)]
    pub(crate) fn prepare(
        &mut self,
        plan: &Plan,
        constants: &DesignConstants,
        derivatives: &DerivativeTables,
    ) {
        let (len, groups) = (self.len, self.groups.min(G));
        for point in 0..plan.points {
            if R::LANES > 1 && !plan.fixed[point] {
                // Every position sets all points that its steps place.
                continue;
            }
            let fixed = Vector::splat(constants.fixed[point]);
            self.pose.points[point * len][..groups].fill(fixed);
            self.conditions.coordinate_scale2[point][..groups].fill(fixed.norm2());
            if R::LANES == 1 {
                self.pose.points[point * len + 1..(point + 1) * len].fill([Vector::ZERO; G]);
            }
        }
        if R::LANES == 1 {
            // After interpolation even fixed orientations carry rounding.
            self.pose.class[0] = [Vector::ONE; G];
            self.pose.theta[..len].fill([R::ZERO; G]);
            let jets = self.pose.orient.chunks_exact_mut(len);
            for (orientation, jet) in plan.orientations.iter().zip(jets) {
                if orientation.class == 0 {
                    jet.fill([Vector::ZERO; G]);
                    jet[0] = [Vector::ONE; G];
                }
            }
        }
        self.prepare_driven_slides(plan, derivatives);
    }

    /// Whether the position has failed, so that no further step can be computed.
    #[inline(always)]
    pub(crate) fn has_failed(&self) -> bool {
        matches!(self.status, Status::Unreachable | Status::BadInput | Status::NotConverged)
    }

    /// Lanes whose analogues keep fewer than six digits.
    #[inline(always)]
    pub(crate) fn near_singular(&self, g: usize) -> R::Mask {
        R::splat(NEAR_SINGULAR_CONDITION * NEAR_SINGULAR_CONDITION).lt(self.conditions.greatest[g])
    }

    /// Marks the position as [`Status::BadInput`].
    pub(crate) fn set_bad_input(&mut self) {
        self.fault = None;
        self.status = Status::BadInput;
    }

    /// Marks the position as [`Status::Lost`].
    pub(crate) fn set_lost(&mut self) {
        self.fault = None;
        self.status = Status::Lost;
    }

    /// Marks the lanes where a step does not close; a single position then becomes unreachable.
    #[inline(always)]
    pub(crate) fn mark_open(&mut self, g: usize, open: R::Mask, fault: impl Fn() -> Fault) {
        self.conditions.needs_scalar[g] = self.conditions.needs_scalar[g].or(open);
        if R::LANES == 1 && open.any() {
            self.fault = Some(fault());
            self.status = Status::Unreachable;
        }
    }
}
