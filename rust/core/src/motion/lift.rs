//! Angles followed continuously from the drawing.
//!
//! An angle at a position is known up to whole turns; the right one is found
//! along the straight path of q from the drawing, on knots that depend on the
//! design alone: equal cells, halved where a link turns fast. So the angle does
//! not depend on which other positions were asked for.

use std::f64::consts::TAU;

use super::state::{Context, State, Status};
use crate::tolerance::{LIFT_HALVINGS, LIFT_TURN};

/// Cells in a turn of a driven angle.
const CELLS_A_TURN: u32 = 32;
/// Cells in the unit of length for a driven slide.
const CELLS_A_LENGTH: f64 = 16.0;
/// Halvings where a stretch that can be reached begins or ends: what is left of
/// the turn there goes with the square root of the cell.
const EDGE_HALVINGS: u32 = 14;

#[derive(Debug, Clone)]
struct Knot {
    at: f64,
    reached: bool,
    /// Lifted angle of every class; where not reached, that of the last knot that was.
    angles: Vec<f64>,
    /// Rate of every class along the path.
    rates: Vec<f64>,
}

/// The lifted angles along one path.
#[derive(Debug, Clone, Default)]
pub struct Lift {
    knots: Vec<Knot>,
    /// Gain of every class over a whole turn of the driver.
    gain: Vec<f64>,
    period: Option<f64>,
}

/// Where a path leads: coordinates at a parameter, and their rates.
pub struct Path<'a> {
    /// Writes q at a parameter.
    pub point: &'a dyn Fn(f64, &mut [f64]),
    /// Derivatives of q by the parameter (constant: paths are straight).
    pub rates: &'a [f64],
}

/// Walks along a path and lays knots.
struct Walker<'a, 'b> {
    cx: &'a Context<'b>,
    state: &'a mut State,
    path: &'a Path<'a>,
    q: Vec<f64>,
    knots: Vec<Knot>,
}

impl Walker<'_, '_> {
    /// The knot at `at`, its angles nearest to those of `from`.
    fn knot(&mut self, at: f64, from: &[f64]) -> Knot {
        (self.path.point)(at, &mut self.q);
        self.state.solve(self.cx, &self.q);
        let reached =
            matches!(self.state.status, Status::Ok | Status::NearSingular | Status::Singular);
        if !reached {
            return Knot { at, reached, angles: from.to_vec(), rates: vec![0.0; from.len()] };
        }
        let angles =
            self.state.class.iter().zip(from).map(|(u, &near)| nearest(u.angle(), near)).collect();
        let len = self.state.len;
        let rates = (0..from.len())
            .map(|c| {
                let by_driver = self.path.rates.iter().enumerate();
                by_driver.map(|(d, r)| r * self.state.theta[c * len + 1 + d]).sum::<f64>().abs()
            })
            .collect();
        Knot { at, reached, angles, rates }
    }

    /// Lays knots from the last one to `to`, close enough to tell the angles.
    fn advance(&mut self, to: f64) {
        let mut ends = vec![(to, 0_u32)];
        while let Some((end, depth)) = ends.pop() {
            let Some(from) = self.knots.last().cloned() else { return };
            let knot = self.knot(end, &from.angles);
            let middle = 0.5 * (from.at + end);
            let can_halve = middle != from.at && middle != end;
            if can_halve && depth < LIFT_HALVINGS && too_far(&from, &knot, depth) {
                ends.push((end, depth + 1));
                ends.push((middle, depth + 1));
            } else {
                self.knots.push(knot);
            }
        }
    }
}

/// The angle that differs from `angle` by whole turns and is nearest to `near`.
fn nearest(angle: f64, near: f64) -> f64 {
    let turns = ((near - angle) / TAU).round();
    if turns == 0.0 { angle } else { angle + TAU * turns }
}

fn too_far(a: &Knot, b: &Knot, depth: u32) -> bool {
    if a.reached != b.reached {
        return depth < EDGE_HALVINGS;
    }
    let cell = (b.at - a.at).abs();
    let turned = a.angles.iter().zip(&b.angles).any(|(x, y)| (x - y).abs() > LIFT_TURN);
    // Near a dead point rates grow without bound while the angle does not.
    let fast =
        depth < EDGE_HALVINGS && a.rates.iter().chain(&b.rates).any(|rate| rate * cell > LIFT_TURN);
    a.reached && (turned || fast)
}

