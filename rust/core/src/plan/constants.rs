//! The constant vectors of one design.

use std::collections::HashMap;

use super::binary_links::LoopVectors;
use super::curvature::curvature;
use super::dyad_constants::{DyadConstants, Sides};
use super::leg::Leg;
use super::lengths::{Lengths, Slot, inverse_power, power_of_two};
use super::plan::{Plan, Step};
use super::tape::{Op, PlaceKind, Tape};
use crate::description::Linkage;
use crate::description::dimension::{Dimension, Dimensions};
use crate::math::vector::Vector;
use crate::structure::closure::{Closure, Span};

/// The constant vectors of one design, in units of its scale.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct DesignConstants {
    /// Power of two near the greatest length, m; results are multiplied by it.
    pub scale: f64,
    /// Origin of the frame in the drawing, m: the first ground joint.
    pub origin: [f64; 2],
    /// Constant part of every edge, in the frame of its class.
    pub edge_vector: Vec<Vector>,
    /// Square of the length of that part.
    pub arm2: Vec<f64>,
    /// Guide direction of every edge with a slide, in the frame of its class.
    pub guide: Vec<Vector>,
    /// Coordinates of the points fixed to the ground.
    pub fixed: Vec<Vector>,
    /// Constant angle of every link relative to its class, rad.
    pub offset: Vec<f64>,
    /// That angle as a unit vector.
    pub turn: Vec<Vector>,
    /// Rotation from the carrying to the sliding link of every slide.
    pub slide_turn: Vec<Vector>,
    /// Square of the longest constant edge that turns with each class (edges to coupler points
    /// count as 1 at most).
    pub max_arm2: Vec<f64>,
    /// The two legs of every dyad (default values where an unknown has no leg).
    pub legs: Vec<[Leg; 2]>,
    /// Other constants of every dyad.
    pub dyads: Vec<DyadConstants>,
    /// Greatest distance of each point from the origin; for points along a slide, without the slide.
    pub reach: Vec<f64>,
    /// For every edge that turns with a leg but is not one: the edge divided by the leg.
    pub on_leg: Vec<Vector>,
    /// See [`curvature`], of every group above class II.
    pub curvature: Vec<f64>,
    /// Spans and bars of the groups of binary links.
    pub spans: LoopVectors,
    /// The misfit of redundant links is relative to this size: 1, or less where a joint far from
    /// all pairs sets the scale.
    pub pair_size: f64,
    /// For every sign, whether its dyad can pass change points.
    pub may_change: Vec<bool>,
}

