//! Derivatives of the constant vectors of a design by one of its dimensions.

use super::constants::{DesignConstants, DimensionMap, EdgeSource, read, read_two, unit};
use super::plan::Plan;
use crate::math::vector::Vector;

/// Derivatives of [`DesignConstants`] by one dimension (m or rad), at constant scale.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct ConstantsRate {
    /// Rate of the frame's origin, m.
    pub origin: Vector,
    /// Rates of the constant part of every edge.
    pub edge_vector: Vec<Vector>,
    /// Rates of the guide direction of every edge with a slide.
    pub guide: Vec<Vector>,
    /// Rates of the points fixed to the ground.
    pub fixed: Vec<Vector>,
    /// Rates of the constant angle of every link relative to its class.
    pub offset: Vec<f64>,
}

impl ConstantsRate {
    /// Derivatives for a design (`values`, `constants`) by the dimension of this index.
    #[must_use]
    pub(crate) fn new(
        plan: &Plan,
        slots: &DimensionMap,
        constants: &DesignConstants,
        values: &[f64],
        index: usize,
    ) -> Self {
        // The constants are linear in all dimensions except angles.
        let mut by = vec![0.0; values.len()];
        by[index] = 1.0;
        let origin = read_two(&by, slots.origin);
        let inv_scale = 1.0 / constants.scale;
        let offset = offsets(plan, slots, &by);
        let mut rate = Self { origin, offset, ..Self::default() };
        for ((e, source), edge_vector) in
            plan.edges.iter().zip(&slots.edges).zip(&constants.edge_vector)
        {
            let (w, d) = match *source {
                EdgeSource::Joint(slots) => (read_two(&by, slots), Vector::ZERO),
                EdgeSource::Guide(slide) => {
                    let slide = &slots.slides[slide];
                    let direction = unit(slide.angle(values));
                    let turned = direction.left().scale(slide.angle(&by));
                    let mut start = read_two(&by, slide.origin);
                    if slide.drawn {
                        start = start - origin;
                    }
                    let across = direction.left().scale(read(&by, slide.offset));
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
            rate.fixed[joint + 1] = (read_two(&by, at) - origin).scale(inv_scale);
        }
        rate
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
