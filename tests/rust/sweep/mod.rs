//! Metrics of sweeps, as Rust users write and combine them.

use std::f64::consts::{PI, TAU};

use assur::sweep::{
    Combination, Condition, Coordinate, Deviation, Extreme, Gradients, Growth, LeastTransmission,
    Line, Mean, Metric, Moves, Need, Operand, Operation, Part, PlaceOf, Positions, Relation,
    RootMeanSquare, Shape, Span, Sweep, TimeRatio,
};
use assur::{Checks, Control, Mechanism, Quantity, Simd, SliderCrank, SolveError};

use crate::models::linkages;

fn turn(count: u32) -> Vec<f64> {
    (0..count).map(|k| f64::from(k) * TAU / f64::from(count)).collect()
}

fn measured(mechanism: &Mechanism, q: &[f64], metrics: &[&dyn Metric]) -> Vec<f64> {
    let sweep = Sweep { metrics, ..Sweep::of(mechanism, mechanism.drawing(), q) };
    let found = mechanism.measure(&sweep, &Control::default()).unwrap();
    assert_eq!(found.kept, [true]);
    found.values.into_iter().map(|values| values[0]).collect()
}

/// The length of a joint's path, closed if the motion returns; and a count of what it is asked.
struct PathLength(usize);

impl Metric for PathLength {
    fn needs(&self) -> Vec<Need> {
        vec![Need { quantity: Quantity::Joint(self.0), order: 0 }]
    }

    fn of(&self, positions: &Positions<'_>) -> f64 {
        let points = positions.values[0].as_chunks::<2>().0;
        assert_eq!(points.len(), positions.count());
        let between = |[a, b]: [[f64; 2]; 2]| (b[0] - a[0]).hypot(b[1] - a[1]);
        let open: f64 = points.windows(2).map(|pair| between([pair[0], pair[1]])).sum();
        open + if positions.returns { between([points[points.len() - 1], points[0]]) } else { 0.0 }
    }

    fn growth(&self) -> Growth {
        Growth::Rises
    }

    fn asks_return(&self) -> bool {
        true
    }
}

#[test]
fn a_metric_of_ones_own() {
    let mechanism = Mechanism::new(&linkages::crank_rocker()).unwrap();
    let crank_pin = PathLength(mechanism.joint("B").unwrap());
    let q = turn(360);
    let length = mechanism.drawing()[mechanism.dimensions().position("crank.length").unwrap()];
    let chord = 2.0 * length * (PI / 360.0).sin();
    let [whole] = measured(&mechanism, &q, &[&crank_pin])[..] else { panic!() };
    assert!((whole - 360.0 * chord).abs() < 1e-12);
    // Of half a turn there is no way back.
    let [half] = measured(&mechanism, &q[..181], &[&crank_pin])[..] else { panic!() };
    assert!((half - 180.0 * chord).abs() < 1e-12);
    // As a condition it drops at the first positions what is too long by them.
    let conditions = [Condition { metric: 0, relation: Relation::Less, limit: 1e-3 }];
    let sweep = Sweep {
        metrics: &[&crank_pin],
        conditions: &conditions,
        ..Sweep::of(&mechanism, mechanism.drawing(), &q)
    };
    let found = mechanism.measure(&sweep, &Control::default()).unwrap();
    assert_eq!(found.kept, [false]);
    assert!(found.values[0][0].is_nan());
}

/// Of a slider-crank with a = 1, b = 3 the piston is at x = a cos q + √(b² − a² sin² q).
#[test]
fn gradients_of_means() {
    let mechanism = Mechanism::new(&SliderCrank::description()).unwrap();
    let index = |name| mechanism.dimensions().position(name).expect("a dimension");
    let [crank, rod] = ["crank.length", "rod.length"].map(index);
    let mut dimensions = mechanism.drawing().to_vec();
    (dimensions[crank], dimensions[rod]) = (1.0, 3.0);
    let pin = Coordinate::joint(mechanism.joint("B").unwrap(), 0);
    let (mean, root) = (Mean(pin), RootMeanSquare(pin));
    let q = turn(100);
    // In another order than the metrics, by the rod first.
    let gradients = Gradients { of: &[1, 0], by: &[rod, crank] };
    let sweep =
        Sweep { metrics: &[&mean, &root], gradients, ..Sweep::of(&mechanism, &dimensions, &q) };
    let found = mechanism.measure(&sweep, &Control::default()).unwrap();
    let terms = q.iter().map(|q| {
        let (sin, cos) = q.sin_cos();
        let along = (9.0 - sin * sin).sqrt();
        (cos + along, [3.0 / along, cos - sin * sin / along])
    });
    let terms: Vec<(f64, [f64; 2])> = terms.collect();
    let average =
        |numbers: &mut dyn Iterator<Item = f64>| numbers.sum::<f64>() / terms.len() as f64;
    let root = average(&mut terms.iter().map(|(x, _)| x * x)).sqrt();
    for at in 0..2 {
        let of_mean = average(&mut terms.iter().map(|(_, slopes)| slopes[at]));
        let of_root = average(&mut terms.iter().map(|(x, slopes)| x * slopes[at])) / root;
        assert!((found.gradients[1][at] - of_mean).abs() < 1e-13);
        assert!((found.gradients[0][at] - of_root).abs() < 1e-13);
    }
    assert!((found.values[1][0] - root).abs() < 1e-13);
}

