//! An interval of the driver's coordinate as a function of an angle from 0 to π.
//!
//! Near a dead point a coordinate x is a power series of s, the square root of the distance from it, so
//! its k-th derivative by q grows as s^(1 − 2k). With q = middle − half · cos θ the series is one of θ,
//! and times a weight that is zero at the end to the order of the pole, the derivative is smooth there.
//! Where two guides become parallel, x has a simple pole in the distance itself.

use std::f64::consts::{PI, TAU};

use crate::math::angle::whole_part;
use crate::math::trig::sin_cos;
use crate::plan::mechanism::Mechanism;
use crate::query::evaluator::Evaluator;
use crate::query::limits::finder::Interval;

/// Nodes for each turn (or size), and the least number.
const NODES: f64 = 96.0;
/// Nearest node to a dead point, as an angle.
const NEAR_END: f64 = 1.0e-3;
/// Nearest node (in halves of the window) to an end where a joint is at infinity: there rounding grows as
/// the inverse square of the distance and more.
const NEAR_OPEN_END: f64 = 1.0e-4;

/// An interval as a function of an angle from 0 to π: square roots at dead points are smooth in it.
pub(super) struct Window {
    pub middle: f64,
    pub half: f64,
    /// Whether each end is a dead point.
    pub folds: [bool; 2],
    /// The slides whose values are lengths, and 0 at the ends.
    pub cuts: [Option<usize>; 2],
    /// Whether each end is infinite, for a slide that nothing stops.
    pub infinite: [bool; 2],
    /// Whether it is one period of a motion that closes.
    pub is_period: bool,
    /// Where passive cylinders have no length and the tracked coordinate is not smooth.
    pub zero_lengths: Vec<ZeroLength>,
    /// No values are taken nearer than this (as an angle) to these places.
    pub aside: f64,
    /// Turns of the driver, or its way in sizes.
    length: f64,
}

/// A place, as an angle of a window, where a passive cylinder has no length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ZeroLength {
    pub angle: f64,
    /// The step of the plan that solves it, and its slide.
    pub step: usize,
    pub slide: usize,
}

impl Window {
    pub(super) fn of(
        mechanism: &Mechanism,
        evaluator: &Evaluator<'_>,
        interval: &Interval,
        turns: f64,
    ) -> Self {
        let q0 = mechanism.q0()[0];
        let is_turn = mechanism.plan().driven_slide(0).is_none();
        let reach = if is_turn { PI * turns } else { evaluator.reach() };
        let first_length = mechanism.plan().end_of_length(0);
        let [low, high] = interval.ends;
        let low = if low.is_finite() { low } else { q0 - reach };
        let high = if high.is_finite() { high } else { q0 + reach };
        let unit = if is_turn { TAU } else { evaluator.unit(0) };
        Self {
            middle: 0.5 * (low + high),
            half: 0.5 * (high - low),
            folds: interval.folds.map(|fold| fold.is_some_and(|fold| fold < first_length)),
            cuts: interval.folds.map(|fold| fold?.checked_sub(first_length)),
            infinite: interval.ends.map(|end| end.is_infinite() && !is_turn),
            is_period: is_turn && interval.ends[0].is_infinite(),
            zero_lengths: Vec::new(),
            aside: 0.0,
            length: (high - low) / unit,
        }
    }

    pub(super) fn ends(&self) -> [f64; 2] {
        [self.middle - self.half, self.middle + self.half]
    }

    /// Whether a coordinate of the driver is in it; one that goes round has every coordinate.
    pub(super) fn holds(&self, q: f64) -> bool {
        let [low, high] = self.ends();
        self.is_period || (low..=high).contains(&q)
    }

    fn has_folds(&self) -> bool {
        self.folds[0] || self.folds[1]
    }

    /// Distance (as an angle) from a place; in a period the shorter way.
    pub(super) fn distance(&self, angle: f64, place: f64) -> f64 {
        let distance = (angle - place).abs();
        if self.is_period { distance.min((PI - distance).abs()) } else { distance }
    }

    /// Distance (as an angle) from a place to the next where the motion is not smooth.
    pub(super) fn to_next(&self, place: f64) -> f64 {
        let ends = if self.is_period { [place; 2] } else { [0.0, PI] };
        let places = self.zero_lengths.iter().map(|zero| zero.angle).chain(ends);
        let rest = places.filter(|&next| next != place);
        rest.map(|next| self.distance(place, next)).fold(PI, f64::min)
    }

    /// Angles from end to end, without those where a cylinder is too short.
    pub(super) fn nodes(&self) -> Vec<f64> {
        let count = (NODES * self.length).max(NODES).ceil();
        let [before, behind] = self.margins();
        let node = |i: usize| before + (PI - before - behind) * i as f64 / count;
        let even = (0..=whole_part(count)).map(node);
        let is_off = |angle: &f64| {
            self.zero_lengths.iter().all(|zero| self.distance(*angle, zero.angle) > self.aside)
        };
        let mut nodes: Vec<f64> = even.filter(is_off).collect();
        for zero in &self.zero_lengths {
            let beside = [-self.aside, self.aside].map(|aside| self.in_period(zero.angle + aside));
            nodes.extend(beside.into_iter().filter(|angle| (0.0..=PI).contains(angle)));
        }
        nodes.sort_by(f64::total_cmp);
        nodes
    }

