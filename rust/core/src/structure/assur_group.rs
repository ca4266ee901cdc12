//! Assur groups: the smallest parts of zero mobility, in solving order.
//!
//! With the drivers locked, every link has 3 unknowns and every joint 2; every joint
//! on a link gives 2 equations, and so does every sliding pair. The groups are the
//! smallest sets of links whose equations determine their unknowns (Assur 1914,
//! Artobolevsky 1975).

use std::collections::BTreeSet;
use std::sync::atomic::AtomicBool;

use super::closure::LeftOut;
use super::contour::minimum_cycle_basis;
use super::matching::{Block, Pattern};
use crate::description::error::{Interrupted, check_flag};
use crate::description::{Driver, Linkage};

/// One Assur group.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Group {
    /// Class: 2 for a dyad, 3, 4 … for higher groups.
    pub class: usize,
    /// Order: number of external pairs.
    pub order: usize,
    /// Kind of dyad: `RRR`, `RRP`, `RPR`, `PRP` or `RPP`; `None` for higher groups.
    pub kind: Option<&'static str>,
    /// Its links, in the description's order.
    pub links: Vec<usize>,
    /// Joints that are pairs of this group, in the description's order.
    pub joints: Vec<usize>,
    /// Slides that are pairs of this group, in the description's order.
    pub slides: Vec<usize>,
}

impl Group {
    /// Artobolevsky's number of the kind, 1 to 5.
    #[must_use]
    pub fn artobolevsky_kind(&self) -> Option<usize> {
        let kinds = ["RRR", "RRP", "RPR", "PRP", "RPP"];
        self.kind.and_then(|k| kinds.iter().position(|&x| x == k)).map(|p| p + 1)
    }
}

/// Roman numeral of a class, below 90.
#[must_use]
pub(crate) fn roman(mut number: usize) -> String {
    let mut text = String::new();
    for (value, letters) in
        [(50, "L"), (40, "XL"), (10, "X"), (9, "IX"), (5, "V"), (4, "IV"), (1, "I")]
    {
        while number >= value {
            text.push_str(letters);
            number -= value;
        }
    }
    text
}

/// Rigid bodies: links that a locked driver joins rigidly are one body.
struct Bodies<'a> {
    linkage: &'a Linkage,
    /// For each link, the link that represents its body.
    of_link: Vec<usize>,
    /// Pairs of links with a locked angle between them but no common joint.
    locked_angles: Vec<(usize, usize)>,
}

impl<'a> Bodies<'a> {
    fn new(linkage: &'a Linkage) -> Self {
        let mut of_link: Vec<usize> = (0..linkage.links.len()).collect();
        let mut locked_angles = Vec::new();
        for driver in &linkage.drivers {
            let (a, b) = match *driver {
                Driver::Slide(s) => (linkage.slides[s].link, linkage.slides[s].on),
                Driver::Angle { link, relative_to } => (link, relative_to),
            };
            let share_a_joint =
                linkage.links[a].joints.iter().any(|j| linkage.links[b].joints.contains(j));
            if matches!(driver, Driver::Slide(_)) || share_a_joint {
                let (keep, drop) = if of_link[a] == of_link[linkage.ground] {
                    (of_link[a], of_link[b])
                } else {
                    (of_link[b], of_link[a])
                };
                of_link.iter_mut().filter(|x| **x == drop).for_each(|x| *x = keep);
            } else {
                locked_angles.push((a, b));
            }
        }
        Self { linkage, of_link, locked_angles }
    }

    fn on_ground(&self, link: usize) -> bool {
        self.of_link[link] == self.of_link[self.linkage.ground]
    }
}

/// The joints and slides on each body, without those that are left out, in the description's order.
struct Parts {
    links: Vec<Vec<usize>>,
    /// Joints of bodies that move.
    joints: Vec<Vec<usize>>,
    /// Slides that are not driven.
    slides: Vec<Vec<usize>>,
    /// For every joint the bodies that move, and whether it is fixed.
    bodies_at: Vec<(BTreeSet<usize>, bool)>,
}

impl Parts {
    fn of(bodies: &Bodies<'_>, left_out: &LeftOut) -> Self {
        let linkage = bodies.linkage;
        let none = || vec![Vec::new(); linkage.links.len()];
        let mut parts =
            Self { links: none(), joints: none(), slides: none(), bodies_at: Vec::new() };
        let is_kept = left_out.keeps(linkage);
        for link in (0..linkage.links.len()).filter(|&link| is_kept[link]) {
            parts.links[bodies.of_link[link]].push(link);
        }
        for joint in 0..linkage.joints.len() {
            let on: Vec<usize> = linkage.links_at(joint).filter(|&link| is_kept[link]).collect();
            let moves = |link: &usize| !bodies.on_ground(*link);
            let moving: BTreeSet<usize> =
                on.iter().copied().filter(moves).map(|link| bodies.of_link[link]).collect();
            for &body in &moving {
                parts.joints[body].push(joint);
            }
            parts.bodies_at.push((moving, !on.iter().all(moves)));
        }
        for (index, slide) in linkage.slides.iter().enumerate() {
            let is_driven = linkage.drivers.contains(&Driver::Slide(index));
            if !is_driven && !left_out.has_slide(linkage, index) {
                let ends = [slide.link, slide.on].map(|link| bodies.of_link[link]);
                for body in BTreeSet::from(ends) {
                    parts.slides[body].push(index);
                }
            }
        }
        parts
    }
}

