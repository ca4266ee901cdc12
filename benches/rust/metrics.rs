//! Metrics of many four-bars: what one costs beside the motion that it is measured on.

use std::hint::black_box;
use std::num::NonZeroUsize;

use assur::sweep::{
    Coordinate, Deviation, Extreme, LeastTransmission, Line, Mean, Metric, Moves, PlaceOf,
    RootMeanSquare, Shape, Span, Sweep, TimeRatio,
};
use assur::{Control, Mechanism};
use criterion::{BenchmarkId, Criterion, Throughput};

use super::{POSITIONS, designs, levels, mechanisms, turn};

const DESIGNS: u32 = 48;

/// Each metric by itself, at every level; one thread.
pub fn metrics(c: &mut Criterion) {
    let (mechanism, q) = (mechanisms::four_bar(), turn());
    let dimensions = designs(&mechanism, DESIGNS);
    for simd in levels("metrics") {
        for (name, metric) in every_metric(&mechanism) {
            let metrics = [&*metric];
            let sweep = Sweep { metrics: &metrics, ..Sweep::of(&mechanism, &dimensions, &q) };
            let control = Control { threads: NonZeroUsize::new(1), simd, ..Control::default() };
            let mut group = c.benchmark_group(format!("metric/{name}"));
            group.throughput(Throughput::Elements(u64::from(DESIGNS * POSITIONS)));
            group.bench_function(BenchmarkId::from_parameter(simd.name()), |b| {
                b.iter(|| mechanism.measure(black_box(&sweep), &control).expect("measured"));
            });
            group.finish();
        }
    }
}

fn every_metric(mechanism: &Mechanism) -> Vec<(&'static str, Box<dyn Metric>)> {
    let joint = |name| mechanism.joint(name).expect("a joint");
    let x = Coordinate::joint(joint("C"), 0);
    let rocker = Coordinate::link(mechanism.link("rocker").expect("a link"));
    let [b, c, d] = ["B", "C", "D"].map(joint);
    let lines = [Line::Joints([c, b]), Line::Joints([c, d])];
    let transmission = LeastTransmission { lines, complement: false };
    let deviation = |shape| Deviation { joint: c, shape, part: 0.5, is_relative: false };
    vec![
        ("moves", Box::new(Moves)),
        ("span of x", Box::new(Span(x))),
        ("span of an angle", Box::new(Span(rocker))),
        ("span of a first analogue", Box::new(Span(rocker.derivative(1)))),
        ("greatest", Box::new(Extreme::Greatest(x))),
        ("place of the greatest", Box::new(PlaceOf(Extreme::Greatest(x)))),
        ("mean", Box::new(Mean(x))),
        ("root mean square", Box::new(RootMeanSquare(rocker.derivative(2)))),
        ("time ratio", Box::new(TimeRatio(rocker))),
        ("least transmission", Box::new(transmission)),
        ("deviation from a line", Box::new(deviation(Shape::Line))),
        ("deviation from a circle", Box::new(deviation(Shape::Circle))),
    ]
}
