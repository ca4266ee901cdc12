//! Analogues: derivatives of the closure equations, not of their solutions.
//!
//! Every closure is a sum of unit vectors times fixed ones, and the derivative of
//! a unit vector is `∂U = i U ∂Θ`; so at every order the unknown analogues stand in
//! the same matrix, and all the rest is known from lower orders (Uicker, Pennock
//! & Shigley 2017, chapters 3 and 4, by complex algebra). One function for all
//! dyads, all orders, any number of drivers.

use super::state::{Context, State};
use crate::plan::{Along, Dyad, Unknown};
use crate::plane::Vector;

impl State {
    /// Value and all analogues of an orientation from its class's.
    pub(crate) fn orient_class(&mut self, cx: &Context<'_>, o: usize) {
        self.orient[o * self.len] = self.class[cx.plan.orientations[o].class] * self.phase[o];
        for k in 1..self.len {
            let partial = self.orientation_without_top(cx, o, k);
            let top = self.theta_of(cx, o, k);
            self.orient[o * self.len + k] = partial + self.orient[o * self.len].left().scale(top);
        }
    }

    /// Analogue `k` of an orientation's angle.
    pub(crate) fn theta_of(&self, cx: &Context<'_>, o: usize, k: usize) -> f64 {
        let orientation = &cx.plan.orientations[o];
        let driven = cx.jets.driver_of(k).map_or(0.0, |d| f64::from(orientation.turns[d]));
        self.theta[orientation.class * self.len + k] + driven
    }

    /// Analogue `k` of an orientation but for the term in its angle's own `k`.
    pub(crate) fn orientation_without_top(&self, cx: &Context<'_>, o: usize, k: usize) -> Vector {
        let mut sum = Vector::ZERO;
        for term in &cx.jets.rotation[k] {
            let rate = self.theta_of(cx, o, term.right);
            sum += self.orient[o * self.len + term.left].scale(term.factor * rate);
        }
        sum.left()
    }

    /// Entry `k` of an edge's vector.
    pub(crate) fn edge(&self, cx: &Context<'_>, e: usize, k: usize) -> Vector {
        let edge = &cx.plan.edges[e];
        let unit = edge.orientation * self.len;
        let mut v = self.orient[unit + k] * cx.bound.rigid[e];
        if let Along::Slide(slide) | Along::Driver { slide, .. } = edge.along {
            let mut along = Vector::ZERO;
            for term in &cx.jets.product[k] {
                let s = self.slides[slide * self.len + term.right];
                along += self.orient[unit + term.left].scale(term.factor * s);
            }
            v += along * cx.bound.guide[e];
        }
        v
    }

    pub(crate) fn no_analogues(&mut self, dyad: &Dyad) {
        let len = self.len;
        for unknown in dyad.unknowns {
            let jet = match unknown {
                Unknown::Class(c) => &mut self.theta[c * len..(c + 1) * len],
                Unknown::Slide(s) => &mut self.slides[s * len..(s + 1) * len],
            };
            jet[1..].fill(f64::NAN);
        }
        for &o in dyad.turned.iter().flatten() {
            self.orient[o * len + 1..(o + 1) * len].fill(Vector::NAN);
        }
    }

    /// Analogues of a dyad's unknowns from its closure equation: at every order
    /// the same two columns, and as right-hand side what is known of that order.
    pub(crate) fn analogues(&mut self, cx: &Context<'_>, dyad: &Dyad) {
        let len = self.len;
        let columns = self.columns(cx, dyad);
        let determinant = columns[0].cross(columns[1]);
        for k in 1..len {
            for &o in dyad.turned.iter().flatten() {
                // The angle's own analogue is still 0 here.
                let partial = self.orientation_without_top(cx, o, k);
                let driven = self.theta_of(cx, o, k);
                self.orient[o * len + k] = partial + self.orient[o * len].left().scale(driven);
            }
            let known = self.closure(cx, dyad, k);
            let values =
                [columns[1].cross(known) / determinant, known.cross(columns[0]) / determinant];
            for ((unknown, value), turned) in
                dyad.unknowns.into_iter().zip(values).zip(&dyad.turned)
            {
                match unknown {
                    Unknown::Slide(s) => self.slides[s * len + k] = value,
                    Unknown::Class(c) => self.theta[c * len + k] = value,
                }
                for &o in turned {
                    let top = self.orient[o * len].left().scale(value);
                    self.orient[o * len + k] += top;
                }
            }
        }
    }

    /// Entry `k` of `P_start + Σ ±edges − P_end`.
    pub(crate) fn closure(&self, cx: &Context<'_>, dyad: &Dyad, k: usize) -> Vector {
        let mut sum = self.points[dyad.start * self.len + k] - self.points[dyad.end * self.len + k];
        for &(e, backward) in &dyad.path {
            let v = self.edge(cx, e, k);
            sum = if backward { sum - v } else { sum + v };
        }
        sum
    }

    /// Derivatives of the closure with respect to the unknowns.
    fn columns(&self, cx: &Context<'_>, dyad: &Dyad) -> [Vector; 2] {
        dyad.unknowns.map(|unknown| self.column(cx, dyad, unknown))
    }

    /// Determinant of the closure's matrix.
    pub(crate) fn determinant(&self, cx: &Context<'_>, dyad: &Dyad) -> f64 {
        let [first, second] = self.columns(cx, dyad);
        first.cross(second)
    }

    /// Derivative of the closure with respect to one unknown.
    fn column(&self, cx: &Context<'_>, dyad: &Dyad, unknown: Unknown) -> Vector {
        let mut sum = Vector::ZERO;
        for &(e, backward) in &dyad.path {
            let edge = &cx.plan.edges[e];
            let v = match unknown {
                Unknown::Class(c) if cx.plan.class_of(e) == c => self.edge(cx, e, 0).left(),
                Unknown::Slide(s) if edge.along == Along::Slide(s) => {
                    self.orient[edge.orientation * self.len] * cx.bound.guide[e]
                }
                _ => continue,
            };
            sum = if backward { sum - v } else { sum + v };
        }
        sum
    }
}
