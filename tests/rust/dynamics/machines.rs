//! Motions from Rust: a machine of a mechanism, and one of tables.

use std::f64::consts::{PI, TAU};
use std::sync::atomic::AtomicBool;

use assur::Mechanism;
use assur::dynamics::{
    Body, Characteristic, Curve, DrivenPositions, EndCondition, EventKind, EventSpec, Load,
    Machine, Mean, Measure, Motor, NoCallbacks, OneWay, Over, Point, RunError, RunOptions,
    SteadyError, SteadyOptions, StopReason, Table, TabulatedMachine, Value, Variable,
};
use assur::ode::{Crossing, Method};

use crate::models::linkages::crank_rocker;

fn task<'a>(q: &'a [f64], speed: &'a [f64], end: f64) -> RunOptions<'a> {
    RunOptions {
        along: Variable::Time,
        t: 0.0,
        q,
        speed,
        end,
        method: Method::DormandPrince853,
        relative: 1e-12,
        absolute: None,
        max_step: f64::INFINITY,
        max_steps: 100_000,
        deadline: None,
        breaks: &[],
        events: &[],
        flywheel: 0.0,
    }
}

fn search(span: f64, speed: Option<f64>) -> SteadyOptions<'static> {
    SteadyOptions {
        q: 0.0,
        span,
        speed,
        mean: Mean::Period,
        method: Method::DormandPrince853,
        relative: 1e-12,
        max_steps: 100_000,
        deadline: None,
        breaks: &[],
        flywheel: 0.0,
    }
}

#[test]
fn options_that_do_not_fit_are_named() {
    let table = |values: [f64; 2]| Table::new(&[0.0, TAU], &values, EndCondition::Linear, true);
    let tabulated =
        TabulatedMachine { tables: vec![table([1.0; 2]).expect("a table")], motors: Vec::new() };
    assert!(tabulated.reduce(&[0.0]).moment[0].is_nan());
    let said = |error: String, what: &str| assert!(error.contains(what), "{error}");
    let run = tabulated.run(&task(&[0.0], &[1.0], 1.0), NoCallbacks);
    said(
        run.expect_err("one table").to_string(),
        "wrong number of tables of inertia and moment: 1 given, 2 needed",
    );
    let steady = tabulated.steady(&search(TAU, Some(1.0)), None, NoCallbacks);
    said(steady.expect_err("one table").to_string(), "1 given, 2 needed");
    let mechanism = Mechanism::new(&crank_rocker()).expect("a mechanism");
    let machine = Machine::default();
    let own = mechanism.drawing();
    let run = |task: &RunOptions<'_>, own: &[f64]| {
        machine.run(&mechanism, own, task, NoCallbacks).expect_err("too few").to_string()
    };
    said(run(&task(&[0.0], &[1.0], 1.0), &own[1..]), "wrong number of dimensions");
    said(
        run(&task(&[0.0, 1.0], &[1.0], 1.0), own),
        "wrong number of coordinates: 2 given, 1 needed",
    );
    said(run(&task(&[0.0], &[], 1.0), own), "wrong number of speeds: 0 given, 1 needed");
    let kind = EventKind::Speed { driver: 1, value: 0.0 };
    let watches = [EventSpec { kind, crossing: Crossing::Either, stops: true, rebound: None }];
    let watched = RunOptions { events: &watches, ..task(&[0.0], &[1.0], 1.0) };
    said(run(&watched, own), "wrong number of drivers: 1 given, 2 needed");
    let steady = machine.steady(&mechanism, &own[1..], &search(TAU, Some(1.0)), None, NoCallbacks);
    said(steady.expect_err("too few").to_string(), "wrong number of dimensions");
}

#[test]
fn energy_stays_and_a_position_is_met() {
    let mechanism = Mechanism::new(&crank_rocker()).expect("a mechanism");
    let [coupler, rocker] = ["coupler", "rocker"].map(|name| mechanism.link(name).expect("a link"));
    let machine = Machine {
        bodies: vec![
            Body {
                link: coupler,
                at: Point::Link { link: coupler, at: [2.0, 0.3] },
                mass: 2.0,
                inertia: 0.5,
            },
            Body { link: rocker, at: Point::Joint(2), mass: 1.0, inertia: 0.2 },
            Body {
                link: mechanism.link("crank").expect("a link"),
                at: Point::Joint(0),
                mass: 0.0,
                inertia: 4.0,
            },
        ],
        gravity: [0.0, -1.0],
        ..Machine::default()
    };
    let watches = [EventSpec {
        kind: EventKind::Coordinate { driver: 0, value: 20.0 },
        crossing: Crossing::Rising,
        stops: true,
        rebound: None,
    }];
    let mut task = task(&[0.0], &[3.0], 60.0);
    task.events = &watches;
    let run = machine.run(&mechanism, mechanism.drawing(), &task, NoCallbacks).expect("a run");
    assert_eq!(run.stop_reason, StopReason::Event(0));
    let last = run.samples.last().expect("an end");
    assert!((last.q[0] - 20.0).abs() < 1e-13);
    let total: Vec<f64> =
        run.energies.iter().map(|[kinetic, potential]| kinetic + potential).collect();
    assert!(total.iter().all(|own| (own - total[0]).abs() < 1e-10 * total[0].abs()));
    // Along the coordinate it takes the same time.
    let mut along = task;
    (along.along, along.end, along.events) = (Variable::Coordinate, 20.0, &[]);
    let over = machine.run(&mechanism, mechanism.drawing(), &along, NoCallbacks).expect("a run");
    assert!((over.samples.last().expect("an end").t - last.t).abs() < 1e-10);
    let there = over.at(10.0).expect("on the way");
    assert!((run.at(there.t).expect("on the way").q[0] - 10.0).abs() < 1e-9);
    assert!(over.at(21.0).is_none());
}

