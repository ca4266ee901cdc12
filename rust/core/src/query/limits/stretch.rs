//! Stretches of a coordinate, with what ends them.

use std::f64::consts::TAU;

/// A stretch over which an assembly exists.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Stretch {
    pub ends: [f64; 2],
    /// What folds at each end: a sign's dyad, or after all signs a group, or after these a slide whose
    /// value is a length and 0 there; `None` if nothing does.
    pub folds: [Option<usize>; 2],
}

impl Stretch {
    /// All coordinates.
    pub(crate) const WHOLE: Self =
        Self { ends: [f64::NEG_INFINITY, f64::INFINITY], folds: [None; 2] };

    pub(crate) fn is_whole(&self) -> bool {
        self.ends == Self::WHOLE.ends
    }

    /// The part of it above a coordinate, with what ends there.
    pub(crate) fn above(mut self, low: f64, end: Option<usize>) -> Option<Self> {
        if self.ends[0] < low {
            (self.ends[0], self.folds[0]) = (low, end);
        }
        (self.ends[0] < self.ends[1]).then_some(self)
    }

    /// The intersection with another, moved by `shift`.
    fn intersection(&self, other: &Self, shift: f64) -> Option<Self> {
        let moved = other.ends.map(|end| end + shift);
        let later = moved[0] > self.ends[0];
        let earlier = moved[1] < self.ends[1];
        let choose = |other_first: bool, side: usize| {
            if other_first {
                (moved[side], other.folds[side])
            } else {
                (self.ends[side], self.folds[side])
            }
        };
        let [(from, start), (to, end)] = [choose(later, 0), choose(earlier, 1)];
        (from < to).then_some(Self { ends: [from, to], folds: [start, end] })
    }
}

/// The intersection of two lists of stretches of an angle.
pub(crate) fn intersections(first: &[Stretch], second: &[Stretch]) -> Vec<Stretch> {
    let mut common = Vec::new();
    for a in first {
        for b in second {
            let shifts: &[f64] =
                if a.is_whole() || b.is_whole() { &[0.0] } else { &[-TAU, 0.0, TAU] };
            common.extend(shifts.iter().filter_map(|&shift| a.intersection(b, shift)));
        }
    }
    common
}

/// Shifts stretches of an angle by whole periods so that their middles are within half a period of
/// `near`, and sorts them: the stretch that contains `near` contains it without a shift.
pub(crate) fn shift_near(stretches: &mut [Stretch], near: f64, period: f64) {
    for stretch in stretches.iter_mut().filter(|stretch| !stretch.is_whole()) {
        let middle = 0.5 * (stretch.ends[0] + stretch.ends[1]);
        let periods = ((middle - near) / period - 0.5).ceil();
        if periods != 0.0 {
            stretch.ends = stretch.ends.map(|end| end - periods * period);
        }
    }
    stretches.sort_by(|a, b| a.ends[0].total_cmp(&b.ends[0]));
}
