//! Solves the positions of one design into their rows: in blocks of lanes, and one by one where a
//! lane cannot decide.

use std::mem::MaybeUninit;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use super::chunks::DesignRow;
use super::failure_log::FailureCounter;
use super::known_signs::KnownSigns;
use super::request::{Column, Request};
use super::rows::RowSlices;
use super::schedule::{Checks, Control};
use super::work_space::WorkSpace;
use super::writer::Writer;
use crate::branch::design::Design;
use crate::branch::lanes::uniform::Traced;
use crate::branch::location::BranchLocation;
use crate::math::derivatives::{DerivativeTables, TWO_DRIVERS};
use crate::math::lanes::Real;
use crate::plan::mechanism::Mechanism;
use crate::query::failure::Failure;
use crate::state::kernel::Level;
use crate::state::state::Context;
use crate::state::status::Status;

/// Uncertain blocks of one design after which the rest takes the checked path directly.
const MAX_UNCERTAIN: usize = 2;

/// An empty range.
const NOWHERE: [f64; 2] = [f64::INFINITY, f64::NEG_INFINITY];

/// Solver of one thread, with blocks of `G` registers `R`.
pub(crate) struct Worker<'a, R: Real, const G: usize> {
    pub(super) design: Design<'a>,
    pub(super) writer: &'a Writer,
    pub(super) columns: &'a [Column],
    pub(super) space: Box<WorkSpace<R, G>>,
    checks: Checks,
    /// Whether the branch serves all positions of the job and has no change points.
    pub(super) is_smooth: bool,
    /// Whether the branch of a driven slide was traced by knots that depend on the requested positions.
    pub(super) depends_on_request: bool,
    /// The last job's offset into the shared coordinates, and its range of driven slides' values, m.
    driven_range: (Option<usize>, [f64; 2]),
    /// When true, work stops after the block in progress.
    cancel: Option<&'a AtomicBool>,
    pub(super) failures: Option<FailureCounter<'a>>,
    known_signs: Option<&'a KnownSigns>,
}

/// How a design, or its next block, is solved, and the reason.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Path {
    /// Without checks, because signs are constant and all dyads have kernels; no requested angle makes
    /// whole turns, so that one reference each unwraps it.
    UncheckedByReference,
    /// Without checks for the same reasons, but angles are unwrapped to those at the knots of the branch.
    UncheckedByKnots,
    /// With checks: signs may change, a dyad has no kernel, or too many blocks were uncertain.
    Checked,
    /// One position after another, because a test requests it, no branch serves all positions of several
    /// drivers, or a position of a block cannot be followed.
    ByPosition,
}

/// Some positions of one design, and the rows they go to.
pub(crate) struct Job<'j, 'r> {
    /// Coordinates, drivers fastest, rad or m.
    pub q: &'j [f64],
    pub rows: &'j mut RowSlices<'r>,
    /// Row of the first position in `rows`.
    pub first: usize,
    /// Row of the first position in the whole batch.
    pub index: usize,
    /// Index of the design.
    pub design: usize,
    /// Offset into the shared coordinates, if shared.
    pub shared: Option<usize>,
}

impl<'a, R: Real, const G: usize> Worker<'a, R, G> {
    pub(crate) fn new(
        mechanism: &'a Mechanism,
        request: &Request<'_>,
        derivatives: &'a DerivativeTables,
        writer: &'a Arc<Writer>,
        control: &Control<'a>,
    ) -> Self {
        let mut space = WorkSpace::take(mechanism, derivatives, writer);
        let mut design = Design::new(mechanism, request.signs, derivatives)
            .reusing(std::mem::take(&mut space.design));
        design.cancel = control.cancel;
        if control.checks == Checks::Needed
            && let Some(tape) = space.tracing_tape.take()
        {
            design.trace_by(tape);
        }
        Self {
            space,
            design,
            writer,
            columns: &writer.columns,
            checks: control.checks,
            is_smooth: false,
            depends_on_request: false,
            driven_range: (None, NOWHERE),
            cancel: control.cancel,
            failures: control.failures.map(FailureCounter::new),
            known_signs: control.known_signs,
        }
    }

