//! Sensitivities: derivatives of positions and analogues by a dimension.
//!
//! The closure equations of every step are differentiated once more, by the dimension. As for the
//! analogues, the unknowns of every order have the same matrix, so one factorisation serves all
//! orders (Uicker, Pennock & Shigley 2017, chapter 3, by complex algebra). The same functions serve
//! dyads and groups of any class.

use nalgebra::{DMatrix, DVector};

use super::closures::{Closures, signed};
use super::state::{Context, State};
use crate::math::derivatives::DerivativeTables;
use crate::math::vector::Vector;
use crate::plan::constants_rate::ConstantsRate;
use crate::plan::dyad::Unknown;
use crate::plan::plan::{EdgeSlide, Plan, Step};

/// Work space: the closures of every step, and the derivatives by a dimension in the form of a
/// state.
pub(crate) struct Sensitivity {
    steps: Vec<Option<Closures>>,
    /// Jets of all orientations.
    units: Vec<Vector>,
    /// Derivatives of points, angles and slides.
    pub rates: State,
}

impl Sensitivity {
    pub(crate) fn new(plan: &Plan, derivatives: &DerivativeTables) -> Self {
        Self {
            steps: plan.steps.iter().map(Closures::of_step).collect(),
            units: vec![Vector::ZERO; plan.orientations.len() * derivatives.len()],
            rates: State::new(plan, derivatives),
        }
    }

    /// Computes the derivatives at a solved position; false if they do not exist.
    pub(crate) fn solve(&mut self, state: &State, cx: &Context<'_>, by: &ConstantsRate) -> bool {
        let len = state.len;
        self.orientation_jets(state, cx);
        for (i, &fixed) in by.fixed.iter().enumerate() {
            self.rates.pose.points[i * len..][..len].fill([Vector::ZERO]);
            self.rates.pose.points[i * len] = [fixed];
        }
        self.rates.pose.theta.fill([0.0]);
        self.rates.pose.slides.fill([0.0]);
        let inputs = Inputs { state, cx, by, len };
        for (index, step) in cx.plan.steps.iter().enumerate() {
            match step {
                &Step::Place { edge, backward } => {
                    let [from, to] = cx.plan.edges[edge].ends(backward);
                    for k in 0..len {
                        let v = self.edge(&inputs, edge, k).scale(signed(backward));
                        let start = self.rates.pose.points[from * len + k][0];
                        self.rates.pose.points[to * len + k][0] = start + v;
                    }
                }
                Step::Redundant(_) => return false,
                Step::Length { .. } => {}
                Step::Dyad(_) | Step::Group(_) => {
                    let Some(closures) = self.steps[index].take() else { return false };
                    let solved = self.solve_closures(&inputs, &closures);
                    self.steps[index] = Some(closures);
                    if !solved {
                        return false;
                    }
                }
            }
        }
        true
    }

    /// Jets of all orientations, from the angles of classes.
    fn orientation_jets(&mut self, state: &State, cx: &Context<'_>) {
        let len = state.len;
        for (o, orientation) in cx.plan.orientations.iter().enumerate() {
            let class = state.pose.class[orientation.class][0];
            let phase = if orientation.driven { state.pose.phase[o][0] } else { Vector::ONE };
            self.units[o * len] = class * phase;
            for k in 1..len {
                let mut sum = self.units[o * len].scale(state.angle_analogue(0, cx, o, k));
                for term in &cx.derivatives.rotation[k] {
                    let rate = term.factor * state.angle_analogue(0, cx, o, term.right);
                    sum += self.units[o * len + term.left].scale(rate);
                }
                self.units[o * len + k] = sum.left();
            }
        }
    }

    /// Entry `k` of an orientation's derivative by the dimension: `∂U = i U ∂Θ`, by Leibniz.
    fn unit_rate(&self, inputs: &Inputs<'_>, o: usize, k: usize) -> Vector {
        let class = inputs.cx.plan.orientations[o].class;
        let mut sum = Vector::ZERO;
        for term in &inputs.cx.derivatives.product[k] {
            let rate = term.factor * self.rates.pose.theta[class * inputs.len + term.right][0];
            sum += self.units[o * inputs.len + term.left].scale(rate);
        }
        sum.left()
    }

