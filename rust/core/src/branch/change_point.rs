//! Change points: where both solutions of a dyad meet and the smooth motion goes
//! from one to the other.
//!
//! The signed spread N of the dyad (sine between its legs, or its chord) crosses
//! zero there; computed with a fixed sign it touches zero from one side. N² is a
//! smooth function of q either way, so its least value, found from points at a
//! distance where nothing is singular, tells a change point (0, to rounding) from
//! a near miss (positive) and from a gap between two dead points (negative).

use super::knot::{ChangePoint, Knot, may_touch};
use super::tracer::BranchTracer;
use crate::math::tolerance::{
    CHANGE_CONDITION, CHANGE_SPREAD, CHANGE_STEP, REDUNDANT_CLOSURE, REDUNDANT_ROUNDING,
};
use crate::plan::dyad::Dyad;

impl BranchTracer<'_, '_> {
    /// Looks for the first change point between two knots and records it; the caller
    /// solves the second knot again with the new sign and asks once more.
    pub(crate) fn pass(&mut self, a: &Knot, b: &Knot) -> bool {
        let walker = self;
        for (place, (step, dyad)) in walker.dyads().enumerate() {
            let Some(sign) = dyad.sign else { continue };
            // A dyad beyond may close only with the sign that is yet to be found.
            if step >= a.solved.min(b.solved) {
                continue;
            }
            let here = |c: &ChangePoint| c.sign == sign && (c.at - a.at) * walker.way > 0.0;
            if walker.changes.iter().any(here) {
                continue;
            }
            let ((from, fall), (to, rise)) = (a.spread[place], b.spread[place]);
            if !may_touch((from, fall), (to, rise), b.at - a.at) {
                continue;
            }
            let Some((at, sure)) = locate(walker, (step, dyad), a.at, b.at) else { continue };
            // Beside the first knot it may be found on the other side, and would be found again and again.
            let least = (a.at.abs() * f64::EPSILON).max(f64::MIN_POSITIVE);
            let at = if (at - a.at) * walker.way > 0.0 { at } else { a.at + walker.way * least };
            let change = ChangePoint { at, sign };
            if sure || leads_through(walker, change, [a.at, b.at]) {
                walker.changes.push(change);
                return true;
            }
        }
        false
    }
}

/// How far behind the first of two knots redundant links are looked at, in cells: close to the change
/// point they fit on both branches.
const BEHIND: [f64; 3] = [1.0, 4.0, 16.0];

/// Whether redundant links fit behind a change point and not without it, so that they lead through.
fn leads_through(walker: &mut BranchTracer<'_, '_>, change: ChangePoint, [a, b]: [f64; 2]) -> bool {
    let before = walker.changes.len();
    for cells in BEHIND {
        let [with, without] = [&[change][..], &[]].map(|taken| {
            walker.changes.extend_from_slice(taken);
            // Also where something else is open, within a gap of another dyad.
            walker.state.fill_nan(&walker.cx);
            walker.solve(a + cells * (b - a));
            walker.changes.truncate(before);
            walker.state.redundant_links_fit(&walker.cx)
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
/// How near the middle of the six points must be to a change point, in steps: the
/// polynomials are then as good as their sixth power.
const NEAR_ENOUGH: f64 = 1e-6;

/// How often the six points are moved there, at most; twice that for what is not one to rounding.
const CENTRINGS: u32 = 3;

/// The change point between `a` and `b`, if there is one, and whether it is one to rounding: where
/// redundant links miss by what they may, so do the lengths that make a change point.
fn locate(
    walker: &mut BranchTracer<'_, '_>,
    (index, dyad): (usize, &Dyad),
    a: f64,
    b: f64,
) -> Option<(f64, bool)> {
    let (mut low, mut high) = (a, b);
    let step = CHANGE_STEP * (b - a);
    // Halving by the golden section keeps clear of the change point itself, which
    // likes to be in the middle.
    while (high - low).abs() > 4.0 * step.abs() {
        let middle = low + GOLDEN * (high - low);
        if walker.solve(middle) <= index {
            return None;
        }
        let (value, rate) = walker.spread(dyad);
        if rate.is_nan() {
            (low, high) = (middle - step, middle + step);
            break;
        }
        if value * rate * walker.way < 0.0 { low = middle } else { high = middle }
    }
    let redundant = walker.cx.plan.redundant_links().next().is_some();
    let strict = if redundant { REDUNDANT_ROUNDING } else { CHANGE_SPREAD };
    let mut centre = 0.5 * (low + high);
    for _ in 0..if redundant { 2 * CENTRINGS } else { CENTRINGS } {
        let fit = LocalFit::around(walker, (index, dyad), centre, step)?;
        let zero = fit.zero();
        let own = fit.before.min(CHANGE_CONDITION) * fit.shortness;
        let noise = strict * own;
        // In a small cell the zero is known no better than the spread there.
        let rise = fit.slope * step;
        if zero.abs() < NEAR_ENOUGH.max(noise / (rise * rise)) {
            let curved = (rise * zero) * (rise * zero);
            let sure = fit.least.abs() <= noise + curved;
            let maybe = redundant && fit.least.abs() <= REDUNDANT_CLOSURE * own + curved;
            return (sure || maybe).then_some((centre + zero * step, sure));
        }
        centre += zero.clamp(-4.0, 4.0) * step;
    }
    None
}

/// The spread on both sides of a point, as if it were a change point.
struct LocalFit {
    /// N at the centre, by an even polynomial through six points.
    value: f64,
    /// Its rate by the parameter.
    slope: f64,
    /// N² at the centre, likewise.
    least: f64,
    /// Greatest condition of what the dyad hangs on, at the points.
    before: f64,
    /// Greatest size by the length of a leg, there.
    shortness: f64,
    step: f64,
}

impl LocalFit {
    fn around(
        walker: &mut BranchTracer<'_, '_>,
        (index, dyad): (usize, &Dyad),
        centre: f64,
        step: f64,
    ) -> Option<Self> {
        let sign = dyad.sign?;
        let (mut n, mut square, mut odd) = ([0.0; 3], [0.0; 3], [0.0; 3]);
        let (mut before, mut shortness) = (1.0_f64, 1.0_f64);
        for (place, reach) in [1.0, 2.0, 3.0].into_iter().enumerate() {
            for side in [-1.0, 1.0] {
                if walker.solve(centre + side * reach * step) <= index {
                    return None;
                }
                let (value, _) = walker.spread(dyad);
                let value = value.abs() * side;
                n[place] += 0.5 * value;
                odd[place] += 0.5 * side * value / (reach * step);
                square[place] += 0.5 * value * value;
                let state = &*walker.state;
                before = before.max(state.upstream_condition2[sign][0].sqrt());
                shortness = shortness.max(state.length_ratio(&walker.cx, dyad));
            }
        }
        // Even polynomials through ±1, ±2, ±3 steps, at 0: weights 15, −6, 1 of 10.
        let at_zero = |e: [f64; 3]| (15.0 * e[0] - 6.0 * e[1] + e[2]) / 10.0;
        Some(Self {
            value: at_zero(n),
            slope: at_zero(odd),
            least: at_zero(square),
            before,
            shortness,
            step,
        })
    }

    /// Where N crosses zero, in steps from the centre.
    fn zero(&self) -> f64 {
        -self.value / (self.slope * self.step)
    }
}
