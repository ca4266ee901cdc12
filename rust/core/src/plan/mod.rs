//! The description compiled: a list of steps, made once, run for any number of
//! designs and positions.
//!
//! The closure equations are split into the smallest blocks that determine
//! something. A block with two unknown rotations or slides is one vector
//! equation (a dyad) solved in closed form; a block with none only places
//! points. A driver appears nowhere as a step: a driven angle makes the
//! orientation of two links differ by q, a driven slide is a known length.

pub mod binary_links;
pub(crate) mod compile;
pub mod constants;
pub mod constants_rate;
pub mod group_loops;
pub mod leg;
pub(crate) mod mechanism;
pub mod pair_span;
pub(crate) mod redundant;

use self::binary_links::Bars;
use self::constants::Bound;
use self::pair_span::PairSpans;
use crate::description::error::StructureError;
use crate::description::{Driver, Linkage};
use crate::math::vector::Vector;
use crate::structure::Structure;
use crate::structure::closure::{Closure, Rotation};
use crate::structure::closure::{Edge, Span, rotations};
pub use compile::{Dyad, Form, Part, Unknown};
pub use group_loops::Group;

/// Value of a slide on an edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[expect(missing_docs, reason = "the fields are indices of what their names say")]
pub enum Along {
    /// A rigid edge.
    Nothing,
    /// The slide's value is unknown until its dyad is solved.
    Slide(usize),
    /// The slide is this driver.
    Driver { slide: usize },
}

/// An edge with the orientation that turns it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PlanEdge {
    /// Its points, link and span.
    pub edge: Edge,
    /// Index of its link's orientation.
    pub orientation: usize,
    /// Class of that.
    pub class: usize,
    /// The slide along it.
    pub along: Along,
    /// Whether the motion depends on it (not on that of a coupler point).
    pub paired: bool,
    /// The leg that it is by itself.
    pub leg: Option<LegEdge>,
}

impl PlanEdge {
    /// Its points: where it is run from and where to.
    #[must_use]
    #[inline(always)]
    pub fn ends(&self, backward: bool) -> [usize; 2] {
        let (from, to) = (self.edge.from, self.edge.to);
        if backward { [to, from] } else { [from, to] }
    }
}

/// An edge that is a leg of a dyad.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LegEdge {
    /// Place among the legs, two a dyad.
    pub index: usize,
    /// Run from `to` to `from`.
    pub backward: bool,
}

/// An orientation: rotation of a class plus multiples of driven angles.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Orientation {
    /// The class.
    pub class: usize,
    /// Multiples of the drivers.
    pub turns: Vec<i8>,
    /// Whether a multiple is not 0.
    pub driven: bool,
    /// The driver that alone turns it, once, and whether the other way round.
    pub lone: Option<(usize, bool)>,
}

/// One thing to do at every position.
#[derive(Debug, Clone, PartialEq)]
#[expect(missing_docs, reason = "the fields are indices of what their names say")]
pub enum Step {
    /// Solve a dyad.
    Dyad(Dyad),
    /// Solve a group above class II.
    Group(Group),
    /// Place one end of an edge from the other.
    Place { edge: usize, backward: bool },
    /// Place a redundant link and check that it fits.
    Fit(Fit),
}

/// A redundant link (or slide): what places it, and what must then fit.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fit {
    /// Name used when it does not fit.
    pub name: String,
    /// How its orientation is found; none for a slide alone.
    pub turned: Option<Turned>,
    /// Edges whose far point is not placed by anything else, with direction.
    pub places: Vec<(usize, bool)>,
    /// Edges that must close (a slide along them takes the value that fits best).
    pub checks: Vec<usize>,
    /// All edges that are placed or must close.
    pub touched: Vec<usize>,
    /// Slides whose two links must keep their angle, with the carrying link.
    pub parallel: Vec<(usize, usize)>,
}

/// How a redundant link's orientation is found.
#[derive(Debug, Clone, PartialEq, Eq)]
#[expect(missing_docs, reason = "the fields are indices of what their names say")]
pub enum Turned {
    /// By two joints that other links carry: edges from the link's first joint
    /// (none: the first joint itself).
    Joints { link: usize, first: Option<usize>, second: Option<usize>, points: [usize; 2] },
    /// By a slide.
    Slide { link: usize, slide: usize },
}

