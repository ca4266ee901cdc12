//! Analogues, from derivatives of the closure equations.
//!
//! Every closure is a sum of unit vectors times constant ones, and the derivative of a unit vector
//! is `∂U = i U ∂Θ`. So the unknown analogues of every order have the same matrix, and the
//! right-hand side follows from lower orders (Uicker, Pennock & Shigley 2017, chapters 3 and 4, by
//! complex algebra). The same functions serve all dyads, all orders and any number of drivers.

use crate::math::lanes::Real;
use crate::math::vector::Vector;
use crate::plan::dyad::{Dyad, LoopTerm, Unknown};
use crate::plan::plan::EdgeSlide;
use crate::state::state::{Context, State};

impl<R: Real, const G: usize> State<R, G> {
    /// Value and analogues of an orientation that only the drivers turn: `∂U = i U` times its
    /// multiple of the driver.
    #[inline(always)]
    pub(crate) fn set_driven_orientation(
        &mut self,
        g: usize,
        cx: &Context<'_>,
        o: usize,
        phase: Vector<R>,
    ) {
        let orientation = &cx.plan.orientations[o];
        let jet = &mut self.pose.orient[o * self.len..][..self.len];
        jet[0][g] = phase;
        if let (1, Some((_, backward))) = (cx.derivatives.drivers, orientation.single_driver) {
            let mut last = phase;
            for entry in &mut jet[1..] {
                last = if backward { -last.left() } else { last.left() };
                entry[g] = last;
            }
            return;
        }
        for k in 1..self.len {
            let (driver, lower) = cx.derivatives.lowered[k];
            let turns = R::splat(f64::from(orientation.turns[driver]));
            jet[k][g] = jet[lower][g].left().scale(turns);
        }
    }

    /// Contribution of the drivers to analogue `k` of an orientation's angle.
    #[inline(always)]
    pub(crate) fn driver_analogue(cx: &Context<'_>, o: usize, k: usize) -> R {
        let turns = &cx.plan.orientations[o].turns;
        R::splat(if let Some(driver) = cx.derivatives.driver_of[k] {
            f64::from(turns[driver])
        } else {
            0.0
        })
    }

    /// Analogue `k` of an orientation's angle.
    #[inline(always)]
    pub(crate) fn angle_analogue(&self, g: usize, cx: &Context<'_>, o: usize, k: usize) -> R {
        let orientation = &cx.plan.orientations[o];
        let rate = self.pose.theta[orientation.class * self.len + k][g];
        if orientation.driven { rate + Self::driver_analogue(cx, o, k) } else { rate }
    }

    /// Analogue `k` of an orientation, without the term in analogue `k` of its class.
    #[inline(always)]
    pub(crate) fn orientation_without_top(
        &self,
        g: usize,
        cx: &Context<'_>,
        o: usize,
        k: usize,
    ) -> Vector<R> {
        let mut sum = Vector::ZERO;
        for term in &cx.derivatives.rotation[k] {
            let rate = R::splat(term.factor) * self.angle_analogue(g, cx, o, term.right);
            sum += self.pose.orient[o * self.len + term.left][g].scale(rate);
        }
        if cx.plan.orientations[o].driven {
            sum += self.pose.orient[o * self.len][g].scale(Self::driver_analogue(cx, o, k));
        }
        sum.left()
    }

    /// Entry `k` of an edge's vector.
    #[inline(always)]
    pub(crate) fn edge(&self, g: usize, cx: &Context<'_>, e: usize, k: usize) -> Vector<R> {
        let edge = &cx.plan.edges[e];
        if let Some(leg) = edge.leg {
            let v = self.pose.legs[leg.index * self.len + k][g];
            return if leg.backward { -v } else { v };
        }
        let edge_vector = self.pose.orient[edge.orientation * self.len + k][g]
            * Vector::splat(cx.constants.edge_vector[e]);
        match edge.along {
            EdgeSlide::Nothing => edge_vector,
            EdgeSlide::Slide(slide) | EdgeSlide::Driver { slide } => {
                edge_vector + self.along(g, cx, e, slide, k)
            }
        }
    }

