//! Values toward the ends of an interval, and where they go through infinity within it.

use std::f64::consts::{FRAC_PI_2, PI};

use super::curve::Curve;
use super::known::{ByAngle, Known};
use super::tracked::{Tracked, ValueAt};
use super::window::{NEAR_END, Weight, Window};

/// Halvings toward a pole, and how many times greater than at the nodes the value is there.
const HALVINGS: usize = 40;
const POLE: f64 = 1.0e6;
/// How far (in halves of the window) a slide is followed to see where a value goes, and by what factor
/// one grows that has no limit.
const FAR: [f64; 2] = [1.0e2, 1.0e4];
const GROWS: f64 = 10.0;
/// How near (in halves of the window) to an end without a fold a value is compared.
const BESIDE_END: [f64; 2] = [1.0e-6, 1.0e-4];
/// Nodes (as angles) from which a value is extrapolated to where a length is 0. Nearer, where the
/// cylinder is short, derivatives lose digits; the polynomial is good to the sixth power of these.
pub(super) const CUT_NODES: [f64; 3] = [0.01, 0.02, 0.03];
/// Multiples of these for an end where a joint is at infinity.
const OPEN_END_FACTORS: [f64; 5] = [1.0, 2.0, 4.0, 8.0, 16.0];
/// The coefficient of a pole at a dead point, relative to the greatest of the weighted values: below, it
/// is the rounding of its extrapolation.
const LEAST_POLE: f64 = 1.0e-7;

