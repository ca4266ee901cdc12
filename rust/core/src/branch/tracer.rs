//! Traces a branch from the drawing, with knots close enough together to show every change point
//! and to count the turns of every angle.

use std::convert::Infallible;
use std::f64::consts::{PI, TAU};

use super::hermite::HermiteCell;
use super::knot::{
    ChangePoint, InitialGuess, Knot, SignInterval, Taylor2, closes, predict, prediction_error,
    prediction_failed,
};
use super::refinement::must_refine;
use crate::math::angle::{unwrap_to, whole_turns};
use crate::math::root::bisection::{TO_ROUNDING, bisect};
use crate::math::tolerance::{KNOT_MAX_HALVINGS, KNOT_MAX_TURN};
use crate::math::vector::Vector;
use crate::plan::dyad::{Dyad, Form, Unknown};
use crate::plan::plan::Step;
use crate::state::state::{Context, State};
use crate::state::status::{Fault, Status};

/// With this many knots cells are no longer halved: if angles are only rounding (a link of 1e-17 of the
/// size), no cell would ever be fine enough.
const MAX_KNOTS: usize = 100_000;
/// Part of a cell by which a knot is moved off a flat dyad.
const NUDGE: f64 = 0.0625;
/// Number of such moves: change points of several dyads are rarely so close together.
const MAX_NUDGES: u32 = 4;
/// Nearest distance (rad, or units of the scale) to a change point at which rates are more than
/// rounding: their error is 64 u κ², with κ about 1/distance.
const MIN_PROBE: f64 = 1.0 / 1048576.0;
/// Distances from a change point, in cells, at which links are checked for a fast turn.
const PROBES: [f64; 3] = [1.0 / 128.0, 1.0 / 16384.0, 1.0 / 1048576.0];

/// Halvings toward a fold: down to the spacing of q.
const FOLD_HALVINGS: u32 = 52;
/// Halvings from which the middle of a cell is checked. Beside two folds close together an unknown
/// varies as the cube root of q, which coarser cells do not follow.
const JUMP_HALVINGS: u32 = 4;
/// Distance that an unknown in the middle of a cell may have from the Hermite polynomial: as a part
/// of the prediction error between the ends (a jump would give half of that) …
const JUMP_RATIO: f64 = 1.0 / 64.0;
/// … and the rounding beside two folds that meet: ∛u with a margin.
const JUMP_ROUNDING: f64 = 1.0 / 65536.0;

/// Largest turn (rad) across a gap that knots beside it show well enough: up to either edge an angle may
/// turn by [`KNOT_MAX_TURN`].
const MAX_KNOWN_STEP: f64 = PI - 2.0 * KNOT_MAX_TURN - 0.0625;

/// Follows a branch along a path and sets its knots.
pub(crate) struct BranchTracer<'a, 'b> {
    pub cx: Context<'b>,
    pub state: &'a mut State,
    /// Writes q at a parameter.
    point: &'a dyn Fn(f64, &mut [f64]),
    /// Derivatives of q by the parameter (constant, because paths are straight).
    rates: &'a [f64],
    /// +1 or −1: direction along the parameter.
    pub direction: f64,
    q: Vec<f64>,
    pub knots: Vec<Knot>,
    /// Change points passed, in that order.
    pub changes: Vec<ChangePoint>,
    pub start_signs: Vec<f64>,
    /// Unknowns of the groups, in order, and the step of the last group.
    unknowns: Vec<Unknown>,
    last_group: Option<usize>,
    /// Their values at the start.
    initial: Vec<Taylor2>,
    /// Whether the branch has ended: a group folds ahead, or a step upstream of it does not close.
    pub ended: bool,
}