/// Gradients of metrics that one position decides, and of what is made of them, beside central differences.
fn assert_gradients(mechanism: &Mechanism, metrics: &[&dyn Metric]) {
    // Not the same on both sides of a dead point: there two positions would decide.
    let q: Vec<f64> = turn(89).iter().map(|q| q + 0.013).collect();
    let drawing = mechanism.drawing();
    let by: Vec<usize> = (0..drawing.len()).collect();
    let of: Vec<usize> = (0..metrics.len()).collect();
    let measure = |dimensions: &[f64]| {
        let gradients = Gradients { of: &of, by: &by };
        let sweep = Sweep { metrics, gradients, ..Sweep::of(mechanism, dimensions, &q) };
        let found = mechanism.measure(&sweep, &Control::default()).unwrap();
        assert_eq!(found.kept, [true]);
        found
    };
    let found = measure(drawing);
    for index in by.iter().copied() {
        let step = 1e-6;
        let [low, high] = [-step, step].map(|step| {
            let mut moved = drawing.to_vec();
            moved[index] += step;
            measure(&moved).values
        });
        for (metric, gradient) in found.gradients.iter().enumerate() {
            let slope = (high[metric][0] - low[metric][0]) / (2.0 * step);
            let off = (gradient[index] - slope).abs();
            assert!(
                off < 1e-7 * (1.0 + slope.abs()),
                "{metric} {index}: {} {slope}",
                gradient[index]
            );
        }
    }
}

#[test]
fn gradients_of_what_one_position_decides() {
    let four_bar = Mechanism::new(&linkages::crank_rocker()).unwrap();
    let joint = |name| four_bar.joint(name).unwrap();
    let lines = [Line::Joints([joint("B"), joint("C")]), Line::Joints([joint("D"), joint("C")])];
    let angle = LeastTransmission { lines, complement: false };
    let (c, rocker) = (joint("C"), Coordinate::link(four_bar.link("rocker").unwrap()));
    let height = Extreme::Greatest(Coordinate::joint(c, 1));
    let quick = Extreme::Least(rocker.derivative(1));
    let over = |metric| Part { metric, from: 1.0, to: 4.0, period: Some(TAU) };
    let boxed = |metric: Span| Operand::Metric(Box::new(metric));
    let quotient = Combination {
        operation: Operation::Divide,
        left: boxed(Span(Coordinate::joint(c, 0))),
        right: boxed(Span(rocker)),
    };
    let part = over(Span(Coordinate::joint(c, 1)));
    assert_gradients(&four_bar, &[&angle, &height, &quick, &part, &quotient]);

    // The guide's own angle is a dimension.
    let engine = Mechanism::new(&SliderCrank::description()).unwrap();
    let guide = engine.dimensions().position("bore.angle").unwrap();
    let ground = engine.link("ground").unwrap();
    let rod = Line::Joints(["A", "B"].map(|name| engine.joint(name).unwrap()));
    let lines = [rod, Line::Guide(ground, Some(guide))];
    let pressure = LeastTransmission { lines, complement: true };
    let negative = Combination {
        operation: Operation::Multiply,
        left: Operand::Number(-2.0),
        right: Operand::Metric(Box::new(pressure)),
    };
    assert_gradients(&engine, &[&pressure, &negative]);
}

#[test]
fn gradients_that_are_refused() {
    let mechanism = Mechanism::new(&SliderCrank::description()).unwrap();
    let bore = Coordinate::slide(mechanism.slide("bore").unwrap());
    let mean = Mean(bore);
    let q = turn(9);
    let refusal = |of: &[usize], by: &[usize]| {
        let sweep = Sweep {
            metrics: &[&mean, &Moves],
            gradients: Gradients { of, by },
            ..Sweep::of(&mechanism, mechanism.drawing(), &q)
        };
        mechanism.measure(&sweep, &Control::default()).unwrap_err().to_string()
    };
    assert!(refusal(&[1], &[0]).contains("metric 1 has no gradient"), "{}", refusal(&[1], &[0]));
    assert!(refusal(&[2], &[0]).contains("metric 2 has no gradient"));
    assert!(refusal(&[0], &[99]).contains("dimension 99"));
}

