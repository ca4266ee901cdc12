//! Assur groups: the smallest parts of zero mobility, in solving order.
//!
//! With the drivers locked every link counts 3 unknowns, every joint 2, every
//! joint on a link 2 equations and every sliding pair 2; the smallest sets of
//! links that close in themselves are the groups (Assur 1914, Artobolevsky 1975).

use std::collections::BTreeSet;

use super::closure::LeftOut;
use super::contour::minimum_cycle_basis;
use super::matching::{Block, Pattern};
use crate::description::{Driver, Linkage};

/// One Assur group.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Group {
    /// Class: 2 for a dyad, 3, 4 … for higher groups.
    pub class: usize,
    /// Order: number of external pairs.
    pub order: usize,
    /// The five dyads `RRR`, `RRP`, `RPR`, `PRP`, `RPP`; none for higher groups.
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

/// Roman numeral of a class (small numbers only).
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

/// Links as rigid bodies: what a locked driver joins is one body.
struct Bodies<'a> {
    linkage: &'a Linkage,
    /// Representative link of every link's body.
    of: Vec<usize>,
    /// Links whose angle is locked to a link they share no joint with.
    loose: Vec<(usize, usize)>,
}

impl<'a> Bodies<'a> {
    fn new(linkage: &'a Linkage) -> Self {
        let mut of: Vec<usize> = (0..linkage.links.len()).collect();
        let mut loose = Vec::new();
        for driver in &linkage.drivers {
            let (a, b) = match *driver {
                Driver::Slide(s) => (linkage.slides[s].link, linkage.slides[s].on),
                Driver::Angle { link, relative_to } => (link, relative_to),
            };
            let shares =
                linkage.links[a].joints.iter().any(|j| linkage.links[b].joints.contains(j));
            if matches!(driver, Driver::Slide(_)) || shares {
                let (keep, drop) =
                    if of[a] == of[linkage.ground] { (of[a], of[b]) } else { (of[b], of[a]) };
                of.iter_mut().filter(|x| **x == drop).for_each(|x| *x = keep);
            } else {
                loose.push((a, b));
            }
        }
        Self { linkage, of, loose }
    }

    fn on_ground(&self, link: usize) -> bool {
        self.of[link] == self.of[self.linkage.ground]
    }
}

/// What an unknown of the counting pattern stands for.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Node {
    Body(usize),
    Joint(usize),
}

/// The groups of a linkage without its redundant links; None if the count does
/// not come out (the caller has checked the ranks before).
#[must_use]
pub(crate) fn groups(linkage: &Linkage, left_out: &LeftOut) -> Option<Vec<Group>> {
    let bodies = Bodies::new(linkage);
    let kept: Vec<usize> =
        (0..linkage.links.len()).filter(|l| !left_out.links.contains(l)).collect();
    let mut pattern = Pattern::default();
    let mut nodes: Vec<Node> = Vec::new();
    let mut body_node = vec![None; linkage.links.len()];
    for &l in &kept {
        if bodies.of[l] == l && !bodies.on_ground(l) {
            body_node[l] = Some(pattern.unknown(3));
            nodes.push(Node::Body(l));
        }
    }
    let node_of = |l: usize| body_node[bodies.of[l]];
    let mut touching: Vec<(BTreeSet<usize>, bool)> = Vec::new();
    let mut joint_node = vec![None; linkage.joints.len()];
    for j in 0..linkage.joints.len() {
        let on: Vec<usize> = linkage.links_at(j).filter(|l| kept.contains(l)).collect();
        let grounded = on.iter().any(|&l| bodies.on_ground(l));
        let moving: BTreeSet<usize> =
            on.iter().filter(|&&l| !bodies.on_ground(l)).map(|&l| bodies.of[l]).collect();
        if !grounded && !moving.is_empty() {
            joint_node[j] = Some(pattern.unknown(2));
            nodes.push(Node::Joint(j));
        }
        touching.push((moving, grounded));
    }
    for (j, (moving, _)) in touching.iter().enumerate() {
        for &body in moving {
            pattern.equation(2, body_node[body].into_iter().chain(joint_node[j]).collect());
        }
    }
    let driven = |s: usize| linkage.drivers.contains(&Driver::Slide(s));
    for (s, slide) in linkage.slides.iter().enumerate() {
        if !driven(s) && !left_out.has_slide(linkage, s) {
            pattern.equation(2, node_of(slide.link).into_iter().chain(node_of(slide.on)).collect());
        }
    }
    for &(a, b) in &bodies.loose {
        pattern.equation(1, node_of(a).into_iter().chain(node_of(b)).collect());
    }
    let blocks = pattern.blocks()?;
    let mut groups = Vec::new();
    let mut solved: BTreeSet<usize> = BTreeSet::from([bodies.of[linkage.ground]]);
    for block in &blocks {
        let members = Members::of(block, &nodes, &bodies, &solved);
        solved.extend(members.bodies.iter().chain(&members.points));
        if !members.bodies.is_empty() {
            groups.push(members.group(&bodies, left_out, &touching, &solved));
        }
    }
    Some(groups)
}

/// The bodies and joints that one block determines.
struct Members {
    /// Bodies of the group.
    bodies: Vec<usize>,
    /// Bodies with a driven angle: with their orientation known they are points.
    points: Vec<usize>,
    /// Inner joints.
    joints: Vec<usize>,
}

