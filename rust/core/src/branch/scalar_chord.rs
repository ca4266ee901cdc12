//! With several drivers: which dyads can meet change points on a path through the coordinates.
//!
//! A dyad has a change point where the length of its chord has an extreme at which it is flat. If
//! one end of the chord moves over an area as seen from every body that is known before the dyad,
//! extremes are single points of the coordinates, which a path meets only by chance; beside them
//! nothing changes. If it moves along a curve, as a joint of the next body does, the length depends
//! on one scalar, and paths in every direction lead through its extremes.

use crate::plan::dyad::{Dyad, Unknown};
use crate::plan::plan::{Plan, Step};
use crate::state::state::{Context, State};
use crate::state::status::{Fault, Status};

/// Offsets from the drawing (rad, or units of the scale) at which chords are examined: the drawing
/// itself may be special, arbitrary offsets hardly are.
const OFFSETS: [f64; 3] = [0.0, 0.0437, -0.0713];
/// Area (of the size², per product of both coordinates) below which the end of a chord moves along
/// a curve: far above rounding.
const CURVE: f64 = 1.0e-8;

/// For every sign, whether its dyad can pass change points in a design: with one driver, all. `q0`:
/// the drawing's coordinates; `state`: work space for first analogues.
pub(super) fn may_change(cx: &Context<'_>, state: &mut State, q0: &[f64]) -> Vec<bool> {
    let mut may_change = vec![true; cx.plan.signs()];
    if q0.len() == 1 || !cx.plan.has_closed_forms() {
        return may_change;
    }
    for offset in OFFSETS {
        let moved = |(driver, &q): (usize, &f64)| q + offset / (1.0 + driver as f64 / 3.0);
        let q: Vec<f64> = q0.iter().enumerate().map(moved).collect();
        state.solve(cx, &q);
        // The chord of a dyad that does not close is still known.
        let last = match (state.status, state.fault) {
            (Status::Ok | Status::NearSingular, _) => usize::MAX,
            (Status::Unreachable, Some(Fault::NotClosed { step, .. })) => step,
            _ => continue,
        };
        let mut is_known = vec![false; cx.plan.classes];
        is_known[0] = true;
        for (step, what) in cx.plan.steps.iter().enumerate() {
            let Step::Dyad(dyad) = what else { continue };
            if step > last {
                break;
            }
            if let Some(sign) = dyad.sign {
                let mut links = (0..cx.plan.rotation.len())
                    .filter(|&link| is_known[cx.plan.rotation[link].class]);
                may_change[sign] &=
                    links.any(|link| greatest_area(state, cx.plan, dyad, link, q0.len()) < CURVE);
            }
            for unknown in dyad.unknowns {
                if let Unknown::Class(class) = unknown {
                    is_known[class] = true;
                }
            }
        }
        if !may_change.contains(&true) {
            break;
        }
    }
    may_change
}

/// The greatest area that the end of a dyad's chord moves over by two drivers, as seen from a link
/// that carries its start.
fn greatest_area(state: &State, plan: &Plan, dyad: &Dyad, link: usize, drivers: usize) -> f64 {
    let len = state.len;
    let rotation = &plan.rotation[link];
    let chord = |k: usize| {
        state.pose.points[dyad.end * len + k][0] - state.pose.points[dyad.start * len + k][0]
    };
    let motion = |driver: usize| {
        let rate = state.pose.theta[rotation.class * len + 1 + driver][0];
        let turn = rate + f64::from(rotation.turns[driver]);
        chord(1 + driver) - chord(0).left().scale(turn)
    };
    let mut greatest = 0.0_f64;
    for a in 0..drivers {
        for b in 0..a {
            greatest = greatest.max(motion(a).cross(motion(b)).abs());
        }
    }
    greatest
}

#[cfg(test)]
mod tests {
    use crate::Description;
    use crate::plan::mechanism::Mechanism;

    fn drawn(drawing: &Description) -> Vec<bool> {
        let mechanism = Mechanism::new(drawing).unwrap_or_else(|error| panic!("{error}"));
        mechanism.plan().may_change.clone()
    }

    /// Two cranks and the dyad between them; G is fixed.
    fn five_bar() -> Description {
        Description::new()
            .joint("A", [0.0, 0.0])
            .joint("B", [-0.5, 1.2])
            .joint("C", [1.2, 2.6])
            .joint("D", [2.9, 1.3])
            .joint("E", [2.4, 0.0])
            .link("crank", ["A", "B"])
            .link("left", ["B", "C"])
            .link("right", ["C", "D"])
            .link("other", ["E", "D"])
    }

    #[test]
    fn a_dyad_between_two_driven_cranks_passes_none() {
        let two = five_bar().link("ground", ["A", "E"]).driver("crank").driver("other");
        assert_eq!(drawn(&two), [false]);
    }

    /// A hand on an arm, both driven, with a dyad from the hand to a joint of `base`.
    fn hand_and_dyad(base: [&str; 2], at: [f64; 2]) -> Vec<bool> {
        let [carrier, joint] = base;
        let link = |name: &'static str, joints: Vec<&'static str>| (name, joints);
        let links = [link("ground", vec!["A"]), link("arm", vec!["A", "B"])];
        let mut drawing = Description::new()
            .joint("A", [0.0, 0.0])
            .joint("B", [-0.5, 1.2])
            .joint("C", [1.2, 2.6])
            .joint("D", [2.1, 1.5])
            .link("hand", ["B", "C"])
            .link("rod", ["C", "D"])
            .link("rocker", [joint, "D"])
            .driver("arm")
            .driver("hand");
        if joint != "A" {
            drawing = drawing.joint(joint, at);
        }
        for (name, joints) in links {
            let more = (name == carrier && joint != "A").then_some(joint);
            drawing = drawing.link(name, joints.into_iter().chain(more));
        }
        drawn(&drawing)
    }

    #[test]
    fn a_dyad_whose_chord_spans_one_driven_joint_may() {
        // E on the arm, and A, which is on it too: the chord depends on the elbow alone.
        assert_eq!(hand_and_dyad(["arm", "E"], [0.9, 0.7]), [true]);
        assert_eq!(hand_and_dyad(["ground", "A"], [0.0, 0.0]), [true]);
        // E on the ground: on both angles.
        assert_eq!(hand_and_dyad(["ground", "E"], [0.9, 0.7]), [false]);
    }
}
