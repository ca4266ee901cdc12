//! Kernel for groups of rigid links and turning pairs (see [`crate::plan::binary_links`]).
//!
//! Equations, iteration and stopping rule are those of every group (see `newton`), for one driver. It
//! solves one lane group after another, so that all data stay in a small work space.

use super::newton::NewtonState;
use super::turn::turned;
use super::workspace::{ENTRIES, GroupWorkspace, VectorJet};
use crate::math::derivatives::ONE_DRIVER;
use crate::math::inverse::invert;
use crate::math::lanes::{Mask, Real};
use crate::math::tolerance::{NEWTON_MAX_ROUNDS, NEWTON_MAX_STEP};
use crate::math::vector::Vector;
use crate::plan::binary_links::{Links, MAX_UNKNOWNS};
use crate::plan::group::{BinaryLoops, Group};
use crate::state::state::{Context, State};
use crate::state::status::{Fault, Status};

impl<R: Real, const G: usize> State<R, G> {
    /// Solves a group (step `index`).
    #[inline(always)]
    pub(crate) fn solve_binary_loops(
        &mut self,
        cx: &Context<'_>,
        group: &Group,
        binary: &BinaryLoops,
        index: usize,
    ) {
        let len = self.len.min(ENTRIES);
        let links = binary.links(&cx.constants.spans);
        let mut max_arm2 = [R::ZERO; MAX_UNKNOWNS];
        for (max_arm2, &class) in max_arm2.iter_mut().zip(&binary.classes) {
            *max_arm2 = R::splat(cx.constants.max_arm2[class]);
        }
        let mut wanted = [false; MAX_UNKNOWNS];
        for ((wanted, &class), l) in wanted.iter_mut().zip(&binary.bar_classes).zip(&group.loops) {
            *wanted = self.work.angle_wanted[class] || !l.orientations.is_empty();
        }
        for g in 0..self.groups.min(G) {
            let loops = &mut self.work.loops;
            for (known, l) in loops.known.iter_mut().zip(&group.loops) {
                let (start, end) =
                    (&self.pose.points[l.start * len..], &self.pose.points[l.end * len..]);
                for (known, (start, end)) in known[..len].iter_mut().zip(start.iter().zip(end)) {
                    *known = end[g] - start[g];
                }
            }
            for (unit, &class) in loops.units.iter_mut().zip(&binary.classes) {
                *unit = self.pose.class[class][g];
            }
            let mut work = NewtonState::<R, 1>::new([self.conditions.needs_scalar[g]]);
            let mut last_determinant = self.work.det_sign[group.index][g];
            loops.turn_spans(&links);
            for round in 0..NEWTON_MAX_ROUNDS {
                if work.done[0].all() {
                    break;
                }
                let determinant = loops.invert(&links);
                last_determinant = R::select(work.done[0], last_determinant, determinant);
                work.record_inverse_size([loops.inverse_size2(&links, &max_arm2)]);
                let first = loops.step(&links, work.done[0]);
                let skip = work.skip_second_step([first]);
                loops.turn_spans(&links);
                let mut second = R::ZERO;
                if !skip[0].all() {
                    second = loops.step(&links, skip[0]);
                    loops.turn_spans(&links);
                }
                work.record_steps([first], [second], &skip, round == 0);
            }
            if len > 1 {
                self.work.determinants[group.index][g] = loops.invert(&links);
                loops.find_analogues(&links, len, wanted);
            }
            for (i, &class) in binary.classes.iter().enumerate().take(MAX_UNKNOWNS) {
                self.pose.class[class][g] = loops.units[i];
                for k in 1..len {
                    self.pose.theta[class * len + k][g] = loops.rates[i][k];
                }
            }
            for (i, &class) in binary.bar_classes.iter().enumerate().take(MAX_UNKNOWNS) {
                if !wanted[i] {
                    continue;
                }
                self.pose.class[class][g] = links.bars[i].on_lanes().turn_to(loops.chords[i][0]);
                for k in 1..len {
                    self.pose.theta[class * len + k][g] = loops.bar_rates[i][k];
                }
            }
            for arm in &binary.arms {
                let unknown = arm.unknown.min(MAX_UNKNOWNS - 1);
                let rates = &loops.rates[unknown];
                let v = loops.units[unknown] * Vector::splat(cx.constants.edge_vector[arm.edge]);
                let jet = &mut self.pose.legs[arm.leg * len..][..len];
                jet[0][g] = v;
                for k in 1..len {
                    let mut sum = v.scale(rates[k]);
                    for term in ONE_DRIVER[k] {
                        sum += jet[term.left][g].scale(R::splat(term.factor) * rates[term.right]);
                    }
                    jet[k][g] = sum.left();
                }
            }
            self.work.det_sign[group.index][g] = last_determinant;
            self.conditions.needs_scalar[g] =
                self.conditions.needs_scalar[g].or(work.done[0].not());
            self.work.first_step[g] = self.work.first_step[g].max(work.first_step[0]);
            self.work.later_steps[g] = self.work.later_steps[g].max(work.later_steps[0]);
            if R::LANES == 1 && !work.done[0].all() {
                self.fault = Some(Fault::NotConverged { step: index });
                self.status = Status::NotConverged;
                return;
            }
            self.update_condition(g, cx, group, index, work.inverse_size2[0]);
        }
        let of_unknowns = group.orientations.iter().zip(&binary.classes);
        let of_bars = group.loops.iter().map(|l| &l.orientations).zip(&binary.bar_classes);
        for (orientations, &class) in of_unknowns.chain(of_bars) {
            for &o in orientations {
                for g in 0..self.groups.min(G) {
                    self.update_orientation(g, cx, o, class);
                }
            }
        }
    }
}

