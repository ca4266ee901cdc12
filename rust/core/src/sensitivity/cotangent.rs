//! Backward: the derivatives of a weighted sum of results by the constants of a design, by the transposed
//! steps in reverse order.

use std::ops::Range;

use super::backward::{BackwardPath, BackwardStep, Target, UnknownWeight};
use super::constants_sum::ConstantsSum;
use super::linearization::Linearization;
use super::plan::SensitivityPlan;
use super::registers::{entry, entry_mut, grow};
use super::steps::{Component, ComponentKind};
use crate::branch::design::Units;
use crate::math::lanes::Real;
use crate::math::vector::Vector;
use crate::plan::dyad::Unknown;

/// Weights of points, edges, and of the classes' angles and slides that are results, jet by jet; each entry has
/// as many registers as in the [`Linearization`].
#[derive(Debug, Default)]
pub(super) struct Cotangent<R> {
    registers: usize,
    points: Vec<Vector<R>>,
    edges: Vec<Vector<R>>,
    theta: Vec<R>,
    slides: Vec<R>,
    /// Weights of an unknown.
    weight: Vec<R>,
    /// Multipliers of the closed paths of a step.
    multipliers: Vec<Vector<R>>,
    pub constants: ConstantsSum<R>,
}

impl<R: Real> Cotangent<R> {
    /// Begins with all weights of results zero.
    #[inline(always)]
    pub(super) fn begin(&mut self, sensitivity: &SensitivityPlan<'_>, registers: usize) {
        let (plan, backward) = (sensitivity.plan(), &sensitivity.backward);
        let jets = sensitivity.len() * registers;
        self.registers = registers;
        grow(&mut self.points, plan.points * jets);
        grow(&mut self.edges, plan.edges.len() * jets);
        grow(&mut self.theta, plan.classes * jets);
        grow(&mut self.slides, plan.slide_links.len() * jets);
        grow(&mut self.weight, registers);
        for &point in &backward.points {
            entry_mut(&mut self.points, point, jets).fill(Vector::ZERO);
        }
        for &class in &backward.classes {
            entry_mut(&mut self.theta, class, jets).fill(R::ZERO);
        }
        for &slide in &backward.slides {
            entry_mut(&mut self.slides, slide, jets).fill(R::ZERO);
        }
    }