    /// The design bound last.
    pub(crate) fn bound_design(&self) -> &Design<'a> {
        &self.design
    }

    /// Swaps work spaces with a worker of the same request, so that each set of jobs finds its own
    /// coordinates loaded.
    pub(crate) fn swap_space(&mut self, other: &mut Self) {
        std::mem::swap(&mut self.space, &mut other.space);
    }

    /// Keeps the work space for later calls.
    pub(crate) fn finish(mut self) {
        let mechanism = self.design.mechanism;
        let (tape, memory) = self.design.into_memory();
        self.space.tracing_tape = tape.or(self.space.tracing_tape);
        self.space.design = memory;
        self.space.keep(mechanism);
    }

    /// Whether the caller has cancelled the work.
    pub(super) fn is_cancelled(&self) -> bool {
        self.cancel.is_some_and(|flag| flag.load(Ordering::Relaxed))
    }

    /// Loads a design. If its dimensions are invalid, fills the job's rows with NaN and
    /// `BadDimension`, and returns false.
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
        let [low, high] = self.driven_range(job);
        let reach = 0.0_f64.max(-low).max(high);
        self.design.bind_within(design.dimensions, design.scale, reach);
        true
    }

    /// See [`Design::lengths_miss_position`].
    pub(crate) fn lengths_miss_position(&self, design: DesignRow<'_>, step: f64) -> bool {
        design.is_valid
            && self.design.lengths_miss_position(&self.space.tape, design.dimensions, step)
    }

    /// See [`Design::misses_position`].
    pub(crate) fn misses_position(&self, step: f64) -> bool {
        self.design.misses_position(&self.space.tape, step)
    }

    /// The least and the greatest value of a driven slide at any position of a job, m.
    fn driven_range(&mut self, job: &Job<'_, '_>) -> [f64; 2] {
        let (shared, range) = self.driven_range;
        if shared.is_some() && shared == job.shared {
            return range;
        }
        let mechanism = self.design.mechanism;
        let drivers = mechanism.q0().len();
        let slides = (0..drivers).filter(|&d| mechanism.plan().driven_slide(d).is_some());
        let values = slides.flat_map(|driver| job.q.iter().skip(driver).step_by(drivers));
        let range = values.fold(NOWHERE, |[low, high], &q| [low.min(q), high.max(q)]);
        self.driven_range = (job.shared, range);
        range
    }

    /// Solves the positions of the design; only `dispatch` calls this. `trace` is [`Worker::trace`],
    /// compiled as a separate function.
    #[inline(always)]
    pub(crate) fn run<L: Level<Register = R>>(
        &mut self,
        job: &mut Job<'_, '_>,
        trace: fn(&mut Self, &Job<'_, '_>, bool) -> Traced,
    ) {
        let traced = trace(self, job, true);
        let count = job.q.len() / self.design.mechanism.q0().len();
        match self.path(traced) {
            Path::ByPosition => self.solve_by_position(job, 0, count),
            path => self.run_blocks::<L>(job, count, (traced, path), trace),
        }
    }

    /// How a traced design is solved, or its first block.
    #[inline(always)]
    fn path(&mut self, traced: Traced) -> Path {
        let drivers = self.design.mechanism.q0().len();
        if self.checks != Checks::Needed || drivers > 1 && !self.design.serves_all {
            return Path::ByPosition;
        }
        // Analogues without checks are for one driver, second ones also for two.
        let (len, tape) = (self.space.block.len, &self.space.tape);
        let has_kernels = drivers == 1
            || len == 1
            || drivers == 2 && len == TWO_DRIVERS.len() && tape.serves_two_drivers;
        if !(has_kernels && (traced == Traced::Surveyed || self.needs_no_checks())) {
            return Path::Checked;
        }
        // A survey has set the references; else the traced angles may give them.
        let by_knots = match traced {
            Traced::Surveyed => false,
            Traced::AtKnots => true,
            Traced::No | Traced::Whole => self.find_references(),
        };
        if by_knots { Path::UncheckedByKnots } else { Path::UncheckedByReference }
    }

    /// Solves the positions in blocks of lanes.
    #[inline(always)]
    fn run_blocks<L: Level<Register = R>>(
        &mut self,
        job: &mut Job<'_, '_>,
        count: usize,
        (mut traced, mut path): (Traced, Path),
        trace: fn(&mut Self, &Job<'_, '_>, bool) -> Traced,
    ) {
        self.load_signs(count);
        self.load_coordinates(job);
        let has_no_angles = |traced| traced == Traced::Surveyed;
        if has_no_angles(traced) && (path == Path::Checked || self.space.coordinates.is_far) {
            traced = trace(self, job, false);
            path = self.path(traced);
        }
        if path != Path::Checked {
            let design = &self.design;
            let cx = Context { tape: &self.space.tape, ..design.context(design.derivatives) };
            self.space.block.prepare_unchecked(&cx);
        }
        if path != Path::UncheckedByReference {
            self.locate();
        }
        job.rows.status[job.first..job.first + count].fill(MaybeUninit::new(Status::Ok as u8));
        let (mut prepared, mut uncertain_blocks) = (false, 0);
        let size = self.space.coordinates.block * R::LANES;
        for row in (0..count).step_by(size) {
            if self.is_cancelled() {
                return;
            }
            if path != Path::UncheckedByReference && self.space.locations.is_empty() {
                self.locate();
            }
            let block = (count - row).min(size);
            if self.space.coordinates.by_position(row / size) {
                self.solve_by_position(job, row, block);
                continue;
            }
            let by_knots = path == Path::UncheckedByKnots;
            if path != Path::Checked && self.solve_unchecked::<L>(job, row, block, by_knots) {
                continue;
            }
            if !prepared {
                let plan = self.design.mechanism.plan();
                // Later blocks are not longer.
                self.space.block.groups = block.div_ceil(R::LANES).min(G);
                self.space.block.prepare(plan, &self.design.constants, self.design.derivatives);
                prepared = true;
            }
            if path == Path::UncheckedByReference {
                if has_no_angles(traced) {
                    trace(self, job, false);
                }
                self.locate();
            }
            self.solve_checked::<L>(job, row, block);
            uncertain_blocks += 1;
            let stays = path == Path::Checked
                || uncertain_blocks == MAX_UNCERTAIN
                || !self.needs_no_checks();
            path = if stays { Path::Checked } else { Path::UncheckedByKnots };
        }
    }

    /// Loads the signs of the branch if they are constant.
    #[inline(always)]
    fn load_signs(&mut self, count: usize) {
        self.space.block.groups = count.div_ceil(R::LANES).min(G);
        if self.design.branch.has_constant_signs() {
            let signs = self.design.branch.signs_at(&BranchLocation::<f64>::default(), 0);
            for (lanes, &sign) in self.space.block.pose.signs.iter_mut().zip(signs) {
                lanes[..self.space.block.groups].fill(R::splat(sign));
            }
        }
    }

    /// Traces the branch. If `unchecked`, it may only show that the design needs no checks.
    #[inline(always)]
    pub(super) fn trace<L: Level<Register = R>>(
        &mut self,
        job: &Job<'_, '_>,
        unchecked: bool,
    ) -> Traced {
        if self.has_known_signs(job.design) {
            self.design.set_constant_signs();
            self.is_smooth = true;
            return Traced::Whole;
        }
        let mut traced = Traced::No;
        // The first guess of a group's iteration depends on how its branch was traced.
        if self.checks == Checks::Needed || self.design.has_groups() {
            let unchecked =
                unchecked && self.checks == Checks::Needed && self.space.tape.is_bounded;
            let mut references = unchecked.then_some(&mut self.space.references[..]);
            let (design, classes) = (&mut self.design, &self.writer.classes);
            traced = design.trace_in_closed_form(classes, references.as_deref_mut());
            if traced == Traced::No {
                let uniform =
                    self.space.uniform.get_or_insert_with(|| Box::new(design.uniform_tracer()));
                let range = self.driven_range.1;
                traced = design.trace_in_lanes::<L, G>(uniform, classes, references, range);
            }
        }
        let slides = self.design.mechanism.plan().driven_slide(0).is_some();
        self.depends_on_request = slides && traced == Traced::Whole;
        if traced == Traced::No {
            match self.checks {
                Checks::Always => self.design.trace(job.q),
                _ => self.design.trace_knot_by_knot(job.q),
            }
        }
        if let Some(known_signs) = self.known_signs
            && self.design.has_constant_signs()
        {
            known_signs.set_constant(job.design);
        }
        self.is_smooth = self.design.is_smooth(job.q);
        traced
    }

    /// Whether only the signs of the branch are needed, and they are known to be constant.
    #[inline(always)]
    fn has_known_signs(&self, design: usize) -> bool {
        let needs_signs_only = self.checks == Checks::Needed && self.writer.classes.is_empty();
        needs_signs_only
            && self.known_signs.is_some_and(|known_signs| known_signs.are_constant(design))
    }

    /// Loads the coordinates into registers; shared ones are loaded once.
    #[inline(always)]
    fn load_coordinates(&mut self, job: &Job<'_, '_>) {
        if self.space.coordinates.load(job.q, job.shared, &self.design) {
            self.space.locations.clear();
        }
    }
}

/// The lanes for which `is_set` is true.
#[inline(always)]
pub(super) fn mask<R: Real>(is_set: impl Fn(usize) -> bool) -> R::Mask {
    R::ZERO.lt(R::from_lanes(|lane| if is_set(lane) { 1.0 } else { 0.0 }))
}
