//! Analogues: derivatives of the closure equations, not of their solutions.
//!
//! Every closure is a sum of unit vectors times fixed ones, and the derivative of
//! a unit vector is `∂U = i U ∂Θ`; so at every order the unknown analogues stand in
//! the same matrix, and all the rest is known from lower orders (Uicker, Pennock
//! & Shigley 2017, chapters 3 and 4, by complex algebra). One function for all
//! dyads, all orders, any number of drivers.

use super::state::{Context, State};
use crate::lanes::Real;
use crate::plan::{Along, Dyad, Part, Unknown};
use crate::plane::Vector;

impl<R: Real> State<R> {
    /// Value and analogues of an orientation that the drivers alone give:
    /// `∂U = i U` times its turns.
    #[inline(always)]
    pub(crate) fn orient_driven(&mut self, cx: &Context<'_, R>, o: usize) {
        let orientation = &cx.plan.orientations[o];
        self.orient[o * self.len] = self.phase[o];
        for k in 1..self.len {
            let (driver, lower) = cx.jets.lowered[k];
            let turns = R::splat(f64::from(orientation.turns[driver]));
            self.orient[o * self.len + k] = self.orient[o * self.len + lower].left().scale(turns);
        }
    }

    /// What the drivers add to analogue `k` of an orientation's angle.
    #[inline(always)]
    fn driven(cx: &Context<'_, R>, o: usize, k: usize) -> R {
        let turns = &cx.plan.orientations[o].turns;
        R::splat(if let Some(driver) = cx.jets.driver_of[k] {
            f64::from(turns[driver])
        } else {
            0.0
        })
    }

    /// Analogue `k` of an orientation's angle.
    #[inline(always)]
    pub(crate) fn theta_of(&self, cx: &Context<'_, R>, o: usize, k: usize) -> R {
        let orientation = &cx.plan.orientations[o];
        let own = self.theta[orientation.class * self.len + k];
        if orientation.driven { own + Self::driven(cx, o, k) } else { own }
    }

    /// Analogue `k` of an orientation but for the term in its class's own `k`.
    #[inline(always)]
    pub(crate) fn orientation_without_top(
        &self,
        cx: &Context<'_, R>,
        o: usize,
        k: usize,
    ) -> Vector<R> {
        let mut sum = Vector::ZERO;
        for term in &cx.jets.rotation[k] {
            let rate = R::splat(term.factor) * self.theta_of(cx, o, term.right);
            sum += self.orient[o * self.len + term.left].scale(rate);
        }
        if cx.plan.orientations[o].driven {
            sum += self.orient[o * self.len].scale(Self::driven(cx, o, k));
        }
        sum.left()
    }

    /// Entry `k` of an edge's vector.
    #[inline(always)]
    pub(crate) fn edge(&self, cx: &Context<'_, R>, e: usize, k: usize) -> Vector<R> {
        let edge = &cx.plan.edges[e];
        if let Some(leg) = edge.leg {
            let v = self.legs[leg.index * self.len + k];
            return if leg.backward { -v } else { v };
        }
        let rigid = self.orient[edge.orientation * self.len + k] * Vector::splat(cx.bound.rigid[e]);
        match edge.along {
            Along::Nothing => rigid,
            Along::Slide(slide) | Along::Driver { slide } => rigid + self.along(cx, e, slide, k),
        }
    }

    /// Entry `k` of the part along its slide.
    #[inline(always)]
    fn along(&self, cx: &Context<'_, R>, e: usize, slide: usize, k: usize) -> Vector<R> {
        let unit = cx.plan.edges[e].orientation * self.len;
        let mut along = Vector::ZERO;
        for term in &cx.jets.product[k] {
            let s = R::splat(term.factor) * self.slides[slide * self.len + term.right];
            along += self.orient[unit + term.left].scale(s);
        }
        along * Vector::splat(cx.bound.guide[e])
    }

