//! The path without checks: designs without change points whose dyads all have kernels. Blocks are computed
//! without conditions; a block with an uncertain position is left to the checked path.

use std::mem::MaybeUninit;

use super::rows::RowRange;
use super::worker::{Job, Worker, mask};
use crate::branch::lanes::uniform::reference_of;
use crate::math::angle::unwrap_to;
use crate::math::lanes::{LANES, Mask, Real};
use crate::state::kernel::Level;
use crate::state::state::Context;
use crate::state::status::Status;

impl<R: Real, const G: usize> Worker<'_, R, G> {
    /// Whether the design needs no checks: only a bound that shows which positions are uncertain.
    #[inline(always)]
    pub(super) fn needs_no_checks(&self) -> bool {
        let branch = &self.design.branch;
        self.space.tape.is_bounded && self.is_smooth && branch.has_constant_signs()
    }

    /// Finds a turn reference for every requested class. Returns true if a class has none: positions
    /// must then be located among the knots.
    #[inline(always)]
    pub(super) fn find_references(&mut self) -> bool {
        let branch = &self.design.branch;
        let classes = branch.gain.len();
        for &class in &self.writer.classes {
            if branch.inverse_width.is_none() || branch.gain[class] != 0.0 {
                return true;
            }
            let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
            for &angle in branch.angles[class..].iter().step_by(classes) {
                low = if angle < low { angle } else { low };
                high = if angle > high { angle } else { high };
            }
            let Some(reference) = reference_of([low, high]) else { return true };
            self.space.references[class] = reference;
        }
        false
    }

    /// Solves up to `G` registers of positions, whose status is already set to `Ok`. Returns false and
    /// writes nothing if a position is uncertain.
    #[inline(always)]
    pub(super) fn solve_unchecked<L: Level<Register = R>>(
        &mut self,
        job: &mut Job<'_, '_>,
        row: usize,
        count: usize,
        located: bool,
    ) -> bool {
        let block = row / (self.space.coordinates.block * R::LANES);
        self.space.coordinates.swap(block, &mut self.space.block);
        let solved = self.solve_loaded::<L>(job, row, count, located);
        self.space.coordinates.swap(block, &mut self.space.block);
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
        self.space.block.groups = groups;
        let design = &self.design;
        let cx = Context { tape: &self.space.tape, ..design.context(design.derivatives) };
        let range = RowRange { first: job.first + row, count, once: true };
        // The memory arrives while the positions are computed.
        job.rows.prefetch::<R>(self.columns, range);
        L::unchecked(&mut self.space.block, &cx);
        let state = &self.space.block;
        let is_finite = self.space.coordinates.are_finite;
        if if is_finite { state.has_uncertain_dyads() } else { state.is_uncertain() } {
            return false;
        }
        let some_open = self.space.block.has_open();
        let mut unknown = None;
        if located && self.turns_by_path() {
            unknown = Some(self.lift(first, groups));
        } else if located && !self.lift_by_knots(first, groups) {
            return false;
        }
        if some_open && !self.is_counted(job, row, count) {
            return false;
        }
        let (design, state) = (&self.design, &self.space.block);
        let with = (&design.constants, &design.units);
        let failed = some_open.then_some(&state.conditions.open);
        let rows = &mut *job.rows;
        if located {
            self.writer.write(rows, range, with, state, &self.space.lifted, failed);
        } else {
            let references = &self.space.references[..];
            self.writer
                .write_unchecked::<L::Stride, R, G>(rows, range, with, state, references, failed);
        }
        if some_open {
            let status = &mut job.rows.status[range.first..range.first + count];
            let state = &self.space.block;
            for (group, status) in status.chunks_mut(R::LANES).enumerate() {
                let codes = open_codes(state.conditions.open[group].bits()).map(MaybeUninit::new);
                if status.len() == R::LANES {
                    status.copy_from_slice(&codes[..R::LANES]);
                } else {
                    status.copy_from_slice(&codes[..status.len()]);
                }
            }
        }
        if let Some(lanes) = unknown {
            self.solve_lanes(job, row, count, &lanes);
        }
        true
    }

    /// Unwraps angles to those of the neighbouring knots; false if one is on an island without a knot,
    /// which must be traced.
    #[inline(always)]
    fn lift_by_knots(&mut self, first: usize, groups: usize) -> bool {
        let branch = &self.design.branch;
        for &class in &self.writer.classes {
            for group in 0..groups {
                let location = &self.space.locations[first + group];
                let angle = self.space.block.pose.class[class][group].unit_angle();
                self.space.lifted[class][group] =
                    unwrap_to(angle, branch.reference_angle(location, class));
                if branch.inverse_width.is_none() {
                    let unseen = |lane: usize| {
                        !self.space.block.conditions.open[group].lane(lane)
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

    /// Counts the positions that do not close; false if the first of them needs a description.
    #[inline(always)]
    fn is_counted(&mut self, job: &Job<'_, '_>, row: usize, count: usize) -> bool {
        let Some(log) = &mut self.failures else { return true };
        let (mut first, mut number) = (None, 0);
        for group in 0..count.div_ceil(R::LANES).min(G) {
            let before = group * R::LANES;
            let used_lanes = u32::MAX >> (u32::BITS as usize - R::LANES.min(count - before));
            let open = self.space.block.conditions.open[group].bits() & used_lanes;
            if open != 0 {
                first.get_or_insert(before + open.trailing_zeros() as usize);
                number += open.count_ones() as usize;
            }
        }
        first.is_none_or(|first| log.count_later(job.index + row + first, number))
    }
}

/// The status of eight positions, given a bit for each that does not close (the lowest for the
/// first).
#[inline(always)]
fn open_codes(open: u32) -> [u8; LANES] {
    const ONES: u64 = 0x0101_0101_0101_0101;
    // Each byte keeps one bit; adding 127 carries it to the top of the byte.
    let spread = (u64::from(open) * ONES) & 0x8040_2010_0804_0201;
    let set = ((spread + 0x7f * ONES) >> 7) & ONES;
    (set * Status::Unreachable as u64).to_le_bytes()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_of_open_positions() {
        for open in 0..256 {
            let expected = [0, 1, 2, 3, 4, 5, 6, 7].map(|lane| match open >> lane & 1 {
                0 => Status::Ok as u8,
                _ => Status::Unreachable as u8,
            });
            assert_eq!(open_codes(open), expected, "{open:b}");
        }
    }
}
