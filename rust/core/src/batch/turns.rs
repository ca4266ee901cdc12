//! Whole turns of angles: from the knots of the branch or, with several drivers, along the straight path to
//! each position.

use super::worker::Worker;
use crate::math::angle::unwrap_to;
use crate::math::lanes::{Mask, Real};

impl<R: Real, const G: usize> Worker<'_, R, G> {
    /// Whether the turns of requested angles depend on the path to each position.
    #[inline(always)]
    pub(super) fn turns_by_path(&self) -> bool {
        !self.design.chord_paths.is_empty()
    }

    /// Unwraps the angles of a block that was solved, whose registers are those from `first` on; returns
    /// the lanes in which the path must be followed.
    #[inline(always)]
    pub(super) fn lift(&mut self, first: usize, groups: usize) -> [R::Mask; G] {
        let by_path = self.turns_by_path();
        let unknown = if by_path { self.find_turns(groups) } else { [R::Mask::NONE; G] };
        let space = &mut *self.space;
        // A separate loop: independent arctangents overlap.
        for &class in &self.writer.classes {
            for g in 0..groups {
                space.lifted[class][g] = space.block.pose.class[class][g].unit_angle();
            }
        }
        for &class in &self.writer.classes {
            for g in 0..groups {
                let near = if by_path {
                    space.near[class][g]
                } else {
                    self.design.branch.reference_angle(&space.locations[first + g], class)
                };
                space.lifted[class][g] = unwrap_to(space.lifted[class][g], near);
            }
        }
        unknown
    }

    /// Sets angles near those of the block that was solved; returns the lanes in which the path must be
    /// followed. Lanes that do not close need none.
    #[inline(always)]
    fn find_turns(&mut self, groups: usize) -> [R::Mask; G] {
        let mut unknown = [R::Mask::NONE; G];
        let (design, space) = (&self.design, &mut *self.space);
        let plan = design.mechanism.plan();
        let is_only = design.chord_paths.len() == 1;
        for (group, unknown) in unknown.iter_mut().enumerate().take(groups) {
            for (driver, (moved, &q0)) in space.moved.iter_mut().zip(&design.q0).enumerate() {
                *moved = space.block.pose.q[driver][group] - R::splat(q0);
            }
            let open = space.block.conditions.open[group];
            for path in &design.chord_paths {
                let turned = path.turned(plan, &space.moved);
                let (angle, missing) = path.end_angle(&turned, open, is_only);
                for (class, middle) in path.legs {
                    space.near[class][group] = angle + R::splat(middle);
                }
                *unknown = unknown.or(missing);
            }
        }
        unknown
    }
}
