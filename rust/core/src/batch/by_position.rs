//! Scalar path: positions that lanes cannot decide.

use std::mem::MaybeUninit;

use super::rows::RowRange;
use super::worker::{Job, Worker};
use crate::branch::position::BranchPoint;
use crate::math::angle::unwrap_to;
use crate::math::lanes::Real;
use crate::query::failure::Failure;
use crate::state::status::{Rejection, Status};

impl<R: Real, const G: usize> Worker<'_, R, G> {
    /// Solves positions one by one.
    pub(super) fn solve_by_position(&mut self, job: &mut Job<'_, '_>, first: usize, count: usize) {
        for row in first..first + count {
            if self.is_cancelled() {
                return;
            }
            self.solve_scalar(job, row);
        }
    }

    /// Solves a single position.
    #[cold]
    #[inline(never)]
    pub(super) fn solve_scalar(&mut self, job: &mut Job<'_, '_>, row: usize) {
        let drivers = self.design.mechanism.q0().len();
        let q = self.design.scaled(&job.q[row * drivers..][..drivers]);
        let mut point = self.design.branch_to(&q);
        if self.depends_on_request && point.as_ref().is_some_and(BranchPoint::is_in_untraced_island)
        {
            drop(point);
            self.trace_again(job);
            point = self.design.branch_to(&q);
        }
        let state = &mut self.space.single;
        self.design.prepare(state);
        let analogues = self.design.solve(state, &q, point.as_ref());
        let at = job.first + row;
        let solved = matches!(state.status, Status::Ok | Status::NearSingular | Status::Singular);
        let no_analogues = !analogues && self.columns.iter().any(|column| column.order > 0);
        if let (Some(log), true) = (&self.failures, !solved || no_analogues) {
            let (status, fault) = (state.status, state.fault);
            let q = &job.q[row * drivers..][..drivers];
            let describe = || Failure::of(&self.design, Rejection::Failed { status, fault }, q);
            log.record(job.index + row, 1, describe);
        }
        let (true, Some(point)) = (solved, &point) else {
            job.rows.write_failed(self.columns, at, 1, state.status as u8);
            return;
        };
        let near = self.design.reference_angles(point, self.space.lifted.len());
        let lift = |class: usize| [unwrap_to(state.pose.class[class][0].unit_angle(), near[class])];
        let lifted: Vec<[f64; 1]> = (0..near.len()).map(lift).collect();
        let with = (&self.design.constants, &self.design.units);
        self.writer.write(job.rows, RowRange::single(at), with, state, &lifted, None);
        if !analogues {
            job.rows.write_nan(self.columns, 1, at, 1);
        }
        job.rows.status[at] = MaybeUninit::new(state.status as u8);
    }

    /// Traces a driven slide knot by knot, because its knots in lanes have missed an island: which islands
    /// they find depends on the requested positions, and angles beyond depend on that. Up to the first
    /// gap both are the same.
    #[cold]
    #[inline(never)]
    fn trace_again(&mut self, job: &Job<'_, '_>) {
        self.design.trace_knot_by_knot(job.q);
        self.depends_on_request = false;
        self.is_smooth = self.design.is_smooth(job.q);
        // They are located again before the next block.
        self.space.locations.clear();
    }
}
