//! What a worker computes in: kept for later calls that ask the same of the same mechanism.

use super::coordinates::Coordinates;
use super::outputs::Column;
use super::writer::Writer;
use crate::branch::branch::BranchLocation;
use crate::branch::uniform::UniformTracer;
use crate::math::angle::Reference;
use crate::math::derivatives::DerivativeTables;
use crate::math::lanes::Real;
use crate::plan::compile_tape::Needs;
use crate::plan::mechanism::Mechanism;
use crate::plan::tape::Tape;
use crate::state::state::State;

/// Work space of greater mechanisms takes megabytes, and is not kept.
const MAX_POINTS: usize = 100;

/// Work space of one thread, with registers of type `R` and blocks of `G` of them.
pub(super) struct WorkSpace<R: Real, const G: usize> {
    /// What it was made for.
    columns: Vec<Column>,
    /// Of single positions.
    pub(super) one: State,
    pub(super) many: State<R, G>,
    /// Angles of the classes.
    pub(super) lifted: Vec<[R; G]>,
    /// Of the last job.
    pub(super) coordinates: Coordinates<R, G>,
    /// Locations of these registers on the branch.
    pub(super) locations: Vec<BranchLocation<R>>,
    /// Whether that branch was a uniform one.
    pub(super) locations_even: bool,
    /// What the request needs.
    pub(super) tape: Tape,
    /// What tracing needs for it; a worker's design has it meanwhile. None with groups.
    pub(super) tracing_tape: Option<Tape>,
    /// Of each class asked for, if the design is plain.
    pub(super) references: Vec<Reference>,
    /// Made for the first design that needs it.
    pub(super) uniform: Option<Box<UniformTracer<R, G>>>,
}

impl<R: Real, const G: usize> WorkSpace<R, G> {
    /// One that an earlier call has left, or a new one.
    pub(super) fn take(
        mechanism: &Mechanism,
        derivatives: &DerivativeTables,
        writer: &Writer<'_>,
        columns: &[Column],
    ) -> Box<Self> {
        match mechanism.number.take(|kept: &Self| kept.columns == columns) {
            Some(mut kept) => {
                kept.coordinates.forget();
                kept.locations.clear();
                kept
            }
            None => Box::new(Self::new(mechanism, derivatives, writer, columns)),
        }
    }

    fn new(
        mechanism: &Mechanism,
        derivatives: &DerivativeTables,
        writer: &Writer<'_>,
        columns: &[Column],
    ) -> Self {
        let plan = mechanism.plan();
        let mut many = State::new(plan, derivatives);
        many.work.angle_wanted.clone_from(&writer.asked);
        let mut points = vec![false; plan.points];
        for point in writer.asked_points() {
            points[point] = true;
        }
        let needs = Needs { points: &points, classes: &writer.asked, samples: false };
        Self {
            columns: columns.to_vec(),
            one: State::new(plan, derivatives),
            many,
            lifted: vec![[R::ZERO; G]; plan.classes],
            coordinates: Coordinates::new(plan, derivatives.len()),
            locations: Vec::new(),
            locations_even: false,
            tape: Tape::new(plan, needs),
            tracing_tape: plan.has_closed_forms().then(|| Tape::for_dyads(plan, &writer.asked)),
            references: vec![Reference::Principal; plan.classes],
            uniform: None,
        }
    }

    /// Leaves it to later calls.
    pub(super) fn keep(mut self: Box<Self>, mechanism: &Mechanism) {
        if mechanism.plan().points > MAX_POINTS || std::thread::panicking() {
            return;
        }
        if let Some(uniform) = &mut self.uniform {
            // Another call may ask for another assembly.
            uniform.reference.take();
        }
        mechanism.number.keep(self);
    }
}
