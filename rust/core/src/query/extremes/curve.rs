//! A coordinate along the branch: where it is stationary, and where it is beyond a level.

use std::f64::consts::PI;
use std::sync::atomic::{AtomicBool, Ordering};

use super::beside::Beside;
use super::node_values::{ByAngle, NOISE, NodeValues, Rounding};
use super::tracked::{Tracked, ValueAt};
use super::window::{Weight, Window};
use crate::math::root::all_roots::{Roots, Sample, all_roots};
use crate::math::tolerance::ANALOGUE_PER_CONDITION_SQUARED;
use crate::query::evaluator::Evaluator;
use crate::structure::closure::point_of_joint;

/// Where the value between two ends is taken, from 0 to 1: it may not exist at the first.
const WITHIN: [f64; 3] = [0.5, 0.3, 0.8];

/// A coordinate along the branch, and the order of its derivative.
pub(super) struct Curve<'m> {
    pub evaluator: Evaluator<'m>,
    pub tracked: Tracked,
    pub order: usize,
    /// Polynomials that replace its values beside places where digits are lost.
    pub beside: Vec<Beside>,
    /// Once this is true, the curve gives no more values.
    pub cancel: Option<&'m AtomicBool>,
}

impl Curve<'_> {
    /// The derivative with its first two derivatives by q.
    pub(super) fn by_coordinate(&mut self, q: f64) -> Option<ByAngle> {
        if self.cancel.is_some_and(|cancel| cancel.load(Ordering::Relaxed)) {
            return None;
        }
        self.evaluator.solve(&[q]).ok()?;
        let position = self.evaluator.position();
        let (state, units) = (position.state, position.units);
        let jet = [0, 1, 2].map(|beyond| {
            let k = self.order + beyond;
            match self.tracked {
                Tracked::Joint(joint, component) => {
                    let point = state.pose.points[point_of_joint(joint) * state.len + k][0];
                    let coordinate = if component == 0 { point.x } else { point.y };
                    let origin = if k == 0 { position.constants.origin[component] } else { 0.0 };
                    coordinate * units.length[k] + origin
                }
                Tracked::Slide(slide) => {
                    state.pose.slides[slide * state.len + k][0] * units.length[k]
                }
                Tracked::Link(link) if k == 0 => position.angle(link),
                Tracked::Link(link) => position.angle_rate(link, k),
            }
        });
        jet.iter().all(|x| x.is_finite()).then_some(jet)
    }

    /// Bounds of rounding at the last position, usually and at most: a coordinate that stands, or does not
    /// take part in the fold, may be made of others that do.
    pub(super) fn rounding(&self) -> [f64; 2] {
        let position = self.evaluator.position();
        // Beside a change point the error of a k-th derivative is one of κ^(k + 1).
        let condition = self.evaluator.total_condition();
        let grown = (0..self.order).fold(condition, |power, _| power * condition);
        let parts = [NOISE, NOISE.max(ANALOGUE_PER_CONDITION_SQUARED * grown)];
        parts.map(|part| part * position.greatest(self.order) * self.own_unit(self.order))
    }

    /// The derivative at a coordinate.
    pub(super) fn value(&mut self, q: f64) -> Option<f64> {
        self.by_coordinate(q).map(|jet| jet[0])
    }

    /// The derivative with its first two derivatives by the window's angle, with the digits it has there.
    pub(super) fn computed_by_angle(&mut self, window: &Window, angle: f64) -> Option<ByAngle> {
        let [value, rate, bend] = self.by_coordinate(window.at(angle))?;
        let [first, second] = window.rates(angle);
        Some([value, rate * first, bend * first * first + rate * second])
    }

    /// Roots of `equation`, which returns a value with its slope; `entry` is the entry whose poles it has.
    fn roots(
        &mut self,
        window: &Window,
        node_values: &NodeValues,
        (entry, poles): (usize, [usize; 2]),
        equation: impl Fn(ByAngle) -> [f64; 2],
    ) -> Roots {
        let unit = self.unit(window, entry);
        let rounding = Rounding::new(node_values, (entry, poles), unit);
        let mut sample = |angle: f64| {
            let jet = node_values.value_or(angle, || self.by_angle(window, angle))?;
            let weight = Weight::new(angle, poles);
            let [value, slope] = weight.of(equation(jet));
            Some(Sample { x: angle, value, slope, noise: rounding.at(angle, weight.factor) })
        };
        let mut roots = Roots::default();
        // From one place where the value is not smooth to the next.
        let is_smooth = |from: &f64, to: &f64| {
            !window.zero_lengths.iter().any(|zero| (*from..*to).contains(&zero.angle))
        };
        for nodes in node_values.nodes.chunk_by(is_smooth) {
            let local = all_roots(nodes, &mut sample);
            roots.isolated.extend(local.isolated);
            roots.jumps.extend(local.jumps);
        }
        roots
    }

    /// The natural size of the derivative, or of its derivative by the angle.
    fn unit(&self, window: &Window, entry: usize) -> f64 {
        self.own_unit(self.order + entry) * if entry == 0 { 1.0 } else { window.half }
    }

    /// The unit of its derivative of an order.
    pub(super) fn own_unit(&self, order: usize) -> f64 {
        let units = self.evaluator.position().units;
        let all = if let Tracked::Link(_) = self.tracked { &units.angle } else { &units.length };
        all[order]
    }

    /// Values that may be extremes.
    pub(super) fn candidates(&mut self, window: &Window) -> Vec<ValueAt> {
        let mut node_values = self.node_values_at(window, &window.nodes());
        if self.order > 0 && node_values.is_zero(self.own_unit(self.order)) {
            return vec![ValueAt { value: 0.0, q: window.middle }];
        }
        let beside = self.settle(window, &mut node_values);
        let mut values = Vec::new();
        for (&angle, jet) in node_values.nodes.iter().zip(&node_values.values) {
            values.extend(jet.map(|jet| ValueAt { value: jet[0], q: window.at(angle) }));
        }
        for q in self.poles_between(window, &node_values).map(|angle| window.at(angle)) {
            values.push(ValueAt { value: f64::NEG_INFINITY, q });
            values.push(ValueAt { value: f64::INFINITY, q });
        }
        // The derivative by the angle has a pole of one order more.
        let poles = window.poles(self.order).map(|pole| if pole == 0 { 0 } else { pole + 1 });
        let roots = self.roots(window, &node_values, (1, poles), |jet| [jet[1], jet[2]]);
        // Where the slope has lost digits it jumps over zero.
        for angle in roots.isolated.iter().map(|root| root.at).chain(roots.jumps) {
            let jet = self.by_angle(window, angle);
            values.extend(jet.map(|jet| ValueAt { value: jet[0], q: window.at(angle) }));
        }
        values.extend(beside);
        if self.goes_round(window, &node_values) {
            values.push(ValueAt { value: f64::NEG_INFINITY, q: f64::NAN });
            values.push(ValueAt { value: f64::INFINITY, q: f64::NAN });
        }
        values
    }

    /// Whether it is the angle of a link that is another after a period. At the very ends the angle may
    /// step (of a cylinder without length), and has no value: it is compared where it has one.
    fn goes_round(&mut self, window: &Window, node_values: &NodeValues) -> bool {
        if !(window.is_period && matches!(self.tracked, Tracked::Link(_)) && self.order == 0) {
            return false;
        }
        let gains = node_values.nodes.iter().zip(&node_values.values).find_map(|(&angle, jet)| {
            let [first, ..] = (*jet)?;
            Some(self.value(window.at(PI + angle))? - first)
        });
        gains.is_some_and(|gain| gain.abs() > PI)
    }

    /// Stretches over which a linear function of the value is not negative.
    pub(super) fn stretches(
        &mut self,
        window: &Window,
        condition: impl Fn(f64) -> f64,
    ) -> Vec<[f64; 2]> {
        let mut node_values = self.node_values_at(window, &window.nodes());
        if self.order > 0 && node_values.is_zero(self.own_unit(self.order)) {
            return if condition(0.0) >= 0.0 { vec![window.ends()] } else { Vec::new() };
        }
        self.settle(window, &mut node_values);
        let slope = condition(1.0) - condition(0.0);
        let poles = window.poles(self.order);
        let roots =
            self.roots(window, &node_values, (0, poles), |jet| [condition(jet[0]), slope * jet[1]]);
        // Where the value steps, or goes through infinity, it may pass the level without a root.
        let steps = window.zero_lengths.iter().map(|zero| zero.angle).chain(roots.jumps);
        // Not so near to an end of the window that no value lies between.
        let steps = steps.filter(|at| (window.aside..=PI - window.aside).contains(at));
        let inner = roots.isolated.iter().map(|root| root.at).chain(steps);
        let mut ends: Vec<f64> = inner.collect();
        ends.extend(self.poles_between(window, &node_values));
        ends.extend([0.0, PI]);
        ends.sort_by(f64::total_cmp);
        let mut stretches: Vec<[f64; 2]> = Vec::new();
        for pair in ends.windows(2) {
            let [from, to] = [pair[0], pair[1]];
            let inside = |on: &f64| self.by_angle(window, from + on * (to - from));
            if !WITHIN.iter().find_map(inside).is_some_and(|jet| condition(jet[0]) >= 0.0) {
                continue;
            }
            let [from, to] = [from, to].map(|angle| window.at(angle));
            match stretches.last_mut() {
                // A value that only touches the level ends nothing.
                Some(last) if last[1] == from => last[1] = to,
                _ => stretches.push([from, to]),
            }
        }
        stretches
    }
}
