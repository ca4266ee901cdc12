//! Stretches over which a dyad on a crank and the ground closes, in closed form.
//!
//! The distance between the crank's pin and the rocker's pivot varies as the cosine of the
//! crank's angle from the ground line: shortest where they are in line on one side, longest on the other.
//! The dyad closes where it is between |a − b| and a + b. The distance of the pin from a standing guide
//! varies as a sine, and must not exceed the rod. (J. J. Uicker, G. R. Pennock, J. E. Shigley, *Theory
//! of Machines and Mechanisms*, 5th ed. 2017, ch. 1, Grashof's law.)

use std::f64::consts::{FRAC_PI_2, TAU};

use super::stretch::Stretch;
use crate::branch::crank_dyad::CrankDyad;
use crate::math::trig::asin;
use crate::plan::constants::DesignConstants;
use crate::plan::plan::Plan;

/// Where the sine of half the angle is 1 or 0 to rounding, the dyad is flat at a change point.
const TOUCH: f64 = 64.0 * f64::EPSILON;

/// Where a dyad closes.
enum Reach {
    Nowhere,
    /// From the first to the second angle from the middle, both ways; `None`: no limit.
    Between {
        middle: f64,
        nearest: Option<f64>,
        farthest: Option<f64>,
    },
}

/// Stretches over which the dyad closes; `None` if its crank has no length.
pub(crate) fn crank_stretches(
    dyad: &CrankDyad,
    plan: &Plan,
    constants: &DesignConstants,
    sign: usize,
) -> Option<Vec<Stretch>> {
    let Reach::Between { middle, nearest, farthest } = reach(dyad, plan, constants)? else {
        return Some(Vec::new());
    };
    let fold = Some(sign);
    let stretch =
        |from: f64, to: f64| Stretch { ends: [middle + from, middle + to], folds: [fold; 2] };
    Some(match (nearest, farthest) {
        (None, None) => vec![Stretch::WHOLE],
        (None, Some(far)) => vec![stretch(-far, far)],
        (Some(near), None) => vec![stretch(near, TAU - near)],
        (Some(near), Some(far)) => vec![stretch(-far, -near), stretch(near, far)],
    })
}

/// `None` if the crank has no length.
fn reach(dyad: &CrankDyad, plan: &Plan, constants: &DesignConstants) -> Option<Reach> {
    let arm = dyad.arm(constants);
    let frame = constants.fixed[dyad.ground] - constants.fixed[dyad.pivot];
    let [a, b] = &constants.legs[dyad.dyad];
    let radius = arm.norm();
    // Squares of the sines of half the angles at which the dyad is flat.
    let (direction, [outer, inner]) = if let Some((guide, middle)) = dyad.line(constants) {
        let half = |rod: f64| (radius - middle + rod) / (2.0 * radius);
        (guide.angle() + FRAC_PI_2, [half(a.norm), half(-a.norm)])
    } else {
        let ground = frame.norm();
        let half = |chord: f64| {
            (chord - ground + radius) * (chord + ground - radius) / (4.0 * ground * radius)
        };
        (frame.angle(), [half(a.norm + b.norm), half((a.norm - b.norm).abs())])
    };
    if !(outer.is_finite() && inner.is_finite()) {
        return None;
    }
    // Flat in its only position, it has no motion there.
    if outer < TOUCH || inner > 1.0 - TOUCH {
        return Some(Reach::Nowhere);
    }
    let angle = |half: f64| 2.0 * asin(half.sqrt());
    Some(Reach::Between {
        middle: dyad.rate(plan) * (direction - arm.angle()),
        nearest: (inner > TOUCH).then(|| angle(inner)),
        farthest: (outer < 1.0 - TOUCH).then(|| angle(outer)),
    })
}