    /// Entry `k` of what a part adds beside the legs.
    #[inline(always)]
    pub(crate) fn part(&self, cx: &Context<'_, R>, part: &Part, k: usize) -> Vector<R> {
        let v = match cx.plan.edges[part.edge].along {
            Along::Slide(slide) if part.in_leg => self.along(cx, part.edge, slide, k),
            _ => self.edge(cx, part.edge, k),
        };
        if part.backward { -v } else { v }
    }

    /// Entry `k` of a leg but for the term in its class's own `k`; legs are not driven.
    #[inline(always)]
    fn leg_without_top(
        &self,
        cx: &Context<'_, R>,
        leg: usize,
        class: usize,
        k: usize,
    ) -> Vector<R> {
        let mut sum = Vector::ZERO;
        for term in &cx.jets.rotation[k] {
            let rate = R::splat(term.factor) * self.theta[class * self.len + term.right];
            sum += self.legs[leg * self.len + term.left].scale(rate);
        }
        sum.left()
    }

    /// NaN for the analogues of a dyad's unknowns.
    #[inline(always)]
    pub(crate) fn no_analogues(&mut self, dyad: &Dyad) {
        let len = self.len;
        for unknown in dyad.unknowns {
            let jet = match unknown {
                Unknown::Class(c) => &mut self.theta[c * len..(c + 1) * len],
                Unknown::Slide(s) => &mut self.slides[s * len..(s + 1) * len],
            };
            jet[1..].fill(R::splat(f64::NAN));
        }
        let nothing = Vector::splat(Vector::NAN);
        for &o in dyad.turned.iter().flatten() {
            self.orient[o * len + 1..(o + 1) * len].fill(nothing);
        }
        for leg in [2 * dyad.index, 2 * dyad.index + 1] {
            self.legs[leg * len + 1..(leg + 1) * len].fill(nothing);
        }
    }

    /// Analogues of a dyad's unknowns from its closure equation: at every order
    /// the same two columns, and as right-hand side what is known of that order.
    #[inline(always)]
    pub(crate) fn analogues(&mut self, cx: &Context<'_, R>, dyad: &Dyad) {
        let len = self.len;
        if len == 1 {
            return;
        }
        if dyad.others.is_empty() {
            self.analogues_of_legs(cx, dyad);
            return;
        }
        let columns = [self.column(cx, dyad, 0), self.column(cx, dyad, 1)];
        let per = R::ONE / columns[0].cross(columns[1]);
        for k in 1..len {
            // What is yet unknown counts as 0.
            for place in 0..2 {
                match dyad.unknowns[place] {
                    Unknown::Slide(s) => self.slides[s * len + k] = R::ZERO,
                    Unknown::Class(class) => {
                        let leg = 2 * dyad.index + place;
                        if dyad.leg[place] {
                            self.legs[leg * len + k] = self.leg_without_top(cx, leg, class, k);
                        }
                    }
                }
                for &o in &dyad.turned[place] {
                    if cx.plan.orientations[o].used {
                        self.orient[o * len + k] = self.orientation_without_top(cx, o, k);
                    }
                }
            }
            let known = self.closure(cx, dyad, k);
            let values = [columns[1].cross(known) * per, known.cross(columns[0]) * per];
            for place in 0..2 {
                let value = values[place];
                match dyad.unknowns[place] {
                    Unknown::Slide(s) => self.slides[s * len + k] = value,
                    Unknown::Class(class) => {
                        self.theta[class * len + k] = value;
                        if dyad.leg[place] {
                            let leg = (2 * dyad.index + place) * len;
                            let top = self.legs[leg].left().scale(value);
                            self.legs[leg + k] += top;
                        }
                    }
                }
                for &o in &dyad.turned[place] {
                    if cx.plan.orientations[o].used {
                        let top = self.orient[o * len].left().scale(value);
                        self.orient[o * len + k] += top;
                    }
                }
            }
        }
    }

