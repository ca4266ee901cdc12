//! Redundant links and slides: placed by what the others give, then checked.

use super::state::{Context, Fault, State};
use crate::plan::{Along, Fit, Turned};
use crate::plane::Vector;
use crate::tolerance::{CLOSURE_PER_CONDITION, REDUNDANT_CLOSURE, REDUNDANT_GREATEST};

impl State {
    pub(crate) fn fit(&mut self, cx: &Context<'_>, fit: &Fit, index: usize) -> Result<(), Fault> {
        let mut gap = match &fit.turned {
            None => 0.0,
            Some(Turned::Joints { link, first, second, points }) => {
                let rigid = |edge: &Option<usize>| edge.map_or(Vector::ZERO, |e| cx.bound.rigid[e]);
                self.turn_by_joints(cx, *link, rigid(second) - rigid(first), *points)
            }
            Some(Turned::Slide { link, slide }) => {
                self.turn_by_slide(cx, *link, *slide);
                0.0
            }
        };
        for &(edge, backward) in &fit.places {
            self.place(cx, edge, backward);
        }
        for &edge in &fit.checks {
            gap = gap.max(self.misfit(cx, edge));
        }
        for &slide in &fit.parallel {
            gap = gap.max(self.angle_misfit(cx, slide));
        }
        let ends = |&e: &usize| [cx.plan.edges[e].edge.from, cx.plan.edges[e].edge.to];
        let touched = fit.checks.iter().chain(fit.places.iter().map(|(e, _)| e)).flat_map(ends);
        let own = match &fit.turned {
            Some(Turned::Joints { points, .. }) => *points,
            _ => [0, 0],
        };
        let condition = touched.chain(own).map(|p| self.point_condition[p]).fold(1.0, f64::max);
        let allowed =
            (CLOSURE_PER_CONDITION * condition).clamp(REDUNDANT_CLOSURE, REDUNDANT_GREATEST);
        if gap <= allowed { Ok(()) } else { Err(Fault::Misfit { step: index, gap }) }
    }

    /// Orientation from two joints that others carry; returns the misfit of
    /// their distance.
    fn turn_by_joints(
        &mut self,
        cx: &Context<'_>,
        link: usize,
        arm: Vector,
        points: [usize; 2],
    ) -> f64 {
        let len = self.len;
        let o = cx.plan.link_orientation[link];
        let span = |state: &Self, k: usize| {
            state.points[points[1] * len + k] - state.points[points[0] * len + k]
        };
        let chord = span(self, 0);
        let (length, distance) = (arm.norm(), chord.norm());
        let per = 1.0 / (length * distance);
        self.set_orientation(cx, o, (chord * arm.conj()).scale(per));
        for k in 1..len {
            // chord = U · arm at every order, were it not for rounding.
            let unit = (span(self, k) * arm.conj()).scale(1.0 / (length * length));
            let partial = self.orientation_without_top(cx, o, k);
            let rest = (unit - partial) * self.orient[o * len].conj();
            self.set_rate(cx, o, k, rest.y);
        }
        let condition = self.point_condition[points[0]].max(self.point_condition[points[1]]);
        self.class_condition[cx.plan.orientations[o].class] = condition;
        (distance - length).abs()
    }

    /// Orientation from a slide: the other link's, turned by a constant.
    fn turn_by_slide(&mut self, cx: &Context<'_>, link: usize, slide: usize) {
        let len = self.len;
        let o = cx.plan.link_orientation[link];
        let (other, constant) = cx.plan.across_slide(cx.bound, link, slide);
        let from = cx.plan.link_orientation[other];
        let value = self.orient[from * len] * constant;
        self.set_orientation(cx, o, value);
        for k in 1..len {
            let rate = self.theta_of(cx, from, k);
            self.set_rate(cx, o, k, rate);
        }
        self.class_condition[cx.plan.orientations[o].class] =
            self.class_condition[cx.plan.orientations[from].class];
    }

    fn set_orientation(&mut self, cx: &Context<'_>, o: usize, value: Vector) {
        let class = cx.plan.orientations[o].class;
        self.class[class] = value * self.phase[o].conj();
        self.orient[o * self.len] = value;
    }

    fn set_rate(&mut self, cx: &Context<'_>, o: usize, k: usize, rate: f64) {
        let class = cx.plan.orientations[o].class;
        self.theta[class * self.len + k] = rate;
        let partial = self.orientation_without_top(cx, o, k);
        self.orient[o * self.len + k] = partial + self.orient[o * self.len].left().scale(rate);
    }

    /// How far an edge misses its end; the slide along it takes its best value.
    fn misfit(&mut self, cx: &Context<'_>, e: usize) -> f64 {
        let len = self.len;
        let edge = cx.plan.edges[e];
        let (from, to, o) = (edge.edge.from * len, edge.edge.to * len, edge.orientation * len);
        if let Along::Slide(slide) = edge.along {
            for k in 0..len {
                // The span seen from the guide's link: conj(U) · ΔP, by Leibniz.
                let mut local = Vector::ZERO;
                for t in &cx.jets.product[k] {
                    let span = self.points[to + t.right] - self.points[from + t.right];
                    local += (span * self.orient[o + t.left].conj()).scale(t.factor);
                }
                if k == 0 {
                    local = local - cx.bound.rigid[e];
                }
                self.slides[slide * len + k] = local.dot(cx.bound.guide[e]);
            }
        }
        (self.points[to] - self.points[from] - self.edge(cx, e, 0)).norm()
    }

    /// How far two links miss their angle at a slide (a half turn: by 2).
    fn angle_misfit(&self, cx: &Context<'_>, slide: usize) -> f64 {
        let Some(e) = cx.plan.edges.iter().find(|e| e.along == Along::Slide(slide)) else {
            return 0.0;
        };
        let on = e.edge.link;
        let (link, constant) = cx.plan.across_slide(cx.bound, on, slide);
        let turned = self.orient[cx.plan.link_orientation[link] * self.len] * constant;
        let actual = self.orient[cx.plan.link_orientation[on] * self.len];
        (turned - actual).norm()
    }
}
