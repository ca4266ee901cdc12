//! Derivatives of the objective against differences of its values, and what a fit finds.

use std::f64::consts::TAU;
use std::sync::atomic::AtomicBool;

use super::conditions::FitCondition;
use super::fit::Fit;
use super::multipliers::Multipliers;
use super::point::Point;
use super::problem::{Compiled, FitRequest, TRAVEL_POSITIONS, Travel};
use super::target::{FitTarget, Freedom, TargetNumber, Timing};
use super::variables::Variable;
use crate::batch::request::{Coordinates, Outputs, Quantity, Request};
use crate::description::Description;
use crate::math::simd::Simd;
use crate::plan::mechanism::Mechanism;

fn four_bar() -> Mechanism {
    let description = Description::new()
        .joint("A", [0.0, 0.0])
        .joint("B", [0.6, 0.8])
        .joint("C", [3.2, 2.3])
        .joint("D", [3.0, 0.1])
        .joint("P", [1.5, 2.6])
        .link("ground", ["A", "D"])
        .link("crank", ["A", "B"])
        .link("coupler", ["B", "C", "P"])
        .link("rocker", ["D", "C"])
        .driver("crank");
    Mechanism::new(&description).expect("a four-bar")
}

fn number(quantity: Quantity, axis: usize, wanted: Vec<f64>, is_angle: bool) -> TargetNumber {
    TargetNumber { quantity, axis, weight: 1.3, wanted, is_angle }
}

fn request(
    mechanism: &Mechanism,
    targets: Vec<FitTarget>,
    conditions: Vec<FitCondition>,
) -> FitRequest {
    let variable = |index| Variable { moves: vec![(index, 1.0)], bounds: [-20.0, 20.0] };
    FitRequest {
        base: vec![0.0; mechanism.dimensions().len()],
        variables: (0..mechanism.dimensions().len()).map(variable).collect(),
        targets,
        conditions,
        assemblies: vec![mechanism.signs().to_vec()],
        travel: Travel::WholeTurn,
        seed: 0,
        threads: None,
        simd: Simd::default(),
    }
}

/// A point near the drawing, with every number that targets have.
fn point(compiled: &Compiled, mechanism: &Mechanism, q: Vec<f64>) -> Point {
    let mut x = mechanism.drawing().to_vec();
    for (index, x) in x.iter_mut().enumerate() {
        *x += 0.01 * (index as f64 + 1.0);
    }
    x.extend(compiled.targets.iter().flat_map(FitTarget::neutral));
    let count = x.len();
    x[count - 1] += 0.07;
    Point { x, q, multipliers: Multipliers::new(0, 1.0), ..Point::default() }
}

fn value(compiled: &Compiled, mechanism: &Mechanism, point: &mut Point) -> f64 {
    let problem = compiled.of(mechanism);
    let never = AtomicBool::new(false);
    let travel = (0, TRAVEL_POSITIONS);
    problem.evaluate(&mut [point], travel, &never).expect("no error");
    point.value
}

/// The gradient of a point beside central differences of its value.
fn assert_gradient(compiled: &Compiled, mechanism: &Mechanism, point: &Point) {
    let mut at = point.clone();
    let size = value(compiled, mechanism, &mut at);
    assert!(size.is_finite() && size > 0.0);
    for index in 0..at.x.len() {
        let step = 1e-6;
        let [low, high] = [-step, step].map(|step| {
            let mut moved = point.clone();
            moved.x[index] += step;
            value(compiled, mechanism, &mut moved)
        });
        let slope = (high - low) / (2.0 * step);
        let off = (slope - at.normal.g[index]).abs();
        assert!(off < 1e-7 * (1.0 + slope.abs()), "{index}: {} {slope}", at.normal.g[index]);
    }
}

