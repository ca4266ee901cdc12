//! Whether the attempted steps of environments lead over a dead point.
//!
//! A mechanism that moves on at a dead point of its drivers takes another assembly, while their coordinates turn
//! back there as smoothly as anywhere: a step from before to after it meets every tolerance. But beside the place
//! where they turn back there are coordinates that do not exist.

use super::failures::has_failed;
use super::states::States;

/// Places along a step that are tried, as parts of it: a turn is within a tenth of a step of one.
pub(super) const PLACES: [f64; 5] = [0.1, 0.3, 0.5, 0.7, 0.9];
/// How far beside the way, in changes of speed times width. Within a tenth of a step drivers leave the place of
/// their turn by 0.005 of that.
const BESIDE: f64 = 0.02;
/// The same at least, rad or in sizes: nearer to a dead point nothing shows which way it is.
const LEAST_BESIDE: f64 = 1e-9;
/// Inertias that change by this factor in a step may be those beside a dead point. In proportion to the inverse
/// square of the time to it they change at least by 3.2 from stage to stage; other parts of them stay as they are.
const GREAT_CHANGE: f64 = 1.3;

impl States {
    /// Whether the drivers of an environment may turn back at a dead point in the attempted step: one driver
    /// changes the sign of its speed there, of several the inertias are great.
    pub(super) fn may_turn_back(&self, index: usize, n: usize) -> bool {
        if has_failed(self.status[index]) {
            return false;
        }
        let mut range = index * n..(index + 1) * n;
        if n == 1 {
            return self.speed[index] * self.stage_speed[index] < 0.0;
        }
        let [least, greatest] = &self.inertia;
        range.any(|entry| greatest[entry] > GREAT_CHANGE * least[entry])
    }

    /// Adds the coordinates beside a place of the attempted step of an environment, away from where its drivers
    /// are accelerated to. `units`: a radian, or the size, for each driver.
    pub(super) fn add_beside(&self, index: usize, units: &[f64], part: f64, out: &mut Vec<f64>) {
        let (n, h) = (units.len(), self.h[index]);
        let entries = index * n..(index + 1) * n;
        let change = |entry: usize| h * (self.speed[entry] - self.stage_speed[entry]);
        let each = entries.clone().zip(units);
        let greatest =
            each.fold(0.0, |most: f64, (entry, unit)| most.max((change(entry) / unit).abs()));
        let beside = BESIDE.max(LEAST_BESIDE / greatest);
        for entry in entries {
            // Hermite's cubic, in Horner's form from the start.
            let way = self.stage_q[entry] - self.q[entry];
            let [first, last] = [h * self.speed[entry], h * self.stage_speed[entry]];
            let bend = part * (first + last - 2.0 * way);
            let along = part * (first + part * (3.0 * way - 2.0 * first - last + bend));
            // At rest, without acceleration, there is none.
            let aside = if greatest > 0.0 { beside * change(entry) } else { 0.0 };
            out.push(self.q[entry] + along + aside);
        }
    }
}