/// A group that has no closed form.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Higher {
    /// Its links.
    pub links: String,
    /// Its class in Roman numerals.
    pub class: String,
}

/// The compiled mechanism.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// The drivers, in the order of q.
    pub drivers: Vec<Driver>,
    /// The two links of every slide: sliding, carrying.
    pub slide_links: Vec<[usize; 2]>,
    /// Number of points (joints, and reference points of links without joints).
    pub points: usize,
    /// Number of rotation classes; 0 is the ground's.
    pub classes: usize,
    /// Distinct orientations.
    pub orientations: Vec<Orientation>,
    /// Edges, as in the closure.
    pub edges: Vec<PlanEdge>,
    /// Rotation of every link.
    pub rotation: Vec<Rotation>,
    /// Orientation of every link.
    pub link_orientation: Vec<usize>,
    /// Reference point of every link.
    pub reference: Vec<usize>,
    /// The link that is the frame.
    pub ground: usize,
    /// Points fixed to the ground.
    pub fixed: Vec<bool>,
    /// What to do, in order.
    pub steps: Vec<Step>,
    /// Inner joint or slide of every dyad that has two solutions, in order.
    pub dyad_names: Vec<String>,
    /// Names of the same dyads' links.
    pub dyad_links: Vec<String>,
    /// The first group without a closed form.
    pub higher: Option<Higher>,
    /// Where the links have pairs; nothing if no link or slide is redundant.
    pub pairs: PairSpans,
}

/// The drivers that turn something, and how often.
fn turning(turns: &[i8]) -> Box<[(usize, i8)]> {
    turns.iter().copied().enumerate().filter(|&(_, t)| t != 0).collect()
}

