//! What derivatives by dimensions read and where they go, compiled once for all positions of a call.

use std::sync::Arc;

use super::backward::Backward;
use super::steps::{Component, LinearStep, components, linear_steps};
use crate::batch::request::{Column, Outputs, Quantity};
use crate::description::error::SolveError;
use crate::math::derivatives::DerivativeTables;
use crate::plan::mechanism::Mechanism;
use crate::plan::plan::{Plan, Step};
use crate::query::failure::redundant_name;

/// Number `entry` of `width` in a column of the solved motion.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Source {
    pub column: usize,
    pub width: usize,
    pub entry: usize,
}

/// The compiled derivatives.
#[derive(Debug)]
pub(crate) struct SensitivityPlan<'m> {
    pub mechanism: &'m Mechanism,
    pub steps: Vec<LinearStep>,
    /// Numbers in the inverses of all steps.
    pub inverses: usize,
    /// Edges, orientations and slides that the steps read.
    pub edges: Vec<usize>,
    pub orientations: Vec<usize>,
    pub read_slides: Vec<usize>,
    /// For every orientation but the ground's a link that has it.
    pub links: Vec<Option<usize>>,
    /// For every orientation the column of that link's direction.
    pub directions: Vec<usize>,
    /// For every orientation the derivatives of its angle, jet by jet; the first is not used.
    pub rates: Vec<Source>,
    /// For every slide the jet of its value.
    pub slides: Vec<Source>,
    /// For every result its components, and the column with their values, if weights count times these.
    pub results: Vec<Vec<Component>>,
    pub values: Vec<usize>,
    /// The steps in reverse.
    pub(super) backward: Backward,
    pub derivatives: Arc<DerivativeTables>,
    pub order: usize,
    pub outputs: Outputs,
}

impl<'m> SensitivityPlan<'m> {
    /// Refuses redundant links: changing one dimension alone would break their fit.
    pub(crate) fn refuse_redundant(mechanism: &Mechanism) -> Result<(), SolveError> {
        let steps = &mechanism.plan().steps;
        match steps.iter().position(|step| matches!(step, Step::Redundant(_))) {
            Some(step) => {
                let (kind, name) = redundant_name(mechanism, step);
                Err(SolveError::Redundant { kind, name })
            }
            None => Ok(()),
        }
    }

    /// Compiles the derivatives of these results.
    pub(crate) fn new(mechanism: &'m Mechanism, of: &[(Quantity, usize)]) -> Self {
        let plan = mechanism.plan();
        let order = of.iter().map(|&(_, order)| order).max().unwrap_or(0);
        let derivatives = DerivativeTables::shared(plan.drivers.len(), order);
        let links: Vec<Option<usize>> = (0..plan.orientations.len())
            .map(|o| plan.link_orientation.iter().position(|&of_link| of_link == o))
            .map(|link| link.filter(|&link| link != plan.ground))
            .collect();
        let with_links: Vec<usize> = links.iter().copied().flatten().collect();
        let outputs = Outputs {
            directions: with_links.clone(),
            rates: with_links,
            slides: (0..plan.slide_links.len()).collect(),
            ..Outputs::default()
        };
        let (steps, inverses) = linear_steps(plan);
        let results = of
            .iter()
            .map(|&(quantity, order)| components(plan, &derivatives, quantity, order))
            .collect();
        Self {
            mechanism,
            steps,
            inverses,
            edges: (0..plan.edges.len()).collect(),
            orientations: (0..links.len()).collect(),
            read_slides: (0..plan.slide_links.len()).collect(),
            links,
            directions: Vec::new(),
            rates: Vec::new(),
            slides: Vec::new(),
            results,
            values: Vec::new(),
            backward: Backward::default(),
            derivatives,
            order,
            outputs,
        }
    }

    /// The same, restricted to what the results depend on.
    pub(super) fn restricted(mechanism: &'m Mechanism, of: &[(Quantity, usize)]) -> Self {
        let mut plan = Self::new(mechanism, of);
        plan.restrict_to_results();
        plan
    }

    /// The same with the steps in reverse; `of_squares`: weights count
    /// times the results, which are solved, too.
    pub(crate) fn backward(
        mechanism: &'m Mechanism,
        of: &[(Quantity, usize)],
        of_squares: bool,
    ) -> Self {
        let mut plan = Self::restricted(mechanism, of);
        plan.backward = Backward::new(mechanism, &plan.steps, &plan.results, &plan.derivatives);
        if of_squares {
            plan.add_values(of);
        }
        plan
    }

    /// Lets the results themselves be solved: for weights that count times these.
    fn add_values(&mut self, of: &[(Quantity, usize)]) {
        for &(quantity, _) in of {
            let (list, index) = match quantity {
                Quantity::Joint(index) => (&mut self.outputs.joints, index),
                Quantity::Slide(index) => (&mut self.outputs.slides, index),
                Quantity::Angle(index) => (&mut self.outputs.links, index),
                Quantity::Origin(index) => (&mut self.outputs.origins, index),
                Quantity::Direction(_) => continue,
            };
            if !list.contains(&index) {
                list.push(index);
            }
        }
    }

    /// Finds the values of results in the columns of the request.
    pub(crate) fn read_values(&mut self, of: &[(Quantity, usize)], columns: &[Column]) {
        let at = |&(quantity, order): &(Quantity, usize)| {
            columns.iter().position(|c| c.quantity == quantity && c.order == order).unwrap_or(0)
        };
        self.values = of.iter().map(at).collect();
    }

    /// Finds the sources in the columns of the request.
    pub(crate) fn read_from(&mut self, columns: &[Column]) {
        let at = |quantity: Quantity, order: usize| {
            columns.iter().position(|c| c.quantity == quantity && c.order == order).unwrap_or(0)
        };
        // Of equal entries of a symmetric tensor, the first.
        let tensors: Vec<Vec<usize>> =
            (0..=self.order).map(|order| self.derivatives.tensor(order)).collect();
        let jet = |quantity: Quantity| {
            let source = |k: usize| {
                let order = self.derivatives.powers[k].iter().sum::<usize>();
                let entry = tensors[order].iter().position(|&entry| entry == k).unwrap_or(0);
                Source { column: at(quantity, order), width: tensors[order].len(), entry }
            };
            (0..self.derivatives.len()).map(source).collect::<Vec<_>>()
        };
        let quantity = |link: &Option<usize>| link.map(Quantity::Angle);
        let rates = self.links.iter().flat_map(|link| {
            quantity(link).map_or(vec![Source::default(); self.derivatives.len()], jet)
        });
        let direction = |link: &Option<usize>| link.map_or(0, |l| at(Quantity::Direction(l), 0));
        let slides = (0..self.mechanism.plan().slide_links.len()).map(Quantity::Slide);
        (self.rates, self.directions, self.slides) = (
            rates.collect(),
            self.links.iter().map(direction).collect(),
            slides.flat_map(jet).collect(),
        );
    }

    pub(crate) fn plan(&self) -> &'m Plan {
        self.mechanism.plan()
    }

    /// Entries of a jet.
    pub(crate) fn len(&self) -> usize {
        self.derivatives.len()
    }
}
