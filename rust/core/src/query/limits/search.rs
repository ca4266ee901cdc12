//! Stretches over which the dyads of a branch close, one dyad after another: roots of the squares of
//! their discriminants, which are known also where they do not close.

use std::f64::consts::PI;

use super::chart::Chart;
use super::stretch::Stretch;
use crate::branch::design::Design;
use crate::math::angle::whole_part;
use crate::math::root::all_roots::{Sample, all_roots};
use crate::plan::dyad::{Dyad, Form};
use crate::plan::plan::Step;
use crate::query::folding::solve;
use crate::state::state::{Context, State};

/// Nodes for each cell of the branch, and the least number.
const NODES_PER_CELL: f64 = 2.0;
const LEAST_NODES: f64 = 48.0;
/// Rounding of a sample, relative to 1, for each unit of the condition of its terms.
const NOISE: f64 = 1.0e-14;
/// Nearest node to the end of a stretch, in u of the greater end: the end is not known better.
const NEAR_END_ULPS: f64 = 8.0;
/// An upper bound of the same as an angle, for a stretch of a few u.
const FARTHEST_NODE: f64 = 0.01;
/// Greatest distance (rad, or units of the scale) between a change point and the ends of a part beside it.
const BESIDE: f64 = 1.0e-9;
/// Where a part is examined, from 0 to 1: change points are often in its middle.
pub(super) const WITHIN: [f64; 3] = [0.3, 0.5, 0.8];
/// Step of a difference where the derivative is not known: at most, and as a part of the way to the end
/// of the stretch.
const DIFFERENCE: f64 = 1.0e-6;
const DIFFERENCE_TO_END: f64 = 0.5;

/// A value that must not be negative, its derivative and its rounding.
struct Sampled {
    value: f64,
    rate: f64,
    noise: f64,
}

/// A search on the branch of a design.
pub(super) struct Search<'d, 'm> {
    pub design: &'d Design<'m>,
    pub state: State,
    /// Width of a cell of the branch.
    pub cell: f64,
    /// How far from the drawing's coordinate cells have this width.
    pub core: f64,
}

