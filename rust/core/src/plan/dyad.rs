//! A dyad of the plan: one vector equation with two unknowns, in one of four closed forms.

/// An unknown of a dyad: rotation of a class, or value of a slide.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Unknown {
    /// Rotation of this class.
    Class(usize),
    /// Value of this slide.
    Slide(usize),
}

impl Unknown {
    /// Index of the class; 0, the ground's, for a slide.
    pub(crate) fn class(self) -> usize {
        match self {
            Self::Class(class) => class,
            Self::Slide(_) => 0,
        }
    }
}

/// Closed form of a dyad.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Form {
    /// Two rotations (RRR): two circles.
    TwoCircles,
    /// A rotation and a slide along a known direction (RRP): circle and line.
    CircleAndLine,
    /// A rotation and a slide that turns with it (RPR): a right triangle.
    TurningGuide,
    /// Two slides along known directions (PRP, RPP): two lines.
    TwoLines,
}

/// The term that an edge adds to the equation of a dyad's loop.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct LoopTerm {
    /// Index of the edge in the plan.
    pub edge: usize,
    /// Traversed from `to` to `from`.
    pub backward: bool,
    /// The unknown (0 or 1) whose rotation turns it.
    pub turns: Option<usize>,
    /// The unknown that is the slide along it.
    pub slides: Option<usize>,
    /// Whether its constant part belongs to that unknown's leg.
    pub in_leg: bool,
}

/// One vector equation with two unknowns:
/// `P_start + Σ ±edge vectors = P_end`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Dyad {
    /// Closed form.
    pub form: Form,
    /// The unknowns; a rotation comes before a slide, and the rotation of the
    /// link listed first before the other.
    pub unknowns: [Unknown; 2],
    /// The orientations that turn with each unknown (none with a slide), unless only the legs need them.
    pub orientations: [Vec<usize>; 2],
    /// The loop, edge by edge.
    pub path: Vec<LoopTerm>,
    /// The terms that are not entirely in a leg.
    pub others: Vec<LoopTerm>,
    /// Whether each unknown has a leg: all that turns with it is constant, except its slide.
    pub leg: [bool; 2],
    /// The classes of its two legs, if it has nothing else (RRR).
    pub rrr_classes: Option<[usize; 2]>,
    /// Index among the dyads.
    pub index: usize,
    /// Known point where the path starts; point 0 if the path is closed.
    pub start: usize,
    /// Known point where it ends.
    pub end: usize,
    /// Index among the assembly signs, if it has two solutions.
    pub sign: Option<usize>,
    /// Whether it consists only of a slide that turns about both its joints and whose value is a
    /// length: a cylinder. Its sign is always +1.
    pub is_length: bool,
}