/// All of these lists of some bodies, without repetition and in order.
fn of_bodies(lists: &[Vec<usize>], bodies: &[usize]) -> BTreeSet<usize> {
    bodies.iter().flat_map(|&body| &lists[body]).copied().collect()
}

/// The meaning of an unknown of the pattern.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Node {
    Body(usize),
    Joint(usize),
}

/// The groups of a linkage without its redundant links. `None` if the pattern of the equations is
/// not structurally square and regular (the caller has checked their rank).
///
/// # Errors
///
/// [`Interrupted`] once `cancel` is true.
pub(crate) fn groups(
    linkage: &Linkage,
    left_out: &LeftOut,
    cancel: Option<&AtomicBool>,
) -> Result<Option<Vec<Group>>, Interrupted> {
    let bodies = Bodies::new(linkage);
    let parts = Parts::of(&bodies, left_out);
    let mut pattern = Pattern::default();
    let mut nodes: Vec<Node> = Vec::new();
    let mut body_node = vec![None; linkage.links.len()];
    for (l, links) in parts.links.iter().enumerate() {
        if bodies.of_link[l] == l && !bodies.on_ground(l) && links.contains(&l) {
            body_node[l] = Some(pattern.add_unknown(3));
            nodes.push(Node::Body(l));
        }
    }
    let node_of = |l: usize| body_node[bodies.of_link[l]];
    let mut joint_node = vec![None; linkage.joints.len()];
    for (j, (moving, grounded)) in parts.bodies_at.iter().enumerate() {
        if !grounded && !moving.is_empty() {
            joint_node[j] = Some(pattern.add_unknown(2));
            nodes.push(Node::Joint(j));
        }
    }
    for (j, (moving, _)) in parts.bodies_at.iter().enumerate() {
        for &body in moving {
            pattern.add_equation(2, body_node[body].into_iter().chain(joint_node[j]).collect());
        }
    }
    let driven = |s: usize| linkage.drivers.contains(&Driver::Slide(s));
    for (s, slide) in linkage.slides.iter().enumerate() {
        if !driven(s) && !left_out.has_slide(linkage, s) {
            pattern.add_equation(
                2,
                node_of(slide.link).into_iter().chain(node_of(slide.on)).collect(),
            );
        }
    }
    for &(a, b) in &bodies.locked_angles {
        pattern.add_equation(1, node_of(a).into_iter().chain(node_of(b)).collect());
    }
    let Some(blocks) = pattern.blocks() else { return Ok(None) };
    let mut groups = Vec::new();
    let mut solved: BTreeSet<usize> = BTreeSet::from([bodies.of_link[linkage.ground]]);
    for block in &blocks {
        check_flag(cancel)?;
        let members = Members::of(block, &nodes, &bodies, &solved);
        solved.extend(members.bodies.iter().chain(&members.point_bodies));
        if !members.bodies.is_empty() {
            groups.push(members.group(&bodies, &parts, &solved, cancel)?);
        }
    }
    Ok(Some(groups))
}

/// Bodies and joints that one block determines.
struct Members {
    /// Bodies of the group.
    bodies: Vec<usize>,
    /// Bodies whose orientation follows from a driven angle: they count as points.
    point_bodies: Vec<usize>,
    /// Inner joints.
    joints: Vec<usize>,
}

impl Members {
    fn of(block: &Block, nodes: &[Node], bodies: &Bodies<'_>, solved: &BTreeSet<usize>) -> Self {
        let mut members = Self { bodies: vec![], point_bodies: vec![], joints: vec![] };
        for &u in &block.unknowns {
            match nodes[u] {
                Node::Joint(j) => members.joints.push(j),
                Node::Body(b) => {
                    let is_point = bodies.locked_angles.iter().any(|&(x, y)| {
                        (bodies.of_link[x] == b && solved.contains(&bodies.of_link[y]))
                            || (bodies.of_link[y] == b && solved.contains(&bodies.of_link[x]))
                    });
                    if is_point { members.point_bodies.push(b) } else { members.bodies.push(b) }
                }
            }
        }
        members
    }

