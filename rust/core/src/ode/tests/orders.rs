//! Orders of convergence, measured with fixed steps.

use super::*;
use crate::ode::options::Method;
use crate::ode::pair::dense::Interpolant;
use crate::ode::pair::stages::{Block, Scale, Stages};

/// Nonlinear, coupled, dependent on t: tan t and e^t / cos t.
fn rates(t: f64, y: &[f64], rates: &mut [f64]) {
    rates[0] = 1.0 + y[0] * t.tan();
    rates[1] = y[1] * (1.0 + y[0]);
}

fn exact(t: f64) -> [f64; 2] {
    [t.tan(), t.exp() / t.cos()]
}

fn block(y: [f64; 2]) -> Vec<Block> {
    vec![[y[0], y[1], 0.0, 0.0]]
}

/// Error at t = 1 after `count` equal steps from t = 0.
fn global_error(method: Method, count: u32) -> f64 {
    let mut stages = Stages::new(method.tableau(), 2);
    let mut system = smooth(rates);
    let h = 1.0 / f64::from(count);
    let (mut y, mut new) = (block(exact(0.0)), block([0.0; 2]));
    for i in 0..count {
        let t = f64::from(i) * h;
        stages.evaluate(&mut system, 0, t, &y).unwrap();
        stages.advance(&mut system, t, &y, h, &mut new).unwrap();
        std::mem::swap(&mut y, &mut new);
    }
    largest_difference(&y[0], &exact(1.0))
}

/// Errors of one step on a circular orbit: of the new state, its estimate, and the largest inside.
fn local_errors(method: Method, h: f64) -> [f64; 3] {
    let n = 4;
    let exact = |t: f64| [t.cos(), t.sin(), -t.sin(), t.cos()];
    let mut stages = Stages::new(method.tableau(), n);
    let mut system = smooth(kepler);
    let (y, mut new) = (vec![exact(0.4)], vec![[0.0; 4]]);
    stages.evaluate(&mut system, 0, 0.0, &y).unwrap();
    stages.advance(&mut system, 0.0, &y, h, &mut new).unwrap();
    stages.evaluate(&mut system, method.tableau().stages, h, &new).unwrap();
    stages.extend(&mut system, 0.0, &y, h).unwrap();
    let estimate = stages.error(&Scale::new(&[0.0], &[1.0], n), &y, &new, h);
    let mut output = Interpolant::new(&stages, n);
    output.set(&stages, &y, &new, h);
    let inside = (1..32)
        .map(|i| f64::from(i) / 32.0)
        .map(|theta| {
            let mut at = [0.0; 4];
            output.at(theta, &mut at);
            largest_difference(&at, &exact(0.4 + theta * h))
        })
        .fold(0.0, f64::max);
    [largest_difference(&new[0], &exact(0.4 + h)), estimate, inside]
}

fn measured_order(coarse: f64, fine: f64, ratio: f64) -> f64 {
    (coarse / fine).log2() / ratio.log2()
}

#[test]
fn new_states_converge_with_their_order() {
    for (method, counts, order) in [(BOTH[0], [120, 240], 5.0), (BOTH[1], [10, 20], 8.0)] {
        let [coarse, fine] = counts.map(|count| global_error(method, count));
        let measured = measured_order(coarse, fine, 2.0);
        println!("{method:?}: {coarse:.2e} {fine:.2e}, order {measured:.2}");
        assert!((measured - order).abs() < 0.4, "{method:?}: {measured}");
    }
}

/// The error of one step of width h has one power more than the order.
#[test]
fn estimates_and_continuous_output_converge_with_their_order() {
    // Estimates: of order 4, and e₅²/√(e₅² + 0.01e₃²), which is about e₅ times e₅/e₃: order 6 + 2 −
    // 1.
    for (method, widths, powers) in
        [(BOTH[0], [0.05, 0.025], [6.0, 5.0, 5.0]), (BOTH[1], [0.4, 0.2], [9.0, 8.0, 8.0])]
    {
        let [coarse, fine] = widths.map(|h| local_errors(method, h));
        for ((c, f), power) in coarse.iter().zip(fine).zip(powers) {
            let measured = measured_order(*c, f, 2.0);
            println!("{method:?}: {c:.2e} {f:.2e}, power {measured:.2} of {power}");
            assert!((measured - power).abs() < 0.6, "{method:?}: {measured} is not {power}");
        }
    }
}
