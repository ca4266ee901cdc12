//! A group above class II of the plan: its edges and independent loops.

use super::dyad::Unknown;

/// What the chord of a loop leaves of its vector equation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Chord {
    /// Its length: the rotation of this class is found afterwards.
    Length {
        /// The class.
        class: usize,
    },
    /// The distance of its end from the guide: the value of this slide is found afterwards.
    Guide {
        /// The slide.
        slide: usize,
    },
    /// Both components.
    Whole,
}

/// An edge on the path of a loop.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct LoopEdge {
    /// Place among the group's edges.
    pub edge: usize,
    /// Run from `to` to `from`.
    pub backward: bool,
}

/// An edge of a group.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct GroupEdge {
    /// The edge.
    pub edge: usize,
    /// The unknown that turns it.
    pub turns: Option<usize>,
    /// The unknown that is the slide along it.
    pub slides: Option<usize>,
    /// Nothing but its length is asked for.
    pub is_bar: bool,
}

/// One independent loop: its chord's vector is `P_end − P_start + Σ path`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Loop {
    /// The edge that closes it, from its `from` to its `to`: place among the group's edges.
    pub edge: usize,
    /// What it leaves.
    pub chord: Chord,
    /// Known point from which `from` is reached; of loops on no known point: point 0.
    pub start: usize,
    /// Known point from which `to` is reached.
    pub end: usize,
    /// Edges from `start` to `from`, run backward, and from `end` to `to`.
    pub path: Vec<LoopEdge>,
    /// The orientations that turn with the rotation it takes along.
    pub orientations: Vec<usize>,
    /// Of every unknown, what changes the chord's vector.
    pub columns: Vec<Vec<ColumnTerm>>,
}

/// What an unknown does to a loop.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct ColumnTerm {
    /// The edge that it turns, or slides along: place among the group's edges. None: the chord,
    /// against the guide that turns.
    pub edge: Option<usize>,
    /// Turns it (otherwise: slides).
    pub turns: bool,
    /// Against its direction.
    pub backward: bool,
}

/// A group without a closed form.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Group {
    /// What is iterated for.
    pub unknowns: Vec<Unknown>,
    /// The orientations that turn with each (none with a slide).
    pub orientations: Vec<Vec<usize>>,
    /// Its edges.
    pub edges: Vec<GroupEdge>,
    /// Its loops.
    pub loops: Vec<Loop>,
    /// Rows of its equations: one of a loop or two.
    pub rows: usize,
    /// Names of its links, for what is said of it.
    pub name: String,
    /// Place among the groups.
    pub index: usize,
    /// Place among the legs of its first edge; the others follow.
    pub first_leg: usize,
    /// What it consists of, if it is of rigid links and turning pairs alone, and small.
    pub binary_loops: Option<BinaryLoops>,
}

impl Group {
    /// Whether an edge closes a loop (and places no point).
    #[must_use]
    pub(crate) fn is_chord(&self, edge: usize) -> bool {
        self.loops.iter().any(|l| l.edge == edge)
    }

    /// All that is found: the unknowns, and what the chords take along.
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
    /// The edge.
    pub edge: usize,
    /// Place among the legs.
    pub leg: usize,
    /// The unknown.
    pub unknown: usize,
}

/// What a group of rigid links and turning pairs consists of, if it is small.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct BinaryLoops {
    /// Place of its first span in the design's spans.
    pub(crate) first_span: usize,
    /// Place of its first binary link in the design's binary links.
    pub(crate) first_bar: usize,
    /// The class of every unknown.
    pub classes: Vec<usize>,
    /// The class of every loop's binary link.
    pub bar_classes: Vec<usize>,
    /// The edges that place its points.
    pub arms: Vec<Arm>,
}
