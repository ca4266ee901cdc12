//! Values toward the ends of an interval, and where they go through infinity within it.

use std::f64::consts::{FRAC_PI_2, PI};

use super::beside::{Side, Singularity};
use super::curve::Curve;
use super::node_values::{ByAngle, NodeValues};
use super::tracked::{Tracked, ValueAt};
use super::window::Window;
use crate::math::root::bisection::bisect;

/// Halvings toward a pole, and the ratio of the value there to those at the nodes.
const HALVINGS: u32 = 40;
const POLE: f64 = 1.0e6;
/// Distances (in halves of the window) over which a slide is followed to see where a value goes, the farthest
/// first (groups above class II are lost in the end), and the factor by which a value without a limit grows.
const FAR: [[f64; 2]; 3] = [[1.0e2, 1.0e4], [1.0e1, 1.0e3], [1.0, 1.0e2]];
const GROWS: f64 = 10.0;
/// Distances (in halves of the window) from an end without a fold at which a value is compared with one
/// farther away: as near as a value exists.
const BESIDE_END: [f64; 4] = [1.0e-6, 1.0e-5, 1.0e-4, 1.0e-3];
const FARTHER: f64 = 100.0;
/// Greatest distance, relative to it, of a value so near from the polynomial that is to follow it.
const FOLLOWS: f64 = 0.5;
/// The coefficient of a pole at a dead point, relative to the greatest of any coordinate: below, it is zero
/// except for the rounding of the dead point's own place, where directions are off by the root of u.
const LEAST_POLE: f64 = 1.0e-7;
/// Values that are off by more than this part of their terms say nothing of a pole.
const NO_DIGITS: f64 = 0.05;
/// The coefficient must exceed its error by this factor: errors are estimates.
const CLEAR: f64 = 4.0;