impl<'a, 'b> BranchTracer<'a, 'b> {
    pub(crate) fn new(
        cx: &Context<'b>,
        state: &'a mut State,
        point: &'a dyn Fn(f64, &mut [f64]),
        rates: &'a [f64],
        (at, direction): (f64, f64),
        start: &InitialGuess<'_>,
    ) -> Self {
        let mut tracer = Self {
            cx: *cx,
            state,
            point,
            rates,
            direction,
            q: vec![0.0; rates.len()],
            knots: Vec::new(),
            changes: Vec::new(),
            start_signs: cx.signs.to_vec(),
            unknowns: cx.plan.groups().flat_map(|group| group.unknowns.clone()).collect(),
            last_group: cx.plan.steps.iter().rposition(|step| matches!(step, Step::Group(_))),
            initial: start.taylor.to_vec(),
            ended: false,
        };
        let knot = tracer.solve_knot(at, start.angles);
        tracer.ended = tracer.last_group.is_some() && knot.taylor.is_empty();
        tracer.knots.push(knot);
        tracer
    }

    /// The dyads with a sign, in order, each with its step of the plan.
    pub(crate) fn dyads(&self) -> impl Iterator<Item = (usize, &'b Dyad)> + use<'b> {
        self.cx.plan.steps.iter().enumerate().filter_map(|(index, step)| match step {
            Step::Dyad(dyad) if dyad.sign.is_some() => Some((index, dyad)),
            _ => None,
        })
    }

    /// Signs at a parameter, after the change points before it.
    pub(crate) fn signs_at(&self, at: f64) -> Vec<f64> {
        let mut signs = self.start_signs.clone();
        for change in self.changes.iter().filter(|c| (at - c.at) * self.direction > 0.0) {
            signs[change.sign] = -signs[change.sign];
        }
        signs
    }

    /// Solves at a parameter; returns whether it can be reached.
    pub(crate) fn visit(&mut self, at: f64) -> bool {
        self.solve(at) == usize::MAX
    }

    /// Solves at a parameter; returns the number of steps solved, `usize::MAX` for all.
    pub(crate) fn solve(&mut self, at: f64) -> usize {
        let signs = self.signs_at(at);
        (self.point)(at, &mut self.q);
        for (index, &unknown) in self.unknowns.iter().enumerate() {
            let value = self.predicted(index, at);
            match unknown {
                Unknown::Class(class) => self.state.pose.class[class][0] = Vector::at_angle(value),
                Unknown::Slide(slide) => self.state.pose.slides[slide * self.state.len][0] = value,
            }
        }
        self.state.solve(&Context { signs: &signs, ..self.cx }, &self.q);
        match (self.state.status, self.state.fault) {
            (Status::BadInput, _) => 0,
            (Status::Unreachable, Some(Fault::NotClosed { step, .. }))
            | (Status::NotConverged, Some(Fault::NotConverged { step })) => step,
            // Redundant links do not count here: beyond a change point they fit only with the sign
            // that is yet to be found.
            _ => usize::MAX,
        }
    }

    /// Rate of a jet along the path, from its first-order entries.
    pub(crate) fn rate_along(&self, first: impl Fn(usize) -> f64) -> f64 {
        self.rates.iter().enumerate().map(|(d, rate)| rate * first(d)).sum()
    }

    /// The knot at `at`, with angles nearest to `from`.
    pub(crate) fn solve_knot(&mut self, at: f64, from: &[f64]) -> Knot {
        let solved = self.solve(at);
        let reached = solved == usize::MAX;
        // Dyads before the step that does not close are still solved.
        let discriminants = self
            .dyads()
            .map(|(step, dyad)| if step < solved { self.discriminant(dyad) } else { (0.0, 0.0) })
            .collect();
        if !reached {
            let rates = vec![0.0; from.len()];
            let open_step = match self.state.fault {
                Some(Fault::NotClosed { step, gap }) => Some((step, gap)),
                _ => None,
            };
            let (angles, guide_sides) = (from.to_vec(), self.guide_sides(solved));
            let open_dyad = self.dyads().find(|&(step, _)| step == solved).map(|(_, dyad)| dyad);
            let open_square = open_dyad.and_then(|dyad| self.open_square(dyad));
            let open_side =
                open_dyad.is_some_and(|dyad| self.state.flat_side(0, &self.cx, dyad) > 0.0);
            let (taylor, det_signs) = self.group_unknowns(at, solved);
            return Knot {
                at,
                reached,
                angles,
                rates,
                discriminants,
                guide_sides,
                open_step,
                open_square,
                open_side,
                solved,
                taylor,
                det_signs,
            };
        }
        let angles = self
            .state
            .pose
            .class
            .iter()
            .zip(from)
            .map(|(u, &near)| unwrap_to(u[0].angle(), near))
            .collect();
        let len = self.state.len;
        let rates = (0..from.len())
            .map(|c| self.rate_along(|d| self.state.pose.theta[c * len + 1 + d][0]).abs())
            .collect();
        let guide_sides = self.guide_sides(solved);
        let (taylor, det_signs) = self.group_unknowns(at, solved);
        Knot {
            at,
            reached,
            angles,
            rates,
            discriminants,
            guide_sides,
            open_step: None,
            open_square: None,
            open_side: false,
            solved,
            taylor,
            det_signs,
        }
    }

    /// See [`Knot::guide_sides`], of the first `solved` steps.
    fn guide_sides(&self, solved: usize) -> Vec<bool> {
        let steps = self.cx.plan.steps.iter().take(solved);
        let lines = steps.filter_map(|step| match step {
            Step::Dyad(dyad) if dyad.form == Form::TwoLines => Some(dyad),
            _ => None,
        });
        lines.map(|dyad| self.state.determinant(0, &self.cx, dyad) > 0.0).collect()
    }

    /// Square of the discriminant of a dyad that does not close at the position just solved, and its rate
    /// along the path; `None` with several drivers.
    fn open_square(&self, dyad: &Dyad) -> Option<(f64, f64)> {
        let &[rate] = self.rates else { return None };
        let op = &self.cx.tape.ops[self.cx.tape.dyads[dyad.index]];
        let sample = self.state.sample(0, &self.cx, dyad, op);
        Some((sample.square, sample.rate * rate))
    }

    /// An unknown of a group at a parameter, predicted from the last knot.
    fn predicted(&self, index: usize, at: f64) -> f64 {
        match self.knots.last() {
            Some(knot) => predict(&knot.taylor[index], at - knot.at),
            None => self.initial[index][0],
        }
    }

    /// Unknowns of the groups at the position just solved, and whether each determinant is
    /// positive; empty if a group is folded or not solved.
    fn group_unknowns(&self, at: f64, solved: usize) -> (Vec<Taylor2>, Vec<bool>) {
        let is_group = |step: usize| matches!(self.cx.plan.steps[step], Step::Group(_));
        let folded = matches!(self.state.fault, Some(Fault::Singular { step }) if is_group(step));
        if folded || self.last_group.is_none_or(|step| solved <= step) {
            return (Vec::new(), Vec::new());
        }
        let len = self.state.len;
        let expand = |(index, &unknown): (usize, &Unknown)| {
            let (value, jet) = match unknown {
                Unknown::Class(class) => {
                    let angle = self.state.pose.class[class][0].angle();
                    (
                        unwrap_to(angle, self.predicted(index, at)),
                        &self.state.pose.theta[class * len..],
                    )
                }
                Unknown::Slide(slide) => {
                    let jet = &self.state.pose.slides[slide * len..];
                    (jet[0][0], jet)
                }
            };
            let drivers = self.rates.len();
            let second = self.cx.derivatives.tensor(2);
            let pairs = second.iter().enumerate().map(|(pair, &k)| {
                self.rates[pair / drivers] * self.rates[pair % drivers] * jet[k][0]
            });
            [value, self.rate_along(|driver| jet[1 + driver][0]), pairs.sum()]
        };
        let taylor = self.unknowns.iter().enumerate().map(expand).collect();
        (taylor, self.state.work.determinants.iter().map(|d| d[0] > 0.0).collect())
    }

    /// Whether the groups at the second knot may have left the branch of the first.
    fn prediction_failed(&self, from: &Knot, knot: &Knot) -> bool {
        let Some(step) = self.last_group else { return false };
        if knot.solved <= step || knot.det_signs != from.det_signs {
            // Not solved, on the other side of a fold, or too near to the fold.
            return true;
        }
        let cell = knot.at - from.at;
        from.taylor.iter().zip(&knot.taylor).any(|(a, b)| prediction_failed(a, b, cell))
    }

    /// Whether a group jumps from one branch to another between two knots. If two folds nearly
    /// meet, the branch beyond both continues the one before them, with a determinant of the same
    /// sign.
    fn jumps(&mut self, from: &Knot, knot: &Knot) -> bool {
        if self.last_group.is_none() {
            return false;
        }
        let cell = knot.at - from.at;
        let ends = || from.taylor.iter().zip(&knot.taylor);
        // In the middle of the cell half of a jump shows.
        if ends().all(|(a, b)| prediction_error(a, b, cell) <= 2.0 * JUMP_ROUNDING) {
            return false;
        }
        let middle = self.solve_knot(from.at + 0.5 * cell, &from.angles);
        if middle.det_signs != from.det_signs || middle.taylor.len() != from.taylor.len() {
            return true;
        }
        ends().zip(&middle.taylor).any(|((a, b), actual)| {
            let interpolated = HermiteCell::new(a, Some(b), cell, Vector::ONE).value(0.5 * cell);
            let allowed = (JUMP_RATIO * prediction_error(a, b, cell)).max(JUMP_ROUNDING);
            (interpolated - actual[0]).abs() > allowed
        })
    }

    /// Discriminant of a dyad at the position just solved, and its rate along the path.
    pub(crate) fn discriminant(&self, dyad: &Dyad) -> (f64, f64) {
        let at = |driver: usize| self.state.discriminant(0, &self.cx, dyad, driver + 1);
        (at(0).0, self.rate_along(|driver| at(driver).1))
    }

    /// Sets knots from the last one to `to`, close enough to count turns and to show every change
    /// point.
    pub(crate) fn advance(&mut self, to: f64) {
        let mut ends = vec![(to, 0_u32)];
        while let Some((end, depth)) = ends.pop() {
            self.ended |= self.cx.is_cancelled();
            if self.ended {
                return;
            }
            let Some(from) = self.knots.last().cloned() else { return };
            let mut end = end;
            let mut knot = self.solve_knot(end, &from.angles);
            // A change point is found from knots on both sides, not from a knot at the point.
            for _ in 0..MAX_NUDGES {
                if !knot.is_flat() {
                    break;
                }
                end += NUDGE * (end - from.at);
                knot = self.solve_knot(end, &from.angles);
            }
            while self.detect(&from, &knot) {
                knot = self.solve_knot(end, &from.angles);
            }
            let turns_fast = self.turns_fast(from.at, end);
            let middle = 0.5 * (from.at + end);
            let has_room = self.knots.len() < MAX_KNOTS;
            let can_halve = has_room && middle != from.at && middle != end;
            let prediction_failed = self.prediction_failed(&from, &knot);
            let coarse = depth < KNOT_MAX_HALVINGS
                && (turns_fast || (!prediction_failed && must_refine(&from, &knot, depth)));
            let coarse = coarse || depth < KNOT_MAX_HALVINGS && self.turns_at_edge(&from, &knot);
            let jumps =
                depth >= JUMP_HALVINGS && !prediction_failed && !coarse && self.jumps(&from, &knot);
            let prediction_failed = prediction_failed || jumps;
            if can_halve && (coarse || prediction_failed && depth < FOLD_HALVINGS) {
                // The halves find these change points again.
                self.changes.retain(|c| (c.at - from.at) * self.direction <= 0.0);
                ends.push((end, depth + 1));
                ends.push((middle, depth + 1));
            } else if prediction_failed {
                self.ended = true;
            } else {
                let mut knot = self.unwrap_across_gap(&from, knot);
                self.turn_lengths_round(&from, &mut knot);
                self.knots.push(knot);
            }
        }
    }

    /// Where the joints of a slide whose value is a length have coincided between two knots, it has
    /// turned by half a turn at once, to either side: this counts as counter-clockwise as the parameter
    /// grows.
    fn turn_lengths_round(&self, from: &Knot, knot: &mut Knot) {
        if !(from.reached && knot.reached) {
            return;
        }
        for dyad in self.cx.plan.dyads().filter(|dyad| dyad.is_length) {
            let class = dyad.unknowns[0].class();
            let turn = self.direction * (knot.angles[class] - from.angles[class]);
            if turn < -KNOT_MAX_TURN {
                knot.angles[class] += self.direction * TAU;
            }
        }
    }

    /// The last parameter that can be reached, between one that can be and one that cannot.
    pub(crate) fn find_edge(&mut self, inside_and_outside: [f64; 2]) -> f64 {
        let is_inside = |at: f64| Ok::<_, Infallible>(self.visit(at));
        let Ok([inside, _]) = bisect(inside_and_outside, TO_ROUNDING, is_inside);
        inside
    }

    /// Unwraps the angles of a knot at the very edge of the gap between it and the knot before.
    /// With several drivers every position has its own branch and knots: an angle that differs
    /// by about half a turn across a gap would otherwise be unwrapped to either side. With one, knots
    /// in lanes would decide otherwise.
    fn unwrap_across_gap(&mut self, from: &Knot, mut knot: Knot) -> Knot {
        if from.reached == knot.reached {
            return knot;
        }
        if self.rates.len() > 1 {
            let ends = if from.reached { [from.at, knot.at] } else { [knot.at, from.at] };
            let edge = self.angles_at_edge(ends, &from.angles);
            knot.angles = if knot.reached { unwrapped(&knot.angles, &edge) } else { edge };
        } else if knot.reached && self.is_ambiguous(&from.angles, &knot.angles) {
            let before = self.knots.iter().rposition(|knot| knot.reached);
            let near = before.map_or_else(|| from.angles.clone(), |last| self.angles_after(last));
            let edge = self.angles_at_edge([knot.at, from.at], &near);
            knot.angles = unwrapped(&knot.angles, &edge);
        }
        knot
    }

    /// Whether some link turns far between the edge of the gap between two knots and the one that can be
    /// reached. If the outer joints of a dyad nearly coincide at the edge, it may turn by half a turn
    /// within any distance.
    fn turns_at_edge(&mut self, from: &Knot, knot: &Knot) -> bool {
        if from.reached == knot.reached || self.last_group.is_some() {
            return false;
        }
        let [inside, outside] = if from.reached { [from, knot] } else { [knot, from] };
        let edge = self.angles_at_edge([inside.at, outside.at], &inside.angles);
        inside.angles.iter().zip(&edge).any(|(angle, edge)| (edge - angle).abs() > KNOT_MAX_TURN)
    }

    /// Whether some angle differs so much across a gap that the knots beside it may not show the shorter way.
    /// (Angles of groups are followed from knot to knot.)
    fn is_ambiguous(&self, before: &[f64], behind: &[f64]) -> bool {
        let mut steps = before.iter().zip(behind).map(|(a, b)| (b - a).abs());
        self.last_group.is_none() && steps.any(|step| step > MAX_KNOWN_STEP)
    }

    /// The angles at the edge of a gap, given a parameter that can be reached and one that cannot.
    fn angles_at_edge(&mut self, inside_and_outside: [f64; 2], near: &[f64]) -> Vec<f64> {
        let edge = self.find_edge(inside_and_outside);
        if !self.visit(edge) {
            return near.to_vec();
        }
        let angles: Vec<f64> = self.state.pose.class.iter().map(|u| u[0].angle()).collect();
        unwrapped(&angles, near)
    }

    /// The angles at the edge of the gap behind a knot.
    fn angles_after(&mut self, knot: usize) -> Vec<f64> {
        let near = self.knots[knot].angles.clone();
        match self.knots.get(knot + 1) {
            Some(next) => self.angles_at_edge([self.knots[knot].at, next.at], &near),
            None => near,
        }
    }

    /// The change of every angle over all knots, after which these are the first again: whole turns, the
    /// nearest, across a gap at their end too.
    pub(crate) fn gain(&mut self) -> Vec<f64> {
        let reached = |knot: &Knot| knot.reached;
        let ends = [self.knots.iter().position(reached), self.knots.iter().rposition(reached)];
        let [Some(first), Some(last)] = ends else { return vec![0.0; self.state.pose.class.len()] };
        let mut a = self.knots[first].angles.clone();
        let mut b = self.knots[last].angles.clone();
        let next = unwrapped(&a, &b);
        if first > 0 && self.is_ambiguous(&b, &next) {
            a = self.angles_at_edge([self.knots[first].at, self.knots[first - 1].at], &a);
            b = self.angles_after(last);
        }
        a.iter().zip(&b).map(|(&a, &b)| TAU * whole_turns(b - a)).collect()
    }

    /// Whether a link turns fast beside a change point between two parameters. If the outer joints
    /// of a dyad nearly coincide, it may turn round within much less than the cell and stand at
    /// both ends as before.
    fn turns_fast(&mut self, from: f64, end: f64) -> bool {
        let within = |c: &&ChangePoint| {
            (c.at - from) * self.direction > 0.0 && (end - c.at) * self.direction > 0.0
        };
        let changes: Vec<f64> = self.changes.iter().filter(within).map(|c| c.at).collect();
        changes.into_iter().any(|change| {
            let reaches = PROBES.iter().map(|part| part * (end - from).abs());
            let probes = reaches.filter(|&reach| reach > MIN_PROBE).flat_map(|r| [-r, r]);
            probes.map(|reach| change + reach).any(|at| {
                let len = self.state.len;
                self.visit(at)
                    && (0..self.state.pose.class.len()).any(|c| {
                        let rate = self.rate_along(|d| self.state.pose.theta[c * len + 1 + d][0]);
                        (rate * (end - from)).abs() > KNOT_MAX_TURN
                    })
            })
        })
    }

    /// Whether the last knot, some turns on, repeats the first.
    pub(crate) fn has_returned(&self) -> bool {
        let [Some(first), Some(last)] = [self.knots.first(), self.knots.last()] else {
            return false;
        };
        let mut pairs = self.unknowns.iter().zip(first.taylor.iter().zip(&last.taylor));
        let same = pairs.all(|(&unknown, (a, b))| closes(unknown, a[0], b[0]));
        same && self.signs_at(f64::INFINITY) == self.start_signs
    }

    /// Signs between the change points, for growing parameters.
    pub(crate) fn sign_intervals(&self) -> Vec<SignInterval> {
        let mut signs = self.start_signs.clone();
        let mut sign_intervals =
            vec![SignInterval { from: f64::NEG_INFINITY, signs: signs.clone() }];
        for change in &self.changes {
            signs[change.sign] = -signs[change.sign];
            sign_intervals.push(SignInterval { from: change.at, signs: signs.clone() });
        }
        sign_intervals
    }
}

/// Angles, each next to another.
fn unwrapped(angles: &[f64], near: &[f64]) -> Vec<f64> {
    angles.iter().zip(near).map(|(&angle, &near)| unwrap_to(angle, near)).collect()
}
