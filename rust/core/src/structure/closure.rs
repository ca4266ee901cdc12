//! Closure equations of the linkage, as a graph of points.
//!
//! Vertices are points (joints, reference points of links without joints, the
//! origin of the ground). Every edge is one vector equation
//!
//! ```text
//! P_to − P_from = U_link · (w + s·d)
//! ```
//!
//! where `U_link` is the link's orientation (a unit complex number), `w` and `d`
//! are fixed in the link's frame and `s` is the value of a slide (absent on a
//! rigid edge). A loop of edges gives a loop closure. Links joined by sliding
//! pairs only translate relative to each other and share one unknown rotation,
//! their *class*. A driven angle joins two links into one class with a known offset.

use crate::description::error::{DriverFault, StructureError};
use crate::description::{Driver, Linkage};

/// Index of the ground's origin among the points.
pub(crate) const GROUND_POINT: usize = 0;

/// The vector of an edge in its link's frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Span {
    /// From the link's first joint to another of its joints.
    Joint { link: usize, joint: usize },
    /// Along a guide: from the slide's origin (or the reference point of the link
    /// that carries the guide) to the sliding point.
    Guide { slide: usize },
}

/// One vector equation of closure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Edge {
    /// Point where it starts.
    pub from: usize,
    /// Point where it ends.
    pub to: usize,
    /// Link with which the vector turns.
    pub link: usize,
    /// Its vector in the link's frame.
    pub span: Span,
}

impl Edge {
    /// The slide along this edge.
    #[must_use]
    pub fn slide(&self) -> Option<usize> {
        match self.span {
            Span::Guide { slide } => Some(slide),
            Span::Joint { .. } => None,
        }
    }
}

/// How a link's orientation follows from the rotation of its class:
/// `θ = θ_class + Σ ±(angle − link_angle of slides) + Σ ±q`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(crate) struct Rotation {
    /// The class; 0 is the ground's.
    pub class: usize,
    /// Slides on the path from the first link of the class to this one, with sign.
    pub slides: Vec<(usize, i8)>,
    /// Factor of each driven coordinate: −1, 0 or +1.
    pub turns: Vec<i8>,
}

/// Links and slides left out of a linkage.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct LeftOut {
    /// Links left out with all their pairs.
    pub links: Vec<usize>,
    /// Slides left out alone.
    pub slides: Vec<usize>,
}

impl LeftOut {
    /// Whether nothing is left out.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.links.is_empty() && self.slides.is_empty()
    }

    /// Whether each link stays.
    pub(crate) fn keeps(&self, linkage: &Linkage) -> Vec<bool> {
        let mut keeps = vec![true; linkage.links.len()];
        for &link in &self.links {
            keeps[link] = false;
        }
        keeps
    }

    /// Whether a slide, or one of its links, is left out.
    #[must_use]
    pub fn has_slide(&self, linkage: &Linkage, slide: usize) -> bool {
        let s = &linkage.slides[slide];
        self.slides.contains(&slide) || self.links.contains(&s.link) || self.links.contains(&s.on)
    }
}

/// Points and edges of the whole linkage, including those that may be left out.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Closure {
    /// Number of points.
    pub points: usize,
    /// Reference point of every link.
    pub reference: Vec<usize>,
    /// Edges of moving links first, then of slides.
    pub edges: Vec<Edge>,
    /// Whether a point is fixed to the ground.
    pub fixed: Vec<bool>,
    /// Whether a point is an end of a guide's edge.
    guided: Vec<bool>,
}

/// Index of a joint among the points.
#[must_use]
pub(crate) fn point_of_joint(joint: usize) -> usize {
    joint + 1
}

