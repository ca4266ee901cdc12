//! Kernels of dyads and groups beside the general formulas for the same mechanisms: single positions,
//! within the error bounds of both.

use super::design::Design;
use crate::math::derivatives::DerivativeTables;
use crate::math::tolerance::{ANALOGUE_PER_CONDITION_SQUARED, CLOSURE_PER_CONDITION};
use crate::plan::mechanism::{Flat, Mechanism};
use crate::plan::tape::Op;
use crate::state::state::State;
use crate::state::status::Status;
use crate::{ClassIv, Description, FourBar, FourBarMode, SliderCrank};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

const DESIGNS: u32 = 6;
const POSITIONS: u32 = 48;
const ORDER: usize = 3;

/// A crank and a plate on three legs, with a dyad on the plate.
fn triad_and_dyad() -> Description {
    Description::new()
        .joint("O", [0.0, 0.0])
        .joint("A", [0.3, 0.2])
        .joint("B", [1.0, 2.0])
        .joint("C", [2.5, 1.5])
        .joint("D", [2.0, 3.0])
        .joint("E", [4.0, 0.0])
        .joint("F", [0.0, 4.0])
        .joint("G", [3.0, 4.0])
        .joint("H", [5.0, 2.5])
        .link("ground", ["O", "E", "F", "H"])
        .link("crank", ["O", "A"])
        .link("rod", ["A", "B"])
        .link("plate", ["B", "C", "D"])
        .link("right", ["C", "E"])
        .link("left", ["D", "F"])
        .link("upper", ["D", "G"])
        .link("lower", ["G", "H"])
        .driver("crank")
}

fn class_iv() -> Description {
    ClassIv::description([
        [0.0, 0.0],
        [0.35, 0.0],
        [1.24, 0.99],
        [0.75, 1.91],
        [3.02, -0.73],
        [2.45, 1.02],
        [3.2, 2.24],
        [1.85, 2.35],
        [1.62, -1.11],
        [4.28, 1.52],
    ])
}

/// A block on a swinging arm, then a ram.
fn whitworth() -> Description {
    Description::new()
        .joint("O", [0.0, 0.0])
        .joint("A", [1.0, 0.5])
        .joint("D", [0.0, -2.0])
        .joint("E", [2.0, 3.0])
        .joint("F", [-1.0, 3.5])
        .link("ground", ["O", "D"])
        .link("crank", ["O", "A"])
        .link("block", ["A"])
        .link("arm", ["D", "E"])
        .link("rod", ["E", "F"])
        .link("ram", ["F"])
        .slide("slot", "block", "arm", 2.5_f64.atan2(1.0), Some("D"))
        .slide("bed", "ram", "ground", PI, Some("O"))
        .driver("crank")
}

/// A four-bar, and a leg on a block that slides on its rocker.
fn block_on_rocker() -> Description {
    Description::new()
        .joint("O", [0.0, 0.0])
        .joint("A", [0.3, 0.2])
        .joint("B", [2.5, 2.0])
        .joint("C", [3.0, 0.0])
        .joint("G", [5.0, 1.0])
        .joint("H", [5.5, 3.0])
        .link("ground", ["O", "C", "H"])
        .link("crank", ["O", "A"])
        .link("coupler", ["A", "B"])
        .link("rocker", ["B", "C"])
        .link("leg", ["G", "H"])
        .link("block", ["G"])
        .slide("guide", "block", "rocker", 1.0_f64.atan2(2.0), Some("C"))
        .driver("crank")
}

fn scotch_yoke() -> Description {
    Description::new()
        .joint("O", [0.0, 0.0])
        .joint("A", [0.6, 0.8])
        .joint("Y", [2.0, 0.0])
        .link("ground", ["O"])
        .link("crank", ["O", "A"])
        .link("block", ["A"])
        .link("yoke", ["Y"])
        .slide("slot", "block", "yoke", FRAC_PI_2, Some("Y"))
        .slide("bed", "yoke", "ground", 0.0, Some("O"))
        .driver("crank")
}

fn mechanism(description: &Description) -> Mechanism {
    Mechanism::compile(description, Flat::Refused, None).unwrap_or_else(|error| panic!("{error}"))
}

