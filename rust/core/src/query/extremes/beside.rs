//! Values beside a place where the motion is singular.
//!
//! At a dead point a coordinate that does not take part in the fold stays smooth, but may be made of others
//! that do: a slide on a link that folds, of joints that do not. Its derivatives are small differences of
//! great ones, and none of their digits may be left. The same holds where a length is 0 or a joint at
//! infinity. There a polynomial through values from farther away stands for it. How far away, the values
//! themselves show: near the place digits are lost, far from it a polynomial is off.

use super::curve::Curve;
use super::hermite::Series;
use super::known::{ByAngle, Known};
use super::window::{Weight, Window};

/// Nodes (as angles from the place) of a polynomial, and multiples of them: from where hardly a digit is
/// left of third derivatives to where a quarter of the window is between them.
const NODES: [f64; 3] = [0.004, 0.008, 0.012];
const FACTORS: [f64; 13] =
    [0.03125, 0.0625, 0.125, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0];
/// Places between the nearest nodes (in multiples of these) that show how far rounding reaches.
const BETWEEN: [f64; 6] = [0.005, 0.006, 0.007, 0.009, 0.010, 0.011];
/// By how much more than at these few places rounding may reach at others.
const MARGIN: f64 = 2.0;

/// What makes the motion singular at a place.
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
    /// How far nodes may be from it.
    pub most: f64,
    pub singularity: Singularity,
}

/// A value on one side of a place.
#[derive(Debug, Clone, Copy)]
struct Sample {
    distance: f64,
    angle: f64,
    own: ByAngle,
    /// The size of what it is made of, which rounding is a part of.
    size: f64,
}

/// Values on one side of a place: those between the nearest nodes, and the nodes, set by set.
pub(super) struct Samples {
    side: Side,
    between: Vec<Sample>,
    sets: Vec<[Sample; 3]>,
}

/// A polynomial through values, weighted by a pole, on one side of a place.
pub(super) struct Fit {
    series: Series,
    reach: f64,
    /// How far its limit may be off.
    pub error: f64,
    /// The size of what it is made of at its nodes, and the part of that by which rounding is off.
    pub size: f64,
    noise: f64,
}

impl Fit {
    /// The value at the place.
    pub(super) fn limit(&self) -> f64 {
        self.series.at(0.0)[0]
    }
}

/// A polynomial that stands for a derivative on one side of a place, where that has lost more digits.
pub(super) struct Beside {
    side: Side,
    fit: Fit,
}

impl Beside {
    /// Distance of an angle from the place, if it reaches there.
    fn distance(&self, window: &Window, angle: f64) -> Option<f64> {
        let distance = window.in_period(self.side.way * (angle - self.side.place));
        (0.0..self.fit.reach).contains(&distance).then_some(distance)
    }
}

impl Samples {
    /// The polynomial of values, weighted by a pole, that is least off.
    pub(super) fn fit(&self, pole: usize) -> Option<Fit> {
        let end = usize::from(self.side.way < 0.0);
        let poles = [0, 1].map(|i| if i == end { pole } else { 0 });
        let weighted = |sample: &Sample| {
            let weight = Weight::new(sample.angle, poles);
            let [value, slope] = weight.of([sample.own[0], sample.own[1]]);
            (sample.distance, value, self.side.way * slope)
        };
        let factor = |sample: &Sample| Weight::new(sample.angle, poles).factor;
        let through = |is_even: bool| -> Vec<Series> {
            let nodes = self.sets.iter().map(|nodes| nodes.map(|node| weighted(&node)));
            nodes.map(|nodes| Series::new(nodes, is_even)).collect()
        };
        let general = through(false);
        let nearest = general.first()?;
        let noise = self.between.iter().fold(0.0_f64, |most, sample| {
            let (distance, value, _) = weighted(sample);
            let apart = (value - nearest.at(distance)[0]).abs();
            most.max(apart / (factor(sample) * sample.size))
        });
        let noise = MARGIN * noise;
        let size = |nodes: &[Sample; 3]| {
            nodes.iter().fold(0.0_f64, |most, node| most.max(factor(node) * node.size))
        };
        let fits = |series: Vec<Series>| {
            let limits: Vec<f64> = series.iter().map(|own| own.at(0.0)[0]).collect();
            let fit = move |(set, (series, nodes)): (usize, (Series, &[Sample; 3]))| {
                // How far the last one is off is not known.
                let apart =
                    limits.get(set + 1).map_or(f64::INFINITY, |next| (next - limits[set]).abs());
                let (reach, size) = (nodes[0].distance, size(nodes));
                Fit { series, reach, error: apart + noise * size, size, noise }
            };
            series.into_iter().zip(&self.sets).enumerate().map(fit)
        };
        // What does not take part in a fold is a function of the square, the distance itself.
        let even = if pole == 0 { through(true) } else { Vec::new() };
        fits(general).chain(fits(even)).min_by(|a, b| a.error.total_cmp(&b.error))
    }
}

