//! The dyad of two legs (RRR), the most frequent one.

use super::chord::{DyadChord, Ends, FROM_GROUND, FROM_PIN, POINTS, TO_GROUND, TO_PIN, ends_of};
use super::intersections::TwoCircles;
use super::turning_leg::{entry, second_rest, third_rest};
use crate::math::lanes::Real;
use crate::math::stride::Stride;
use crate::math::vector::Vector;
use crate::plan::tape::DyadOp;
use crate::state::state::{Context, State};

/// Terms shared by all entries of the jets of both legs.
#[derive(Clone, Copy)]
struct Legs<R: Real> {
    a: Vector<R>,
    b: Vector<R>,
    /// 1 / (a × b)
    inverse: R,
}

impl<R: Real> Legs<R> {
    /// An entry of both angles, from that of the chord. `rests`: the legs' entries without the angles'
    /// own terms; `None` for the first.
    #[inline(always)]
    fn rates(&self, chord: Vector<R>, rests: Option<[Vector<R>; 2]>) -> [R; 2] {
        let rest = if let Some([a, b]) = rests { (chord - a) - b } else { chord };
        [self.b.dot(rest) * self.inverse, -(self.a.dot(rest) * self.inverse)]
    }
}

impl<R: Real, const G: usize> State<R, G> {
    /// Solves the dyad for its legs, their rotations and analogues.
    #[inline(always)]
    pub(crate) fn two_legs(&mut self, cx: &Context<'_>, op: &DyadOp) {
        if cx.derivatives.drivers > 1 {
            self.legs_by_drivers(cx, op);
        } else {
            self.legs_by_driver::<R, true, POINTS>(cx, op, self.len);
        }
    }

    /// The same on the unchecked path: one driver, jets of a constant length, only what the tape uses.
    #[inline(always)]
    pub(crate) fn unchecked_two_legs<W: Stride<R>, const LEN: usize>(
        &mut self,
        cx: &Context<'_>,
        op: &DyadOp,
    ) {
        match ends_of(op) {
            FROM_PIN => self.legs_by_driver::<W, false, FROM_PIN>(cx, op, LEN),
            TO_PIN => self.legs_by_driver::<W, false, TO_PIN>(cx, op, LEN),
            FROM_GROUND => self.legs_by_driver::<W, false, FROM_GROUND>(cx, op, LEN),
            TO_GROUND => self.legs_by_driver::<W, false, TO_GROUND>(cx, op, LEN),
            _ => self.legs_by_driver::<W, false, POINTS>(cx, op, LEN),
        }
    }

