//! Independent loops of groups above class II, with as few unknowns as possible.
//!
//! A spanning tree of the block's graph leaves chords, and each chord closes one independent loop.
//! If nothing else turns with a chord (a binary link), one equation for its length is enough. If a
//! chord lies along a guide, one equation for the distance of its end from the guide is enough.
//! Both eliminate an unknown, so the tree takes other edges first.

use super::dyad::Unknown;
use super::group::{Chord, ColumnTerm, Group, GroupEdge, Loop, LoopEdge};
use super::plan::{EdgeSlide, Plan};

impl Group {
    /// Finds the loops of a block; also returns their chords, which do not place points.
    pub(crate) fn new(
        plan: &Plan,
        edges: &[usize],
        unknowns: &[Unknown],
        known: &[bool],
        name: String,
    ) -> (Self, Vec<usize>) {
        let chord = |edge: usize| chord_of(plan, edges, unknowns, edge);
        // A stable sort keeps the order of the description among equals.
        let mut order: Vec<usize> = edges.to_vec();
        order.sort_by_key(|&edge| usize::from(chord(edge) != Chord::Whole));
        let (tree, chords) = spanning_tree(plan, &order, known);
        let eliminated: Vec<Unknown> = chords
            .iter()
            .filter_map(|&edge| match chord(edge) {
                Chord::Length { class } => Some(Unknown::Class(class)),
                Chord::Guide { slide } => Some(Unknown::Slide(slide)),
                Chord::Whole => None,
            })
            .collect();
        let unknowns: Vec<Unknown> =
            unknowns.iter().copied().filter(|u| !eliminated.contains(u)).collect();
        let mut loops: Vec<Loop> =
            chords.iter().map(|&e| close_loop(plan, &tree, e, chord(e), edges)).collect();
        let position = |unknown| unknowns.iter().position(|&u| u == unknown);
        let edges: Vec<GroupEdge> = edges
            .iter()
            .map(|&edge| GroupEdge {
                edge,
                turns: position(Unknown::Class(plan.class_of(edge))),
                slides: match plan.edges[edge].along {
                    EdgeSlide::Slide(slide) => position(Unknown::Slide(slide)),
                    _ => None,
                },
                is_bar: matches!(chord(edge), Chord::Length { .. })
                    && chords.contains(&edge)
                    && plan.edges[edge].along == EdgeSlide::Nothing,
            })
            .collect();
        for l in &mut loops {
            l.columns = (0..unknowns.len()).map(|unknown| column(&edges, l, unknown)).collect();
        }
        let orientations = unknowns.iter().map(|&unknown| orientations_of(plan, unknown)).collect();
        let rows = loops.iter().map(|l| if l.chord == Chord::Whole { 2 } else { 1 }).sum();
        let index = plan.groups().count();
        (
            Self {
                unknowns,
                orientations,
                edges,
                loops,
                rows,
                name,
                index,
                first_leg: 0,
                binary_loops: None,
            },
            chords,
        )
    }
}

/// Derivative of a loop's chord by an unknown.
fn column(edges: &[GroupEdge], l: &Loop, unknown: usize) -> Vec<ColumnTerm> {
    let mut column = Vec::new();
    let mut add = |index: usize, backward: bool| {
        let edge = &edges[index];
        for (moved_by, turns) in [(edge.turns, true), (edge.slides, false)] {
            if moved_by == Some(unknown) {
                column.push(ColumnTerm { edge: Some(index), turns, backward });
            }
        }
    };
    for path_edge in &l.path {
        add(path_edge.edge, path_edge.backward);
    }
    match l.chord {
        Chord::Whole => add(l.edge, true),
        Chord::Guide { .. } if edges[l.edge].turns == Some(unknown) => {
            // In the frame of the turning guide the chord turns back.
            column.push(ColumnTerm { edge: None, turns: true, backward: true });
        }
        _ => {}
    }
    column
}

