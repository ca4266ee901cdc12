//! Steps from blocks of closure equations.

use std::collections::{BTreeSet, HashMap, HashSet, VecDeque};
use std::sync::atomic::AtomicBool;

use super::dyad::{Dyad, Form, LoopTerm, Unknown};
use super::group::Group;
use super::plan::{EdgeSlide, Plan, PlanEdge, Step};
use crate::description::error::{StructureError, check_flag};
use crate::description::{Driver, Linkage};
use crate::structure::Structure;
use crate::structure::assur_group::{Group as AssurGroup, roman};
use crate::structure::matching::{Block, Pattern};

/// Adds the steps of all blocks; returns for every point whether it is fixed or a step places it.
pub(crate) fn add_steps(
    plan: &mut Plan,
    linkage: &Linkage,
    structure: &Structure,
    kept: &[usize],
    cancel: Option<&AtomicBool>,
) -> Result<Vec<bool>, StructureError> {
    let nodes = Nodes::new(plan, linkage, structure, kept);
    let mut tables = Tables::of(plan, structure);
    let blocks = nodes.pattern.blocks().ok_or_else(|| StructureError::OverConstrained {
        excess: 1,
        links: linkage.links.iter().map(|l| l.name.clone()).collect(),
    })?;
    let blocks = groups_first(blocks, &nodes);
    let mut known = plan.fixed.clone();
    for (index, slide) in linkage.slides.iter().enumerate() {
        if slide.length && linkage.drivers.contains(&Driver::Slide(index)) {
            plan.steps.push(Step::Length { slide: index });
        }
    }
    for block in &blocks {
        check_flag(cancel)?;
        let mut edges: Vec<usize> = block.equations.iter().map(|&e| kept[e]).collect();
        let mut unknowns: Vec<Unknown> =
            block.unknowns.iter().filter_map(|&u| nodes.unknown(u)).collect();
        match unknowns.len() {
            0 => {}
            2 => {
                let dyad = dyad(plan, linkage, &mut tables, &mut edges, &mut unknowns, &known);
                plan.steps.push(Step::Dyad(dyad));
            }
            _ => {
                let links = plan_links(linkage, &plan.edges, &edges);
                let assur_group = tables.owner(&unknowns);
                let name = assur_group.map_or_else(
                    || named(linkage, 3, &links),
                    |g| named(linkage, g.class, &g.links),
                );
                let (group, chords) = Group::new(plan, &edges, &unknowns, &known, name);
                edges.retain(|edge| !chords.contains(edge));
                plan.steps.push(Step::Group(group));
            }
        }
        add_length_checks(plan, linkage);
        place_points(plan, &mut known, edges);
    }
    Ok(known)
}

/// Groups above class II and the blocks that they depend on come first. So a dyad that does not close never
/// stops the solver before a group that does not depend on it.
fn groups_first(blocks: Vec<Block>, nodes: &Nodes) -> Vec<Block> {
    let mut block_of = vec![0; nodes.unknowns.len()];
    for (index, block) in blocks.iter().enumerate() {
        for &unknown in &block.unknowns {
            block_of[unknown] = index;
        }
    }
    let mut first = vec![false; blocks.len()];
    for (index, block) in blocks.iter().enumerate().rev() {
        let is_group = block.unknowns.iter().filter_map(|&u| nodes.unknown(u)).count() > 2;
        first[index] |= is_group;
        if first[index] {
            for &equation in &block.equations {
                for &unknown in &nodes.pattern.unknowns_in[equation] {
                    first[block_of[unknown]] = true;
                }
            }
        }
    }
    let (before, after): (Vec<_>, Vec<_>) =
        blocks.into_iter().zip(first).partition(|&(_, first)| first);
    before.into_iter().chain(after).map(|(block, _)| block).collect()
}

