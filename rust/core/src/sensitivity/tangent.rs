//! Forward: the rates of positions where the constants of a design change at given rates.

use super::linearization::Linearization;
use super::plan::SensitivityPlan;
use super::steps::{Component, ComponentKind, LinearStep, slide_along};
use crate::branch::design::Units;
use crate::math::lanes::Real;
use crate::math::vector::Vector;
use crate::plan::constants_rate::ConstantsRate;
use crate::plan::dyad::Unknown;
use crate::plan::plan::EdgeSlide;

/// Rates of points, classes' angles and slides, jet by jet, in units of the scale.
#[derive(Debug, Default)]
pub(crate) struct Tangent<R> {
    points: Vec<Vector<R>>,
    theta: Vec<R>,
    slides: Vec<R>,
    right: Vec<R>,
}

impl<R: Real> Tangent<R> {
    /// Computes all rates in a register of the linearised equations.
    #[inline(always)]
    pub(crate) fn solve(
        &mut self,
        sensitivity: &SensitivityPlan<'_>,
        (linear, register): (&Linearization<R>, usize),
        by: &ConstantsRate,
    ) {
        let (len, plan) = (sensitivity.len(), sensitivity.plan());
        self.points.clear();
        for &fixed in &by.fixed {
            self.points.push(Vector::splat(fixed));
            self.points.extend((1..len).map(|_| Vector::ZERO));
        }
        for (numbers, count) in
            [(&mut self.theta, plan.classes), (&mut self.slides, plan.slide_links.len())]
        {
            numbers.clear();
            numbers.resize(count * len, R::ZERO);
        }
        for step in &sensitivity.steps {
            match step {
                &LinearStep::Place { edge, from, to, sign } => {
                    for k in 0..len {
                        let along = self.edge(sensitivity, (linear, register), by, (edge, k));
                        let start = self.points[from * len + k];
                        self.points[to * len + k] = start + along.scale(R::splat(sign));
                    }
                }
                LinearStep::Solve { closures, inverse } => {
                    let n = closures.unknowns.len();
                    for k in 0..len {
                        self.right.clear();
                        for path in &closures.paths {
                            let mut sum = self.points[path.plus * len + k];
                            sum = sum - self.points[path.minus * len + k];
                            for &(e, sign) in &path.edges {
                                let rate = self.edge(sensitivity, (linear, register), by, (e, k));
                                sum += rate.scale(R::splat(sign));
                            }
                            self.right.extend([-sum.x, -sum.y]);
                        }
                        for (row, &unknown) in closures.unknowns.iter().enumerate() {
                            let mut value = R::ZERO;
                            for (column, &right) in self.right.iter().enumerate() {
                                let entry = linear.inverse(*inverse, row * n + column)[register];
                                value += entry * right;
                            }
                            match unknown {
                                Unknown::Class(class) => self.theta[class * len + k] = value,
                                Unknown::Slide(slide) => self.slides[slide * len + k] = value,
                            }
                        }
                    }
                }
            }
        }
    }

    /// The rate of a jet entry of an edge: `i V θ + G s + U w + (U s) g`, by Leibniz.
    #[inline(always)]
    fn edge(
        &self,
        sensitivity: &SensitivityPlan<'_>,
        (linear, register): (&Linearization<R>, usize),
        by: &ConstantsRate,
        (e, k): (usize, usize),
    ) -> Vector<R> {
        let len = sensitivity.len();
        let edge = &sensitivity.plan().edges[e];
        let unit = linear.unit(edge.orientation, k)[register];
        let mut sum = unit * Vector::splat(by.edge_vector[e]);
        if edge.class != 0 {
            let mut turned = Vector::ZERO;
            for term in &sensitivity.derivatives.product[k] {
                let rate = R::splat(term.factor) * self.theta[edge.class * len + term.right];
                turned += linear.edge(e, term.left)[register].scale(rate);
            }
            sum = turned.left() + sum;
        }
        if slide_along(edge.along).is_some() {
            sum += linear.stroke(e, k)[register] * Vector::splat(by.guide[e]);
        }
        if let EdgeSlide::Slide(slide) = edge.along {
            for term in &sensitivity.derivatives.product[k] {
                let rate = R::splat(term.factor) * self.slides[slide * len + term.right];
                sum += linear.guide(e, term.left)[register].scale(rate);
            }
        }
        sum
    }

    /// The rate of a component of a result, in metres and radians.
    #[inline(always)]
    pub(crate) fn component(
        &self,
        len: usize,
        (units, by): (&Units, &ConstantsRate),
        Component { kind, k }: Component,
    ) -> R {
        let value = |at: usize| at * len + k;
        let length = R::splat(units.length[k]);
        let shift = if k == 0 { by.origin } else { Vector::ZERO };
        match kind {
            ComponentKind::X { point } => self.points[value(point)].x * length + R::splat(shift.x),
            ComponentKind::Y { point } => self.points[value(point)].y * length + R::splat(shift.y),
            ComponentKind::Slide(slide) => self.slides[value(slide)] * length,
            ComponentKind::Angle { link, class } => {
                let offset = if k == 0 { by.offset[link] } else { 0.0 };
                self.theta[value(class)] * R::splat(units.angle[k]) + R::splat(offset)
            }
        }
    }
}
