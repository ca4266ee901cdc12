//! Every special kernel beside the general formulas for the same designs, and mixed chains beside their
//! parts. The general formulas need the feature `test-hooks`:
//! `cargo bench --features test-hooks special`.

use std::num::NonZeroUsize;

use assur::{Control, Coordinates, Mechanism, Outputs, Request, Simd, fill};
use criterion::{BenchmarkId, Criterion, Throughput};

use crate::mechanisms;
use crate::{Buffers, POSITIONS, designs, turn};

const DESIGNS: u32 = 64;

/// All joints of many designs at all positions, in one thread.
fn joints(c: &mut Criterion, group: &str, name: &str, mechanism: &Mechanism, order: usize) {
    let all = Outputs::all(mechanism);
    let kept = Outputs { joints: all.joints, ..Outputs::default() };
    let (q, dimensions) = (turn(), designs(mechanism, DESIGNS));
    let request = Request {
        dimensions: &dimensions,
        coordinates: Coordinates::Shared(&q),
        signs: mechanism.signs(),
        order,
        outputs: &kept,
    };
    let mut buffers = Buffers::new(&request.columns(mechanism), DESIGNS as usize * q.len());
    let control =
        Control { threads: NonZeroUsize::new(1), simd: Simd::best(), ..Control::default() };
    let mut group = c.benchmark_group(group);
    group.throughput(Throughput::Elements(u64::from(DESIGNS * POSITIONS)));
    group.sample_size(20);
    group.bench_function(BenchmarkId::new(name, order), |b| {
        b.iter(|| fill(mechanism, &request, buffers.arrays(), &control).expect("solved"));
    });
    group.finish();
}

/// A chain costs the sum of its parts: a triad and a dyad, side by side and one after the other.
fn chains(c: &mut Criterion) {
    for order in [0, 2] {
        for (name, mechanism) in [
            ("triad", mechanisms::triad()),
            ("dyad", mechanisms::dyad()),
            ("triad_beside_dyad", mechanisms::triad_beside_dyad()),
            ("dyad_on_triad", mechanisms::dyad_on_triad()),
        ] {
            joints(c, "chains", name, &mechanism, order);
        }
    }
}

pub fn special_kernels(c: &mut Criterion) {
    chains(c);
    let all = [
        ("two_legs", mechanisms::four_bar()),
        ("standing_guide", mechanisms::engine()),
        ("turning_guide", mechanisms::quick_return()),
        ("standing_guides", mechanisms::yoke()),
        ("two_loops", mechanisms::triad()),
        ("three_loops", mechanisms::class_iv()),
    ];
    for (name, mechanism) in all {
        for order in [0, 2] {
            joints(c, "special", name, &mechanism, order);
            #[cfg(feature = "test-hooks")]
            {
                let general = mechanism.clone().with_general_kernels();
                joints(c, "general", name, &general, order);
            }
        }
    }
}