impl Closure {
    /// The graph of a linkage.
    #[must_use]
    pub fn of(linkage: &Linkage) -> Self {
        let mut points = 1 + linkage.joints.len();
        let mut reference = Vec::with_capacity(linkage.links.len());
        for (index, link) in linkage.links.iter().enumerate() {
            reference.push(match link.joints.first() {
                _ if index == linkage.ground => GROUND_POINT,
                Some(&joint) => point_of_joint(joint),
                None => {
                    points += 1;
                    points - 1
                }
            });
        }
        let mut fixed = vec![false; points];
        fixed[GROUND_POINT] = true;
        for &joint in &linkage.links[linkage.ground].joints {
            fixed[point_of_joint(joint)] = true;
        }
        let mut edges = Vec::new();
        for (index, link) in linkage.links.iter().enumerate() {
            if index == linkage.ground {
                continue;
            }
            for &joint in link.joints.iter().skip(1) {
                let span = Span::Joint { link: index, joint };
                edges.push(Edge {
                    from: reference[index],
                    to: point_of_joint(joint),
                    link: index,
                    span,
                });
            }
        }
        for (slide, s) in linkage.slides.iter().enumerate() {
            let to = match linkage.links[s.link].joints.first() {
                Some(&joint) => point_of_joint(joint),
                None => reference[s.link],
            };
            let from = s.origin.map_or(reference[s.on], point_of_joint);
            edges.push(Edge { from, to, link: s.on, span: Span::Guide { slide } });
        }
        let mut guided = vec![false; points];
        for edge in edges.iter().filter(|edge| edge.slide().is_some()) {
            guided[edge.from] = true;
            guided[edge.to] = true;
        }
        Self { points, reference, edges, fixed, guided }
    }

    /// Whether the end of an edge is a pair. If not (a coupler point), the edge
    /// does not constrain the motion.
    #[must_use]
    pub fn is_paired(&self, linkage: &Linkage, edge: usize) -> bool {
        match self.edges[edge].span {
            Span::Joint { joint, .. } => self.is_pair(linkage, joint),
            Span::Guide { .. } => true,
        }
    }

    /// Whether a joint connects several links or is an end of a guide's edge.
    #[must_use]
    pub fn is_pair(&self, linkage: &Linkage, joint: usize) -> bool {
        linkage.links_at(joint).nth(1).is_some() || self.guided[point_of_joint(joint)]
    }

    /// The edges that are not left out.
    pub fn kept<'a>(
        &'a self,
        linkage: &'a Linkage,
        left_out: &'a LeftOut,
    ) -> impl Iterator<Item = usize> + 'a {
        (0..self.edges.len()).filter(move |&e| match self.edges[e].span {
            Span::Joint { link, .. } => !left_out.links.contains(&link),
            Span::Guide { slide } => !left_out.has_slide(linkage, slide),
        })
    }
}

/// Rotations of all links, and the number of classes; with `locked`, driven angles join classes.
///
/// # Errors
///
/// [`StructureError::SlidesOnly`] for a closed chain of sliding pairs;
/// [`StructureError::CannotDrive`] for a driven angle between two links that cannot turn
/// relative to each other.
pub(crate) fn rotations(
    linkage: &Linkage,
    left_out: &LeftOut,
    locked: bool,
) -> Result<(Vec<Rotation>, usize), StructureError> {
    let drivers: &[Driver] = if locked { &linkage.drivers } else { &[] };
    let turns = vec![0; linkage.drivers.len()];
    let mut rotation: Vec<Option<Rotation>> = vec![None; linkage.links.len()];
    let mut used_slides = vec![false; linkage.slides.len()];
    let mut used_drivers = vec![false; drivers.len()];
    let mut classes = 0;
    let order = std::iter::once(linkage.ground).chain(0..linkage.links.len());
    for first in order {
        if rotation[first].is_some() {
            continue;
        }
        let root = if classes == 0 { first } else { base(linkage, left_out, drivers, first) };
        rotation[root] = Some(Rotation { class: classes, slides: vec![], turns: turns.clone() });
        classes += 1;
        let mut queue = std::collections::VecDeque::from([root]);
        while let Some(current) = queue.pop_front() {
            let Some(base) = rotation[current].clone() else { continue };
            for (slide, s) in linkage.slides.iter().enumerate() {
                // From the carrier to the sliding link: + angle − link_angle.
                let (next, sign) = match current {
                    l if l == s.on => (s.link, 1),
                    l if l == s.link => (s.on, -1),
                    _ => continue,
                };
                if used_slides[slide] || left_out.has_slide(linkage, slide) {
                    continue;
                }
                used_slides[slide] = true;
                if rotation[next].is_some() {
                    check_slide_cycle(linkage, &rotation, slide)?;
                    continue;
                }
                let mut reached = base.clone();
                reached.slides.push((slide, sign));
                rotation[next] = Some(reached);
                queue.push_back(next);
            }
            for (index, driver) in drivers.iter().enumerate() {
                let Driver::Angle { link, relative_to } = *driver else { continue };
                let (next, sign) = match current {
                    l if l == relative_to => (link, 1),
                    l if l == link => (relative_to, -1),
                    _ => continue,
                };
                if used_drivers[index] {
                    continue;
                }
                used_drivers[index] = true;
                if rotation[next].is_some() {
                    return Err(StructureError::CannotDrive {
                        drivers: vec![linkage.driver_name(*driver)],
                        fault: DriverFault::AngleFixed {
                            link: linkage.links[link].name.clone(),
                            other: linkage.links[relative_to].name.clone(),
                        },
                    });
                }
                let mut reached = base.clone();
                reached.turns[index] += sign;
                rotation[next] = Some(reached);
                queue.push_back(next);
            }
        }
    }
    Ok((rotation.into_iter().map(Option::unwrap_or_default).collect(), classes))
}

