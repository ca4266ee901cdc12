//! Derivatives of the constant vectors of a design by its dimensions, and the transpose.

use super::constants::{
    DesignConstants, DimensionMap, EdgeSource, SlideSlots, read, read_two, unit,
};
use super::lengths::Slot;
use super::plan::Plan;
use crate::math::lanes::Real;
use crate::math::vector::Vector;

/// Rates of [`DesignConstants`] at constant scale; or derivatives of a number by them.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct ConstantsRate<R = f64> {
    /// Of the frame's origin, m.
    pub origin: Vector<R>,
    /// Of the constant part of every edge.
    pub edge_vector: Vec<Vector<R>>,
    /// Of the guide direction of every edge with a slide.
    pub guide: Vec<Vector<R>>,
    /// Of the points fixed to the ground.
    pub fixed: Vec<Vector<R>>,
    /// Of the constant angle of every link relative to its class.
    pub offset: Vec<R>,
}

impl ConstantsRate {
    /// Rates for a design (`values`, `constants`) whose dimensions have the rates `by`, m or rad.
    #[must_use]
    pub(crate) fn new(
        plan: &Plan,
        slots: &DimensionMap,
        constants: &DesignConstants,
        values: &[f64],
        by: &[f64],
    ) -> Self {
        // The constants are linear in all dimensions except angles.
        let origin = read_two(by, slots.origin);
        let inv_scale = 1.0 / constants.scale;
        let offset = offsets(plan, slots, by);
        let mut rate = Self { origin, offset, ..Self::default() };
        for ((e, source), edge_vector) in
            plan.edges.iter().zip(&slots.edges).zip(&constants.edge_vector)
        {
            let (w, d) = match *source {
                EdgeSource::Joint(slots) => (read_two(by, slots), Vector::ZERO),
                EdgeSource::Guide(slide) => {
                    let slide = &slots.slides[slide];
                    let direction = unit(slide.angle(values));
                    let turned = direction.left().scale(slide.angle(by));
                    let mut start = read_two(by, slide.origin);
                    if slide.drawn {
                        start = start - origin;
                    }
                    let across = direction.left().scale(read(by, slide.offset));
                    let along = turned.left().scale(read(values, slide.offset));
                    (start + across + along, turned)
                }
            };
            let link = e.edge.link;
            let (turn, offset) = (constants.turn[link], rate.offset[link]);
            let guide = constants.guide[rate.guide.len()];
            rate.edge_vector.push((turn * w).scale(inv_scale) + edge_vector.left().scale(offset));
            rate.guide.push(turn * d + guide.left().scale(offset));
        }
        rate.fixed.resize(plan.points, Vector::ZERO);
        for &(joint, at) in &slots.ground {
            rate.fixed[joint + 1] = (read_two(by, at) - origin).scale(inv_scale);
        }
        rate
    }
}

impl<R: Real> ConstantsRate<R> {
    /// Derivatives by the dimensions of a number with these derivatives by the constants: the transpose of
    /// [`Self::new`].
    #[inline(always)]
    pub(crate) fn by_dimensions(
        &self,
        plan: &Plan,
        slots: &DimensionMap,
        constants: &DesignConstants,
        values: &[f64],
        by: &mut [R],
    ) {
        by.fill(R::ZERO);
        add_two(by, slots.origin, self.origin);
        let inv_scale = R::splat(1.0 / constants.scale);
        for (e, source) in slots.edges.iter().enumerate() {
            let link = plan.edges[e].edge.link;
            let turn = Vector::<R>::splat(constants.turn[link].conj());
            let along = (turn * self.edge_vector[e]).scale(inv_scale);
            let mut offset = Vector::splat(constants.edge_vector[e]).cross(self.edge_vector[e]);
            match *source {
                EdgeSource::Joint(slots) => add_two(by, slots, along),
                EdgeSource::Guide(slide) => {
                    let slide = &slots.slides[slide];
                    let direction = Vector::splat(unit(slide.angle(values)));
                    let across = read(values, slide.offset);
                    add_two(by, slide.origin, along);
                    if slide.drawn {
                        add_two(by, slots.origin, -along);
                    }
                    add(by, slide.offset, direction.cross(along));
                    let turned = direction.cross(turn * self.guide[e]);
                    slide.add_angle(by, turned + -(direction.dot(along) * R::splat(across)));
                    offset += Vector::splat(constants.guide[e]).cross(self.guide[e]);
                }
            }
            add_offset(by, plan, slots, link, offset);
        }
        for &(joint, at) in &slots.ground {
            let fixed = self.fixed[joint + 1].scale(inv_scale);
            add_two(by, at, fixed);
            add_two(by, slots.origin, -fixed);
        }
        for (link, &offset) in self.offset.iter().enumerate() {
            add_offset(by, plan, slots, link, offset);
        }
    }
}

/// Adds to the dimension of a slot, if there is one.
#[inline(always)]
fn add<R: Real>(by: &mut [R], slot: Slot, number: R) {
    if let Some(index) = slot {
        by[index] += number;
    }
}

#[inline(always)]
fn add_two<R: Real>(by: &mut [R], slots: [Slot; 2], vector: Vector<R>) {
    add(by, slots[0], vector.x);
    add(by, slots[1], vector.y);
}

/// Adds what a link's constant angle gives to the angles of the slides that it depends on.
#[inline(always)]
fn add_offset<R: Real>(by: &mut [R], plan: &Plan, slots: &DimensionMap, link: usize, offset: R) {
    for &(slide, sign) in &plan.rotation[link].slides {
        slots.slides[slide].add_step(by, offset * R::splat(f64::from(sign)));
    }
}

/// Derivatives of the links' constant angles by the dimension whose entry in `by` is 1.
pub(crate) fn offsets(plan: &Plan, slots: &DimensionMap, by: &[f64]) -> Vec<f64> {
    let step = |slide: usize| slots.slides[slide].step(by);
    let offset = |r: &crate::structure::closure::Rotation| {
        r.slides.iter().map(|&(slide, sign)| f64::from(sign) * step(slide)).sum()
    };
    plan.rotation.iter().map(offset).collect()
}

impl SlideSlots {
    /// The transpose of [`Self::angle`].
    #[inline(always)]
    fn add_angle<R: Real>(&self, by: &mut [R], number: R) {
        add(by, self.angle, number);
    }

    /// The transpose of [`Self::step`].
    #[inline(always)]
    fn add_step<R: Real>(&self, by: &mut [R], number: R) {
        add(by, self.angle, number);
        add(by, self.link_angle, -number);
    }
}
