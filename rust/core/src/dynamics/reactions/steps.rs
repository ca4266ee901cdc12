//! The steps of a plan, transposed: how loads pass from the last group to the drivers, and the states
//! of stress that redundant links allow.

use crate::plan::dyad::Unknown;
use crate::plan::mechanism::Mechanism;
use crate::plan::plan::{AngleFrom, EdgeSlide, Plan, RedundantLink, Step};
use crate::state::closures::Closures;

/// A step of the solution, transposed.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Transposed {
    /// The load on a point passes along an edge to the point that places it.
    Carry { edge: usize, backward: bool },
    /// The loads on the unknowns of closed paths give the forces that close these.
    Close { closures: Closures, unknowns: Vec<LoadedUnknown> },
    /// The moment on a redundant link becomes a couple of forces at two joints.
    TurnByJoints { link: usize, edges: [Option<usize>; 2], points: [usize; 2] },
    /// The moment on a redundant link passes to the other link of a slide.
    TurnBySlide { link: usize, slide: usize },
}

/// The part that an unknown of a group moves.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum LoadedUnknown {
    /// Links that turn together.
    Links(Vec<usize>),
    /// The part that slides along a guide.
    Slide(usize),
}

/// A state of stress without loads.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum SelfStress {
    /// A force at the end of an edge along an axis.
    Component { edge: usize, axis: usize },
    /// A force at the end of an edge along the line between two points.
    Along { edge: usize, points: [usize; 2] },
    /// A force at the end of a guide's edge, across the guide.
    Across { edge: usize },
    /// A moment between the links of a slide.
    Moment { slide: usize },
}

/// The steps of a plan in reverse, each transposed.
pub(crate) fn transposed_steps(plan: &Plan) -> Vec<Transposed> {
    let transposed = |step: &Step| match step {
        // The end is a coupler point: loads act on links, so it carries no load.
        &Step::Place { edge, .. } if !plan.edges[edge].paired => Vec::new(),
        &Step::Place { edge, backward } => vec![Transposed::Carry { edge, backward }],
        Step::Dyad(_) | Step::Group(_) => Closures::of_step(step)
            .map(|closures| {
                let unknowns = closures.unknowns.iter().map(|&u| loaded_unknown(plan, u)).collect();
                Transposed::Close { closures, unknowns }
            })
            .into_iter()
            .collect(),
        Step::Redundant(redundant) => of_redundant(redundant),
        Step::Length { .. } => Vec::new(),
    };
    plan.steps.iter().rev().flat_map(transposed).collect()
}

fn loaded_unknown(plan: &Plan, unknown: Unknown) -> LoadedUnknown {
    match unknown {
        Unknown::Class(class) => {
            let links = 0..plan.rotation.len();
            LoadedUnknown::Links(links.filter(|&l| plan.rotation[l].class == class).collect())
        }
        Unknown::Slide(slide) => LoadedUnknown::Slide(slide),
    }
}

/// The transposed steps of a redundant link or slide: its moment goes to the part that holds its angle, and
/// its force to the point that places it.
fn of_redundant(redundant: &RedundantLink) -> Vec<Transposed> {
    let carried = redundant.places.iter().rev();
    let mut steps: Vec<_> =
        carried.map(|&(edge, backward)| Transposed::Carry { edge, backward }).collect();
    match redundant.angle_from {
        Some(AngleFrom::Joints { link, first, second, points }) => {
            steps.push(Transposed::TurnByJoints { link, edges: [first, second], points });
        }
        Some(AngleFrom::Slide { link, slide }) => {
            steps.push(Transposed::TurnBySlide { link, slide });
        }
        None => {}
    }
    steps
}

/// The self-stresses of a mechanism: one for each closure equation that is only checked.
pub(crate) fn self_stresses(mechanism: &Mechanism) -> Vec<SelfStress> {
    let plan = mechanism.plan();
    plan.redundant_links().flat_map(|redundant| of_part(plan, redundant)).collect()
}

fn of_part(plan: &Plan, redundant: &RedundantLink) -> Vec<SelfStress> {
    let mut stresses = Vec::new();
    let (mut turned_by, mut held_by) = (None, None);
    match redundant.angle_from {
        Some(AngleFrom::Joints { second, points, .. }) => turned_by = second.map(|e| (e, points)),
        Some(AngleFrom::Slide { slide, .. }) => held_by = Some(slide),
        None => {}
    }
    for &edge in &redundant.checks {
        match (plan.edges[edge].along, turned_by) {
            (EdgeSlide::Nothing, Some((turning, points))) if turning == edge => {
                stresses.push(SelfStress::Along { edge, points });
            }
            (EdgeSlide::Nothing, _) => {
                stresses.extend([0, 1].map(|axis| SelfStress::Component { edge, axis }));
            }
            _ => stresses.push(SelfStress::Across { edge }),
        }
    }
    let checked = redundant.parallel.iter().map(|&(slide, _)| slide);
    stresses.extend(
        checked.filter(|&slide| held_by != Some(slide)).map(|slide| SelfStress::Moment { slide }),
    );
    stresses
}
