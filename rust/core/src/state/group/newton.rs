//! Groups above class II: Newton's iteration on their loops.
//!
//! The unknown rotations are unit vectors, turned by every step; the equations are polynomials
//! in them and in the slides, so the matrix is exact. It starts where the caller has put the
//! rotations and slides, on the way from the drawing. Every matrix serves two steps, which
//! together converge to the third order (Potra & Pták, Nondiscrete Induction and Iterative
//! Processes, 1984). Work goes on in all groups of positions at once; each lane stops where its
//! own steps end.

use super::turn::turned;
use crate::math::inverse::invert;
use crate::math::lanes::{Mask, Real};
use crate::math::tolerance::{
    NEWTON_FROZEN_MAX2, NEWTON_LAST_STEP, NEWTON_MAX_ROUNDS, NEWTON_MAX_STEP, NEWTON_TOLERANCE,
};
use crate::math::vector::Vector;
use crate::plan::dyad::Unknown;
use crate::plan::group::{Chord, Group, Loop};
use crate::plan::plan::EdgeSlide;
use crate::state::state::{Context, State};
use crate::state::status::{FLAT2, Fault, Status};

impl<R: Real, const G: usize> State<R, G> {
    /// Solves the group (step `index`) from where its unknowns are; not where `care` knows that
    /// it must be done again.
    #[inline(always)]
    pub(crate) fn solve_group(&mut self, cx: &Context<'_>, group: &Group, index: usize) {
        if let (Some(bars), 1) = (&group.bars, cx.jets.drivers) {
            self.solve_bars(cx, group, bars, index);
            return;
        }
        let mut matrix = std::mem::take(&mut self.matrix);
        let mut work = NewtonState::<R, G>::new(self.care);
        for unused in work.done.iter_mut().skip(self.groups) {
            *unused = R::Mask::NONE.not();
        }
        let known = work.done;
        self.prepare_group(cx, group);
        self.place_group(cx, group);
        for round in 0..NEWTON_MAX_ROUNDS {
            if work.done.iter().all(|done| done.all()) {
                break;
            }
            self.linearise(cx, group, &mut matrix);
            let determinants = invert(&mut matrix, group.rows);
            for g in 0..G {
                let own = &mut self.bends[group.index][g];
                *own = R::select(work.done[g], *own, determinants[g]);
            }
            work.weigh(cx, group, &matrix);
            let first = self.step(group, &matrix, &work.done);
            let waits = work.waits(first);
            self.place_group(cx, group);
            let mut second = [R::ZERO; G];
            if !waits.iter().all(|waits| waits.all()) {
                self.miss(cx, group, 0, &mut matrix[2 * group.rows * group.rows..]);
                second = self.step(group, &matrix, &waits);
                self.place_group(cx, group);
            }
            work.count(first, second, &waits, round == 0);
        }
        for g in 0..G {
            self.care[g] = self.care[g].or(work.done[g].not());
            self.first_step[g] = self.first_step[g].max(work.first[g]);
            self.later_steps[g] = self.later_steps[g].max(work.rest[g]);
        }
        if R::LANES == 1 && !work.done.iter().all(|done| done.all()) {
            self.fault = Some(Fault::NotConverged { step: index });
            self.status = Status::NotConverged;
        } else {
            for g in 0..G {
                self.judge(g, cx, group, index, work.size2[g]);
            }
            self.take_all(cx, group, 0);
            if self.len > 1 && !known.iter().all(|done| done.all()) {
                self.linearise(cx, group, &mut matrix);
                self.determinants[group.index] = invert(&mut matrix, group.rows);
                self.group_analogues(cx, group, &mut matrix);
            }
        }
        self.matrix = matrix;
    }

