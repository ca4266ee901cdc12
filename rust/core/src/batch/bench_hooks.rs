//! The separate parts of a sweep, for `benches/rust/kernels.rs`. Not part of the crate's interface.

use std::mem::MaybeUninit;

use super::chunks::Designs;
use super::dispatch::{Entry, ForLevel, at_level};
use super::request::{Coordinates, Request};
use super::rows::{Layout, RowSlices};
use super::schedule::Control;
use super::worker::{Job, Worker};
use super::writer::Writer;
use crate::math::derivatives::DerivativeTables;
use crate::math::lanes::Real;
use crate::math::simd::Simd;
use crate::plan::mechanism::Mechanism;
use crate::plan::tape::{DyadOp, Op, PlaceKind, PlaceOp, Tape};
use crate::state::kernel::BLOCK;
use crate::state::state::Context;

/// A benchmark of a part: its name, the positions of a call, and the call.
pub type Bench<'b> = dyn FnMut(&str, usize, &mut dyn FnMut()) + 'b;

/// Passes every part of the sweep of one design, with one driver, to `bench`: each operation of its tape
/// alone, on one block of positions that is already solved, and "rows", the rest of a sweep without them.
///
/// # Panics
///
/// If the request has several designs, or its coordinates do not fill a block.
pub fn each_part(mechanism: &Mechanism, request: &Request<'_>, simd: Simd, bench: &mut Bench<'_>) {
    at_level(simd, Parts { mechanism, request, bench });
}

struct Parts<'p, 'b> {
    mechanism: &'p Mechanism,
    request: &'p Request<'p>,
    bench: &'p mut Bench<'b>,
}

impl ForLevel for Parts<'_, '_> {
    type Output = ();

    fn run<L: Entry, const G: usize>(self) {
        let Self { mechanism, request, bench } = self;
        let Coordinates::Shared(q) = request.coordinates else { panic!("shared coordinates") };
        assert!(q.len() >= BLOCK, "a block has {BLOCK} positions");
        let derivatives = DerivativeTables::new(1, request.order);
        let writer = Writer::of(mechanism, &derivatives, request);
        let control = Control::default();
        let mut worker: Worker<'_, L::Register, G> =
            Worker::new(mechanism, request, &derivatives, &writer, &control);
        let mut designs = Designs::default();
        designs.read(mechanism, request.dimensions, 1, 0..1);
        let mut values: Vec<Vec<MaybeUninit<f64>>> =
            writer.columns.iter().map(|c| vec![MaybeUninit::new(0.0); q.len() * c.width]).collect();
        let mut rows = RowSlices {
            layout: Layout::Rows,
            columns: values.iter_mut().map(Vec::as_mut_slice).collect(),
            status: &mut vec![MaybeUninit::new(0); q.len()],
            past_caches: false,
        };
        let mut job = Job { q, rows: &mut rows, first: 0, index: 0, design: 0, shared: Some(0) };
        assert!(worker.bind(designs.row(0), &mut job), "the dimensions are invalid");
        L::run(&mut worker, &mut job);
        let tape = worker.space.tape.clone();
        worker.space.tape.ops.clear();
        bench("rows", q.len(), &mut || L::run(&mut worker, &mut job));
        worker.space.tape = tape.clone();
        L::run(&mut worker, &mut job);

        let space = &mut *worker.space;
        space.coordinates.swap(0, &mut space.block);
        for op in &tape.ops {
            let single_op = Tape { ops: vec![op.clone()], ..tape.clone() };
            let cx = Context { tape: &single_op, ..worker.design.context(&derivatives) };
            let (name, is_unchecked) = name(op);
            let Some(name) = name else { continue };
            if is_unchecked && tape.is_bounded {
                bench(name, G * L::Register::LANES, &mut || L::unchecked(&mut space.block, &cx));
            } else {
                bench(name, G * L::Register::LANES, &mut || L::solve(&mut space.block, &cx));
            }
        }
    }
}

/// The name of an operation, if it is used, and whether it has an unchecked kernel.
fn name(op: &Op) -> (Option<&'static str>, bool) {
    let if_used = |op: &DyadOp, name: [&'static str; 2]| {
        op.is_used.then_some(name[usize::from(op.pin.is_some())])
    };
    match op {
        Op::TwoLegs(op) => (if_used(op, ["two legs", "two legs on a crank"]), true),
        Op::StandingGuide(op) => {
            (if_used(op, ["standing guide", "standing guide, a crank's rod"]), true)
        }
        Op::MovingGuide(op) => (if_used(op, ["moving guide"; 2]), true),
        Op::TurningGuide(op) => (if_used(op, ["turning guide"; 2]), true),
        Op::StandingGuides(op) => (if_used(op, ["two standing guides"; 2]), true),
        Op::Place(PlaceOp { is_used: false, .. }) => (None, true),
        Op::Place(PlaceOp { kind, .. }) => {
            let name = match kind {
                PlaceKind::Leg { .. } => "point at the end of a leg",
                PlaceKind::OnLeg { .. } => "point on a leg's link",
                PlaceKind::Crank { .. } => "point on a crank",
                PlaceKind::Rigid { .. } => "point on a turned link",
                PlaceKind::Along => "point along a guide",
            };
            (Some(name), true)
        }
        Op::Dyad { .. } => (Some("any other dyad"), false),
        Op::Group { .. } => (Some("group"), false),
        Op::Redundant { .. } => (Some("redundant link"), false),
        Op::Length { .. } => (Some("check of a length"), true),
    }
}
