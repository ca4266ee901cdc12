//! One position of one design, or eight: every point, orientation and slide with its
//! analogues.

use crate::lanes::{Mask, Real};
use crate::plan::bind::Bound;
use crate::plan::jet::Jets;
use crate::plan::{Along, Dyad, Plan, Step, Unknown};
use crate::plane::Vector;
use crate::tolerance::{NEAR_SINGULAR_CONDITION, SINGULAR_CONDITION};

/// Square of the sine of a dyad that cannot be told from a flat one.
const FLAT2: f64 = 1.0 / (SINGULAR_CONDITION * SINGULAR_CONDITION);

/// How a position came out; the codes are those of the arrays.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[repr(u8)]
pub enum Status {
    /// Solved.
    Ok = 0,
    /// Solved; fewer than six digits of the analogues remain.
    NearSingular = 1,
    /// The position is given; its analogues are NaN, except at a change point.
    Singular = 2,
    /// This assembly does not exist at this coordinate.
    Unreachable = 3,
    /// The way from the drawing to here is not known: the signs of a driven angle do not
    /// return within 64 turns (or beyond a fold of a higher group).
    Lost = 4,
    /// The iteration of a higher group did not end.
    NotConverged = 5,
    /// A dimension of this design is no dimension.
    BadDimension = 6,
    /// The coordinate is no number, or with several drivers too far from the drawing.
    BadInput = 7,
}

/// Where and why a position failed.
#[derive(Debug, Clone, Copy, PartialEq)]
#[expect(missing_docs, reason = "the fields are indices of what their names say")]
pub enum Fault {
    /// Dyad (step) whose triangle does not close, by this part of the size.
    Open { step: usize, gap: f64 },
    /// Redundant link (step) that does not fit, by this part of the size.
    Misfit { step: usize, gap: f64 },
    /// Dyad (step) that is flat.
    Flat { step: usize },
}

impl Fault {
    /// Index of the step of the plan that failed.
    #[must_use]
    pub fn step(self) -> usize {
        match self {
            Self::Open { step, .. } | Self::Misfit { step, .. } | Self::Flat { step } => step,
        }
    }
}

/// Work space for one position, or for as many as `R` has lanes; made once, used
/// for all.
#[derive(Debug, Clone)]
pub struct State<R: Real = f64> {
    /// Entries of a jet.
    pub(crate) len: usize,
    /// Jets of points, one after another.
    pub points: Vec<Vector<R>>,
    /// Jets of orientations.
    pub orient: Vec<Vector<R>>,
    /// Jets of the legs of dyads, two a dyad.
    pub(crate) legs: Vec<Vector<R>>,
    /// Jets of the angles of classes; the value itself is not used.
    pub theta: Vec<R>,
    /// Jets of slides.
    pub slides: Vec<R>,
    /// Rotations of classes.
    pub class: Vec<Vector<R>>,
    /// Turns by the drivers alone, of every orientation.
    pub(crate) phase: Vec<Vector<R>>,
    /// Unit vectors at the driven angles.
    pub(crate) unit: Vec<Vector<R>>,
    /// Square of the greatest coordinate or arm on the way to each point: what its
    /// rounding is a part of.
    pub(crate) grain: Vec<R>,
    /// Square of the product of the conditions of the dyads that each point depends on
    /// (squares need no roots).
    pub(crate) point_condition: Vec<R>,
    /// Likewise of each class.
    pub(crate) class_condition: Vec<R>,
    /// Likewise of each slide.
    pub(crate) slide_condition: Vec<R>,
    /// Square of the condition of what each dyad with a sign hangs on.
    pub(crate) before: Vec<R>,
    /// Square of the greatest condition of the position.
    pub condition2: R,
    /// Lanes that did not come out as plainly solved; each is done again by itself.
    pub care: R::Mask,
    /// How one position by itself came out (with several lanes: see `care`).
    pub status: Status,
    /// The first thing that failed, likewise.
    pub fault: Option<Fault>,
}

/// What is the same for all positions of a design.
#[derive(Debug, Clone, Copy)]
pub struct Context<'a, R: Real = f64> {
    /// The compiled mechanism.
    pub plan: &'a Plan,
    /// One design.
    pub bound: &'a Bound,
    /// Index tables of the analogues.
    pub jets: &'a Jets,
    /// Assembly signs, +1 or −1.
    pub signs: &'a [R],
}

