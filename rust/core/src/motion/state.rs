//! One position of one design: every point, orientation and slide with its
//! analogues.

use crate::plan::bind::Bound;
use crate::plan::jet::Jets;
use crate::plan::{Along, Dyad, Plan, Step, Unknown};
use crate::plane::Vector;
use crate::tolerance::{near_singular_condition, singular_condition};

/// How a position came out; the codes are those of the arrays.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[repr(u8)]
pub enum Status {
    /// Solved.
    Ok = 0,
    /// Solved; fewer than six digits of the analogues remain.
    NearSingular = 1,
    /// The position is given; it has no analogues.
    Singular = 2,
    /// This assembly does not exist at this coordinate.
    Unreachable = 3,
    /// The way from the drawing to here is not known (beyond a fold of a higher group).
    Lost = 4,
    /// The iteration of a higher group did not end.
    NotConverged = 5,
    /// A dimension of this design is no dimension.
    BadDimension = 6,
    /// The coordinate is no number.
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

/// Work space for one position; made once, used for all.
#[derive(Debug, Clone)]
pub struct State {
    /// Entries of a jet.
    pub(crate) len: usize,
    /// Jets of points, one after another.
    pub points: Vec<Vector>,
    /// Jets of orientations.
    pub orient: Vec<Vector>,
    /// Jets of the angles of classes; the value itself is not used.
    pub theta: Vec<f64>,
    /// Jets of slides.
    pub slides: Vec<f64>,
    /// Rotations of classes.
    pub class: Vec<Vector>,
    /// Turns by the drivers alone, of every orientation.
    pub(crate) phase: Vec<Vector>,
    /// Greatest coordinate or arm on the way to each point: what its rounding is a
    /// part of.
    pub(crate) grain: Vec<f64>,
    /// Product of the conditions of the dyads that each point depends on.
    pub(crate) point_condition: Vec<f64>,
    pub(crate) class_condition: Vec<f64>,
    pub(crate) slide_condition: Vec<f64>,
    /// Condition of what each dyad with a sign hangs on.
    pub(crate) before: Vec<f64>,
    /// Greatest condition of the position.
    pub condition: f64,
    /// How it came out.
    pub status: Status,
    /// The first thing that failed.
    pub fault: Option<Fault>,
}

/// What is the same for all positions of a design.
#[derive(Debug, Clone, Copy)]
pub struct Context<'a> {
    /// The compiled mechanism.
    pub plan: &'a Plan,
    /// One design.
    pub bound: &'a Bound,
    /// Index tables of the analogues.
    pub jets: &'a Jets,
    /// Assembly signs, +1 or −1.
    pub signs: &'a [f64],
}

impl State {
    /// Work space for a plan.
    #[must_use]
    pub fn new(plan: &Plan, jets: &Jets, slides: usize) -> Self {
        let len = jets.len();
        Self {
            len,
            points: vec![Vector::ZERO; plan.points * len],
            orient: vec![Vector::ZERO; plan.orientations.len() * len],
            theta: vec![0.0; plan.classes * len],
            slides: vec![0.0; slides * len],
            class: vec![Vector::ONE; plan.classes],
            phase: vec![Vector::ONE; plan.orientations.len()],
            grain: vec![0.0; plan.points],
            point_condition: vec![1.0; plan.points],
            class_condition: vec![1.0; plan.classes],
            slide_condition: vec![1.0; slides],
            before: vec![1.0; plan.signs()],
            condition: 1.0,
            status: Status::Ok,
            fault: None,
        }
    }