#[test]
fn combinations_are_sums_of_their_metrics() {
    let mechanism = Mechanism::new(&SliderCrank::description()).unwrap();
    let bore = Coordinate::slide(mechanism.slide("bore").unwrap());
    let boxed = |metric: Span| Operand::Metric(Box::new(metric));
    let sum = |operation, left, right| Combination { operation, left, right };
    let twice = sum(Operation::Multiply, Operand::Number(2.0), boxed(Span(bore)));
    let speed = Span(bore.derivative(1));
    let weighted = sum(Operation::Add, Operand::Metric(Box::new(twice)), boxed(speed));
    assert_eq!(weighted.growth(), Growth::Rises);
    let values = measured(&mechanism, &turn(72), &[&Span(bore), &speed, &weighted]);
    assert_eq!(values[2].to_bits(), (2.0 * values[0] + values[1]).to_bits());
    let growth = |operation, left, right| sum(operation, left, right).growth();
    let (number, span) = (Operand::Number, || boxed(Span(bore)));
    assert_eq!(growth(Operation::Multiply, span(), number(-1.0)), Growth::Falls);
    assert_eq!(growth(Operation::Subtract, number(1.0), span()), Growth::Falls);
    assert_eq!(growth(Operation::Subtract, span(), number(1.0)), Growth::Rises);
    assert_eq!(growth(Operation::Divide, span(), number(-2.0)), Growth::Falls);
    assert_eq!(growth(Operation::Divide, number(1.0), span()), Growth::Either);
    assert_eq!(growth(Operation::Subtract, span(), span()), Growth::Either);
    assert_eq!(growth(Operation::Multiply, span(), span()), Growth::Either);
    let least = Operand::Metric(Box::new(Extreme::Least(bore)));
    assert_eq!(growth(Operation::Subtract, span(), least), Growth::Rises);
    // A design that does not move has what the sum of those numbers is.
    let moves = Operand::Metric(Box::new(Moves));
    assert_eq!(
        sum(Operation::Subtract, moves, number(3.0)).of_failed().to_bits(),
        (-3.0_f64).to_bits()
    );
}

#[test]
fn several_drivers_are_solved_or_refused() {
    let mechanism = Mechanism::new(&linkages::five_bar(&["left", "right"])).unwrap();
    let q0 = mechanism.q0();
    let q: Vec<f64> =
        (0..40).flat_map(|k| q0.iter().map(move |q| q + 0.01 * f64::from(k))).collect();
    let [arm, far] = ["l2", "l3"].map(|name| mechanism.link(name).unwrap());
    let joint = mechanism.joint("C").unwrap();
    let lines = [Line::Guide(arm, None), Line::Guide(far, None)];
    let transmission = LeastTransmission { lines, complement: false };
    let span = Span(Coordinate::joint(joint, 0));
    let path = Deviation { joint, shape: Shape::Line, part: 0.5, is_relative: false };
    let values = measured(&mechanism, &q, &[&transmission, &span, &path]);
    assert!(values.iter().all(|value| value.is_finite()));
    let angle = Coordinate::link(arm);
    let refused: [&dyn Metric; 4] = [
        &PlaceOf(Extreme::Least(angle)),
        &TimeRatio(angle),
        &Span(angle.derivative(1)),
        &Part { metric: span, from: 0.0, to: 1.0, period: None },
    ];
    for metric in refused {
        let sweep = Sweep { metrics: &[metric], ..Sweep::of(&mechanism, mechanism.drawing(), &q) };
        match mechanism.measure(&sweep, &Control::default()) {
            Err(SolveError::Shape(why)) => assert!(why.contains("one driver, here are 2"), "{why}"),
            other => panic!("{other:?}"),
        }
    }
}

/// Designs of many lengths, some of which do not turn, one that has a change point.
#[test]
fn values_do_not_depend_on_the_way() {
    let mechanism = Mechanism::new(&linkages::crank_rocker()).unwrap();
    let rocker = mechanism.dimensions().position("rocker.length").unwrap();
    let count = 50;
    let mut dimensions: Vec<f64> =
        mechanism.drawing().iter().flat_map(|&value| vec![value; count]).collect();
    for (k, length) in dimensions[rocker * count..][..count].iter_mut().enumerate() {
        *length *= 0.3 + 0.03 * k as f64;
    }
    let q = turn(48);
    let joint = mechanism.joint("C").unwrap();
    let path = Deviation { joint, shape: Shape::Circle, part: 0.4, is_relative: true };
    let ratio = TimeRatio(Coordinate::joint(joint, 0));
    let jerk = Extreme::Greatest(Coordinate::joint(joint, 1).derivative(3));
    let metrics: [&dyn Metric; 3] = [&path, &ratio, &jerk];
    let sweep = Sweep { metrics: &metrics, ..Sweep::of(&mechanism, &dimensions, &q) };
    let bits = |control: &Control<'_>| {
        let found = mechanism.measure(&sweep, control).unwrap();
        let bits = |values: &Vec<f64>| values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
        (found.values.iter().map(bits).collect::<Vec<_>>(), found.status, found.kept)
    };
    let expected = bits(&Control::default());
    assert!(expected.2.contains(&true) && expected.2.contains(&false));
    for checks in [Checks::Needed, Checks::Always, Checks::KnotByKnot] {
        for simd in [Simd::Baseline, Simd::Avx2, Simd::Avx512] {
            for threads in [1, 3] {
                let threads = std::num::NonZeroUsize::new(threads);
                let found = bits(&Control { checks, simd, threads, ..Control::default() });
                assert!(found == expected, "{checks:?} {simd:?}");
            }
        }
    }
}
