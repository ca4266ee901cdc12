//! Designs without change points, on tapes with kernels alone: their positions are computed bare,
//! block by block. A block with a doubtful position is left to the careful path.

use std::mem::MaybeUninit;

use super::worker::{Job, Worker, mask};
use crate::branch::uniform::reference_of;
use crate::math::angle::unwrap_to;
use crate::math::lanes::{Mask, Real};
use crate::state::kernel::Level;
use crate::state::state::Context;
use crate::state::status::Status;

impl<R: Real, const G: usize> Worker<'_, R, G> {
    /// Whether the design is of that kind.
    #[inline(always)]
    pub(super) fn is_plain(&self) -> bool {
        let branch = &self.design.branch;
        self.tape.is_bounded && branch.is_plain() && branch.has_constant_signs()
    }

    /// Finds for every class asked for an angle from which its whole turns follow everywhere; true
    /// if some class has none, so that positions must be located among the knots.
    #[inline(always)]
    pub(super) fn find_references(&mut self) -> bool {
        let branch = &self.design.branch;
        let classes = branch.gain.len();
        for &class in &self.writer.classes {
            if branch.inverse_width.is_none() || branch.gain[class] != 0.0 {
                return true;
            }
            let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
            for &angle in branch.angles[class..].iter().step_by(classes) {
                least = if angle < least { angle } else { least };
                most = if angle > most { angle } else { most };
            }
            let Some(reference) = reference_of([least, most]) else { return true };
            self.references[class] = reference;
        }
        false
    }

    /// Solves up to `G` registers of positions, whose status is `Ok` as yet; false if some position is
    /// doubtful, and nothing is written.
    #[inline(always)]
    pub(super) fn solve_bare<L: Level<Register = R>>(
        &mut self,
        job: &mut Job<'_, '_>,
        row: usize,
        count: usize,
        located: bool,
    ) -> bool {
        let block = row / (G * R::LANES);
        self.coordinates.swap(block, &mut self.many);
        let solved = self.solve_loaded::<L>(job, row, count, located);
        self.coordinates.swap(block, &mut self.many);
        solved
    }

    #[inline(always)]
    fn solve_loaded<L: Level<Register = R>>(
        &mut self,
        job: &mut Job<'_, '_>,
        row: usize,
        count: usize,
        located: bool,
    ) -> bool {
        let (first, groups) = (row / R::LANES, count.div_ceil(R::LANES).min(G));
        self.many.groups = groups;
        let design = &self.design;
        let cx = Context { tape: &self.tape, ..design.context(design.derivatives) };
        // Stores to memory would wait for it; meanwhile the positions are computed.
        for (column, of) in job.rows.columns.iter().zip(self.columns) {
            let first = job.first + row;
            R::prefetch(&column[first * of.width..(first + count) * of.width]);
        }
        L::bare(&mut self.many, &cx);
        let state = &self.many;
        let (mut doubtful, mut open) = (R::Mask::NONE, R::Mask::NONE);
        for group in 0..groups {
            doubtful = doubtful.or(state.doubtful(group));
            open = open.or(state.open[group]);
        }
        if doubtful.any() {
            return false;
        }
        let some_open = open.any();
        if located && !self.lift_by_knots(first, groups) {
            return false;
        }
        if some_open && !self.is_counted(job, row, count) {
            return false;
        }
        let (design, state) = (&self.design, &self.many);
        let at = job.first + row;
        let with = (&design.constants, &design.units);
        let failed = some_open.then_some(&state.open);
        let rows = &mut *job.rows;
        if located {
            self.writer.write(rows, (at, count), with, state, &self.lifted, failed);
        } else {
            let references = &self.references[..];
            self.writer.write_plain::<L::Stride, R, G>(
                rows,
                (at, count),
                with,
                state,
                references,
                failed,
            );
        }
        if some_open {
            let status = &mut job.rows.status[at..at + count];
            let state = &self.many;
            for (group, status) in status.chunks_mut(R::LANES).enumerate() {
                let open = state.open[group].bits();
                for (lane, status) in status.iter_mut().enumerate() {
                    let own = [Status::Ok, Status::Unreachable][(open >> lane & 1) as usize];
                    *status = MaybeUninit::new(own as u8);
                }
            }
        }
        true
    }

    /// Lifts angles to those of the knots beside them; false if one is on an island that no knot has
    /// seen, to which it has to be followed.
    #[inline(always)]
    fn lift_by_knots(&mut self, first: usize, groups: usize) -> bool {
        let branch = &self.design.branch;
        for &class in &self.writer.classes {
            for group in 0..groups {
                let location = &self.locations[first + group];
                let angle = self.many.class[class][group].unit_angle();
                self.lifted[class][group] =
                    unwrap_to(angle, branch.reference_angle(location, class));
                if branch.inverse_width.is_none() {
                    let unseen = |lane: usize| {
                        !self.many.open[group].lane(lane)
                            && branch.in_untraced_island(location, lane)
                    };
                    if mask::<R>(unseen).any() {
                        return false;
                    }
                }
            }
        }
        true
    }

    /// Counts the positions that are open, if none of them has to be described.
    #[inline(always)]
    fn is_counted(&self, job: &Job<'_, '_>, row: usize, count: usize) -> bool {
        let Some(log) = self.failures else { return true };
        let (mut first, mut number) = (None, 0);
        for group in 0..count.div_ceil(R::LANES).min(G) {
            let before = group * R::LANES;
            let own = u32::MAX >> (u32::BITS as usize - R::LANES.min(count - before));
            let open = self.many.open[group].bits() & own;
            if open != 0 {
                first.get_or_insert(before + open.trailing_zeros() as usize);
                number += open.count_ones() as usize;
            }
        }
        first.is_none_or(|first| log.count_later(job.index + row + first, number))
    }
}
