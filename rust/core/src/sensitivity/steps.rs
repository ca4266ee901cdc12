//! The steps of the solution as linear equations, and the components of results.

use crate::batch::request::Quantity;
use crate::math::derivatives::DerivativeTables;
use crate::plan::plan::{EdgeSlide, Plan, Step};
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

/// The steps as linear equations, and the numbers in their inverses.
pub(super) fn linear_steps(plan: &Plan) -> (Vec<LinearStep>, usize) {
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
pub(super) fn components(
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