impl<R: Real> State<R> {
    /// Work space for a plan.
    #[must_use]
    pub fn new(plan: &Plan, jets: &Jets) -> Self {
        let (len, slides) = (jets.len(), plan.slide_links.len());
        Self {
            len,
            points: vec![Vector::ZERO; plan.points * len],
            orient: vec![Vector::ZERO; plan.orientations.len() * len],
            legs: vec![Vector::ZERO; plan.dyads().count() * 2 * len],
            theta: vec![R::ZERO; plan.classes * len],
            slides: vec![R::ZERO; slides * len],
            class: vec![Vector::ONE; plan.classes],
            phase: vec![Vector::ONE; plan.orientations.len()],
            unit: vec![Vector::ONE; plan.drivers.len()],
            grain: vec![R::ZERO; plan.points],
            point_condition: vec![R::ONE; plan.points],
            class_condition: vec![R::ONE; plan.classes],
            slide_condition: vec![R::ONE; slides],
            before: vec![R::ONE; plan.signs()],
            condition2: R::ONE,
            care: R::Mask::NONE,
            status: Status::Ok,
            fault: None,
        }
    }

    /// Takes what is the same at all positions of a design; before the first of each.
    #[inline(always)]
    pub fn prepare(&mut self, plan: &Plan, bound: &Bound, jets: &Jets) {
        let len = self.len;
        for (point, (&fixed, jet)) in
            bound.fixed.iter().zip(self.points.chunks_exact_mut(len)).enumerate()
        {
            let fixed = Vector::splat(fixed);
            jet.fill(Vector::ZERO);
            jet[0] = fixed;
            self.grain[point] = fixed.norm2();
        }
        self.class[0] = Vector::ONE;
        self.theta[..len].fill(R::ZERO);
        for (orientation, jet) in plan.orientations.iter().zip(self.orient.chunks_exact_mut(len)) {
            if orientation.class == 0 {
                jet.fill(Vector::ZERO);
                jet[0] = Vector::ONE;
            }
        }
        for driver in 0..plan.drivers.len() {
            let Some(slide) = plan.driven_slide(driver) else { continue };
            for k in 1..len {
                let own = jets.driver_of[k] == Some(driver);
                self.slides[slide * len + k] = if own { R::ONE } else { R::ZERO };
            }
        }
    }

    /// Computes the position at `q` (rad; slide drivers in units of the scale).
    #[inline(always)]
    pub fn solve(&mut self, cx: &Context<'_, R>, q: &[R]) {
        for (driver, &value) in q.iter().enumerate() {
            if cx.plan.driven_slide(driver).is_none() {
                self.unit[driver] = Vector::at_angle(value);
            }
        }
        self.solve_turned(cx, q);
    }

    /// The same where `unit` holds the unit vectors of the driven angles.
    #[inline(always)]
    pub(crate) fn solve_turned(&mut self, cx: &Context<'_, R>, q: &[R]) {
        self.start(cx, q);
        if self.care.all() {
            self.status = Status::BadInput;
            return;
        }
        for (index, step) in cx.plan.steps.iter().enumerate() {
            match step {
                Step::Dyad(dyad) => self.solve_dyad(cx, dyad, index),
                &Step::Place { edge, backward } => self.place(cx, edge, backward),
                Step::Fit(fit) => self.fit(cx, fit, index),
            }
            if self.status == Status::Unreachable {
                return;
            }
        }
        let mut greatest = R::ONE;
        for list in [&self.point_condition, &self.class_condition, &self.slide_condition] {
            for &one in list {
                greatest = one.max(greatest);
            }
        }
        self.condition2 = greatest;
        if self.status == Status::Ok && self.near_singular().all() {
            self.status = Status::NearSingular;
        }
    }

    /// Where fewer than six digits of the analogues remain.
    #[inline(always)]
    pub(crate) fn near_singular(&self) -> R::Mask {
        R::splat(NEAR_SINGULAR_CONDITION * NEAR_SINGULAR_CONDITION).lt(self.condition2)
    }

    /// A coordinate that cannot be computed with.
    pub(crate) fn refuse(&mut self) {
        self.fault = None;
        self.status = Status::BadInput;
    }

    /// A place to which the way from the drawing is not known.
    pub(crate) fn lose(&mut self) {
        self.fault = None;
        self.status = Status::Lost;
    }

    /// Lanes where a step did not close. With one lane, or none left, the rest is spared.
    #[inline(always)]
    pub(crate) fn open(&mut self, open: R::Mask, fault: impl Fn() -> Fault) {
        if open.any() {
            self.care = self.care.or(open);
            if self.care.all() {
                self.fault = Some(fault());
                self.status = Status::Unreachable;
            }
        }
    }

