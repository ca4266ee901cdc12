//! Solves the positions of one design into their rows: as many at once as a register holds, and one
//! by one those that need special care.

use std::mem::MaybeUninit;
use std::sync::atomic::{AtomicBool, Ordering};

use super::designs::DesignRow;
use super::failure_log::FailureCounter;
use super::known_signs::KnownSigns;
use super::outputs::Column;
use super::request::Request;
use super::schedule::{Care, Control};
use super::work_space::WorkSpace;
use super::writer::{RowRange, RowSlices, Writer};
use crate::branch::branch::BranchLocation;
use crate::branch::design::Design;
use crate::branch::uniform::Traced;
use crate::math::angle::unwrap_to;
use crate::math::derivatives::DerivativeTables;
use crate::math::lanes::{Mask, Real};
use crate::plan::mechanism::Mechanism;
use crate::query::failure::Failure;
use crate::state::kernel::Level;
use crate::state::sensitivity::Sensitivity;
use crate::state::state::Context;
use crate::state::status::{Rejection, Status};

/// Blocks of a design with doubtful positions, after which all are computed carefully at once.
const MAX_DOUBTS: usize = 2;

/// Workspace of one thread, with registers of type `R` and blocks of `G` of them.
pub(crate) struct Worker<'a, R: Real, const G: usize> {
    pub(super) design: Design<'a>,
    pub(super) writer: &'a Writer<'a>,
    pub(super) columns: &'a [Column],
    pub(super) space: Box<WorkSpace<R, G>>,
    /// The dimension to differentiate by, with its workspace.
    by: Option<(usize, Sensitivity)>,
    care: Care,
    /// Whether the branch serves all positions of the job, without change points.
    pub(super) is_smooth: bool,
    /// Of the last job: its shared coordinates, and how far its driven slides reach.
    driven_reach: (Option<usize>, f64),
    /// When true, work stops after the block in progress.
    cancel: Option<&'a AtomicBool>,
    pub(super) failures: Option<FailureCounter<'a>>,
    known_signs: Option<&'a KnownSigns>,
}

/// Some positions of one design, and the rows they go to.
pub(crate) struct Job<'j, 'r> {
    /// Coordinates, drivers fastest, rad or m.
    pub q: &'j [f64],
    pub rows: &'j mut RowSlices<'r>,
    /// Row of the first position.
    pub first: usize,
    /// The same in the whole batch.
    pub index: usize,
    /// Index of the design.
    pub design: usize,
    /// Index of the first of these among the coordinates shared by all designs, if they are shared.
    pub shared: Option<usize>,
}

impl<'a, R: Real, const G: usize> Worker<'a, R, G> {
    pub(crate) fn new(
        mechanism: &'a Mechanism,
        request: &Request<'_>,
        derivatives: &'a DerivativeTables,
        writer: &'a Writer<'a>,
        columns: &'a [Column],
        control: &Control<'a>,
    ) -> Self {
        let mut design = Design::new(mechanism, request.signs, derivatives);
        if control.care == Care::Needed {
            design.trace_only(&writer.asked);
        }
        let plan = mechanism.plan();
        Self {
            space: WorkSpace::take(mechanism, derivatives, writer, columns),
            by: request.by.map(|index| (index, Sensitivity::new(plan, derivatives))),
            design,
            writer,
            columns,
            care: control.care,
            is_smooth: false,
            driven_reach: (None, 0.0),
            cancel: control.cancel,
            failures: control.failures.map(FailureCounter::new),
            known_signs: control.known_signs,
        }
    }

    /// Leaves the work space to later calls.
    pub(crate) fn finish(self) {
        self.space.keep(self.design.mechanism);
    }

    /// Whether the caller has cancelled the work.
    pub(super) fn is_cancelled(&self) -> bool {
        self.cancel.is_some_and(|flag| flag.load(Ordering::Relaxed))
    }