    #[inline(always)]
    fn legs_by_driver<W: Stride<R>, const CHECKED: bool, const ENDS: Ends>(
        &mut self,
        cx: &Context<'_>,
        op: &DyadOp,
        len: usize,
    ) {
        let jet = |i: usize| i * len..i * len + len;
        let chord = DyadChord::new(cx, op, &self.pose.points, &self.pose.unit, len);
        let (Ok([a_jet, b_jet]), Ok([u, v]), Ok([a_turn, b_turn])) = (
            self.pose.legs.get_disjoint_mut([2 * op.dyad, 2 * op.dyad + 1].map(jet)),
            self.pose.theta.get_disjoint_mut(op.unknowns.map(jet)),
            self.pose.class.get_disjoint_mut(op.unknowns),
        ) else {
            return;
        };
        let turns = [CHECKED || op.turns[0], CHECKED || op.turns[1]];
        let keeps = [CHECKED || op.keeps[0], CHECKED || op.keeps[1]];
        let signs = &self.pose.signs[op.sign.unwrap_or(0)];
        let (legs, dyad) = (&cx.constants.legs[op.dyad], &cx.constants.dyads[op.dyad]);
        let (a, b) = (legs[0].on_lanes::<W>(), legs[1].on_lanes::<W>());
        let mut sides = dyad.sides.on_lanes::<W>();
        if !CHECKED {
            sides.per_sine2 = W::splat(dyad.bounding_per_sine2);
        }
        let bounds = &mut self.conditions.bounds[op.dyad];
        for g in (0..self.groups.min(G)).step_by(W::REGISTERS) {
            let arm = chord.arm::<W, ENDS>(g);
            let k = chord.at::<W, ENDS>(0, g, arm);
            let solved = TwoCircles::solve::<CHECKED>([&a, &b], &sides, k, W::load(signs, g));
            if CHECKED {
                self.work.closings[g] = solved.closing.first();
            } else {
                W::add_to(solved.closing.open, &mut self.conditions.open, g);
                let mut bound = solved.closing.sine2;
                if ENDS != FROM_PIN && ENDS != TO_PIN {
                    bound = W::load(&self.conditions.bound, g) * bound;
                }
                bound.store(bounds, g);
            }
            let [a0, b0] = solved.legs;
            if turns[0] {
                W::store_vectors(a.turn_to(a0), a_turn, g);
            }
            if turns[1] {
                W::store_vectors(b.turn_to(b0), b_turn, g);
            }
            if keeps[0] {
                W::store_vectors(a0, &mut a_jet[0], g);
            }
            if keeps[1] {
                W::store_vectors(b0, &mut b_jet[0], g);
            }
            let legs = Legs { a: a0, b: b0, inverse: solved.inverse_determinant };
            let mut rates = [[W::ZERO; 2]; 2];
            for k in 1..len {
                let chord = chord.at::<W, ENDS>(k, g, arm);
                let [[u1, v1], [u2, v2]] = rates;
                let rests: Option<[Vector<W>; 2]> = match k {
                    1 => None,
                    2 => Some([second_rest(a0, u1), second_rest(b0, v1)]),
                    _ => Some([third_rest(a0, u1, u2), third_rest(b0, v1, v2)]),
                };
                let entries = legs.rates(chord, rests);
                if k < 3 {
                    rates[k - 1] = entries;
                }
                if turns[0] {
                    entries[0].store(&mut u[k], g);
                }
                if turns[1] {
                    entries[1].store(&mut v[k], g);
                }
                if keeps[0] || keeps[1] {
                    let a_rest = if let Some([a, _]) = rests { Some(a) } else { None };
                    let a_next = entry(a0, entries[0], a_rest);
                    W::store_vectors(a_next, &mut a_jet[k], g);
                    W::store_vectors(chord - a_next, &mut b_jet[k], g);
                }
            }
        }
        if CHECKED {
            self.record_closings(cx, op);
        }
        self.turn_orientations(cx, op);
    }

    /// The checked path for any number of drivers.
    #[inline(always)]
    fn legs_by_drivers(&mut self, cx: &Context<'_>, op: &DyadOp) {
        let len = self.len;
        let jet = |i: usize| i * len..i * len + len;
        let (start, end) = (&self.pose.points[jet(op.start)], &self.pose.points[jet(op.end)]);
        let (Ok([a_jet, b_jet]), Ok([u, v]), Ok([a_turn, b_turn])) = (
            self.pose.legs.get_disjoint_mut([2 * op.dyad, 2 * op.dyad + 1].map(jet)),
            self.pose.theta.get_disjoint_mut(op.unknowns.map(jet)),
            self.pose.class.get_disjoint_mut(op.unknowns),
        ) else {
            return;
        };
        let signs = &self.pose.signs[op.sign.unwrap_or(0)];
        let legs = &cx.constants.legs[op.dyad];
        let (a, b) = (legs[0].on_lanes(), legs[1].on_lanes());
        let sides = cx.constants.dyads[op.dyad].sides.on_lanes();
        for g in 0..self.groups.min(G) {
            let k = end[0][g] - start[0][g];
            let solved = TwoCircles::solve::<true>([&a, &b], &sides, k, signs[g]);
            self.work.closings[g] = solved.closing;
            let [a0, b0] = solved.legs;
            (a_jet[0][g], b_jet[0][g]) = (a0, b0);
            (a_turn[g], b_turn[g]) = (a.turn_to(a0), b.turn_to(b0));
            let legs = Legs { a: a0, b: b0, inverse: solved.inverse_determinant };
            for k in 1..len {
                let (mut a_rest, mut b_rest) = (Vector::ZERO, Vector::ZERO);
                for term in &cx.derivatives.rotation[k] {
                    let factor = R::splat(term.factor);
                    a_rest += a_jet[term.left][g].scale(factor * u[term.right][g]);
                    b_rest += b_jet[term.left][g].scale(factor * v[term.right][g]);
                }
                let chord = end[k][g] - start[k][g];
                let rests = [a_rest.left(), b_rest.left()];
                [u[k][g], v[k][g]] = legs.rates(chord, Some(rests));
                a_jet[k][g] = entry(a0, u[k][g], Some(rests[0]));
                b_jet[k][g] = chord - a_jet[k][g];
            }
        }
        self.record_closings(cx, op);
        self.turn_orientations(cx, op);
    }
}
