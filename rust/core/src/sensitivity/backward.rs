//! The steps of the solution in reverse, compiled once: how weights of results pass back to the edges.
//!
//! What is written first is set, so that nothing needs to be cleared at every position.

use super::steps::{Component, ComponentKind, LinearStep, slide_along};
use crate::math::derivatives::DerivativeTables;
use crate::plan::dyad::Unknown;
use crate::plan::mechanism::Mechanism;
use crate::plan::plan::{EdgeSlide, Plan};
use crate::state::closures::Closures;

/// A place to add to; the first that does so sets it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Target {
    pub index: usize,
    pub is_first: bool,
}

/// A step in reverse.
#[derive(Debug)]
pub(super) enum BackwardStep {
    /// The weight of a placed point passes to the point that it was placed from, and with this sign to the
    /// edge.
    Place { to: usize, from: Target, edge: Target, sign: f64 },
    /// The weights of the unknowns pass, by the transposed inverse that begins at this place, to the closed
    /// paths.
    Solve { unknowns: Vec<UnknownWeight>, paths: Vec<BackwardPath>, inverse: usize },
}

/// The weight of an unknown: its own as a result, and those of the edges that it turns or shifts.
#[derive(Debug)]
pub(super) struct UnknownWeight {
    pub unknown: Unknown,
    /// Row of the inverse.
    pub row: usize,
    /// Whether it is a result.
    pub is_result: bool,
    /// The edges; true if only this step gives one a weight, so far of higher orders.
    pub edges: Vec<(usize, bool)>,
}

/// A closed path, which gives its multiplier to its ends and, with their signs, to its edges.
#[derive(Debug)]
pub(super) struct BackwardPath {
    pub plus: Target,
    pub minus: Target,
    pub edges: Vec<(Target, f64)>,
}

/// A weight of order `order` counts, times `factor` and the derivative `left` of its edge.
#[derive(Debug, Clone, Copy)]
pub(super) struct WeightTerm {
    pub order: usize,
    pub left: usize,
    pub factor: f64,
}

/// The compiled steps.
#[derive(Debug, Default)]
pub(super) struct Backward {
    pub steps: Vec<BackwardStep>,
    /// Points, classes and slides that are results, and links whose angles are.
    pub points: Vec<usize>,
    pub classes: Vec<usize>,
    pub slides: Vec<usize>,
    pub links: Vec<usize>,
    /// Edges that get weights, and those with a slide among them.
    pub edges: Vec<usize>,
    pub guides: Vec<usize>,
    /// Points fixed to the ground, at places that are dimensions, that get weights.
    pub fixed: Vec<usize>,
    /// For every entry of a jet of an unknown the weights of edges that count: Leibniz' rule, transposed.
    pub terms: Vec<Vec<WeightTerm>>,
}

/// Which points and edges have a weight so far.
struct Weighted {
    points: Vec<bool>,
    edges: Vec<bool>,
}

impl Backward {
    pub(super) fn new(
        mechanism: &Mechanism,
        steps: &[LinearStep],
        results: &[Vec<Component>],
        derivatives: &DerivativeTables,
    ) -> Self {
        let plan = mechanism.plan();
        let mut backward = Self { terms: transposed(derivatives), ..Self::default() };
        for component in results.iter().flatten() {
            let (list, index) = match component.kind {
                ComponentKind::X { point } | ComponentKind::Y { point } => {
                    (&mut backward.points, point)
                }
                ComponentKind::Slide(slide) => (&mut backward.slides, slide),
                ComponentKind::Angle { link, class } => {
                    push_new(&mut backward.links, link);
                    (&mut backward.classes, class)
                }
            };
            push_new(list, index);
        }
        let mut weighted =
            Weighted { points: vec![false; plan.points], edges: vec![false; plan.edges.len()] };
        for &point in &backward.points {
            weighted.points[point] = true;
        }
        for step in steps.iter().rev() {
            let step = match step {
                &LinearStep::Place { edge, from, to, sign } => {
                    let (edge, from) = (weighted.edge(edge), weighted.point(from));
                    BackwardStep::Place { to, from, edge, sign }
                }
                LinearStep::Solve { closures, inverse } => BackwardStep::Solve {
                    unknowns: backward.unknowns(plan, closures, &weighted),
                    paths: weighted.paths(closures),
                    inverse: *inverse,
                },
            };
            backward.steps.push(step);
        }
        let with_weight = |edge: &usize| weighted.edges[*edge];
        backward.edges = (0..plan.edges.len()).filter(with_weight).collect();
        let with_slide = |edge: &usize| slide_along(plan.edges[*edge].along).is_some();
        backward.guides = backward.edges.iter().copied().filter(with_slide).collect();
        let fixed = mechanism.slots.ground.iter().map(|&(joint, _)| joint + 1);
        backward.fixed = fixed.filter(|&point| weighted.points[point]).collect();
        backward
    }

    /// The weights of a step's unknowns that have any.
    fn unknowns(
        &self,
        plan: &Plan,
        closures: &Closures,
        weighted: &Weighted,
    ) -> Vec<UnknownWeight> {
        let own =
            |e: usize| closures.paths.iter().any(|p| p.edges.iter().any(|&(own, _)| own == e));
        let has_higher_orders = self.terms.len() > 1;
        let of_edge = |e: usize| {
            let is_weighted = weighted.edges[e];
            (is_weighted || has_higher_orders && own(e)).then_some((e, !is_weighted))
        };
        let unknowns = closures.unknowns.iter().enumerate().map(|(row, &unknown)| {
            let moves = |e: &usize| match unknown {
                Unknown::Class(class) => plan.edges[*e].class == class,
                Unknown::Slide(slide) => plan.edges[*e].along == EdgeSlide::Slide(slide),
            };
            let is_result = match unknown {
                Unknown::Class(class) => self.classes.contains(&class),
                Unknown::Slide(slide) => self.slides.contains(&slide),
            };
            let edges = (0..plan.edges.len()).filter(moves).filter_map(of_edge).collect();
            UnknownWeight { unknown, row, is_result, edges }
        });
        unknowns.filter(|weight| weight.is_result || !weight.edges.is_empty()).collect()
    }
}

impl Weighted {
    fn point(&mut self, index: usize) -> Target {
        let is_first = !std::mem::replace(&mut self.points[index], true);
        Target { index, is_first }
    }

    fn edge(&mut self, index: usize) -> Target {
        let is_first = !std::mem::replace(&mut self.edges[index], true);
        Target { index, is_first }
    }

    fn paths(&mut self, closures: &Closures) -> Vec<BackwardPath> {
        let paths = closures.paths.iter().map(|path| BackwardPath {
            plus: self.point(path.plus),
            minus: self.point(path.minus),
            edges: path.edges.iter().map(|&(edge, sign)| (self.edge(edge), sign)).collect(),
        });
        paths.collect()
    }
}

/// Leibniz' rule, transposed: see [`Backward::terms`].
fn transposed(derivatives: &DerivativeTables) -> Vec<Vec<WeightTerm>> {
    let mut terms = vec![Vec::new(); derivatives.len()];
    for (order, product) in derivatives.product.iter().enumerate() {
        for term in product {
            terms[term.right].push(WeightTerm { order, left: term.left, factor: term.factor });
        }
    }
    terms
}

fn push_new(list: &mut Vec<usize>, index: usize) {
    if !list.contains(&index) {
        list.push(index);
    }
}