impl Curve<'_> {
    /// The derivative with its first two derivatives by the window's angle: as computed, or from the
    /// polynomial where that has more digits.
    pub(super) fn by_angle(&mut self, window: &Window, angle: f64) -> Option<ByAngle> {
        let own = self.computed_by_angle(window, angle)?;
        let better = self.beside.iter().find_map(|beside| {
            let distance = beside.distance(window, angle)?;
            let Beside { side, fit } = beside;
            let is_better = fit.noise * self.size_of_terms(side.singularity) > fit.error;
            is_better.then(|| {
                let [value, slope, bend] = fit.series.at(distance);
                [value, side.way * slope, bend]
            })
        });
        Some(better.unwrap_or(own))
    }

    /// The limit on one side of a place where a coordinate is smooth. Beside it values from now on come
    /// from the polynomial where that has more digits.
    pub(super) fn limit(
        &mut self,
        window: &Window,
        known: &mut Known,
        samples: &Samples,
    ) -> Option<f64> {
        let beside = Beside { side: samples.side, fit: samples.fit(0)? };
        let limit = beside.fit.limit();
        let reaches = |angle: &f64| beside.distance(window, *angle).is_some();
        let stale: Vec<f64> = known.angles().filter(reaches).collect();
        self.beside.push(beside);
        for angle in stale {
            let value = self.by_angle(window, angle);
            known.replace(angle, value);
        }
        Some(limit)
    }

    /// Values on one side of a place.
    pub(super) fn samples(&mut self, window: &Window, side: Side) -> Samples {
        let mut samples = Samples { side, between: Vec::new(), sets: Vec::new() };
        for factor in FACTORS {
            if factor * NODES[2] > side.most {
                break;
            }
            // So near that there are no values, or too far.
            let Some(nodes) = self.set(window, side, NODES.map(|node| factor * node)) else {
                continue;
            };
            if samples.sets.is_empty() {
                let between = BETWEEN.map(|node| factor * node);
                let between = between.map(|distance| self.sample(window, side, distance));
                samples.between.extend(between.into_iter().flatten());
            }
            samples.sets.push(nodes);
        }
        samples
    }

    fn set(&mut self, window: &Window, side: Side, nodes: [f64; 3]) -> Option<[Sample; 3]> {
        let [first, second, third] = nodes.map(|distance| self.sample(window, side, distance));
        Some([first?, second?, third?])
    }

    fn sample(&mut self, window: &Window, side: Side, distance: f64) -> Option<Sample> {
        let angle = window.in_period(side.place + side.way * distance);
        let own = self.computed_by_angle(window, angle)?;
        Some(Sample { distance, angle, own, size: self.size_of_terms(side.singularity) })
    }

    /// The size of what the derivative is made of at the last position.
    fn size_of_terms(&self, singularity: Singularity) -> f64 {
        let size = match singularity {
            Singularity::Pole => self.evaluator.position().greatest(self.order),
            // A direction is off by u κ, its k-th derivative by u κ^(k + 1).
            Singularity::ZeroLength => {
                let condition = self.evaluator.total_condition();
                (0..=self.order).fold(1.0, |power, _| power * condition)
            }
        };
        size * self.own_unit(self.order)
    }
}