    /// What does not change during the iteration.
    #[inline(always)]
    fn prepare_group(&mut self, cx: &Context<'_>, group: &Group) {
        for (place, l) in group.loops.iter().enumerate() {
            if l.chord == Chord::Whole {
                continue;
            }
            let e = group.edges[l.edge].edge;
            if let EdgeSlide::Driver { .. } = cx.plan.edges[e].along {
                for g in 0..G {
                    self.per[place][g] = R::ONE / self.local(g, cx, e, 0).norm();
                }
            } else {
                self.per[place] = [R::splat(1.0 / cx.bound.rigid[e].norm()); G];
            }
        }
    }

    /// Edges and chords at the unknowns.
    #[inline(always)]
    fn place_group(&mut self, cx: &Context<'_>, group: &Group) {
        for (place, &unknown) in group.unknowns.iter().enumerate() {
            if let Unknown::Class(class) = unknown {
                self.spread_rotation(cx, &group.turned[place], class);
            }
        }
        self.measure(cx, group, 0);
    }

    /// Takes a step by the inverse at hand, on the lanes that are not done; how great a change
    /// was asked for.
    #[inline(always)]
    fn step(&mut self, group: &Group, matrix: &[[R; G]], done: &[R::Mask; G]) -> [R; G] {
        let (len, n) = (self.len, group.rows);
        let most = R::splat(NEWTON_MAX_STEP);
        let mut greatest = [R::ZERO; G];
        let missing = &matrix[2 * n * n..][..n];
        for (place, &unknown) in group.unknowns.iter().enumerate() {
            let row = &matrix[place * 2 * n + n..][..n];
            for g in 0..G {
                let mut step = R::ZERO;
                for (inverse, missing) in row.iter().zip(missing) {
                    step = step - inverse[g] * missing[g];
                }
                let size = step.abs();
                // No number counts as great.
                greatest[g] = R::select(size.le(greatest[g]), greatest[g], size);
                let step = R::select(done[g], R::ZERO, step.max(-most).min(most));
                match unknown {
                    Unknown::Class(class) => {
                        let old = self.class[class][g];
                        let new = turned(old, step);
                        let x = R::select(done[g], old.x, new.x);
                        self.class[class][g] = Vector::new(x, R::select(done[g], old.y, new.y));
                    }
                    Unknown::Slide(slide) => {
                        let value = &mut self.slides[slide * len][g];
                        *value += step;
                    }
                }
            }
        }
        greatest
    }

    /// Condition of the group, whose inverse has this size, and of all that hangs on it.
    #[inline(always)]
    pub(crate) fn judge(
        &mut self,
        g: usize,
        cx: &Context<'_>,
        group: &Group,
        index: usize,
        size2: R,
    ) {
        let mut before = R::ONE;
        for l in &group.loops {
            for point in [l.start, l.end] {
                before = before.max(self.point_condition[point][g]);
            }
        }
        if group.bars.is_none() {
            before = before.max(self.carried(g, cx, group));
        }
        let condition = before * size2.max(R::ONE);
        // No number counts as great.
        let kept = condition.le(self.condition2[g]);
        self.condition2[g] = R::select(kept, self.condition2[g], condition);
        for unknown in group.found() {
            match unknown {
                Unknown::Class(class) => self.class_condition[class][g] = condition,
                Unknown::Slide(slide) => self.slide_condition[slide][g] = condition,
            }
        }
        let flat = (condition * R::splat(FLAT2)).le(before).not();
        self.care[g] = self.care[g].or(flat);
        if R::LANES == 1 && flat.any() {
            self.fault.get_or_insert(Fault::Singular { step: index });
            self.status = Status::Singular;
        }
    }

    /// Square of the condition of the rotations that come from before the group.
    #[inline(always)]
    fn carried(&self, g: usize, cx: &Context<'_>, group: &Group) -> R {
        let mut before = R::ONE;
        for edge in group.edges.iter().filter(|edge| edge.turns.is_none()) {
            let class = cx.plan.class_of(edge.edge);
            let own = |l: &Loop| l.chord == Chord::Length { class };
            if !group.loops.iter().any(own) {
                before = before.max(self.class_condition[class][g]);
            }
        }
        before
    }
}