/// Index of every edge's and slide's dimensions in the list of values; found once per mechanism.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct DimensionMap {
    pub(crate) edges: Vec<EdgeSource>,
    pub(crate) slides: Vec<SlideSlots>,
    /// Ground joints with their coordinates.
    pub(crate) ground: Vec<(usize, [Slot; 2])>,
    /// Coordinates of the origin.
    pub(crate) origin: [Slot; 2],
    /// Lengths that set the scale.
    pub(crate) lengths: Lengths,
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) enum EdgeSource {
    /// From the first joint of a link to another: its coordinates in the link's frame.
    Joint([Slot; 2]),
    /// Along a guide.
    Guide(usize),
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct SlideSlots {
    pub(super) angle: Slot,
    pub(super) link_angle: Slot,
    pub(crate) offset: Slot,
    pub(crate) origin: [Slot; 2],
    /// Whether its origin is a point of the drawing, not a joint.
    pub(crate) drawn: bool,
}

pub(crate) fn read(values: &[f64], slot: Slot) -> f64 {
    slot.map_or(0.0, |i| values[i])
}

pub(crate) fn read_two(values: &[f64], slots: [Slot; 2]) -> Vector {
    Vector::new(read(values, slots[0]), read(values, slots[1]))
}

impl SlideSlots {
    pub(crate) fn angle(&self, values: &[f64]) -> f64 {
        read(values, self.angle)
    }

    /// Angle from the carrying to the sliding link, rad.
    pub(crate) fn step(&self, values: &[f64]) -> f64 {
        read(values, self.angle) - read(values, self.link_angle)
    }
}

impl DimensionMap {
    /// Finds the indices.
    #[must_use]
    pub(crate) fn new(
        plan: &Plan,
        linkage: &Linkage,
        closure: &Closure,
        dimensions: &Dimensions,
    ) -> Self {
        let index_of: HashMap<Dimension, usize> =
            dimensions.iter().enumerate().map(|(index, (_, d))| (d, index)).collect();
        let find = |dimension: Dimension| index_of.get(&dimension).copied();
        let on_ground =
            |joint| [find(Dimension::GroundX { joint }), find(Dimension::GroundY { joint })];
        let in_link = |link: usize, joint: usize| match linkage.links[link]
            .joints
            .iter()
            .position(|&j| j == joint)
        {
            Some(0) => [None, None],
            Some(1) => [find(Dimension::Length { link }), None],
            _ => [find(Dimension::JointX { link, joint }), find(Dimension::JointY { link, joint })],
        };
        let edges = plan
            .edges
            .iter()
            .map(|e| match e.edge.span {
                Span::Joint { link, joint } => EdgeSource::Joint(in_link(link, joint)),
                Span::Guide { slide } => EdgeSource::Guide(slide),
            })
            .collect();
        let slides = (0..linkage.slides.len())
            .map(|slide| SlideSlots {
                angle: find(Dimension::SlideAngle { slide }),
                link_angle: find(Dimension::SlideLinkAngle { slide }),
                offset: find(Dimension::SlideOffset { slide }),
                origin: [
                    find(Dimension::SlideOriginX { slide }),
                    find(Dimension::SlideOriginY { slide }),
                ],
                drawn: linkage.slides[slide].on == linkage.ground
                    && linkage.slides[slide].origin.is_none(),
            })
            .collect();
        let joints = &linkage.links[linkage.ground].joints;
        let ground = joints.iter().map(|&joint| (joint, on_ground(joint))).collect();
        // The first ground joint, or the drawing's own origin without one.
        let origin = joints.first().map_or([None, None], |&joint| on_ground(joint));
        let lengths = Lengths::of(linkage, closure, dimensions);
        Self { edges, slides, ground, origin, lengths }
    }

    /// The greatest length of a design.
    pub(crate) fn size(&self, values: &[f64]) -> f64 {
        let origin = read_two(values, self.origin);
        self.lengths.size(values, [origin.x, origin.y])
    }

    /// The scale of a design: the power of two at or below its greatest length.
    pub(crate) fn scale(&self, values: &[f64]) -> f64 {
        power_of_two(self.size(values))
    }

    /// The scales of designs whose dimensions are in columns: `column(i)` holds the dimension `i`
    /// of all of them, `values(k)` all dimensions of design `k`.
    pub(crate) fn scales<'a>(
        &self,
        column: impl Fn(usize) -> &'a [f64],
        values: impl Fn(usize) -> &'a [f64],
        scales: &mut [f64],
    ) {
        self.lengths.greatest(column, self.origin, scales);
        for (design, scale) in scales.iter_mut().enumerate() {
            *scale = if *scale > 0.0 { power_of_two(*scale) } else { self.scale(values(design)) };
        }
    }
}

impl DesignConstants {
    /// The link on the other side of a slide, and the constant rotation from its orientation to
    /// that of `link`.
    #[must_use]
    pub(crate) fn across_slide(&self, plan: &Plan, link: usize, slide: usize) -> (usize, Vector) {
        let [sliding, carrying] = plan.slide_links[slide];
        let turn = self.slide_turn[slide];
        let (other_link, turn) =
            if link == sliding { (carrying, turn) } else { (sliding, turn.conj()) };
        (other_link, self.turn[other_link] * turn * self.turn[link].conj())
    }

    /// Constants for these values of the dimensions (in the order of [`Dimensions`]).
    #[must_use]
    pub(crate) fn new(plan: &Plan, slots: &DimensionMap, values: &[f64]) -> Self {
        let mut constants = Self::default();
        let scale = slots.scale(values);
        constants.bind(plan, slots, values, scale, f64::INFINITY);
        constants
    }

