//! Whether the attempted steps of environments lead over a dead point.
//!
//! A mechanism that moves on at a dead point of its drivers takes another assembly, while their coordinates turn
//! back there as smoothly as anywhere: a step from before to after it meets every tolerance. But beside the place
//! where they turn back there are coordinates that do not exist.

use super::failures::{has_failed, note_positions};
use super::step_batch::{StepBatch, StepWorker};
use crate::batch::dispatch::Entry;
use crate::batch::motion::Asked;
use crate::dynamics::kinetostatics::positions::DesignPositions;

/// Places along a step that are tried, as parts of it: a turn is within a tenth of a step of one.
const PLACES: [f64; 5] = [0.1, 0.3, 0.5, 0.7, 0.9];
/// How far beside the way of an accurate step, in changes of speed times width. Within a tenth of a step drivers
/// leave the place of their turn by 0.005 of that.
const BESIDE: f64 = 0.02;
/// How far beside that of a coarse step, which may turn anywhere before a dead point that it does not resolve. From
/// the start, at the speed v, a dead point at the time t of the step is v t / 2 away.
const BESIDE_COARSE: f64 = 0.5;
/// The greatest relative tolerance of accurate steps.
const ACCURATE: f64 = 1e-6;
/// The least way beside, rad or in sizes: nearer to a dead point nothing shows which way it is.
const LEAST_BESIDE: f64 = 1e-9;

/// Attempted steps of environments, drivers fastest: coordinates and speeds before and after them.
#[derive(Debug, Clone, Copy)]
pub(super) struct Attempted<'a> {
    pub start: [&'a [f64]; 2],
    pub end: [&'a [f64]; 2],
    /// Their widths, or that of all.
    pub h: &'a [f64],
    /// The relative tolerance that they keep, if they keep any.
    pub tolerance: Option<f64>,
}

/// The room for the coordinates beside attempted steps.
#[derive(Debug, Default)]
pub(super) struct DeadPoints {
    beside: Vec<f64>,
}

impl DeadPoints {
    /// Notes which attempted steps lead over a dead point, of `suspects`: the environments whose drivers may
    /// turn back. `size`: of the design that was solved last.
    pub(super) fn note<'b, L: Entry, const G: usize>(
        &mut self,
        (batch, worker): (&StepBatch<'b>, &mut StepWorker<'b, L::Register, G>),
        (asked, size): (&Asked<'_>, f64),
        (suspects, steps): (&[usize], Attempted<'_>),
        status: &mut [u8],
    ) {
        if suspects.is_empty() {
            return;
        }
        let links = batch.equations.positions.plan.driven_links.iter();
        let units: Vec<f64> = links.map(|link| if link.is_some() { 1.0 } else { size }).collect();
        let rest = &vec![0.0; units.len()];
        for part in PLACES {
            self.beside.clear();
            for &index in suspects {
                steps.add_beside(index, &units, part, &mut self.beside);
            }
            let rows = asked.rows.start..asked.rows.start + suspects.len();
            let positions = Asked { q: &self.beside, rows, ..*asked };
            let read = &mut |design: DesignPositions<'_>| {
                let each = suspects.iter().zip(design.status);
                for (&index, &now) in each.filter(|(_, now)| has_failed(**now)) {
                    note_positions(&mut status[index..=index], &[now]);
                }
            };
            let solved = &batch.equations.positions;
            solved.solve_design::<L, G>(&mut worker.positions, &positions, rest, read);
        }
    }
}

impl Attempted<'_> {
    /// Adds the coordinates beside a place of the attempted step of an environment, away from where its drivers
    /// are accelerated to. `units`: a radian, or the size, for each driver.
    fn add_beside(&self, index: usize, units: &[f64], part: f64, out: &mut Vec<f64>) {
        let n = units.len();
        let h = if let [h] = self.h { *h } else { self.h[index] };
        let ([start, first], [end, last]) = (self.start, self.end);
        let entries = index * n..(index + 1) * n;
        let change = |entry: usize| h * (first[entry] - last[entry]);
        let each = entries.clone().zip(units);
        let greatest =
            each.fold(0.0, |most: f64, (entry, unit)| most.max((change(entry) / unit).abs()));
        let is_accurate = self.tolerance.is_some_and(|relative| relative <= ACCURATE);
        let part_beside = if is_accurate { BESIDE } else { BESIDE_COARSE };
        let beside = part_beside.max(LEAST_BESIDE / greatest);
        for entry in entries {
            // Hermite's cubic, in Horner's form from the start.
            let way = end[entry] - start[entry];
            let [first, last] = [h * first[entry], h * last[entry]];
            let bend = part * (first + last - 2.0 * way);
            let along = part * (first + part * (3.0 * way - 2.0 * first - last + bend));
            // At rest, without acceleration, there is none.
            let aside = if greatest > 0.0 { beside * change(entry) } else { 0.0 };
            out.push(start[entry] + along + aside);
        }
    }
}
