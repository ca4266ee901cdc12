//! Numbers of the papers and of textbooks.

use assur::{Coordinates, FourBar, FourBarMode, Mechanism, Motion, Outputs, Request, SliderCrank};

use crate::models::linkages::jansen;

/// Everything of one design at some positions, to order 2.
fn solve(mechanism: &Mechanism, dimensions: &[f64], q: &[f64]) -> Motion {
    let request = Request {
        dimensions,
        coordinates: Coordinates::Shared(q),
        signs: mechanism.signs(),
        order: 2,
        outputs: &Outputs::all(mechanism),
    };
    mechanism.solve(&request).expect("a class II mechanism")
}

/// The foot of Theo Jansen's leg at the crank's angle 0, computed apart from this program.
#[test]
fn jansens_foot() {
    let leg = Mechanism::new(&jansen()).expect("a mechanism");
    let motion = solve(&leg, leg.drawing(), &[0.0]);
    let foot = leg.joint("7").expect("the foot");
    let position = &motion.joints[foot].derivatives[0];
    for (value, printed) in position.iter().zip([-43.170055, -91.753226]) {
        assert!((value - printed).abs() <= 0.5e-6, "{value} {printed}");
    }
}

/// The triangle of B, C and D by the law of cosines: degrees, three decimals.
#[test]
fn four_bar_angles() {
    for (mode, printed) in
        [(FourBarMode::Open, [20.298, 57.325]), (FourBarMode::Crossed, [-60.978, -98.005])]
    {
        let four_bar = FourBar { crank: 40.0, coupler: 120.0, rocker: 80.0, ground: 100.0, mode };
        let mechanism = Mechanism::new(&FourBar::description(mode)).expect("a mechanism");
        let dimensions = four_bar.dimensions(&mechanism);
        let motion = solve(&mechanism, &dimensions, &[40.0_f64.to_radians()]);
        for (name, expected) in ["coupler", "rocker"].into_iter().zip(printed) {
            let link = mechanism.link(name).expect("a link of the four-bar");
            let angle = motion.links[link].derivatives[0][0].to_degrees();
            let apart = (angle - expected + 180.0).rem_euclid(360.0) - 180.0;
            assert!(apart.abs() <= 0.5e-3, "{mode:?} {name}: {angle} {expected}");
        }
    }
}

/// A slider-crank with offset by hand: φ2 from l1 sin φ + l2 sin φ2 = e, then
/// P1's (33)-(40), where l1 sin φ1 and l2 sin φ2 are the same with an offset.
#[test]
fn slider_crank_closed_forms() {
    const TOLERANCE: f64 = 1e-14;
    let mechanism = Mechanism::new(&SliderCrank::description()).expect("a mechanism");
    let (rod, bore) =
        (mechanism.link("rod").expect("the rod"), mechanism.slide("bore").expect("the bore"));
    let q: Vec<f64> = (-20..60).map(|k| 0.17 * f64::from(k)).collect();
    for (l2, e) in [(3.0, 0.0), (4.0, 0.0), (1.5, 0.25), (5.0, -1.2)] {
        let l1 = 1.0;
        let design = SliderCrank { crank: l1, rod: l2, offset: e };
        let motion = solve(&mechanism, &design.dimensions(&mechanism), &q);
        let (angle, stroke) = (&motion.links[rod].derivatives, &motion.slides[bore].derivatives);
        for (k, &phi) in q.iter().enumerate() {
            let (sin, cos) = phi.sin_cos();
            let across = e - l1 * sin; // l2 sin φ2
            let along = ((l2 - across) * (l2 + across)).sqrt(); // l2 cos φ2
            let first = -l1 * cos / along;
            let second = (l1 * sin + first * first * across) / along;
            let expected = [
                [across.atan2(along), first, second],
                [
                    l1 * cos + along,
                    -l1 * sin - first * across,
                    -l1 * cos - second * across - first * first * along,
                ],
            ];
            for (order, (a, s)) in angle.iter().zip(stroke).enumerate() {
                for (value, expected) in [(a[k], expected[0][order]), (s[k], expected[1][order])] {
                    let error = (value - expected).abs();
                    assert!(error <= TOLERANCE, "l2 = {l2}, e = {e}, φ = {phi}: {error:e}");
                }
            }
        }
    }
}
