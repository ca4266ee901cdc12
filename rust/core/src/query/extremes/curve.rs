//! A coordinate along the branch: where it is stationary, and where it is beyond a level.

use std::f64::consts::PI;

use super::known::{ByAngle, Known, Rounding};
use super::tracked::{Tracked, ValueAt};
use super::window::{Weight, Window};
use crate::math::root::all_roots::{Roots, Sample, all_roots};
use crate::query::evaluator::Evaluator;
use crate::structure::closure::point_of_joint;

/// Distance (as an angle) beside a length of 0 at which values are taken: nearer, second derivatives lose
/// digits.
pub(super) const ASIDE: f64 = 1.0e-6;

/// A coordinate along the branch, and the order of its derivative.
pub(super) struct Curve<'m> {
    pub evaluator: Evaluator<'m>,
    pub tracked: Tracked,
    pub order: usize,
}

impl Curve<'_> {
    /// The derivative with its first two derivatives by q.
    pub(super) fn by_coordinate(&mut self, q: f64) -> Option<ByAngle> {
        self.evaluator.solve(&[q]).ok()?;
        let position = self.evaluator.position();
        let (state, units) = (position.state, position.units);
        let jet = [0, 1, 2].map(|beyond| {
            let k = self.order + beyond;
            match self.tracked {
                Tracked::Joint(joint, component) => {
                    let point = state.pose.points[point_of_joint(joint) * state.len + k][0];
                    let own = if component == 0 { point.x } else { point.y };
                    let origin = if k == 0 { position.constants.origin[component] } else { 0.0 };
                    own * units.length[k] + origin
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

    /// The derivative at a coordinate.
    pub(super) fn value(&mut self, q: f64) -> Option<f64> {
        self.by_coordinate(q).map(|jet| jet[0])
    }

    /// The derivative with its first two derivatives by the window's angle.
    pub(super) fn by_angle(&mut self, window: &Window, angle: f64) -> Option<ByAngle> {
        let [value, rate, bend] = self.by_coordinate(window.at(angle))?;
        let [first, second] = window.rates(angle);
        Some([value, rate * first, bend * first * first + rate * second])
    }

    fn known(&mut self, window: &Window) -> Known {
        self.known_at(window, window.nodes())
    }

    fn known_at(&mut self, window: &Window, nodes: Vec<f64>) -> Known {
        let values = nodes.iter().map(|&angle| self.by_angle(window, angle)).collect();
        Known { nodes, values }
    }

    /// Roots of what `of` makes of the values, its slope with it; `entry` is the one whose poles it has.
    fn roots(
        &mut self,
        window: &Window,
        known: &Known,
        (entry, poles): (usize, [usize; 2]),
        of: impl Fn(ByAngle) -> [f64; 2],
    ) -> Roots {
        let unit = self.unit(window, entry);
        let rounding = Rounding::new(known, (entry, poles), unit);
        all_roots(&known.nodes, |angle| {
            let own = match known.node(angle) {
                Some(node) => known.values[node],
                None => self.by_angle(window, angle),
            }?;
            let weight = Weight::new(angle, poles);
            let [value, slope] = weight.of(of(own));
            Some(Sample { x: angle, value, slope, noise: rounding.at(angle, weight.factor) })
        })
    }

    /// The natural size of the derivative, or of its own by the angle.
    fn unit(&self, window: &Window, entry: usize) -> f64 {
        let units = self.evaluator.position().units;
        let all = if let Tracked::Link(_) = self.tracked { &units.angle } else { &units.length };
        all[self.order + entry] * if entry == 0 { 1.0 } else { window.half }
    }

    /// Values that may be extremes.
    pub(super) fn candidates(&mut self, window: &Window) -> Vec<ValueAt> {
        let known = self.known(window);
        let mut values = Vec::new();
        let mut last: Option<(f64, ByAngle)> = None;
        for (&angle, own) in known.nodes.iter().zip(&known.values) {
            let here = own.map(|own| (angle, own));
            values.extend(own.map(|own| ValueAt { value: own[0], q: window.at(angle) }));
            if let (Some(from), Some(to)) = (last, here)
                && let Some(q) = self.pole(window, from, to)
            {
                values.push(ValueAt { value: f64::NEG_INFINITY, q });
                values.push(ValueAt { value: f64::INFINITY, q });
            }
            last = here;
        }
        // The derivative by the angle has a pole of one order more.
        let poles = window.poles(self.order).map(|pole| if pole == 0 { 0 } else { pole + 1 });
        let roots = self.roots(window, &known, (1, poles), |own| [own[1], own[2]]);
        for root in &roots.isolated {
            let q = window.at(root.at);
            values.extend(self.value(q).map(|value| ValueAt { value, q }));
        }
        values.extend(self.at_zero_lengths(window, &known.nodes));
        values.extend(self.at_ends(window, &known));
        let [first, last] = window.ends();
        if window.is_period
            && matches!(self.tracked, Tracked::Link(_))
            && self.order == 0
            && let (Some(first), Some(last)) = (self.value(first), self.value(last))
            && (last - first).abs() > PI
        {
            values.push(ValueAt { value: f64::NEG_INFINITY, q: f64::NAN });
            values.push(ValueAt { value: f64::INFINITY, q: f64::NAN });
        }
        values
    }

    /// Stretches over which a linear function of the value is not negative.
    pub(super) fn stretches(&mut self, window: &Window, of: impl Fn(f64) -> f64) -> Vec<[f64; 2]> {
        let mut nodes = window.nodes();
        for at in self.zero_lengths(window, &window.nodes()) {
            nodes.extend([at - ASIDE, at + ASIDE]);
        }
        nodes.sort_by(f64::total_cmp);
        let known = self.known_at(window, nodes);
        let slope = of(1.0) - of(0.0);
        let poles = window.poles(self.order);
        let roots = self.roots(window, &known, (0, poles), |own| [of(own[0]), slope * own[1]]);
        let [first, last] = window.ends();
        let mut ends = vec![first];
        ends.extend(roots.isolated.iter().map(|root| window.at(root.at)));
        ends.push(last);
        let mut found: Vec<[f64; 2]> = Vec::new();
        for pair in ends.windows(2) {
            let inside = self.value(0.5 * (pair[0] + pair[1]));
            if !inside.is_some_and(|value| of(value) >= 0.0) {
                continue;
            }
            match found.last_mut() {
                // A value that only touches the level ends nothing.
                Some(last) if last[1] == pair[0] => last[1] = pair[1],
                _ => found.push([pair[0], pair[1]]),
            }
        }
        found
    }
}