impl Curve<'_> {
    /// Values at the ends, and beside places where a cylinder has no length. Later values beside these come
    /// from the polynomials as far as digits are lost.
    pub(super) fn settle(&mut self, window: &Window, node_values: &mut NodeValues) -> Vec<ValueAt> {
        self.beside.clear();
        let mut values = self.at_zero_lengths(window, node_values);
        for side in [0, 1] {
            values.extend(if window.folds[side] {
                self.at_dead_point(window, node_values, side)
            } else if window.infinite[side] {
                self.at_infinity(window, side)
            } else if let Some(slide) = window.cuts[side] {
                self.at_cut_end(window, node_values, (side, slide))
            } else if window.is_open(side) {
                self.at_open_end(window, node_values, side)
            } else {
                None
            });
        }
        values
    }

    /// The angles where the value goes through infinity between nodes.
    pub(super) fn poles_between(
        &mut self,
        window: &Window,
        node_values: &NodeValues,
    ) -> impl Iterator<Item = f64> + use<> {
        let nodes = node_values.nodes.iter().zip(&node_values.values);
        // A pole itself has no value.
        let values: Vec<(f64, ByAngle)> =
            nodes.filter_map(|(&angle, jet)| jet.map(|jet| (angle, jet))).collect();
        let pairs = values.windows(2);
        let poles: Vec<f64> =
            pairs.filter_map(|pair| self.pole(window, pair[0], pair[1])).collect();
        poles.into_iter()
    }

    /// Where a value goes through infinity between two angles: it steps back although it grows at both,
    /// or forward although it falls.
    fn pole(
        &mut self,
        window: &Window,
        (from, [first, rate, _]): (f64, ByAngle),
        (to, [last, later, _]): (f64, ByAngle),
    ) -> Option<f64> {
        let way = 1.0_f64.copysign(rate);
        if rate * later <= 0.0 || way * (last - first) >= 0.0 {
            return None;
        }
        let (mut above, mut below) = (first, last);
        let grows_on = |angle: f64| {
            let value = self.value(window.at(angle)).ok_or(())?;
            let is_before = way * (value - above) >= 0.0;
            *(if is_before { &mut above } else { &mut below }) = value;
            Ok::<_, ()>(is_before)
        };
        let [before, _] = bisect([from, to], HALVINGS, grows_on).ok()?;
        let size = first.abs().max(last.abs());
        (above.abs().min(below.abs()) > POLE * size).then_some(before)
    }

    /// The value where an interval ends without a fold: infinite if a joint is at infinity there, because
    /// then it grows without limit.
    fn at_open_end(
        &mut self,
        window: &Window,
        node_values: &mut NodeValues,
        side: usize,
    ) -> Option<ValueAt> {
        let q = window.ends()[side];
        let way = if side == 0 { window.half } else { -window.half };
        // The end itself has no value.
        let (part, near) =
            BESIDE_END.iter().find_map(|part| Some((part, self.value(q + way * part)?)))?;
        let [rounding, _] = self.rounding();
        let far = self.value(q + way * FARTHER * part)?;
        if near.abs() > (GROWS * far.abs()).max(rounding) {
            return Some(ValueAt { value: f64::INFINITY.copysign(near), q });
        }
        let pole = window.poles(self.order)[side];
        let samples = self.samples(window, inward(window, side, Singularity::Pole), pole);
        let limit = samples.fit(0).map(|fit| fit.limit());
        // Another singularity just beyond the end: no polynomial reaches past it.
        if limit.is_none_or(|limit| (near - limit).abs() > FOLLOWS * near.abs().max(rounding)) {
            return Some(ValueAt { value: near, q });
        }
        let value = self.limit(window, node_values, &samples);
        Some(ValueAt { value: value.unwrap_or(near), q })
    }

    /// The value where a length is 0; for a driven length the position itself does not exist.
    fn at_cut_end(
        &mut self,
        window: &Window,
        node_values: &mut NodeValues,
        (side, slide): (usize, usize),
    ) -> Option<ValueAt> {
        let q = window.ends()[side];
        if self.order == 0 && self.tracked == Tracked::Slide(slide) {
            return Some(ValueAt { value: 0.0, q });
        }
        let value = self.limit_at_end(window, node_values, (side, Singularity::ZeroLength))?;
        Some(ValueAt { value, q })
    }

    /// The limit of a value at an end where it is smooth, and its values beside it.
    fn limit_at_end(
        &mut self,
        window: &Window,
        node_values: &mut NodeValues,
        (side, singularity): (usize, Singularity),
    ) -> Option<f64> {
        let samples = self.samples(window, inward(window, side, singularity), 0);
        self.limit(window, node_values, &samples)
    }

    /// The limit of the value as a slide goes on without end.
    fn at_infinity(&mut self, window: &Window, side: usize) -> Option<ValueAt> {
        let way = if side == 0 { -1.0 } else { 1.0 };
        let mut at = |part: f64| self.value(window.middle + way * part * window.half);
        let [parts, [near, far]] =
            FAR.iter().find_map(|&parts| Some([parts, [at(parts[0])?, at(parts[1])?]]))?;
        let grows = far.abs() > GROWS * near.abs();
        // What is left of the way to the limit falls with the distance.
        let limit = far + (far - near) * parts[0] / (parts[1] - parts[0]);
        let value = if grows { f64::INFINITY.copysign(far) } else { limit };
        Some(ValueAt { value, q: way * f64::INFINITY })
    }

    /// The value at a dead point. A derivative is infinite there unless the coefficients of all its
    /// poles are zero.
    fn at_dead_point(
        &mut self,
        window: &Window,
        node_values: &mut NodeValues,
        side: usize,
    ) -> Option<ValueAt> {
        let q = window.ends()[side];
        let greatest = window.poles(self.order)[side];
        let samples = self.samples(window, inward(window, side, Singularity::Pole), greatest);
        // Even terms of the series in the square root of the distance have no poles.
        for pole in (1..=greatest).rev().step_by(2) {
            let fit = samples.fit(pole)?;
            if fit.noise > NO_DIGITS {
                break;
            }
            let coefficient = fit.limit();
            let bound = (LEAST_POLE * fit.size).max(CLEAR * fit.error);
            if coefficient.abs() > bound {
                return Some(ValueAt { value: f64::INFINITY.copysign(coefficient), q });
            }
        }
        let value = self.limit(window, node_values, &samples)?;
        Some(ValueAt { value, q })
    }
}

/// The side of an end that is within the window.
fn inward(window: &Window, side: usize, singularity: Singularity) -> Side {
    let (place, way) = ([0.0, PI][side], [1.0, -1.0][side]);
    Side { place, way, most: window.to_next(place).min(FRAC_PI_2), singularity }
}
