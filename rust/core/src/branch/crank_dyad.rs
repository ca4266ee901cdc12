//! A dyad on a crank and the ground: its change points follow from the extremes of one distance,
//! without solving a position.

use crate::plan::constants::DesignConstants;
use crate::plan::dyad::{Dyad, Form};
use crate::plan::plan::{EdgeSlide, Plan, Step};

/// A dyad that comes this near to flat at an extreme (relative to the sum of all lengths) is left to
/// the tracer: far above rounding, and far below what a design meets by chance.
const NEAR: f64 = 1.0e-9;

/// The attachment of a dyad to the pin of a crank and to the ground.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CrankDyad {
    /// Index of the dyad.
    dyad: usize,
    /// The crank's edge, and the fixed point about which it turns.
    crank: usize,
    pivot: usize,
    /// The dyad's fixed point; the crank's pin is its other one.
    ground: usize,
    /// The guide's edge, if there is one.
    guide: Option<usize>,
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
        let (crank, pivot) = plan.steps.iter().find_map(|step| match *step {
            Step::Place { edge, backward } => {
                let [from, to] = plan.edges[edge].ends(backward);
                let rigid = plan.edges[edge].along == EdgeSlide::Nothing;
                (to == pin && plan.fixed[from] && rigid).then_some((edge, from))
            }
            _ => None,
        })?;
        (plan.edges[crank].class == 0).then_some(Self {
            dyad: dyad.index,
            crank,
            pivot,
            ground,
            guide,
        })
    }

    /// Whether the dyad is nowhere near flat at the extremes, so that its sign never changes.
    pub(crate) fn keeps_sign(&self, constants: &DesignConstants) -> bool {
        let crank = constants.edge_vector[self.crank].norm();
        let frame = constants.fixed[self.ground] - constants.fixed[self.pivot];
        let [a, b] = &constants.legs[self.dyad];
        if let Some(guide) = self.guide {
            // The line of the far joint, and the distance of the crank's pin from it.
            let line = frame + constants.edge_vector[guide];
            let middle = constants.guide[guide].cross(line);
            let near = NEAR * (crank + middle.abs() + a.norm);
            let away = |extreme: f64| (extreme.abs() - a.norm).abs() > near;
            return away(middle + crank) && away(middle - crank);
        }
        // The distance between the crank's pin and the fixed point.
        let frame = frame.norm();
        let (longest, shortest) = (frame + crank, (frame - crank).abs());
        let near = NEAR * (longest + a.norm + b.norm);
        (longest - (a.norm + b.norm)).abs() > near
            && (shortest - (a.norm - b.norm).abs()).abs() > near
    }
}

/// The edge of the guide, if it stands still and nothing else turns or slides.
fn fixed_guide(plan: &Plan, dyad: &Dyad) -> Option<usize> {
    let [term] = dyad.others[..] else { return None };
    let edge = &plan.edges[term.edge];
    let still = edge.class == 0 && !plan.orientations[edge.orientation].driven;
    (still && term.slides == Some(1) && term.turns.is_none()).then_some(term.edge)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::mechanism::Mechanism;
    use crate::{Description, FourBar, FourBarMode};

    /// A slider-crank whose guide starts at a joint of its own, 30° from horizontal, `offset` beside
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
}
