//! The way of a driven angle where nothing happens, eight knots at a time: no dead
//! point, no change point, no link that turns fast. Whatever is else is left to the
//! walk; both lay the same knots.
//!
//! The quick way of groups above class II: their unknowns at all knots from those of the drawing.
//!
//! A design near the drawing moves nearly as it does; so the iteration starts, at all knots at
//! once, where the drawing is. What it comes to is held to what the walk holds its knots to: from
//! each knot the next is foretold, and the first is told from the drawing.

use std::cell::OnceCell;
use std::f64::consts::TAU;

use super::branch::{Branch, CELLS_A_TURN};
use super::hermite::HermiteCell;
use super::knot::{FIRST_STEP, LATER_STEPS, SignInterval, Taylor2, may_touch, returns, strays};
use crate::math::angle::turns_between;
use crate::math::derivatives::DerivativeTables;
use crate::math::lanes::{LANES, Lanes, Mask, Real};
use crate::math::tolerance::KNOT_MAX_TURN;
use crate::math::vector::Vector;
use crate::plan::dyad::{Form, Unknown};
use crate::plan::plan::Plan;
use crate::state::kernel::Level;
use crate::state::state::{Context, State};

/// Knots of a turn, its end included.
pub(crate) const KNOTS: usize = CELLS_A_TURN as usize + 1;
/// Groups of them.
pub(crate) const GROUPS: usize = KNOTS / LANES;
/// One cell.
pub(crate) const CELL: f64 = TAU / CELLS_A_TURN as f64;

/// Work space: for every knot what the walk asks of it.
#[derive(Debug)]
pub(crate) struct UniformTracer {
    /// All knots.
    pub(crate) state: State<Lanes, GROUPS>,
    /// Drawing's angle that the knots below are for, the same for all designs.
    q0: f64,
    /// Angles of the driver, eight a group, and their unit vectors.
    knots: Vec<(Lanes, Vector<Lanes>)>,
    /// Spread and rate of every dyad with a sign at the last knot.
    spread: Vec<(f64, f64)>,
    /// Angle of every class at the last knot, and its whole turns until there.
    pub(crate) last: Vec<(f64, f64)>,
    /// On which side of parallel the guides of every dyad of two known directions are, at
    /// the knots before.
    sides: Vec<bool>,
    /// Unknowns of groups at the knots of the drawing's way; asked for once.
    pub(crate) template: OnceCell<Option<ReferenceBranch>>,
    /// Unknowns of groups at the knots, one after another.
    pub(crate) seeds: Vec<Taylor2>,
}

impl UniformTracer {
    /// Work space for a plan; `jets` are of order 1 in one driver.
    pub(crate) fn new(plan: &Plan, jets: &DerivativeTables) -> Self {
        Self {
            state: State::new(plan, jets),
            q0: f64::NAN,
            knots: Vec::new(),
            spread: vec![(0.0, 0.0); plan.signs()],
            last: vec![(0.0, 0.0); plan.classes],
            sides: Vec::new(),
            template: OnceCell::new(),
            seeds: Vec::new(),
        }
    }

    /// Whether the drawing has a way from which others are told.
    pub(crate) fn has_template(&self, make: impl FnOnce() -> Option<ReferenceBranch>) -> bool {
        self.template.get_or_init(make).is_some()
    }

    /// Lays the knots of a turn from `q0` on into `track`; false if the way needs
    /// walking.
    #[inline(always)]
    pub(crate) fn turn<L: Level>(
        &mut self,
        cx: &Context<'_>,
        q0: f64,
        start: &[f64],
        track: &mut Branch,
    ) -> bool {
        self.sides.clear();
        track.at.clear();
        track.angles.clear();
        if self.q0 != q0 {
            self.spread_knots(q0);
        }
        self.state.prepare(cx.plan, cx.bound, cx.jets);
        for (group, &(at, unit)) in self.knots.iter().enumerate() {
            self.state.q[0][group] = at;
            self.state.unit[0][group] = unit;
        }
        for (lanes, &sign) in self.state.signs.iter_mut().zip(cx.signs) {
            *lanes = [Lanes::splat(sign); GROUPS];
        }
        self.guess(cx);
        L::solve(&mut self.state, cx);
        track.angles.resize(KNOTS * start.len(), 0.0);
        // Nothing is before the first knot but the drawing.
        self.spread.fill((0.0, 0.0));
        for (last, &angle) in self.last.iter_mut().zip(start) {
            *last = (angle, 0.0);
        }
        for group in 0..GROUPS {
            if !(self.look(cx, group) && self.lay(group, &mut track.angles)) {
                return false;
            }
            track.at.extend_from_slice(&self.knots[group].0.0);
        }
        if !self.lay_cells(cx, track) {
            return false;
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
        track.stretches.resize_with(1, SignInterval::default);
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
            let at = knots_at(q0, first);
            self.knots.push((at, Vector::at_angle(at)));
        }
    }

