//! Extremes of a coordinate of the motion, or of a derivative of it, over all of an assembly's
//! intervals.

use std::f64::consts::{PI, TAU};

use super::evaluator::{Evaluator, Queries};
use super::limits::finder::{Interval, LimitsFinder, Tables};
use crate::description::error::SolveError;
use crate::math::angle::whole_part;
use crate::math::derivatives::DerivativeTables;
use crate::math::root::all_roots::{Sample, all_roots};
use crate::math::trig::sin_cos;
use crate::plan::mechanism::Mechanism;
use crate::structure::closure::point_of_joint;

/// Nodes for each turn (or size), and at least.
const NODES: f64 = 96.0;
/// Rounding of a derivative, relative to the greatest at a node.
const NOISE: f64 = 1.0e-11;
/// Nearest node to a dead point, as an angle.
const NEAR_END: f64 = 1.0e-3;
/// Step of a difference (as an angle) in place of a derivative of fourth order.
const DIFFERENCE: f64 = 1.0e-5;

/// Halvings toward a pole, and how many times greater than at the nodes the value is there.
const HALVINGS: usize = 40;
const POLE: f64 = 1.0e6;
/// How far (in halves of the window) a slide is followed to see where a value goes, and by what factor
/// one grows that has no limit.
const FAR: [f64; 2] = [1.0e2, 1.0e4];
const GROWS: f64 = 10.0;
/// How near (in halves of the window) to an end without a fold a value is compared.
const BESIDE_END: [f64; 2] = [1.0e-6, 1.0e-4];

/// A coordinate of the motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tracked {
    /// A joint's x (0) or y (1), m.
    Joint(usize, usize),
    /// A link's angle, rad.
    Link(usize),
    /// A slide's value, m.
    Slide(usize),
}

/// A value and the coordinate of the driver where it is taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ValueAt {
    /// The value.
    pub value: f64,
    /// Where.
    pub q: f64,
}

impl Mechanism {
    /// The least and the greatest value of a derivative of order 0 to 2 of a coordinate; none if the
    /// assembly does not exist. At a dead point derivatives are infinite, and so is the angle of a link
    /// that goes round.
    ///
    /// # Errors
    ///
    /// Those of [`LimitsFinder`], and an order above 2.
    pub fn extremes(
        &self,
        dimensions: &[f64],
        signs: &[i8],
        tracked: Tracked,
        order: usize,
    ) -> Result<Option<[ValueAt; 2]>, SolveError> {
        let mut found: Option<[ValueAt; 2]> = None;
        self.over_intervals((dimensions, signs), tracked, order, |curve, window| {
            for one in curve.candidates(window) {
                found = Some(match found {
                    None => [one; 2],
                    Some([least, greatest]) => [
                        if one.value < least.value { one } else { least },
                        if one.value > greatest.value { one } else { greatest },
                    ],
                });
            }
        })?;
        Ok(found)
    }

    /// Stretches of q over which a derivative of order 0 to 2 of a coordinate is at least `level`, or
    /// at most.
    ///
    /// # Errors
    ///
    /// Those of [`Mechanism::extremes`].
    pub fn stretches_beyond(
        &self,
        dimensions: &[f64],
        signs: &[i8],
        (tracked, order): (Tracked, usize),
        (level, at_least): (f64, bool),
    ) -> Result<Vec<[f64; 2]>, SolveError> {
        let mut found = Vec::new();
        let sign = if at_least { 1.0 } else { -1.0 };
        self.over_intervals((dimensions, signs), tracked, order, |curve, window| {
            let mut own = curve.stretches(window, |value| sign * (value - level));
            if window.is_period {
                join(&mut own, window.ends());
            }
            found.extend(own);
        })?;
        Ok(found)
    }