/// Dimensions up to 1 % above those of the drawing.
fn dimensions(mechanism: &Mechanism, design: u32) -> Vec<f64> {
    let stretch = |place: usize| {
        let step = (design * 7 + u32::try_from(place).unwrap_or(0) * 3) % 101;
        1.0 + 1e-4 * f64::from(step)
    };
    mechanism.drawing().iter().enumerate().map(|(i, x)| x * stretch(i)).collect()
}

/// Solves a design at all positions.
fn solve(mechanism: &Mechanism, values: &[f64], derivatives: &DerivativeTables) -> Vec<State> {
    let mut design = Design::new(mechanism, mechanism.signs(), derivatives);
    design.bind(values);
    let q: Vec<f64> = (0..POSITIONS).map(|i| TAU * f64::from(i) / f64::from(POSITIONS)).collect();
    design.trace_knot_by_knot(&q);
    let at = |q: &f64| {
        let mut state = design.state(derivatives);
        let point = design.branch_to(&[*q]);
        design.solve(&mut state, &[*q], point.as_ref());
        state
    };
    q.iter().map(at).collect()
}

/// Whether a kernel solves one of its dyads or groups.
fn has_kernels(mechanism: &Mechanism) -> bool {
    let plan = mechanism.plan();
    let is_general = |op: &Op| matches!(op, Op::Dyad { .. } | Op::Group { .. } | Op::Place(_));
    !plan.tape.ops.iter().all(is_general) || plan.groups().any(|g| g.binary_loops.is_some())
}

/// The number of a dyad's kernel; a new one is tried, too.
fn kernel_of_dyad(op: &Op) -> Option<usize> {
    match op {
        Op::TwoLegs(_) => Some(0),
        Op::StandingGuide(_) => Some(1),
        Op::MovingGuide(_) => Some(2),
        Op::TurningGuide(_) => Some(3),
        Op::StandingGuides(_) => Some(4),
        Op::Dyad { .. }
        | Op::Place(_)
        | Op::Group { .. }
        | Op::Redundant { .. }
        | Op::Length { .. } => None,
    }
}

/// Asserts that two solutions of a position agree.
fn compare(name: &str, kernel: &State, general: &State) {
    assert_eq!(kernel.status, general.status, "{name}");
    if !matches!(kernel.status, Status::Ok | Status::NearSingular) {
        return;
    }
    let condition2 = kernel.conditions.greatest[0].max(general.conditions.greatest[0]);
    let points = |state: &State, k: usize| -> Vec<f64> {
        let jets = state.pose.points.chunks_exact(state.len);
        jets.flat_map(|jet| [jet[k][0].x, jet[k][0].y]).collect()
    };
    for k in 0..kernel.len {
        let (a, b) = (points(kernel, k), points(general, k));
        let size = a.iter().fold(1.0_f64, |size, x| size.max(x.abs()));
        let each = if k == 0 {
            CLOSURE_PER_CONDITION * condition2.sqrt()
        } else {
            ANALOGUE_PER_CONDITION_SQUARED * condition2
        };
        for (a, b) in a.iter().zip(&b) {
            assert!((a - b).abs() <= 2.0 * each * size, "{name}, order {k}: {a} and {b}");
        }
    }
}

#[test]
fn kernels_agree_with_the_general_formulas() {
    let derivatives = DerivativeTables::new(1, ORDER);
    let mut tried = [false; 5];
    for (name, description) in [
        ("two legs", FourBar::description(FourBarMode::Open)),
        ("standing guide", SliderCrank::description()),
        ("turning guide", whitworth()),
        ("moving guide", block_on_rocker()),
        ("standing guides", scotch_yoke()),
        ("two loops", triad_and_dyad()),
        ("three loops", class_iv()),
    ] {
        let kernels = mechanism(&description);
        let general = mechanism(&description).with_general_kernels();
        assert!(has_kernels(&kernels) && !has_kernels(&general), "{name}");
        for kernel in kernels.plan().tape.ops.iter().filter_map(kernel_of_dyad) {
            tried[kernel] = true;
        }
        let mut solved = 0;
        for design in 0..DESIGNS {
            let values = dimensions(&kernels, design);
            let pairs = solve(&kernels, &values, &derivatives).into_iter();
            for (a, b) in pairs.zip(solve(&general, &values, &derivatives)) {
                solved += usize::from(a.status == Status::Ok);
                compare(name, &a, &b);
            }
        }
        assert!(solved > 100, "{name}: {solved} positions");
    }
    assert_eq!(tried, [true; 5], "a kernel has no mechanism here");
}