    /// Recomputes the constants for another design of the same plan, given its dimensions and scale.
    /// `driven_reach`: the greatest value of a driven slide, m.
    pub(crate) fn bind(
        &mut self,
        plan: &Plan,
        slots: &DimensionMap,
        values: &[f64],
        scale: f64,
        driven_reach: f64,
    ) {
        if self.turn.len() != plan.rotation.len() {
            self.resize(plan, slots);
        }
        let origin = read_two(values, slots.origin);
        self.origin = [origin.x, origin.y];
        self.scale = scale;
        let inv_scale = inverse_power(self.scale);
        let has_slides = !slots.slides.is_empty();
        if has_slides {
            self.turn_links(plan, slots, values);
        }
        for ((e, source), i) in plan.edges.iter().zip(&slots.edges).zip(0..) {
            let mut w = match *source {
                EdgeSource::Joint(slots) => read_two(values, slots),
                EdgeSource::Guide(slide) => {
                    let slide = &slots.slides[slide];
                    let direction = unit(slide.angle(values));
                    let mut start = read_two(values, slide.origin);
                    if slide.drawn {
                        start = start - origin;
                    }
                    self.guide[i] = self.turn[e.edge.link] * direction;
                    start + direction.left().scale(read(values, slide.offset))
                }
            };
            if has_slides {
                w = self.turn[e.edge.link] * w;
            }
            self.edge_vector[i] = w.scale(inv_scale);
            self.arm2[i] = self.edge_vector[i].norm2();
        }
        for &(joint, at) in &slots.ground {
            self.fixed[joint + 1] = (read_two(values, at) - origin).scale(inv_scale);
        }
        self.max_arm2.fill(0.0);
        for (e, &arm2) in plan.edges.iter().zip(&self.arm2) {
            // The error of a coupler point beyond all pairs is relative to its own distance.
            let arm2 = if e.paired { arm2 } else { arm2.min(1.0) };
            self.max_arm2[e.class] = self.max_arm2[e.class].max(arm2);
        }
        plan.leg_edges.measure(&self.edge_vector, &mut self.legs);
        self.measure_dyads(plan, &plan.tape, driven_reach * inv_scale);
        for (i, e) in plan.edges.iter().enumerate() {
            if let (Some(leg), None) = (e.on_leg, e.leg) {
                self.on_leg[i] = self.legs[leg / 2][leg % 2].part(self.edge_vector[i]);
            }
        }
        self.curvature.clear();
        self.curvature.extend(plan.groups().map(|group| curvature(plan, group, &self.edge_vector)));
        self.spans.measure(plan, &self.edge_vector);
        // Twice, since the scale is more than half of the greatest length.
        let longest = plan.pairs.longest(&self.edge_vector, &self.fixed);
        self.pair_size = if longest > 0.0 { (2.0 * longest).min(1.0) } else { 1.0 };
    }

    /// Resizes the arrays. Entries that stay 0 are never written.
    fn resize(&mut self, plan: &Plan, slots: &DimensionMap) {
        self.may_change.clone_from(&plan.may_change);
        let edges = plan.edges.len();
        for vectors in [&mut self.edge_vector, &mut self.guide, &mut self.on_leg] {
            vectors.resize(edges, Vector::ZERO);
        }
        self.arm2.resize(edges, 0.0);
        self.fixed.resize(plan.points, Vector::ZERO);
        self.max_arm2.resize(plan.classes, 0.0);
        self.offset.resize(plan.rotation.len(), 0.0);
        self.turn.resize(plan.rotation.len(), Vector::ONE);
        self.slide_turn.resize(slots.slides.len(), Vector::ONE);
    }

