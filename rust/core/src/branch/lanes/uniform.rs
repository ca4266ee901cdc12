//! The uniform branch: the branch of a driven angle on evenly spaced knots, solved in lanes. It needs
//! a full turn without dead points, change points and links that turn fast; any other branch is left
//! to [`BranchTracer`](super::super::tracer::BranchTracer). Both use the same knots.
//!
//! With groups above class II, a design near the drawing moves much like the drawing. So the
//! iteration starts at all knots at once from the drawing's unknowns. Its results must pass the
//! same checks as the tracer's knots: each is predicted from the one before, and the first must be
//! near the drawing's. How far a prediction may be off does not depend on the distance of the knots: where
//! there are only groups, half as many knots are tried first.

use std::cell::OnceCell;
use std::f64::consts::{PI, TAU};

use super::grid::{Grid, KNOTS, knots_at, previous};
use super::reference_branch::ReferenceBranch;
use crate::branch::branch::Branch;
use crate::branch::knot::{SignInterval, may_touch};
use crate::math::angle::{Reference, turns_between, unwrap_to, whole_turns};
use crate::math::derivatives::DerivativeTables;
use crate::math::lanes::{Mask, Real};
use crate::math::tolerance::KNOT_MAX_TURN;
use crate::math::vector::Vector;
use crate::plan::dyad::{Form, Unknown};
use crate::plan::plan::Plan;
use crate::state::dyad::sample::DyadSample;
use crate::state::kernel::Level;
use crate::state::state::{Context, State};

/// Cosine of [`KNOT_MAX_TURN`].
const COS_MAX_TURN: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// The result of tracing a branch in closed form or by knots in lanes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Traced {
    /// The design needs the tracer.
    No,
    /// The design needs no checks: its signs are the same everywhere, and each requested angle has a
    /// reference. Angles at knots are not known.
    Surveyed,
    /// The design needs no checks; the branch has a reference of each requested angle for every cell, at the
    /// evenly spaced knot before it.
    AtKnots,
    /// All signs and requested angles are known.
    Whole,
}

/// Work space: the data of every knot that the checks need. `G` registers hold at least all knots.
#[derive(Debug)]
pub(crate) struct UniformTracer<R: Real, const G: usize> {
    /// All knots.
    pub(crate) state: State<R, G>,
    /// Whether the knots were solved with checks.
    is_checked: bool,
    /// Whether the driver is an angle.
    is_angle: bool,
    /// The knots that were solved last.
    grid: Grid,
    /// Drawing's angle for which the knots of turns below are set; the same for all designs.
    q0: f64,
    /// Angles of the driver and their unit vectors: of a turn, and of one in wide cells.
    knots: [Vec<(R, Vector<R>)>; 2],
    /// Square of the discriminant of every dyad with a sign at the last knot, and its rate.
    squares: Vec<(f64, f64)>,
    /// Angle of every class at the last knot, and its whole turns up to there.
    pub(crate) last_angles: Vec<(f64, f64)>,
    /// With groups: the classes whose angles are unwrapped.
    unwrapped: Vec<usize>,
    /// For every dyad of two guides: on which side of parallel these are at the knots before.
    guide_sides: Vec<bool>,
    /// Unknowns of groups at the knots of the drawing's branch; computed once.
    pub(crate) reference: OnceCell<Option<ReferenceBranch<R, G>>>,
}

impl<R: Real, const G: usize> UniformTracer<R, G> {
    /// Work space for a plan; `derivatives` are for one driver.
    pub(crate) fn new(plan: &Plan, derivatives: &DerivativeTables) -> Self {
        let state = State::new(plan, derivatives);
        Self {
            state,
            is_checked: true,
            is_angle: plan.driven_slide(0).is_none(),
            grid: Grid::turn(f64::NAN),
            q0: f64::NAN,
            knots: [const { Vec::new() }; 2],
            squares: vec![(0.0, 0.0); plan.signs()],
            last_angles: vec![(0.0, 0.0); plan.classes],
            unwrapped: Vec::new(),
            guide_sides: Vec::new(),
            reference: OnceCell::new(),
        }
    }

    /// The drawing's branch, if other branches can start from it.
    pub(in crate::branch) fn reference(
        &self,
        make: impl FnOnce() -> Option<ReferenceBranch<R, G>>,
    ) -> Option<&ReferenceBranch<R, G>> {
        self.reference.get_or_init(make).as_ref()
    }

    /// The knots that were solved last.
    pub(in crate::branch) fn grid(&self) -> Grid {
        self.grid
    }

