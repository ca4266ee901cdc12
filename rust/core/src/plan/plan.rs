//! The compiled mechanism: a list of steps.

use super::dyad::Dyad;
use super::group::Group;
use super::leg::LegEdges;
use super::pair_span::PairSpans;
use super::tape::Tape;
use crate::description::Driver;
use crate::structure::closure::{Edge, Rotation};

/// The slide along an edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum EdgeSlide {
    /// None: a rigid edge.
    Nothing,
    /// A slide whose value its dyad or group finds.
    Slide(usize),
    /// A slide that is a driver.
    Driver { slide: usize },
}

/// An edge with the orientation that turns it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct PlanEdge {
    /// Points, link and span.
    pub edge: Edge,
    /// Index of its link's orientation.
    pub orientation: usize,
    /// Class of that orientation.
    pub class: usize,
    /// The slide along it.
    pub along: EdgeSlide,
    /// Whether the motion depends on it (as on all edges but those to coupler points).
    pub paired: bool,
    /// Set if the edge alone is a leg.
    pub leg: Option<LegEdge>,
    /// The leg of a dyad that it turns with, if that is not driven.
    pub on_leg: Option<usize>,
}

impl PlanEdge {
    /// The points where a traversal of the edge starts and ends.
    #[must_use]
    #[inline(always)]
    pub(crate) fn ends(&self, backward: bool) -> [usize; 2] {
        let (from, to) = (self.edge.from, self.edge.to);
        if backward { [to, from] } else { [from, to] }
    }
}

/// An edge that is a leg of a dyad, or the edge of a group.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct LegEdge {
    /// Index among the legs: two per dyad, then the edges of groups.
    pub index: usize,
    /// Whether the leg runs from `to` to `from`.
    pub backward: bool,
}

/// An orientation: the rotation of a class plus integer multiples of driven angles.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Orientation {
    /// Class.
    pub class: usize,
    /// Multiple of every driver's angle.
    pub turns: Vec<i8>,
    /// Whether a multiple is not 0.
    pub driven: bool,
    /// The driver, if only one counts and its multiple is ±1; true for −1.
    pub single_driver: Option<(usize, bool)>,
}

/// One step of the solution at every position.
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
    /// Check that the value of this slide, a length, is not negative.
    Length { slide: usize },
}

/// A redundant link (or slide): how it is placed, and which closures must then hold.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct RedundantLink {
    /// Name for messages.
    pub name: String,
    /// How its orientation is found; `None` for a slide alone.
    pub angle_from: Option<AngleFrom>,
    /// Edges to points that no other step places; true for an edge traversed backward.
    pub places: Vec<(usize, bool)>,
    /// Edges that must close (a slide along them takes the value that fits best).
    pub checks: Vec<usize>,
    /// The edges of `checks`, then those of `places`.
    pub touched: Vec<usize>,
    /// Slides whose two links must keep their angle, with the carrying link.
    pub parallel: Vec<(usize, usize)>,
}

/// How a redundant link's orientation is found.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum AngleFrom {
    /// From two joints that other links carry: edges to them from the link's first joint (`None`:
    /// the first joint itself).
    Joints { link: usize, first: Option<usize>, second: Option<usize>, points: [usize; 2] },
    /// From the other link of a slide.
    Slide { link: usize, slide: usize },
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
    /// Steps in order of solution.
    pub steps: Vec<Step>,
    /// Inner joint or slide of every dyad that has two solutions, in order.
    pub dyad_names: Vec<String>,
    /// Names of the same dyads' links.
    pub dyad_links: Vec<String>,
    /// The same as groups, for limits.
    pub dyad_groups: Vec<String>,
    /// Pairs of every link; empty if no link or slide is redundant.
    pub pairs: PairSpans,
    /// For every sign, whether its dyad can pass change points in the drawing.
    pub may_change: Vec<bool>,
    /// The edges whose sums the legs are.
    pub leg_edges: LegEdges,
    /// Whether the general formulas solve what kernels could: for higher orders, and to compare both.
    pub is_general: bool,
    /// All steps as they are run.
    pub tape: Tape,
    /// The tape for tracing where the requested angles are not known: it needs only the points of dyads.
    pub tracing_tape: Tape,
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

    /// The slide that is the only driver, if its value is a length.
    pub(crate) fn driven_length(&self) -> Option<usize> {
        self.length_step(0).filter(|_| self.drivers.len() == 1)?;
        self.driven_slide(0)
    }

    /// The step that checks the length of driver number `driver`, if that is one.
    pub(crate) fn length_step(&self, driver: usize) -> Option<usize> {
        let slide = self.driven_slide(driver)?;
        self.steps.iter().position(|step| *step == Step::Length { slide })
    }

    /// Whether a position may fail at the length of a slide that is not a driver.
    pub(crate) fn has_passive_lengths(&self) -> bool {
        let is_passive = |slide: usize| !self.drivers.contains(&Driver::Slide(slide));
        self.steps.iter().any(|step| matches!(*step, Step::Length { slide } if is_passive(slide)))
    }

    /// The index of an end where the value of a slide, a length, is 0: after the indices of all that may fold.
    pub(crate) fn end_of_length(&self, slide: usize) -> usize {
        self.signs() + self.groups().count() + slide
    }

    /// Whether the sign of a dyad is always +1.
    pub(crate) fn is_length(&self, sign: usize) -> bool {
        self.dyads().any(|dyad| dyad.sign == Some(sign) && dyad.is_length)
    }

    /// The groups above class II, in order.
    pub(crate) fn groups(&self) -> impl Iterator<Item = &Group> {
        self.steps.iter().filter_map(|step| match step {
            Step::Group(group) => Some(group),
            _ => None,
        })
    }

    /// Whether all steps have closed forms: no groups above class II, no redundant links.
    pub(crate) fn has_closed_forms(&self) -> bool {
        self.groups().next().is_none() && self.redundant_links().next().is_none()
    }

    /// Largest size of a group's matrix with its inverse and a right-hand side, in numbers.
    #[must_use]
    pub(crate) fn matrix_size(&self) -> usize {
        self.groups().map(|group| (2 * group.rows + 1) * group.rows).max().unwrap_or(0)
    }

    /// Number of legs: two per dyad, and the edges of groups.
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

    /// Whether an edge of a group is rigid and turns with an unknown, so that its jet follows from
    /// its own lower entries.
    #[must_use]
    #[inline(always)]
    pub(crate) fn is_arm(&self, group: &Group, edge: usize) -> bool {
        let edge = &group.edges[edge];
        edge.turns.is_some() && self.edges[edge.edge].along == EdgeSlide::Nothing
    }
}
