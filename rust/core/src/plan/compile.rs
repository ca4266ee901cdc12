//! Compiles a linkage and its structure to a plan.

use std::collections::HashMap;
use std::sync::atomic::AtomicBool;

use super::blocks::add_steps;
use super::dyad::{Form, Unknown};
use super::group::BinaryLoops;
use super::leg::LegEdges;
use super::pair_span::PairSpans;
use super::plan::{EdgeSlide, LegEdge, Orientation, Plan, PlanEdge, Step};
use super::redundant;
use super::tape::Tape;
use crate::description::error::{StructureError, check_flag};
use crate::description::{Driver, Linkage};
use crate::structure::Structure;
use crate::structure::closure::{Closure, Span, rotations};

/// The drivers with a multiple other than 0, with that multiple.
fn driver_turns(turns: &[i8]) -> Box<[(usize, i8)]> {
    turns.iter().copied().enumerate().filter(|&(_, t)| t != 0).collect()
}

impl Plan {
    /// Compiles a linkage whose structure has been found.
    ///
    /// # Errors
    ///
    /// [`StructureError::Interrupted`] once `cancel` is true; others only if [`Structure::of`] has
    /// returned them before.
    pub(crate) fn new(
        linkage: &Linkage,
        closure: &Closure,
        structure: &Structure,
        cancel: Option<&AtomicBool>,
    ) -> Result<Self, StructureError> {
        let (rotation, classes) = rotations(linkage, &structure.redundant, true)?;
        let mut orientations: Vec<Orientation> = Vec::new();
        let mut index_of = HashMap::new();
        let mut link_orientation = Vec::new();
        for r in &rotation {
            let driven = r.turns.iter().any(|&t| t != 0);
            let single_driver = match *driver_turns(&r.turns) {
                [(driver, 1)] => Some((driver, false)),
                [(driver, -1)] => Some((driver, true)),
                _ => None,
            };
            let orientation =
                Orientation { class: r.class, turns: r.turns.clone(), driven, single_driver };
            // Class and multiples decide the rest.
            let index = *index_of.entry((r.class, &r.turns)).or_insert_with(|| {
                orientations.push(orientation);
                orientations.len() - 1
            });
            link_orientation.push(index);
        }
        let edges = closure
            .edges
            .iter()
            .enumerate()
            .map(|(index, &edge)| {
                let along = match edge.span {
                    Span::Joint { .. } => EdgeSlide::Nothing,
                    Span::Guide { slide } => {
                        if linkage.drivers.contains(&Driver::Slide(slide)) {
                            EdgeSlide::Driver { slide }
                        } else {
                            EdgeSlide::Slide(slide)
                        }
                    }
                };
                let paired = closure.is_paired(linkage, index);
                PlanEdge {
                    edge,
                    orientation: link_orientation[edge.link],
                    class: rotation[edge.link].class,
                    along,
                    paired,
                    leg: None,
                    on_leg: None,
                }
            })
            .collect();
        let mut plan = Self {
            drivers: linkage.drivers.clone(),
            slide_links: linkage.slides.iter().map(|s| [s.link, s.on]).collect(),
            points: closure.points,
            classes,
            orientations,
            edges,
            rotation,
            link_orientation,
            reference: closure.reference.clone(),
            ground: linkage.ground,
            fixed: closure.fixed.clone(),
            steps: Vec::new(),
            dyad_names: Vec::new(),
            dyad_links: Vec::new(),
            dyad_groups: Vec::new(),
            pairs: PairSpans::default(),
            may_change: Vec::new(),
            leg_edges: LegEdges::default(),
            is_general: false,
            tape: Tape::default(),
            tracing_tape: Tape::default(),
        };
        let kept: Vec<usize> = closure.kept(linkage, &structure.redundant).collect();
        let placed = add_steps(&mut plan, linkage, structure, &kept, cancel)?;
        redundant::add_redundant(&mut plan, linkage, closure, structure, placed);
        if plan.redundant_links().next().is_some() {
            plan.pairs = PairSpans::of(linkage, closure);
        }
        check_flag(cancel)?;
        plan.mark_legs();
        plan.leg_edges = LegEdges::of(plan.dyads());
        plan.may_change = vec![true; plan.signs()];
        plan.tape = Tape::whole(&plan);
        plan.tracing_tape = Tape::for_dyads(&plan, &vec![true; plan.classes]);
        Ok(plan)
    }