#[test]
fn a_table_over_the_coordinate_does_its_work() {
    let mechanism = Mechanism::new(&crank_rocker()).expect("a mechanism");
    let crank = mechanism.link("crank").expect("a link");
    let ground = mechanism.link("ground").expect("a link");
    let torque =
        Table::new(&[0.0, PI, TAU], &[1.0, 3.0, 1.0], EndCondition::Linear, true).expect("a table");
    let machine = Machine {
        bodies: vec![Body { link: crank, at: Point::Joint(0), mass: 0.0, inertia: 2.0 }],
        loads: vec![Load::Torque {
            link: crank,
            on: ground,
            torque: Value::Table(0),
            one_way: None,
        }],
        tables: vec![torque],
        ..Machine::default()
    };
    let task = RunOptions { along: Variable::Coordinate, ..task(&[0.0], &[1.0], TAU) };
    let run = machine.run(&mechanism, mechanism.drawing(), &task, NoCallbacks).expect("a run");
    // Work of 2 N·m over a turn.
    let speed = run.samples.last().expect("an end").speed[0];
    assert!((speed - (1.0 + 2.0 * TAU).sqrt()).abs() < 1e-12, "{speed}");
    assert_eq!(run.statistics.restarts, 1);
}

#[test]
fn loads_follow_another_link() {
    let mechanism = Mechanism::new(&crank_rocker()).expect("a mechanism");
    let link = |name| mechanism.link(name).expect("a link");
    let (crank, rocker, ground) = (link("crank"), link("rocker"), link("ground"));
    // A table with a jump, which over the rocker's own angle does no work in a turn, and a brake that
    // takes 2 N·m over what the rocker swings forward.
    let table = Table::with_jumps(
        &[-10.0, 2.0, 2.0, 10.0],
        &[3.0, 3.0, -8.0, 0.0],
        EndCondition::Linear,
        false,
    );
    let curve = Curve::Table(table.expect("a table"));
    let one_way = Some(OneWay { way: 0, sign: 1.0 });
    let torque = |torque, one_way| Load::Torque { link: rocker, on: ground, torque, one_way };
    let machine = Machine {
        bodies: vec![Body { link: crank, at: Point::Joint(0), mass: 0.0, inertia: 2.0 }],
        loads: vec![torque(Value::Over(0), None), torque(Value::Number(-2.0), one_way)],
        over: vec![Over { measure: Measure::Angle(rocker), curve }],
        ways: vec![Measure::Angle(rocker)],
        ..Machine::default()
    };
    let turns = machine.stations(&mechanism, mechanism.drawing(), [0.0, TAU]);
    assert!((2..=6).contains(&turns.len()), "{turns:?}");
    let task = RunOptions { along: Variable::Coordinate, ..task(&[0.0], &[9.0], TAU) };
    let run = machine.run(&mechanism, mechanism.drawing(), &task, NoCallbacks).expect("a run");
    let end = run.samples.last().expect("an end").speed[0];
    // The potential of a constant torque is the angle.
    let preloaded =
        Load::TorsionSpring { link: rocker, on: ground, stiffness: 0.0, angle: 0.0, preload: 1.0 };
    let unit = Machine { loads: vec![preloaded], ..Machine::default() };
    let q: Vec<f64> = (0..20_000).map(|i| TAU * f64::from(i) / 20_000.0).collect();
    let positions = DrivenPositions { q: &q, speed: &q, ..DrivenPositions::default() };
    let cancel = AtomicBool::new(false);
    let swings = unit.reduce(&mechanism, mechanism.drawing(), positions, &cancel).potential;
    let least = swings.iter().copied().fold(f64::INFINITY, f64::min);
    let greatest = swings.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    assert!((81.0 - end * end - 2.0 * (greatest - least)).abs() < 1e-6, "{end}");
}

