//! A curve continued by polynomials beside places where the motion is singular.

use super::beside::{Beside, Sample, Samples, Side, Singularity};
use super::curve::Curve;
use super::node_values::{ByAngle, NodeValues};
use super::window::Window;

/// Nodes (as angles from the place) of a polynomial, and multiples of them: from where third derivatives
/// have hardly a digit left to where a quarter of the window is between them.
const NODES: [f64; 3] = [0.004, 0.008, 0.012];
const FACTORS: [f64; 13] =
    [0.03125, 0.0625, 0.125, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0];
/// Nearer nodes, if the nearest of these show that another singularity is as near.
const NEARER: [f64; 3] = [0.125, 0.015_625, 0.001_953_125];
/// Nearest distance of nodes, relative to q: below, the rounding of the place itself would show.
const RESOLVED: f64 = 2.0e3 * f64::EPSILON;
/// Places between the nearest nodes (in multiples of these) that show the size of rounding.
const BETWEEN: [f64; 6] = [0.005, 0.006, 0.007, 0.009, 0.010, 0.011];

impl Curve<'_> {
    /// The derivative with its first two derivatives by the window's angle: as computed, or from the
    /// polynomial where that has more digits.
    pub(super) fn by_angle(&mut self, window: &Window, angle: f64) -> Option<ByAngle> {
        let computed = self.computed_by_angle(window, angle)?;
        let better = self.beside.iter().find_map(|beside| {
            let distance = beside.distance(window, angle)?;
            let Beside { side, fit } = beside;
            let is_better = fit.noise * self.size_of_terms(side.singularity) > fit.error;
            is_better.then(|| {
                let [value, slope, bend] = fit.series.at(distance);
                [value, side.way * slope, bend]
            })
        });
        Some(better.unwrap_or(computed))
    }

    /// The limit on one side of a place where a coordinate is smooth. Later values beside it come from the
    /// polynomial where that has more digits.
    pub(super) fn limit(
        &mut self,
        window: &Window,
        node_values: &mut NodeValues,
        samples: &Samples,
    ) -> Option<f64> {
        let beside = Beside { side: samples.side, fit: samples.fit(0)? };
        let limit = beside.fit.limit();
        let reaches = |angle: &f64| beside.distance(window, *angle).is_some();
        let stale: Vec<f64> = node_values.angles().filter(reaches).collect();
        self.beside.push(beside);
        for angle in stale {
            let value = self.by_angle(window, angle);
            node_values.replace(angle, value);
        }
        Some(limit)
    }

    /// Values on one side of a place where the derivative may have a pole. The nodes are as near as they
    /// must be for the values to follow a polynomial: another singularity may lie just beyond the place.
    pub(super) fn samples(&mut self, window: &Window, side: Side, pole: usize) -> Samples {
        let place = window.at(side.place);
        let is_resolved = |factor: &f64| {
            let distance = window.at(side.place + side.way * factor * NODES[0]) - place;
            distance.abs() > RESOLVED * place.abs()
        };
        let usual = self.samples_at(window, side, FACTORS.into_iter().filter(is_resolved));
        // An interval of some hundred roundings.
        if usual.sets.is_empty() {
            return self.samples_at(window, side, FACTORS.into_iter());
        }
        if usual.have_limit(pole) {
            return usual;
        }
        let scales = NEARER.iter().filter(|scale| is_resolved(&(*scale * FACTORS[0])));
        let mut nearer = scales.map(|scale| {
            self.samples_at(window, side, FACTORS.into_iter().map(|factor| scale * factor))
        });
        nearer.find(|samples| samples.have_limit(pole)).unwrap_or(usual)
    }

    /// Values on one side of a place, at multiples of the nodes.
    fn samples_at(
        &mut self,
        window: &Window,
        side: Side,
        factors: impl Iterator<Item = f64>,
    ) -> Samples {
        let mut samples = Samples { side, between: Vec::new(), sets: Vec::new() };
        for factor in factors {
            if factor * NODES[2] > side.most {
                break;
            }
            // So near that no value exists, or too far.
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
        let jet = self.computed_by_angle(window, angle)?;
        Some(Sample { distance, angle, jet, size: self.size_of_terms(side.singularity) })
    }

    /// The size of the derivative's terms at the last position.
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