impl Lift {
    /// Along one driven angle, from `q0` on, for ever.
    #[must_use]
    pub fn turning(cx: &Context<'_>, state: &mut State, q0: f64, start: &[f64]) -> Self {
        let path = Path { point: &|at, q| q[0] = at, rates: &[1.0] };
        let mut walker = walker(cx, state, &path, q0, start);
        for cell in 1..=CELLS_A_TURN {
            walker.advance(q0 + TAU * f64::from(cell) / f64::from(CELLS_A_TURN));
        }
        let knots = walker.knots;
        let gain = match (knots.iter().find(|k| k.reached), knots.last()) {
            (Some(first), Some(last)) => first
                .angles
                .iter()
                .zip(&last.angles)
                .map(|(&a, &b)| TAU * ((b - a) / TAU).round())
                .collect(),
            _ => vec![0.0; start.len()],
        };
        Self { knots, gain, period: Some(TAU) }
    }

    /// Along one driven slide, from `q0` both ways to `low` and `high`
    /// (not farther than `reach` from `q0`).
    #[must_use]
    pub fn sliding(
        cx: &Context<'_>,
        state: &mut State,
        q0: f64,
        [low, high]: [f64; 2],
        reach: f64,
        start: &[f64],
    ) -> Self {
        let path = Path { point: &|at, q| q[0] = at, rates: &[1.0] };
        let mut knots = Vec::new();
        for (end, sign) in [(low, -1.0), (high, 1.0)] {
            let mut walker = walker(cx, state, &path, q0, start);
            let cells = (((end - q0) * sign).min(reach) * CELLS_A_LENGTH).ceil();
            let mut cell = 0.0;
            while cell < cells {
                cell += 1.0;
                walker.advance(q0 + sign * cell / CELLS_A_LENGTH);
            }
            if sign < 0.0 {
                walker.knots.reverse();
                walker.knots.pop();
            }
            knots.append(&mut walker.knots);
        }
        Self { knots, gain: vec![0.0; start.len()], period: None }
    }

    /// Straight from the drawing to one point of several coordinates.
    #[must_use]
    pub fn straight(
        cx: &Context<'_>,
        state: &mut State,
        q0: &[f64],
        q1: &[f64],
        start: &[f64],
    ) -> Self {
        let rates: Vec<f64> = q0.iter().zip(q1).map(|(a, b)| b - a).collect();
        let point = |at: f64, q: &mut [f64]| {
            for ((x, &a), &rate) in q.iter_mut().zip(q0).zip(&rates) {
                *x = a + at * rate;
            }
        };
        let path = Path { point: &point, rates: &rates };
        let longest = rates.iter().fold(0.0_f64, |m, r| m.max(r.abs()));
        let cells = (longest * CELLS_A_LENGTH).ceil().clamp(1.0, 1e6);
        let mut walker = walker(cx, state, &path, 0.0, start);
        let mut cell = 0.0;
        while cell < cells {
            cell += 1.0;
            walker.advance(cell / cells);
        }
        Self { knots: walker.knots, gain: vec![0.0; start.len()], period: None }
    }

    /// The angle of a class at a parameter, given its value up to whole turns.
    #[must_use]
    pub fn angle(&self, at: f64, class: usize, principal: f64) -> f64 {
        let Some(first) = self.knots.first() else { return principal };
        let (mut place, mut whole) = (at, 0.0);
        if let Some(period) = self.period {
            whole = ((at - first.at) / period).floor();
            place = at - whole * period;
        }
        let after = self.knots.partition_point(|k| k.at <= place);
        let left = self.knots.get(after.saturating_sub(1)).unwrap_or(first);
        let knot = match self.knots.get(after) {
            Some(right) if !left.reached && right.reached => right,
            _ => left,
        };
        nearest(principal, knot.angles[class] + whole * self.gain[class])
    }
}

fn walker<'a, 'b>(
    cx: &'a Context<'b>,
    state: &'a mut State,
    path: &'a Path<'a>,
    at: f64,
    start: &[f64],
) -> Walker<'a, 'b> {
    let mut walker = Walker { cx, state, path, q: vec![0.0; path.rates.len()], knots: Vec::new() };
    let knot = walker.knot(at, start);
    walker.knots.push(knot);
    walker
}
