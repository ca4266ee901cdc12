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
    /// For every requested class, the angles at these positions, and their rates.
    angles: Vec<[f64; POSITIONS]>,
    rates: Vec<[f64; POSITIONS]>,
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

/// An angle at the end of a gap.
#[derive(Debug, Clone, Copy)]
pub(in crate::branch) struct AngleAtEnd {
    /// At the position that can be reached, and at the one beyond.
    pub inside: f64,
    pub beyond: f64,
    /// Greatest distance of the one beyond from the angle at the end itself.
    pub slack: f64,
}

/// Greatest turn (rad) of an angle on the way to a position beyond the end of a gap and back.
pub(in crate::branch) const TIE_AT_ENDS: f64 = 0.0078125;
/// Distance from half a turn (rad) at which rounding might decide which way an angle steps across a gap.
pub(in crate::branch) const TIE: f64 = TIE_AT_ENDS / 32.0;
/// Error of an angle extrapolated to the end, as a part of its turn between both positions.
const EXTRAPOLATED: f64 = 0.0625;

impl GapEnds {
    /// Whether the cell before a knot has a dead point that is confirmed to lie in another dyad's gap.
    pub(in crate::branch) fn is_shut(&self, knot: usize) -> bool {
        self.ends.iter().any(|end| end.is_confirmed && end.is_shut && end.knot == knot)
    }

    /// The positions beside the end in the cell before a knot, if that end is confirmed and one of them
    /// can be reached.
    pub(in crate::branch) fn beside(
        &self,
        scan: (f64, f64),
        knot: usize,
    ) -> Option<[EndPosition; 2]> {
        let index = self.ends.iter().position(|end| end.is_open() && end.knot == knot)?;
        let end = &self.ends[index];
        let [before, after] = end.beside(scan);
        Some([
            EndPosition { at: before, reached: end.is_start, lane: 2 * index },
            EndPosition { at: after, reached: !end.is_start, lane: 2 * index + 1 },
        ])
    }

    /// The angles of a class at all confirmed ends beside which positions can be reached.
    pub(in crate::branch) fn with_angles(
        &self,
        scan: &ScanView<'_>,
        class: usize,
    ) -> impl Iterator<Item = (&GapEnd, AngleAtEnd)> {
        let is_open = |(_, end): &(usize, &GapEnd)| end.is_open();
        let at_knots = (&scan.angles[class], &scan.rates[class]);
        self.ends.iter().enumerate().filter(is_open).map(move |(index, end)| {
            let (angles, rates) = (&self.angles[class], &self.rates[class]);
            let [inside, beyond] = end.lanes(2 * index);
            let at_inside = (angles[inside], rates[inside]);
            let extrapolated = end.extrapolated(scan, at_inside, at_knots);
            let [inside, beyond] = [inside, beyond].map(|lane| angles[lane]);
            let turned = unwrap_to(inside, beyond) - beyond;
            let apart = unwrap_to(extrapolated, beyond) - beyond;
            let slack = apart.abs() + EXTRAPOLATED * turned.abs();
            (end, AngleAtEnd { inside, beyond, slack })
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
        self.rates.resize(classes.len(), [0.0; POSITIONS]);
        let pose = &knots.state.pose;
        for ((angles, rates), &class) in self.angles.iter_mut().zip(&mut self.rates).zip(classes) {
            for group in 0..knots.state.groups {
                let angle = pose.class[class][group].angle();
                let rate = pose.theta[knots.state.len * class + 1][group];
                for lane in 0..L::Register::LANES {
                    angles[group * L::Register::LANES + lane] = angle.lane(lane);
                    rates[group * L::Register::LANES + lane] = rate.lane(lane);
                }
            }
        }
        for index in 0..self.ends.len() {
            self.ends[index].is_confirmed &=
                self.ends[index].is_shut || self.turns_little(scan, index);
        }
    }

    /// The cells with a confirmed end.
    pub(in crate::branch) fn cells(&self) -> Bits {
        let confirmed = self.ends.iter().filter(|end| end.is_confirmed);
        confirmed.fold(0, |cells, end| cells | 1 << end.knot)
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
        knots.solve_checked::<L>(cx);
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