impl Members {
    fn of(block: &Block, nodes: &[Node], bodies: &Bodies<'_>, solved: &BTreeSet<usize>) -> Self {
        let mut members = Self { bodies: vec![], points: vec![], joints: vec![] };
        for &u in &block.unknowns {
            match nodes[u] {
                Node::Joint(j) => members.joints.push(j),
                Node::Body(b) => {
                    let is_point = bodies.loose.iter().any(|&(x, y)| {
                        (bodies.of[x] == b && solved.contains(&bodies.of[y]))
                            || (bodies.of[y] == b && solved.contains(&bodies.of[x]))
                    });
                    if is_point { members.points.push(b) } else { members.bodies.push(b) }
                }
            }
        }
        members
    }

    fn group(
        &self,
        bodies: &Bodies<'_>,
        left_out: &LeftOut,
        touching: &[(BTreeSet<usize>, bool)],
        solved: &BTreeSet<usize>,
    ) -> Group {
        let linkage = bodies.linkage;
        // A point body (driven angle) gathers all its joints into one pair element.
        let element = |joint: usize| {
            let holder = self.points.iter().position(|p| touching[joint].0.contains(p));
            holder.map_or(joint, |p| linkage.joints.len() + p)
        };
        let mut inner: Vec<(usize, BTreeSet<usize>)> = Vec::new();
        let mut outer: Vec<(usize, char)> = Vec::new();
        let (mut joints, mut slides) = (Vec::new(), Vec::new());
        for (j, (on, grounded)) in touching.iter().enumerate() {
            let here: Vec<usize> = self.bodies.iter().copied().filter(|b| on.contains(b)).collect();
            let is_inner = self.joints.contains(&j);
            let others = on.iter().any(|b| self.points.contains(b));
            let before = |b: &usize| solved.contains(b) && !self.bodies.contains(b);
            let hangs = *grounded || on.iter().any(before);
            if here.is_empty() || (is_inner && here.len() < 2 && !others) || !(is_inner || hangs) {
                continue;
            }
            joints.push(j);
            if is_inner {
                let e = element(j);
                match inner.iter_mut().find(|(x, _)| *x == e) {
                    Some((_, set)) => set.extend(here),
                    None => inner.push((e, here.into_iter().collect())),
                }
            } else {
                outer.extend(here.into_iter().map(|b| (b, 'R')));
            }
        }
        let mut inner: Vec<(char, BTreeSet<usize>)> =
            inner.into_iter().map(|(_, s)| ('R', s)).collect();
        for (s, slide) in linkage.slides.iter().enumerate() {
            if left_out.has_slide(linkage, s) || linkage.drivers.contains(&Driver::Slide(s)) {
                continue;
            }
            let (a, b) = (bodies.of[slide.link], bodies.of[slide.on]);
            match (self.bodies.contains(&a), self.bodies.contains(&b)) {
                (true, true) => inner.push(('P', BTreeSet::from([a, b]))),
                (true, false) if solved.contains(&b) => outer.push((a, 'P')),
                (false, true) if solved.contains(&a) => outer.push((b, 'P')),
                _ => continue,
            }
            slides.push(s);
        }
        // An angle locked between two bodies of the group closes a contour like a pair.
        let locked =
            bodies.loose.iter().map(|&(x, y)| BTreeSet::from([bodies.of[x], bodies.of[y]]));
        let contours: Vec<BTreeSet<usize>> = (inner.iter().map(|(_, set)| set.clone()))
            .chain(locked.filter(|set| set.iter().all(|b| self.bodies.contains(b))))
            .collect();
        let mut links: Vec<usize> = (0..linkage.links.len())
            .filter(|&l| !left_out.links.contains(&l) && self.bodies.contains(&bodies.of[l]))
            .collect();
        links.sort_unstable();
        Group {
            class: self.class(&contours),
            order: outer.len(),
            kind: self.kind(&inner, &outer),
            links,
            joints,
            slides,
        }
    }

    fn class(&self, inner: &[BTreeSet<usize>]) -> usize {
        if self.bodies.len() <= 2 {
            return 2;
        }
        let place = |b: usize| self.bodies.iter().position(|&x| x == b);
        let mut edges = Vec::new();
        for (e, set) in inner.iter().enumerate() {
            edges.extend(set.iter().filter_map(|&b| place(b)).map(|b| (b, self.bodies.len() + e)));
        }
        let contours = minimum_cycle_basis(self.bodies.len() + inner.len(), &edges);
        let longest = contours.into_iter().map(|length| length / 2).max().unwrap_or(0);
        // More than two links close no dyad: at least a link with three pairs stands there.
        longest.max(3)
    }

    fn kind(
        &self,
        inner: &[(char, BTreeSet<usize>)],
        outer: &[(usize, char)],
    ) -> Option<&'static str> {
        let [first, second] = self.bodies[..] else { return None };
        let end = |b: usize| outer.iter().find(|(x, _)| *x == b).map(|(_, c)| *c);
        let letters = if let [(middle, _)] = inner {
            [end(first)?, *middle, end(second)?]
        } else {
            // Both ends hang on one link that a driven angle leaves no turn of its own.
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