/// How far the iteration is.
pub(crate) struct NewtonState<R: Real, const G: usize> {
    /// Lanes that need no more steps.
    pub done: [R::Mask; G],
    /// Square of the size of the last inverse.
    pub size2: [R; G],
    /// Greatest change of an unknown by the first step (rad, or of the size).
    pub first: [R; G],
    /// By the others, together.
    pub rest: [R; G],
}

impl<R: Real, const G: usize> NewtonState<R, G> {
    #[inline(always)]
    pub(crate) fn new(done: [R::Mask; G]) -> Self {
        Self { done, size2: [R::ONE; G], first: [R::ZERO; G], rest: [R::ZERO; G] }
    }

    /// Measures the inverse.
    #[inline(always)]
    fn weigh(&mut self, cx: &Context<'_>, group: &Group, matrix: &[[R; G]]) {
        let n = group.rows;
        let mut size2 = [R::ZERO; G];
        for (place, &unknown) in group.unknowns.iter().enumerate() {
            // A column of a rotation is measured in units of the greatest arm that turns with it.
            let lever2 = match unknown {
                Unknown::Class(class) => R::splat(cx.bound.lever2[class]),
                Unknown::Slide(_) => R::ONE,
            };
            let row = &matrix[place * 2 * n + n..][..n];
            for g in 0..G {
                let mut sum = R::ZERO;
                for entry in row {
                    sum += entry[g] * entry[g];
                }
                size2[g] += lever2 * sum;
            }
        }
        self.take_size(size2);
    }

    /// Takes the size of the inverse.
    #[inline(always)]
    pub(crate) fn take_size(&mut self, size2: [R; G]) {
        for g in 0..G {
            self.size2[g] = R::select(self.done[g], self.size2[g], size2[g]);
        }
    }

    /// Lanes that take no second step by the same matrix: what is done or will be by the first
    /// step, and where that was so long that the matrix is not that of the solution (beside a fold
    /// such a step leads to the other assembly).
    #[inline(always)]
    pub(crate) fn waits(&self, first: [R; G]) -> [R::Mask; G] {
        let mut waits = self.done;
        for g in 0..G {
            let turned2 = first[g] * first[g] * self.size2[g];
            let bent = turned2.lt(R::splat(NEWTON_FROZEN_MAX2)).not();
            waits[g] = waits[g].or(bent).or(self.enough(g, first[g]));
        }
        waits
    }

    /// Whether nothing is left after one step: of its error the square remains, by the condition
    /// (Kantorovich's theorem).
    #[inline(always)]
    fn enough(&self, g: usize, first: R) -> R::Mask {
        let left = first * first;
        (left * left * self.size2[g].max(R::ONE)).lt(R::splat(NEWTON_TOLERANCE * NEWTON_TOLERANCE))
    }

    /// Counts the two steps of a round.
    #[inline(always)]
    pub(crate) fn count(
        &mut self,
        first: [R; G],
        second: [R; G],
        waits: &[R::Mask; G],
        is_first: bool,
    ) {
        for g in 0..G {
            let done = self.done[g];
            let second = R::select(waits[g], R::ZERO, second[g]);
            let sum = if is_first { second } else { self.rest[g] + first[g] + second };
            self.rest[g] = R::select(done, self.rest[g], sum);
            if is_first {
                self.first[g] = R::select(done, self.first[g], first[g]);
            }
            // What is left is about the product.
            let left = first[g] * second;
            let settled = waits[g].not().and(left.lt(R::splat(NEWTON_TOLERANCE)));
            let is_short = first[g].lt(R::splat(NEWTON_LAST_STEP)).or(self.enough(g, first[g]));
            self.done[g] = done.or(settled).or(is_short);
        }
    }
}