    #[inline(always)]
    fn start(&mut self, cx: &Context<'_, R>, q: &[R]) {
        let len = self.len;
        self.fault = None;
        self.status = Status::Ok;
        self.condition2 = R::ONE;
        self.care = R::Mask::NONE;
        for (driver, &value) in q.iter().enumerate() {
            self.care = self.care.or(value.finite().not());
            if let Some(slide) = cx.plan.driven_slide(driver) {
                self.slides[slide * len] = value;
            }
        }
        for (o, orientation) in cx.plan.orientations.iter().enumerate() {
            if !orientation.driven {
                continue;
            }
            let mut phase: Option<Vector<R>> = None;
            for (&turns, &unit) in orientation.turns.iter().zip(&self.unit) {
                let unit = if turns < 0 { unit.conj() } else { unit };
                for _ in 0..turns.unsigned_abs() {
                    phase = Some(if let Some(p) = phase { p * unit } else { unit });
                }
            }
            let phase = phase.unwrap_or(Vector::ONE);
            self.phase[o] = phase;
            if orientation.class == 0 {
                self.orient_driven(cx, o);
            }
        }
    }

    /// Condition of what an edge starts from, without the points.
    #[inline(always)]
    fn edge_condition(&self, cx: &Context<'_, R>, e: usize) -> R {
        let turned = self.class_condition[cx.plan.class_of(e)];
        match cx.plan.edges[e].along {
            Along::Slide(slide) => turned.max(self.slide_condition[slide]),
            _ => turned,
        }
    }

    #[inline(always)]
    pub(crate) fn place(&mut self, cx: &Context<'_, R>, e: usize, backward: bool) {
        let edge = &cx.plan.edges[e];
        let (mut from, mut to) = (edge.edge.from, edge.edge.to);
        if backward {
            (from, to) = (to, from);
        }
        let len = self.len;
        let [from_jet, to_jet] = [from, to].map(|point| point * len..(point + 1) * len);
        let Ok([base, out]) = self.points.get_disjoint_mut([from_jet, to_jet]) else { return };
        match (edge.leg, edge.along) {
            (Some(leg), _) => {
                let leg_jet = &self.legs[leg.index * len..][..len];
                let ahead = leg.backward == backward;
                for ((out, &base), &v) in out.iter_mut().zip(&*base).zip(leg_jet) {
                    *out = if ahead { base + v } else { base - v };
                }
            }
            (None, Along::Nothing) => {
                let rigid = Vector::splat(cx.bound.rigid[e]);
                let rigid = if backward { -rigid } else { rigid };
                let orient = &self.orient[edge.orientation * len..][..len];
                for ((out, &base), &unit) in out.iter_mut().zip(&*base).zip(orient) {
                    *out = base + unit * rigid;
                }
            }
            _ => {
                for k in 0..len {
                    let v = self.edge(cx, e, k);
                    let base = self.points[from * len + k];
                    self.points[to * len + k] = if backward { base - v } else { base + v };
                }
            }
        }
        let (start, end) = (self.points[from * len], self.points[to * len]);
        let arm = match edge.along {
            Along::Nothing => R::splat(cx.bound.arm2[e]),
            _ => (end - start).norm2(),
        };
        self.grain[to] = self.grain[from].max(arm).max(end.norm2());
        self.point_condition[to] = self.point_condition[from].max(self.edge_condition(cx, e));
    }

    #[inline(always)]
    fn solve_dyad(&mut self, cx: &Context<'_, R>, dyad: &Dyad, index: usize) {
        let mut before = self.point_condition[dyad.start].max(self.point_condition[dyad.end]);
        for part in &dyad.others {
            if part.turns.is_none() {
                before = before.max(self.class_condition[cx.plan.class_of(part.edge)]);
            }
            if let (Along::Slide(slide), None) = (cx.plan.edges[part.edge].along, part.slides) {
                before = before.max(self.slide_condition[slide]);
            }
        }
        if let Some(sign) = dyad.sign {
            self.before[sign] = before;
        }
        let solved = self.close(cx, dyad);
        self.open(solved.open, || Fault::Open { step: index, gap: solved.gap.lane(0) });
        if self.status == Status::Unreachable {
            return;
        }
        let condition = before * solved.arm2 / solved.sine2;
        for unknown in dyad.unknowns {
            match unknown {
                Unknown::Class(c) => self.class_condition[c] = condition,
                Unknown::Slide(s) => self.slide_condition[s] = condition,
            }
        }
        let flat = solved.flat.or(solved.sine2.lt(R::splat(FLAT2)));
        if flat.any() {
            self.care = self.care.or(flat);
            if flat.all() {
                self.fault.get_or_insert(Fault::Flat { step: index });
                self.status = Status::Singular;
                self.no_analogues(dyad);
                return;
            }
        }
        self.analogues(cx, dyad);
    }
}
