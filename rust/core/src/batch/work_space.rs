//! A worker's work space, kept for later calls with the same request and mechanism.

use std::sync::Arc;

use super::coordinates::CoordinateRegisters;
use super::writer::Writer;
use crate::branch::design::DesignMemory;
use crate::branch::lanes::uniform::UniformTracer;
use crate::branch::location::BranchLocation;
use crate::math::angle::Reference;
use crate::math::derivatives::DerivativeTables;
use crate::math::lanes::Real;
use crate::plan::compile_tape::Needs;
use crate::plan::mechanism::Mechanism;
use crate::plan::tape::Tape;
use crate::state::state::State;

/// Points beyond which a work space is not kept: it would take megabytes.
const MAX_POINTS: usize = 100;

/// Work space of one thread, with blocks of `G` registers `R`.
pub(super) struct WorkSpace<R: Real, const G: usize> {
    /// The writer that it was made for.
    writer: Arc<Writer>,
    /// State of a single position.
    pub(super) single: State,
    /// State of a block.
    pub(super) block: State<R, G>,
    /// Unwrapped angles of the classes.
    pub(super) lifted: Vec<[R; G]>,
    /// Angles of the classes near those, where they are found along the path to each position.
    pub(super) near: Vec<[R; G]>,
    /// How far each coordinate of a register is from the drawing's.
    pub(super) moved: Vec<R>,
    /// Coordinates of the last job.
    pub(super) coordinates: CoordinateRegisters<R, G>,
    /// Location of each of their registers on the branch.
    pub(super) locations: Vec<BranchLocation<R>>,
    /// Knots per unit of the uniform branch on which these are locations.
    pub(super) locations_width: Option<f64>,
    /// The operations that the request needs.
    pub(super) tape: Tape,
    /// The tape that traces its designs; a worker's design holds it during a call. `None` with groups.
    pub(super) tracing_tape: Option<Tape>,
    /// Memory of the design, which holds it during a call.
    pub(super) design: DesignMemory,
    /// Turn reference of each requested class, for designs solved without checks.
    pub(super) references: Vec<Reference>,
    /// Made for the first design that needs it.
    pub(super) uniform: Option<Box<UniformTracer<R, G>>>,
}

impl<R: Real, const G: usize> WorkSpace<R, G> {
    /// Reuses an earlier call's work space, or makes one.
    pub(super) fn take(
        mechanism: &Mechanism,
        derivatives: &DerivativeTables,
        writer: &Arc<Writer>,
    ) -> Box<Self> {
        match mechanism.number.take(|kept: &Self| Arc::ptr_eq(&kept.writer, writer)) {
            Some(mut kept) => {
                kept.coordinates.forget();
                kept.locations.clear();
                kept
            }
            None => Box::new(Self::new(mechanism, derivatives, writer)),
        }
    }

    fn new(mechanism: &Mechanism, derivatives: &DerivativeTables, writer: &Arc<Writer>) -> Self {
        let plan = mechanism.plan();
        let mut block = State::new(plan, derivatives);
        block.work.angle_wanted.clone_from(&writer.needed_classes);
        let mut points = vec![false; plan.points];
        for point in writer.written_points() {
            points[point] = true;
        }
        let mut orientations = vec![false; plan.orientations.len()];
        for orientation in writer.driven_orientations() {
            orientations[orientation] = true;
        }
        let needs = Needs {
            points: &points,
            classes: &writer.needed_classes,
            orientations: &orientations,
            samples: false,
        };
        Self {
            writer: Arc::clone(writer),
            single: State::new(plan, derivatives),
            block,
            lifted: vec![[R::ZERO; G]; plan.classes],
            near: vec![[R::ZERO; G]; plan.classes],
            moved: vec![R::ZERO; plan.drivers.len()],
            coordinates: CoordinateRegisters::new(plan, derivatives.len()),
            locations: Vec::new(),
            locations_width: None,
            tape: Tape::new(plan, needs),
            tracing_tape: plan
                .has_closed_forms()
                .then(|| Tape::for_dyads(plan, &writer.needed_classes)),
            design: DesignMemory::default(),
            references: vec![Reference::Principal; plan.classes],
            uniform: None,
        }
    }

    /// Keeps it for later calls.
    pub(super) fn keep(mut self: Box<Self>, mechanism: &Mechanism) {
        if mechanism.plan().points > MAX_POINTS || std::thread::panicking() {
            return;
        }
        if let Some(uniform) = &mut self.uniform {
            // A later call may request another assembly.
            uniform.reference.take();
        }
        mechanism.number.keep(self);
    }
}
