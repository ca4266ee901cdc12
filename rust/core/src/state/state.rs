//! State of one position of a design, or of several at once: points, orientations and slides with
//! their analogues.

use std::sync::atomic::{AtomicBool, Ordering};

use super::closing::Closing;
use super::status::{Fault, Status};
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
    /// Whether it was interpolated, so that even the values that all positions share carry rounding.
    pub(crate) is_interpolated: bool,
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
    /// Once it is true, tracing along a branch ends.
    pub cancel: Option<&'a AtomicBool>,
}

impl Context<'_> {
    /// Whether work along a branch must end without a result.
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
            is_interpolated: false,
            status: Status::Ok,
            fault: None,
        }
    }

    /// Sets, in the lane groups in use, the data of the unchecked path that all positions of a design share.
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
                let is_rate = derivatives.driver_of[k] == Some(driver);
                let rate = if is_rate { R::ONE } else { R::ZERO };
                self.pose.slides[slide * self.len + k][..groups].fill(rate);
            }
        }
    }

    /// Sets, in the lane groups in use, the data that all positions of a design share; call it before the
    /// first of them.
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
        self.is_interpolated = false;
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

/// Coordinates, assembly, and the pose that follows from them.
#[derive(Debug, Clone)]
pub(crate) struct Pose<R: Real = f64, const G: usize = 1> {
    /// Coordinates (rad; slide drivers in units of the scale).
    pub(crate) q: Vec<[R; G]>,
    /// Unit vectors at the driven angles.
    pub(crate) unit: Vec<[Vector<R>; G]>,
    /// Assembly signs, +1 or −1.
    pub(crate) signs: Vec<[R; G]>,
    /// Jets of points, one after another.
    pub(crate) points: Vec<[Vector<R>; G]>,
    /// Jets of orientations.
    pub(crate) orient: Vec<[Vector<R>; G]>,
    /// Jets of the legs of dyads (two per dyad), then of the edges of groups.
    pub(crate) legs: Vec<[Vector<R>; G]>,
    /// Jets of the angles of classes; entry 0, the value, is not used.
    pub(crate) theta: Vec<[R; G]>,
    /// Jets of slides.
    pub(crate) slides: Vec<[R; G]>,
    /// Rotations of classes.
    pub(crate) class: Vec<[Vector<R>; G]>,
    /// Rotation of every orientation by the drivers alone.
    pub(crate) phase: Vec<[Vector<R>; G]>,
}

impl<R: Real, const G: usize> Pose<R, G> {
    fn new(plan: &Plan, derivatives: &DerivativeTables) -> Self {
        let (len, slides) = (derivatives.len(), plan.slide_links.len());
        let mut orient = vec![[Vector::ZERO; G]; plan.orientations.len() * len];
        for (orientation, jet) in plan.orientations.iter().zip(orient.chunks_exact_mut(len)) {
            if orientation.class == 0 {
                jet[0] = [Vector::ONE; G];
            }
        }
        Self {
            q: vec![[R::ZERO; G]; plan.drivers.len()],
            unit: vec![[Vector::ONE; G]; plan.drivers.len()],
            signs: vec![[R::ONE; G]; plan.signs()],
            points: vec![[Vector::ZERO; G]; plan.points * len],
            orient,
            legs: vec![[Vector::ZERO; G]; plan.legs() * len],
            theta: vec![[R::ZERO; G]; plan.classes * len],
            slides: vec![[R::ZERO; G]; slides * len],
            class: vec![[Vector::ONE; G]; plan.classes],
            phase: vec![[Vector::ONE; G]; plan.orientations.len()],
        }
    }
}

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
    /// The margin with which each dyad closes (relative to the scale), negative where it does not close.
    pub(crate) margin: Vec<[R; G]>,
    /// Lanes where a dyad does not close.
    pub(crate) open: [R::Mask; G],
    /// Lanes that failed or are singular; the caller solves each again as a single position.
    pub(crate) needs_scalar: [R::Mask; G],
}

impl<R: Real, const G: usize> Conditions<R, G> {
    fn new(plan: &Plan) -> Self {
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

/// Work space of the path with checks and of the iteration for groups above class II, with the results
/// that the branch checks.
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
    /// Whether the caller needs the rotation of each class; used for bars that no step needs.
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
    fn new(plan: &Plan, derivatives: &DerivativeTables) -> Self {
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
