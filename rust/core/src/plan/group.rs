//! Groups above class II in the plan: their edges and independent loops.

use super::dyad::Unknown;

/// The condition on the chord that a loop adds to the equations.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Chord {
    /// Its length; the rotation of its class follows by back substitution.
    Length {
        /// Class of the chord.
        class: usize,
    },
    /// The distance of its end from the guide; the slide's value follows by back substitution.
    Guide {
        /// Slide along the chord.
        slide: usize,
    },
    /// Both components of its vector.
    Whole,
}

/// An edge on the path of a loop.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct LoopEdge {
    /// Index among the group's edges.
    pub edge: usize,
    /// Traversed from `to` to `from`.
    pub backward: bool,
}

/// An edge of a group.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct GroupEdge {
    /// Index of the edge in the plan.
    pub edge: usize,
    /// The unknown that turns it.
    pub turns: Option<usize>,
    /// The unknown that is the slide along it.
    pub slides: Option<usize>,
    /// Whether it is a bar that closes a loop: only its length enters the equations.
    pub is_bar: bool,
}

/// One independent loop: its chord's vector is `P_end − P_start + Σ path`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Loop {
    /// The edge that closes it, from its `from` to its `to`: index among the group's edges.
    pub edge: usize,
    /// The condition on that edge.
    pub chord: Chord,
    /// Known point from which `from` is reached; point 0 if both would be the same.
    pub start: usize,
    /// Known point from which `to` is reached; point 0 if both would be the same.
    pub end: usize,
    /// Edges from `start` to `from`, traversed backward, and from `end` to `to`.
    pub path: Vec<LoopEdge>,
    /// The orientations that turn with the chord, if its rotation follows by back substitution.
    pub orientations: Vec<usize>,
    /// For every unknown, the derivative of the chord's vector.
    pub columns: Vec<Vec<ColumnTerm>>,
}

/// A term of the derivative of a loop's chord by an unknown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct ColumnTerm {
    /// The edge that the unknown turns or slides along: index among the group's edges. `None`: the
    /// chord, seen from a guide that turns.
    pub edge: Option<usize>,
    /// Whether the unknown turns the edge (else it slides along it).
    pub turns: bool,
    /// Whether the term is negative.
    pub backward: bool,
}

/// A group above class II, which has no closed form.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Group {
    /// The unknowns of the iteration.
    pub unknowns: Vec<Unknown>,
    /// The orientations that turn with each unknown (none with a slide).
    pub orientations: Vec<Vec<usize>>,
    /// All edges, chords included.
    pub edges: Vec<GroupEdge>,
    /// Independent loops.
    pub loops: Vec<Loop>,
    /// Number of equations: one or two per loop.
    pub rows: usize,
    /// Class and links, for messages.
    pub name: String,
    /// Index among the groups.
    pub index: usize,
    /// Index of its first edge among the legs; its other edges follow.
    pub first_leg: usize,
    /// Data of the special kernel, if the group is small and has only rigid links and turning
    /// pairs.
    pub binary_loops: Option<BinaryLoops>,
}

impl Group {
    /// Whether an edge closes a loop (and places no point).
    #[must_use]
    pub(crate) fn is_chord(&self, edge: usize) -> bool {
        self.loops.iter().any(|l| l.edge == edge)
    }

    /// The unknowns of the iteration, then those found by back substitution.
    #[inline(always)]
    pub(crate) fn all_unknowns(&self) -> impl Iterator<Item = Unknown> + '_ {
        let eliminated = self.loops.iter().filter_map(|l| match l.chord {
            Chord::Length { class } => Some(Unknown::Class(class)),
            Chord::Guide { slide } => Some(Unknown::Slide(slide)),
            Chord::Whole => None,
        });
        self.unknowns.iter().copied().chain(eliminated)
    }
}

/// A rigid edge that turns with an unknown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Arm {
    /// Index of the edge in the plan.
    pub edge: usize,
    /// Index among the legs.
    pub leg: usize,
    /// The unknown that turns it.
    pub unknown: usize,
}

/// A small group of rigid links and turning pairs, prepared for its special kernel.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct BinaryLoops {
    /// Index of its first span in the design's spans.
    pub(crate) first_span: usize,
    /// Index of its first binary link in the design's binary links.
    pub(crate) first_bar: usize,
    /// The class of every unknown.
    pub classes: Vec<usize>,
    /// The class of every loop's binary link.
    pub bar_classes: Vec<usize>,
    /// The edges that place its points.
    pub arms: Vec<Arm>,
}
