//! Change points: where both solutions of a dyad meet and the smooth motion goes from one to the
//! other.
//!
//! The discriminant N of the dyad (sine of the angle between its legs, or its chord) crosses zero
//! there; with a fixed assembly sign it touches zero from one side. N² is a smooth function of q in
//! both cases. Its minimum, found from points far enough away to be regular, distinguishes a change
//! point (zero, to rounding) from a near miss (positive) and from a gap between two dead points
//! (negative).

use super::knot::{ChangePoint, Knot, may_vanish};
use super::tracer::BranchTracer;
use crate::math::tolerance::{
    CHANGE_CONDITION, CHANGE_DISCRIMINANT, CHANGE_STEP, REDUNDANT_CLOSURE, REDUNDANT_ROUNDING,
};
use crate::plan::dyad::Dyad;

impl BranchTracer<'_, '_> {
    /// Finds the first change point between two knots and records it. The caller then solves the
    /// second knot again with the new sign and calls again.
    pub(crate) fn detect(&mut self, a: &Knot, b: &Knot) -> bool {
        let tracer = self;
        for (index, (step, dyad)) in tracer.dyads().enumerate() {
            let Some(sign) = dyad.sign else { continue };
            if dyad.is_length || !tracer.cx.constants.may_change[sign] {
                continue;
            }
            // A later dyad may close only with the sign that is yet to be found.
            if step >= a.solved.min(b.solved) {
                continue;
            }
            let is_recorded =
                |c: &ChangePoint| c.sign == sign && (c.at - a.at) * tracer.direction > 0.0;
            if tracer.changes.iter().any(is_recorded) {
                continue;
            }
            let ((from, fall), (to, rise)) = (a.discriminants[index], b.discriminants[index]);
            if !may_vanish((from, fall), (to, rise), b.at - a.at) {
                continue;
            }
            let Some((at, certain)) = locate(tracer, (step, dyad), a.at, b.at) else { continue };
            // Rounding may put it on the wrong side of the first knot, where the search would find it for
            // ever.
            let smallest = (a.at.abs() * f64::EPSILON).max(f64::MIN_POSITIVE);
            let at = if (at - a.at) * tracer.direction > 0.0 {
                at
            } else {
                a.at + tracer.direction * smallest
            };
            let change = ChangePoint { at, sign };
            let passed = certain && tracer.is_assembled_beside(at);
            if passed || redundant_links_confirm(tracer, change, [a.at, b.at]) {
                tracer.changes.push(change);
                return true;
            }
        }
        false
    }

    /// Whether the whole mechanism closes right beside a change point, with either sign of its dyad. If
    /// not, the change point lies in a gap. The assembly does not change across it, for any order in which
    /// the dyads are solved.
    fn is_assembled_beside(&mut self, at: f64) -> bool {
        // The other side with this sign corresponds to this side with the other sign.
        self.visit(at - BESIDE) || self.visit(at + BESIDE)
    }
}

/// Distance (rad, or units of the scale) from a change point at which the mechanism is solved to see
/// whether it closes: the dyad's own discriminant is known there to half of the digits.
const BESIDE: f64 = 1.0e-6;

/// Distance past the first knot at which redundant links are checked, in cells: close to the change point
/// they fit on both branches.
const CELLS_BEHIND: [f64; 3] = [1.0, 4.0, 16.0];

/// Whether redundant links fit past a change point with the new sign and not with the old one.
fn redundant_links_confirm(
    tracer: &mut BranchTracer<'_, '_>,
    change: ChangePoint,
    [a, b]: [f64; 2],
) -> bool {
    let count = tracer.changes.len();
    for cells in CELLS_BEHIND {
        let [with, without] = [&[change][..], &[]].map(|taken| {
            tracer.changes.extend_from_slice(taken);
            // Also in a gap of another dyad, where some steps cannot be solved.
            tracer.state.fill_nan(&tracer.cx);
            tracer.solve(a + cells * (b - a));
            tracer.changes.truncate(count);
            tracer.state.redundant_links_fit(&tracer.cx)
        });
        if let (Some(with), Some(without)) = (with, without)
            && with != without
        {
            return with;
        }
    }
    false
}

/// The smaller part of the golden section.
const GOLDEN: f64 = 0.381_966_011_250_105;
/// Greatest distance of the middle of the six points from a change point, in steps: the polynomials are
/// then accurate to the sixth power of the step.
const NEAR_ENOUGH: f64 = 1e-6;

