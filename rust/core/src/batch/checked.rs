//! Checked path: blocks with conditions, then single positions.

use std::mem::MaybeUninit;

use super::rows::RowRange;
use super::worker::{Job, Worker, mask};
use crate::branch::location::BranchLocation;
use crate::math::lanes::{Mask, Real};
use crate::state::kernel::Level;
use crate::state::state::Context;
use crate::state::status::Status;

impl<R: Real, const G: usize> Worker<'_, R, G> {
    /// Locates the coordinates among the knots of the branch.
    #[inline(always)]
    pub(super) fn locate(&mut self) {
        let branch = &self.design.branch;
        // Uniform branches with the same number of knots have the same locations for all designs.
        if branch.inverse_width.is_none() || self.space.locations_width != branch.inverse_width {
            self.space.locations.clear();
        }
        self.space.locations_width = branch.inverse_width;
        if branch.at.is_empty() {
            // There is nothing to locate.
            self.space
                .locations
                .resize_with(self.space.coordinates.registers, BranchLocation::default);
        } else if self.space.locations.is_empty() {
            for register in 0..self.space.coordinates.registers {
                self.space.locations.push(branch.locate(self.space.coordinates.q(0, register)));
            }
        }
    }

    /// Lanes that must be solved again as single positions for any result of the vector solution.
    #[inline(always)]
    fn lanes_to_redo(&self, q: R, location: &BranchLocation<R>, with_islands: bool) -> R::Mask {
        let branch = &self.design.branch;
        let must_redo = |i: usize| {
            let at = q.lane(i);
            !branch.covers(at)
                || with_islands && branch.in_untraced_island(location, i)
                || branch.change_near(at, self.design.change_window.reach).is_some()
        };
        mask::<R>(must_redo)
    }

    /// Solves up to `G` registers of positions from `row` on.
    #[inline(always)]
    pub(super) fn solve_checked<L: Level<Register = R>>(
        &mut self,
        job: &mut Job<'_, '_>,
        row: usize,
        count: usize,
    ) {
        let (first, groups) = (row / R::LANES, count.div_ceil(R::LANES));
        let mut redo = [R::Mask::NONE; G];
        let branch = &self.design.branch;
        let closed_forms = self.design.closed_forms;
        let constant_signs = branch.has_constant_signs();
        let (even, smooth) = (branch.inverse_width.is_some(), self.is_smooth);
        for group in 0..groups {
            let q = self.space.coordinates.q(0, first + group);
            let location = &self.space.locations[first + group];
            if !(even || smooth && closed_forms) {
                redo[group] = self.lanes_to_redo(q, location, !closed_forms);
            }
            let branch = &self.design.branch;
            // Lanes to redo are set to NaN: their vector result is not used.
            for driver in 0..self.space.block.pose.q.len() {
                let q = self.space.coordinates.q(driver, first + group);
                self.space.block.pose.q[driver][group] =
                    R::select(redo[group], R::splat(f64::NAN), q);
                self.space.block.pose.unit[driver][group] =
                    self.space.coordinates.unit(driver, first + group);
            }
            if !constant_signs {
                for (sign, groups) in self.space.block.pose.signs.iter_mut().enumerate() {
                    groups[group] = R::from_lanes(|i| branch.signs_at(location, i)[sign]);
                }
            }
        }
        let design = &self.design;
        self.space.block.groups = groups;
        if !closed_forms {
            for group in 0..groups.min(G) {
                let location = &self.space.locations[first + group];
                design.guess(group, &mut self.space.block, &design.branch, location);
            }
        }
        let cx = Context { tape: &self.space.tape, ..design.context(design.derivatives) };
        L::solve(&mut self.space.block, &cx);
        for (redo, unknown) in redo.iter_mut().zip(self.lift(first, groups.min(G))) {
            *redo = redo.or(unknown);
        }
        let (design, state) = (&self.design, &self.space.block);
        let at = job.first + row;
        let with = (&design.constants, &design.units);
        let (mut open, mut some_open, mut again) = ([R::Mask::NONE; G], false, false);
        for group in 0..groups.min(G) {
            redo[group] = redo[group].or(self.space.coordinates.q(0, first + group).finite().not());
            if closed_forms {
                open[group] = state.conditions.open[group].and(redo[group].not());
                some_open |= open[group].any();
                if !(even || self.writer.classes.is_empty()) {
                    // On an island without a knot the angle must be traced.
                    let location = &self.space.locations[first + group];
                    let unseen = |i: usize| {
                        !open[group].lane(i) && design.branch.in_untraced_island(location, i)
                    };
                    redo[group] = redo[group].or(mask::<R>(unseen));
                }
            }
            redo[group] =
                redo[group].or(state.conditions.needs_scalar[group].and(open[group].not()));
            redo[group] = redo[group].or(design.branch.same_det_sign(state, group).not());
            again |= redo[group].any();
        }
        let failed = some_open.then_some(&open);
        // Rows that are solved again would be fetched again.
        let once = !(again || some_open && self.failures.is_some());
        let range = RowRange { first: at, count, once };
        self.writer.write(job.rows, range, with, state, &self.space.lifted, failed);
        let status = &mut job.rows.status[at..at + count];
        for (group, status) in status.chunks_mut(R::LANES).enumerate() {
            let near = state.near_singular(group);
            if !near.or(open[group]).any() {
                continue;
            }
            for (lane, status) in status.iter_mut().enumerate() {
                if open[group].lane(lane) {
                    *status = MaybeUninit::new(Status::Unreachable as u8);
                } else if near.lane(lane) {
                    *status = MaybeUninit::new(Status::NearSingular as u8);
                }
            }
        }
        if some_open && let Some(log) = &mut self.failures {
            for position in 0..count {
                let (group, lane) = (position / R::LANES, position % R::LANES);
                if open[group].lane(lane) && !log.count_later(job.index + row + position, 1) {
                    // The first failure needs a description.
                    redo[group] = redo[group].or(mask::<R>(|i| i == lane));
                    again = true;
                }
            }
        }
        if again {
            self.solve_lanes(job, row, count, &redo);
        }
    }

    /// Solves some lanes of a block one by one.
    #[inline(always)]
    pub(super) fn solve_lanes(
        &mut self,
        job: &mut Job<'_, '_>,
        row: usize,
        count: usize,
        lanes: &[R::Mask; G],
    ) {
        for position in 0..count {
            if self.is_cancelled() {
                return;
            }
            if lanes[position / R::LANES].lane(position % R::LANES) {
                self.solve_scalar(job, row + position);
            }
        }
    }
}
