//! Groups above class II of rigid links and turning pairs (see [`crate::plan::binary_links`]).
//!
//! The same equations, the same iteration and the same ends of it as of every group (see
//! `group`), with one driver; eight positions after eight, so that all of it stays in a small
//! work space.

use super::newton::NewtonState;
use super::turn::turned;
use super::workspace::{ENTRIES, GroupWorkspace, VectorJet};
use crate::math::derivatives::ONE_DRIVER;
use crate::math::inverse::invert;
use crate::math::lanes::{Mask, Real};
use crate::math::tolerance::{NEWTON_MAX_ROUNDS, NEWTON_MAX_STEP};
use crate::math::vector::Vector;
use crate::plan::binary_links::{Links, MOST};
use crate::plan::group::{BinaryLoops, Group};
use crate::state::state::{Context, State};
use crate::state::status::{Fault, Status};

impl<R: Real, const G: usize> State<R, G> {
    /// Solves a group (step `index`).
    #[inline(always)]
    pub(crate) fn solve_bars(
        &mut self,
        cx: &Context<'_>,
        group: &Group,
        bars: &BinaryLoops,
        index: usize,
    ) {
        let len = self.len.min(ENTRIES);
        let links = bars.links(&cx.bound.spans);
        let mut lever2 = [R::ZERO; MOST];
        for (lever2, &class) in lever2.iter_mut().zip(&bars.classes) {
            *lever2 = R::splat(cx.bound.lever2[class]);
        }
        let mut asked = [false; MOST];
        for ((asked, &class), l) in asked.iter_mut().zip(&bars.taken).zip(&group.loops) {
            *asked = self.asked[class] || !l.turned.is_empty();
        }
        for g in 0..self.groups.min(G) {
            let loops = &mut self.loops;
            for (known, l) in loops.known.iter_mut().zip(&group.loops) {
                let (start, end) = (&self.points[l.start * len..], &self.points[l.end * len..]);
                for (known, (start, end)) in known[..len].iter_mut().zip(start.iter().zip(end)) {
                    *known = end[g] - start[g];
                }
            }
            for (unit, &class) in loops.units.iter_mut().zip(&bars.classes) {
                *unit = self.class[class][g];
            }
            let mut work = NewtonState::<R, 1>::new([self.care[g]]);
            let mut bend = self.bends[group.index][g];
            loops.place(&links);
            for round in 0..NEWTON_MAX_ROUNDS {
                if work.done[0].all() {
                    break;
                }
                let determinant = loops.invert(&links);
                bend = R::select(work.done[0], bend, determinant);
                work.take_size([loops.size2(&links, &lever2)]);
                let first = loops.step(&links, work.done[0]);
                let waits = work.waits([first]);
                loops.place(&links);
                let mut second = R::ZERO;
                if !waits[0].all() {
                    second = loops.step(&links, waits[0]);
                    loops.place(&links);
                }
                work.count([first], [second], &waits, round == 0);
            }
            if len > 1 {
                self.determinants[group.index][g] = loops.invert(&links);
                loops.find_rates(&links, len, asked);
            }
            for (place, &class) in bars.classes.iter().enumerate().take(MOST) {
                self.class[class][g] = loops.units[place];
                for k in 1..len {
                    self.theta[class * len + k][g] = loops.rates[place][k];
                }
            }
            for (place, &class) in bars.taken.iter().enumerate().take(MOST) {
                if !asked[place] {
                    continue;
                }
                self.class[class][g] = links.bars[place].on_lanes().turn_to(loops.chords[place][0]);
                for k in 1..len {
                    self.theta[class * len + k][g] = loops.taken[place][k];
                }
            }
            for arm in &bars.arms {
                let unknown = arm.unknown.min(MOST - 1);
                let rates = &loops.rates[unknown];
                let v = loops.units[unknown] * Vector::splat(cx.bound.rigid[arm.edge]);
                let jet = &mut self.legs[arm.leg * len..][..len];
                jet[0][g] = v;
                for k in 1..len {
                    let mut sum = v.scale(rates[k]);
                    for term in ONE_DRIVER[k] {
                        sum += jet[term.left][g].scale(R::splat(term.factor) * rates[term.right]);
                    }
                    jet[k][g] = sum.left();
                }
            }
            self.bends[group.index][g] = bend;
            self.care[g] = self.care[g].or(work.done[0].not());
            self.first_step[g] = self.first_step[g].max(work.first[0]);
            self.later_steps[g] = self.later_steps[g].max(work.rest[0]);
            if R::LANES == 1 && !work.done[0].all() {
                self.fault = Some(Fault::NotConverged { step: index });
                self.status = Status::NotConverged;
                return;
            }
            self.judge(g, cx, group, index, work.size2[0]);
        }
        let unknown = group.turned.iter().zip(&bars.classes);
        let taken = group.loops.iter().map(|l| &l.turned).zip(&bars.taken);
        for (turned, &class) in unknown.chain(taken) {
            for &o in turned {
                for g in 0..self.groups.min(G) {
                    self.turn_other(g, cx, o, class);
                }
            }
        }
    }
}