    /// Computes the position at `q` (rad; slide drivers in units of the scale).
    pub fn solve(&mut self, cx: &Context<'_>, q: &[f64]) {
        self.start(cx, q);
        if self.status != Status::Ok {
            return;
        }
        for (index, step) in cx.plan.steps.iter().enumerate() {
            let result = match step {
                Step::Dyad(dyad) => self.solve_dyad(cx, dyad, index),
                &Step::Place { edge, backward } => {
                    self.place(cx, edge, backward);
                    Ok(())
                }
                Step::Fit(fit) => self.fit(cx, fit, index),
            };
            if let Err(fault) = result {
                match fault {
                    Fault::Flat { .. } => {
                        self.fault.get_or_insert(fault);
                        self.status = Status::Singular;
                    }
                    Fault::Open { .. } | Fault::Misfit { .. } => {
                        self.fault = Some(fault);
                        self.status = Status::Unreachable;
                        return;
                    }
                }
            }
        }
        let greatest = |c: &[f64]| c.iter().copied().fold(1.0, f64::max);
        self.condition = greatest(&self.point_condition)
            .max(greatest(&self.class_condition))
            .max(greatest(&self.slide_condition));
        if self.status == Status::Ok && self.condition > near_singular_condition() {
            self.status = Status::NearSingular;
        }
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

    fn start(&mut self, cx: &Context<'_>, q: &[f64]) {
        let len = self.len;
        self.fault = None;
        self.condition = 1.0;
        self.status = if q.iter().all(|x| x.is_finite()) { Status::Ok } else { Status::BadInput };
        for (point, &fixed) in cx.bound.fixed.iter().enumerate() {
            self.points[point * len..(point + 1) * len].fill(Vector::ZERO);
            self.points[point * len] = fixed;
            self.grain[point] = fixed.norm();
        }
        self.class[0] = Vector::ONE;
        self.theta.fill(0.0);
        self.slides.fill(0.0);
        self.point_condition.fill(1.0);
        self.class_condition.fill(1.0);
        self.slide_condition.fill(1.0);
        for (driver, &value) in q.iter().enumerate() {
            let Some(slide) = cx.plan.driven_slide(driver) else { continue };
            self.slides[slide * len] = value;
            for k in 1..len {
                if cx.jets.driver_of(k) == Some(driver) {
                    self.slides[slide * len + k] = 1.0;
                }
            }
        }
        for (o, orientation) in cx.plan.orientations.iter().enumerate() {
            let mut phase = Vector::ONE;
            for (&turns, &angle) in orientation.turns.iter().zip(q) {
                let mut unit = Vector::ONE;
                if turns != 0 {
                    unit = Vector::at_angle(angle);
                }
                if turns < 0 {
                    unit = unit.conj();
                }
                for _ in 0..turns.unsigned_abs() {
                    phase = phase * unit;
                }
            }
            self.phase[o] = phase;
            if orientation.class == 0 {
                self.orient_class(cx, o);
            }
        }
    }

    /// Condition of what an edge starts from, without the points.
    fn edge_condition(&self, cx: &Context<'_>, e: usize) -> f64 {
        let turned = self.class_condition[cx.plan.class_of(e)];
        match cx.plan.edges[e].along {
            Along::Slide(slide) => turned.max(self.slide_condition[slide]),
            _ => turned,
        }
    }

    pub(crate) fn place(&mut self, cx: &Context<'_>, e: usize, backward: bool) {
        let edge = &cx.plan.edges[e].edge;
        let (from, to) = if backward { (edge.to, edge.from) } else { (edge.from, edge.to) };
        for k in 0..self.len {
            let v = self.edge(cx, e, k);
            let base = self.points[from * self.len + k];
            self.points[to * self.len + k] = if backward { base - v } else { base + v };
        }
        let (start, end) = (self.points[from * self.len], self.points[to * self.len]);
        self.grain[to] = self.grain[from].max((end - start).norm()).max(end.norm());
        self.point_condition[to] = self.point_condition[from].max(self.edge_condition(cx, e));
    }

    fn solve_dyad(&mut self, cx: &Context<'_>, dyad: &Dyad, index: usize) -> Result<(), Fault> {
        let mut before = self.point_condition[dyad.start].max(self.point_condition[dyad.end]);
        for &(e, _) in &dyad.path {
            before = before.max(self.edge_condition(cx, e));
        }
        if let Some(sign) = dyad.sign {
            self.before[sign] = before;
        }
        let solved = self.close(cx, dyad).map_err(|gap| Fault::Open { step: index, gap })?;
        let condition = before * solved.condition;
        for unknown in dyad.unknowns {
            match unknown {
                Unknown::Class(c) => self.class_condition[c] = condition,
                Unknown::Slide(s) => self.slide_condition[s] = condition,
            }
        }
        if solved.flat || solved.angle > singular_condition() {
            self.no_analogues(dyad);
            return Err(Fault::Flat { step: index });
        }
        self.analogues(cx, dyad);
        Ok(())
    }
}