    /// Entry `k` of the part of an edge's vector along its slide.
    #[inline(always)]
    fn along(&self, g: usize, cx: &Context<'_>, e: usize, slide: usize, k: usize) -> Vector<R> {
        let unit = cx.plan.edges[e].orientation * self.len;
        let mut along = Vector::ZERO;
        for term in &cx.derivatives.product[k] {
            let s = R::splat(term.factor) * self.pose.slides[slide * self.len + term.right][g];
            along += self.pose.orient[unit + term.left][g].scale(s);
        }
        along * Vector::splat(cx.constants.guide[e])
    }

    /// Entry `k` of a loop term, without the part that is in a leg.
    #[inline(always)]
    pub(crate) fn term_vector(
        &self,
        g: usize,
        cx: &Context<'_>,
        term: &LoopTerm,
        k: usize,
    ) -> Vector<R> {
        let v = match cx.plan.edges[term.edge].along {
            EdgeSlide::Slide(slide) if term.in_leg => self.along(g, cx, term.edge, slide, k),
            _ => self.edge(g, cx, term.edge, k),
        };
        if term.backward { -v } else { v }
    }

    /// Entry `k` of a leg, without the term in analogue `k` of its class; legs are not driven.
    #[inline(always)]
    fn leg_without_top(
        &self,
        g: usize,
        cx: &Context<'_>,
        leg: usize,
        class: usize,
        k: usize,
    ) -> Vector<R> {
        let mut sum = Vector::ZERO;
        for term in &cx.derivatives.rotation[k] {
            let rate = R::splat(term.factor) * self.pose.theta[class * self.len + term.right][g];
            sum += self.pose.legs[leg * self.len + term.left][g].scale(rate);
        }
        sum.left()
    }

    /// Sets the analogues of a dyad's unknowns, and of all that turns with them, to NaN.
    #[inline(always)]
    pub(crate) fn set_nan_analogues(&mut self, g: usize, dyad: &Dyad) {
        let len = self.len;
        for unknown in dyad.unknowns {
            let jet = match unknown {
                Unknown::Class(c) => &mut self.pose.theta[c * len..(c + 1) * len],
                Unknown::Slide(s) => &mut self.pose.slides[s * len..(s + 1) * len],
            };
            for entry in &mut jet[1..] {
                entry[g] = R::splat(f64::NAN);
            }
        }
        let nan = Vector::splat(Vector::NAN);
        for &o in dyad.orientations.iter().flatten() {
            for entry in &mut self.pose.orient[o * len + 1..(o + 1) * len] {
                entry[g] = nan;
            }
        }
        for leg in [2 * dyad.index, 2 * dyad.index + 1] {
            for entry in &mut self.pose.legs[leg * len + 1..(leg + 1) * len] {
                entry[g] = nan;
            }
        }
    }

    /// Analogues of a dyad's unknowns from its closure equation. Every order has the same two
    /// columns; the right-hand side follows from lower orders.
    #[inline(always)]
    pub(crate) fn analogues(&mut self, g: usize, cx: &Context<'_>, dyad: &Dyad) {
        let len = self.len;
        if len == 1 {
            return;
        }
        let columns = [self.column(g, cx, dyad, 0), self.column(g, cx, dyad, 1)];
        let inv_determinant = R::ONE / columns[0].cross(columns[1]);
        for k in 1..len {
            // The unknown entry counts as 0 in the right-hand side.
            for i in 0..2 {
                match dyad.unknowns[i] {
                    Unknown::Slide(s) => self.pose.slides[s * len + k][g] = R::ZERO,
                    Unknown::Class(class) => {
                        let leg = 2 * dyad.index + i;
                        if dyad.leg[i] {
                            self.pose.legs[leg * len + k][g] =
                                self.leg_without_top(g, cx, leg, class, k);
                        }
                    }
                }
                for &o in &dyad.orientations[i] {
                    self.pose.orient[o * len + k][g] = self.orientation_without_top(g, cx, o, k);
                }
            }
            let sum = self.closure(g, cx, dyad, k);
            let values =
                [columns[1].cross(sum) * inv_determinant, sum.cross(columns[0]) * inv_determinant];
            for i in 0..2 {
                let value = values[i];
                match dyad.unknowns[i] {
                    Unknown::Slide(s) => self.pose.slides[s * len + k][g] = value,
                    Unknown::Class(class) => {
                        self.pose.theta[class * len + k][g] = value;
                        if dyad.leg[i] {
                            let leg = (2 * dyad.index + i) * len;
                            let top = self.pose.legs[leg][g].left().scale(value);
                            self.pose.legs[leg + k][g] += top;
                        }
                    }
                }
                for &o in &dyad.orientations[i] {
                    let top = self.pose.orient[o * len][g].left().scale(value);
                    self.pose.orient[o * len + k][g] += top;
                }
            }
        }
    }

