//! The way from the drawing: signs that change at change points, angles followed
//! continuously.
//!
//! At a change point a dyad with two solutions is flat and both solutions meet;
//! the smooth motion goes from one to the other, so its sign changes there. An
//! angle is known up to whole turns. Both are found along the straight path of q
//! from the drawing, on knots that depend on the design alone: equal cells, halved
//! where a link turns fast. So neither depends on which positions are asked for.

use std::f64::consts::TAU;

use super::change::{self, Change};
use super::state::{Context, Fault, State, Status};
use crate::plan::{Dyad, Form, Step};
use crate::tolerance::{LIFT_HALVINGS, LIFT_TURN};

/// Cells in a turn of a driven angle.
const CELLS_A_TURN: u32 = 32;
/// Cells in the unit of length for a driven slide.
const CELLS_A_LENGTH: f64 = 16.0;
/// Halvings where a stretch that can be reached begins or ends: what is left of
/// the turn there goes with the square root of the cell.
const EDGE_HALVINGS: u32 = 14;
/// How fast (of the size, by unit of the path) the gap of a dyad that does not close
/// may shrink; between two knots where it is greater no island is looked for.
const ISLAND_RATE: f64 = 8.0;
/// Halvings in search of an island: down to a tenth of a degree.
const ISLAND_HALVINGS: u32 = 7;
/// The same where different dyads do not close at the two ends.
const UNLIKE_HALVINGS: u32 = 4;
/// Knots after which cells are no longer halved: where angles are nothing but
/// rounding (a link of 1e-17 of the size) no cell would ever be fine enough.
const MOST_KNOTS: usize = 100_000;
/// Steps of a cell in which an island that no knot has seen is measured.
const ISLAND_STEPS: f64 = 1024.0;
/// Part of a cell by which a knot that falls on a flat dyad is put off, and how
/// often: change points of several dyads seldom follow so closely.
const NUDGE: f64 = 0.0625;
const NUDGES: u32 = 4;
/// Turns after which the signs have returned, at the latest; a kite needs two.
const MOST_TURNS: u32 = 64;

/// One point of the path.
#[derive(Debug, Clone)]
pub(crate) struct Knot {
    pub at: f64,
    pub reached: bool,
    /// Lifted angle of every class; where not reached, that of the last knot that was.
    angles: Vec<f64>,
    /// Rate of every class along the path.
    rates: Vec<f64>,
    /// Spread of every dyad with a sign, and its rate along the path.
    pub spread: Vec<(f64, f64)>,
    /// On which side of parallel the guides of every dyad of two known directions are;
    /// between the sides its point passes through infinity.
    sides: Vec<bool>,
    /// Where not reached: the step that does not close, and by how much.
    open: Option<(usize, f64)>,
}

/// Signs on one stretch of the path, from its beginning on.
#[derive(Debug, Clone)]
struct Stretch {
    from: f64,
    signs: Vec<f64>,
}

impl Knot {
    fn is_flat(&self) -> bool {
        self.spread.iter().any(|(_, rate)| rate.is_nan())
    }
}

/// Angles and signs along one path.
#[derive(Debug, Clone, Default)]
pub(crate) struct Track {
    knots: Vec<Knot>,
    stretches: Vec<Stretch>,
    changes: Vec<Change>,
    /// Gain of every class over a period.
    gain: Vec<f64>,
    period: Option<f64>,
    /// Where the way is known; none: everywhere.
    covered: Option<[f64; 2]>,
}

/// Walks along a path and lays knots.
pub(crate) struct Walker<'a, 'b> {
    pub cx: Context<'b>,
    pub state: &'a mut State,
    /// Writes q at a parameter.
    point: &'a dyn Fn(f64, &mut [f64]),
    /// Derivatives of q by the parameter (constant: paths are straight).
    rates: &'a [f64],
    /// +1 or −1: the way along the parameter.
    pub way: f64,
    q: Vec<f64>,
    pub knots: Vec<Knot>,
    /// Change points passed, in the order of passing.
    pub changes: Vec<Change>,
    start_signs: Vec<f64>,
}

impl<'a, 'b> Walker<'a, 'b> {
    fn new(
        cx: &Context<'b>,
        state: &'a mut State,
        point: &'a dyn Fn(f64, &mut [f64]),
        rates: &'a [f64],
        (at, way): (f64, f64),
        start: &[f64],
    ) -> Self {
        let mut walker = Self {
            cx: *cx,
            state,
            point,
            rates,
            way,
            q: vec![0.0; rates.len()],
            knots: Vec::new(),
            changes: Vec::new(),
            start_signs: cx.signs.to_vec(),
        };
        let knot = walker.knot(at, start);
        walker.knots.push(knot);
        walker
    }

