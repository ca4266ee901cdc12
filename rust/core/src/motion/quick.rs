//! The way of a driven angle where nothing happens, eight knots at a time: no dead
//! point, no change point, no link that turns fast. Whatever is else is left to the
//! walk; both lay the same knots.

use std::f64::consts::TAU;

use super::change::may_touch;
use super::state::{Context, State};
use super::track::{CELLS_A_TURN, Track, nearest};
use super::walk::Stretch;
use crate::lanes::{Lanes, Mask, Real};
use crate::plan::jet::Jets;
use crate::plan::{Form, Plan};
use crate::plane::Vector;
use crate::tolerance::LIFT_TURN;

/// Knots of a turn, its end included.
const KNOTS: usize = CELLS_A_TURN as usize + 1;
/// One cell.
const CELL: f64 = TAU / CELLS_A_TURN as f64;

/// Work space: for every knot what the walk asks of it.
#[derive(Debug)]
pub(crate) struct Quick {
    state: State<Lanes>,
    /// Drawing's angle that the knots below are for, the same for all designs.
    q0: f64,
    /// Angles of the driver, eight a group, and their unit vectors.
    knots: Vec<(Lanes, Vector<Lanes>)>,
    signs: Vec<Lanes>,
    /// Spread and rate of every dyad with a sign at the last knot.
    spread: Vec<(f64, f64)>,
    /// The same of eight knots.
    spreads: Vec<(Lanes, Lanes)>,
    /// Angles of classes at eight knots.
    angles: Vec<Lanes>,
    /// On which side of parallel the guides of every dyad of two known directions are, at
    /// the knots before.
    sides: Vec<bool>,
}

impl Quick {
    /// Work space for a plan; `jets` are of order 1 in one driver.
    pub(crate) fn new(plan: &Plan, jets: &Jets) -> Self {
        Self {
            state: State::new(plan, jets),
            q0: f64::NAN,
            knots: Vec::new(),
            signs: Vec::new(),
            spread: vec![(0.0, 0.0); plan.signs()],
            spreads: vec![(Lanes::ZERO, Lanes::ZERO); plan.signs()],
            angles: vec![Lanes::ZERO; plan.classes],
            sides: Vec::new(),
        }
    }

    /// Lays the knots of a turn from `q0` on into `track`; false if the way needs
    /// walking.
    #[inline(always)]
    pub(crate) fn turn(
        &mut self,
        cx: &Context<'_>,
        q0: f64,
        start: &[f64],
        track: &mut Track,
    ) -> bool {
        self.signs.clear();
        self.signs.extend(cx.signs.iter().map(|&s| Lanes::splat(s)));
        self.state.prepare(cx.plan, cx.bound, cx.jets);
        self.sides.clear();
        track.at.clear();
        track.angles.clear();
        if self.q0 != q0 {
            self.spread_knots(q0);
        }
        for group in 0..self.knots.len() {
            let (at, unit) = self.knots[group];
            let first = group * Lanes::LANES;
            self.state.unit[0] = unit;
            if !self.solve(cx, at, group == 0) {
                return false;
            }
            for lane in 0..Lanes::LANES {
                if first + lane < KNOTS && !self.lay(at.lane(lane), lane, start, track) {
                    return false;
                }
            }
        }
        let classes = start.len();
        track.gain.clear();
        for class in 0..classes {
            let (a, b) = (track.angles[class], track.angles[(KNOTS - 1) * classes + class]);
            track.gain.push(TAU * ((b - a) / TAU).round());
        }
        track.reached.clear();
        track.reached.resize(KNOTS, true);
        track.changes.clear();
        track.stretches.resize_with(1, Stretch::default);
        track.stretches[0].from = f64::NEG_INFINITY;
        track.stretches[0].signs.clear();
        track.stretches[0].signs.extend_from_slice(cx.signs);
        track.period = Some(TAU);
        track.covered = None;
        track.even = Some(1.0 / CELL);
        true
    }

    #[inline(always)]
    fn spread_knots(&mut self, q0: f64) {
        self.q0 = q0;
        self.knots.clear();
        for first in (0..KNOTS).step_by(Lanes::LANES) {
            let at = Lanes::from_lanes(|lane| {
                let turned = ((first + lane) as f64) / f64::from(CELLS_A_TURN);
                q0 + TAU * turned
            });
            self.knots.push((at, Vector::at_angle(at)));
        }
    }

    /// Eight knots; false if one of them, by itself, needs walking.
    #[inline(always)]
    fn solve(&mut self, cx: &Context<'_>, at: Lanes, is_first: bool) -> bool {
        let Context { plan, bound, jets, .. } = *cx;
        let cx = Context { plan, bound, jets, signs: &self.signs };
        self.state.solve_turned(&cx, &[at]);
        if self.state.care.any() {
            return false;
        }
        let mut lines = 0;
        for dyad in plan.dyads() {
            match dyad.sign {
                Some(sign) => self.spreads[sign] = self.state.spread(&cx, dyad, 1),
                None if dyad.form == Form::TwoLines => {
                    let positive = Lanes::ZERO.lt(self.state.determinant(&cx, dyad));
                    let side = positive.any();
                    if is_first {
                        self.sides.push(side);
                    }
                    if side != positive.all() || self.sides[lines] != side {
                        return false;
                    }
                    lines += 1;
                }
                None => {}
            }
        }
        let mut fast = Lanes::ZERO;
        for class in 1..self.angles.len() {
            self.angles[class] = self.state.class[class].angle();
            fast = (self.state.theta[2 * class + 1].abs() * Lanes::splat(CELL)).max(fast);
        }
        !Lanes::splat(LIFT_TURN).lt(fast).any()
    }

    /// One knot after the last; false if something may happen between them.
    #[inline(always)]
    fn lay(&mut self, at: f64, lane: usize, start: &[f64], track: &mut Track) -> bool {
        let classes = start.len();
        let before = track.angles.len();
        let is_first = before == 0;
        for class in 0..classes {
            let last = if is_first { start[class] } else { track.angles[before - classes + class] };
            let angle = nearest(self.angles[class].lane(lane), last);
            if !is_first && (angle - last).abs() > LIFT_TURN {
                return false;
            }
            track.angles.push(angle);
        }
        for (last, now) in self.spread.iter_mut().zip(&self.spreads) {
            let now = (now.0.lane(lane), now.1.lane(lane));
            if !is_first && may_touch(*last, now, CELL) {
                return false;
            }
            *last = now;
        }
        track.at.push(at);
        true
    }
}
