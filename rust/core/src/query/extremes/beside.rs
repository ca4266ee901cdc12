//! Values beside a place where the motion is singular.
//!
//! At a dead point a coordinate that does not take part in the fold stays smooth, but may be made of others
//! that do: a slide on a link that folds, between joints that do not. Its derivatives are small differences
//! of large ones and may lose all digits. The same holds where a length is 0 or a joint is at infinity.
//! There a polynomial through values farther away replaces it. The values themselves show how far away:
//! near the place digits are lost, far from it the polynomial is inaccurate.

use super::hermite::Series;
use super::node_values::ByAngle;
use super::window::{Weight, Window};

/// Rounding elsewhere may exceed that at the few places between nodes by this factor.
const MARGIN: f64 = 2.0;
/// Number of pairs of the nearest sets that also show rounding. In a single set all errors may be the same:
/// so near to the place the motion hardly changes.
const NEAREST: usize = 2;
/// Greatest distance of the nearest values from a polynomial, and error of its limit, as parts of their terms.
/// Rounding is 1e-6 of them at most: where they are greater, another singularity is as near as the nodes.
const FOLLOWED: f64 = 1.0e-4;

/// The cause of a singular motion at a place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Singularity {
    /// A dead point, or a joint at infinity: derivatives of some coordinates are infinite.
    Pole,
    /// A length of 0: its direction is lost, and derivatives are finite.
    ZeroLength,
}

/// One side of a place where the motion is singular.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Side {
    pub place: f64,
    /// 1 toward greater angles, −1 toward smaller ones.
    pub way: f64,
    /// Greatest distance of nodes from it.
    pub most: f64,
    pub singularity: Singularity,
}

impl Side {
    /// A pole at the place, as the poles of a weight.
    fn poles(&self, pole: usize) -> [usize; 2] {
        let end = usize::from(self.way < 0.0);
        [0, 1].map(|i| if i == end { pole } else { 0 })
    }

    /// The distance of a sample, with its weighted value and slope away from the place.
    fn weighted(&self, sample: &Sample, poles: [usize; 2]) -> (f64, f64, f64) {
        let weight = Weight::new(sample.angle, poles);
        let [value, slope] = weight.of([sample.jet[0], sample.jet[1]]);
        (sample.distance, value, self.way * slope)
    }

    /// Distance of a sample from a polynomial, as a part of its terms.
    fn apart(&self, sample: &Sample, poles: [usize; 2], series: &Series) -> f64 {
        let (distance, value, _) = self.weighted(sample, poles);
        let factor = Weight::new(sample.angle, poles).factor;
        (value - series.at(distance)[0]).abs() / (factor * sample.size)
    }
}

/// A value on one side of a place.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sample {
    pub distance: f64,
    pub angle: f64,
    pub jet: ByAngle,
    /// The size of its terms; rounding is relative to it.
    pub size: f64,
}

/// Values on one side of a place: those between the nearest nodes, and the nodes, set by set.
pub(super) struct Samples {
    pub side: Side,
    pub between: Vec<Sample>,
    pub sets: Vec<[Sample; 3]>,
}

/// A polynomial through values, weighted by a pole, on one side of a place.
pub(super) struct Fit {
    pub series: Series,
    reach: f64,
    /// Error of its limit.
    pub error: f64,
    /// The size of its terms at its nodes, and rounding as a part of that.
    pub size: f64,
    pub noise: f64,
    /// Whether the values between the nearest nodes follow it.
    is_followed: bool,
}

impl Fit {
    /// The value at the place.
    pub(super) fn limit(&self) -> f64 {
        self.series.at(0.0)[0]
    }
}

/// A polynomial that replaces a derivative on one side of a place, where the derivative has lost more digits.
pub(super) struct Beside {
    pub side: Side,
    pub fit: Fit,
}

impl Beside {
    /// Distance of an angle from the place, if it reaches there.
    pub(super) fn distance(&self, window: &Window, angle: f64) -> Option<f64> {
        let distance = window.in_period(self.side.way * (angle - self.side.place));
        (0.0..self.fit.reach).contains(&distance).then_some(distance)
    }
}

impl Samples {
    /// Whether a polynomial of them, weighted by a pole, has a limit with small error.
    pub(super) fn have_limit(&self, pole: usize) -> bool {
        self.fit(pole).is_some_and(|fit| fit.is_followed && fit.error < FOLLOWED * fit.size)
    }

    /// The polynomial of values, weighted by a pole, with the smallest error: of those that the values
    /// between the nearest nodes follow, if there is one.
    pub(super) fn fit(&self, pole: usize) -> Option<Fit> {
        let poles = self.side.poles(pole);
        let weighted = |sample: &Sample| self.side.weighted(sample, poles);
        let factor = |sample: &Sample| Weight::new(sample.angle, poles).factor;
        let through = |is_even: bool| -> Vec<Series> {
            let nodes = self.sets.iter().map(|nodes| nodes.map(|node| weighted(&node)));
            nodes.map(|nodes| Series::new(nodes, is_even)).collect()
        };
        let general = through(false);
        let nearest = general.first()?;
        let apart = |sample: &Sample, series: &Series| self.side.apart(sample, poles, series);
        let within = self.between.iter().map(|sample| apart(sample, nearest));
        let farther = self.sets.iter().skip(1).zip(&general[1..]);
        let across = self.sets.iter().zip(farther).take(NEAREST);
        let across = across.filter(|([.., last], (next, _))| last.distance > next[0].distance);
        let across = across.map(|([.., last], (_, series))| apart(last, series));
        let noise = within.chain(across).fold(0.0, f64::max);
        let noise = MARGIN * noise;
        let size = |nodes: &[Sample; 3]| {
            nodes.iter().fold(0.0_f64, |most, node| most.max(factor(node) * node.size))
        };
        let is_followed =
            |series: &Series| self.between.iter().all(|sample| apart(sample, series) < FOLLOWED);
        let fits = |series: Vec<Series>| {
            let limits: Vec<f64> = series.iter().map(|polynomial| polynomial.at(0.0)[0]).collect();
            let fit = move |(set, (series, nodes)): (usize, (Series, &[Sample; 3]))| {
                // The error of the last one is not known.
                let apart =
                    limits.get(set + 1).map_or(f64::INFINITY, |next| (next - limits[set]).abs());
                let (reach, size) = (nodes[0].distance, size(nodes));
                let is_followed = is_followed(&series);
                Fit { series, reach, error: apart + noise * size, size, noise, is_followed }
            };
            series.into_iter().zip(&self.sets).enumerate().map(fit)
        };
        // A coordinate that does not take part in a fold is a function of the square, the distance itself.
        let even = if pole == 0 { through(true) } else { Vec::new() };
        let by_error =
            |a: &Fit, b: &Fit| b.is_followed.cmp(&a.is_followed).then(a.error.total_cmp(&b.error));
        fits(general).chain(fits(even)).min_by(by_error)
    }
}