/// Orientations that turn with an unknown.
fn orientations_of(plan: &Plan, unknown: Unknown) -> Vec<usize> {
    let turns_with = |o: &usize| unknown == Unknown::Class(plan.orientations[*o].class);
    (0..plan.orientations.len()).filter(turns_with).collect()
}

/// The condition that an edge would add as a chord.
fn chord_of(plan: &Plan, edges: &[usize], unknowns: &[Unknown], edge: usize) -> Chord {
    let class = plan.class_of(edge);
    let alone = edges.iter().filter(|&&e| plan.class_of(e) == class).count() == 1;
    match plan.edges[edge].along {
        EdgeSlide::Slide(slide) if unknowns.contains(&Unknown::Slide(slide)) => {
            Chord::Guide { slide }
        }
        _ if alone && unknowns.contains(&Unknown::Class(class)) => Chord::Length { class },
        _ => Chord::Whole,
    }
}

/// For every point the tree's edge that reaches it, and whether it is traversed backward.
type Tree = Vec<Option<(usize, bool)>>;

/// Spanning tree that takes edges in `order` unless they would close a loop; all known points
/// count as one. The remaining edges are chords.
fn spanning_tree(plan: &Plan, order: &[usize], known: &[bool]) -> (Tree, Vec<usize>) {
    let mut part: Vec<usize> = (0..plan.points).collect();
    if let Some(root) = known.iter().position(|&k| k) {
        for (point, part) in part.iter_mut().enumerate() {
            if known[point] {
                *part = root;
            }
        }
    }
    let (mut inside, mut chords) = (Vec::new(), Vec::new());
    for &edge in order {
        let [a, b] = plan.edges[edge].ends(false).map(|point| part[point]);
        if a == b {
            chords.push(edge);
        } else {
            part.iter_mut().filter(|p| **p == b).for_each(|p| *p = a);
            inside.push(edge);
        }
    }
    chords.sort_unstable();
    let mut tree: Tree = vec![None; plan.points];
    let mut seen = known.to_vec();
    loop {
        let mut grown = false;
        for &edge in &inside {
            let [from, to] = plan.edges[edge].ends(false);
            for (here, next, backward) in [(from, to, false), (to, from, true)] {
                if seen[here] && !seen[next] {
                    seen[next] = true;
                    tree[next] = Some((edge, backward));
                    grown = true;
                }
            }
        }
        if grown {
            continue;
        }
        // A component without a known point grows from any of its points.
        let Some(&edge) = inside.iter().find(|&&e| !seen[plan.edges[e].edge.from]) else { break };
        seen[plan.edges[edge].edge.from] = true;
    }
    (tree, chords)
}

fn close_loop(plan: &Plan, tree: &Tree, edge: usize, chord: Chord, edges: &[usize]) -> Loop {
    let to_root = |mut point: usize| {
        let mut run = Vec::new();
        while let Some((edge, backward)) = tree[point] {
            run.push((edge, backward));
            let [tail, _] = plan.edges[edge].ends(backward);
            point = tail;
        }
        (point, run)
    };
    let [from, to] = plan.edges[edge].ends(false);
    let ((start, mut back), (end, mut ahead)) = (to_root(from), to_root(to));
    // The loop leaves out the common start of the two paths.
    while let (Some(a), Some(b)) = (back.last(), ahead.last())
        && a == b
    {
        back.pop();
        ahead.pop();
    }
    let (start, end) = if start == end { (0, 0) } else { (start, end) };
    let position = |edge: usize| edges.iter().position(|&e| e == edge).unwrap_or(0);
    let loop_edge = |(edge, backward)| LoopEdge { edge: position(edge), backward };
    let back = back.into_iter().map(|(edge, backward)| (edge, !backward));
    let path = back.chain(ahead.into_iter().rev()).map(loop_edge).collect();
    let orientations = match chord {
        Chord::Length { class } => orientations_of(plan, Unknown::Class(class)),
        _ => Vec::new(),
    };
    Loop { edge: position(edge), chord, start, end, path, orientations, columns: Vec::new() }
}