/// Most times that the six points are centred; twice that with redundant links.
const MAX_CENTRINGS: u32 = 3;

/// The change point between `a` and `b`, if any, and whether it is exact to rounding. Where redundant links
/// may miss by a tolerance, the lengths that make a change point may miss too.
fn locate(
    tracer: &mut BranchTracer<'_, '_>,
    (step_index, dyad): (usize, &Dyad),
    a: f64,
    b: f64,
) -> Option<(f64, bool)> {
    let (mut low, mut high) = (a, b);
    let step = CHANGE_STEP * (b - a);
    // Bisection of the slope of N² at the golden section, not in the middle: the change point itself,
    // where the slope is undefined, is often there.
    while (high - low).abs() > 4.0 * step.abs() {
        let middle = low + GOLDEN * (high - low);
        if tracer.solve(middle) <= step_index {
            return None;
        }
        let (value, rate) = tracer.discriminant(dyad);
        if rate.is_nan() {
            (low, high) = (middle - step, middle + step);
            break;
        }
        if value * rate * tracer.direction < 0.0 { low = middle } else { high = middle }
    }
    let redundant = tracer.cx.plan.redundant_links().next().is_some();
    let strict = if redundant { REDUNDANT_ROUNDING } else { CHANGE_DISCRIMINANT };
    let mut centre = 0.5 * (low + high);
    for _ in 0..if redundant { 2 * MAX_CENTRINGS } else { MAX_CENTRINGS } {
        let fit = LocalFit::around(tracer, (step_index, dyad), centre, step)?;
        let zero = fit.zero();
        let closure = fit.upstream_condition.min(CHANGE_CONDITION) * fit.length_ratio;
        let noise = strict * closure;
        // In a small cell the zero is known only as well as the discriminant.
        let rise = fit.slope * step;
        if zero.abs() < NEAR_ENOUGH.max(noise / (rise * rise)) {
            let curved = (rise * zero) * (rise * zero);
            let certain = fit.square.abs() <= noise + curved;
            let possible = redundant && fit.square.abs() <= REDUNDANT_CLOSURE * closure + curved;
            return (certain || possible).then_some((centre + zero * step, certain));
        }
        centre += zero.clamp(-4.0, 4.0) * step;
    }
    None
}

/// The discriminant on both sides of a point, treated as a change point.
struct LocalFit {
    /// N at the centre, by an even polynomial through six points.
    value: f64,
    /// Derivative of N by the parameter.
    slope: f64,
    /// N² at the centre, by the same polynomial.
    square: f64,
    /// Greatest condition upstream of the dyad, at the six points.
    upstream_condition: f64,
    /// Greatest ratio of the triangle's size to its shortest leg, at the six points.
    length_ratio: f64,
    step: f64,
}

impl LocalFit {
    fn around(
        tracer: &mut BranchTracer<'_, '_>,
        (step_index, dyad): (usize, &Dyad),
        centre: f64,
        step: f64,
    ) -> Option<Self> {
        let sign = dyad.sign?;
        let (mut n, mut square, mut odd) = ([0.0; 3], [0.0; 3], [0.0; 3]);
        let (mut upstream_condition, mut length_ratio) = (1.0_f64, 1.0_f64);
        for (index, offset) in [1.0, 2.0, 3.0].into_iter().enumerate() {
            for side in [-1.0, 1.0] {
                if tracer.solve(centre + side * offset * step) <= step_index {
                    return None;
                }
                let (value, _) = tracer.discriminant(dyad);
                let value = value.abs() * side;
                n[index] += 0.5 * value;
                odd[index] += 0.5 * side * value / (offset * step);
                square[index] += 0.5 * value * value;
                let state = &*tracer.state;
                upstream_condition =
                    upstream_condition.max(state.conditions.upstream[sign][0].sqrt());
                length_ratio = length_ratio.max(state.length_ratio(&tracer.cx, dyad));
            }
        }
        // Even polynomials through ±1, ±2, ±3 steps, at 0: weights 15, −6, 1 over 10.
        let at_zero = |e: [f64; 3]| (15.0 * e[0] - 6.0 * e[1] + e[2]) / 10.0;
        Some(Self {
            value: at_zero(n),
            slope: at_zero(odd),
            square: at_zero(square),
            upstream_condition,
            length_ratio,
            step,
        })
    }

    /// Where N crosses zero, in steps from the centre.
    fn zero(&self) -> f64 {
        -self.value / (self.slope * self.step)
    }
}
