//! What the stages of attempted steps show of drivers that turn back.
//!
//! A single driver that turns back changes the sign of its speed. Of several, each may swing on while their way
//! turns back at a dead point, but inertias grow beside it.

use crate::dynamics::reactions::lane_rows::Rows;
use crate::math::lanes::{LANES, Mask, Real, place_in_blocks};

/// Inertias that change by this factor in a step may be those beside a dead point. In proportion to the inverse
/// square of the time to it they change at least by 3.2 from stage to stage; other parts of them stay as they are.
const GREAT_CHANGE: f64 = 1.3;

/// The drivers of the environments of a chunk in attempted steps.
#[derive(Debug, Default)]
pub(super) struct Turns {
    drivers: usize,
    /// Whether a single driver has moved against its speed at the start.
    has_turned: Vec<bool>,
    /// Least and greatest inertias of several drivers at the stages, in blocks.
    inertias: [Vec<f64>; 2],
}

impl Turns {
    /// Begins steps of some environments.
    pub(super) fn start(&mut self, count: usize, drivers: usize) {
        self.drivers = drivers;
        self.has_turned.clear();
        self.has_turned.resize(count, false);
        if drivers > 1 {
            for inertias in &mut self.inertias {
                inertias.resize(count.next_multiple_of(LANES) * drivers, 0.0);
            }
        }
    }

    /// Notes the speed of a driver at a stage, and at the start.
    #[inline(always)]
    pub(super) fn note_speed<R: Real>(&mut self, rows: Rows, speed: R, start: R) {
        if self.drivers > 1 {
            return;
        }
        let turns = (speed * start).lt(R::ZERO);
        if turns.any() {
            let has_turned = self.has_turned.iter_mut().skip(rows.first).take(R::LANES);
            for (lane, has_turned) in has_turned.enumerate() {
                *has_turned |= turns.lane(lane);
            }
        }
    }

    /// Notes the inertia of a driver at a stage, the first of the step or another.
    #[inline(always)]
    pub(super) fn note_inertia<R: Real>(
        &mut self,
        rows: Rows,
        driver: usize,
        inertia: impl FnOnce() -> R,
        is_first: bool,
    ) {
        if self.drivers == 1 {
            return;
        }
        let inertia = inertia();
        let place = place_in_blocks(rows.first, self.drivers, driver);
        let [least, greatest] =
            self.inertias.each_mut().map(|values| &mut values[place..place + R::LANES]);
        let (mut smaller, mut greater) = (inertia, inertia);
        if !is_first {
            smaller = inertia.min(R::read(least));
            greater = inertia.max(R::read(greatest));
        }
        for lane in 0..R::LANES {
            least[lane] = smaller.lane(lane);
            greatest[lane] = greater.lane(lane);
        }
    }

    /// Whether the drivers of an environment may turn back at a dead point in the attempted step.
    pub(super) fn may_turn_back(&self, index: usize) -> bool {
        if self.drivers == 1 {
            return self.has_turned[index];
        }
        let [least, greatest] = &self.inertias;
        (0..self.drivers).any(|driver| {
            let place = place_in_blocks(index, self.drivers, driver);
            changes_greatly(least[place], greatest[place])
        })
    }

    /// Whether some may; few steps have such ones.
    pub(super) fn some_may_turn_back(&self) -> bool {
        // No search that stops at the first: this reads them by vectors.
        if self.drivers == 1 {
            return self.has_turned.iter().fold(false, |some, &has_turned| some | has_turned);
        }
        let [least, greatest] = &self.inertias;
        let each = least.iter().zip(greatest);
        each.fold(false, |some, (&least, &greatest)| some | changes_greatly(least, greatest))
    }
}

/// Whether an inertia between these may be that beside a dead point.
#[inline(always)]
fn changes_greatly(least: f64, greatest: f64) -> bool {
    greatest > GREAT_CHANGE * least
}