impl Plan {
    /// Compiles a linkage whose structure has been found.
    ///
    /// # Errors
    ///
    /// Only for what [`Structure::of`] would have refused before.
    pub fn new(
        linkage: &Linkage,
        closure: &Closure,
        structure: &Structure,
    ) -> Result<Self, StructureError> {
        let (rotation, classes) = rotations(linkage, &structure.redundant, true)?;
        let mut orientations: Vec<Orientation> = Vec::new();
        let mut link_orientation = Vec::new();
        for r in &rotation {
            let driven = r.turns.iter().any(|&t| t != 0);
            let lone = match *turning(&r.turns) {
                [(driver, 1)] => Some((driver, false)),
                [(driver, -1)] => Some((driver, true)),
                _ => None,
            };
            let orientation = Orientation { class: r.class, turns: r.turns.clone(), driven, lone };
            let place = orientations.iter().position(|o| *o == orientation).unwrap_or_else(|| {
                orientations.push(orientation);
                orientations.len() - 1
            });
            link_orientation.push(place);
        }
        let edges = closure
            .edges
            .iter()
            .enumerate()
            .map(|(index, &edge)| {
                let along = match edge.span {
                    Span::Joint { .. } => Along::Nothing,
                    Span::Guide { slide } => {
                        if linkage.drivers.contains(&Driver::Slide(slide)) {
                            Along::Driver { slide }
                        } else {
                            Along::Slide(slide)
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
            higher: None,
            pairs: PairSpans::default(),
        };
        let kept: Vec<usize> = closure.kept(linkage, &structure.redundant).collect();
        let placed = compile::add_steps(&mut plan, linkage, structure, &kept)?;
        redundant::add_fits(&mut plan, linkage, closure, structure, placed);
        if plan.fits().next().is_some() {
            plan.pairs = PairSpans::of(linkage, closure);
        }
        plan.mark_legs();
        Ok(plan)
    }

    /// Finds the edges that are legs, and the orientations that something else asks for.
    fn mark_legs(&mut self) {
        let mut found = Vec::new();
        for dyad in self.dyads() {
            for place in 0..2 {
                let mut turning = dyad.path.iter().filter(|part| part.turns == Some(place));
                if let (Some(part), None) = (turning.next(), turning.next())
                    && part.in_leg
                    && part.slides.is_none()
                {
                    let index = 2 * dyad.index + place;
                    found.push((part.edge, LegEdge { index, backward: part.backward }));
                }
            }
        }
        let mut used = vec![false; self.orientations.len()];
        let mut bars = Vec::new();
        let mut first = 2 * self.dyads().count();
        for step in &mut self.steps {
            let Step::Group(group) = step else { continue };
            group.first_leg = first;
            first += group.edges.len();
        }
        let mut of_bars: Vec<Option<Bars>> = Vec::new();
        for group in self.groups() {
            let bars = Bars::new(self, group, of_bars.iter().flatten());
            of_bars.push(bars);
        }
        let mut of_bars = of_bars.into_iter();
        for step in &mut self.steps {
            let Step::Group(group) = step else { continue };
            group.bars = of_bars.next().flatten();
        }
        for group in self.groups() {
            for (place, edge) in group.edges.iter().enumerate() {
                if !group.is_chord(place) {
                    let index = group.first_leg + place;
                    found.push((edge.edge, LegEdge { index, backward: false }));
                }
                if edge.is_bar {
                    bars.push(edge.edge);
                } else if !group.is_arm(self, place) {
                    used[self.edges[edge.edge].orientation] = true;
                }
            }
        }
        for (edge, leg) in found {
            self.edges[edge].leg = Some(leg);
        }
        for (index, edge) in self.edges.iter().enumerate() {
            let is_arm = |group: &Group| {
                (0..group.edges.len())
                    .any(|place| group.edges[place].edge == index && group.is_arm(self, place))
            };
            if edge.leg.is_none() && !bars.contains(&index) && !self.groups().any(is_arm) {
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
                    for turned in &mut dyad.turned {
                        turned.retain(|&o| used[o]);
                    }
                }
                Step::Group(group) => {
                    for turned in &mut group.turned {
                        turned.retain(|&o| used[o]);
                    }
                    for l in &mut group.loops {
                        l.turned.retain(|&o| used[o]);
                    }
                }
                _ => {}
            }
        }
    }

    /// Class of an edge's rotation.
    #[must_use]
    pub fn class_of(&self, edge: usize) -> usize {
        self.edges[edge].class
    }

    /// The slide that is driver number `driver`, if it is one.
    #[must_use]
    pub fn driven_slide(&self, driver: usize) -> Option<usize> {
        match self.drivers[driver] {
            Driver::Slide(slide) => Some(slide),
            Driver::Angle { .. } => None,
        }
    }

    /// The link on the other side of a slide, and the constant turn from its
    /// orientation to that of `link`.
    #[must_use]
    pub fn across_slide(&self, bound: &Bound, link: usize, slide: usize) -> (usize, Vector) {
        let [sliding, carrying] = self.slide_links[slide];
        let turn = bound.slide_turn[slide];
        let (other, turn) = if link == sliding { (carrying, turn) } else { (sliding, turn.conj()) };
        (other, bound.turn[other] * turn * bound.turn[link].conj())
    }

    /// The dyads, in order.
    pub fn dyads(&self) -> impl Iterator<Item = &Dyad> {
        self.steps.iter().filter_map(|step| match step {
            Step::Dyad(dyad) => Some(dyad),
            _ => None,
        })
    }

    /// The redundant links and slides, in order.
    pub fn fits(&self) -> impl Iterator<Item = &Fit> {
        self.steps.iter().filter_map(|step| match step {
            Step::Fit(fit) => Some(fit),
            _ => None,
        })
    }

    /// The groups above class II, in order.
    pub fn groups(&self) -> impl Iterator<Item = &Group> {
        self.steps.iter().filter_map(|step| match step {
            Step::Group(group) => Some(group),
            _ => None,
        })
    }

    /// Numbers that the matrix of any group needs, with its inverse and a right-hand side.
    #[must_use]
    pub fn matrix_size(&self) -> usize {
        self.groups().map(|group| (2 * group.rows + 1) * group.rows).max().unwrap_or(0)
    }

    /// Number of legs: two a dyad, and the edges of groups.
    #[must_use]
    pub fn legs(&self) -> usize {
        let edges: usize = self.groups().map(|group| group.edges.len()).sum();
        2 * self.dyads().count() + edges
    }

    /// Number of dyads with two solutions.
    #[must_use]
    pub fn signs(&self) -> usize {
        self.dyad_names.len()
    }
}