    /// Solves all knots of a grid.
    #[inline(always)]
    pub(in crate::branch) fn solve_knots<L: Level<Register = R>>(
        &mut self,
        cx: &Context<'_>,
        grid: Grid,
        angles: bool,
    ) {
        self.grid = grid;
        self.state.groups = grid.count / R::LANES;
        if grid.is_turn {
            if self.q0 != grid.from {
                self.set_knots(grid.from);
            }
            let knots = &self.knots[usize::from(grid.is_wide())];
            for (group, &(at, unit)) in knots.iter().enumerate().take(G) {
                self.state.pose.q[0][group] = at;
                self.state.pose.unit[0][group] = unit;
            }
        } else {
            for group in 0..self.state.groups.min(G) {
                self.set_group(group, |lane| grid.at(lane));
            }
        }
        // Fill as many registers as closer scans may take, which are more than those of a short grid.
        for (lanes, &sign) in self.state.pose.signs.iter_mut().zip(cx.signs) {
            lanes[..(KNOTS / R::LANES).min(G)].fill(R::splat(sign));
        }
        self.guess(cx);
        self.solve::<L>(cx, angles);
    }

    /// Solves the knots that are set. If `angles` are requested and some knot may be flat or beyond a
    /// dead point, solves all with checks: angles there are those of the flat dyad. Samples of dyads need
    /// no checks, because they follow from the chords, whether or not the dyads close.
    #[inline(always)]
    pub(crate) fn solve<L: Level<Register = R>>(&mut self, cx: &Context<'_>, angles: bool) {
        self.is_checked = !cx.tape.is_bounded;
        if !self.is_checked {
            self.state.prepare_unchecked(cx);
            L::unchecked(&mut self.state, cx);
            self.is_checked = angles && (self.state.is_uncertain() || self.state.has_open());
        }
        if self.is_checked {
            self.solve_checked::<L>(cx);
        }
    }

    /// Solves the knots again, with checks, if some may be flat.
    #[inline(always)]
    pub(crate) fn check_uncertain<L: Level<Register = R>>(&mut self, cx: &Context<'_>) {
        if !self.is_checked && self.state.is_uncertain() {
            self.solve_checked::<L>(cx);
        }
    }

    /// Sets positions in place of the knots.
    #[inline(always)]
    pub(in crate::branch) fn set_at(&mut self, at: &[f64]) {
        self.state.groups = at.len().div_ceil(R::LANES);
        for group in 0..self.state.groups.min(G) {
            self.set_group(group, |lane| at[lane.min(at.len() - 1)]);
        }
    }

    /// Sets a register of positions, given the coordinate at each.
    #[inline(always)]
    pub(in crate::branch) fn set_group(&mut self, group: usize, at: impl Fn(usize) -> f64) {
        let at = R::from_lanes(|lane| at(group * R::LANES + lane));
        self.state.pose.q[0][group] = at;
        if self.is_angle {
            self.state.pose.unit[0][group] = Vector::at_angle(at);
        }
    }

    /// Solves the knots that are set, with checks.
    #[inline(always)]
    pub(crate) fn solve_checked<L: Level<Register = R>>(&mut self, cx: &Context<'_>) {
        self.is_checked = true;
        self.state.prepare(cx.plan, cx.constants, cx.derivatives);
        L::solve(&mut self.state, cx);
    }

    /// Knots that do not close or are flat.
    #[inline(always)]
    pub(crate) fn not_closed(&self, group: usize) -> R::Mask {
        let open = self.state.conditions.open[group];
        if self.is_checked { self.state.conditions.needs_scalar[group].or(open) } else { open }
    }

    /// Traces the turn whose knots have been solved into `branch`; false if the tracer is needed.
    #[inline(always)]
    pub(crate) fn trace(
        &mut self,
        cx: &Context<'_>,
        classes: &[usize],
        start: &[f64],
        branch: &mut Branch,
    ) -> bool {
        let has_groups = self.reference.get().is_some();
        if has_groups {
            self.set_unwrapped(cx.plan, classes);
        }
        let unwrapped = std::mem::take(&mut self.unwrapped);
        let classes = if has_groups { &unwrapped[..] } else { classes };
        let traced = self.trace_classes(cx, (classes, has_groups), start, branch);
        self.unwrapped = unwrapped;
        traced
    }

    /// With groups: the requested classes, and those of the groups' unknowns.
    fn set_unwrapped(&mut self, plan: &Plan, classes: &[usize]) {
        self.unwrapped.clear();
        self.unwrapped.extend_from_slice(classes);
        for unknown in plan.groups().flat_map(|group| &group.unknowns) {
            if let Unknown::Class(class) = *unknown
                && !classes.contains(&class)
            {
                self.unwrapped.push(class);
            }
        }
    }