    /// The dyads with a sign, in order.
    pub(crate) fn dyads(&self) -> impl Iterator<Item = &'b Dyad> + use<'b> {
        self.cx.plan.steps.iter().filter_map(|step| match step {
            Step::Dyad(dyad) if dyad.sign.is_some() => Some(dyad),
            _ => None,
        })
    }

    /// Signs at a parameter, after the changes on the way there.
    pub(crate) fn signs_at(&self, at: f64) -> Vec<f64> {
        let mut signs = self.start_signs.clone();
        for change in self.changes.iter().filter(|c| (at - c.at) * self.way > 0.0) {
            signs[change.sign] = -signs[change.sign];
        }
        signs
    }

    /// Solves at a parameter; whether it was reached.
    pub(crate) fn visit(&mut self, at: f64) -> bool {
        let signs = self.signs_at(at);
        (self.point)(at, &mut self.q);
        self.state.solve(&Context { signs: &signs, ..self.cx }, &self.q);
        // A redundant link that does not fit is no matter of the way: beyond a change
        // point it fits only with the sign that is yet to be found.
        matches!(self.state.status, Status::Ok | Status::NearSingular | Status::Singular)
            || matches!(self.state.fault, Some(Fault::Misfit { .. }))
    }

    /// Rate of a jet along the path, from its first-order entries.
    pub(crate) fn along(&self, first: impl Fn(usize) -> f64) -> f64 {
        self.rates.iter().enumerate().map(|(d, rate)| rate * first(d)).sum()
    }

    /// The knot at `at`, its angles nearest to those of `from`.
    pub(crate) fn knot(&mut self, at: f64, from: &[f64]) -> Knot {
        let reached = self.visit(at);
        let nothing = vec![(0.0, 0.0); self.start_signs.len()];
        if !reached {
            let rates = vec![0.0; from.len()];
            let open = match self.state.fault {
                Some(Fault::Open { step, gap }) => Some((step, gap)),
                _ => None,
            };
            let (angles, sides) = (from.to_vec(), Vec::new());
            return Knot { at, reached, angles, rates, spread: nothing, sides, open };
        }
        let angles =
            self.state.class.iter().zip(from).map(|(u, &near)| nearest(u.angle(), near)).collect();
        let len = self.state.len;
        let rates = (0..from.len())
            .map(|c| self.along(|d| self.state.theta[c * len + 1 + d]).abs())
            .collect();
        let spread = self.dyads().map(|dyad| self.spread(dyad)).collect();
        let lines = self.cx.plan.steps.iter().filter_map(|step| match step {
            Step::Dyad(dyad) if dyad.form == Form::TwoLines => Some(dyad),
            _ => None,
        });
        let sides = lines.map(|dyad| self.state.determinant(&self.cx, dyad) > 0.0).collect();
        Knot { at, reached, angles, rates, spread, sides, open: None }
    }

    /// Spread of a dyad at the position just visited, and its rate along the path.
    pub(crate) fn spread(&self, dyad: &Dyad) -> (f64, f64) {
        let at = |driver: usize| self.state.spread(&self.cx, dyad, driver + 1);
        (at(0).0, self.along(|driver| at(driver).1))
    }

    /// Lays knots from the last one to `to`, close enough to tell the angles and
    /// to see every change point.
    fn advance(&mut self, to: f64) {
        let mut ends = vec![(to, 0_u32)];
        while let Some((end, depth)) = ends.pop() {
            let Some(from) = self.knots.last().cloned() else { return };
            let mut end = end;
            let mut knot = self.knot(end, &from.angles);
            // A change point shows from both sides, not from where it is.
            for _ in 0..NUDGES {
                if !knot.is_flat() {
                    break;
                }
                end += NUDGE * (end - from.at);
                knot = self.knot(end, &from.angles);
            }
            while change::pass(self, &from, &knot) {
                knot = self.knot(end, &from.angles);
            }
            let middle = 0.5 * (from.at + end);
            let room = self.knots.len() < MOST_KNOTS;
            let can_halve = room && middle != from.at && middle != end;
            if can_halve && depth < LIFT_HALVINGS && too_far(&from, &knot, depth) {
                // The halves find what was found on the whole again.
                self.changes.retain(|c| (c.at - from.at) * self.way <= 0.0);
                ends.push((end, depth + 1));
                ends.push((middle, depth + 1));
            } else {
                self.knots.push(knot);
            }
        }
    }