/// Adds checks of the lengths that the last step finds, unless their sign is that of a square root.
fn add_length_checks(plan: &mut Plan, linkage: &Linkage) {
    let unknowns = match plan.steps.last() {
        Some(Step::Dyad(dyad)) if !dyad.is_length => dyad.unknowns.to_vec(),
        Some(Step::Group(group)) => group.all_unknowns().collect(),
        _ => return,
    };
    let checks = unknowns.into_iter().filter_map(|unknown| match unknown {
        Unknown::Slide(slide) if linkage.slides[slide].length => Some(Step::Length { slide }),
        _ => None,
    });
    plan.steps.extend(checks);
}

fn plan_links(linkage: &Linkage, edges: &[PlanEdge], chosen: &[usize]) -> Vec<usize> {
    let mut links: Vec<usize> = chosen.iter().map(|&e| edges[e].edge.link).collect();
    links.extend(
        chosen.iter().filter_map(|&e| edges[e].edge.slide()).map(|s| linkage.slides[s].link),
    );
    links.sort_unstable();
    links.dedup();
    links.retain(|&l| l != linkage.ground);
    links
}

/// Tables to look up for every block.
struct Tables<'s> {
    groups: &'s [AssurGroup],
    /// The first group in solving order that has each slide, and each class.
    of_slide: HashMap<usize, usize>,
    of_class: HashMap<usize, usize>,
    /// The orientations of every class, in order.
    orientations: Vec<Vec<usize>>,
    /// Names of the dyads so far, and their number.
    names: HashSet<String>,
    dyads: usize,
}

impl<'s> Tables<'s> {
    fn of(plan: &Plan, structure: &'s Structure) -> Self {
        let (mut of_slide, mut of_class) = (HashMap::new(), HashMap::new());
        for (index, group) in structure.groups.iter().enumerate() {
            for &slide in &group.slides {
                of_slide.entry(slide).or_insert(index);
            }
            for &link in &group.links {
                of_class.entry(plan.rotation[link].class).or_insert(index);
            }
        }
        let mut orientations = vec![Vec::new(); plan.classes];
        for (index, orientation) in plan.orientations.iter().enumerate() {
            orientations[orientation.class].push(index);
        }
        let groups = &structure.groups;
        Self { groups, of_slide, of_class, orientations, names: HashSet::new(), dyads: 0 }
    }

    /// The Assur group of some unknowns. A slide is a pair of one group; an angle belongs to the links of the
    /// first group in solving order that has it, and later groups know it.
    fn owner(&self, unknowns: &[Unknown]) -> Option<&'s AssurGroup> {
        let of_slide = unknowns.iter().find_map(|unknown| match unknown {
            Unknown::Slide(slide) => self.of_slide.get(slide),
            Unknown::Class(_) => None,
        });
        let classes = unknowns.iter().filter_map(|unknown| match unknown {
            Unknown::Class(class) => self.of_class.get(class),
            Unknown::Slide(_) => None,
        });
        of_slide.or_else(|| classes.min()).map(|&group| &self.groups[group])
    }

    /// The orientations that turn with an unknown.
    fn turning(&self, unknown: Unknown) -> Vec<usize> {
        match unknown {
            Unknown::Class(class) => self.orientations[class].clone(),
            Unknown::Slide(_) => Vec::new(),
        }
    }
}

/// Class and links of a group, for messages.
fn named(linkage: &Linkage, class: usize, links: &[usize]) -> String {
    let names: Vec<&str> = links.iter().map(|&l| linkage.links[l].name.as_str()).collect();
    format!("{}({})", roman(class), names.join(", "))
}

/// Incidence pattern of the kept edges' equations, and the meaning of its unknowns.
struct Nodes {
    pattern: Pattern,
    unknowns: Vec<Option<Unknown>>,
}