/// The link whose angle gives those of its class: one that no driver turns relative to another, for any order
/// of the links. (If there are several, that of the first driver.)
fn base(linkage: &Linkage, left_out: &LeftOut, drivers: &[Driver], first: usize) -> usize {
    let class = joined(linkage, left_out, drivers, first);
    let mut base = first;
    let mut free: Vec<&Driver> = drivers.iter().collect();
    let mut driven = class;
    loop {
        let turns =
            |driver: &&Driver| matches!(**driver, Driver::Angle { link, .. } if driven[link]);
        let Some(&Driver::Angle { relative_to, .. }) =
            free.iter().position(turns).map(|index| free.remove(index))
        else {
            break;
        };
        base = relative_to;
        driven = joined(linkage, left_out, &[], base);
    }
    // Links that only slide relative to each other have the same rotation.
    if driven[first] { first } else { base }
}

/// Whether each link is joined to `start` by slides and drivers that turn.
fn joined(linkage: &Linkage, left_out: &LeftOut, drivers: &[Driver], start: usize) -> Vec<bool> {
    let slides = linkage.slides.iter().enumerate();
    let slides = slides.filter(|&(slide, _)| !left_out.has_slide(linkage, slide));
    let turned = drivers.iter().filter_map(|driver| match *driver {
        Driver::Angle { link, relative_to } => Some([link, relative_to]),
        Driver::Slide(_) => None,
    });
    let pairs: Vec<[usize; 2]> = slides.map(|(_, s)| [s.link, s.on]).chain(turned).collect();
    let mut joined = vec![false; linkage.links.len()];
    joined[start] = true;
    while let Some(&[a, b]) = pairs.iter().find(|pair| joined[pair[0]] != joined[pair[1]]) {
        (joined[a], joined[b]) = (true, true);
    }
    joined
}

/// Checks a slide that closes a cycle of slides. Two slides between the same links may be a
/// doubled guide, about which the rank decides; three or more are the invalid chain PPP.
fn check_slide_cycle(
    linkage: &Linkage,
    rotation: &[Option<Rotation>],
    slide: usize,
) -> Result<(), StructureError> {
    let s = &linkage.slides[slide];
    let path = |link: usize| rotation[link].as_ref().map(|r| &r.slides[..]).unwrap_or_default();
    let (a, b) = (path(s.link), path(s.on));
    let common = a.iter().zip(b).take_while(|(x, y)| x == y).count();
    let mut cycle: Vec<usize> = a[common..].iter().chain(&b[common..]).map(|x| x.0).collect();
    if cycle.len() < 2 {
        let turns = |link: usize| rotation[link].as_ref().map(|r| &r.turns[..]).unwrap_or_default();
        let unequal = turns(s.link).iter().zip(turns(s.on)).position(|(x, y)| x != y);
        return unequal.map_or(Ok(()), |driver| {
            Err(StructureError::CannotDrive {
                drivers: vec![linkage.driver_name(linkage.drivers[driver])],
                fault: DriverFault::SlideFixes { slide: s.name.clone() },
            })
        });
    }
    cycle.push(slide);
    cycle.sort_unstable();
    let slides = cycle.iter().map(|&c| linkage.slides[c].name.clone()).collect();
    Err(StructureError::SlidesOnly { slides })
}
