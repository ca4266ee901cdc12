//! Finds the ends of all gaps of a turn together: predicts the roots of the dyads' discriminants from
//! the neighbouring knots, and confirms each by a position on either side.
//!
//! Beside a dead point angles vary as the square root of the distance, so evenly spaced knots would
//! have to be very close to follow them. Ends that are not confirmed here are left to closer scans.

use super::cell_test::Bits;
use super::gap_end::{GapEnd, MAX_ENDS, POSITIONS, ScanView};
use super::uniform::UniformTracer;
use crate::math::angle::unwrap_to;
use crate::math::lanes::{Mask, Real};
use crate::state::kernel::Level;
use crate::state::state::Context;

/// Predicted ends, with samples at the positions before and after each.
#[derive(Debug, Default)]
pub(in crate::branch) struct GapEnds {
    ends: Vec<GapEnd>,
    /// For every dyad, its squares, their rates and [`DyadSample::flat`] at these positions.
    samples: Vec<[[f64; POSITIONS]; 3]>,
    /// For every requested class, the angles at these positions.
    angles: Vec<[f64; POSITIONS]>,
    /// A bit for each position that does not close.
    open: u32,
}

/// A position beside an end.
#[derive(Debug, Clone, Copy)]
pub(in crate::branch) struct EndPosition {
    pub at: f64,
    pub reached: bool,
    /// Its lane, for [`GapEnds::angle`].
    pub lane: usize,
}

impl GapEnds {
    fn index(&self, knot: usize) -> Option<usize> {
        self.ends.iter().position(|end| end.is_confirmed && end.knot == knot)
    }

    /// The positions beside the end in the cell before a knot, if that end is confirmed.
    pub(in crate::branch) fn beside(
        &self,
        scan: (f64, f64),
        knot: usize,
    ) -> Option<[EndPosition; 2]> {
        let index = self.index(knot)?;
        let end = &self.ends[index];
        let [before, after] = end.beside(scan);
        Some([
            EndPosition { at: before, reached: end.is_start, lane: 2 * index },
            EndPosition { at: after, reached: !end.is_start, lane: 2 * index + 1 },
        ])
    }

    /// All confirmed ends, each with the angles of a class at its inside position and beyond.
    pub(in crate::branch) fn with_angles(
        &self,
        class: usize,
    ) -> impl Iterator<Item = (&GapEnd, [f64; 2])> {
        let is_confirmed = |(_, end): &(usize, &GapEnd)| end.is_confirmed;
        self.ends.iter().enumerate().filter(is_confirmed).map(move |(index, end)| {
            (end, end.lanes(2 * index).map(|lane| self.angles[class][lane]))
        })
    }

    /// The angle of a class at a position beside an end.
    pub(in crate::branch) fn angle(&self, class: usize, beside: &EndPosition) -> f64 {
        self.angles[class][beside.lane]
    }

    /// Finds the ends in some cells.
    #[inline(always)]
    pub(in crate::branch) fn find<L: Level, const G: usize>(
        &mut self,
        cx: &Context<'_>,
        knots: &mut UniformTracer<L::Register, G>,
        classes: &[usize],
        scan: &ScanView<'_>,
    ) {
        self.ends.clear();
        let mut left = scan.cells;
        while left != 0 && self.ends.len() < MAX_ENDS {
            let knot = left.trailing_zeros() as usize;
            left &= left - 1;
            self.ends.extend(GapEnd::predict(scan, knot));
        }
        if self.ends.is_empty() {
            return;
        }
        self.solve::<L, G>(cx, knots, scan);
        for (index, end) in self.ends.iter_mut().enumerate() {
            end.is_confirmed = end.is_as_predicted(&self.samples, self.open, scan, 2 * index);
        }
        self.angles.resize(classes.len(), [0.0; POSITIONS]);
        for (angles, &class) in self.angles.iter_mut().zip(classes) {
            for group in 0..knots.state.groups {
                let angle = knots.state.pose.class[class][group].angle();
                for lane in 0..L::Register::LANES {
                    angles[group * L::Register::LANES + lane] = angle.lane(lane);
                }
            }
        }
        for index in 0..self.ends.len() {
            self.ends[index].is_confirmed &= self.turns_little(scan, index);
        }
    }

    /// The cells with a confirmed end.
    pub(in crate::branch) fn cells(&self) -> Bits {
        let found = self.ends.iter().filter(|end| end.is_confirmed);
        found.fold(0, |cells, end| cells | 1 << end.knot)
    }

    /// Solves the positions before and after all ends, whether or not they close.
    #[inline(always)]
    fn solve<L: Level, const G: usize>(
        &mut self,
        cx: &Context<'_>,
        knots: &mut UniformTracer<L::Register, G>,
        scan: &ScanView<'_>,
    ) {
        let mut at = [scan.from; POSITIONS];
        for (end, at) in self.ends.iter().zip(at.chunks_exact_mut(2)) {
            at.copy_from_slice(&end.beside((scan.from, scan.cell)));
        }
        knots.set_at(&at[..2 * self.ends.len()]);
        knots.solve_carefully::<L>(cx);
        self.samples.resize(scan.dyads.len(), [[0.0; POSITIONS]; 3]);
        let of_dyads = cx.plan.dyads().zip(&cx.tape.dyads).zip(&mut self.samples);
        for ((dyad, &op), [squares, rates, flats]) in of_dyads {
            for group in 0..knots.state.groups {
                let sample = knots.state.sample(group, cx, dyad, &cx.tape.ops[op]);
                for lane in 0..L::Register::LANES {
                    squares[group * L::Register::LANES + lane] = sample.square.lane(lane);
                    rates[group * L::Register::LANES + lane] = sample.rate.lane(lane);
                    flats[group * L::Register::LANES + lane] = sample.flat.lane(lane);
                }
            }
        }
        self.open = 0;
        for group in 0..knots.state.groups {
            self.open |= knots.not_closed(group).bits() << (group * L::Register::LANES);
        }
    }

    /// Whether all angles can be unwrapped from the reachable knot to an end.
    fn turns_little(&self, scan: &ScanView<'_>, index: usize) -> bool {
        let end = &self.ends[index];
        let [inside, outside] = end.lanes(2 * index);
        self.angles.iter().zip(scan.angles.iter().zip(scan.rates)).all(|(beside, (at, rate))| {
            let near = at[end.known()];
            let [to_end, beyond] =
                [inside, outside].map(|lane| unwrap_to(beside[lane], near) - near);
            end.is_followed(scan, [to_end, beyond], rate)
        })
    }
}
