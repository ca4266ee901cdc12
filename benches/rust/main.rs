//! Speed of the core: many positions of one design, and many designs.
//!
//! Medians and ratios are what counts: baseline beside AVX2 and AVX-512, one thread
//! beside two, every case in the same run.

mod assemblies;
mod beside_by_hand;
mod by_hand;
mod kernels;
mod mechanisms;
mod metrics;
mod special_kernels;

use std::hint::black_box;
use std::mem::MaybeUninit;
use std::num::NonZeroUsize;
use std::time::Duration;

use assur::{Arrays, Column, Control, Coordinates, Mechanism, Outputs, Request, Simd, fill};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};

const POSITIONS: u32 = 360;

/// Arrays that a request fills, kept from one run to the next.
struct Buffers {
    columns: Vec<Vec<MaybeUninit<f64>>>,
    status: Vec<MaybeUninit<u8>>,
}

impl Buffers {
    fn new(columns: &[Column], rows: usize) -> Self {
        let empty = |c: &Column| vec![MaybeUninit::new(0.0); rows * c.width];
        Self {
            columns: columns.iter().map(empty).collect(),
            status: vec![MaybeUninit::new(0); rows],
        }
    }

    fn arrays(&mut self) -> Arrays<'_> {
        Arrays {
            columns: self.columns.iter_mut().map(Vec::as_mut_slice).collect(),
            status: &mut self.status,
        }
    }
}

fn turn() -> Vec<f64> {
    (0..POSITIONS).map(|i| f64::from(i) * std::f64::consts::TAU / f64::from(POSITIONS)).collect()
}

/// Levels that this processor has, the quickest first; says which ones it has not.
fn levels(what: &str) -> Vec<Simd> {
    let (has, lacks): (Vec<_>, Vec<_>) =
        [Simd::Avx512, Simd::Avx2, Simd::Baseline].into_iter().partition(|&s| s <= Simd::best());
    println!("{what}: levels {}", has.iter().map(|s| s.name()).collect::<Vec<_>>().join(", "));
    for simd in lacks {
        println!("{what}, {}: skipped, this processor has no such instructions", simd.name());
    }
    has
}

/// Dimensions of designs near the drawing's, all of the same type of motion.
fn designs(mechanism: &Mechanism, count: u32) -> Vec<f64> {
    let stretch = |design: u32, place: usize| {
        let step = (design * 7 + u32::try_from(place).unwrap_or(0) * 3) % 101;
        1.0 + 2e-4 * f64::from(step)
    };
    let one = mechanism.drawing().iter().enumerate();
    one.flat_map(|(i, x)| (0..count).map(move |design| x * stretch(design, i))).collect()
}

fn batch(c: &mut Criterion, designs_of_each: u32) {
    let q = turn();
    let class_iv = &["2", "3", "4", "5", "6", "7", "8"][..];
    for (name, mechanism, outputs, order) in [
        ("four_bar", mechanisms::four_bar(), &["B", "C", "coupler", "rocker"][..], 2),
        ("jansen", mechanisms::jansen(), &["1", "3", "4", "5", "6", "7"][..], 0),
        ("class_iv", mechanisms::class_iv(), class_iv, 0),
        ("class_iv_analogues", mechanisms::class_iv(), class_iv, 2),
    ] {
        let mut kept = Outputs::default();
        for output in outputs {
            match mechanism.joint(output) {
                Ok(joint) => kept.joints.push(joint),
                Err(_) => kept.links.extend(mechanism.link(output)),
            }
        }
        let dimensions = designs(&mechanism, designs_of_each);
        let request = Request {
            dimensions: &dimensions,
            coordinates: Coordinates::Shared(&q),
            signs: mechanism.signs(),
            order,
            outputs: &kept,
        };
        let rows = designs_of_each as usize * q.len();
        let mut buffers = Buffers::new(&request.columns(&mechanism), rows);
        let mut group = c.benchmark_group(format!("{name}/{designs_of_each}x{POSITIONS}"));
        group.throughput(Throughput::Elements(u64::from(designs_of_each * POSITIONS)));
        group.sample_size(10);
        for simd in levels(name) {
            for threads in [1, 2] {
                let id = BenchmarkId::new(format!("{simd:?}"), format!("{threads} threads"));
                let control =
                    Control { threads: NonZeroUsize::new(threads), simd, ..Control::default() };
                group.bench_function(id, |b| {
                    b.iter(|| {
                        fill(&mechanism, black_box(&request), buffers.arrays(), &control)
                            .expect("solved");
                    });
                });
            }
        }
        group.finish();
    }
}