    /// Loads a design. Returns false if its dimensions are invalid: the job is then done, with its
    /// rows set to NaN and the status `BadDimension`.
    pub(crate) fn bind(&mut self, design: DesignRow<'_>, job: &mut Job<'_, '_>) -> bool {
        let mechanism = self.design.mechanism;
        let fault = || mechanism.dimensions().first_fault(design.dimensions);
        if let Some(fault) = (!design.is_valid).then(fault).flatten() {
            let count = job.q.len() / mechanism.q0().len();
            let status = Status::BadDimension as u8;
            job.rows.write_failed(self.columns, job.first, count, status);
            if let (Some(log), true) = (&self.failures, count > 0) {
                let q = &job.q[..mechanism.q0().len()];
                log.record(job.index, count, || Failure::of_dimension(fault, q));
            }
            return false;
        }
        let reach = self.driven_reach(job);
        self.design.bind_within(design.dimensions, design.scale, reach);
        true
    }

    /// The greatest value of a driven slide at any position of a job, m.
    fn driven_reach(&mut self, job: &Job<'_, '_>) -> f64 {
        let (shared, reach) = self.driven_reach;
        if shared.is_some() && shared == job.shared {
            return reach;
        }
        let mechanism = self.design.mechanism;
        let drivers = mechanism.q0().len();
        let slides = (0..drivers).filter(|&d| mechanism.plan().driven_slide(d).is_some());
        let values = slides.flat_map(|driver| job.q.iter().skip(driver).step_by(drivers));
        let reach = values.fold(0.0, |reach: f64, q| reach.max(q.abs()));
        self.driven_reach = (job.shared, reach);
        reach
    }

    /// Solves the positions of the design; only `dispatch` calls this. `trace`: [`Worker::trace`],
    /// compiled by itself.
    #[inline(always)]
    pub(crate) fn run<L: Level<Register = R>>(
        &mut self,
        job: &mut Job<'_, '_>,
        trace: fn(&mut Self, &Job<'_, '_>, bool) -> bool,
    ) {
        let mut surveyed = trace(self, job, self.by.is_none());
        let drivers = self.design.mechanism.q0().len();
        let count = job.q.len() / drivers;
        if let Some((index, mut by)) = self.by.take() {
            self.sensitivities(job, index, &mut by);
            self.by = Some((index, by));
            return;
        }
        if self.care != Care::Needed || drivers > 1 && !self.design.serves_all {
            self.solve_by_position(job, 0, count);
            return;
        }
        self.space.many.groups = count.div_ceil(R::LANES).min(G);
        if self.design.branch.has_constant_signs() {
            let signs = self.design.branch.signs_at(&BranchLocation::<f64>::default(), 0);
            for (lanes, &sign) in self.space.many.pose.signs.iter_mut().zip(signs) {
                lanes[..self.space.many.groups].fill(R::splat(sign));
            }
        }
        self.load_coordinates(job);
        if surveyed && self.space.coordinates.is_far {
            surveyed = trace(self, job, false);
        }
        // Bare analogues are for one driver.
        let bare = drivers == 1 || self.space.many.len == 1;
        let mut doubts = if bare && (surveyed || self.is_plain()) { 0 } else { MAX_DOUBTS };
        if doubts < MAX_DOUBTS {
            let design = &self.design;
            let cx = Context { tape: &self.space.tape, ..design.context(design.derivatives) };
            self.space.many.prepare_bare(&cx);
        }
        let mut prepared = false;
        let mut located = !surveyed && (doubts == MAX_DOUBTS || self.find_references());
        if located {
            self.locate();
        }
        job.rows.status[job.first..job.first + count].fill(MaybeUninit::new(Status::Ok as u8));
        for row in (0..count).step_by(G * R::LANES) {
            if self.is_cancelled() {
                return;
            }
            let block = (count - row).min(G * R::LANES);
            if self.space.coordinates.by_position(row / (G * R::LANES)) {
                self.solve_by_position(job, row, block);
                continue;
            }
            if doubts < MAX_DOUBTS && self.solve_bare::<L>(job, row, block, located) {
                continue;
            }
            if !prepared {
                let plan = self.design.mechanism.plan();
                self.space.many.prepare(plan, &self.design.constants, self.design.derivatives);
                prepared = true;
            }
            if !located {
                if surveyed {
                    trace(self, job, false);
                }
                self.locate();
                located = true;
            }
            doubts =
                if bare && self.is_plain() { (doubts + 1).min(MAX_DOUBTS) } else { MAX_DOUBTS };
            self.solve_block::<L>(job, row, block);
        }
    }