    /// Distance (as an angle) of the first and last node from the ends.
    fn margins(&self) -> [f64; 2] {
        [0, 1].map(|side| match (self.has_folds(), self.is_open(side)) {
            (true, false) => NEAR_END,
            (false, false) => 0.0,
            (true, true) => (2.0 * NEAR_OPEN_END).sqrt(),
            (false, true) => 0.5 * PI * NEAR_OPEN_END,
        })
    }

    /// The angle within the period where the motion is the same.
    pub(super) fn in_period(&self, angle: f64) -> f64 {
        if self.is_period { angle - PI * (angle / PI).floor() } else { angle }
    }

    pub(super) fn at(&self, angle: f64) -> f64 {
        let part = if self.has_folds() { -sin_cos(angle).1 } else { angle / (0.5 * PI) - 1.0 };
        self.middle + self.half * part
    }

    /// First and second derivative.
    pub(super) fn rates(&self, angle: f64) -> [f64; 2] {
        if self.has_folds() {
            let (sin, cos) = sin_cos(angle);
            [self.half * sin, self.half * cos]
        } else {
            [self.half / (0.5 * PI), 0.0]
        }
    }

    /// Whether an end is neither a dead point nor a length of 0 nor beyond all limits: a joint may be at
    /// infinity there.
    pub(super) fn is_open(&self, side: usize) -> bool {
        let has_end = self.folds[side] || self.cuts[side].is_some() || self.infinite[side];
        !has_end && !self.is_period
    }

    /// Orders of the poles, in the angle, that a derivative of a coordinate may have at the ends.
    pub(super) fn poles(&self, order: usize) -> [usize; 2] {
        // Beside a dead point at the other end, the distance is the square of the angle.
        let per_distance = if self.has_folds() { 2 } else { 1 };
        [0, 1].map(|side| {
            if self.folds[side] {
                (2 * order).saturating_sub(1)
            } else if self.is_open(side) {
                per_distance * (order + 1)
            } else {
                0
            }
        })
    }
}

/// A factor that is zero at the ends of a window, and the derivative of its logarithm by the angle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Weight {
    pub factor: f64,
    log_slope: f64,
}

impl Weight {
    /// The weight that takes away poles of these orders.
    pub(super) fn new(angle: f64, poles: [usize; 2]) -> Self {
        let (sin, cos) = sin_cos(0.5 * angle);
        let mut weight = Self { factor: 1.0, log_slope: 0.0 };
        for (pole, [distance, rate]) in poles.into_iter().zip([[sin, cos], [cos, -sin]]) {
            for _ in 0..pole {
                weight.factor *= 2.0 * distance;
                weight.log_slope += 0.5 * rate / distance;
            }
        }
        weight
    }

    /// A value and its slope, weighted.
    pub(super) fn of(&self, [value, slope]: [f64; 2]) -> [f64; 2] {
        [self.factor * value, self.factor * (slope + value * self.log_slope)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A swing between dead points, and one that ends where a joint is at infinity.
    fn window(folds: [bool; 2]) -> Window {
        Window {
            middle: 0.3,
            half: 1.1,
            folds,
            cuts: [None; 2],
            infinite: [false; 2],
            is_period: false,
            zero_lengths: Vec::new(),
            aside: 0.0,
            length: 0.2,
        }
    }

    #[test]
    fn weights_take_poles_away() {
        for folds in [[true; 2], [true, false], [false; 2]] {
            let window = window(folds);
            for order in 0..=3 {
                let poles = window.poles(order);
                // 1/weight has just these poles: weighted it is constant.
                for angle in [1.0e-3, 0.2, 1.5, 3.0, PI - 1.0e-3] {
                    let weight = Weight::new(angle, poles);
                    let pole = 1.0 / weight.factor;
                    let [value, slope] = weight.of([pole, -pole * weight.log_slope]);
                    assert!((value - 1.0).abs() < 1.0e-14 && slope.abs() < 1.0e-12);
                }
            }
            // The derivative of the logarithm, by differences.
            let poles = window.poles(2);
            let ln = |angle: f64| libm::log(Weight::new(angle, poles).factor);
            let slope = (ln(0.7001) - ln(0.6999)) / 2.0e-4;
            assert!((slope - Weight::new(0.7, poles).log_slope).abs() < 1.0e-5);
        }
        assert_eq!(window([true, false]).poles(2), [3, 6]);
        assert_eq!(window([false; 2]).poles(2), [3, 3]);
        assert_eq!(window([true; 2]).poles(0), [0, 0]);
    }
}
