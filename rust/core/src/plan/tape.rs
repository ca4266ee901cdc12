//! The tape: the plan's steps as the solver runs them, with all indices resolved and without the steps
//! that a request does not need.

/// The operations to run at every position, in order.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(crate) struct Tape {
    pub ops: Vec<Op>,
    /// The operation of every dyad.
    pub dyads: Vec<usize>,
    /// Ground points that the unchecked path uses.
    pub fixed: Vec<usize>,
    /// Driven orientations whose phases are used.
    pub driven: Vec<DrivenOrientation>,
    /// Whether all dyads have kernels and depend only on points with bounded coordinates. Then a
    /// product of sines bounds the condition, and the unchecked path may be used.
    pub is_bounded: bool,
    /// Whether all dyads have kernels for second derivatives by two drivers.
    pub serves_two_drivers: bool,
}

/// An orientation that turns with drivers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct DrivenOrientation {
    pub index: usize,
    /// Whether some operation uses its derivatives.
    pub has_jet: bool,
}

/// One operation.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Op {
    /// A dyad of two legs (RRR).
    TwoLegs(DyadOp),
    /// A dyad of a leg and a slide along a fixed guide (RRP).
    StandingGuide(DyadOp),
    /// A dyad of a leg and a slide along a guide on a moving link that is already solved (RRP).
    MovingGuide(DyadOp),
    /// A dyad with a guide that turns (RPR).
    TurningGuide(DyadOp),
    /// A dyad of two slides along fixed guides (PRP, RPP).
    StandingGuides(DyadOp),
    /// Any other dyad.
    Dyad { step: usize },
    /// A point.
    Place(PlaceOp),
    /// A group above class II.
    Group { step: usize },
    /// A redundant link.
    Redundant { step: usize },
    /// The check of a length.
    Length { step: usize, slide: usize },
}

/// Indices of a dyad.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct DyadOp {
    /// Index of the step in the plan.
    pub step: usize,
    /// Index among the dyads.
    pub dyad: usize,
    pub start: usize,
    pub end: usize,
    pub sign: Option<usize>,
    /// See [`Dyad::is_length`](super::dyad::Dyad::is_length).
    pub is_length: bool,
    /// Index of each unknown, a class or a slide.
    pub unknowns: [usize; 2],
    /// Whether the rotation of each unknown class is used.
    pub turns: [bool; 2],
    /// The orientations that turn with the unknowns, with their classes.
    pub orientations: Vec<(usize, usize)>,
    /// The dyads that its points directly depend on.
    pub upstream: Vec<usize>,
    /// Whether the jet of each leg is used.
    pub keeps: [bool; 2],
    /// Whether any operation uses it.
    pub is_used: bool,
    /// The crank's pin, if it connects one to the ground.
    pub pin: Option<CrankPin>,
    /// Whether start and end belong to the ground.
    pub on_ground: [bool; 2],
    /// The orientation of its guide, if the guide is on a moving link.
    pub carrier: Option<usize>,
}

impl DyadOp {
    /// Whether the dyad may depend on others before it: not between a crank's pin and the ground.
    #[inline(always)]
    pub(crate) fn may_have_upstream(&self) -> bool {
        self.pin.is_none() || self.carrier.is_some()
    }
}

/// Indices of the pin of a crank on the ground.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct CrankPin {
    /// Whether it is the start of the dyad.
    pub is_start: bool,
    pub pivot: usize,
    pub edge: usize,
    /// Whether the edge is subtracted.
    pub backward: bool,
    pub driver: usize,
    /// Whether the crank turns against the driver.
    pub conj: bool,
}

impl CrankPin {
    pub(crate) const NONE: Self =
        Self { is_start: false, pivot: 0, edge: 0, backward: false, driver: 0, conj: false };
}

/// Indices of a point to be placed.
#[allow(clippy::struct_excessive_bools, reason = "each is a fact of its own")]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct PlaceOp {
    pub edge: usize,
    /// Class of the edge.
    pub class: usize,
    pub from: usize,
    pub to: usize,
    /// Whether the edge is subtracted.
    pub backward: bool,
    pub kind: PlaceKind,
    /// Whether it is placed from a point of the ground, whose jet is constant.
    pub from_ground: bool,
    /// Whether any operation of the unchecked path uses the point.
    pub is_used: bool,
    /// Whether a later operation reads the point's condition.
    pub is_recorded: bool,
}

/// How the vector of an edge is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum PlaceKind {
    /// It is a leg; `negative`: from its tip to its root.
    Leg { leg: usize, negative: bool },
    /// It turns with a leg: a constant multiple of it.
    OnLeg { leg: usize },
    /// It turns with one driver, forward or backward.
    Crank { driver: usize, conj: bool },
    /// It turns with an orientation.
    Rigid { orientation: usize },
    /// A slide is along it.
    Along,
}