    fn group(
        &self,
        bodies: &Bodies<'_>,
        parts: &Parts,
        solved: &BTreeSet<usize>,
        cancel: Option<&AtomicBool>,
    ) -> Result<Group, Interrupted> {
        let linkage = bodies.linkage;
        // All joints of a point body count as one pair.
        let pair_element = |joint: usize| {
            let holder =
                self.point_bodies.iter().position(|p| parts.bodies_at[joint].0.contains(p));
            holder.map_or(joint, |p| linkage.joints.len() + p)
        };
        let mut inner: Vec<(usize, BTreeSet<usize>)> = Vec::new();
        let mut outer: Vec<(usize, char)> = Vec::new();
        let (mut joints, mut slides) = (Vec::new(), Vec::new());
        for j in of_bodies(&parts.joints, &self.bodies) {
            let (on, grounded) = &parts.bodies_at[j];
            let members: Vec<usize> =
                self.bodies.iter().copied().filter(|b| on.contains(b)).collect();
            let is_inner = self.joints.contains(&j);
            let has_point_body = on.iter().any(|b| self.point_bodies.contains(b));
            let solved_before = |b: &usize| solved.contains(b) && !self.bodies.contains(b);
            let is_outer = *grounded || on.iter().any(solved_before);
            if (is_inner && members.len() < 2 && !has_point_body) || !(is_inner || is_outer) {
                continue;
            }
            joints.push(j);
            if is_inner {
                let e = pair_element(j);
                match inner.iter_mut().find(|(x, _)| *x == e) {
                    Some((_, set)) => set.extend(members),
                    None => inner.push((e, members.into_iter().collect())),
                }
            } else {
                outer.extend(members.into_iter().map(|b| (b, 'R')));
            }
        }
        let mut inner: Vec<(char, BTreeSet<usize>)> =
            inner.into_iter().map(|(_, s)| ('R', s)).collect();
        for s in of_bodies(&parts.slides, &self.bodies) {
            let slide = &linkage.slides[s];
            let (a, b) = (bodies.of_link[slide.link], bodies.of_link[slide.on]);
            match (self.bodies.contains(&a), self.bodies.contains(&b)) {
                (true, true) => inner.push(('P', BTreeSet::from([a, b]))),
                (true, false) if solved.contains(&b) => outer.push((a, 'P')),
                (false, true) if solved.contains(&a) => outer.push((b, 'P')),
                _ => continue,
            }
            slides.push(s);
        }
        // A locked angle between two bodies of the group closes a contour like a pair.
        let locked_pairs = bodies
            .locked_angles
            .iter()
            .map(|&(x, y)| BTreeSet::from([bodies.of_link[x], bodies.of_link[y]]));
        let contours: Vec<BTreeSet<usize>> = (inner.iter().map(|(_, set)| set.clone()))
            .chain(locked_pairs.filter(|set| set.iter().all(|b| self.bodies.contains(b))))
            .collect();
        Ok(Group {
            class: self.class(&contours, cancel)?,
            order: outer.len(),
            kind: self.kind(&inner, &outer),
            links: of_bodies(&parts.links, &self.bodies).into_iter().collect(),
            joints,
            slides,
        })
    }

    fn class(
        &self,
        inner: &[BTreeSet<usize>],
        cancel: Option<&AtomicBool>,
    ) -> Result<usize, Interrupted> {
        if self.bodies.len() <= 2 {
            return Ok(2);
        }
        let node = |b: usize| self.bodies.iter().position(|&x| x == b);
        let mut edges = Vec::new();
        for (e, set) in inner.iter().enumerate() {
            edges.extend(set.iter().filter_map(|&b| node(b)).map(|b| (b, self.bodies.len() + e)));
        }
        let contours = minimum_cycle_basis(self.bodies.len() + inner.len(), &edges, cancel)?;
        let longest = contours.into_iter().map(|length| length / 2).max().unwrap_or(0);
        // With more than two links, at least one has three pairs: class III or above.
        Ok(longest.max(3))
    }

    fn kind(
        &self,
        inner: &[(char, BTreeSet<usize>)],
        outer: &[(usize, char)],
    ) -> Option<&'static str> {
        let [first, second] = self.bodies[..] else { return None };
        let outer_pair = |b: usize| outer.iter().find(|(x, _)| *x == b).map(|(_, c)| *c);
        let letters = if let [(middle, _)] = inner {
            [outer_pair(first)?, *middle, outer_pair(second)?]
        } else {
            // Both outer pairs are on one link, whose rotation a driven angle determines.
            let mut all: Vec<char> = outer.iter().map(|(_, c)| *c).collect();
            all.extend(inner.iter().map(|(c, _)| *c));
            let slides = inner.iter().filter(|(c, _)| *c == 'P').count();
            match (all.iter().filter(|&&c| c == 'P').count(), slides) {
                (0, _) => ['R', 'R', 'R'],
                (1, 0) => ['R', 'R', 'P'],
                (1, _) => ['R', 'P', 'R'],
                (2, 0) => ['P', 'R', 'P'],
                (2, _) => ['R', 'P', 'P'],
                _ => return None,
            }
        };
        match letters {
            ['R', 'R', 'R'] => Some("RRR"),
            ['R', 'R', 'P'] | ['P', 'R', 'R'] => Some("RRP"),
            ['R', 'P', 'R'] => Some("RPR"),
            ['P', 'R', 'P'] => Some("PRP"),
            ['R', 'P', 'P'] | ['P', 'P', 'R'] => Some("RPP"),
            _ => None,
        }
    }
}
