//! Walking from the drawing: knots close enough together to see every change point
//! and to tell every angle.

use super::hermite::HermiteCell;
use super::knot::{
    ChangePoint, InitialGuess, Knot, SignInterval, Taylor2, apart, foretell, may_touch, returns,
    strays,
};
use crate::math::angle::unwrap_to;
use crate::math::tolerance::{KNOT_MAX_HALVINGS, KNOT_MAX_TURN};
use crate::math::vector::Vector;
use crate::plan::dyad::{Dyad, Form, Unknown};
use crate::plan::plan::Step;
use crate::state::state::{Context, State};
use crate::state::status::{Fault, Status};

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
/// Part of a cell by which a knot that falls on a flat dyad is put off.
const NUDGE: f64 = 0.0625;
/// How often: change points of several dyads seldom follow so closely.
const NUDGES: u32 = 4;
/// How near to a change point (rad, or units of the scale) rates are more than rounding:
/// 64 u κ² of them are, κ about 1/distance.
const LEAST_PROBE: f64 = 1.0 / 1048576.0;
/// How near to a change point, in cells, it is looked for a link that swings.
const PROBES: [f64; 3] = [1.0 / 128.0, 1.0 / 16384.0, 1.0 / 1048576.0];

/// Halvings toward the place where a group folds: down to the spacing of q.
const FOLD_HALVINGS: u32 = 52;
/// Halvings from which on a cell is looked at in its middle. Beside two folds close together an unknown
/// goes with the cube root of q, which coarser cells do not follow.
const LEAP_HALVINGS: u32 = 4;
/// What an unknown in the middle of a cell may be off Hermite's polynomial: as a part of how far the
/// ends are from each other's Taylor polynomials (half of it, were it a leap) …
const LEAP: f64 = 1.0 / 64.0;
/// … and the rounding beside two folds that meet, ∛u and a margin.
const LEAP_ROUNDING: f64 = 1.0 / 65536.0;

/// Walks along a path and lays knots.
pub(crate) struct BranchTracer<'a, 'b> {
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
    pub changes: Vec<ChangePoint>,
    pub start_signs: Vec<f64>,
    /// Unknowns of the groups, in order, and the step of the last group.
    unknowns: Vec<Unknown>,
    last_group: Option<usize>,
    /// Their values where the way begins.
    first: Vec<Taylor2>,
    /// Whether the way has ended: beyond is a fold of a group, or what it hangs on is open.
    pub ended: bool,
}

