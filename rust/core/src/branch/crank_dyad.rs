//! A dyad on a crank and the ground: its change points, and whether it goes through a turn, follow from
//! the extremes of one distance, without solving a position.

use crate::math::vector::Vector;
use crate::plan::constants::{DesignConstants, DimensionMap, EdgeSource, read_two};
use crate::plan::dyad::{Dyad, Form};
use crate::plan::lengths::Slot;
use crate::plan::plan::{EdgeSlide, Orientation, Plan, Step};

/// A dyad nearer than this to flat at an extreme (relative to the sum of all lengths) is left to the tracer.
/// The bound is far above rounding, and few designs are this near by chance. It also holds for the square
/// of the sine between the legs: with legs of one length that is the square of the distance.
const NEAR: f64 = 1.0e-9;

/// The attachment of a dyad to the pin of a crank and to the ground.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CrankDyad {
    /// Index of the dyad.
    pub dyad: usize,
    /// The crank's edge, and whether it leads from the pin to the pivot.
    pub(super) crank: usize,
    backward: bool,
    /// The fixed point about which the crank turns.
    pub(crate) pivot: usize,
    /// The dyad's fixed point; the crank's pin is its other one.
    pub(crate) ground: usize,
    /// The guide's edge, if any, and whether it leads to the dyad's fixed point.
    guide: Option<(usize, bool)>,
}

impl CrankDyad {
    /// The attachment, if the dyad is of this kind.
    pub(crate) fn of(plan: &Plan, dyad: &Dyad) -> Option<Self> {
        let guide = match dyad.form {
            Form::TwoCircles if dyad.rrr_classes.is_some() => None,
            Form::CircleAndLine if dyad.leg[0] => Some(fixed_guide(plan, dyad)?),
            _ => return None,
        };
        let (pin, ground) = match [dyad.start, dyad.end].map(|point| plan.fixed[point]) {
            [false, true] => (dyad.start, dyad.end),
            [true, false] => (dyad.end, dyad.start),
            _ => return None,
        };
        let (crank, backward, pivot) = plan.steps.iter().find_map(|step| match *step {
            Step::Place { edge, backward } => {
                let [from, to] = plan.edges[edge].ends(backward);
                let rigid = plan.edges[edge].along == EdgeSlide::Nothing;
                (to == pin && plan.fixed[from] && rigid).then_some((edge, backward, from))
            }
            _ => None,
        })?;
        let guide = match guide.map(|edge| (edge, plan.edges[edge].ends(false))) {
            None => None,
            Some((edge, [from, _])) if from == ground => Some((edge, false)),
            Some((edge, [_, to])) if to == ground => Some((edge, true)),
            Some(_) => return None,
        };
        let Orientation { class, single_driver, .. } =
            &plan.orientations[plan.edges[crank].orientation];
        // A link whose angle slides hold may be pinned to the ground, too, but its pin stands still.
        (*class == 0 && single_driver.is_some()).then_some(Self {
            dyad: dyad.index,
            crank,
            backward,
            pivot,
            ground,
            guide,
        })
    }

    /// The direction of the guide, if any, and its distance from the crank's pivot, positive to
    /// the left of it.
    pub(crate) fn line(&self, constants: &DesignConstants) -> Option<(Vector, f64)> {
        let (edge, backward) = self.guide?;
        let frame = constants.fixed[self.ground] - constants.fixed[self.pivot];
        let vector = constants.edge_vector[edge];
        let guide = constants.guide[edge];
        Some((guide, guide.cross(if backward { frame - vector } else { frame + vector })))
    }

    /// Whether it has a guide.
    pub(crate) fn has_guide(&self) -> bool {
        self.guide.is_some()
    }

    /// The vector from the crank's pivot to its pin where the driver is at 0.
    pub(crate) fn arm(&self, constants: &DesignConstants) -> Vector {
        let edge = constants.edge_vector[self.crank];
        if self.backward { -edge } else { edge }
    }

    /// The crank's turns for each turn of the driver: 1, or −1 if it turns the opposite way.
    pub(crate) fn rate(&self, plan: &Plan) -> f64 {
        f64::from(plan.orientations[plan.edges[self.crank].orientation].turns[0])
    }