impl<'d> Search<'d, '_> {
    /// The parts of a stretch over which all dyads close.
    pub(super) fn stretches(&mut self, within: Stretch) -> Vec<Stretch> {
        self.parts_of_dyads(within, usize::MAX)
    }

    /// The parts of a stretch over which the first dyad closes. It closes over one interval, or over
    /// some of them near the drawing: each further dyad may have gaps wherever another one ends.
    pub(super) fn stretches_of_first(&mut self, within: Stretch) -> Vec<Stretch> {
        self.parts_of_dyads(within, 1)
    }

    /// The parts of a stretch over which so many dyads close.
    fn parts_of_dyads(&mut self, within: Stretch, mut count: usize) -> Vec<Stretch> {
        let plan = self.design.mechanism.plan();
        let mut closing = vec![within];
        for (step, kind) in plan.steps.iter().enumerate() {
            if let &Step::Length { slide } = kind {
                closing = closing
                    .iter()
                    .flat_map(|stretch| self.lengths(*stretch, slide, step))
                    .collect();
            }
            let Step::Dyad(dyad) = kind else { continue };
            // Two guides never fold, but where they are parallel their point is at infinity.
            if dyad.sign.is_some() || dyad.form == Form::TwoLines {
                if count == 0 {
                    break;
                }
                count -= 1;
                closing =
                    closing.iter().flat_map(|stretch| self.parts(*stretch, dyad, step)).collect();
            }
        }
        closing
    }

    /// The parts over which a dyad closes.
    fn parts(&mut self, within: Stretch, dyad: &Dyad, step: usize) -> Vec<Stretch> {
        let has_sign = dyad.form != Form::TwoLines;
        let parts = self.cut(within, dyad.sign, |search, q| search.sample(q, within, dyad, step));
        let closes = |search: &mut Self, part: &Stretch| {
            is_positive(part, |q| search.value(q, dyad, step)).unwrap_or(false)
        };
        let closed = parts.into_iter().filter(|part| !has_sign || closes(self, part)).collect();
        self.joined_at_change_points(closed, dyad)
    }

    /// Joins parts between which the branch passes a change point of the dyad: there the square of its
    /// discriminant is less than 0 by rounding alone.
    fn joined_at_change_points(&self, parts: Vec<Stretch>, dyad: &Dyad) -> Vec<Stretch> {
        let mut joined: Vec<Stretch> = Vec::new();
        for part in parts {
            if let Some(last) = joined.last_mut() {
                let [from, to] = [last.ends[1], part.ends[0]];
                let reach = 0.5 * (to - from) + BESIDE;
                let change = self.design.branch.change_near(0.5 * (from + to), reach);
                if change.is_some_and(|(change, _)| dyad.sign == Some(change.sign)) {
                    (last.ends[1], last.folds[1]) = (part.ends[1], part.folds[1]);
                    continue;
                }
            }
            joined.push(part);
        }
        joined
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
            is_positive(part, |q| search.length(q, slide, step)).unwrap_or(true)
        };
        parts.into_iter().filter(|part| exists(self, part)).collect()
    }

    /// Cuts a stretch where a value changes its sign; `fold`: what folds there.
    fn cut(
        &mut self,
        within: Stretch,
        fold: Option<usize>,
        mut sample: impl FnMut(&mut Self, f64) -> Option<Sampled>,
    ) -> Vec<Stretch> {
        let [from, to] = within.ends;
        let chart = Chart::new(within.ends, self.design.q0[0], self.core);
        let nodes = self.nodes(within, &chart);
        let roots = all_roots(&nodes, |angle| {
            let sampled = sample(self, chart.at(angle))?;
            let slope = sampled.rate * chart.slope(angle);
            let finite = sampled.value.is_finite() && slope.is_finite();
            finite.then_some(Sample { x: angle, value: sampled.value, slope, noise: sampled.noise })
        });
        let crossings = roots.isolated.iter().filter(|root| root.signs[0] != root.signs[1]);
        // A change of sign is an end, also where the value beside it is more than its rounding.
        let places = crossings.map(|root| root.at).chain(roots.jumps);
        let mut inner: Vec<f64> = places.map(|angle| chart.at(angle)).collect();
        inner.sort_by(f64::total_cmp);
        let mut ends: Vec<(f64, Option<usize>)> = vec![(from, within.folds[0])];
        ends.extend(inner.into_iter().map(|end| (end, fold)));
        ends.push((to, within.folds[1]));
        let part = |pair: &[(f64, Option<usize>)]| {
            let ((start, first), (end, last)) = (pair[0], pair[1]);
            Stretch { ends: [start, end], folds: [first, last] }
        };
        ends.windows(2).map(part).filter(|part| part.ends[0] < part.ends[1]).collect()
    }

    /// Nodes of a search over a stretch, as angles: evenly, and the drawing, which is on the branch.
    fn nodes(&self, within: Stretch, chart: &Chart) -> Vec<f64> {
        let [from, to] = within.ends;
        let count = (NODES_PER_CELL * chart.length() / self.cell).max(LEAST_NODES).ceil();
        let nearest = NEAR_END_ULPS * f64::EPSILON * from.abs().max(to.abs());
        let near_end = (2.0 * nearest / (0.5 * (to - from))).sqrt().min(FARTHEST_NODE);
        let inner = PI - 2.0 * near_end;
        let mut nodes: Vec<f64> =
            (0..=whole_part(count)).map(|node| near_end + inner * node as f64 / count).collect();
        let drawing = chart.angle(self.design.q0[0]);
        if let Some(after) = nodes.iter().position(|&node| drawing <= node)
            && after > 0
            && drawing < nodes[after]
        {
            nodes.insert(after, drawing);
        }
        nodes
    }

    /// The value of a slide, and its derivative.
    fn length(&mut self, q: f64, slide: usize, step: usize) -> Option<Sampled> {
        self.solve(q)?;
        if self.fails_before(step) {
            return None;
        }
        let jet = &self.state.pose.slides[slide * self.state.len..];
        let condition2 = self.state.conditions.of_slide[slide][0];
        Some(Sampled { value: jet[0][0], rate: jet[1][0], noise: NOISE * condition2.sqrt() })
    }

    /// The square of a dyad's discriminant, and its derivative; for two guides the sine of the angle
    /// between them.
    fn sample(&mut self, q: f64, within: Stretch, dyad: &Dyad, step: usize) -> Option<Sampled> {
        let sampled = self.value(q, dyad, step)?;
        if !sampled.rate.is_nan() {
            return Some(sampled);
        }
        let to_end = (q - within.ends[0]).min(within.ends[1] - q);
        let aside = DIFFERENCE.min(DIFFERENCE_TO_END * to_end);
        let ahead = self.value(q + aside, dyad, step)?;
        let behind = self.value(q - aside, dyad, step)?;
        Some(Sampled { rate: (ahead.value - behind.value) / (2.0 * aside), ..sampled })
    }

    /// Solves a position of the branch, unless the search has been cancelled.
    fn solve(&mut self, q: f64) -> Option<Context<'d>> {
        (!self.design.is_cancelled()).then(|| solve(self.design, &mut self.state, q))
    }

    /// Whether the position just solved fails before a step.
    fn fails_before(&self, step: usize) -> bool {
        self.state.has_failed() && self.state.fault.is_none_or(|fault| fault.step() < step)
    }

    /// The same, its derivative only where it is known from the position.
    fn value(&mut self, q: f64, dyad: &Dyad, step: usize) -> Option<Sampled> {
        let cx = self.solve(q)?;
        if self.fails_before(step) {
            return None;
        }
        let state = &mut self.state;
        let op = &cx.tape.ops[cx.tape.dyads[dyad.index]];
        let sample = state.sample(0, &cx, dyad, op);
        let [start, end] = [dyad.start, dyad.end].map(|point| state.conditions.of_point[point][0]);
        let condition2 =
            dyad.sign.map_or(start.max(end), |sign| state.conditions.upstream[sign][0]);
        let noise = NOISE * condition2.sqrt();
        Some(if dyad.form == Form::TwoLines {
            Sampled { value: sample.side, rate: f64::NAN, noise }
        } else {
            Sampled { value: sample.square, rate: sample.rate, noise }
        })
    }
}

/// Whether a value that does not change its sign over a part is positive there, judged where it is greatest:
/// at a change point it touches zero. `None` if it has no value.
fn is_positive(part: &Stretch, mut value: impl FnMut(f64) -> Option<Sampled>) -> Option<bool> {
    let [from, to] = part.ends;
    let values = WITHIN.iter().filter_map(|&on| value(from + on * (to - from)));
    let greatest = values.max_by(|a, b| a.value.abs().total_cmp(&b.value.abs()));
    greatest.map(|sample| sample.value > 0.0)
}