    /// Traces with the angles of `classes`; with `with_others`, checks that all other angles turn slowly.
    #[inline(always)]
    fn trace_classes(
        &mut self,
        cx: &Context<'_>,
        (classes, with_others): (&[usize], bool),
        start: &[f64],
        branch: &mut Branch,
    ) -> bool {
        self.guide_sides.clear();
        branch.at.clear();
        let (count, cell) = (self.grid.count, self.grid.cell);
        branch.angles.resize(count * start.len(), 0.0);
        // Before the first knot there is only the drawing.
        self.squares.fill((0.0, 0.0));
        for (last, &angle) in self.last_angles.iter_mut().zip(start) {
            *last = (angle, 0.0);
        }
        for group in 0..(count / R::LANES).min(G) {
            if !(self.check_knots(cx, group) && self.unwrap(group, classes, &mut branch.angles)) {
                return false;
            }
            if with_others && !self.others_turn_slowly(group, classes) {
                return false;
            }
            let at = self.state.pose.q[0][group];
            branch.at.extend((0..R::LANES).map(|lane| at.lane(lane)));
        }
        if !self.build_cells(cx, branch) {
            return false;
        }
        let classes = start.len();
        branch.gain.clear();
        for class in 0..classes {
            let (a, b) = (branch.angles[class], branch.angles[(count - 1) * classes + class]);
            branch.gain.push(TAU * whole_turns(b - a));
        }
        branch.reached.clear();
        branch.reached.resize(count, true);
        branch.changes.clear();
        branch.sign_intervals.resize_with(1, SignInterval::default);
        branch.sign_intervals[0].from = f64::NEG_INFINITY;
        branch.sign_intervals[0].signs.clear();
        branch.sign_intervals[0].signs.extend_from_slice(cx.signs);
        branch.period = Some(TAU);
        branch.covered = None;
        branch.inverse_width = Some(1.0 / cell);
        true
    }

    #[inline(always)]
    fn set_knots(&mut self, q0: f64) {
        self.q0 = q0;
        for (knots, turn) in self.knots.iter_mut().zip([Grid::turn(q0), Grid::wide_turn(q0)]) {
            knots.clear();
            for first in (0..turn.count).step_by(R::LANES) {
                let at = knots_at(&turn, first);
                knots.push((at, Vector::at_angle(at)));
            }
        }
    }

    /// Checks a register of knots, one after another; false if something may happen between them.
    #[inline(always)]
    fn check_knots(&mut self, cx: &Context<'_>, group: usize) -> bool {
        let state = &self.state;
        let mut lines = 0;
        let mut suspect = self.not_closed(group);
        for (index, dyad) in cx.plan.dyads().enumerate() {
            let DyadSample { square, rate, side, .. } =
                state.sample(group, cx, dyad, &cx.tape.ops[cx.tape.dyads[index]]);
            match dyad.sign {
                Some(sign) => {
                    let (last, last_rate) = self.squares[sign];
                    let before = (previous(last, square), previous(last_rate, rate));
                    suspect =
                        suspect.or(may_touch(before, (square, rate), R::splat(self.grid.cell)));
                    // A dyad that no requested quantity depends on is sampled, but not solved.
                    suspect = suspect.or(R::ZERO.lt(square).not());
                    self.squares[sign] = (square.lane(R::LANES - 1), rate.lane(R::LANES - 1));
                }
                None if dyad.form == Form::TwoLines => {
                    let positive = R::ZERO.lt(side);
                    let side = positive.any();
                    if group == 0 {
                        self.guide_sides.push(side);
                    }
                    if side != positive.all() || self.guide_sides[lines] != side {
                        return false;
                    }
                    lines += 1;
                }
                None => {}
            }
        }
        !suspect.any()
    }

    /// Shows without unwrapping angles knot by knot whether the design does not need checks: every knot can be
    /// reached, signs cannot change between two, and requested angles turn neither fast nor far. `None` if it
    /// needs checks; false if only an angle fails. Sets the reference of each class.
    #[inline(always)]
    pub(crate) fn survey(
        &mut self,
        cx: &Context<'_>,
        classes: &[usize],
        start: &[f64],
        references: &mut [Reference],
    ) -> Option<bool> {
        self.guide_sides.clear();
        self.squares.fill((0.0, 0.0));
        for group in 0..(KNOTS / R::LANES).min(G) {
            if !self.check_knots(cx, group) {
                return None;
            }
        }
        for &class in classes {
            let Some(range) = self.range(class, start[class]) else { return Some(false) };
            let Some(reference) = reference_of(range) else { return Some(false) };
            references[class] = reference;
        }
        Some(true)
    }

