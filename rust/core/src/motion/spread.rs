//! How far a dyad is from flat, and polynomials through several states: what
//! change points are found and passed with.

use super::state::{Context, State};
use crate::plan::{Along, Dyad, Form, Unknown};
use crate::plane::Vector;

impl State {
    /// How far a dyad is from flat, with the sign of its assembly, and the rate of
    /// that by one driver (jet entry `first`): the sine of the angle between its legs (a rotation
    /// and a slide: the chord) as far as it matters near 0.
    pub(crate) fn spread(&self, cx: &Context<'_>, dyad: &Dyad, first: usize) -> (f64, f64) {
        let [a, da] = [0, first].map(|k| self.leg(cx, dyad, dyad.unknowns[0], k));
        let (value, rate, size) = match dyad.form {
            Form::TwoCircles => {
                let [b, db] = [0, first].map(|k| self.leg(cx, dyad, dyad.unknowns[1], k));
                (b.cross(a), db.cross(a) + b.cross(da), a.norm() * b.norm())
            }
            Form::CircleAndLine | Form::TurningGuide => {
                let [g, dg] = [0, first].map(|k| self.guide(cx, dyad, k));
                let sign = if dyad.form == Form::TurningGuide { 1.0 } else { -1.0 };
                let size = if dyad.form == Form::TurningGuide { 1.0 } else { a.norm() };
                (sign * g.dot(a), sign * (dg.dot(a) + g.dot(da)), size)
            }
            Form::TwoLines => (1.0, 0.0, 1.0),
        };
        (value / size, rate / size)
    }

    /// Entry `k` of the sum of a dyad's edges that turn with one unknown.
    fn leg(&self, cx: &Context<'_>, dyad: &Dyad, unknown: Unknown, k: usize) -> Vector {
        let mut sum = Vector::ZERO;
        for &(e, backward) in &dyad.path {
            if Unknown::Class(cx.plan.class_of(e)) == unknown {
                let v = self.edge(cx, e, k);
                sum = if backward { sum - v } else { sum + v };
            }
        }
        sum
    }

    /// Entry `k` of the direction of a dyad's unknown slide.
    fn guide(&self, cx: &Context<'_>, dyad: &Dyad, k: usize) -> Vector {
        let along = |e: usize| match cx.plan.edges[e].along {
            Along::Slide(s) => dyad.unknowns.contains(&Unknown::Slide(s)),
            _ => false,
        };
        let found = dyad.path.iter().find(|(e, _)| along(*e));
        found.map_or(Vector::ZERO, |&(e, backward)| {
            let v = self.orient[cx.plan.edges[e].orientation * self.len + k] * cx.bound.guide[e];
            if backward { -v } else { v }
        })
    }

    /// Becomes the weighted sum of other states of the same plan: a polynomial
    /// through them, evaluated between them.
    pub(crate) fn blend(&mut self, states: &[Self], weights: &[f64]) {
        fn sum(out: &mut [f64], states: &[State], weights: &[f64], of: impl Fn(&State) -> &[f64]) {
            for (i, x) in out.iter_mut().enumerate() {
                *x = states.iter().zip(weights).map(|(s, w)| w * of(s)[i]).sum();
            }
        }
        fn sums(
            out: &mut [Vector],
            states: &[State],
            weights: &[f64],
            of: impl Fn(&State) -> &[Vector],
        ) {
            for (i, x) in out.iter_mut().enumerate() {
                *x = Vector::ZERO;
                for (s, &w) in states.iter().zip(weights) {
                    *x += of(s)[i].scale(w);
                }
            }
        }
        sums(&mut self.points, states, weights, |s| &s.points);
        sums(&mut self.orient, states, weights, |s| &s.orient);
        sums(&mut self.class, states, weights, |s| &s.class);
        sum(&mut self.theta, states, weights, |s| &s.theta);
        sum(&mut self.slides, states, weights, |s| &s.slides);
    }
}