impl<R: Real> GroupWorkspace<R> {
    /// Spans and chords at the unknowns.
    #[inline(always)]
    fn place(&mut self, links: &Links<'_>) {
        for l in 0..links.count.min(MOST) {
            let mut chord = self.known[l][0];
            for unknown in 0..links.count.min(MOST) {
                let span = Vector::splat(links.spans[l * links.count + unknown]);
                let turned = self.units[unknown] * span;
                self.spans[l][unknown][0] = turned;
                chord += turned;
            }
            self.chords[l][0] = chord;
        }
    }

    /// The inverse of the derivatives of what the lengths miss; their determinant.
    #[inline(always)]
    fn invert(&mut self, links: &Links<'_>) -> R {
        let n = links.count.min(MOST);
        for l in 0..n {
            let along = self.chords[l][0].scale(R::splat(links.bars[l].per_norm()));
            for unknown in 0..n {
                // Along the chord · i · span.
                self.matrix[l * 2 * n + unknown][0] = self.spans[l][unknown][0].cross(along);
            }
        }
        let [determinant] = invert(&mut self.matrix, n);
        determinant
    }

    /// Square of the size of the inverse.
    #[inline(always)]
    fn size2(&self, links: &Links<'_>, lever2: &[R; MOST]) -> R {
        let n = links.count.min(MOST);
        let mut size2 = R::ZERO;
        for unknown in 0..n {
            let mut sum = R::ZERO;
            for l in 0..n {
                let entry = self.matrix[unknown * 2 * n + n + l][0];
                sum += entry * entry;
            }
            size2 += lever2[unknown] * sum;
        }
        size2
    }

    /// Takes a step by the inverse at hand, on the lanes that are not done; how great a change
    /// was asked for.
    #[inline(always)]
    fn step(&mut self, links: &Links<'_>, done: R::Mask) -> R {
        let n = links.count.min(MOST);
        for l in 0..n {
            let lack = self.chords[l][0].norm2() - R::splat(links.bars[l].norm2);
            self.missing[l] = lack * R::splat(0.5 * links.bars[l].per_norm());
        }
        let most = R::splat(NEWTON_MAX_STEP);
        let mut greatest = R::ZERO;
        for unknown in 0..n {
            let change = -self.by_inverse(n, unknown);
            let size = change.abs();
            // No number counts as great.
            greatest = R::select(size.le(greatest), greatest, size);
            let old = self.units[unknown];
            let new = turned(old, change.max(-most).min(most));
            self.units[unknown] =
                Vector::new(R::select(done, old.x, new.x), R::select(done, old.y, new.y));
        }
        greatest
    }

    /// Row of an unknown in the inverse, by what is missing.
    #[inline(always)]
    fn by_inverse(&self, n: usize, unknown: usize) -> R {
        let mut sum = R::ZERO;
        for l in 0..n {
            sum += self.matrix[unknown * 2 * n + n + l][0] * self.missing[l];
        }
        sum
    }

    /// Analogues of the unknowns and of the binary links asked for: at every order the same matrix,
    /// as right-hand side what is known of that order.
    #[inline(always)]
    fn find_rates(&mut self, links: &Links<'_>, len: usize, asked: [bool; MOST]) {
        let n = links.count.min(MOST);
        for k in 1..len.min(ENTRIES) {
            for l in 0..n {
                let mut chord = self.known[l][k];
                if k > 1 {
                    for unknown in 0..n {
                        let span = without_top(&self.spans[l][unknown], &self.rates[unknown], k);
                        self.spans[l][unknown][k] = span;
                        chord += span;
                    }
                }
                self.chords[l][k] = chord;
                // Half of the derivative of the square of the length.
                let jet = &self.chords[l];
                let mut sum = jet[0].dot(chord);
                match k {
                    2 => sum += jet[1].norm2(),
                    3 => sum += R::splat(3.0) * jet[1].dot(jet[2]),
                    _ => {}
                }
                self.missing[l] = sum * R::splat(links.bars[l].per_norm());
            }
            for unknown in 0..n {
                self.rates[unknown][k] = -self.by_inverse(n, unknown);
            }
            for l in 0..n {
                let mut chord = self.chords[l][k];
                for unknown in 0..n {
                    let jet = &mut self.spans[l][unknown];
                    let top = jet[0].left().scale(self.rates[unknown][k]);
                    chord += top;
                    // Nobody asks for the last.
                    if k == 1 {
                        jet[1] = top;
                    } else if k + 1 < len {
                        jet[k] += top;
                    }
                }
                self.chords[l][k] = chord;
                if !asked[l] {
                    continue;
                }
                // The chord turns as a whole.
                let mut top = chord;
                if k > 1 {
                    top = top - without_top(&self.chords[l], &self.taken[l], k);
                }
                self.taken[l][k] = self.chords[l][0].cross(top) * R::splat(links.bars[l].per);
            }
        }
    }
}

/// Entry `k` of the jet of a vector that turns with these analogues, from those before, but for
/// the term in the analogue `k` itself.
#[inline(always)]
fn without_top<R: Real>(jet: &VectorJet<R>, rates: &[R; ENTRIES], k: usize) -> Vector<R> {
    let mut sum = Vector::ZERO;
    for term in ONE_DRIVER[k] {
        sum += jet[term.left].scale(R::splat(term.factor) * rates[term.right]);
    }
    sum.left()
}
