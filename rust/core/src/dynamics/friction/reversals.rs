//! Where pairs with friction reverse while the driver moves on: there the friction jumps.

use std::collections::BTreeMap;

use crate::dynamics::kinematics::SolvedPose;
use crate::dynamics::machine::Machine;
use crate::dynamics::pair_friction::Friction;
use crate::dynamics::stations::{nodes_of, within};
use crate::math::derivatives::DerivativeTables;
use crate::math::root::all_roots::{Sample, all_roots};
use crate::math::tolerance::ANALOGUE_PER_CONDITION_SQUARED;
use crate::plan::mechanism::Mechanism;
use crate::query::evaluator::{Evaluator, Queries};
use crate::state::status::Status;

/// How a pair with friction slides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Sliding {
    /// A link turns on a pin that is fast in another one.
    Turn { on: usize, fast: usize },
    /// A link moves along a guide.
    Along(usize),
}

impl Sliding {
    /// The pairs of a machine with friction.
    pub(crate) fn of(machine: &Machine, mechanism: &Mechanism) -> Vec<Self> {
        let mut pairs = Vec::new();
        for friction in &machine.friction {
            match *friction {
                Friction::Joint { joint, .. } => {
                    let mut links = mechanism.linkage().links_at(joint);
                    let Some(fast) = links.next() else { continue };
                    pairs.extend(links.map(|on| Self::Turn { on, fast }));
                }
                Friction::Slide { slide, .. } => pairs.push(Self::Along(slide)),
            }
        }
        pairs
    }

    /// First and second derivative by the only driver.
    fn rates(self, pose: &SolvedPose<'_>) -> [f64; 2] {
        [SolvedPose::first_order(0), pose.second_order(0, 0)].map(|k| match self {
            Self::Turn { on, fast } => pose.angle(on, k) - pose.angle(fast, k),
            Self::Along(slide) => pose.slide(slide, k),
        })
    }
}

impl Machine {
    /// Where the pairs of a design with one driver reverse between two coordinates, ends included, ascending;
    /// empty with several drivers.
    #[must_use]
    pub fn reversals(
        &self,
        mechanism: &Mechanism,
        dimensions: &[f64],
        range: [f64; 2],
    ) -> Vec<f64> {
        if mechanism.q0().len() != 1 || self.friction.is_empty() {
            return Vec::new();
        }
        let derivatives = DerivativeTables::new(1, 2);
        let mut evaluator =
            Evaluator::new(mechanism, dimensions, &derivatives, Queries::Any, self.needs_angles());
        reversals(&Sliding::of(self, mechanism), &mut evaluator, &derivatives, range)
    }
}

/// The places in a range where one of these pairs reverses, ascending.
pub(crate) fn reversals(
    pairs: &[Sliding],
    evaluator: &mut Evaluator<'_>,
    derivatives: &DerivativeTables,
    range: [f64; 2],
) -> Vec<f64> {
    let (nodes, unit) = (nodes_of(range, evaluator.unit(0)), evaluator.unit(0));
    let size = evaluator.position().constants.scale;
    // Every pair requests most of the positions.
    let mut solved: BTreeMap<u64, Option<Vec<Sample>>> = BTreeMap::new();
    let mut solve = |q: f64| {
        evaluator.solve(&[q]).ok()?;
        if evaluator.status() as u8 > Status::Singular as u8 {
            return None;
        }
        let condition = evaluator.total_condition();
        let pose = SolvedPose::new(evaluator.position(), derivatives);
        let sample = |&pair: &Sliding| {
            let [value, slope] = pair.rates(&pose);
            let size = if matches!(pair, Sliding::Along(_)) { size } else { 1.0 };
            let noise = ANALOGUE_PER_CONDITION_SQUARED * condition * condition * size / unit;
            Sample { x: q, value, slope, noise }
        };
        Some(pairs.iter().map(sample).collect())
    };
    let mut places = Vec::new();
    for index in 0..pairs.len() {
        let roots = all_roots(&nodes, |q: f64| {
            let samples = solved.entry(q.to_bits()).or_insert_with(|| solve(q));
            samples.as_ref().map(|samples| samples[index])
        });
        places.extend(roots.isolated.iter().map(|root| root.at));
        places.extend(roots.jumps);
        places.extend(roots.zero.into_iter().flatten());
    }
    places.retain(|&q| within(q, range, unit));
    places.sort_unstable_by(f64::total_cmp);
    places.dedup();
    places
}
