//! The dyad of two legs (RRR), the most frequent one.

use super::chord::{DyadChord, Ends, FROM_GROUND, FROM_PIN, POINTS, TO_GROUND, TO_PIN, ends_of};
use super::intersections::TwoCircles;
use super::turning_leg::{entry, second_rest, third_rest};
use crate::math::derivatives::{TWO_DRIVERS, Term};
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
            self.legs_by_drivers::<R, true>(cx, op, self.len, &|k| &cx.derivatives.rotation[k][..]);
        } else {
            self.legs_by_driver::<R, true, POINTS>(cx, op, self.len);
        }
    }

    /// The same on the unchecked path: one driver, or two with jets of second order; jets of a constant
    /// length, only what the tape uses.
    #[inline(always)]
    pub(crate) fn unchecked_two_legs<W: Stride<R>, const LEN: usize>(
        &mut self,
        cx: &Context<'_>,
        op: &DyadOp,
    ) {
        if LEN == TWO_DRIVERS.len() {
            self.legs_by_drivers::<W, false>(cx, op, LEN, &|k| TWO_DRIVERS[k]);
            return;
        }
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

    /// Several drivers; `terms`: those of a rotation.
    #[inline(always)]
    fn legs_by_drivers<'t, W: Stride<R>, const CHECKED: bool>(
        &mut self,
        cx: &Context<'_>,
        op: &DyadOp,
        len: usize,
        terms: &impl Fn(usize) -> &'t [Term],
    ) {
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
        let (legs, dyad) = (&cx.constants.legs[op.dyad], &cx.constants.dyads[op.dyad]);
        let (a, b) = (legs[0].on_lanes::<W>(), legs[1].on_lanes::<W>());
        let mut sides = dyad.sides.on_lanes::<W>();
        if !CHECKED {
            sides.per_sine2 = W::splat(dyad.bounding_per_sine2);
        }
        let bounds = &mut self.conditions.bounds[op.dyad];
        for g in (0..self.groups.min(G)).step_by(W::REGISTERS) {
            let k = W::load_vectors(&end[0], g) - W::load_vectors(&start[0], g);
            let solved = TwoCircles::solve::<CHECKED>([&a, &b], &sides, k, W::load(signs, g));
            if CHECKED {
                self.work.closings[g] = solved.closing.first();
            } else {
                W::add_to(solved.closing.open, &mut self.conditions.open, g);
                let bound = W::load(&self.conditions.bound, g) * solved.closing.sine2;
                bound.store(bounds, g);
            }
            let [a0, b0] = solved.legs;
            W::store_vectors(a0, &mut a_jet[0], g);
            W::store_vectors(b0, &mut b_jet[0], g);
            W::store_vectors(a.turn_to(a0), a_turn, g);
            W::store_vectors(b.turn_to(b0), b_turn, g);
            let legs = Legs { a: a0, b: b0, inverse: solved.inverse_determinant };
            for k in 1..len {
                let (mut a_rest, mut b_rest) = (Vector::ZERO, Vector::ZERO);
                for term in terms(k) {
                    let (left, right) = (term.left, term.right);
                    let factor = W::splat(term.factor);
                    let [u, v] = [factor * W::load(&u[right], g), factor * W::load(&v[right], g)];
                    a_rest += W::load_vectors(&a_jet[left], g).scale(u);
                    b_rest += W::load_vectors(&b_jet[left], g).scale(v);
                }
                let chord = W::load_vectors(&end[k], g) - W::load_vectors(&start[k], g);
                let rests = [a_rest.left(), b_rest.left()];
                let entries = legs.rates(chord, Some(rests));
                entries[0].store(&mut u[k], g);
                entries[1].store(&mut v[k], g);
                let a_next = entry(a0, entries[0], Some(rests[0]));
                W::store_vectors(a_next, &mut a_jet[k], g);
                W::store_vectors(chord - a_next, &mut b_jet[k], g);
            }
        }
        if CHECKED {
            self.record_closings(cx, op);
        }
        self.turn_orientations(cx, op);
    }
}
