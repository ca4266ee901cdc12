//! A dyad of the plan: one vector equation with two unknowns, in one of four closed forms.

/// An unknown of a dyad: rotation of a class, or value of a slide.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Unknown {
    /// Rotation of this class.
    Class(usize),
    /// Value of this slide.
    Slide(usize),
}

/// The closed forms: every dyad is one of four.
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

/// What an edge of a dyad's loop adds to its equation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct LoopTerm {
    /// The edge.
    pub edge: usize,
    /// Run from `to` to `from`.
    pub backward: bool,
    /// The unknown (0 or 1) whose rotation turns it.
    pub turns: Option<usize>,
    /// The unknown that is the slide along it.
    pub slides: Option<usize>,
    /// Whether its constant part is counted in that unknown's leg.
    pub in_leg: bool,
}

/// One vector equation with two unknowns:
/// `P_start + Σ ±edge vectors = P_end`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Dyad {
    /// Its closed form.
    pub form: Form,
    /// The unknowns; a rotation comes before a slide, and the rotation of the
    /// link listed first before the other.
    pub unknowns: [Unknown; 2],
    /// The orientations that turn with each unknown (none with a slide) and that
    /// something else than its legs asks for.
    pub orientations: [Vec<usize>; 2],
    /// The loop, edge by edge.
    pub path: Vec<LoopTerm>,
    /// What of the loop is not wholly in a leg.
    pub others: Vec<LoopTerm>,
    /// Whether what turns with each unknown is a leg: constant parts only, but for its slide.
    pub leg: [bool; 2],
    /// The classes of its two legs, if there is nothing else.
    pub rrr_classes: Option<[usize; 2]>,
    /// Place among the dyads.
    pub index: usize,
    /// Known point where the path starts; of a path that ends where it starts: point 0.
    pub start: usize,
    /// Known point where it ends.
    pub end: usize,
    /// Place among the assembly signs, if it has two solutions.
    pub sign: Option<usize>,
}