impl Nodes {
    fn new(plan: &Plan, linkage: &Linkage, structure: &Structure, kept: &[usize]) -> Self {
        let mut nodes = Self { pattern: Pattern::default(), unknowns: Vec::new() };
        let mut point = vec![None; plan.points];
        let mut class = vec![None; plan.classes];
        let keeps = structure.redundant.keeps(linkage);
        for &e in kept {
            for p in [plan.edges[e].edge.from, plan.edges[e].edge.to] {
                if !plan.fixed[p] && point[p].is_none() {
                    point[p] = Some(nodes.add(2, None));
                }
            }
        }
        for (l, &orientation) in plan.link_orientation.iter().enumerate() {
            let c = plan.orientations[orientation].class;
            let is_kept = keeps[l] && l != linkage.ground;
            if c != 0 && is_kept && class[c].is_none() {
                class[c] = Some(nodes.add(1, Some(Unknown::Class(c))));
            }
        }
        for &e in kept {
            let edge = &plan.edges[e];
            let mut touched: Vec<usize> =
                [point[edge.edge.from], point[edge.edge.to]].into_iter().flatten().collect();
            touched.extend(class[plan.class_of(e)]);
            if let EdgeSlide::Slide(s) = edge.along {
                touched.push(nodes.add(1, Some(Unknown::Slide(s))));
            }
            nodes.pattern.add_equation(2, touched);
        }
        nodes
    }

    fn add(&mut self, size: usize, unknown: Option<Unknown>) -> usize {
        self.unknowns.push(unknown);
        self.pattern.add_unknown(size)
    }

    fn unknown(&self, node: usize) -> Option<Unknown> {
        self.unknowns[node]
    }
}

/// Adds steps that place points along edges, as far as the known points reach.
fn place_points(plan: &mut Plan, known: &mut [bool], mut edges: Vec<usize>) {
    loop {
        let count = edges.len();
        edges.retain(|&edge| {
            let e = &plan.edges[edge].edge;
            match (known[e.from], known[e.to]) {
                (true, false) => {
                    known[e.to] = true;
                    plan.steps.push(Step::Place { edge, backward: false });
                    false
                }
                (false, true) => {
                    known[e.from] = true;
                    plan.steps.push(Step::Place { edge, backward: true });
                    false
                }
                _ => true,
            }
        });
        if edges.len() == count {
            return;
        }
    }
}

/// A path: edges, true for one that is traversed backward.
type Path = Vec<(usize, bool)>;

/// The edge that closes the loop of a block (its index among the edges), and the paths over it and to its
/// other end.
fn closing(plan: &Plan, edges: &[usize], known: &[bool]) -> Option<(usize, Path, Path)> {
    // Breadth-first paths from the known points; the remaining edge closes the loop.
    let ends: BTreeSet<usize> =
        edges.iter().flat_map(|&edge| plan.edges[edge].ends(false)).collect();
    let mut queue: VecDeque<usize> = ends.into_iter().filter(|&point| known[point]).collect();
    let mut path: HashMap<usize, Path> = queue.iter().map(|&point| (point, Vec::new())).collect();
    let mut closing = None;
    let mut used = vec![false; edges.len()];
    while let Some(here) = queue.pop_front() {
        for (i, &edge) in edges.iter().enumerate() {
            let e = &plan.edges[edge].edge;
            let (next, backward) = match here {
                h if h == e.from => (e.to, false),
                h if h == e.to => (e.from, true),
                _ => continue,
            };
            if used[i] {
                continue;
            }
            used[i] = true;
            let mut extended = path.get(&here).cloned().unwrap_or_default();
            extended.push((edge, backward));
            match path.get(&next) {
                None => {
                    path.insert(next, extended);
                    queue.push_back(next);
                }
                Some(other_path) => closing = Some((i, extended, other_path.clone())),
            }
        }
    }
    closing
}