impl Curve<'_> {
    /// Values at both ends.
    pub(super) fn at_ends(&mut self, window: &Window, known: &Known) -> Vec<ValueAt> {
        let mut values = Vec::new();
        for side in [0, 1] {
            values.extend(if window.folds[side] {
                self.at_dead_point(window, known, side)
            } else if window.infinite[side] {
                self.at_infinity(window, side)
            } else if let Some(slide) = window.cuts[side] {
                self.at_cut_end(window, side, slide)
            } else if window.is_open(side) {
                self.at_open_end(window, side)
            } else {
                None
            });
        }
        values
    }

    /// Where the value goes through infinity between nodes.
    pub(super) fn poles_between(&mut self, window: &Window, known: &Known) -> Vec<f64> {
        let nodes = known.nodes.iter().zip(&known.values);
        // At a pole itself there is no value.
        let values: Vec<(f64, ByAngle)> =
            nodes.filter_map(|(&angle, own)| own.map(|own| (angle, own))).collect();
        values.windows(2).filter_map(|pair| self.pole(window, pair[0], pair[1])).collect()
    }

    /// Where a value goes through infinity between two angles: it steps back although it grows at both,
    /// or forward although it falls.
    fn pole(
        &mut self,
        window: &Window,
        (mut from, [first, rate, _]): (f64, ByAngle),
        (mut to, [last, later, _]): (f64, ByAngle),
    ) -> Option<f64> {
        let way = 1.0_f64.copysign(rate);
        if rate * later <= 0.0 || way * (last - first) >= 0.0 {
            return None;
        }
        let (mut above, mut below) = (first, last);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (from + to);
            let value = self.value(window.at(middle))?;
            if way * (value - above) >= 0.0 {
                (from, above) = (middle, value);
            } else {
                (to, below) = (middle, value);
            }
        }
        let size = first.abs().max(last.abs());
        (above.abs().min(below.abs()) > POLE * size).then_some(window.at(from))
    }

    /// The value where an interval ends without a fold: infinite if a joint is at infinity there, for
    /// then it grows without end.
    fn at_open_end(&mut self, window: &Window, side: usize) -> Option<ValueAt> {
        let inward = if side == 0 { window.half } else { -window.half };
        let end = window.ends()[side];
        let [near, far] = BESIDE_END.map(|part| self.value(end + inward * part));
        let (near, far) = (near?, far?);
        if near.abs() > GROWS * far.abs() {
            return Some(ValueAt { value: f64::INFINITY.copysign(near), q: end });
        }
        let value = self.extrapolated_to_open_end(window, side).unwrap_or(near);
        Some(ValueAt { value, q: end })
    }

    /// The limit of a value at an end where a joint is at infinity. Near it derivatives lose digits, far
    /// from it a polynomial does: of nodes ever farther away the two sets that agree best.
    fn extrapolated_to_open_end(&mut self, window: &Window, side: usize) -> Option<f64> {
        let way = [1.0, -1.0][side];
        let mut limits = Vec::new();
        for factor in OPEN_END_FACTORS {
            let mut table = Vec::new();
            for node in CUT_NODES.map(|node| factor * node) {
                let angle = if side == 0 { node } else { PI - node };
                let [value, slope, _] = self.by_angle(window, angle)?;
                table.push((node, value, way * slope));
            }
            limits.push(hermite_at_zero(&table));
        }
        let apart = |pair: &&[f64]| (pair[1] - pair[0]).abs();
        let best = limits.windows(2).min_by(|a, b| apart(a).total_cmp(&apart(b)))?;
        Some(best[0])
    }

    /// The value where a length is 0, extrapolated as at a dead point: of a driven one the position
    /// itself does not exist.
    fn at_cut_end(&mut self, window: &Window, side: usize, slide: usize) -> Option<ValueAt> {
        let q = window.ends()[side];
        if self.order == 0 && self.tracked == Tracked::Slide(slide) {
            return Some(ValueAt { value: 0.0, q });
        }
        let way = [1.0, -1.0][side];
        let mut table = Vec::new();
        for node in CUT_NODES {
            let angle = if side == 0 { node } else { PI - node };
            let [value, slope, _] = self.by_angle(window, angle)?;
            table.push((node, value, way * slope));
        }
        Some(ValueAt { value: hermite_at_zero(&table), q })
    }

    /// Where the value goes as a slide goes on without end.
    fn at_infinity(&mut self, window: &Window, side: usize) -> Option<ValueAt> {
        let way = if side == 0 { -1.0 } else { 1.0 };
        let [near, far] = FAR.map(|part| self.value(window.middle + way * part * window.half));
        let (near, far) = (near?, far?);
        let grows = far.abs() > GROWS * near.abs();
        let value = if grows { f64::INFINITY.copysign(far) } else { far };
        Some(ValueAt { value, q: way * f64::INFINITY })
    }

    /// The value at a dead point. A derivative is infinite there unless the coefficients of all its
    /// poles are zero.
    fn at_dead_point(&mut self, window: &Window, known: &Known, side: usize) -> Option<ValueAt> {
        let way = [1.0, -1.0][side];
        let mut beside = Vec::new();
        for part in [4.0, 8.0, 12.0].map(|part| part * NEAR_END) {
            let angle = if side == 0 { part } else { PI - part };
            let own = self.by_angle(window, angle)?;
            beside.push((part, angle, own, self.rounding()));
        }
        let extrapolated = |pole: usize| {
            let poles = [0, 1].map(|end| if end == side { pole } else { 0 });
            let nodes = beside.iter().map(|&(part, angle, [value, slope, _], _)| {
                let [value, slope] = Weight::new(angle, poles).of([value, slope]);
                (part, value, way * slope)
            });
            (hermite_at_zero(&nodes.collect::<Vec<_>>()), poles)
        };
        let q = window.ends()[side];
        // Even terms of the series in the square root of the distance have no poles.
        for pole in (1..=window.poles(self.order)[side]).rev().step_by(2) {
            let (coefficient, poles) = extrapolated(pole);
            let own = |angle: f64| if side == 0 { angle <= FRAC_PI_2 } else { angle >= FRAC_PI_2 };
            let size = known
                .sizes(0, poles)
                .filter(|&(angle, _)| own(angle))
                .fold(0.0_f64, |size, (_, [_, weighted])| size.max(weighted));
            let rounding = beside.iter().fold(0.0_f64, |most, &(_, angle, _, [rounding, _])| {
                most.max(Weight::new(angle, poles).factor * rounding)
            });
            if coefficient.abs() > (LEAST_POLE * size).max(rounding) {
                return Some(ValueAt { value: f64::INFINITY.copysign(coefficient), q });
            }
        }
        Some(ValueAt { value: extrapolated(0).0, q })
    }
}

/// The value at 0 of the polynomial through values and slopes at nodes.
pub(super) fn hermite_at_zero(nodes: &[(f64, f64, f64)]) -> f64 {
    let weight = |i: usize| {
        let (own, ..) = nodes[i];
        let others = nodes.iter().enumerate().filter(|(j, _)| *j != i);
        let (mut basis, mut slope) = (1.0, 0.0);
        for (_, &(other, ..)) in others {
            basis *= -other / (own - other);
            slope += 1.0 / (own - other);
        }
        (own, basis * basis, slope)
    };
    let term = |i: usize| {
        let (own, square, slope) = weight(i);
        let (_, value, rate) = nodes[i];
        square * (value * (1.0 + 2.0 * own * slope) - rate * own)
    };
    (0..nodes.len()).map(term).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn interpolation_reproduces_a_polynomial() {
        let of = |x: f64| (3.0 - x + 0.5 * x * x - x.powi(5), -1.0 + x - 5.0 * x.powi(4));
        let nodes: Vec<_> = [0.1, 0.25, 0.4].map(|x| (x, of(x).0, of(x).1)).to_vec();
        assert!((hermite_at_zero(&nodes) - 3.0).abs() < 1e-13);
    }
}
