//! Steps that place redundant links and check their closure.

use super::plan::{AngleFrom, Plan, RedundantLink, Step};
use crate::description::Linkage;
use crate::structure::Structure;
use crate::structure::closure::{Closure, Span, point_of_joint};

/// Adds the steps that place and check redundant links and slides.
pub(crate) fn add_redundant(
    plan: &mut Plan,
    linkage: &Linkage,
    closure: &Closure,
    structure: &Structure,
    mut known: Vec<bool>,
) {
    let redundant_parts = &structure.redundant;
    let mut waiting: Vec<usize> = redundant_parts.links.iter().rev().copied().collect();
    let mut placed_links: Vec<usize> =
        (0..linkage.links.len()).filter(|l| !redundant_parts.links.contains(l)).collect();
    let mut checked = Vec::new();
    while !waiting.is_empty() {
        let count = waiting.len();
        waiting.retain(|&link| {
            let redundant = redundant_link(plan, linkage, closure, link, &placed_links, &mut known);
            let Some(redundant) = redundant else { return true };
            checked.extend(redundant.parallel.iter().map(|&(slide, _)| slide));
            plan.steps.push(Step::Redundant(redundant));
            placed_links.push(link);
            false
        });
        if waiting.len() == count {
            break;
        }
    }
    for &slide in &redundant_parts.slides {
        if !checked.contains(&slide) {
            let checks: Vec<usize> = slide_edge(closure, slide).into_iter().collect();
            let name = linkage.slides[slide].name.clone();
            plan.steps.push(Step::Redundant(RedundantLink {
                name,
                angle_from: None,
                places: vec![],
                touched: checks.clone(),
                checks,
                parallel: vec![(slide, linkage.slides[slide].on)],
            }));
        }
    }
    let checks: Vec<Step> = (0..linkage.slides.len())
        .filter(|&slide| linkage.slides[slide].length)
        .filter(|slide| checked.contains(slide) || redundant_parts.slides.contains(slide))
        .map(|slide| Step::Length { slide })
        .filter(|check| !plan.steps.contains(check))
        .collect();
    plan.steps.extend(checks);
}

fn slide_edge(closure: &Closure, slide: usize) -> Option<usize> {
    closure.edges.iter().position(|e| e.span == Span::Guide { slide })
}

fn redundant_link(
    plan: &Plan,
    linkage: &Linkage,
    closure: &Closure,
    link: usize,
    placed_links: &[usize],
    known: &mut [bool],
) -> Option<RedundantLink> {
    let joints = &linkage.links[link].joints;
    let edge_to =
        |joint: usize| closure.edges.iter().position(|e| e.span == Span::Joint { link, joint });
    let carried: Vec<usize> =
        joints.iter().copied().filter(|&j| known[point_of_joint(j)]).collect();
    let slides: Vec<usize> = (0..linkage.slides.len())
        .filter(|&s| {
            let x = &linkage.slides[s];
            (x.link == link && placed_links.contains(&x.on))
                || (x.on == link && placed_links.contains(&x.link))
        })
        .collect();
    let angle_from = match (&carried[..], &slides[..]) {
        (&[a, b, ..], _) => AngleFrom::Joints {
            link,
            first: edge_to(a),
            second: edge_to(b),
            points: [point_of_joint(a), point_of_joint(b)],
        },
        (&[_], &[slide, ..]) => AngleFrom::Slide { link, slide },
        _ => return None,
    };
    let (mut places, mut checks) = (Vec::new(), Vec::new());
    let first = plan.reference[link];
    if !known[first]
        && let Some(edge) = carried.first().and_then(|&a| edge_to(a))
    {
        places.push((edge, true));
        known[first] = true;
    }
    for &joint in joints.iter().skip(1) {
        let Some(edge) = edge_to(joint) else { continue };
        if places.contains(&(edge, true)) {
            continue;
        }
        if known[point_of_joint(joint)] {
            checks.push(edge);
        } else {
            places.push((edge, false));
            known[point_of_joint(joint)] = true;
        }
    }
    checks.extend(slides.iter().filter_map(|&s| slide_edge(closure, s)));
    let touched = checks.iter().copied().chain(places.iter().map(|&(e, _)| e)).collect();
    Some(RedundantLink {
        name: linkage.links[link].name.clone(),
        angle_from: Some(angle_from),
        places,
        checks,
        touched,
        parallel: slides.into_iter().map(|s| (s, linkage.slides[s].on)).collect(),
    })
}
