//! The variable in which a stretch is searched: an angle from 0 to π.

use crate::math::trig::{asin, sin_cos};

/// An angle from the start to the end of a stretch. Square roots at the ends, where earlier dyads are
/// flat, are smooth in it; and far from the drawing its cells grow about as the distance, as what is so
/// far away changes little over a length of a link.
pub(super) struct Chart {
    center: f64,
    core: f64,
    middle: f64,
    half: f64,
}

impl Chart {
    /// Of a stretch; `core`: the distance from `center` beyond which cells grow.
    pub(super) fn new(ends: [f64; 2], center: f64, core: f64) -> Self {
        let mut chart = Self { center, core, middle: 0.0, half: 0.0 };
        let [from, to] = ends.map(|end| chart.even(end));
        (chart.middle, chart.half) = (0.5 * (from + to), 0.5 * (to - from));
        chart
    }

    /// The length of the stretch, measured with cells that do not grow.
    pub(super) fn length(&self) -> f64 {
        2.0 * self.half
    }

    /// The coordinate at an angle.
    pub(super) fn at(&self, angle: f64) -> f64 {
        let even = self.middle - self.half * sin_cos(angle).1;
        let beyond = self.beyond(even);
        if beyond <= 0.0 {
            return even;
        }
        self.center + self.core.copysign(even - self.center) / square(square(1.0 - 0.25 * beyond))
    }

    /// The derivative of the coordinate by the angle.
    pub(super) fn slope(&self, angle: f64) -> f64 {
        let (sin, cos) = sin_cos(angle);
        let root = 1.0 - 0.25 * self.beyond(self.middle - self.half * cos).max(0.0);
        self.half * sin / (square(square(root)) * root)
    }

    /// The angle of a coordinate.
    pub(super) fn angle(&self, q: f64) -> f64 {
        0.5 * std::f64::consts::PI - asin((self.middle - self.even(q)) / self.half)
    }

    /// How far a coordinate is beyond the core, in cores, where cells do not grow.
    fn beyond(&self, even: f64) -> f64 {
        (even - self.center).abs() / self.core - 1.0
    }

    /// The coordinate measured in cells that do not grow: beyond the core 1 + 4 (1 - (core / x)^(1/4))
    /// cores, so that cells grow with the power 5/4 of the distance x.
    fn even(&self, q: f64) -> f64 {
        let x = (q - self.center) / self.core;
        if x.abs() <= 1.0 {
            return q;
        }
        let root = (1.0 / x.abs()).sqrt().sqrt();
        self.center + (self.core * (5.0 - 4.0 * root)).copysign(x)
    }
}

fn square(x: f64) -> f64 {
    x * x
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn it_goes_from_end_to_end_and_back(
            ends in [-600.0..600.0_f64, -600.0..600.0], center in -1.0..1.0_f64, on in 0.05..0.95_f64
        ) {
            let ends = [ends[0].min(ends[1]), ends[0].max(ends[1]) + 0.1];
            let chart = Chart::new(ends, center, 3.0);
            for (angle, end) in [(0.0, ends[0]), (PI, ends[1])] {
                prop_assert!((chart.at(angle) - end).abs() < 1e-12 * 600.0 * 600.0);
            }
            let (angle, step) = (on * PI, 1e-5);
            prop_assert!((chart.angle(chart.at(angle)) - angle).abs() < 1e-9);
            let secant = (chart.at(angle + step) - chart.at(angle - step)) / (2.0 * step);
            prop_assert!((chart.slope(angle) - secant).abs() < 1e-4 * chart.slope(angle));
        }
    }

    #[test]
    fn cells_within_the_core_are_even() {
        let chart = Chart::new([-2.0, 3.0], 0.5, 4.0);
        assert_eq!(chart.length(), 5.0);
        assert_eq!(chart.at(1.0), 0.5 - 2.5 * sin_cos(1.0).1);
    }
}