/// Finds the loop of a block, and removes the edge that closes it from `edges` (the others place
/// the points).
fn dyad(
    plan: &mut Plan,
    linkage: &Linkage,
    tables: &mut Tables<'_>,
    edges: &mut Vec<usize>,
    unknowns: &mut [Unknown],
    known: &[bool],
) -> Dyad {
    let (closing_edge, ahead, back) = closing(plan, edges, known).unwrap_or_default();
    // The loop leaves out the common start of the two paths.
    let common = ahead.iter().zip(&back).take_while(|(a, b)| a == b).count();
    let mut loop_path: Vec<(usize, bool)> = ahead[common..].to_vec();
    loop_path.extend(back[common..].iter().rev().map(|&(e, b)| (e, !b)));
    if closing_edge < edges.len() {
        edges.remove(closing_edge);
    }
    let tip = |(e, backward): (usize, bool)| {
        let edge = &plan.edges[e].edge;
        if backward { edge.from } else { edge.to }
    };
    let tail = |(e, backward): (usize, bool)| tip((e, !backward));
    order_unknowns(plan, &loop_path, unknowns);
    let unknowns = [unknowns[0], unknowns[1]];
    let form = form(plan, unknowns);
    let start = loop_path.first().map_or(0, |&x| tail(x));
    let end = loop_path.last().map_or(0, |&x| tip(x));
    let (start, end) = if start == end {
        rotate_to_first(plan, &mut loop_path, unknowns[0]);
        // A closed loop does not depend on any point and may avoid all known ones: start at the origin.
        (0, 0)
    } else {
        (start, end)
    };
    let sign = (form != Form::TwoLines).then(|| {
        let name = inner_pair(plan, linkage, &loop_path, form, unknowns, &tip, &tail);
        let links =
            plan_links(linkage, &plan.edges, &loop_path.iter().map(|x| x.0).collect::<Vec<_>>());
        let moves =
            |&l: &usize| plan.rotation[l].class != 0 || linkage.slides.iter().any(|s| s.link == l);
        let moving: Vec<usize> = links.into_iter().filter(moves).collect();
        let names: Vec<&str> = moving.iter().map(|&l| linkage.links[l].name.as_str()).collect();
        let assur_group = tables.owner(&unknowns);
        let group = assur_group
            .map_or_else(|| named(linkage, 2, &moving), |g| named(linkage, g.class, &g.links));
        (name, names.join("-"), group)
    });
    let sign = sign.map(|(name, links, group)| {
        // Loops through links with driven angles may share their inner joint.
        let name = if tables.names.contains(&name) { links.clone() } else { name };
        tables.names.insert(name.clone());
        plan.dyad_names.push(name);
        plan.dyad_links.push(links);
        plan.dyad_groups.push(group);
        plan.dyad_names.len() - 1
    });
    let orientations = unknowns.map(|unknown| tables.turning(unknown));
    let (path, leg) = loop_terms(plan, loop_path, unknowns);
    let others =
        path.iter().copied().filter(|term| !term.in_leg || term.slides.is_some()).collect();
    let index = tables.dyads;
    tables.dyads += 1;
    let rrr_classes = match unknowns {
        [Unknown::Class(a), Unknown::Class(b)] if path.iter().all(|term| term.in_leg) => {
            Some([a, b])
        }
        _ => None,
    };
    let is_length = is_length(linkage, form, unknowns, &path);
    Dyad {
        form,
        unknowns,
        orientations,
        path,
        others,
        leg,
        rrr_classes,
        index,
        start,
        end,
        sign,
        is_length,
    }
}

/// Whether a dyad consists only of a slide that turns about both its joints and whose value is a length.
fn is_length(linkage: &Linkage, form: Form, unknowns: [Unknown; 2], path: &[LoopTerm]) -> bool {
    let is_alone = matches!(path, [term] if term.slides.is_some());
    form == Form::TurningGuide
        && is_alone
        && matches!(unknowns[1], Unknown::Slide(slide) if linkage.slides[slide].length)
}

/// The terms that a loop's edges add to its equation, and for each unknown whether it has a leg.
fn loop_terms(
    plan: &Plan,
    loop_path: Vec<(usize, bool)>,
    unknowns: [Unknown; 2],
) -> (Vec<LoopTerm>, [bool; 2]) {
    let position = |unknown| unknowns.iter().position(|&u| u == unknown);
    let mut path: Vec<LoopTerm> = loop_path
        .into_iter()
        .map(|(edge, backward)| {
            let turns = position(Unknown::Class(plan.class_of(edge)));
            let slides = match plan.edges[edge].along {
                EdgeSlide::Slide(s) => position(Unknown::Slide(s)),
                _ => None,
            };
            LoopTerm { edge, backward, turns, slides, in_leg: false }
        })
        .collect();
    let leg = [0, 1].map(|unknown| {
        let mut turning = path.iter().filter(|term| term.turns == Some(unknown)).peekable();
        turning.peek().is_some()
            && turning.all(|term| {
                let edge = &plan.edges[term.edge];
                let constant = edge.along == EdgeSlide::Nothing || term.slides.is_some();
                constant && !plan.orientations[edge.orientation].driven
            })
    });
    for term in &mut path {
        term.in_leg = term.turns.is_some_and(|unknown| leg[unknown]);
    }
    (path, leg)
}