#[test]
fn a_place_on_the_ground_is_in_the_drawings_frame() {
    let mechanism = Mechanism::new(&crank_rocker()).expect("a mechanism");
    let ground = mechanism.link("ground").expect("a link");
    // Joint 1 is B, wherever the ground's first joint is.
    let [x, y] = mechanism.linkage().joints[1].at;
    let anchor = Point::Link { link: ground, at: [x - 3.0, y + 4.0] };
    let spring =
        Load::Spring { ends: [Point::Joint(1), anchor], stiffness: 8.0, length: 0.0, preload: 0.0 };
    let machine = Machine { loads: vec![spring], ..Machine::default() };
    let (q, cancel) = (mechanism.q0(), AtomicBool::new(false));
    let positions = DrivenPositions { q, speed: &[0.0], ..DrivenPositions::default() };
    let rows = machine.reduce(&mechanism, mechanism.drawing(), positions, &cancel);
    // 8/2 · 5².
    assert!((rows.potential[0] - 100.0).abs() < 1e-12);
}

#[test]
fn the_mean_of_the_search_is_met() {
    let table = |of: fn(f64) -> f64| {
        let rows: Vec<f64> = (0..97).map(|k| f64::from(k) * TAU / 96.0).collect();
        let mut values: Vec<f64> = rows.iter().map(|&q| of(q)).collect();
        values[96] = values[0];
        Table::new(&rows, &values, EndCondition::NotAKnot, true).expect("a table")
    };
    let tables = vec![table(|q| 2.0 + q.cos()), table(|q| 40.0 * (2.0 * q).sin())];
    let tabulated = TabulatedMachine { tables, motors: Vec::new() };
    for mean in [Mean::Period, Mean::Extremes] {
        for speed in [9.0, -25.0] {
            let search = SteadyOptions { mean, ..search(TAU.copysign(speed), Some(speed)) };
            let steady = tabulated.steady(&search, None, NoCallbacks).expect("a motion");
            assert!((steady.mean(mean) - speed.abs()).abs() < 1e-10, "{mean:?} {speed}");
            assert!(steady.prescribed);
        }
    }
    let bare =
        TabulatedMachine { tables: vec![table(|_| 0.0), table(f64::sin)], motors: Vec::new() };
    let none = bare.steady(&search(TAU, Some(5.0)), None, NoCallbacks);
    assert!(matches!(none, Err(SteadyError::Run(RunError::NoInertia { .. }))), "{none:?}");
}

#[test]
fn tables_with_a_motor_come_to_a_periodic_motion() {
    let flat = |value: f64| Table::new(&[0.0, TAU], &[value, value], EndCondition::Linear, true);
    let motor = |stall: f64| Motor {
        driver: 0,
        ratio: 2.0,
        rotor_inertia: 0.25,
        characteristic: Characteristic::Linear { stall, no_load: 30.0 },
    };
    let tabulated = |stall: f64| TabulatedMachine {
        tables: vec![flat(3.0).expect("a table"), flat(-8.0).expect("a table")],
        motors: vec![motor(stall)],
    };
    let steady = tabulated(10.0).steady(&search(TAU, None), None, NoCallbacks).expect("a motion");
    // 2 · 10 (1 − 2 ω/30) = 8.
    assert!((steady.mean(Mean::Period) - 9.0).abs() < 1e-12);
    // Inertia 3 + 4 · 0.25, slope 4 · 10/30.
    assert!((steady.multiplier - (-TAU * 4.0 / 3.0 / (4.0 * 9.0)).exp()).abs() < 1e-11);
    assert!((steady.drive - 8.0 * TAU).abs() < 1e-10);
    let weak = tabulated(3.9).steady(&search(TAU, None), None, NoCallbacks);
    assert!(
        matches!(weak, Err(SteadyError::Stops { .. } | SteadyError::CannotCarry { .. })),
        "{weak:?}"
    );
    // A guess far above the field's speed, where the motor brakes less and less.
    let induction = Characteristic::Induction { breakdown: 60.0, slip: 0.2, synchronous: 15.7 };
    let kloss = TabulatedMachine {
        motors: vec![Motor { characteristic: induction, ..motor(1.0) }],
        ..tabulated(1.0)
    };
    // 2 · 120 s 0.2 / (s² + 0.04) = 8.
    let slip = 0.2 * (15.0 - 224.0_f64.sqrt());
    for guess in [None, Some(5.0), Some(20.0), Some(100.0), Some(3000.0)] {
        let own = kloss.steady(&search(TAU, guess), None, NoCallbacks).expect("a motion");
        let exact = 0.5 * 15.7 * (1.0 - slip);
        assert!((own.mean(Mean::Period) - exact).abs() < 1e-10, "{guess:?}");
    }
    let unknown = TabulatedMachine { motors: vec![], ..tabulated(1.0) };
    let unknown = unknown.steady(&search(TAU, None), None, NoCallbacks);
    assert_eq!(unknown.unwrap_err(), SteadyError::NeedsSpeed);
}