    /// Adds the weights of a component of a result, per metre or radian.
    #[inline(always)]
    pub(super) fn add(&mut self, len: usize, units: &Units, component: Component, weights: &[R]) {
        let Component { kind, k } = component;
        let registers = self.registers;
        let length = R::splat(units.length[k]);
        if k == 0 {
            self.constants.add_result(kind, weights);
        }
        match kind {
            ComponentKind::X { point } => {
                let points = entry_mut(&mut self.points, point * len + k, registers);
                for (point, &weight) in points.iter_mut().zip(weights) {
                    point.x += weight * length;
                }
            }
            ComponentKind::Y { point } => {
                let points = entry_mut(&mut self.points, point * len + k, registers);
                for (point, &weight) in points.iter_mut().zip(weights) {
                    point.y += weight * length;
                }
            }
            ComponentKind::Slide(slide) => {
                let slides = entry_mut(&mut self.slides, slide * len + k, registers);
                for (slide, &weight) in slides.iter_mut().zip(weights) {
                    *slide += weight * length;
                }
            }
            ComponentKind::Angle { class, .. } => {
                let unit = R::splat(units.angle[k]);
                let theta = entry_mut(&mut self.theta, class * len + k, registers);
                for (theta, &weight) in theta.iter_mut().zip(weights) {
                    *theta += weight * unit;
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
        let (len, registers) = (sensitivity.len(), self.registers);
        for step in &sensitivity.backward.steps {
            match step {
                &BackwardStep::Place { to, from, edge, sign } => {
                    for k in 0..len {
                        let places = [to, from.index].map(|at| range(at * len + k, registers));
                        let Ok([placed, base]) = self.points.get_disjoint_mut(places) else {
                            continue;
                        };
                        let edges = entry_mut(&mut self.edges, edge.index * len + k, registers);
                        let are_first = [from.is_first, edge.is_first];
                        put_two([base, edges], [1.0, sign], are_first, placed);
                    }
                }
                BackwardStep::Solve { unknowns, paths, inverse } => {
                    // A higher order depends on the lower ones.
                    for k in (0..len).rev() {
                        self.multiply(sensitivity, linear, (unknowns, *inverse, paths.len()), k);
                        self.spread(len, paths, k);
                    }
                }
            }
        }
        self.reach_constants(sensitivity, linear);
    }

    /// The multipliers of a step's closed paths at an order.
    #[inline(always)]
    fn multiply(
        &mut self,
        sensitivity: &SensitivityPlan<'_>,
        linear: &Linearization<R>,
        (unknowns, inverse, paths): (&[UnknownWeight], usize, usize),
        k: usize,
    ) {
        let registers = self.registers;
        grow(&mut self.multipliers, paths * registers);
        for (index, unknown) in unknowns.iter().enumerate() {
            self.weigh(sensitivity, linear, unknown, k);
            let weights = &self.weight[..registers];
            for path in 0..paths {
                let place = unknown.row * 2 * paths + 2 * path;
                let (x, y) = (linear.inverse(inverse, place), linear.inverse(inverse, place + 1));
                let multipliers = entry_mut(&mut self.multipliers, path, registers);
                for g in 0..registers {
                    let multiplier = -Vector::new(x[g], y[g]).scale(weights[g]);
                    multipliers[g] =
                        if index == 0 { multiplier } else { multipliers[g] + multiplier };
                }
            }
        }
    }

    /// The weights of an unknown at an order.
    #[inline(always)]
    fn weigh(
        &mut self,
        sensitivity: &SensitivityPlan<'_>,
        linear: &Linearization<R>,
        unknown: &UnknownWeight,
        k: usize,
    ) {
        let (len, registers) = (sensitivity.len(), self.registers);
        let weights = &mut self.weight[..registers];
        let mut is_first = !unknown.is_result;
        if unknown.is_result {
            let results = match unknown.unknown {
                Unknown::Class(class) => entry(&self.theta, class * len + k, registers),
                Unknown::Slide(slide) => entry(&self.slides, slide * len + k, registers),
            };
            weights.copy_from_slice(results);
        }
        for &(e, of_higher_orders) in &unknown.edges {
            for term in &sensitivity.backward.terms[k] {
                if of_higher_orders && term.order == k {
                    continue;
                }
                let (factor, turns) = match unknown.unknown {
                    Unknown::Class(_) => (R::splat(term.factor), true),
                    Unknown::Slide(_) => (R::splat(term.factor), false),
                };
                let jets =
                    if turns { linear.edge(e, term.left) } else { linear.guide(e, term.left) };
                let edges = entry(&self.edges, e * len + term.order, registers);
                for ((weight, jet), &edge) in weights.iter_mut().zip(jets).zip(edges) {
                    let part = factor * if turns { jet.cross(edge) } else { jet.dot(edge) };
                    *weight = if is_first { part } else { *weight + part };
                }
                is_first = false;
            }
        }
        if is_first {
            weights.fill(R::ZERO);
        }
    }

    /// Passes the multipliers of closed paths at an order to their ends and edges.
    #[inline(always)]
    fn spread(&mut self, len: usize, paths: &[BackwardPath], k: usize) {
        let registers = self.registers;
        for (i, path) in paths.iter().enumerate() {
            let multipliers = entry(&self.multipliers, i, registers);
            let ends = [(path.plus, 1.0), (path.minus, -1.0)];
            let places = ends.map(|(end, _)| range(end.index * len + k, registers));
            if let Ok(points) = self.points.get_disjoint_mut(places) {
                let are_first = [path.plus.is_first, path.minus.is_first];
                put_two(points, [1.0, -1.0], are_first, multipliers);
            } else {
                // A path that ends where it begins.
                for (end, sign) in ends {
                    let points = entry_mut(&mut self.points, end.index * len + k, registers);
                    put((points, sign, end.is_first), multipliers);
                }
            }
            for &(Target { index, is_first }, sign) in &path.edges {
                let edges = entry_mut(&mut self.edges, index * len + k, registers);
                put((edges, sign, is_first), multipliers);
            }
        }
    }

    /// Passes the weights of edges and fixed points to the constants.
    #[inline(always)]
    fn reach_constants(&mut self, sensitivity: &SensitivityPlan<'_>, linear: &Linearization<R>) {
        let (len, registers) = (sensitivity.len(), self.registers);
        for &e in &sensitivity.backward.edges {
            let edge = &sensitivity.plan().edges[e];
            for k in 0..len {
                let weights = entry(&self.edges, e * len + k, registers);
                self.constants.add_edge(e, linear.unit(edge.orientation, k), weights);
            }
        }
        for &e in &sensitivity.backward.guides {
            for k in 0..len {
                let weights = entry(&self.edges, e * len + k, registers);
                self.constants.add_guide(e, linear.stroke(e, k), weights);
            }
        }
        for &point in &sensitivity.backward.fixed {
            self.constants.add_fixed(point, entry(&self.points, point * len, registers));
        }
    }
}

/// Where vectors, times a sign, are added, or set if these are the first.
type Sums<'s, R> = (&'s mut [Vector<R>], f64, bool);

#[inline(always)]
fn put<R: Real>((sums, sign, is_first): Sums<'_, R>, vectors: &[Vector<R>]) {
    let sign = R::splat(sign);
    for (sum, vector) in sums.iter_mut().zip(vectors) {
        let vector = vector.scale(sign);
        *sum = if is_first { vector } else { *sum + vector };
    }
}

/// The same at two places at once, which takes less time.
#[inline(always)]
fn put_two<R: Real>(
    [one, other]: [&mut [Vector<R>]; 2],
    signs: [f64; 2],
    are_first: [bool; 2],
    vectors: &[Vector<R>],
) {
    let signs = [R::splat(signs[0]), R::splat(signs[1])];
    let both = one.iter_mut().zip(other.iter_mut());
    for ((one, other), vector) in both.zip(vectors) {
        let [to_one, to_other] = [vector.scale(signs[0]), vector.scale(signs[1])];
        *one = if are_first[0] { to_one } else { *one + to_one };
        *other = if are_first[1] { to_other } else { *other + to_other };
    }
}

/// The registers of an entry.
#[inline(always)]
fn range(index: usize, registers: usize) -> Range<usize> {
    index * registers..(index + 1) * registers
}