    /// Whether the dyad certainly does not close at one of the positions that go round in even steps
    /// (rad). If false, it may close or not.
    pub(crate) fn misses_position(&self, constants: &DesignConstants, step: f64) -> bool {
        let crank = self.arm(constants).norm();
        let frame = constants.fixed[self.ground] - constants.fixed[self.pivot];
        let [a, b] = &constants.legs[self.dyad];
        if let Some((_, middle)) = self.line(constants) {
            let near = NEAR * (crank + middle.abs() + a.norm);
            return middle.abs() + crank * (1.0 - squeeze(step)) > a.norm + near;
        }
        chord_misses(crank, frame.norm(), [a.norm, b.norm], step)
    }

    /// Whether the dyad is nowhere near flat at the extremes, so that its sign never changes.
    pub(crate) fn keeps_sign(&self, constants: &DesignConstants) -> bool {
        let crank = self.arm(constants).norm();
        let frame = constants.fixed[self.ground] - constants.fixed[self.pivot];
        let [a, b] = &constants.legs[self.dyad];
        if let Some((_, middle)) = self.line(constants) {
            let near = NEAR * (crank + middle.abs() + a.norm);
            let away = |extreme: f64| (extreme.abs() - a.norm).abs() > near;
            return away(middle + crank) && away(middle - crank);
        }
        // The distance between the crank's pin and the fixed point.
        let frame = frame.norm();
        let (longest, shortest) = (frame + crank, (frame - crank).abs());
        let near = NEAR * (longest + a.norm + b.norm);
        let cosine = |chord: f64| {
            (a.norm * a.norm + b.norm * b.norm - chord * chord) / (2.0 * a.norm * b.norm)
        };
        let is_flat = |chord: f64| (1.0 - cosine(chord).abs()).abs() <= NEAR;
        (longest - (a.norm + b.norm)).abs() > near
            && (shortest - (a.norm - b.norm).abs()).abs() > near
            && !is_flat(longest)
            && !is_flat(shortest)
    }
}

/// Greatest amount by which the cosine of the crank's angle to an extreme falls below 1: from the extreme to
/// the nearest position the crank turns by at most half a step, which bounds the cosine.
fn squeeze(step: f64) -> f64 {
    0.125 * step * step
}

/// Whether two legs certainly do not reach across the chord at one of the positions that go round in
/// even steps. The chord is between the pin of a crank and a point at the distance `frame` from its
/// pivot.
pub(super) fn chord_misses(crank: f64, frame: f64, legs: [f64; 2], step: f64) -> bool {
    let [a, b] = legs;
    let nearer = 2.0 * squeeze(step) * crank * frame;
    let (longest, shortest) = (frame + crank, frame - crank);
    let near = NEAR * (longest + a + b);
    let (longest_reach, shortest_reach) = (a + b + near, (a - b).abs() - near);
    longest * longest - nearer > longest_reach * longest_reach
        || shortest_reach > 0.0 && shortest * shortest + nearer < shortest_reach * shortest_reach
}

/// The edge of the guide, if it stands still and nothing else turns or slides.
fn fixed_guide(plan: &Plan, dyad: &Dyad) -> Option<usize> {
    let [term] = dyad.others[..] else { return None };
    let edge = &plan.edges[term.edge];
    let still = edge.class == 0 && !plan.orientations[edge.orientation].driven;
    (still && term.slides == Some(1) && term.turns.is_none()).then_some(term.edge)
}

/// Indices of the lengths of a dyad of two links on a crank and the ground in the list of dimensions: whether
/// it misses a position follows from these alone. Most designs of a random design space do not go through a
/// turn and do not need other constants.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CrankLengths {
    crank: [Slot; 2],
    /// The crank's pivot, and the dyad's fixed point.
    frame: [[Slot; 2]; 2],
    legs: [[Slot; 2]; 2],
}