    /// Sets the constant angles of the links; only slides cause any.
    fn turn_links(&mut self, plan: &Plan, slots: &DimensionMap, values: &[f64]) {
        for (r, (offset, turn)) in
            plan.rotation.iter().zip(self.offset.iter_mut().zip(&mut self.turn))
        {
            // Starting the sum at 0.0 keeps 0 exact.
            *offset = r.slides.iter().fold(0.0, |angle, &(slide, sign)| {
                let step = slots.slides[slide].step(values);
                if sign > 0 { angle + step } else { angle - step }
            });
            *turn = unit(*offset);
        }
        for (turn, slide) in self.slide_turn.iter_mut().zip(&slots.slides) {
            *turn = unit(slide.step(values));
        }
    }
}

/// Unit vector at an angle, exact at 0.
pub(crate) fn unit(angle: f64) -> Vector {
    if angle == 0.0 { Vector::ONE } else { Vector::at_angle(angle) }
}

impl DesignConstants {
    /// Greatest distance of the tip of a leg from the origin, given the lengths of its dyad.
    fn inner_reach(&self, leg: usize) -> f64 {
        self.dyads.get(leg / 2).map_or(f64::INFINITY, |dyad| dyad.inner_reach)
    }

    /// Computes the constants of the dyads on the tape. `driven_reach`: the greatest value of a
    /// driven slide.
    pub(crate) fn measure_dyads(&mut self, plan: &Plan, tape: &Tape, driven_reach: f64) {
        self.dyads.resize(self.legs.len(), DyadConstants::default());
        self.reach.clear();
        self.reach.extend(self.fixed.iter().map(|at| at.x.abs() + at.y.abs()));
        for op in &tape.ops {
            let step = match op {
                Op::Place(place) => {
                    let arm = self.edge_vector[place.edge];
                    let reach = self.reach[place.from] + arm.x.abs() + arm.y.abs();
                    self.reach[place.to] = match place.kind {
                        PlaceKind::Leg { leg, .. } => reach.min(self.inner_reach(leg)),
                        PlaceKind::Along => reach + driven_reach,
                        _ => reach,
                    };
                    continue;
                }
                Op::TwoLegs(dyad)
                | Op::StandingGuide(dyad)
                | Op::MovingGuide(dyad)
                | Op::TurningGuide(dyad)
                | Op::StandingGuides(dyad) => dyad.step,
                Op::Dyad { step } => *step,
                Op::Group { .. } | Op::Redundant { .. } | Op::Length { .. } => continue,
            };
            let Step::Dyad(dyad) = &plan.steps[step] else { continue };
            let legs = &self.legs[dyad.index];
            let constants = &mut self.dyads[dyad.index];
            (constants.inner_reach, constants.offset) = (f64::INFINITY, Vector::ZERO);
            let [start, end] = [self.reach[dyad.start], self.reach[dyad.end]];
            let rounding = 0.5 * start.max(end);
            let arm2 = |class: usize| self.max_arm2[class].max(rounding * rounding);
            let [u, v] = dyad.unknowns;
            constants.reach = start + end + legs[0].norm;
            for term in &dyad.others {
                let sign = if term.backward { -1.0 } else { 1.0 };
                if let Some(i) = term.slides {
                    constants.guides[i] = self.guide[term.edge].scale(sign);
                }
                if !term.in_leg {
                    let offset = self.edge_vector[term.edge];
                    constants.offset += offset.scale(sign);
                    constants.reach += offset.x.abs() + offset.y.abs();
                }
            }
            let greatest = match op {
                Op::TwoLegs(_) => {
                    constants.sides = Sides::of(&legs[0], &legs[1]);
                    constants.inner_reach = (start + legs[0].norm).min(end + legs[1].norm);
                    (arm2(u.class()) * legs[0].inv_norm2).max(arm2(v.class()) * legs[1].inv_norm2)
                }
                Op::StandingGuide(_) | Op::MovingGuide(_) => arm2(u.class()) * legs[0].inv_norm2,
                Op::TurningGuide(_) => arm2(u.class()),
                _ => 1.0,
            };
            constants.inverse_arm2 = 1.0 / greatest.max(1.0);
            constants.bounding_per_sine2 = constants.sides.per_sine2 * constants.inverse_arm2;
        }
    }
}