    /// Hands every interval of an assembly to `visit`.
    fn over_intervals(
        &self,
        (dimensions, signs): (&[f64], &[i8]),
        tracked: Tracked,
        order: usize,
        mut visit: impl FnMut(&mut Curve<'_>, &Window),
    ) -> Result<(), SolveError> {
        if order > 2 {
            return Err(SolveError::Order(order));
        }
        let tables = Tables::default();
        let limits = LimitsFinder::new(self, signs, &tables)?.limits(dimensions)?;
        let derivatives = DerivativeTables::new(1, 3);
        let evaluator = Evaluator::with_signs(
            self,
            (dimensions, signs),
            &derivatives,
            Queries::Any,
            matches!(tracked, Tracked::Link(_)),
        );
        let mut curve = Curve { evaluator, tracked, order };
        let turns = limits.period.map_or(1.0, f64::from);
        for interval in &limits.intervals {
            let window = Window::of(self, &curve.evaluator, interval, turns);
            visit(&mut curve, &window);
        }
        Ok(())
    }
}

/// Joins the first and the last stretch if they are one, over the end of a period.
fn join(stretches: &mut Vec<[f64; 2]>, [from, to]: [f64; 2]) {
    if let [[first, _], .., [_, last]] = stretches[..]
        && first == from
        && last == to
        && let Some([start, _]) = stretches.pop()
    {
        stretches[0][0] = start - (to - from);
    }
}

/// A coordinate along the branch.
struct Curve<'m> {
    evaluator: Evaluator<'m>,
    tracked: Tracked,
    order: usize,
}

/// An interval as a function of an angle from 0 to π: square roots at dead points are smooth in it.
struct Window {
    middle: f64,
    half: f64,
    /// Which ends are dead points.
    folds: [bool; 2],
    /// Which ends are infinite: of a slide that nothing stops.
    infinite: [bool; 2],
    /// Whether it is one period of a motion that closes.
    is_period: bool,
    /// Turns of the driver, or its way in sizes.
    length: f64,
}

impl Window {
    fn of(
        mechanism: &Mechanism,
        evaluator: &Evaluator<'_>,
        interval: &Interval,
        turns: f64,
    ) -> Self {
        let q0 = mechanism.q0()[0];
        let is_turn = mechanism.plan().driven_slide(0).is_none();
        let reach = if is_turn { PI * turns } else { evaluator.reach() };
        let [low, high] = interval.ends;
        let low = if low.is_finite() { low } else { q0 - reach };
        let high = if high.is_finite() { high } else { q0 + reach };
        let unit = if is_turn { TAU } else { evaluator.unit(0) };
        Self {
            middle: 0.5 * (low + high),
            half: 0.5 * (high - low),
            folds: interval.folds.map(|fold| fold.is_some()),
            infinite: interval.ends.map(|end| end.is_infinite() && !is_turn),
            is_period: is_turn && interval.ends[0].is_infinite(),
            length: (high - low) / unit,
        }
    }

    fn ends(&self) -> [f64; 2] {
        [self.middle - self.half, self.middle + self.half]
    }

    fn has_folds(&self) -> bool {
        self.folds[0] || self.folds[1]
    }

    /// Angles from end to end.
    fn nodes(&self) -> Vec<f64> {
        let count = (NODES * self.length).max(NODES).ceil();
        let margin = if self.has_folds() { NEAR_END } else { 0.0 };
        let node = |i: usize| margin + (PI - 2.0 * margin) * i as f64 / count;
        (0..=whole_part(count)).map(node).collect()
    }

    fn at(&self, angle: f64) -> f64 {
        let part = if self.has_folds() { -sin_cos(angle).1 } else { angle / (0.5 * PI) - 1.0 };
        self.middle + self.half * part
    }

    /// First and second derivative.
    fn rates(&self, angle: f64) -> [f64; 2] {
        if self.has_folds() {
            let (sin, cos) = sin_cos(angle);
            [self.half * sin, self.half * cos]
        } else {
            [self.half / (0.5 * PI), 0.0]
        }
    }
}