impl CrankLengths {
    /// The lengths, if each is that of one vector from joint to joint.
    pub(super) fn of(crank: &CrankDyad, dyad: &Dyad, slots: &DimensionMap) -> Option<Self> {
        if crank.has_guide() {
            return None;
        }
        let vector = |edge: usize| match slots.edges[edge] {
            EdgeSource::Joint(slots) => Some(slots),
            EdgeSource::Guide(_) => None,
        };
        let fixed = |point: usize| {
            slots.ground.iter().find_map(|&(joint, at)| (joint + 1 == point).then_some(at))
        };
        let leg = |unknown| {
            let mut edges = dyad.path.iter().filter(|term| term.turns == Some(unknown));
            let only = edges.next().filter(|_| edges.next().is_none())?;
            vector(only.edge)
        };
        Some(Self {
            crank: vector(crank.crank)?,
            frame: [fixed(crank.pivot)?, fixed(crank.ground)?],
            legs: [leg(0)?, leg(1)?],
        })
    }

    /// See [`CrankDyad::misses_position`]; lengths whose squares leave the range of numbers miss nothing.
    pub(super) fn miss_position(&self, dimensions: &[f64], step: f64) -> bool {
        let read = |slots| read_two(dimensions, slots);
        let frame = (read(self.frame[1]) - read(self.frame[0])).norm();
        let legs = self.legs.map(|leg| read(leg).norm());
        chord_misses(read(self.crank).norm(), frame, legs, step)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use proptest::prelude::*;

    use super::*;
    use crate::branch::design::Design;
    use crate::math::derivatives::DerivativeTables;
    use crate::plan::mechanism::Mechanism;
    use crate::state::status::Status;
    use crate::{Coordinates, Description, FourBar, FourBarMode, Outputs, Request};

    /// A slider-crank whose guide starts at its own joint, 30° from horizontal, `offset` beside
    /// it.
    fn engine(rod: f64) -> Mechanism {
        let (sin, cos) = (0.5, 0.75_f64.sqrt());
        let joint =
            |along: f64, across: f64| [along * cos - across * sin, along * sin + across * cos];
        let pin = joint(0.6, 0.8);
        let far = joint(0.6 + (rod * rod - 0.04_f64).sqrt(), 1.0);
        let drawing = Description::new()
            .joint("A", [0.0, 0.0])
            .joint("B", pin)
            .joint("C", far)
            .joint("D", joint(-2.0, 0.3))
            .link("ground", ["A", "D"])
            .link("crank", ["A", "B"])
            .link("rod", ["B", "C"])
            .link("piston", ["C"])
            .slide("guide", "piston", "ground", std::f64::consts::FRAC_PI_6, Some("D"))
            .driver("crank");
        Mechanism::new(&drawing).unwrap_or_else(|error| panic!("{error}"))
    }

    fn keeps_sign(mechanism: &Mechanism, dimensions: &[f64]) -> bool {
        let plan = mechanism.plan();
        let dyad = plan.dyads().find_map(|dyad| CrankDyad::of(plan, dyad));
        let dyad = dyad.expect("a dyad on a crank");
        dyad.keeps_sign(&DesignConstants::new(mechanism.plan(), &mechanism.slots, dimensions))
    }

    #[test]
    fn four_bars_change_where_grashofs_sums_are_equal() {
        let mechanism = Mechanism::new(&FourBar::description(FourBarMode::Open))
            .unwrap_or_else(|error| panic!("{error}"));
        for (lengths, keeps) in [
            ([1.0, 3.0, 2.5, 3.2], true),
            ([1.0, 3.0, 2.0, 4.0], false),
            ([1.0, 3.0, 2.0, 4.000001], true),
            ([1.0, 4.0, 2.0, 3.0], false),
            ([1.0, 2.0, 1.0, 2.0], false),
            ([3.0, 1.0, 1.5, 2.0], true),
            // The crank's pin passes 1e-8 beside the rocker's pivot.
            ([2.000_000_01, 1.5, 1.5, 2.0], false),
            ([2.001, 1.5, 1.5, 2.0], true),
        ] {
            let [crank, coupler, rocker, ground] = lengths;
            let four_bar = FourBar { crank, coupler, rocker, ground, mode: FourBarMode::Open };
            assert_eq!(
                keeps_sign(&mechanism, &four_bar.dimensions(&mechanism)),
                keeps,
                "{lengths:?}"
            );
        }
    }

    /// The line of the far joint is 1 from the crank's pivot: change points with rods of 2 and 0.
    #[test]
    fn slider_cranks_change_where_the_rod_just_reaches() {
        for (rod, keeps) in [(2.0, false), (2.00001, true), (1.5, true), (3.0, true)] {
            let mechanism = engine(rod);
            assert_eq!(keeps_sign(&mechanism, mechanism.drawing()), keeps, "{rod}");
        }
    }

    const POSITIONS: [u32; 4] = [3, 8, 72, 361];

    /// Whether the design misses a position by its shape alone, and whether the solver fails at one of the
    /// positions.
    fn misses(drawing: &Description, stretch: &[f64], q: &[f64]) -> [bool; 2] {
        let mechanism = Mechanism::new(drawing).unwrap_or_else(|error| panic!("{error}"));
        let dimensions: Vec<f64> =
            mechanism.drawing().iter().zip(stretch.iter().cycle()).map(|(x, s)| x * s).collect();
        let derivatives = DerivativeTables::new(1, 0);
        let mut design = Design::new(&mechanism, mechanism.signs(), &derivatives);
        design.bind(&dimensions);
        let request = Request {
            dimensions: &dimensions,
            coordinates: Coordinates::Shared(q),
            signs: mechanism.signs(),
            order: 0,
            outputs: &Outputs::all(&mechanism),
        };
        let solved = mechanism.solve(&request).unwrap_or_else(|error| panic!("{error}"));
        let fails = solved.status.contains(&(Status::Unreachable as u8));
        let (tape, step) = (&mechanism.plan().tape, q[1] - q[0]);
        let lengths_miss = design.lengths_miss_position(tape, &dimensions, step);
        [lengths_miss || design.misses_position(tape, step), fails]
    }

    /// A crank-rocker turned in its frame, and an offset slider-crank with a tilted guide; each link
    /// listed either way round.
    fn drawings(turned: bool) -> [Description; 2] {
        let pair = |a, b| if turned { [b, a] } else { [a, b] };
        let common = Description::new().joint("A", [0.2, -0.1]).joint("B", [0.9, 0.6]);
        let four_bar = common
            .clone()
            .joint("C", [1.0, 3.5])
            .joint("D", [-1.5, 2.5])
            .link("ground", pair("A", "D"))
            .link("crank", pair("A", "B"))
            .link("coupler", pair("B", "C"))
            .link("rocker", pair("C", "D"))
            .driver("crank");
        let slider_crank = common
            .joint("C", [3.0, 2.0])
            .joint("D", [-1.0, 0.3])
            .link("ground", pair("A", "D"))
            .link("crank", pair("A", "B"))
            .link("rod", pair("B", "C"))
            .link("piston", ["C"])
            .slide("guide", "piston", "ground", 0.4, Some("D"))
            .driver("crank");
        [four_bar, slider_crank]
    }

    #[test]
    fn a_link_of_another_length_is_missed() {
        let q: Vec<f64> = (0..72).map(|k| TAU * f64::from(k) / 72.0).collect();
        for drawing in drawings(false) {
            for (crank, missed) in [(1.0, false), (3.0, true)] {
                let stretch = [crank, 1.0, 1.0, 1.0, 1.0, 1.0];
                assert_eq!(misses(&drawing, &stretch, &q), [missed; 2], "{drawing:?} {crank}");
            }
        }
    }

    proptest! {
        #[test]
        fn positions_that_are_missed_are_unreachable(
            stretch in prop::collection::vec(0.3_f64..2.0, 6),
            first in -7.0_f64..7.0,
            turned: bool,
            backward: bool,
            count in prop::sample::select(POSITIONS.to_vec()),
        ) {
            let turn = if backward { -TAU } else { TAU };
            let q: Vec<f64> =
                (0..count).map(|k| first + turn * f64::from(k) / f64::from(count)).collect();
            for drawing in drawings(turned) {
                let [missed, fails] = misses(&drawing, &stretch, &q);
                prop_assert!(fails || !missed, "{stretch:?} {first}");
            }
        }
    }
}