impl<R: Real> GroupWorkspace<R> {
    /// Updates spans and chords to the present unknowns.
    #[inline(always)]
    fn turn_spans(&mut self, links: &Links<'_>) {
        for l in 0..links.count.min(MAX_UNKNOWNS) {
            let mut chord = self.known[l][0];
            for unknown in 0..links.count.min(MAX_UNKNOWNS) {
                let span = Vector::splat(links.spans[l * links.count + unknown]);
                let turned = self.units[unknown] * span;
                self.spans[l][unknown][0] = turned;
                chord += turned;
            }
            self.chords[l][0] = chord;
        }
    }

    /// Inverts the Jacobian of the length equations; returns its determinant.
    #[inline(always)]
    fn invert(&mut self, links: &Links<'_>) -> R {
        let n = links.count.min(MAX_UNKNOWNS);
        for l in 0..n {
            let along = self.chords[l][0].scale(R::splat(links.bars[l].inv_norm()));
            for unknown in 0..n {
                // Derivative of the length: unit vector along the chord · i · span.
                self.matrix[l * 2 * n + unknown][0] = self.spans[l][unknown][0].cross(along);
            }
        }
        let [determinant] = invert(&mut self.matrix, n);
        determinant
    }

    /// Square of the weighted norm of the inverse.
    #[inline(always)]
    fn inverse_size2(&self, links: &Links<'_>, max_arm2: &[R; MAX_UNKNOWNS]) -> R {
        let n = links.count.min(MAX_UNKNOWNS);
        let mut size2 = R::ZERO;
        for unknown in 0..n {
            let mut sum = R::ZERO;
            for l in 0..n {
                let entry = self.matrix[unknown * 2 * n + n + l][0];
                sum += entry * entry;
            }
            size2 += max_arm2[unknown] * sum;
        }
        size2
    }

    /// Takes a Newton step with the present inverse on the lanes that are not done; returns the
    /// largest change of an unknown before it is limited.
    #[inline(always)]
    fn step(&mut self, links: &Links<'_>, done: R::Mask) -> R {
        let n = links.count.min(MAX_UNKNOWNS);
        for l in 0..n {
            let excess2 = self.chords[l][0].norm2() - R::splat(links.bars[l].norm2);
            self.residual[l] = excess2 * R::splat(0.5 * links.bars[l].inv_norm());
        }
        let longest = R::splat(NEWTON_MAX_STEP);
        let mut largest = R::ZERO;
        for unknown in 0..n {
            let change = -self.inverse_times_residual(n, unknown);
            let size = change.abs();
            // NaN must count as large, so that it does not look converged.
            largest = R::select(size.le(largest), largest, size);
            let old = self.units[unknown];
            let new = turned(old, change.max(-longest).min(longest));
            self.units[unknown] =
                Vector::new(R::select(done, old.x, new.x), R::select(done, old.y, new.y));
        }
        largest
    }

    /// Product of an unknown's row of the inverse with the residuals.
    #[inline(always)]
    fn inverse_times_residual(&self, n: usize, unknown: usize) -> R {
        let mut sum = R::ZERO;
        for l in 0..n {
            sum += self.matrix[unknown * 2 * n + n + l][0] * self.residual[l];
        }
        sum
    }

    /// Analogues of the unknowns and of the wanted bars. Every order has the same matrix; the
    /// right-hand side follows from lower orders.
    #[inline(always)]
    fn find_analogues(&mut self, links: &Links<'_>, len: usize, wanted: [bool; MAX_UNKNOWNS]) {
        let n = links.count.min(MAX_UNKNOWNS);
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
                // Half the derivative of the square of the length.
                let jet = &self.chords[l];
                let mut sum = jet[0].dot(chord);
                match k {
                    2 => sum += jet[1].norm2(),
                    3 => sum += R::splat(3.0) * jet[1].dot(jet[2]),
                    _ => {}
                }
                self.residual[l] = sum * R::splat(links.bars[l].inv_norm());
            }
            for unknown in 0..n {
                self.rates[unknown][k] = -self.inverse_times_residual(n, unknown);
            }
            for l in 0..n {
                let mut chord = self.chords[l][k];
                for unknown in 0..n {
                    let jet = &mut self.spans[l][unknown];
                    let top = jet[0].left().scale(self.rates[unknown][k]);
                    chord += top;
                    // The last entry is never read.
                    if k == 1 {
                        jet[1] = top;
                    } else if k + 1 < len {
                        jet[k] += top;
                    }
                }
                self.chords[l][k] = chord;
                if !wanted[l] {
                    continue;
                }
                // The chord is rigid: its jet follows from its lower entries.
                let mut top = chord;
                if k > 1 {
                    top = top - without_top(&self.chords[l], &self.bar_rates[l], k);
                }
                self.bar_rates[l][k] =
                    self.chords[l][0].cross(top) * R::splat(links.bars[l].inv_norm2);
            }
        }
    }
}

/// Entry `k` of the jet of a vector that turns with these analogues, without the term in analogue
/// `k` itself.
#[inline(always)]
fn without_top<R: Real>(jet: &VectorJet<R>, rates: &[R; ENTRIES], k: usize) -> Vector<R> {
    let mut sum = Vector::ZERO;
    for term in ONE_DRIVER[k] {
        sum += jet[term.left].scale(R::splat(term.factor) * rates[term.right]);
    }
    sum.left()
}