    /// Traces the branch. True if it is only known to be plain, which `plain` permits.
    #[inline(always)]
    pub(super) fn trace<L: Level<Register = R>>(&mut self, job: &Job<'_, '_>, plain: bool) -> bool {
        if self.has_known_signs(job.design) {
            self.design.set_constant_signs();
            self.is_smooth = true;
            return false;
        }
        let mut traced = Traced::No;
        // The first guess of a group's iteration depends on how its branch was traced.
        if self.care == Care::Needed || self.design.has_groups() {
            let plain = plain && self.care == Care::Needed && self.space.tape.is_bounded;
            let mut references = plain.then_some(&mut self.space.references[..]);
            let (design, classes) = (&mut self.design, &self.writer.classes);
            traced = design.trace_in_closed_form(classes, references.as_deref_mut());
            if traced == Traced::No {
                let uniform =
                    self.space.uniform.get_or_insert_with(|| Box::new(design.uniform_tracer()));
                traced = design.trace_in_lanes::<L, G>(uniform, classes, references);
            }
        }
        if traced == Traced::No {
            match self.care {
                Care::Always => self.design.trace(job.q),
                _ => self.design.trace_knot_by_knot(job.q),
            }
        }
        if let Some(known) = self.known_signs
            && self.design.has_constant_signs()
        {
            known.set_constant(job.design);
        }
        self.is_smooth = self.design.is_smooth(job.q);
        traced == Traced::Surveyed
    }

    /// Whether nothing but the signs is wanted of the branch, and they are known to be constant.
    #[inline(always)]
    fn has_known_signs(&self, design: usize) -> bool {
        let wanted = self.care == Care::Needed && self.writer.classes.is_empty();
        wanted && self.known_signs.is_some_and(|known| known.are_constant(design))
    }

    /// Loads the coordinates into registers; those that all designs share are kept.
    #[inline(always)]
    fn load_coordinates(&mut self, job: &Job<'_, '_>) {
        if self.space.coordinates.load(job.q, job.shared, &self.design) {
            self.space.locations.clear();
        }
    }

    /// Locates the coordinates among the knots of the branch.
    #[inline(always)]
    pub(super) fn locate(&mut self) {
        let branch = &self.design.branch;
        // Uniform branches have the same knots for all designs.
        if branch.inverse_width.is_none() || !self.space.locations_even {
            self.space.locations.clear();
        }
        self.space.locations_even = branch.inverse_width.is_some();
        if branch.at.is_empty() {
            // There is nothing to locate.
            self.space
                .locations
                .resize_with(self.space.coordinates.registers, BranchLocation::default);
        } else if self.space.locations.is_empty() {
            for register in 0..self.space.coordinates.registers {
                self.space.locations.push(branch.locate(self.space.coordinates.q(0, register)));
            }
        }
    }

    /// Lanes that must be solved again by themselves, whatever the vector solution gives.
    #[inline(always)]
    fn lanes_to_redo(&self, q: R, location: &BranchLocation<R>, with_islands: bool) -> R::Mask {
        let branch = &self.design.branch;
        let must_redo = |i: usize| {
            let at = q.lane(i);
            !branch.covers(at)
                || with_islands && branch.in_untraced_island(location, i)
                || branch.change_near(at, self.design.change_window.reach).is_some()
        };
        mask::<R>(must_redo)
    }

