//! The ends of the gaps of a turn, found together: the roots of the dyads' discriminants are
//! predicted from the knots beside them, and positions on either side confirm them.
//!
//! Beside a dead point angles vary as the square root of the distance, so that even knots would have
//! to be very close to follow them. What is not confirmed here is left to closer looks.

use super::cell_test::Bits;
use super::gap_end::{End, Shown};
use super::uniform::UniformTracer;
use crate::math::angle::unwrap_to;
use crate::math::lanes::{LANES, Mask, Real};
use crate::state::kernel::Level;
use crate::state::state::Context;

/// Ends looked for at once; a turn seldom has more.
const MAX_ENDS: usize = LANES / 2;

/// The ends found, with what the positions beside them show.
#[derive(Debug, Default)]
pub(super) struct GapEnds {
    ends: Vec<End>,
    /// Of every dyad, the square and its rate before every end and after it.
    squares: Vec<[[f64; LANES]; 2]>,
    /// The same of the angles asked for.
    angles: Vec<[f64; LANES]>,
    /// Positions that do not close, by their bits.
    open: u32,
}

/// A position beside an end.
#[derive(Debug, Clone, Copy)]
pub(super) struct Beside {
    pub at: f64,
    pub reached: bool,
    /// Its place in [`GapEnds::angle`].
    pub lane: usize,
}

impl GapEnds {
    /// Forgets all.
    pub(super) fn clear(&mut self) {
        self.ends.clear();
    }

    /// Whether none was found.
    pub(super) fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    fn index(&self, knot: usize) -> Option<usize> {
        self.ends.iter().position(|end| end.is_confirmed && end.knot == knot)
    }

    /// The positions beside the end in the cell before a knot, if it was found.
    pub(super) fn beside(&self, shown: (f64, f64), knot: usize) -> Option<[Beside; 2]> {
        let index = self.index(knot)?;
        let end = &self.ends[index];
        let [before, after] = end.beside(shown);
        Some([
            Beside { at: before, reached: end.is_start, lane: 2 * index },
            Beside { at: after, reached: !end.is_start, lane: 2 * index + 1 },
        ])
    }

    /// The ends, each with the angle of a class before it, from where the mechanism closes, and beyond.
    /// All must have been found.
    pub(super) fn with_angles(&self, class: usize) -> impl Iterator<Item = (&End, [f64; 2])> {
        self.ends.iter().enumerate().map(move |(index, end)| {
            (end, end.lanes(2 * index).map(|lane| self.angles[class][lane]))
        })
    }

    /// The angle of a class there.
    pub(super) fn angle(&self, class: usize, beside: &Beside) -> f64 {
        self.angles[class][beside.lane]
    }

    /// Finds the ends in some cells.
    #[inline(always)]
    pub(super) fn find<L: Level, const G: usize>(
        &mut self,
        cx: &Context<'_>,
        knots: &mut UniformTracer<L::Register, G>,
        classes: &[usize],
        shown: &Shown<'_>,
    ) {
        self.ends.clear();
        let mut left = shown.cells;
        while left != 0 && self.ends.len() < MAX_ENDS {
            let knot = left.trailing_zeros() as usize;
            left &= left - 1;
            self.ends.extend(End::predict(shown, knot));
        }
        if self.ends.is_empty() {
            return;
        }
        self.solve::<L, G>(cx, knots, shown);
        for (index, end) in self.ends.iter_mut().enumerate() {
            end.is_confirmed = end.is_as_predicted(&self.squares, self.open, shown, 2 * index);
        }
        self.angles.resize(classes.len(), [0.0; LANES]);
        for (angles, &class) in self.angles.iter_mut().zip(classes) {
            for group in 0..LANES / L::Register::LANES {
                let angle = knots.state.pose.class[class][group].angle();
                for lane in 0..L::Register::LANES {
                    angles[group * L::Register::LANES + lane] = angle.lane(lane);
                }
            }
        }
        for index in 0..self.ends.len() {
            self.ends[index].is_confirmed &= self.turns_little(shown, index);
        }
    }

    /// The cells whose ends were found.
    pub(super) fn cells(&self) -> Bits {
        let found = self.ends.iter().filter(|end| end.is_confirmed);
        found.fold(0, |cells, end| cells | 1 << end.knot)
    }

    /// Solves the positions before and after all ends, whether or not they close.
    #[inline(always)]
    fn solve<L: Level, const G: usize>(
        &mut self,
        cx: &Context<'_>,
        knots: &mut UniformTracer<L::Register, G>,
        shown: &Shown<'_>,
    ) {
        let mut at = [shown.from; LANES];
        for (end, at) in self.ends.iter().zip(at.chunks_exact_mut(2)) {
            at.copy_from_slice(&end.beside((shown.from, shown.cell)));
        }
        knots.set_at(&at);
        knots.solve_carefully::<L>(cx);
        self.squares.resize(shown.dyads.len(), [[0.0; LANES]; 2]);
        let of_dyads = cx.plan.dyads().zip(&cx.tape.dyads).zip(&mut self.squares);
        for ((dyad, &op), [squares, rates]) in of_dyads {
            for group in 0..LANES / L::Register::LANES {
                let sample = knots.state.sample(group, cx, dyad, &cx.tape.ops[op]);
                for lane in 0..L::Register::LANES {
                    squares[group * L::Register::LANES + lane] = sample.square.lane(lane);
                    rates[group * L::Register::LANES + lane] = sample.rate.lane(lane);
                }
            }
        }
        self.open = 0;
        for group in 0..LANES / L::Register::LANES {
            self.open |= knots.not_closed(group).bits() << (group * L::Register::LANES);
        }
    }

    /// Whether no angle turns far from the knot that can be reached up to the end, nor at it.
    fn turns_little(&self, shown: &Shown<'_>, index: usize) -> bool {
        let end = &self.ends[index];
        let [inside, outside] = end.lanes(2 * index);
        self.angles.iter().zip(shown.angles.iter().zip(shown.rates)).all(|(beside, (at, rate))| {
            let near = at[end.known()];
            let [to_end, beyond] =
                [inside, outside].map(|lane| unwrap_to(beside[lane], near) - near);
            end.is_followed(shown, [to_end, beyond], rate)
        })
    }
}
