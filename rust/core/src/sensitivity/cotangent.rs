//! Backward: the derivatives of a weighted sum of results by the constants of a design, by the transposed
//! steps in reverse order.

use super::linearization::Linearization;
use super::plan::{Component, ComponentKind, LinearStep, SensitivityPlan, slide_along};
use crate::branch::design::Units;
use crate::math::lanes::Real;
use crate::math::vector::Vector;
use crate::plan::constants_rate::ConstantsRate;
use crate::plan::dyad::Unknown;
use crate::plan::plan::EdgeSlide;

/// Derivatives by the points, classes' angles and slides, jet by jet, and by the constants.
#[derive(Debug, Default)]
pub(super) struct Cotangent<R> {
    points: Vec<Vector<R>>,
    theta: Vec<R>,
    slides: Vec<R>,
    pub constants: ConstantsRate<R>,
    multipliers: Vec<R>,
}

impl<R: Real> Cotangent<R> {
    /// Begins with all weights zero.
    #[inline(always)]
    pub(super) fn clear(&mut self, sensitivity: &SensitivityPlan<'_>) {
        let (len, plan) = (sensitivity.len(), sensitivity.plan());
        let edges = plan.edges.len();
        for (vectors, count) in [
            (&mut self.points, plan.points * len),
            (&mut self.constants.edge_vector, edges),
            (&mut self.constants.guide, edges),
            (&mut self.constants.fixed, plan.points),
        ] {
            vectors.clear();
            vectors.resize(count, Vector::ZERO);
        }
        for (numbers, count) in [
            (&mut self.theta, plan.classes * len),
            (&mut self.slides, plan.slide_links.len() * len),
            (&mut self.constants.offset, plan.rotation.len()),
        ] {
            numbers.clear();
            numbers.resize(count, R::ZERO);
        }
        self.constants.origin = Vector::ZERO;
    }

    /// Adds the weight of a component of a result, per metre or radian.
    #[inline(always)]
    pub(super) fn add(
        &mut self,
        len: usize,
        units: &Units,
        Component { kind, k }: Component,
        weight: R,
    ) {
        let length = weight * R::splat(units.length[k]);
        match kind {
            ComponentKind::X { point } => {
                self.points[point * len + k].x += length;
                if k == 0 {
                    self.constants.origin.x += weight;
                }
            }
            ComponentKind::Y { point } => {
                self.points[point * len + k].y += length;
                if k == 0 {
                    self.constants.origin.y += weight;
                }
            }
            ComponentKind::Slide(slide) => self.slides[slide * len + k] += length,
            ComponentKind::Angle { link, class } => {
                self.theta[class * len + k] += weight * R::splat(units.angle[k]);
                if k == 0 {
                    self.constants.offset[link] += weight;
                }
            }
        }
    }

    /// Passes all weights back to the constants.
    #[inline(always)]
    pub(super) fn pull_back(
        &mut self,
        sensitivity: &SensitivityPlan<'_>,
        linear: &Linearization<R>,
    ) {
        let len = sensitivity.len();
        for step in sensitivity.steps.iter().rev() {
            match step {
                &LinearStep::Place { edge, from, to, sign } => {
                    for k in 0..len {
                        let weight = self.points[to * len + k];
                        self.points[from * len + k] += weight;
                        self.edge(sensitivity, linear, (edge, k), weight.scale(R::splat(sign)));
                    }
                }
                LinearStep::Solve { closures, inverse } => {
                    let n = closures.unknowns.len();
                    let inverse = linear.inverse(*inverse, n);
                    // A higher order depends on the lower ones.
                    for k in (0..len).rev() {
                        self.multipliers.clear();
                        self.multipliers.resize(n, R::ZERO);
                        for (row, &unknown) in closures.unknowns.iter().enumerate() {
                            let weight = match unknown {
                                Unknown::Class(class) => self.theta[class * len + k],
                                Unknown::Slide(slide) => self.slides[slide * len + k],
                            };
                            for (multiplier, &entry) in
                                self.multipliers.iter_mut().zip(&inverse[row * n..])
                            {
                                *multiplier += -(entry * weight);
                            }
                        }
                        for (i, path) in closures.paths.iter().enumerate() {
                            let multiplier =
                                Vector::new(self.multipliers[2 * i], self.multipliers[2 * i + 1]);
                            self.points[path.plus * len + k] += multiplier;
                            self.points[path.minus * len + k] += -multiplier;
                            for &(e, sign) in &path.edges {
                                let weight = multiplier.scale(R::splat(sign));
                                self.edge(sensitivity, linear, (e, k), weight);
                            }
                        }
                    }
                }
            }
        }
        for (point, fixed) in self.constants.fixed.iter_mut().enumerate() {
            *fixed = self.points[point * len];
        }
    }

    /// Passes the weight of a jet entry of an edge back: the transpose of [`Tangent`](super::tangent::Tangent)'s
    /// `edge`. What a step's own unknowns get at its own order is read no more.
    #[inline(always)]
    fn edge(
        &mut self,
        sensitivity: &SensitivityPlan<'_>,
        linear: &Linearization<R>,
        (e, k): (usize, usize),
        weight: Vector<R>,
    ) {
        let len = sensitivity.len();
        let edge = &sensitivity.plan().edges[e];
        if edge.class != 0 {
            for term in &sensitivity.derivatives.product[k] {
                let moment = linear.edges[e * len + term.left].cross(weight);
                self.theta[edge.class * len + term.right] += R::splat(term.factor) * moment;
            }
        }
        self.constants.edge_vector[e] += linear.turns[e * len + k].conj() * weight;
        if slide_along(edge.along).is_some() {
            self.constants.guide[e] += linear.strokes[e * len + k].conj() * weight;
        }
        if let EdgeSlide::Slide(slide) = edge.along {
            for term in &sensitivity.derivatives.product[k] {
                let along = linear.guides[e * len + term.left].dot(weight);
                self.slides[slide * len + term.right] += R::splat(term.factor) * along;
            }
        }
    }
}
