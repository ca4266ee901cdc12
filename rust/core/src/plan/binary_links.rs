//! Groups above class II of rigid links and turning pairs in which a binary link closes every loop.
//! Most groups are of this kind, and their equations need no sorting by term.
//!
//! In each loop, all that turns with one unknown is one vector (a span), constant over all
//! positions. So the vector of a loop's chord is a known vector plus the spans, each turned by its
//! unknown.

use super::dyad::Unknown;
use super::group::{Arm, BinaryLoops, Chord, Group};
use super::leg::Leg;
use super::plan::{EdgeSlide, Plan};
use crate::math::vector::Vector;

/// Greatest number of unknowns (and loops); larger groups use the general kernel.
pub(crate) const MAX_UNKNOWNS: usize = 3;

impl BinaryLoops {
    /// The loops of such a group, else `None`; `earlier` are those of the groups before it.
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
                    let class = class_of(&group.unknowns[unknown])?;
                    arms.push(Arm { edge: edge.edge, leg: group.first_leg + index, class });
                }
                None if edge.is_bar => {}
                None => return None,
            }
        }
        let fits = square
            && (2..=MAX_UNKNOWNS).contains(&bar_classes.len())
            && classes.len() == bar_classes.len();
        let (mut first_span, mut first_bar) = (0, 0);
        for group in earlier {
            first_span += group.classes.len() * group.classes.len();
            first_bar += group.bar_classes.len();
        }
        fits.then_some(Self { first_span, first_bar, classes, bar_classes, arms })
    }

    /// The spans and binary links of one design, if it has `N` of these.
    #[inline(always)]
    pub(crate) fn links<'b, const N: usize>(
        &self,
        constants: &'b LoopVectors,
    ) -> Option<Links<'b, N>> {
        let spans = constants.spans.get(self.first_span..)?;
        let bars = constants.bars.get(self.first_bar..)?;
        Some(Links {
            spans: spans.as_chunks::<N>().0.first_chunk::<N>()?,
            bars: bars.first_chunk::<N>()?,
        })
    }
}

/// Spans and binary links of one group of one design, with `N` loops and as many unknowns.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Links<'b, const N: usize> {
    /// Spans: for every loop, one per unknown.
    pub spans: &'b [[Vector; N]; N],
    /// The binary link of every loop.
    pub bars: &'b [Leg; N],
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

/// Spans and binary links of all such groups of one design.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct LoopVectors {
    spans: Vec<Vector>,
    bars: Vec<Leg>,
}

impl LoopVectors {
    /// Computes them from the edge vectors.
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