    /// Signs between the changes, in the direction of growing parameter.
    fn stretches(&self) -> Vec<Stretch> {
        let mut signs = self.start_signs.clone();
        let mut stretches = vec![Stretch { from: f64::NEG_INFINITY, signs: signs.clone() }];
        for change in &self.changes {
            signs[change.sign] = -signs[change.sign];
            stretches.push(Stretch { from: change.at, signs: signs.clone() });
        }
        stretches
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
    if !a.reached {
        return may_hide_island(a, b, cell, depth);
    }
    let turned = a.angles.iter().zip(&b.angles).any(|(x, y)| (x - y).abs() > LIFT_TURN);
    // Near a dead point rates grow without bound while the angle does not.
    let fast =
        depth < EDGE_HALVINGS && a.rates.iter().chain(&b.rates).any(|rate| rate * cell > LIFT_TURN);
    let through_infinity = depth < EDGE_HALVINGS && a.sides != b.sides;
    turned || fast || through_infinity
}

/// Whether a stretch that can be reached may lie between two knots that cannot.
fn may_hide_island(a: &Knot, b: &Knot, cell: f64, depth: u32) -> bool {
    match (a.open, b.open) {
        (Some((i, g)), Some((j, h))) if i == j => {
            depth < ISLAND_HALVINGS && g + h < ISLAND_RATE * cell
        }
        _ => depth < UNLIKE_HALVINGS,
    }
}

impl Track {
    /// Along one driven angle, from `q0` on, for ever.
    pub(crate) fn turning(cx: &Context<'_>, state: &mut State, q0: f64, start: &[f64]) -> Self {
        let point = |at: f64, q: &mut [f64]| q[0] = at;
        let mut walker = Walker::new(cx, state, &point, &[1.0], (q0, 1.0), start);
        let mut turns = 0;
        let mut returned = false;
        while turns < MOST_TURNS && !returned {
            for cell in 1..=CELLS_A_TURN {
                let turned = f64::from(turns) + f64::from(cell) / f64::from(CELLS_A_TURN);
                walker.advance(q0 + TAU * turned);
            }
            turns += 1;
            returned = walker.signs_at(f64::INFINITY) == walker.start_signs;
        }
        let stretches = walker.stretches();
        let Walker { knots, changes, .. } = walker;
        let gain = match (knots.iter().find(|k| k.reached), knots.last()) {
            (Some(first), Some(last)) => {
                let pairs = first.angles.iter().zip(&last.angles);
                pairs.map(|(&a, &b)| TAU * ((b - a) / TAU).round()).collect()
            }
            _ => vec![0.0; start.len()],
        };
        let period = returned.then_some(TAU * f64::from(turns));
        let end = if returned { f64::INFINITY } else { q0 + TAU * f64::from(turns) };
        let covered = [if returned { f64::NEG_INFINITY } else { q0 }, end];
        Self { knots, stretches, changes, gain, period, covered: Some(covered) }
    }

    /// Along one driven slide, from `q0` both ways to `low` and `high`
    /// (not farther than `reach` from `q0`).
    pub(crate) fn sliding(
        cx: &Context<'_>,
        state: &mut State,
        q0: f64,
        [low, high]: [f64; 2],
        reach: f64,
        start: &[f64],
    ) -> Self {
        let point = |at: f64, q: &mut [f64]| q[0] = at;
        let mut track = Self { gain: vec![0.0; start.len()], ..Self::default() };
        for (end, way) in [(low, -1.0), (high, 1.0)] {
            let mut walker = Walker::new(cx, state, &point, &[1.0], (q0, way), start);
            let cells = (((end - q0) * way).min(reach) * CELLS_A_LENGTH).ceil();
            let mut cell = 0.0;
            while cell < cells {
                cell += 1.0;
                walker.advance(q0 + way * cell / CELLS_A_LENGTH);
            }
            let mut stretches = walker.stretches();
            let Walker { mut knots, mut changes, .. } = walker;
            if way < 0.0 {
                knots.reverse();
                knots.pop();
                changes.reverse();
                // Downward a stretch begins where the next change is.
                for i in 0..stretches.len() {
                    stretches[i].from = stretches.get(i + 1).map_or(f64::NEG_INFINITY, |s| s.from);
                }
                stretches.reverse();
                // The last of them, around q0, is the first of the way up.
                if let (Some(around), true) = (stretches.pop(), track.stretches.is_empty()) {
                    track.stretches = stretches;
                    track.stretches.push(around);
                }
            } else {
                track.stretches.extend(stretches.into_iter().skip(1));
            }
            track.knots.append(&mut knots);
            track.changes.append(&mut changes);
        }
        track
    }

