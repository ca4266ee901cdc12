//! Every kernel by itself, at every order and level: one block of positions again and again.
//!
//! A kernel is had from the first of these mechanisms whose tape has it.

use assur::bench_hooks::each_part;
use assur::{Coordinates, Mechanism, Outputs, Request, Simd};
use criterion::{BenchmarkId, Criterion, Throughput};

use super::{levels, mechanisms, turn};

/// All kernels but the groups', which have benches of their own.
const KERNELS: [&str; 14] = [
    "two legs on a crank",
    "two legs",
    "standing guide, a crank's rod",
    "standing guide",
    "moving guide",
    "turning guide",
    "two standing guides",
    "any other dyad",
    "redundant link",
    "point at the end of a leg",
    "point on a leg's link",
    "point on a crank",
    "point on a turned link",
    "point along a guide",
];
const MAX_ORDER: usize = 3;

/// Kernels, and what is left of a sweep without them.
pub fn kernels(c: &mut Criterion) {
    let q = turn();
    for simd in levels("kernels") {
        let mut found: Vec<String> = Vec::new();
        for mechanism in mechanisms::of_all_kernels() {
            let before = found.clone();
            for order in 0..=MAX_ORDER {
                let outputs = Outputs::all(&mechanism);
                let request = request(&mechanism, &outputs, order, &q);
                let mut done = before.clone();
                each_part(&mechanism, &request, simd, &mut |part, positions, run| {
                    if part == "rows" || part == "group" || done.iter().any(|d| d == part) {
                        return;
                    }
                    done.push(part.to_owned());
                    bench(c, &format!("kernel/{part}"), simd, order, positions, run);
                });
                found = done;
            }
        }
        for kernel in KERNELS {
            assert!(found.iter().any(|k| k == kernel), "no mechanism has the kernel {kernel:?}");
        }
        rows(c, simd, &q);
    }
}

/// Rows alone: points, angles, slides, and the angles' turns.
fn rows(c: &mut Criterion, simd: Simd, q: &[f64]) {
    let (four_bar, engine) = (mechanisms::four_bar(), mechanisms::engine());
    let link = |name| four_bar.link(name).expect("a link");
    let joint =
        Outputs { joints: vec![four_bar.joint("C").expect("a joint")], ..Outputs::default() };
    let angle = Outputs { links: vec![link("rocker")], ..Outputs::default() };
    let slide =
        Outputs { slides: vec![engine.slide("bore").expect("a slide")], ..Outputs::default() };
    for (name, mechanism, outputs) in
        [("a joint", &four_bar, joint), ("an angle", &four_bar, angle), ("a slide", &engine, slide)]
    {
        for order in 0..=MAX_ORDER {
            let request = request(mechanism, &outputs, order, q);
            each_part(mechanism, &request, simd, &mut |part, positions, run| {
                if part == "rows" {
                    bench(c, &format!("rows/{name}"), simd, order, positions, run);
                }
            });
        }
    }
}

fn request<'r>(
    mechanism: &'r Mechanism,
    outputs: &'r Outputs,
    order: usize,
    q: &'r [f64],
) -> Request<'r> {
    Request {
        dimensions: mechanism.drawing(),
        coordinates: Coordinates::Shared(q),
        signs: mechanism.signs(),
        order,
        outputs,
    }
}

fn bench(
    c: &mut Criterion,
    name: &str,
    simd: Simd,
    order: usize,
    positions: usize,
    run: &mut dyn FnMut(),
) {
    let mut group = c.benchmark_group(name);
    group.throughput(Throughput::Elements(positions as u64));
    group.bench_function(BenchmarkId::new(simd.name(), format!("order {order}")), |b| {
        b.iter(&mut *run);
    });
    group.finish();
}
