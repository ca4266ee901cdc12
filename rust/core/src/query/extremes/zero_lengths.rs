//! Where the joints of a passive cylinder coincide: its length has a kink there, and its angle steps by
//! half a turn. No derivative shows this, so a search of its own finds these places.

use std::f64::consts::PI;

use super::beside::{Side, Singularity};
use super::curve::Curve;
use super::node_values::NodeValues;
use super::tracked::{Tracked, ValueAt};
use super::window::{Window, ZeroLength};
use crate::math::root::bisection::{TO_ROUNDING, bisect};
use crate::plan::dyad::Unknown;
use crate::plan::plan::Step;

/// No values of each order are taken nearer than this (as an angle) to a length of 0: the direction there
/// has errors of u κ, and its k-th derivatives of u κ^(k + 1).
const ASIDE: [f64; 4] = [1.0e-6, 1.0e-4, 1.0e-3, 3.0e-3];
/// Greatest length there, relative to the size: the root of the rounding of its square.
const ZERO: f64 = 1.0e-7;
/// Places (as angles) nearer to each other than this are the same, found from both ends of a period.
const SAME: f64 = 1.0e-9;

impl Curve<'_> {
    /// Values beside the places where the tracked coordinate is not smooth.
    pub(super) fn at_zero_lengths(
        &mut self,
        window: &Window,
        node_values: &mut NodeValues,
    ) -> Vec<ValueAt> {
        let mut values = Vec::new();
        for zero in &window.zero_lengths {
            let q = window.at(zero.angle);
            if self.order == 0 && self.tracked == Tracked::Slide(zero.slide) {
                values.push(ValueAt { value: 0.0, q });
                continue;
            }
            let most = window.to_next(zero.angle);
            for way in [-1.0, 1.0] {
                let singularity = Singularity::ZeroLength;
                let side = Side { place: zero.angle, way, most, singularity };
                let samples = self.samples(window, side, 0);
                let limit = self.limit(window, node_values, &samples);
                values.extend(limit.map(|value| ValueAt { value, q }));
            }
        }
        values
    }

    /// Finds the places where passive cylinders have no length. A coordinate that depends on their direction
    /// has no derivatives there; others are smooth, and for them the places are dropped.
    pub(super) fn find_zero_lengths(&mut self, window: &mut Window) {
        let mut zeros = self.zero_lengths(window);
        zeros.retain(|zero| self.computed_by_angle(window, zero.angle).is_none());
        window.zero_lengths = zeros;
        window.aside = ASIDE[self.order];
    }

    /// The places where passive cylinders have no length.
    fn zero_lengths(&mut self, window: &Window) -> Vec<ZeroLength> {
        let lengths = self.passive_lengths();
        if lengths.is_empty() {
            return Vec::new();
        }
        let mut nodes = window.nodes();
        if window.is_period {
            // The end of a period is within it, too.
            nodes.extend(nodes.get(1).map(|first| PI + first));
        }
        let mut zeros = Vec::new();
        for (step, slide) in lengths {
            let places = self.zeros_of(window, &nodes, slide);
            zeros.extend(places.into_iter().map(|angle| ZeroLength { angle, step, slide }));
        }
        zeros
    }

    /// The angles where one of them has no length.
    fn zeros_of(&mut self, window: &Window, nodes: &[f64], slide: usize) -> Vec<f64> {
        let mut angles: Vec<f64> = Vec::new();
        let mut before: Option<(f64, f64)> = None;
        for &angle in nodes {
            let here = self.length(window, angle, slide).map(|(_, rate)| (angle, rate));
            if let (Some((from, falls)), Some((to, rises))) = (before, here)
                && falls < 0.0
                && rises > 0.0
            {
                let is_falling =
                    |at: f64| self.length(window, at, slide).map(|(_, rate)| rate < 0.0).ok_or(());
                if let Ok([at, _]) = bisect([from, to], TO_ROUNDING, is_falling)
                    && let Some((length, rate)) = self.length(window, at, slide)
                    && length < ZERO
                {
                    // Beside the place the rate is not known; up to it the length falls evenly.
                    let ahead = -length / rate * self.evaluator.unit(0);
                    let place = window.in_period(at + ahead / window.rates(at)[0]);
                    if angles.iter().all(|&angle| window.distance(angle, place) > SAME) {
                        angles.push(place);
                    }
                }
            }
            // At length 0 itself it is neither.
            before = here.filter(|&(_, rate)| rate != 0.0).or(before.filter(|_| here.is_some()));
        }
        angles
    }

    /// The steps of passive cylinders, and their slides.
    fn passive_lengths(&self) -> Vec<(usize, usize)> {
        let slide = |unknown: Unknown| match unknown {
            Unknown::Slide(slide) => Some(slide),
            Unknown::Class(_) => None,
        };
        let steps = self.evaluator.position().plan.steps.iter().enumerate();
        steps
            .filter_map(|(step, kind)| match kind {
                Step::Dyad(dyad) if dyad.is_length => {
                    dyad.unknowns.into_iter().find_map(slide).map(|slide| (step, slide))
                }
                _ => None,
            })
            .collect()
    }

    /// A length in sizes, and its derivative by q; at length 0 it is neither falling nor rising.
    fn length(&mut self, window: &Window, angle: f64, slide: usize) -> Option<(f64, f64)> {
        self.evaluator.solve(&[window.at(angle)]).ok()?;
        let state = self.evaluator.position().state;
        let [value, rate] = [0, 1].map(|k| state.pose.slides[slide * state.len + k][0]);
        Some((value, if rate.is_nan() { 0.0 } else { rate }))
    }
}
