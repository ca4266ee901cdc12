//! Sweeps of the core beside the same formulas fused by hand: one thread, rows that stay in the
//! cache, arrays used again.

use std::hint::black_box;
use std::num::NonZeroUsize;

use assur::{
    Control, Coordinates, FourBar, FourBarMode, Mechanism, Outputs, Quantity, Request, Simd,
    SliderCrank, fill,
};
use criterion::{BenchmarkId, Criterion, Throughput};

use super::by_hand::{Rows, Turn, avx2, avx512};
use super::{Buffers, POSITIONS, mechanisms, turn};

const DESIGNS: u32 = 48;
/// By how much both may differ: rounding, for the formulas and the arc functions are the same.
const TOLERANCE: f64 = 1e-12;

/// A mechanism, its designs, two outputs, and the loop by hand over one design.
struct Case {
    name: &'static str,
    mechanism: Mechanism,
    dimensions: Vec<f64>,
    outputs: Outputs,
    quantities: [Quantity; 2],
    by_hand: fn(Simd, u32, Turn<'_>, &mut Rows<'_>),
}

fn stretch(design: u32) -> f64 {
    1.0 + 1e-4 * f64::from(design)
}

fn four_bar(design: u32) -> FourBar {
    let coupler = 3.0 * stretch(design);
    FourBar { crank: 1.0, coupler, rocker: 2.5, ground: 3.2, mode: FourBarMode::Open }
}

fn engine(design: u32) -> SliderCrank {
    SliderCrank { crank: 1.0, rod: 3.0 * stretch(design), offset: 0.1 }
}

#[allow(unsafe_code, reason = "both levels are benched only where the processor has them")]
fn four_bar_by_hand(simd: Simd, design: u32, turn: Turn<'_>, rows: &mut Rows<'_>) {
    let FourBar { crank, coupler, rocker, ground, .. } = four_bar(design);
    let lengths = [crank, coupler, rocker, ground];
    // SAFETY: see above.
    unsafe {
        match simd {
            Simd::Avx512 => avx512::four_bar(lengths, turn, rows),
            _ => avx2::four_bar(lengths, turn, rows),
        }
    }
}

#[allow(unsafe_code, reason = "both levels are benched only where the processor has them")]
fn engine_by_hand(simd: Simd, design: u32, turn: Turn<'_>, rows: &mut Rows<'_>) {
    let SliderCrank { crank, rod, offset } = engine(design);
    let lengths = [crank, rod, offset];
    // SAFETY: see above.
    unsafe {
        match simd {
            Simd::Avx512 => avx512::slider_crank(lengths, turn, rows),
            _ => avx2::slider_crank(lengths, turn, rows),
        }
    }
}

/// The first dimension of every design, then the second.
fn by_dimension(design: impl Fn(u32) -> Vec<f64>) -> Vec<f64> {
    let designs: Vec<Vec<f64>> = (0..DESIGNS).map(design).collect();
    (0..designs[0].len()).flat_map(|i| designs.iter().map(move |one| one[i])).collect()
}

fn cases() -> [Case; 2] {
    let (open, piston) = (mechanisms::four_bar(), mechanisms::engine());
    let link = |mechanism: &Mechanism, name: &str| mechanism.link(name).expect("a link");
    let links = vec![link(&open, "coupler"), link(&open, "rocker")];
    let (rod, bore) = (link(&piston, "rod"), piston.slide("bore").expect("a slide"));
    [
        Case {
            name: "four_bar",
            dimensions: by_dimension(|d| four_bar(d).dimensions(&open)),
            mechanism: open,
            quantities: [Quantity::Angle(links[0]), Quantity::Angle(links[1])],
            outputs: Outputs { links, ..Outputs::default() },
            by_hand: four_bar_by_hand,
        },
        Case {
            name: "engine",
            dimensions: by_dimension(|d| engine(d).dimensions(&piston)),
            mechanism: piston,
            quantities: [Quantity::Slide(bore), Quantity::Angle(rod)],
            outputs: Outputs { slides: vec![bore], links: vec![rod], ..Outputs::default() },
            by_hand: engine_by_hand,
        },
    ]
}

/// The loop by hand over all designs.
fn run_by_hand(case: &Case, simd: Simd, turn: Turn<'_>, columns: &mut [Vec<f64>; 6]) {
    for design in 0..DESIGNS {
        let first = (design * POSITIONS) as usize;
        let [a, b, c, d, e, f] = columns;
        let mut rows =
            [a, b, c, d, e, f].map(|column| &mut column[first..first + POSITIONS as usize]);
        (case.by_hand)(simd, design, turn, &mut rows);
    }
}

/// Both, at every level that the processor has and that the loops by hand are written for.
#[allow(clippy::disallowed_methods, reason = "the loops by hand have no given bits")]
pub fn beside_by_hand(c: &mut Criterion) {
    let q = turn();
    let (cos, sin): (Vec<f64>, Vec<f64>) = q.iter().map(|q| (q.cos(), q.sin())).unzip();
    let total = DESIGNS * POSITIONS;
    for case in cases() {
        let mechanism = &case.mechanism;
        let request = Request {
            dimensions: &case.dimensions,
            coordinates: Coordinates::Shared(&q),
            signs: mechanism.signs(),
            order: 2,
            outputs: &case.outputs,
        };
        let columns = request.columns(mechanism);
        let mut buffers = Buffers::new(&columns, total as usize);
        let mut rows: [Vec<f64>; 6] = std::array::from_fn(|_| vec![0.0; total as usize]);
        let mut group = c.benchmark_group(format!("{}/in cache", case.name));
        group.throughput(Throughput::Elements(u64::from(total)));
        for simd in [Simd::Avx2, Simd::Avx512] {
            if simd > Simd::best() {
                println!("{}, {}: skipped, this processor has none", case.name, simd.name());
                continue;
            }
            let threads = NonZeroUsize::new(1);
            let control = Control { threads, simd, ..Control::default() };
            group.bench_function(BenchmarkId::new("core", simd.name()), |b| {
                b.iter(|| {
                    fill(mechanism, black_box(&request), buffers.arrays(), &control)
                        .expect("solved");
                });
            });
            group.bench_function(BenchmarkId::new("by hand", simd.name()), |b| {
                b.iter(|| run_by_hand(&case, simd, black_box((&cos, &sin)), &mut rows));
            });
            run_by_hand(&case, simd, (&cos, &sin), &mut rows);
            let motion = mechanism.solve(&request).expect("solved");
            for (place, quantity) in case.quantities.iter().enumerate() {
                let series = match *quantity {
                    Quantity::Angle(link) => motion.links.iter().find(|s| s.index == link),
                    Quantity::Slide(slide) => motion.slides.iter().find(|s| s.index == slide),
                    _ => None,
                };
                for (order, found) in series.expect("an output").derivatives.iter().enumerate() {
                    for (a, b) in found.iter().zip(&rows[3 * place + order]) {
                        assert!((a - b).abs() < TOLERANCE, "{quantity:?} {order}: {a} {b}");
                    }
                }
            }
        }
        group.finish();
    }
}