    /// Looks at eight knots, one after another; false if something may happen between them.
    #[inline(always)]
    fn look(&mut self, cx: &Context<'_>, group: usize) -> bool {
        let state = &self.state;
        let mut lines = 0;
        let mut trouble = state.care[group];
        for dyad in cx.plan.dyads() {
            match dyad.sign {
                Some(sign) => {
                    let (value, rate) = state.spread(group, cx, dyad, 1);
                    let (last, last_rate) = self.spread[sign];
                    let before = (after(last, value), after(last_rate, rate));
                    trouble = trouble.or(may_touch(before, (value, rate), Lanes::splat(CELL)));
                    self.spread[sign] = (value.lane(LANES - 1), rate.lane(LANES - 1));
                }
                None if dyad.form == Form::TwoLines => {
                    let positive = Lanes::ZERO.lt(state.determinant(group, cx, dyad));
                    let side = positive.any();
                    if group == 0 {
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
        !trouble.any()
    }

    /// Lays the angles of eight knots; false if a link turns fast there.
    #[inline(always)]
    fn lay(&mut self, group: usize, angles: &mut [f64]) -> bool {
        let classes = self.last.len();
        let first = group * LANES * classes;
        let Some(angles) = angles.get_mut(first..first + LANES * classes) else { return false };
        let mut most = Lanes::splat(KNOT_MAX_TURN);
        if group == 0 {
            // To the drawing's own angle it may be far.
            most.0[0] = f64::INFINITY;
        }
        let mut fast = <Lanes as Real>::Mask::NONE;
        for class in 0..classes {
            let angle = self.state.class[class][group].angle();
            let (last, mut whole) = self.last[class];
            let before = after(last, angle);
            let turns = turns_between(angle, before);
            let step = (angle + Lanes::splat(TAU) * turns) - before;
            let rate = self.state.theta[self.state.len * class + 1][group] * Lanes::splat(CELL);
            fast = fast.or(most.lt(step.abs())).or(Lanes::splat(KNOT_MAX_TURN).lt(rate.abs()));
            for lane in 0..LANES {
                whole += turns.lane(lane);
                angles[lane * classes + class] = angle.lane(lane) + TAU * whole;
            }
            self.last[class] = (angle.lane(LANES - 1), whole);
        }
        !fast.any()
    }
}

/// Eight knots of the way from `q0`, from one on.
#[inline(always)]
pub(crate) fn knots_at(q0: f64, first: usize) -> Lanes {
    Lanes::from_lanes(|lane| {
        let turned = ((first + lane) as f64) / f64::from(CELLS_A_TURN);
        q0 + TAU * turned
    })
}

/// Each lane's neighbour before it; that of the first is given.
#[inline(always)]
fn after(last: f64, lanes: Lanes) -> Lanes {
    Lanes::from_lanes(|i| if i == 0 { last } else { lanes.lane(i - 1) })
}

/// Unknowns of groups at the knots of the drawing's way.
#[derive(Debug)]
pub(crate) struct ReferenceBranch {
    /// Rotations, or slides (m) in the place of their x.
    unknowns: Vec<[Vector<Lanes>; GROUPS]>,
    /// Signs of the groups' determinants.
    bends: Vec<bool>,
}

impl ReferenceBranch {
    /// From a way from `q0` that returns after one turn, of a design of this scale.
    pub(crate) fn of(plan: &Plan, track: &Branch, q0: f64, scale: f64) -> Option<Self> {
        if track.period != Some(TAU) {
            return None;
        }
        let list: Vec<Unknown> = plan.groups().flat_map(|g| g.unknowns.clone()).collect();
        let of = |(place, &unknown): (usize, &Unknown)| {
            std::array::from_fn(|group| {
                let spot = track.spot(knots_at(q0, group * LANES));
                match unknown {
                    Unknown::Class(_) => track.rotation(&spot, place, list.len()),
                    Unknown::Slide(_) => {
                        let value = track.slide(&spot, place, list.len());
                        Vector::new(value * Lanes::splat(scale), Lanes::ZERO)
                    }
                }
            })
        };
        let unknowns = list.iter().enumerate().map(of).collect();
        Some(Self { unknowns, bends: track.bends.clone() })
    }
}

impl UniformTracer {
    /// The unknowns of groups where the drawing has them, as the iteration's first guess.
    #[inline(always)]
    pub(crate) fn guess(&mut self, cx: &Context<'_>) {
        let Some(Some(template)) = self.template.get() else { return };
        let per = Lanes::splat(1.0 / cx.bound.scale);
        let unknowns = cx.plan.groups().flat_map(|group| &group.unknowns);
        for (&unknown, knots) in unknowns.zip(&template.unknowns) {
            match unknown {
                Unknown::Class(class) => self.state.class[class] = *knots,
                Unknown::Slide(slide) => {
                    self.state.slides[slide * self.state.len] = knots.map(|v| v.x * per);
                }
            }
        }
    }

    /// Lays the polynomials of the groups' unknowns; false if one is not surely the same
    /// assembly as at the knot before, or as in the drawing.
    #[inline(always)]
    pub(crate) fn lay_cells(&mut self, cx: &Context<'_>, track: &mut Branch) -> bool {
        track.cells.clear();
        let Some(Some(template)) = self.template.get() else { return true };
        let state = &self.state;
        let is_near = |step: Lanes, most: f64| step.0[0] <= most;
        if !(is_near(state.first_step[0], FIRST_STEP) && is_near(state.later_steps[0], LATER_STEPS))
        {
            return false;
        }
        for (groups, &bend) in state.determinants.iter().zip(&template.bends) {
            if groups.iter().any(|lanes| lanes.0.iter().any(|&d| (d > 0.0) != bend)) {
                return false;
            }
        }
        let unknowns = || cx.plan.groups().flat_map(|group| &group.unknowns);
        let count = template.unknowns.len();
        self.seeds.clear();
        self.seeds.resize(KNOTS * count, [0.0; 3]);
        for (place, &unknown) in unknowns().enumerate() {
            let jet = match unknown {
                Unknown::Class(class) => &state.theta[class * state.len..],
                Unknown::Slide(slide) => &state.slides[slide * state.len..],
            };
            for knot in 0..KNOTS {
                let (group, lane) = (knot / LANES, knot % LANES);
                let value = match unknown {
                    Unknown::Class(class) => track.angles[knot * self.last.len() + class],
                    Unknown::Slide(_) => jet[0][group].0[lane],
                };
                self.seeds[knot * count + place] =
                    [value, jet[1][group].0[lane], jet[2][group].0[lane]];
            }
        }
        track.cells.reserve(KNOTS * count);
        for knot in 0..KNOTS {
            for (place, &unknown) in unknowns().enumerate() {
                let a = &self.seeds[knot * count + place];
                let b = self.seeds.get((knot + 1) * count + place);
                if b.is_some_and(|b| strays(a, b, CELL)) {
                    return false;
                }
                let unit = match unknown {
                    Unknown::Class(class) => {
                        let unit = state.class[class][knot / LANES];
                        Vector::new(unit.x.0[knot % LANES], unit.y.0[knot % LANES])
                    }
                    Unknown::Slide(_) => Vector::ONE,
                };
                track.cells.push(HermiteCell::new(a, b, CELL, unit));
            }
        }
        let (first, last) = (&self.seeds[..count], &self.seeds[(KNOTS - 1) * count..]);
        unknowns().zip(first.iter().zip(last)).all(|(&u, (a, b))| returns(u, a, b))
    }
}