    /// The least and greatest angle of a class at the knots, if its link turns slowly and stays within
    /// half a turn of its angle at the drawing's coordinate, which is unwrapped to `start`.
    #[inline(always)]
    fn range(&self, class: usize, start: f64) -> Option<[f64; 2]> {
        let (units, rates) =
            (&self.state.pose.class[class], &self.state.pose.theta[self.state.len * class + 1]);
        let at = self.grid.home;
        let home = unwrap_to(units[at / R::LANES].unit_angle().lane(at % R::LANES), start);
        let near = R::splat(home);
        let (mut low, mut high) = (near, near);
        let mut last = unwrap_to(units[0].unit_angle(), near);
        last = R::splat(last.lane(0));
        let mut slow = R::Mask::NONE.not();
        for group in 0..(KNOTS / R::LANES).min(G) {
            let angle = unwrap_to(units[group].unit_angle(), near);
            let step = angle - previous(last.lane(R::LANES - 1), angle);
            let rate = rates[group] * R::splat(self.grid.cell);
            let limit = R::splat(KNOT_MAX_TURN);
            slow = slow.and(step.abs().le(limit)).and(rate.abs().le(limit));
            (low, high) = (low.min(angle), high.max(angle));
            last = angle;
        }
        if !slow.all() {
            return None;
        }
        let mut range = [home; 2];
        for lane in 0..R::LANES {
            range = [range[0].min(low.lane(lane)), range[1].max(high.lane(lane))];
        }
        Some(range)
    }

    /// Whether the links of all other classes turn slowly between the knots of a register and those
    /// before. Groups are predicted with all of them.
    #[inline(always)]
    fn others_turn_slowly(&self, group: usize, classes: &[usize]) -> bool {
        let mut slow = R::Mask::NONE.not();
        for class in (0..self.last_angles.len()).filter(|class| !classes.contains(class)) {
            let units = &self.state.pose.class[class];
            let unit = units[group];
            // The first knot may be far from the drawing's own angle.
            let last = if group == 0 {
                Vector::splat(Vector::new(unit.x.lane(0), unit.y.lane(0)))
            } else {
                units[group - 1]
            };
            let end = R::LANES - 1;
            let before =
                Vector::new(previous(last.x.lane(end), unit.x), previous(last.y.lane(end), unit.y));
            let rate =
                self.state.pose.theta[self.state.len * class + 1][group] * R::splat(self.grid.cell);
            slow = slow
                .and(R::splat(COS_MAX_TURN).le(before.dot(unit)))
                .and(rate.abs().le(R::splat(KNOT_MAX_TURN)));
        }
        slow.all()
    }

    /// Unwraps the angles of a register of knots; false if a link turns fast there.
    #[inline(always)]
    fn unwrap(&mut self, group: usize, classes: &[usize], angles: &mut [f64]) -> bool {
        let count = self.last_angles.len();
        let first = group * R::LANES * count;
        let Some(angles) = angles.get_mut(first..first + R::LANES * count) else { return false };
        let mut max_turn = R::splat(KNOT_MAX_TURN);
        if group == 0 {
            // The first knot may be far from the drawing's own angle.
            max_turn = R::from_lanes(|i| if i == 0 { f64::INFINITY } else { KNOT_MAX_TURN });
        }
        let mut fast = R::Mask::NONE;
        for &class in classes {
            let angle = self.state.pose.class[class][group].unit_angle();
            let (last, mut whole_turns) = self.last_angles[class];
            let before = previous(last, angle);
            let turns = turns_between(angle, before);
            let step = (angle + R::splat(TAU) * turns) - before;
            let rate =
                self.state.pose.theta[self.state.len * class + 1][group] * R::splat(self.grid.cell);
            fast = fast.or(max_turn.lt(step.abs())).or(R::splat(KNOT_MAX_TURN).lt(rate.abs()));
            let unwrapped = angle + R::splat(TAU * whole_turns);
            let passes_half = turns.abs().le(R::ZERO).not().any();
            for (lane, knot) in angles.chunks_exact_mut(count).enumerate() {
                knot[class] = unwrapped.lane(lane);
                if passes_half {
                    whole_turns += turns.lane(lane);
                    knot[class] = angle.lane(lane) + TAU * whole_turns;
                }
            }
            self.last_angles[class] = (angle.lane(R::LANES - 1), whole_turns);
        }
        !fast.any()
    }
}

/// A reference for all angles whose values at the knots are in a range; `None` if it is too wide.
pub(crate) fn reference_of([low, high]: [f64; 2]) -> Option<Reference> {
    // Between two knots an angle leaves the range by less than one step.
    let margin = KNOT_MAX_TURN;
    if -PI < low - margin && high + margin < PI {
        return Some(Reference::Principal);
    }
    (high - low <= TAU - 2.0 * margin).then_some(Reference::Near(0.5 * (low + high)))
}
