//! Stretches over which the dyads of a branch close, one dyad after another: roots of the squares of
//! their discriminants, which are known also where they do not close.

use std::f64::consts::PI;

use super::stretch::Stretch;
use crate::branch::design::Design;
use crate::math::angle::whole_part;
use crate::math::root::all_roots::{Sample, all_roots};
use crate::math::trig::sin_cos;
use crate::plan::dyad::{Dyad, Form};
use crate::plan::plan::Step;
use crate::state::state::{Context, State};

/// Nodes for each cell of the branch, and at least.
const NODES_PER_CELL: f64 = 2.0;
const LEAST_NODES: f64 = 48.0;
/// Rounding of a sample, relative to 1.
const NOISE: f64 = 1.0e-14;
/// Nearest node to the end of a stretch, as an angle: 5e-9 of its length.
const NEAR_END: f64 = 2.0e-4;
/// Step of a difference where the derivative is not known.
const DIFFERENCE: f64 = 1.0e-6;

/// A search on the branch of a design.
pub(super) struct Search<'d, 'm> {
    pub design: &'d Design<'m>,
    pub state: State,
    /// Width of a cell of the branch.
    pub cell: f64,
}

impl<'d> Search<'d, '_> {
    /// The parts of a stretch over which all dyads close.
    pub(super) fn stretches(&mut self, within: Stretch) -> Vec<Stretch> {
        let plan = self.design.mechanism.plan();
        let mut found = vec![within];
        for (step, of) in plan.steps.iter().enumerate() {
            if let &Step::Length { slide } = of {
                found = found.iter().flat_map(|one| self.lengths(*one, slide, step)).collect();
            }
            let Step::Dyad(dyad) = of else { continue };
            // Two guides never fold, but where they are parallel their point is at infinity.
            if dyad.sign.is_some() || dyad.form == Form::TwoLines {
                found = found.iter().flat_map(|one| self.parts(*one, dyad, step)).collect();
            }
        }
        found
    }

    /// The parts over which a dyad closes.
    fn parts(&mut self, within: Stretch, dyad: &Dyad, step: usize) -> Vec<Stretch> {
        let has_sign = dyad.form != Form::TwoLines;
        let parts = self.cut(within, dyad.sign, |search, q| search.sample(q, dyad, step));
        let closes = |search: &mut Self, part: &Stretch| {
            search.sample(middle_of(part), dyad, step).is_some_and(|[x, _]| x >= 0.0)
        };
        parts.into_iter().filter(|part| !has_sign || closes(self, part)).collect()
    }

    /// The parts over which the value of a slide that is a length is not negative.
    fn lengths(&mut self, within: Stretch, slide: usize, step: usize) -> Vec<Stretch> {
        let plan = self.design.mechanism.plan();
        let end = Some(plan.end_of_length(slide));
        if plan.driven_slide(0) == Some(slide) {
            return within.above(0.0, end).into_iter().collect();
        }
        let parts = self.cut(within, end, |search, q| search.length(q, slide, step));
        let exists = |search: &mut Self, part: &Stretch| {
            search.length(middle_of(part), slide, step).is_none_or(|[x, _]| x >= 0.0)
        };
        parts.into_iter().filter(|part| exists(self, part)).collect()
    }

    /// Cuts a stretch where a value changes its sign; `fold`: what folds there.
    fn cut(
        &mut self,
        within: Stretch,
        fold: Option<usize>,
        mut sample: impl FnMut(&mut Self, f64) -> Option<[f64; 2]>,
    ) -> Vec<Stretch> {
        let [from, to] = within.ends;
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        // Square roots at the ends, where earlier dyads are flat, are smooth in this angle.
        let at = |angle: f64| middle - half * sin_cos(angle).1;
        let count = (NODES_PER_CELL * 2.0 * half / self.cell).max(LEAST_NODES).ceil();
        let inner = PI - 2.0 * NEAR_END;
        let nodes: Vec<f64> =
            (0..=whole_part(count)).map(|node| NEAR_END + inner * node as f64 / count).collect();
        let roots = all_roots(&nodes, |angle| {
            let [value, rate] = sample(self, at(angle))?;
            let slope = rate * half * sin_cos(angle).0;
            let known = value.is_finite() && slope.is_finite();
            known.then_some(Sample { x: angle, value, slope, noise: NOISE })
        });
        let crossings = roots.isolated.iter().filter(|root| root.signs[0] != root.signs[1]);
        let mut ends: Vec<(f64, Option<usize>)> = vec![(from, within.folds[0])];
        ends.extend(crossings.map(|root| (at(root.at), fold)));
        ends.push((to, within.folds[1]));
        let part = |pair: &[(f64, Option<usize>)]| {
            let ((start, first), (end, last)) = (pair[0], pair[1]);
            Stretch { ends: [start, end], folds: [first, last] }
        };
        ends.windows(2).map(part).filter(|part| part.ends[0] < part.ends[1]).collect()
    }

    /// The value of a slide, and its derivative.
    fn length(&mut self, q: f64, slide: usize, step: usize) -> Option<[f64; 2]> {
        self.solve(q);
        if self.state.has_failed() && self.state.fault.is_none_or(|fault| fault.step() < step) {
            return None;
        }
        let jet = &self.state.pose.slides[slide * self.state.len..];
        Some([jet[0][0], jet[1][0]])
    }

    /// The square of a dyad's discriminant, and its derivative; of two guides the sine of the angle
    /// between them.
    fn sample(&mut self, q: f64, dyad: &Dyad, step: usize) -> Option<[f64; 2]> {
        let [value, rate] = self.value(q, dyad, step)?;
        if rate.is_nan() || dyad.form == Form::TwoLines {
            let [ahead, _] = self.value(q + DIFFERENCE, dyad, step)?;
            let [behind, _] = self.value(q - DIFFERENCE, dyad, step)?;
            return Some([value, (ahead - behind) / (2.0 * DIFFERENCE)]);
        }
        Some([value, rate])
    }

    /// The group above class II that folds at an end of the branch, as an index of the groups: just
    /// before it, at `q`, its condition is by far the greatest.
    pub(super) fn folding_group(&mut self, q: f64) -> Option<usize> {
        let cx = self.solve(q);
        let groups = cx.plan.groups().filter_map(|group| {
            let condition2 = self.state.own_condition2_of_group(&cx, group)?;
            Some((group.index, condition2)).filter(|_| condition2.is_finite())
        });
        groups.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(index, _)| index)
    }

    /// Solves a position of the branch.
    fn solve(&mut self, q: f64) -> Context<'d> {
        let Self { design, state, .. } = self;
        let branch = &design.branch;
        design.guess(0, state, branch, &branch.locate(q));
        let own = design.context(design.tracing_derivatives());
        let cx = Context { signs: branch.signs(q), ..own };
        state.solve(&cx, &[q]);
        cx
    }

    fn value(&mut self, q: f64, dyad: &Dyad, step: usize) -> Option<[f64; 2]> {
        let cx = self.solve(q);
        let state = &mut self.state;
        if state.has_failed() && state.fault.is_none_or(|fault| fault.step() < step) {
            return None;
        }
        let op = &cx.tape.ops[cx.tape.dyads[dyad.index]];
        let sample = state.sample(0, &cx, dyad, op);
        Some(if dyad.form == Form::TwoLines {
            [sample.side, f64::NAN]
        } else {
            [sample.square, sample.rate]
        })
    }
}

/// The middle of a stretch.
fn middle_of(part: &Stretch) -> f64 {
    0.5 * (part.ends[0] + part.ends[1])
}
