//! Condition of each dyad and group on its own, and the amount by which the lengths of a dyad miss a change
//! point.
//!
//! The condition of a position is a product along a chain. It is large everywhere in a long chain,
//! so it does not show which single dyad is about to fold.

use super::state::{Context, State};
use crate::plan::dyad::{Dyad, Form, Unknown};
use crate::plan::group::Group;
use crate::plan::plan::{EdgeSlide, Step};

impl State {
    /// The step with the greatest condition of its own, and that condition; `None` without dyads
    /// and groups.
    pub(crate) fn worst_own_condition(&self, cx: &Context<'_>) -> Option<(usize, f64)> {
        let conditions = (0..cx.plan.steps.len())
            .filter_map(|step| Some((step, self.own_condition2(cx, step)?)));
        let worst = conditions.max_by(|a, b| a.1.total_cmp(&b.1))?;
        Some((worst.0, worst.1.sqrt()))
    }

    /// Square of the condition of a dyad or group on its own.
    pub(crate) fn own_condition2(&self, cx: &Context<'_>, step: usize) -> Option<f64> {
        match &cx.plan.steps[step] {
            Step::Dyad(dyad) => {
                let total = self.condition2_of(dyad.unknowns[0]);
                Some(total / self.upstream_of_dyad(cx, dyad))
            }
            Step::Group(group) => {
                let total = self.condition2_of(*group.unknowns.first()?);
                Some(total / self.upstream_of_group(cx, group))
            }
            _ => None,
        }
    }

    fn condition2_of(&self, unknown: Unknown) -> f64 {
        match unknown {
            Unknown::Class(class) => self.conditions.of_class[class][0],
            Unknown::Slide(slide) => self.conditions.of_slide[slide][0],
        }
    }

    /// Square of the condition of all that a dyad depends on.
    fn upstream_of_dyad(&self, cx: &Context<'_>, dyad: &Dyad) -> f64 {
        let ends = [dyad.start, dyad.end].map(|point| self.conditions.of_point[point][0]);
        let carried = dyad.others.iter().map(|term| {
            let class = cx.plan.class_of(term.edge);
            let turned =
                if term.turns.is_none() { self.conditions.of_class[class][0] } else { 1.0 };
            match (cx.plan.edges[term.edge].along, term.slides) {
                (EdgeSlide::Slide(slide), None) => turned.max(self.conditions.of_slide[slide][0]),
                _ => turned,
            }
        });
        carried.fold(ends[0].max(ends[1]), f64::max)
    }

    /// Square of the condition of all that a group depends on.
    fn upstream_of_group(&self, cx: &Context<'_>, group: &Group) -> f64 {
        let unknowns: Vec<Unknown> = group.all_unknowns().collect();
        let ends = group.loops.iter().flat_map(|l| [l.start, l.end]);
        let points = ends.map(|point| self.conditions.of_point[point][0]);
        let classes = group.edges.iter().map(|edge| cx.plan.class_of(edge.edge));
        let carried = classes
            .filter(|&class| !unknowns.contains(&Unknown::Class(class)))
            .map(|class| self.conditions.of_class[class][0]);
        points.chain(carried).fold(1.0, f64::max)
    }

    /// Difference between the sides of a dyad's triangle and those of a flat one, in units of the scale.
    pub(crate) fn flatness_gap(&self, cx: &Context<'_>, dyad: &Dyad) -> f64 {
        let a = self.leg_vector(0, cx, dyad, 0, 0);
        match dyad.form {
            Form::TwoCircles => {
                let b = self.leg_vector(0, cx, dyad, 1, 0);
                let (product, along, across) = (a.norm() * b.norm(), a.dot(b), a.cross(b));
                let third = (a + b).norm();
                // (|a| + |b|)² − c² or c² − (|a| − |b|)² is 2|a||b| (1 ∓ cos), and 1 ∓ cos is
                // sin² / (1 ± cos).
                let side = if along > 0.0 {
                    a.norm() + b.norm() + third
                } else {
                    third + (a.norm() - b.norm()).abs()
                };
                2.0 * across * across / ((product + along.abs()) * side)
            }
            Form::CircleAndLine | Form::TurningGuide => {
                let guide = self.slide_direction(0, cx, dyad, 1, 0);
                let (along, across) = (guide.dot(a), guide.cross(a));
                along * along / (a.norm() + across.abs())
            }
            Form::TwoLines => f64::INFINITY,
        }
    }
}