impl<'a, 'b> BranchTracer<'a, 'b> {
    pub(crate) fn new(
        cx: &Context<'b>,
        state: &'a mut State,
        point: &'a dyn Fn(f64, &mut [f64]),
        rates: &'a [f64],
        (at, way): (f64, f64),
        start: &InitialGuess<'_>,
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
            unknowns: cx.plan.groups().flat_map(|group| group.unknowns.clone()).collect(),
            last_group: cx.plan.steps.iter().rposition(|step| matches!(step, Step::Group(_))),
            first: start.seeds.to_vec(),
            ended: false,
        };
        let knot = walker.knot(at, start.angles);
        walker.ended = walker.last_group.is_some() && knot.seeds.is_empty();
        walker.knots.push(knot);
        walker
    }

    /// The dyads with a sign, in order, each with its step of the plan.
    pub(crate) fn dyads(&self) -> impl Iterator<Item = (usize, &'b Dyad)> + use<'b> {
        self.cx.plan.steps.iter().enumerate().filter_map(|(index, step)| match step {
            Step::Dyad(dyad) if dyad.sign.is_some() => Some((index, dyad)),
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
        self.solve(at) == usize::MAX
    }

    /// Solves at a parameter; how many steps could be.
    pub(crate) fn solve(&mut self, at: f64) -> usize {
        let signs = self.signs_at(at);
        (self.point)(at, &mut self.q);
        for (place, &unknown) in self.unknowns.iter().enumerate() {
            let value = self.foretold(place, at);
            match unknown {
                Unknown::Class(class) => self.state.class[class][0] = Vector::at_angle(value),
                Unknown::Slide(slide) => self.state.slides[slide * self.state.len][0] = value,
            }
        }
        self.state.solve(&Context { signs: &signs, ..self.cx }, &self.q);
        match (self.state.status, self.state.fault) {
            (Status::BadInput, _) => 0,
            (Status::Unreachable, Some(Fault::NotClosed { step, .. }))
            | (Status::NotConverged, Some(Fault::NotConverged { step })) => step,
            // A redundant link that does not fit is no matter of the way: beyond a change
            // point it fits only with the sign that is yet to be found.
            _ => usize::MAX,
        }
    }

    /// Rate of a jet along the path, from its first-order entries.
    pub(crate) fn along(&self, first: impl Fn(usize) -> f64) -> f64 {
        self.rates.iter().enumerate().map(|(d, rate)| rate * first(d)).sum()
    }

    /// The knot at `at`, its angles nearest to those of `from`.
    pub(crate) fn knot(&mut self, at: f64, from: &[f64]) -> Knot {
        let solved = self.solve(at);
        let reached = solved == usize::MAX;
        // Before the step that does not close all is as if it did.
        let spread = self
            .dyads()
            .map(|(step, dyad)| if step < solved { self.spread(dyad) } else { (0.0, 0.0) })
            .collect();
        if !reached {
            let rates = vec![0.0; from.len()];
            let open = match self.state.fault {
                Some(Fault::NotClosed { step, gap }) => Some((step, gap)),
                _ => None,
            };
            let (angles, sides) = (from.to_vec(), Vec::new());
            let (seeds, bends) = self.seeds(at, solved);
            return Knot { at, reached, angles, rates, spread, sides, open, solved, seeds, bends };
        }
        let angles = self
            .state
            .class
            .iter()
            .zip(from)
            .map(|(u, &near)| unwrap_to(u[0].angle(), near))
            .collect();
        let len = self.state.len;
        let rates = (0..from.len())
            .map(|c| self.along(|d| self.state.theta[c * len + 1 + d][0]).abs())
            .collect();
        let lines = self.cx.plan.dyads().filter(|dyad| dyad.form == Form::TwoLines);
        let sides = lines.map(|dyad| self.state.determinant(0, &self.cx, dyad) > 0.0).collect();
        let (seeds, bends) = self.seeds(at, solved);
        Knot { at, reached, angles, rates, spread, sides, open: None, solved, seeds, bends }
    }

    /// An unknown of a group at a parameter, by its Taylor polynomial at the last knot.
    fn foretold(&self, place: usize, at: f64) -> f64 {
        match self.knots.last() {
            Some(knot) => foretell(&knot.seeds[place], at - knot.at),
            None => self.first[place][0],
        }
    }

    /// Unknowns of the groups at the position just visited, and signs of the determinants; nothing
    /// where a group cannot be told from a folded one.
    fn seeds(&self, at: f64, solved: usize) -> (Vec<Taylor2>, Vec<bool>) {
        let is_group = |step: usize| matches!(self.cx.plan.steps[step], Step::Group(_));
        let folded = matches!(self.state.fault, Some(Fault::Singular { step }) if is_group(step));
        if folded || self.last_group.is_none_or(|step| solved <= step) {
            return (Vec::new(), Vec::new());
        }
        let len = self.state.len;
        let seed = |(place, &unknown): (usize, &Unknown)| {
            let (value, jet) = match unknown {
                Unknown::Class(class) => {
                    let angle = self.state.class[class][0].angle();
                    (unwrap_to(angle, self.foretold(place, at)), &self.state.theta[class * len..])
                }
                Unknown::Slide(slide) => {
                    let jet = &self.state.slides[slide * len..];
                    (jet[0][0], jet)
                }
            };
            let drivers = self.rates.len();
            let second = self.cx.jets.tensor(2);
            let pairs = second.iter().enumerate().map(|(pair, &k)| {
                self.rates[pair / drivers] * self.rates[pair % drivers] * jet[k][0]
            });
            [value, self.along(|driver| jet[1 + driver][0]), pairs.sum()]
        };
        let seeds = self.unknowns.iter().enumerate().map(seed).collect();
        (seeds, self.state.determinants.iter().map(|d| d[0] > 0.0).collect())
    }

    /// Whether the groups at the second knot are not surely where the way from the first leads.
    fn strays(&self, from: &Knot, knot: &Knot) -> bool {
        let Some(step) = self.last_group else { return false };
        if knot.solved <= step || knot.bends != from.bends {
            // Not there, another side of the fold, or too near to it.
            return true;
        }
        let cell = knot.at - from.at;
        from.seeds.iter().zip(&knot.seeds).any(|(a, b)| strays(a, b, cell))
    }

    /// Whether a group leaps from one branch to another between two knots: where two folds nearly
    /// meet, the branch behind both continues the one before, and the determinant has its old sign.
    fn leaps(&mut self, from: &Knot, knot: &Knot) -> bool {
        if self.last_group.is_none() {
            return false;
        }
        let cell = knot.at - from.at;
        let ends = || from.seeds.iter().zip(&knot.seeds);
        // A leap shows as half of itself in the middle.
        if ends().all(|(a, b)| apart(a, b, cell) <= 2.0 * LEAP_ROUNDING) {
            return false;
        }
        let middle = self.knot(from.at + 0.5 * cell, &from.angles);
        if middle.bends != from.bends || middle.seeds.len() != from.seeds.len() {
            return true;
        }
        ends().zip(&middle.seeds).any(|((a, b), there)| {
            let between = HermiteCell::new(a, Some(b), cell, Vector::ONE).at(0.5 * cell);
            let allowed = (LEAP * apart(a, b, cell)).max(LEAP_ROUNDING);
            (between - there[0]).abs() > allowed
        })
    }

    /// Spread of a dyad at the position just visited, and its rate along the path.
    pub(crate) fn spread(&self, dyad: &Dyad) -> (f64, f64) {
        let at = |driver: usize| self.state.spread(0, &self.cx, dyad, driver + 1);
        (at(0).0, self.along(|driver| at(driver).1))
    }

    /// Lays knots from the last one to `to`, close enough to tell the angles and
    /// to see every change point.
    pub(crate) fn advance(&mut self, to: f64) {
        let mut ends = vec![(to, 0_u32)];
        while let Some((end, depth)) = ends.pop() {
            if self.ended {
                return;
            }
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
            while self.pass(&from, &knot) {
                knot = self.knot(end, &from.angles);
            }
            let swings = self.swings(from.at, end);
            let middle = 0.5 * (from.at + end);
            let room = self.knots.len() < MOST_KNOTS;
            let can_halve = room && middle != from.at && middle != end;
            let strays = self.strays(&from, &knot);
            let coarse =
                depth < KNOT_MAX_HALVINGS && (swings || (!strays && too_far(&from, &knot, depth)));
            let leaps = depth >= LEAP_HALVINGS && !strays && !coarse && self.leaps(&from, &knot);
            let strays = strays || leaps;
            if can_halve && (coarse || strays && depth < FOLD_HALVINGS) {
                // The halves find what was found on the whole again.
                self.changes.retain(|c| (c.at - from.at) * self.way <= 0.0);
                ends.push((end, depth + 1));
                ends.push((middle, depth + 1));
            } else if strays {
                self.ended = true;
            } else {
                let knot = self.lifted(&from, knot);
                self.knots.push(knot);
            }
        }
    }

    /// The last parameter that is reached between one that is and one that is not.
    pub(crate) fn edge(&mut self, [mut inside, mut outside]: [f64; 2]) -> f64 {
        loop {
            let middle = 0.5 * (inside + outside);
            if middle == inside || middle == outside {
                return inside;
            }
            if self.visit(middle) { inside = middle } else { outside = middle }
        }
    }

    /// A knot with its angles lifted at the very edge of a gap between the one before and it: of
    /// several drivers every position has a way and knots of its own, and angles that differ by
    /// about half a turn across a gap would be lifted now this way, now that.
    fn lifted(&mut self, from: &Knot, mut knot: Knot) -> Knot {
        if self.rates.len() == 1 || from.reached == knot.reached {
            return knot;
        }
        let ends = if from.reached { [from.at, knot.at] } else { [knot.at, from.at] };
        let edge = self.edge(ends);
        if !self.visit(edge) {
            return knot;
        }
        let classes = self.state.class.iter().zip(&from.angles);
        let edge: Vec<f64> = classes.map(|(u, &near)| unwrap_to(u[0].angle(), near)).collect();
        if knot.reached {
            let pairs = knot.angles.iter().zip(&edge);
            knot.angles = pairs.map(|(&angle, &near)| unwrap_to(angle, near)).collect();
        } else {
            knot.angles = edge;
        }
        knot
    }

    /// Whether a link turns fast beside a change point between two parameters: where the
    /// outer joints of a dyad nearly coincide it may swing round within much less than
    /// the cell, and stand as before at both ends.
    fn swings(&mut self, from: f64, end: f64) -> bool {
        let within =
            |c: &&ChangePoint| (c.at - from) * self.way > 0.0 && (end - c.at) * self.way > 0.0;
        let changes: Vec<f64> = self.changes.iter().filter(within).map(|c| c.at).collect();
        changes.into_iter().any(|change| {
            let reaches = PROBES.iter().map(|part| part * (end - from).abs());
            let probes = reaches.filter(|&reach| reach > LEAST_PROBE).flat_map(|r| [-r, r]);
            probes.map(|reach| change + reach).any(|at| {
                let len = self.state.len;
                self.visit(at)
                    && (0..self.state.class.len()).any(|c| {
                        let rate = self.along(|d| self.state.theta[c * len + 1 + d][0]);
                        (rate * (end - from)).abs() > KNOT_MAX_TURN
                    })
            })
        })
    }

    /// Whether the last knot, some turns on, is the first again.
    pub(crate) fn has_returned(&self) -> bool {
        let [Some(first), Some(last)] = [self.knots.first(), self.knots.last()] else {
            return false;
        };
        let mut pairs = self.unknowns.iter().zip(first.seeds.iter().zip(&last.seeds));
        let same = pairs.all(|(&unknown, (a, b))| returns(unknown, a, b));
        same && self.signs_at(f64::INFINITY) == self.start_signs
    }

    /// Signs between the changes, in the direction of growing parameter.
    pub(crate) fn stretches(&self) -> Vec<SignInterval> {
        let mut signs = self.start_signs.clone();
        let mut stretches = vec![SignInterval { from: f64::NEG_INFINITY, signs: signs.clone() }];
        for change in &self.changes {
            signs[change.sign] = -signs[change.sign];
            stretches.push(SignInterval { from: change.at, signs: signs.clone() });
        }
        stretches
    }
}

fn too_far(a: &Knot, b: &Knot, depth: u32) -> bool {
    if a.reached != b.reached {
        return depth < EDGE_HALVINGS;
    }
    let cell = (b.at - a.at).abs();
    if !a.reached {
        return may_hide_island(a, b, cell, depth);
    }
    let turned = a.angles.iter().zip(&b.angles).any(|(x, y)| (x - y).abs() > KNOT_MAX_TURN);
    // Near a dead point rates grow without bound while the angle does not.
    let fast = depth < EDGE_HALVINGS
        && a.rates.iter().chain(&b.rates).any(|rate| rate * cell > KNOT_MAX_TURN);
    let through_infinity = depth < EDGE_HALVINGS && a.sides != b.sides;
    // Beside a near miss of a change point a link may swing round between the knots.
    let missed = || a.spread.iter().zip(&b.spread).any(|(&x, &y)| may_touch(x, y, b.at - a.at));
    turned || fast || through_infinity || missed()
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