impl Curve<'_> {
    /// The coordinate and its derivatives to order 3.
    fn jet(&mut self, q: f64) -> Option<[f64; 4]> {
        self.evaluator.solve(&[q]).ok()?;
        let position = self.evaluator.position();
        let (state, units) = (position.state, position.units);
        let mut jet = [0.0; 4];
        for (k, entry) in jet.iter_mut().enumerate() {
            *entry = match self.tracked {
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
            };
        }
        jet.iter().all(|x| x.is_finite()).then_some(jet)
    }

    /// Values that may be extremes.
    fn candidates(&mut self, window: &Window) -> Vec<ValueAt> {
        let nodes = window.nodes();
        let (mut values, mut greatest) = (Vec::new(), 0.0_f64);
        let mut last: Option<(f64, [f64; 2])> = None;
        for &angle in &nodes {
            let jet = self.jet(window.at(angle));
            let here = jet.map(|jet| (window.at(angle), [jet[self.order], jet[self.order + 1]]));
            if let Some((q, [value, rate])) = here {
                values.push(ValueAt { value, q });
                greatest = greatest.max((rate * window.rates(angle)[0]).abs());
            }
            if let (Some(from), Some(to)) = (last, here)
                && let Some(q) = self.pole(from, to)
            {
                values.push(ValueAt { value: f64::NEG_INFINITY, q });
                values.push(ValueAt { value: f64::INFINITY, q });
            }
            last = here;
        }
        let noise = NOISE * greatest;
        let roots = all_roots(&nodes, |angle| {
            let [value, slope] = self.rate(window, angle)?;
            Some(Sample { x: angle, value, slope, noise })
        });
        for root in &roots.isolated {
            let q = window.at(root.at);
            values.extend(self.jet(q).map(|jet| ValueAt { value: jet[self.order], q }));
        }
        for (side, end) in window.ends().into_iter().enumerate() {
            if window.folds[side] {
                values.extend(self.at_dead_point(window, end, side == 0));
            }
        }
        for side in [0, 1] {
            if window.infinite[side] {
                values.extend(self.at_infinity(window, side));
            } else if !window.folds[side] && !window.is_period {
                values.extend(self.at_open_end(window, side));
            }
        }
        let [first, last] = window.ends();
        if window.is_period
            && matches!(self.tracked, Tracked::Link(_))
            && self.order == 0
            && let (Some(first), Some(last)) = (self.jet(first), self.jet(last))
            && (last[0] - first[0]).abs() > PI
        {
            values.push(ValueAt { value: f64::NEG_INFINITY, q: f64::NAN });
            values.push(ValueAt { value: f64::INFINITY, q: f64::NAN });
        }
        values
    }

    /// Stretches over which a linear function of the value is not negative.
    fn stretches(&mut self, window: &Window, of: impl Fn(f64) -> f64) -> Vec<[f64; 2]> {
        let nodes = window.nodes();
        let slope_of = of(1.0) - of(0.0);
        let mut size = 0.0_f64;
        for &angle in &nodes {
            size = size.max(self.jet(window.at(angle)).map_or(0.0, |jet| jet[self.order].abs()));
        }
        let noise = NOISE * size;
        let roots = all_roots(&nodes, |angle| {
            let jet = self.jet(window.at(angle))?;
            let slope = slope_of * jet[self.order + 1] * window.rates(angle)[0];
            Some(Sample { x: angle, value: of(jet[self.order]), slope, noise })
        });
        let [first, last] = window.ends();
        let mut ends = vec![first];
        ends.extend(roots.isolated.iter().map(|root| window.at(root.at)));
        ends.push(last);
        let mut found: Vec<[f64; 2]> = Vec::new();
        for pair in ends.windows(2) {
            let inside = self.jet(0.5 * (pair[0] + pair[1]));
            if !inside.is_some_and(|jet| of(jet[self.order]) >= 0.0) {
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

    /// The derivative by the window's angle, and its own.
    fn rate(&mut self, window: &Window, angle: f64) -> Option<[f64; 2]> {
        let jet = self.jet(window.at(angle))?;
        let [first, second] = window.rates(angle);
        let value = jet[self.order + 1] * first;
        if self.order < 2 {
            return Some([
                value,
                jet[self.order + 2] * first * first + jet[self.order + 1] * second,
            ]);
        }
        let mut beside = |angle: f64| {
            let jet = self.jet(window.at(angle))?;
            Some(jet[3] * window.rates(angle)[0])
        };
        let slope =
            (beside(angle + DIFFERENCE)? - beside(angle - DIFFERENCE)?) / (2.0 * DIFFERENCE);
        Some([value, slope])
    }

    /// Where a value goes through infinity between two coordinates: it steps back although it grows at
    /// both, or forward although it falls.
    fn pole(
        &mut self,
        (mut from, [first, rate]): (f64, [f64; 2]),
        (mut to, [last, later]): (f64, [f64; 2]),
    ) -> Option<f64> {
        let way = 1.0_f64.copysign(rate);
        if rate * later <= 0.0 || way * (last - first) >= 0.0 {
            return None;
        }
        let (mut above, mut below) = (first, last);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (from + to);
            let value = self.jet(middle)?[self.order];
            if way * (value - above) >= 0.0 {
                (from, above) = (middle, value);
            } else {
                (to, below) = (middle, value);
            }
        }
        let size = first.abs().max(last.abs());
        (above.abs().min(below.abs()) > POLE * size).then_some(from)
    }

    /// Infinity, if the value grows without end toward where an interval ends without a fold: there a
    /// joint is at infinity.
    fn at_open_end(&mut self, window: &Window, side: usize) -> Option<ValueAt> {
        let inward = if side == 0 { window.half } else { -window.half };
        let end = window.ends()[side];
        let [near, far] = BESIDE_END.map(|part| self.jet(end + inward * part));
        let [near, far] = [near?[self.order], far?[self.order]];
        let grows = near.abs() > GROWS * far.abs();
        grows.then(|| ValueAt { value: f64::INFINITY.copysign(near), q: end })
    }

    /// Where the value goes as a slide goes on without end.
    fn at_infinity(&mut self, window: &Window, side: usize) -> Option<ValueAt> {
        let way = if side == 0 { -1.0 } else { 1.0 };
        let [near, far] = FAR.map(|part| self.jet(window.middle + way * part * window.half));
        let [near, far] = [near?[self.order], far?[self.order]];
        let grows = far.abs() > GROWS * near.abs();
        let value = if grows { f64::INFINITY.copysign(far) } else { far };
        Some(ValueAt { value, q: way * f64::INFINITY })
    }

    /// The value at a dead point: of the coordinate extrapolated, of a derivative infinite.
    fn at_dead_point(&mut self, window: &Window, end: f64, is_first: bool) -> Option<ValueAt> {
        let at = |part: f64| if is_first { part } else { PI - part };
        if self.order > 0 {
            let [near, far] = [NEAR_END, 4.0 * NEAR_END].map(|part| self.jet(window.at(at(part))));
            let [near, far] = [near?[self.order], far?[self.order]];
            let grows = near.abs() > 2.0 * far.abs();
            return grows.then(|| ValueAt { value: f64::INFINITY.copysign(near), q: end });
        }
        // Hermite interpolation at three nodes, of the sixth degree in the angle.
        let nodes = [4.0, 8.0, 12.0].map(|part| part * NEAR_END);
        let mut table = Vec::new();
        for part in nodes {
            let angle = at(part);
            let jet = self.jet(window.at(angle))?;
            let way = if is_first { 1.0 } else { -1.0 };
            table.push((part, jet[0], way * jet[1] * window.rates(angle)[0]));
        }
        Some(ValueAt { value: hermite_at_zero(&table), q: end })
    }
}

/// The value at 0 of the polynomial through values and slopes at nodes.
fn hermite_at_zero(nodes: &[(f64, f64, f64)]) -> f64 {
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