    /// Entry `k` of an edge's derivative by the dimension.
    fn edge(&self, inputs: &Inputs<'_>, e: usize, k: usize) -> Vector {
        let (edge, constants, len) = (&inputs.cx.plan.edges[e], inputs.cx.constants, inputs.len);
        let o = edge.orientation;
        let mut sum = self.unit_rate(inputs, o, k) * constants.edge_vector[e]
            + self.units[o * len + k] * inputs.by.edge_vector[e];
        if let EdgeSlide::Slide(slide) | EdgeSlide::Driver { slide } = edge.along {
            for term in &inputs.cx.derivatives.product[k] {
                let unit = self.units[o * len + term.left];
                let value = inputs.state.pose.slides[slide * len + term.right][0];
                let rate = self.rates.pose.slides[slide * len + term.right][0];
                let turned = self.unit_rate(inputs, o, term.left) * constants.guide[e];
                let guide_rate = unit * inputs.by.guide[e];
                let along = unit * constants.guide[e];
                sum += ((turned + guide_rate).scale(value) + along.scale(rate)).scale(term.factor);
            }
        }
        sum
    }

    /// Solves for the unknowns' derivatives, order by order; false if the matrix is singular.
    fn solve_closures(&mut self, inputs: &Inputs<'_>, closures: &Closures) -> bool {
        let (len, n) = (inputs.len, closures.unknowns.len());
        let lu = self.matrix(inputs, closures).lu();
        for k in 0..len {
            let mut rhs = DVector::zeros(n);
            for (i, path) in closures.paths.iter().enumerate() {
                let point = |p: usize| self.rates.pose.points[p * len + k][0];
                let mut sum = point(path.plus) - point(path.minus);
                for &(e, sign) in &path.edges {
                    sum += self.edge(inputs, e, k).scale(sign);
                }
                rhs[2 * i] = -sum.x;
                rhs[2 * i + 1] = -sum.y;
            }
            let Some(values) = lu.solve(&rhs) else { return false };
            for (&unknown, &value) in closures.unknowns.iter().zip(values.iter()) {
                match unknown {
                    Unknown::Class(class) => self.rates.pose.theta[class * len + k][0] = value,
                    Unknown::Slide(slide) => self.rates.pose.slides[slide * len + k][0] = value,
                }
            }
        }
        true
    }

    /// Derivatives of the closures by the unknowns.
    fn matrix(&self, inputs: &Inputs<'_>, closures: &Closures) -> DMatrix<f64> {
        let n = closures.unknowns.len();
        let mut matrix = DMatrix::zeros(n, n);
        for (i, path) in closures.paths.iter().enumerate() {
            for &(e, sign) in &path.edges {
                let edge = &inputs.cx.plan.edges[e];
                let unit = self.units[edge.orientation * inputs.len].scale(sign);
                let guide = unit * inputs.cx.constants.guide[e];
                let mut vector = unit * inputs.cx.constants.edge_vector[e];
                if let EdgeSlide::Slide(slide) | EdgeSlide::Driver { slide } = edge.along {
                    vector += guide.scale(inputs.state.pose.slides[slide * inputs.len][0]);
                }
                for (column, &unknown) in closures.unknowns.iter().enumerate() {
                    let v = match (unknown, edge.along) {
                        (Unknown::Class(class), _) if class == edge.class => vector.left(),
                        (Unknown::Slide(slide), EdgeSlide::Slide(along)) if slide == along => guide,
                        _ => continue,
                    };
                    matrix[(2 * i, column)] += v.x;
                    matrix[(2 * i + 1, column)] += v.y;
                }
            }
        }
        matrix
    }
}

/// The solved position and the rates of the constants by the dimension.
struct Inputs<'a> {
    state: &'a State,
    cx: &'a Context<'a>,
    by: &'a ConstantsRate,
    len: usize,
}
