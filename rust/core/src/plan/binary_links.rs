//! Groups above class II of rigid links and turning pairs, whose loops all leave the length of a
//! binary link: most are so, and there is nothing in their loops to sort.
//!
//! What turns with one unknown in one loop is one vector (a span), the same at all positions; so
//! the vector of a loop's chord is a known one and a sum of spans, each turned by its unknown.

use super::dyad::Unknown;
use super::group::{Arm, BinaryLoops, Chord, Group};
use super::leg::Leg;
use super::plan::{EdgeSlide, Plan};
use crate::math::vector::Vector;

/// Unknowns (and loops), at most: more are left to the general machinery.
pub(crate) const MAX_UNKNOWNS: usize = 3;

impl BinaryLoops {
    /// Of a group that is so, behind others.
    pub(crate) fn new<'b>(
        plan: &Plan,
        group: &Group,
        earlier: impl Iterator<Item = &'b Self>,
    ) -> Option<Self> {
        let classes: Vec<usize> = group.unknowns.iter().filter_map(class_of).collect();
        let bar_classes: Vec<usize> =
            group.loops.iter().filter_map(|l| bar_class(&l.chord)).collect();
        let square =
            classes.len() == group.unknowns.len() && bar_classes.len() == group.loops.len();
        let mut arms = Vec::new();
        for (index, edge) in group.edges.iter().enumerate() {
            let plan_edge = &plan.edges[edge.edge];
            if plan_edge.along != EdgeSlide::Nothing
                || plan.orientations[plan_edge.orientation].driven
            {
                return None;
            }
            match edge.turns {
                Some(unknown) => {
                    arms.push(Arm { edge: edge.edge, leg: group.first_leg + index, unknown });
                }
                None if edge.is_bar => {}
                None => return None,
            }
        }
        let fits = square
            && (2..=MAX_UNKNOWNS).contains(&bar_classes.len())
            && classes.len() == bar_classes.len();
        let (mut first_span, mut first_bar) = (0, 0);
        for other in earlier {
            first_span += other.classes.len() * other.classes.len();
            first_bar += other.bar_classes.len();
        }
        fits.then_some(Self { first_span, first_bar, classes, bar_classes, arms })
    }

    /// Those of one design.
    #[inline(always)]
    #[must_use]
    pub(crate) fn links<'b>(&self, bound: &'b LoopVectors) -> Links<'b> {
        let count = self.bar_classes.len();
        let spans = &bound.spans[self.first_span..][..count * count];
        Links { count, spans, bars: &bound.bars[self.first_bar..][..count] }
    }
}

/// Spans and binary links of a group, of one design.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Links<'b> {
    /// Loops, and unknowns.
    pub count: usize,
    /// Loop after loop, of every unknown.
    pub spans: &'b [Vector],
    /// Of every loop.
    pub bars: &'b [Leg],
}

fn class_of(unknown: &Unknown) -> Option<usize> {
    match *unknown {
        Unknown::Class(class) => Some(class),
        Unknown::Slide(_) => None,
    }
}

fn bar_class(chord: &Chord) -> Option<usize> {
    match *chord {
        Chord::Length { class } => Some(class),
        _ => None,
    }
}

/// The vectors of such groups, of one design.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct LoopVectors {
    spans: Vec<Vector>,
    bars: Vec<Leg>,
}

impl LoopVectors {
    /// Measures them on the rigid edges.
    pub(crate) fn measure(&mut self, plan: &Plan, edge_vectors: &[Vector]) {
        self.spans.clear();
        self.bars.clear();
        for group in plan.groups().filter(|group| group.binary_loops.is_some()) {
            for l in &group.loops {
                for column in &l.columns {
                    let mut sum = Vector::ZERO;
                    for term in column {
                        let Some(index) = term.edge else { continue };
                        let v = edge_vectors[group.edges[index].edge];
                        sum += if term.backward { -v } else { v };
                    }
                    self.spans.push(sum);
                }
                self.bars.push(Leg::of(edge_vectors[group.edges[l.edge].edge]));
            }
        }
    }
}