/// A closed loop may start anywhere: here at the edges of its first unknown, so that one end of
/// them is the inner pair.
fn rotate_to_first(plan: &Plan, path: &mut [(usize, bool)], first: Unknown) {
    let has_unknown = |e: usize| match first {
        Unknown::Class(c) => plan.class_of(e) == c,
        Unknown::Slide(s) => plan.edges[e].along == EdgeSlide::Slide(s),
    };
    let n = path.len();
    let begin = (0..n).find(|&i| has_unknown(path[i].0) && !has_unknown(path[(i + n - 1) % n].0));
    path.rotate_left(begin.unwrap_or(0));
}

/// Sorts rotations before slides, and of two rotations that of the link listed first.
fn order_unknowns(plan: &Plan, path: &[(usize, bool)], unknowns: &mut [Unknown]) {
    unknowns.sort_by_key(|u| match *u {
        Unknown::Class(c) => {
            let first = path
                .iter()
                .filter(|(e, _)| plan.class_of(*e) == c)
                .map(|(e, _)| plan.edges[*e].edge.link);
            (0, first.min().unwrap_or(usize::MAX))
        }
        Unknown::Slide(s) => (1, s),
    });
}

fn form(plan: &Plan, unknowns: [Unknown; 2]) -> Form {
    match unknowns {
        [Unknown::Class(_), Unknown::Class(_)] => Form::TwoCircles,
        [Unknown::Slide(_), _] => Form::TwoLines,
        [Unknown::Class(c), Unknown::Slide(s)] => {
            let edge = plan.edges.iter().position(|e| e.along == EdgeSlide::Slide(s));
            if edge.is_some_and(|e| plan.class_of(e) == c) {
                Form::TurningGuide
            } else {
                Form::CircleAndLine
            }
        }
    }
}

/// Name of the dyad's inner pair: the slide of a turning guide, else the joint between the edges
/// of the first unknown and those of the second.
fn inner_pair(
    plan: &Plan,
    linkage: &Linkage,
    path: &[(usize, bool)],
    form: Form,
    unknowns: [Unknown; 2],
    tip: &impl Fn((usize, bool)) -> usize,
    tail: &impl Fn((usize, bool)) -> usize,
) -> String {
    let has_unknown = |e: usize, unknown: Unknown| match unknown {
        Unknown::Class(c) => plan.class_of(e) == c,
        Unknown::Slide(s) => plan.edges[e].along == EdgeSlide::Slide(s),
    };
    let slide_name = |unknown: Unknown| match unknown {
        Unknown::Slide(s) => Some(linkage.slides[s].name.clone()),
        Unknown::Class(_) => None,
    };
    if form == Form::TurningGuide {
        return slide_name(unknowns[1]).unwrap_or_default();
    }
    let ranks =
        |u| path.iter().enumerate().filter(move |(_, x)| has_unknown(x.0, u)).map(|(i, _)| i);
    let (first, second) =
        (ranks(unknowns[0]).collect::<Vec<_>>(), ranks(unknowns[1]).collect::<Vec<_>>());
    let point = match (first.last(), second.first()) {
        (Some(&a), Some(&b)) if a < b => tip(path[a]),
        _ => first.first().map_or(0, |&a| tail(path[a])),
    };
    match point.checked_sub(1).and_then(|j| linkage.joints.get(j)) {
        Some(joint) => joint.name.clone(),
        None => {
            slide_name(unknowns[1]).unwrap_or_else(|| format!("dyad{}", plan.dyad_names.len() + 1))
        }
    }
}