fn many_designs(c: &mut Criterion) {
    batch(c, 20);
    batch(c, 10_000);
}

/// A student's call: one mechanism, one turn; everything in new arrays, or two outputs in given ones.
fn one_design(c: &mut Criterion) {
    let q = turn();
    let mut group = c.benchmark_group("one_design");
    group.throughput(Throughput::Elements(u64::from(POSITIONS)));
    for ((name, mechanism), last) in mechanisms::all().into_iter().zip(["C", "B", "7"]) {
        let all = Outputs::all(&mechanism);
        let joints = vec![mechanism.joint(last).expect("a joint")];
        let links = vec![*all.links.last().expect("a link")];
        let two = Outputs { joints, links, ..Outputs::default() };
        for order in [0, 2] {
            let coordinates = Coordinates::Shared(&q);
            let (dimensions, signs) = (mechanism.drawing(), mechanism.signs());
            let everything = Request { dimensions, coordinates, signs, order, outputs: &all };
            group.bench_function(BenchmarkId::new(name, order), |b| {
                b.iter(|| mechanism.solve(black_box(&everything)).expect("solved"));
            });
            let some = Request { outputs: &two, ..everything.clone() };
            let mut buffers = Buffers::new(&some.columns(&mechanism), q.len());
            let control = Control { threads: NonZeroUsize::new(1), ..Control::default() };
            group.bench_function(BenchmarkId::new(format!("{name}, two outputs"), order), |b| {
                b.iter(|| {
                    fill(&mechanism, black_box(&some), buffers.arrays(), &control).expect("solved");
                });
            });
        }
    }
    group.finish();
}

/// Parts of a sweep take microseconds a call: less time than criterion's own is enough.
fn short() -> Criterion {
    let (warm_up, measured) = (Duration::from_millis(200), Duration::from_millis(500));
    Criterion::default().sample_size(20).warm_up_time(warm_up).measurement_time(measured)
}

/// A joint of a five-bar with two drivers, at pairs of angles of a net, to the second analogue.
fn several_drivers(c: &mut Criterion) {
    let mechanism = mechanisms::five_bar();
    let swing = |i: u32, start: f64| start + 0.6 * f64::from(i) / 60.0;
    let [left, right] = [mechanism.q0()[0], mechanism.q0()[1]];
    let q: Vec<f64> =
        (0..POSITIONS * 10).flat_map(|i| [swing(i % 60, left), swing(i / 60, right)]).collect();
    let joint = mechanism.joint("C").expect("a joint");
    let outputs = Outputs { joints: vec![joint], ..Outputs::default() };
    let mut group = c.benchmark_group("several drivers");
    group.throughput(Throughput::Elements(u64::from(POSITIONS * 10)));
    for order in [0, 2] {
        let request = Request {
            dimensions: mechanism.drawing(),
            coordinates: Coordinates::Shared(&q),
            signs: mechanism.signs(),
            order,
            outputs: &outputs,
        };
        let mut buffers = Buffers::new(&request.columns(&mechanism), q.len() / 2);
        let control = Control { threads: NonZeroUsize::new(1), ..Control::default() };
        group.bench_function(BenchmarkId::new("joint", order), |b| {
            b.iter(|| {
                fill(&mechanism, black_box(&request), buffers.arrays(), &control).expect("solved");
            });
        });
        assert!(mechanism.solve(&request).expect("solved").status.iter().all(|&s| s == 0));
    }
    group.finish();
}

/// What a request costs before its first position, ten dyads: with the feature `test-hooks`.
#[cfg(feature = "test-hooks")]
fn compile_tape(c: &mut Criterion) {
    let mechanism = mechanisms::chain(10);
    let last = mechanism.joint("B10").expect("a joint");
    let outputs = Outputs { joints: vec![last], ..Outputs::default() };
    c.bench_function("compile tape/10 dyads", |b| {
        b.iter(|| assur::test_hooks::compile_tape(black_box(&mechanism), &outputs));
    });
}

#[cfg(not(feature = "test-hooks"))]
fn compile_tape(_: &mut Criterion) {}

criterion_group!(
    benches,
    beside_by_hand::beside_by_hand,
    many_designs,
    one_design,
    special_kernels::special_kernels,
    several_drivers,
    compile_tape
);
criterion_group! { name = parts; config = short(); targets = kernels::kernels, metrics::metrics, assemblies::assemblies, assemblies::limits }
criterion_main!(benches, parts);
