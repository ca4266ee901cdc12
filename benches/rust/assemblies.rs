//! All assemblies of a position, and limits of many designs.

use std::hint::black_box;

use assur::{Description, LimitsFinder, Mechanism, Tables};
use criterion::{BenchmarkId, Criterion, Throughput};

use crate::mechanisms;

/// Designs whose limits are found in one iteration.
const DESIGNS: u64 = 1000;

/// A plate on three legs, one of them on the crank; its six assemblies are real.
fn triad() -> Mechanism {
    let description = Description::new()
        .joint("O", [0.45, 2.8])
        .joint("A", [-0.34, 3.2])
        .joint("P", [2.43, 0.41])
        .joint("Q", [1.26, 2.45])
        .joint("R", [0.04, 1.89])
        .joint("U", [2.38, 1.54])
        .joint("V", [2.18, 0.68])
        .link("ground", ["O", "U", "V"])
        .link("crank", ["O", "A"])
        .link("plate", ["P", "Q", "R"])
        .link("l1", ["A", "P"])
        .link("l2", ["U", "Q"])
        .link("l3", ["V", "R"])
        .driver("crank");
    Mechanism::new(&description).expect("a mechanism")
}

/// A four-bar, and a dyad on its coupler.
fn six_bar() -> Mechanism {
    let description = Description::new()
        .joint("A", [0.0, 0.0])
        .joint("B", [1.0, 0.0])
        .joint("C", [4.1, 3.2])
        .joint("D", [4.8, 0.0])
        .joint("P", [3.0, 4.0])
        .joint("E", [5.5, 5.0])
        .joint("F", [7.0, 2.0])
        .link("ground", ["A", "D", "F"])
        .link("crank", ["A", "B"])
        .link("coupler", ["B", "C", "P"])
        .link("rocker", ["D", "C"])
        .link("bar", ["P", "E"])
        .link("rocker2", ["F", "E"])
        .driver("crank");
    Mechanism::new(&description).expect("a mechanism")
}

/// Assemblies at one position after another.
pub fn assemblies(c: &mut Criterion) {
    let mut group = c.benchmark_group("assemblies");
    for (name, mechanism) in
        [("six-bar", six_bar()), ("triad", triad()), ("class IV", mechanisms::class_iv())]
    {
        let mut turned = 0.0;
        group.bench_function(BenchmarkId::new(name, mechanism.q0().len()), |b| {
            b.iter(|| {
                turned = (turned + 0.37) % 6.0;
                let q = [mechanism.q0()[0] + turned];
                mechanism.assemblies(mechanism.drawing(), black_box(&q), None).expect("found")
            });
        });
    }
    group.finish();
}

/// Limits of four-bars in closed form, and of a six-bar by search.
pub fn limits(c: &mut Criterion) {
    let mut group = c.benchmark_group("limits");
    let tables = Tables::default();
    group.throughput(Throughput::Elements(DESIGNS));
    for (name, mechanism) in [("four-bar", mechanisms::four_bar()), ("six-bar", six_bar())] {
        let drawing = mechanism.drawing().to_vec();
        let designs: Vec<Vec<f64>> = (0..DESIGNS)
            .map(|design| {
                let stretch = |(i, x): (usize, &f64)| {
                    x * (1.0 + 0.3 * (design as f64 * (i + 1) as f64 * 0.618).fract())
                };
                drawing.iter().enumerate().map(stretch).collect()
            })
            .collect();
        let mut finder =
            LimitsFinder::new(&mechanism, mechanism.signs(), &tables, None).expect("one driver");
        group.bench_function(BenchmarkId::new(name, DESIGNS), |b| {
            b.iter(|| {
                for design in &designs {
                    black_box(finder.limits(design).expect("dimensions that fit"));
                }
            });
        });
    }
    group.finish();
}
