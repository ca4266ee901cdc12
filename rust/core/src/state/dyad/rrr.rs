//! Kernel for dyads of two binary links (RRR). Most dyads are of this kind, and their equations
//! need no sorting by term.
//!
//! It has the closed form and the equations of every dyad (see `solve`, `analogues`). For one
//! driver it is compiled for each order separately, so that jets have constant length and the
//! tables are constants.

use super::closed_form::two_circles;
use crate::math::derivatives::{ONE_DRIVER, Term};
use crate::math::lanes::{Mask, Real};
use crate::math::vector::Vector;
use crate::plan::dyad::Dyad;
use crate::state::state::{Context, State};
use crate::state::status::{FLAT2, Fault, Status};

impl<R: Real, const G: usize> State<R, G> {
    /// Solves the dyad of step `index`, whose two legs turn with these classes.
    #[inline(always)]
    pub(crate) fn solve_rrr(
        &mut self,
        cx: &Context<'_>,
        dyad: &Dyad,
        classes: [usize; 2],
        index: usize,
    ) {
        match (cx.derivatives.drivers, self.len) {
            (1, 1) => self.rrr_of_length(cx, dyad, classes, index, 1, &|k| ONE_DRIVER[k]),
            (1, 2) => self.rrr_of_length(cx, dyad, classes, index, 2, &|k| ONE_DRIVER[k]),
            (1, 3) => self.rrr_of_length(cx, dyad, classes, index, 3, &|k| ONE_DRIVER[k]),
            (1, 4) => self.rrr_of_length(cx, dyad, classes, index, 4, &|k| ONE_DRIVER[k]),
            (_, len) => {
                self.rrr_of_length(cx, dyad, classes, index, len, &|k| {
                    &cx.derivatives.rotation[k][..]
                });
            }
        }
        for (turned, class) in dyad.orientations.iter().zip(classes) {
            for &o in turned {
                for g in 0..self.groups.min(G) {
                    self.update_orientation(g, cx, o, class);
                }
            }
        }
        if R::LANES == 1 && matches!(self.fault, Some(Fault::Singular { step }) if step == index) {
            self.set_nan_analogues(0, dyad);
        }
    }

    /// [`solve_rrr`](Self::solve_rrr) for jets of `len` entries, with `terms` the table of
    /// rotation.
    #[inline(always)]
    fn rrr_of_length<'t>(
        &mut self,
        cx: &Context<'_>,
        dyad: &Dyad,
        classes: [usize; 2],
        index: usize,
        len: usize,
        terms: &impl Fn(usize) -> &'t [Term],
    ) {
        let jet = |i: usize| i * len..i * len + len;
        let legs = [2 * dyad.index, 2 * dyad.index + 1].map(jet);
        let (start, end) = (&self.points[jet(dyad.start)], &self.points[jet(dyad.end)]);
        let coordinate_scale2 =
            [&self.coordinate_scale2[dyad.start], &self.coordinate_scale2[dyad.end]];
        let upstream2 = [&self.point_condition[dyad.start], &self.point_condition[dyad.end]];
        let (
            Some(sign),
            Ok([a_jet, b_jet]),
            Ok([u, v]),
            Ok([first_turn, second_turn]),
            Ok([first_condition, second_condition]),
        ) = (
            dyad.sign,
            self.legs.get_disjoint_mut(legs),
            self.theta.get_disjoint_mut(classes.map(jet)),
            self.class.get_disjoint_mut(classes),
            self.class_condition.get_disjoint_mut(classes),
        )
        else {
            return;
        };
        let margin = &mut self.margin[dyad.index];
        let (signs, upstream_sign2) = (&self.signs[sign], &mut self.upstream_condition2[sign]);
        let [a, b] = &cx.constants.legs[dyad.index];
        let (a, b) = (a.on_lanes(), b.on_lanes());
        let max_arm2 = [
            R::splat(cx.constants.max_arm2[classes[0]]),
            R::splat(cx.constants.max_arm2[classes[1]]),
        ];
        for g in 0..self.groups.min(G) {
            let (first, second, solved) = two_circles(&a, &b, end[0][g] - start[0][g], signs[g]);
            let flat = solved.flat.or(solved.sine2.lt(R::splat(FLAT2)));
            self.needs_scalar[g] = self.needs_scalar[g].or(solved.open).or(flat);
            self.open[g] = self.open[g].or(solved.open);
            margin[g] = solved.margin;
            if R::LANES == 1 && solved.open.any() {
                self.fault = Some(Fault::NotClosed { step: index, gap: solved.gap.lane(0) });
                self.status = Status::Unreachable;
                return;
            }
            if R::LANES == 1 && flat.any() {
                self.fault.get_or_insert(Fault::Singular { step: index });
                self.status = Status::Singular;
            }
            upstream_sign2[g] = upstream2[0][g].max(upstream2[1][g]);
            let rounding = R::splat(0.25) * coordinate_scale2[0][g].max(coordinate_scale2[1][g]);
            let relative_arm2 = (max_arm2[0].max(rounding) * a.inv_norm2)
                .max(max_arm2[1].max(rounding) * b.inv_norm2);
            let condition = upstream_sign2[g] * relative_arm2.max(R::ONE) / solved.sine2;
            first_condition[g] = condition;
            second_condition[g] = condition;
            self.condition2[g] = condition.max(self.condition2[g]);
            first_turn[g] = a.turn_to(first);
            second_turn[g] = b.turn_to(second);
            a_jet[0][g] = first;
            b_jet[0][g] = second;
            let columns = [first.left(), second.left()];
            let inv_determinant = R::ONE / columns[0].cross(columns[1]);
            for k in 1..len {
                let (mut first, mut second) = (Vector::ZERO, Vector::ZERO);
                for term in terms(k) {
                    let factor = R::splat(term.factor);
                    first += a_jet[term.left][g].scale(factor * u[term.right][g]);
                    second += b_jet[term.left][g].scale(factor * v[term.right][g]);
                }
                let (first, second) = (first.left(), second.left());
                let known = (start[k][g] - end[k][g]) + first + second;
                let (first_rate, second_rate) = (
                    columns[1].cross(known) * inv_determinant,
                    known.cross(columns[0]) * inv_determinant,
                );
                u[k][g] = first_rate;
                v[k][g] = second_rate;
                a_jet[k][g] = first + columns[0].scale(first_rate);
                b_jet[k][g] = second + columns[1].scale(second_rate);
            }
        }
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
        let rotation = self.class[class][g];
        self.orient[o * len][g] =
            if cx.plan.orientations[o].driven { rotation * self.phase[o][g] } else { rotation };
        for k in 1..len {
            let rest = self.orientation_without_top(g, cx, o, k);
            let top = self.orient[o * len][g].left().scale(self.theta[class * len + k][g]);
            self.orient[o * len + k][g] = rest + top;
        }
    }
}