#[test]
fn gradients_are_those_of_the_value() {
    let mechanism = four_bar();
    let p = Quantity::Joint(mechanism.joint("P").expect("a joint"));
    let rocker = Quantity::Angle(mechanism.link("rocker").expect("a link"));
    let coupler = mechanism.link("coupler").expect("a link");
    let q = vec![0.3, 0.9, 1.7, 2.5];
    let (x, y) = (vec![1.0, 1.2, 0.9, 0.4], vec![2.0, 2.4, 2.2, 1.9]);
    let path = |freedom, timing| FitTarget {
        numbers: vec![number(p, 0, x.clone(), false), number(p, 1, y.clone(), false)],
        weights: vec![1.0, 0.5, 2.0, 1.0],
        timing,
        freedom,
    };
    let function = |freedom| FitTarget {
        numbers: vec![number(rocker, 0, vec![1.5, 1.6, 8.0, 2.0], true)],
        weights: vec![1.0; 4],
        timing: Timing::Phase(q.clone()),
        freedom,
    };
    let poses = FitTarget {
        numbers: vec![
            number(Quantity::Origin(coupler), 0, x.clone(), false),
            number(Quantity::Origin(coupler), 1, y.clone(), false),
            number(Quantity::Angle(coupler), 0, vec![0.1, 0.2, 0.4, 0.3], true),
        ],
        weights: vec![1.0; 4],
        timing: Timing::Fixed(q.clone()),
        freedom: Freedom::Turned,
    };
    let line = Freedom::Line { scale: true, offset: true };
    let all = [
        vec![path(Freedom::None, Timing::Fixed(q.clone()))],
        vec![path(Freedom::Place, Timing::Phase(q.clone()))],
        vec![path(Freedom::Similarity, Timing::Fixed(q.clone())), function(line)],
        vec![function(Freedom::Line { scale: false, offset: true }), poses],
    ];
    for targets in all {
        let count = 4 * targets.len();
        let compiled = Compiled::new(request(&mechanism, targets, vec![]));
        let point = point(&compiled, &mechanism, vec![0.0; count]);
        assert_gradient(&compiled, &mechanism, &point);
    }
}

#[test]
fn free_coordinates_go_to_the_nearest_places() {
    let mechanism = four_bar();
    let p = Quantity::Joint(mechanism.joint("P").expect("a joint"));
    let target = FitTarget {
        numbers: vec![number(p, 0, vec![1.4, 1.0], false), number(p, 1, vec![2.4, 2.1], false)],
        weights: vec![1.0; 2],
        timing: Timing::Free { is_ordered: true, is_closed: false },
        freedom: Freedom::None,
    };
    let compiled = Compiled::new(request(&mechanism, vec![target], vec![]));
    let mut at = point(&compiled, &mechanism, vec![1.0, 2.0]);
    for _ in 0..300 {
        value(&compiled, &mechanism, &mut at);
        let width = 1 + at.x.len();
        for k in 0..2 {
            at.q[k] += at.normal.follow[k * width];
        }
    }
    let nearest = value(&compiled, &mechanism, &mut at);
    for k in 0..2 {
        for step in [-0.01, 0.01] {
            let mut moved = at.clone();
            moved.q[k] += step;
            assert!(value(&compiled, &mechanism, &mut moved) > nearest);
        }
    }
    // There the gradient is that of the least value (the envelope theorem).
    assert_gradient(&compiled, &mechanism, &at);
}

#[test]
fn a_fit_finds_the_mechanism_that_drew_the_curve() {
    let mechanism = four_bar();
    let joint = mechanism.joint("P").expect("a joint");
    let q: Vec<f64> = (0..24).map(|k| TAU * f64::from(k) / 24.0).collect();
    let drawn = mechanism.solve(&Request {
        dimensions: mechanism.drawing(),
        coordinates: Coordinates::Shared(&q),
        signs: mechanism.signs(),
        order: 0,
        outputs: &Outputs { joints: vec![joint], ..Outputs::default() },
    });
    let drawn = drawn.expect("a motion").joints[0].derivatives[0].clone();
    let axis = |axis: usize| drawn.iter().skip(axis).step_by(2).copied().collect::<Vec<f64>>();
    let target = FitTarget {
        numbers: [0, 1].map(|k| number(Quantity::Joint(joint), k, axis(k), false)).to_vec(),
        weights: vec![1.0; 24],
        timing: Timing::Free { is_ordered: true, is_closed: true },
        freedom: Freedom::None,
    };
    let mut wanted = request(&mechanism, vec![target], vec![]);
    wanted.assemblies = vec![vec![1], vec![-1]];
    let mut fit = Fit::new(wanted);
    let never = AtomicBool::new(false);
    while fit.best() > 1e-16 {
        assert!(fit.evaluations() < 200_000, "{}", fit.best());
        fit.round(&mechanism, &never).expect("no error");
    }
}