    /// The same where there is nothing but two legs: most dyads are so.
    #[inline(always)]
    fn analogues_of_legs(&mut self, cx: &Context<'_, R>, dyad: &Dyad) {
        let len = self.len;
        let [Unknown::Class(c0), Unknown::Class(c1)] = dyad.unknowns else { return };
        let jet = |place: usize| place * len..(place + 1) * len;
        let (start, end) = (&self.points[jet(dyad.start)], &self.points[jet(dyad.end)]);
        let legs = [2 * dyad.index, 2 * dyad.index + 1].map(jet);
        let (Ok([a, b]), Ok([u, v])) =
            (self.legs.get_disjoint_mut(legs), self.theta.get_disjoint_mut([jet(c0), jet(c1)]))
        else {
            return;
        };
        let columns = [a[0].left(), b[0].left()];
        let per = R::ONE / columns[0].cross(columns[1]);
        for k in 1..len {
            let (mut first, mut second) = (Vector::ZERO, Vector::ZERO);
            for term in &cx.jets.rotation[k] {
                let factor = R::splat(term.factor);
                first += a[term.left].scale(factor * u[term.right]);
                second += b[term.left].scale(factor * v[term.right]);
            }
            let (first, second) = (first.left(), second.left());
            let known = (start[k] - end[k]) + first + second;
            u[k] = columns[1].cross(known) * per;
            v[k] = known.cross(columns[0]) * per;
            a[k] = first + columns[0].scale(u[k]);
            b[k] = second + columns[1].scale(v[k]);
        }
        for &o in dyad.turned.iter().flatten() {
            if cx.plan.orientations[o].used {
                for k in 1..len {
                    let top = self.theta[cx.plan.orientations[o].class * len + k];
                    let rest = self.orientation_without_top(cx, o, k);
                    self.orient[o * len + k] = rest + self.orient[o * len].left().scale(top);
                }
            }
        }
    }

    /// Entry `k` of `P_start + Σ ±edges − P_end`.
    #[inline(always)]
    pub(crate) fn closure(&self, cx: &Context<'_, R>, dyad: &Dyad, k: usize) -> Vector<R> {
        let mut sum = self.points[dyad.start * self.len + k] - self.points[dyad.end * self.len + k];
        for place in 0..2 {
            if dyad.leg[place] {
                sum += self.legs[(2 * dyad.index + place) * self.len + k];
            }
        }
        for part in &dyad.others {
            sum += self.part(cx, part, k);
        }
        sum
    }

    /// Determinant of the closure's matrix.
    #[inline(always)]
    pub(crate) fn determinant(&self, cx: &Context<'_, R>, dyad: &Dyad) -> R {
        self.column(cx, dyad, 0).cross(self.column(cx, dyad, 1))
    }

    /// Derivative of the closure with respect to one unknown.
    #[inline(always)]
    fn column(&self, cx: &Context<'_, R>, dyad: &Dyad, place: usize) -> Vector<R> {
        match dyad.unknowns[place] {
            Unknown::Class(_) => self.turning(cx, dyad, place, 0).left(),
            Unknown::Slide(_) => self.sliding(cx, dyad, place, 0),
        }
    }

    /// Entry `k` of the sum of what turns with an unknown.
    #[inline(always)]
    pub(crate) fn turning(
        &self,
        cx: &Context<'_, R>,
        dyad: &Dyad,
        place: usize,
        k: usize,
    ) -> Vector<R> {
        let mut sum = Vector::ZERO;
        if dyad.leg[place] {
            sum = self.legs[(2 * dyad.index + place) * self.len + k];
        }
        for part in &dyad.others {
            if part.turns == Some(place) {
                sum += self.part(cx, part, k);
            }
        }
        sum
    }

    /// Entry `k` of the direction of the slide that is an unknown.
    #[inline(always)]
    pub(crate) fn sliding(
        &self,
        cx: &Context<'_, R>,
        dyad: &Dyad,
        place: usize,
        k: usize,
    ) -> Vector<R> {
        let mut sum = Vector::ZERO;
        for part in &dyad.others {
            if part.slides == Some(place) {
                let unit = self.orient[cx.plan.edges[part.edge].orientation * self.len + k];
                let v = unit * Vector::splat(cx.bound.guide[part.edge]);
                sum = if part.backward { -v } else { v };
            }
        }
        sum
    }
}