    /// Entry `k` of `P_start + Σ ±edges − P_end`.
    #[inline(always)]
    pub(crate) fn closure(&self, g: usize, cx: &Context<'_>, dyad: &Dyad, k: usize) -> Vector<R> {
        let mut sum = self.pose.points[dyad.start * self.len + k][g]
            - self.pose.points[dyad.end * self.len + k][g];
        for i in 0..2 {
            if dyad.leg[i] {
                sum += self.pose.legs[(2 * dyad.index + i) * self.len + k][g];
            }
        }
        for term in &dyad.others {
            sum += self.term_vector(g, cx, term, k);
        }
        sum
    }

    /// Determinant of the closure's matrix.
    #[inline(always)]
    pub(crate) fn determinant(&self, g: usize, cx: &Context<'_>, dyad: &Dyad) -> R {
        self.column(g, cx, dyad, 0).cross(self.column(g, cx, dyad, 1))
    }

    /// Derivative of the closure with respect to one unknown.
    #[inline(always)]
    fn column(&self, g: usize, cx: &Context<'_>, dyad: &Dyad, i: usize) -> Vector<R> {
        match dyad.unknowns[i] {
            Unknown::Class(_) => self.leg_vector(g, cx, dyad, i, 0).left(),
            Unknown::Slide(_) => self.slide_direction(g, cx, dyad, i, 0),
        }
    }

    /// Entry `k` of the sum of all that turns with an unknown.
    #[inline(always)]
    pub(crate) fn leg_vector(
        &self,
        g: usize,
        cx: &Context<'_>,
        dyad: &Dyad,
        i: usize,
        k: usize,
    ) -> Vector<R> {
        let mut sum = Vector::ZERO;
        if dyad.leg[i] {
            sum = self.pose.legs[(2 * dyad.index + i) * self.len + k][g];
        }
        for term in &dyad.others {
            if term.turns == Some(i) {
                sum += self.term_vector(g, cx, term, k);
            }
        }
        sum
    }

    /// Entry `k` of the direction of an unknown slide.
    #[inline(always)]
    pub(crate) fn slide_direction(
        &self,
        g: usize,
        cx: &Context<'_>,
        dyad: &Dyad,
        i: usize,
        k: usize,
    ) -> Vector<R> {
        let mut sum = Vector::ZERO;
        for term in &dyad.others {
            if term.slides == Some(i) {
                let unit = self.pose.orient[cx.plan.edges[term.edge].orientation * self.len + k][g];
                let v = unit * Vector::splat(cx.constants.guide[term.edge]);
                sum = if term.backward { -v } else { v };
            }
        }
        sum
    }

    /// Sets the jet of an orientation from the rotation and analogues of its class.
    #[inline(always)]
    pub(crate) fn update_orientation(
        &mut self,
        g: usize,
        cx: &Context<'_>,
        o: usize,
        class: usize,
    ) {
        let len = self.len;
        let rotation = self.pose.class[class][g];
        self.pose.orient[o * len][g] = if cx.plan.orientations[o].driven {
            rotation * self.pose.phase[o][g]
        } else {
            rotation
        };
        for k in 1..len {
            let rest = self.orientation_without_top(g, cx, o, k);
            let top =
                self.pose.orient[o * len][g].left().scale(self.pose.theta[class * len + k][g]);
            self.pose.orient[o * len + k][g] = rest + top;
        }
    }
}