    /// Straight from the drawing to one point of several coordinates.
    pub(crate) fn straight(
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
        let longest = rates.iter().fold(0.0_f64, |m, r| m.max(r.abs()));
        let cells = (longest * CELLS_A_LENGTH).ceil().clamp(1.0, 1e6);
        let mut walker = Walker::new(cx, state, &point, &rates, (0.0, 1.0), start);
        let mut cell = 0.0;
        while cell < cells {
            cell += 1.0;
            walker.advance(cell / cells);
            // Only the end is asked for.
            walker.knots.drain(..walker.knots.len() - 1);
        }
        let stretches = walker.stretches();
        let Walker { knots, changes, .. } = walker;
        Self {
            knots,
            stretches,
            changes,
            gain: vec![0.0; start.len()],
            period: None,
            covered: None,
        }
    }

    /// The parameter within the first period, and whole periods before it.
    fn reduced(&self, at: f64) -> (f64, f64) {
        match (self.knots.first(), self.period) {
            (Some(first), Some(period)) => {
                let whole = ((at - first.at) / period).floor();
                (at - whole * period, whole)
            }
            _ => (at, 0.0),
        }
    }

    /// Whether the way to a parameter is known.
    pub(crate) fn covers(&self, at: f64) -> bool {
        self.covered.is_none_or(|[low, high]| (low..=high).contains(&at))
    }

    /// The assembly signs at a parameter.
    pub(crate) fn signs(&self, at: f64) -> &[f64] {
        let (place, _) = self.reduced(at);
        let after = self.stretches.partition_point(|s| s.from <= place);
        self.stretches.get(after.saturating_sub(1)).map_or(&[], |s| &s.signs)
    }

    /// The change point nearest to a parameter, if within `reach` of it.
    pub(crate) fn change_near(&self, at: f64, reach: f64) -> Option<f64> {
        let (place, whole) = self.reduced(at);
        let shift = whole * self.period.unwrap_or(0.0);
        let period = self.period.unwrap_or(0.0);
        let images = |c: &Change| [c.at, c.at - period, c.at + period];
        let nearest = self
            .changes
            .iter()
            .flat_map(images)
            .min_by(|a, b| (a - place).abs().total_cmp(&(b - place).abs()))?;
        ((nearest - place).abs() <= reach).then_some(nearest + shift)
    }

    /// The knots on both sides of a place.
    fn around(&self, place: f64) -> (Option<&Knot>, Option<&Knot>) {
        let after = self.knots.partition_point(|k| k.at <= place);
        (after.checked_sub(1).and_then(|i| self.knots.get(i)), self.knots.get(after))
    }

    /// Whether a parameter lies on an island that no knot has seen.
    pub(crate) fn hides(&self, at: f64) -> bool {
        match self.around(self.reduced(at).0) {
            (Some(left), Some(right)) => !left.reached && !right.reached,
            _ => false,
        }
    }

    /// The way along such an island, from its lower end to the parameter.
    pub(crate) fn island(&self, cx: &Context<'_>, state: &mut State, at: f64) -> Self {
        let (place, whole) = self.reduced(at);
        let (Some(left), Some(right)) = self.around(place) else { return Self::default() };
        let cx = Context { signs: self.signs(at), ..*cx };
        let point = |at: f64, q: &mut [f64]| q[0] = at;
        let mut walker = Walker::new(&cx, state, &point, &[1.0], (place, 1.0), &left.angles);
        let step = (right.at - left.at) / ISLAND_STEPS;
        let (mut inside, mut outside) = (place, left.at);
        while inside - step > left.at {
            if !walker.visit(inside - step) {
                outside = inside - step;
                break;
            }
            inside -= step;
        }
        loop {
            let middle = 0.5 * (inside + outside);
            if middle == inside || middle == outside {
                break;
            }
            if walker.visit(middle) { inside = middle } else { outside = middle }
        }
        let mut walker = Walker::new(&cx, state, &point, &[1.0], (inside, 1.0), &left.angles);
        walker.advance(place);
        let Walker { mut knots, .. } = walker;
        for knot in &mut knots {
            knot.at += at - place;
            for (angle, gain) in knot.angles.iter_mut().zip(&self.gain) {
                *angle += whole * gain;
            }
        }
        Self { knots, gain: self.gain.clone(), ..Self::default() }
    }

    /// The angle of a class at a parameter, given its value up to whole turns.
    pub(crate) fn angle(&self, at: f64, class: usize, principal: f64) -> f64 {
        let Some(first) = self.knots.first() else { return principal };
        let (place, whole) = self.reduced(at);
        let (left, right) = self.around(place);
        let left = left.unwrap_or(first);
        let knot = match right {
            Some(right) if !left.reached && right.reached => right,
            _ => left,
        };
        let gain = if whole == 0.0 { 0.0 } else { whole * self.gain[class] };
        nearest(principal, knot.angles[class] + gain)
    }
}