    /// Solves up to `G` registers of positions from `row` on.
    #[inline(always)]
    fn solve_block<L: Level<Register = R>>(
        &mut self,
        job: &mut Job<'_, '_>,
        row: usize,
        count: usize,
    ) {
        let (first, groups) = (row / R::LANES, count.div_ceil(R::LANES));
        let mut care = [R::Mask::NONE; G];
        let branch = &self.design.branch;
        let closed_forms = self.design.closed_forms;
        let constant_signs = branch.has_constant_signs();
        let (even, smooth) = (branch.inverse_width.is_some(), self.is_smooth);
        for group in 0..groups {
            let q = self.space.coordinates.q(0, first + group);
            let location = &self.space.locations[first + group];
            if !(even || smooth && closed_forms) {
                care[group] = self.lanes_to_redo(q, location, !closed_forms);
            }
            let branch = &self.design.branch;
            // Lanes to redo are set to NaN: their vector result is not used.
            for driver in 0..self.space.many.pose.q.len() {
                let q = self.space.coordinates.q(driver, first + group);
                self.space.many.pose.q[driver][group] =
                    R::select(care[group], R::splat(f64::NAN), q);
                self.space.many.pose.unit[driver][group] =
                    self.space.coordinates.unit(driver, first + group);
            }
            if !constant_signs {
                for (sign, groups) in self.space.many.pose.signs.iter_mut().enumerate() {
                    groups[group] = R::from_lanes(|i| branch.signs_at(location, i)[sign]);
                }
            }
        }
        let design = &self.design;
        self.space.many.groups = groups;
        if !closed_forms {
            for group in 0..groups.min(G) {
                let location = &self.space.locations[first + group];
                design.guess(group, &mut self.space.many, &design.branch, location);
            }
        }
        let cx = Context { tape: &self.space.tape, ..design.context(design.derivatives) };
        L::solve(&mut self.space.many, &cx);
        let state = &self.space.many;
        // A separate loop: independent arctangents overlap.
        for &class in &self.writer.classes {
            for g in 0..groups.min(G) {
                self.space.lifted[class][g] = state.pose.class[class][g].unit_angle();
            }
        }
        for &class in &self.writer.classes {
            for (location, lifted) in
                self.space.locations[first..].iter().zip(&mut self.space.lifted[class])
            {
                *lifted = unwrap_to(*lifted, design.branch.reference_angle(location, class));
            }
        }
        let at = job.first + row;
        let with = (&design.constants, &design.units);
        let (mut open, mut some_open, mut again) = ([R::Mask::NONE; G], false, false);
        for group in 0..groups.min(G) {
            care[group] = care[group].or(self.space.coordinates.q(0, first + group).finite().not());
            if closed_forms {
                open[group] = state.conditions.open[group].and(care[group].not());
                some_open |= open[group].any();
                if !(even || self.writer.classes.is_empty()) {
                    // The angle on an island that no knot has seen has to be followed to it.
                    let location = &self.space.locations[first + group];
                    let unseen = |i: usize| {
                        !open[group].lane(i) && design.branch.in_untraced_island(location, i)
                    };
                    care[group] = care[group].or(mask::<R>(unseen));
                }
            }
            care[group] =
                care[group].or(state.conditions.needs_scalar[group].and(open[group].not()));
            care[group] = care[group].or(design.branch.same_det_sign(state, group).not());
            again |= care[group].any();
        }
        let failed = some_open.then_some(&open);
        let range = RowRange { first: at, count, once: false };
        self.writer.write(job.rows, range, with, state, &self.space.lifted, failed);
        let status = &mut job.rows.status[at..at + count];
        for (group, status) in status.chunks_mut(R::LANES).enumerate() {
            let near = state.near_singular(group);
            if !near.or(open[group]).any() {
                continue;
            }
            for (lane, status) in status.iter_mut().enumerate() {
                if open[group].lane(lane) {
                    *status = MaybeUninit::new(Status::Unreachable as u8);
                } else if near.lane(lane) {
                    *status = MaybeUninit::new(Status::NearSingular as u8);
                }
            }
        }
        if some_open && let Some(log) = &mut self.failures {
            for place in 0..count {
                let (group, lane) = (place / R::LANES, place % R::LANES);
                if open[group].lane(lane) && !log.count_later(job.index + row + place, 1) {
                    // It has to be described.
                    care[group] = care[group].or(mask::<R>(|i| i == lane));
                    again = true;
                }
            }
        }
        if again {
            self.solve_lanes(job, row, count, &care);
        }
    }

