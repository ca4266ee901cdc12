//! Speed of the core: positions a second, with and without analogues.

use std::hint::black_box;

use assur::{Coordinates, Description, FourBar, FourBarMode, Mechanism, Outputs, Request};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};

fn four_bar() -> Mechanism {
    Mechanism::new(&FourBar::description(FourBarMode::Open)).expect("a mechanism")
}

fn jansen() -> Mechanism {
    let places = [
        (0.0, 0.0),
        (9.61, 11.52),
        (-38.0, -7.8),
        (-35.24, 33.61),
        (-77.75, -2.54),
        (-20.1, -42.79),
        (-56.05, -35.42),
        (-22.22, -91.74),
    ];
    let mut leg = Description::new();
    for (joint, (x, y)) in places.into_iter().enumerate() {
        leg = leg.joint(&joint.to_string(), [x, y]);
    }
    let leg = leg
        .link("ground", ["0", "2"])
        .link("crank", ["0", "1"])
        .link("upper", ["1", "3"])
        .link("shoulder", ["2", "3", "4"])
        .link("lower", ["1", "5"])
        .link("arm", ["2", "5"])
        .link("rod", ["4", "6"])
        .link("foot", ["5", "6", "7"]);
    Mechanism::new(&leg.driver("crank")).expect("a mechanism")
}

fn positions(c: &mut Criterion) {
    let q: Vec<f64> = (0..3600).map(|i| f64::from(i) * std::f64::consts::TAU / 3600.0).collect();
    let mut group = c.benchmark_group("positions");
    group.throughput(Throughput::Elements(3600));
    for (name, mechanism) in [("four_bar", four_bar()), ("jansen", jansen())] {
        let outputs = Outputs::all(&mechanism);
        for order in [0, 2] {
            group.bench_function(BenchmarkId::new(name, order), |b| {
                b.iter(|| {
                    let request = Request {
                        dimensions: mechanism.drawing(),
                        coordinates: Coordinates::Shared(black_box(&q)),
                        signs: mechanism.signs(),
                        order,
                        outputs: &outputs,
                    };
                    mechanism.solve(&request).expect("solved")
                });
            });
        }
    }
    group.finish();
}

criterion_group!(benches, positions);
criterion_main!(benches);
