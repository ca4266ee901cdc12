//! The compiled mechanism: a list of steps.

use super::dyad::Dyad;
use super::group::Group;
use super::pair_span::PairSpans;
use crate::description::Driver;
use crate::structure::closure::{Edge, Rotation};

/// Value of a slide on an edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum EdgeSlide {
    /// A rigid edge.
    Nothing,
    /// The slide's value is unknown until its dyad is solved.
    Slide(usize),
    /// The slide is this driver.
    Driver { slide: usize },
}

/// An edge with the orientation that turns it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct PlanEdge {
    /// Its points, link and span.
    pub edge: Edge,
    /// Index of its link's orientation.
    pub orientation: usize,
    /// Class of that.
    pub class: usize,
    /// The slide along it.
    pub along: EdgeSlide,
    /// Whether the motion depends on it (not on that of a coupler point).
    pub paired: bool,
    /// The leg that it is by itself.
    pub leg: Option<LegEdge>,
}

impl PlanEdge {
    /// Its points: where it is run from and where to.
    #[must_use]
    #[inline(always)]
    pub(crate) fn ends(&self, backward: bool) -> [usize; 2] {
        let (from, to) = (self.edge.from, self.edge.to);
        if backward { [to, from] } else { [from, to] }
    }
}

/// An edge that is a leg of a dyad.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct LegEdge {
    /// Place among the legs, two a dyad.
    pub index: usize,
    /// Run from `to` to `from`.
    pub backward: bool,
}

/// An orientation: rotation of a class plus multiples of driven angles.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Orientation {
    /// The class.
    pub class: usize,
    /// Multiples of the drivers.
    pub turns: Vec<i8>,
    /// Whether a multiple is not 0.
    pub driven: bool,
    /// The driver that alone turns it, once, and whether the other way round.
    pub single_driver: Option<(usize, bool)>,
}

/// One thing to do at every position.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Step {
    /// Solve a dyad.
    Dyad(Dyad),
    /// Solve a group above class II.
    Group(Group),
    /// Place one end of an edge from the other.
    Place { edge: usize, backward: bool },
    /// Place a redundant link and check that it fits.
    Redundant(RedundantLink),
}

/// A redundant link (or slide): what places it, and what must then fit.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct RedundantLink {
    /// Name used when it does not fit.
    pub name: String,
    /// How its orientation is found; none for a slide alone.
    pub angle_from: Option<AngleFrom>,
    /// Edges whose far point is not placed by anything else, with direction.
    pub places: Vec<(usize, bool)>,
    /// Edges that must close (a slide along them takes the value that fits best).
    pub checks: Vec<usize>,
    /// All edges that are placed or must close.
    pub touched: Vec<usize>,
    /// Slides whose two links must keep their angle, with the carrying link.
    pub parallel: Vec<(usize, usize)>,
}

/// How a redundant link's orientation is found.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum AngleFrom {
    /// By two joints that other links carry: edges from the link's first joint
    /// (none: the first joint itself).
    Joints { link: usize, first: Option<usize>, second: Option<usize>, points: [usize; 2] },
    /// By a slide.
    Slide { link: usize, slide: usize },
}

/// A group that has no closed form.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Higher {
    /// Its links.
    pub links: String,
    /// Its class in Roman numerals.
    pub class: String,
}

/// The compiled mechanism.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Plan {
    /// The drivers, in the order of q.
    pub drivers: Vec<Driver>,
    /// The two links of every slide: sliding, carrying.
    pub slide_links: Vec<[usize; 2]>,
    /// Number of points (joints, and reference points of links without joints).
    pub points: usize,
    /// Number of rotation classes; 0 is the ground's.
    pub classes: usize,
    /// Distinct orientations.
    pub orientations: Vec<Orientation>,
    /// Edges, as in the closure.
    pub edges: Vec<PlanEdge>,
    /// Rotation of every link.
    pub rotation: Vec<Rotation>,
    /// Orientation of every link.
    pub link_orientation: Vec<usize>,
    /// Reference point of every link.
    pub reference: Vec<usize>,
    /// The link that is the frame.
    pub ground: usize,
    /// Points fixed to the ground.
    pub fixed: Vec<bool>,
    /// What to do, in order.
    pub steps: Vec<Step>,
    /// Inner joint or slide of every dyad that has two solutions, in order.
    pub dyad_names: Vec<String>,
    /// Names of the same dyads' links.
    pub dyad_links: Vec<String>,
    /// The first group without a closed form.
    pub higher: Option<Higher>,
    /// Where the links have pairs; nothing if no link or slide is redundant.
    pub pairs: PairSpans,
}

impl Plan {
    /// Class of an edge's rotation.
    #[must_use]
    pub(crate) fn class_of(&self, edge: usize) -> usize {
        self.edges[edge].class
    }

    /// The slide that is driver number `driver`, if it is one.
    #[must_use]
    pub(crate) fn driven_slide(&self, driver: usize) -> Option<usize> {
        match self.drivers[driver] {
            Driver::Slide(slide) => Some(slide),
            Driver::Angle { .. } => None,
        }
    }

    /// The dyads, in order.
    pub(crate) fn dyads(&self) -> impl Iterator<Item = &Dyad> {
        self.steps.iter().filter_map(|step| match step {
            Step::Dyad(dyad) => Some(dyad),
            _ => None,
        })
    }

    /// The redundant links and slides, in order.
    pub(crate) fn redundant_links(&self) -> impl Iterator<Item = &RedundantLink> {
        self.steps.iter().filter_map(|step| match step {
            Step::Redundant(redundant) => Some(redundant),
            _ => None,
        })
    }

    /// The groups above class II, in order.
    pub(crate) fn groups(&self) -> impl Iterator<Item = &Group> {
        self.steps.iter().filter_map(|step| match step {
            Step::Group(group) => Some(group),
            _ => None,
        })
    }

    /// Numbers that the matrix of any group needs, with its inverse and a right-hand side.
    #[must_use]
    pub(crate) fn matrix_size(&self) -> usize {
        self.groups().map(|group| (2 * group.rows + 1) * group.rows).max().unwrap_or(0)
    }

    /// Number of legs: two a dyad, and the edges of groups.
    #[must_use]
    pub(crate) fn legs(&self) -> usize {
        let edges: usize = self.groups().map(|group| group.edges.len()).sum();
        2 * self.dyads().count() + edges
    }

    /// Number of dyads with two solutions.
    #[must_use]
    pub(crate) fn signs(&self) -> usize {
        self.dyad_names.len()
    }

    /// Whether an edge of a group is a rigid one that turns with an unknown: its jets follow from its own.
    #[must_use]
    #[inline(always)]
    pub(crate) fn is_arm(&self, group: &Group, edge: usize) -> bool {
        let edge = &group.edges[edge];
        edge.turns.is_some() && self.edges[edge.edge].along == EdgeSlide::Nothing
    }
}