    /// Solves some lanes of a block one by one.
    #[inline(always)]
    fn solve_lanes(
        &mut self,
        job: &mut Job<'_, '_>,
        row: usize,
        count: usize,
        lanes: &[R::Mask; G],
    ) {
        for place in 0..count {
            if self.is_cancelled() {
                return;
            }
            if lanes[place / R::LANES].lane(place % R::LANES) {
                self.solve_scalar(job, row + place);
            }
        }
    }

    /// Solves positions one by one.
    fn solve_by_position(&mut self, job: &mut Job<'_, '_>, first: usize, count: usize) {
        for row in first..first + count {
            if self.is_cancelled() {
                return;
            }
            self.solve_scalar(job, row);
        }
    }

    /// Solves one position by itself.
    #[cold]
    #[inline(never)]
    fn solve_scalar(&mut self, job: &mut Job<'_, '_>, row: usize) {
        let drivers = self.design.mechanism.q0().len();
        let q = self.design.scaled(&job.q[row * drivers..][..drivers]);
        let place = self.design.branch_to(&q);
        let state = &mut self.space.one;
        let analogues = self.design.solve(state, &q, place.as_ref());
        let at = job.first + row;
        let solved = matches!(state.status, Status::Ok | Status::NearSingular | Status::Singular);
        let no_analogues = !analogues && self.columns.iter().any(|column| column.order > 0);
        if let (Some(log), true) = (&self.failures, !solved || no_analogues) {
            let (status, fault) = (state.status, state.fault);
            let q = &job.q[row * drivers..][..drivers];
            let describe = || Failure::of(&self.design, Rejection::Failed { status, fault }, q);
            log.record(job.index + row, 1, describe);
        }
        let (true, Some(place)) = (solved, &place) else {
            job.rows.write_failed(self.columns, at, 1, state.status as u8);
            return;
        };
        let near = self.design.reference_angles(place, self.space.lifted.len());
        let lift = |class: usize| [unwrap_to(state.pose.class[class][0].unit_angle(), near[class])];
        let lifted: Vec<[f64; 1]> = (0..near.len()).map(lift).collect();
        let with = (&self.design.constants, &self.design.units);
        self.writer.write(job.rows, RowRange::single(at), with, state, &lifted, None);
        if !analogues {
            job.rows.write_nan(self.columns, 1, at, 1);
        }
        job.rows.status[at] = MaybeUninit::new(state.status as u8);
    }

    /// Differentiates by a dimension, one position after another.
    #[cold]
    #[inline(never)]
    fn sensitivities(&mut self, job: &mut Job<'_, '_>, index: usize, by: &mut Sensitivity) {
        let design = &self.design;
        let drivers = design.mechanism.q0().len();
        let cx = design.context(design.derivatives);
        let rate = design.rate(index);
        let nothing = vec![[0.0]; self.space.lifted.len()];
        for (row, q) in job.q.chunks_exact(drivers).enumerate() {
            if self.is_cancelled() {
                return;
            }
            let q = design.scaled(q);
            let place = design.branch_to(&q);
            let state = &mut self.space.one;
            design.solve(state, &q, place.as_ref());
            let at = job.first + row;
            let status = state.status;
            job.rows.write_failed(self.columns, at, 1, status as u8);
            let solved = matches!(status, Status::Ok | Status::NearSingular);
            if solved && by.solve(state, &cx, &rate) {
                // A dimension that moves the frame's origin moves all points with it.
                for point in by.rates.pose.points.chunks_exact_mut(design.derivatives.len()) {
                    point[0][0] += rate.origin.scale(1.0 / design.constants.scale);
                }
                let with = (&design.constants, &design.units);
                self.writer.write(job.rows, RowRange::single(at), with, &by.rates, &nothing, None);
                job.rows.status[at] = MaybeUninit::new(status as u8);
            }
        }
    }
}

/// The lanes of which something is true.
#[inline(always)]
pub(super) fn mask<R: Real>(of: impl Fn(usize) -> bool) -> R::Mask {
    R::ZERO.lt(R::from_lanes(|lane| if of(lane) { 1.0 } else { 0.0 }))
}
