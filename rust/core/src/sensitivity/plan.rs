//! What derivatives by dimensions read and where they go, compiled once for all positions of a call.

use std::sync::Arc;

use crate::batch::request::{Column, Outputs, Quantity};
use crate::description::error::SolveError;
use crate::math::derivatives::DerivativeTables;
use crate::plan::mechanism::Mechanism;
use crate::plan::plan::{EdgeSlide, Plan, Step};
use crate::query::failure::redundant_name;
use crate::state::closures::{Closures, signed};
use crate::structure::closure::point_of_joint;

/// A step of the solution, as linear equations.
#[derive(Debug)]
pub(crate) enum LinearStep {
    /// A point is placed from another, along an edge with this sign.
    Place { edge: usize, from: usize, to: usize, sign: f64 },
    /// Closures are solved; the inverse of their matrix begins at this place.
    Solve { closures: Closures, inverse: usize },
}

/// A number of each row of a result: where it comes from.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Component {
    pub kind: ComponentKind,
    /// Entry of the jet.
    pub k: usize,
}

/// The source of a number of a result.
#[derive(Debug, Clone, Copy)]
pub(crate) enum ComponentKind {
    X { point: usize },
    Y { point: usize },
    Slide(usize),
    Angle { link: usize, class: usize },
}

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
    /// For every orientation but the ground's a link that has it.
    pub links: Vec<Option<usize>>,
    /// For every orientation the column of that link's direction.
    pub directions: Vec<usize>,
    /// For every orientation the derivatives of its angle, jet by jet; the first is not used.
    pub rates: Vec<Source>,
    /// For every slide the jet of its value.
    pub slides: Vec<Source>,
    /// For every result its components.
    pub results: Vec<Vec<Component>>,
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
            links,
            directions: Vec::new(),
            rates: Vec::new(),
            slides: Vec::new(),
            results,
            derivatives,
            order,
            outputs,
        }
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

/// The steps as linear equations, and the numbers in their inverses.
fn linear_steps(plan: &Plan) -> (Vec<LinearStep>, usize) {
    let mut inverses = 0;
    let mut linear = Vec::new();
    for step in &plan.steps {
        if let &Step::Place { edge, backward } = step {
            let [from, to] = plan.edges[edge].ends(backward);
            linear.push(LinearStep::Place { edge, from, to, sign: signed(backward) });
        } else if let Some(closures) = Closures::of_step(step) {
            let n = closures.unknowns.len();
            linear.push(LinearStep::Solve { closures, inverse: inverses });
            inverses += n * n;
        }
    }
    (linear, inverses)
}

/// The components of a result, in the order of its array.
fn components(
    plan: &Plan,
    derivatives: &DerivativeTables,
    quantity: Quantity,
    order: usize,
) -> Vec<Component> {
    let tensor = derivatives.tensor(order);
    let entries = |kind: ComponentKind| {
        tensor.iter().map(move |&k| Component { kind, k }).collect::<Vec<_>>()
    };
    let point = |point: usize| {
        [entries(ComponentKind::X { point }), entries(ComponentKind::Y { point })].concat()
    };
    match quantity {
        Quantity::Joint(joint) => point(point_of_joint(joint)),
        Quantity::Origin(link) => point(plan.reference[link]),
        Quantity::Slide(slide) => entries(ComponentKind::Slide(slide)),
        Quantity::Angle(link) | Quantity::Direction(link) => {
            entries(ComponentKind::Angle { link, class: plan.rotation[link].class })
        }
    }
}

/// The slide along an edge, whoever finds its value.
pub(crate) fn slide_along(along: EdgeSlide) -> Option<usize> {
    match along {
        EdgeSlide::Nothing => None,
        EdgeSlide::Slide(slide) | EdgeSlide::Driver { slide } => Some(slide),
    }
}
