//! Many runs in lanes: each is the run that it is alone, at every level of vector instructions.

use std::ops::ControlFlow;
use std::sync::atomic::AtomicBool;

use assur::dynamics::{
    Body, Characteristic, EventKind, EventSpec, Load, Machine, Motor, NoCallbacks, Outcome, Point,
    RunBatch, RunOptions, Value, Variable,
};
use assur::ode::{Crossing, Method};
use assur::{Mechanism, Simd};

use crate::models::linkages::crank_rocker;

const RUNS: usize = 45;

fn machine(mechanism: &Mechanism, loads: Vec<Load>) -> Machine {
    let link = |name| mechanism.link(name).expect("a link");
    let [crank, coupler, rocker] = ["crank", "coupler", "rocker"].map(link);
    let body = |link, at, mass, inertia| Body { link, at: Point::Link { link, at }, mass, inertia };
    Machine {
        bodies: vec![
            body(crank, [0.0; 2], 1.0, 1.5),
            body(coupler, [1.0, 0.3], 2.0, 0.5),
            Body { link: rocker, at: Point::Joint(2), mass: 1.0, inertia: 0.2 },
        ],
        gravity: [0.3, -9.81],
        motors: vec![Motor {
            driver: 0,
            ratio: 2.0,
            rotor_inertia: 0.1,
            characteristic: Characteristic::Linear { stall: 10.0, no_load: 9.0 },
        }],
        loads,
        ..Machine::default()
    }
}

fn options(method: Method) -> RunOptions<'static> {
    RunOptions {
        along: Variable::Time,
        t: 0.0,
        q: &[],
        speed: &[],
        end: 0.0,
        method,
        relative: 1e-9,
        absolute: None,
        max_step: f64::INFINITY,
        max_steps: 10_000,
        deadline: None,
        breaks: &[],
        events: &[],
        flywheel: 0.0,
    }
}

fn check(machine: &Machine, mechanism: &Mechanism, method: Method) {
    let dimensions = mechanism.drawing();
    let q: Vec<f64> = (0..RUNS).map(|run| 0.21 * run as f64 - 4.0).collect();
    let speed: Vec<f64> = (0..RUNS).map(|run| 0.3 * (run as f64 - 20.0)).collect();
    // Some of the runs end much sooner than the others.
    let ends: Vec<f64> = (0..RUNS).map(|run| 0.1 + 0.07 * (run % 11) as f64).collect();
    let speed_event = |value, stops| EventSpec {
        kind: EventKind::Speed { driver: 0, value },
        crossing: Crossing::Either,
        stops,
        rebound: None,
    };
    let events = [vec![speed_event(2.0, false), speed_event(5.0, true)]];
    let options = options(method);
    let batch = RunBatch {
        variations: &[],
        dimensions,
        designs: 1,
        q: &q,
        speed: &speed,
        ends: &ends,
        events: &events,
        limit: None,
        options,
    };
    let alone: Vec<Outcome<std::convert::Infallible>> = (0..RUNS)
        .map(|run| {
            let options = RunOptions {
                q: &q[run..=run],
                speed: &speed[run..=run],
                end: ends[run],
                events: &events[0],
                ..options
            };
            machine.run(mechanism, dimensions, &options, NoCallbacks)
        })
        .collect();
    assert!(alone.iter().all(Result::is_ok));
    let cancel = AtomicBool::new(false);
    for simd in [Simd::Baseline, Simd::Avx2, Simd::Avx512] {
        for first in [0, 7] {
            let mut found = Vec::new();
            machine.runs_side_by_side(
                mechanism,
                &batch,
                first..RUNS,
                (&cancel, simd),
                &mut |run, outcome| {
                    assert_eq!(run, first + found.len());
                    found.push(outcome);
                    ControlFlow::Continue(())
                },
            );
            assert_eq!(found, alone[first..], "{simd:?}");
        }
    }
}

#[test]
fn lanes_change_no_run() {
    let mechanism = Mechanism::new(&crank_rocker()).expect("a mechanism");
    let machine = machine(&mechanism, Vec::new());
    check(&machine, &mechanism, Method::DormandPrince853);
    check(&machine, &mechanism, Method::DormandPrince54);
}

#[test]
fn machines_without_lanes_change_no_run() {
    let mechanism = Mechanism::new(&crank_rocker()).expect("a mechanism");
    let link = |name| mechanism.link(name).expect("a link");
    let torque = Load::Torque {
        link: link("rocker"),
        on: link("ground"),
        torque: Value::Number(2.0),
        one_way: None,
    };
    check(&machine(&mechanism, vec![torque]), &mechanism, Method::DormandPrince853);
}

#[test]
fn a_batch_ends_where_it_is_told_to() {
    let mechanism = Mechanism::new(&crank_rocker()).expect("a mechanism");
    let machine = machine(&mechanism, Vec::new());
    let batch = RunBatch {
        variations: &[],
        dimensions: mechanism.drawing(),
        designs: 1,
        q: &[0.0; 40],
        speed: &[1.0; 40],
        ends: &[0.1; 40],
        events: &[],
        limit: None,
        options: options(Method::DormandPrince853),
    };
    let mut kept = 0;
    machine.runs_side_by_side::<std::convert::Infallible>(
        &mechanism,
        &batch,
        0..40,
        (&AtomicBool::new(false), Simd::best()),
        &mut |_, _| {
            kept += 1;
            if kept == 35 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        },
    );
    assert_eq!(kept, 35);
}