    /// Marks the edges that are legs, and drops the orientations that only legs and bars would use.
    fn mark_legs(&mut self) {
        let mut leg_edges = Vec::new();
        for dyad in self.dyads() {
            for unknown in 0..2 {
                let mut turned = dyad.path.iter().filter(|term| term.turns == Some(unknown));
                if let (Some(term), None) = (turned.next(), turned.next())
                    && term.in_leg
                    && term.slides.is_none()
                {
                    let index = 2 * dyad.index + unknown;
                    leg_edges.push((term.edge, LegEdge { index, backward: term.backward }));
                }
            }
        }
        let mut on_leg = vec![None; self.classes];
        for dyad in self.dyads() {
            for (i, unknown) in dyad.unknowns.into_iter().enumerate() {
                let Unknown::Class(class) = unknown else { continue };
                // A turning guide stores the rotation itself in the slot of the other leg.
                on_leg[class] = match dyad.form {
                    Form::TurningGuide => dyad.turning_guide().map(|_| 2 * dyad.index + 1),
                    _ => dyad.leg[i].then_some(2 * dyad.index + i),
                };
            }
        }
        for edge in &mut self.edges {
            let driven = self.orientations[edge.orientation].driven;
            edge.on_leg = if driven { None } else { on_leg[edge.class] };
        }
        let mut used = vec![false; self.orientations.len()];
        // Edges that need no orientation: bars, and arms of groups.
        let mut without = vec![false; self.edges.len()];
        let mut first = 2 * self.dyads().count();
        for step in &mut self.steps {
            let Step::Group(group) = step else { continue };
            group.first_leg = first;
            first += group.edges.len();
        }
        let mut binary_loops: Vec<Option<BinaryLoops>> = Vec::new();
        for group in self.groups() {
            let loops = BinaryLoops::new(self, group, binary_loops.iter().flatten());
            binary_loops.push(loops);
        }
        let mut binary_loops = binary_loops.into_iter();
        for step in &mut self.steps {
            let Step::Group(group) = step else { continue };
            group.binary_loops = binary_loops.next().flatten();
        }
        for group in self.groups() {
            for (index, edge) in group.edges.iter().enumerate() {
                if !group.is_chord(index) {
                    let leg = group.first_leg + index;
                    leg_edges.push((edge.edge, LegEdge { index: leg, backward: false }));
                }
                let is_arm = self.is_arm(group, index);
                without[edge.edge] |= edge.is_bar || is_arm;
                if !edge.is_bar && !is_arm {
                    used[self.edges[edge.edge].orientation] = true;
                }
            }
        }
        for (edge, leg) in leg_edges {
            self.edges[edge].leg = Some(leg);
        }
        for (index, edge) in self.edges.iter().enumerate() {
            if edge.leg.is_none() && !without[index] {
                used[edge.orientation] = true;
            }
        }
        for links in &self.slide_links {
            for &link in links {
                used[self.link_orientation[link]] = true;
            }
        }
        for step in &mut self.steps {
            match step {
                Step::Dyad(dyad) => {
                    for orientations in &mut dyad.orientations {
                        orientations.retain(|&o| used[o]);
                    }
                }
                Step::Group(group) => {
                    for orientations in &mut group.orientations {
                        orientations.retain(|&o| used[o]);
                    }
                    for l in &mut group.loops {
                        l.orientations.retain(|&o| used[o]);
                    }
                }
                _ => {}
            }
        }
    }
}
