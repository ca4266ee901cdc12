//! One position of one design: every point, orientation and slide with its
//! analogues.

use crate::plan::bind::Bound;
use crate::plan::jet::Jets;
use crate::plan::{Along, Dyad, Form, Plan, Step, Unknown};
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
    /// Beyond a fold of a higher group: not followed.
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
                self.fault.get_or_insert(fault);
                match fault {
                    Fault::Flat { .. } => self.status = Status::Singular,
                    Fault::Open { .. } | Fault::Misfit { .. } => {
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

    fn start(&mut self, cx: &Context<'_>, q: &[f64]) {
        let len = self.len;
        self.fault = None;
        self.condition = 1.0;
        self.status = if q.iter().all(|x| x.is_finite()) { Status::Ok } else { Status::BadInput };
        for (point, &fixed) in cx.bound.fixed.iter().enumerate() {
            self.points[point * len..(point + 1) * len].fill(Vector::ZERO);
            self.points[point * len] = fixed;
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

    /// Value and all analogues of an orientation from its class's.
    fn orient_class(&mut self, cx: &Context<'_>, o: usize) {
        self.orient[o * self.len] = self.class[cx.plan.orientations[o].class] * self.phase[o];
        for k in 1..self.len {
            let partial = self.orientation_without_top(cx, o, k);
            let top = self.theta_of(cx, o, k);
            self.orient[o * self.len + k] = partial + self.orient[o * self.len].left().scale(top);
        }
    }

    /// Analogue `k` of an orientation's angle.
    pub(crate) fn theta_of(&self, cx: &Context<'_>, o: usize, k: usize) -> f64 {
        let orientation = &cx.plan.orientations[o];
        let driven = cx.jets.driver_of(k).map_or(0.0, |d| f64::from(orientation.turns[d]));
        self.theta[orientation.class * self.len + k] + driven
    }

    /// Analogue `k` of an orientation but for the term in its angle's own `k`.
    pub(crate) fn orientation_without_top(&self, cx: &Context<'_>, o: usize, k: usize) -> Vector {
        let mut sum = Vector::ZERO;
        for term in &cx.jets.rotation[k] {
            let rate = self.theta_of(cx, o, term.right);
            sum += self.orient[o * self.len + term.left].scale(term.factor * rate);
        }
        sum.left()
    }

    /// Entry `k` of an edge's vector.
    pub(crate) fn edge(&self, cx: &Context<'_>, e: usize, k: usize) -> Vector {
        let edge = &cx.plan.edges[e];
        let unit = edge.orientation * self.len;
        let mut v = self.orient[unit + k] * cx.bound.rigid[e];
        if let Along::Slide(slide) | Along::Driver { slide, .. } = edge.along {
            let mut along = Vector::ZERO;
            for term in &cx.jets.product[k] {
                let s = self.slides[slide * self.len + term.right];
                along += self.orient[unit + term.left].scale(term.factor * s);
            }
            v += along * cx.bound.guide[e];
        }
        v
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
        if solved.flat || solved.angle > singular_condition(before) {
            self.no_analogues(cx, dyad);
            return Err(Fault::Flat { step: index });
        }
        self.analogues(cx, dyad);
        Ok(())
    }

    /// Every class that turns with one unknown class, in every orientation.
    fn orientations_of<'a>(cx: &Context<'a>, dyad: &'a Dyad) -> impl Iterator<Item = usize> + 'a {
        let plan = cx.plan;
        (0..plan.orientations.len())
            .filter(move |&o| dyad.unknowns.contains(&Unknown::Class(plan.orientations[o].class)))
    }

    fn no_analogues(&mut self, cx: &Context<'_>, dyad: &Dyad) {
        let len = self.len;
        for unknown in dyad.unknowns {
            let jet = match unknown {
                Unknown::Class(c) => &mut self.theta[c * len..(c + 1) * len],
                Unknown::Slide(s) => &mut self.slides[s * len..(s + 1) * len],
            };
            jet[1..].fill(f64::NAN);
        }
        for o in Self::orientations_of(cx, dyad) {
            self.orient[o * len + 1..(o + 1) * len].fill(Vector::NAN);
        }
    }

    /// Analogues of a dyad's unknowns from its closure equation: at every order
    /// the same two columns, and as right-hand side what is known of that order.
    fn analogues(&mut self, cx: &Context<'_>, dyad: &Dyad) {
        let len = self.len;
        let columns = dyad.unknowns.map(|unknown| self.column(cx, dyad, unknown));
        let determinant = columns[0].cross(columns[1]);
        for k in 1..len {
            for o in Self::orientations_of(cx, dyad) {
                // The angle's own analogue is still 0 here.
                let partial = self.orientation_without_top(cx, o, k);
                let driven = self.theta_of(cx, o, k);
                self.orient[o * len + k] = partial + self.orient[o * len].left().scale(driven);
            }
            let known = self.closure(cx, dyad, k);
            let values =
                [columns[1].cross(known) / determinant, known.cross(columns[0]) / determinant];
            for (unknown, value) in dyad.unknowns.into_iter().zip(values) {
                match unknown {
                    Unknown::Slide(s) => self.slides[s * len + k] = value,
                    Unknown::Class(c) => {
                        self.theta[c * len + k] = value;
                        for o in 0..cx.plan.orientations.len() {
                            if cx.plan.orientations[o].class == c {
                                let top = self.orient[o * len].left().scale(value);
                                self.orient[o * len + k] += top;
                            }
                        }
                    }
                }
            }
        }
    }

    /// Entry `k` of `P_start + Σ ±edges − P_end`.
    pub(crate) fn closure(&self, cx: &Context<'_>, dyad: &Dyad, k: usize) -> Vector {
        let mut sum = self.points[dyad.start * self.len + k] - self.points[dyad.end * self.len + k];
        for &(e, backward) in &dyad.path {
            let v = self.edge(cx, e, k);
            sum = if backward { sum - v } else { sum + v };
        }
        sum
    }

    /// How far a dyad is from flat, with the sign of its assembly, and the rate of
    /// that by one driver (jet entry `first`): the sine of the angle between its legs (a rotation
    /// and a slide: the chord) as far as it matters near 0.
    pub(crate) fn spread(&self, cx: &Context<'_>, dyad: &Dyad, first: usize) -> (f64, f64) {
        let [a, da] = [0, first].map(|k| self.leg(cx, dyad, dyad.unknowns[0], k));
        let (value, rate, size) = match dyad.form {
            Form::TwoCircles => {
                let [b, db] = [0, first].map(|k| self.leg(cx, dyad, dyad.unknowns[1], k));
                (b.cross(a), db.cross(a) + b.cross(da), a.norm() * b.norm())
            }
            Form::CircleAndLine | Form::TurningGuide => {
                let [g, dg] = [0, first].map(|k| self.guide(cx, dyad, k));
                let sign = if dyad.form == Form::TurningGuide { 1.0 } else { -1.0 };
                let size = if dyad.form == Form::TurningGuide { 1.0 } else { a.norm() };
                (sign * g.dot(a), sign * (dg.dot(a) + g.dot(da)), size)
            }
            Form::TwoLines => (1.0, 0.0, 1.0),
        };
        (value / size, rate / size)
    }

    /// Entry `k` of the sum of a dyad's edges that turn with one unknown.
    fn leg(&self, cx: &Context<'_>, dyad: &Dyad, unknown: Unknown, k: usize) -> Vector {
        let mut sum = Vector::ZERO;
        for &(e, backward) in &dyad.path {
            if Unknown::Class(cx.plan.class_of(e)) == unknown {
                let v = self.edge(cx, e, k);
                sum = if backward { sum - v } else { sum + v };
            }
        }
        sum
    }

    /// Entry `k` of the direction of a dyad's unknown slide.
    fn guide(&self, cx: &Context<'_>, dyad: &Dyad, k: usize) -> Vector {
        let along = |e: usize| match cx.plan.edges[e].along {
            Along::Slide(s) => dyad.unknowns.contains(&Unknown::Slide(s)),
            _ => false,
        };
        let found = dyad.path.iter().find(|(e, _)| along(*e));
        found.map_or(Vector::ZERO, |&(e, backward)| {
            let v = self.orient[cx.plan.edges[e].orientation * self.len + k] * cx.bound.guide[e];
            if backward { -v } else { v }
        })
    }

    /// Becomes the weighted sum of other states of the same plan: a polynomial
    /// through them, evaluated between them.
    pub(crate) fn blend(&mut self, states: &[Self], weights: &[f64]) {
        fn sum(out: &mut [f64], states: &[State], weights: &[f64], of: impl Fn(&State) -> &[f64]) {
            for (i, x) in out.iter_mut().enumerate() {
                *x = states.iter().zip(weights).map(|(s, w)| w * of(s)[i]).sum();
            }
        }
        fn sums(
            out: &mut [Vector],
            states: &[State],
            weights: &[f64],
            of: impl Fn(&State) -> &[Vector],
        ) {
            for (i, x) in out.iter_mut().enumerate() {
                *x = Vector::ZERO;
                for (s, &w) in states.iter().zip(weights) {
                    *x += of(s)[i].scale(w);
                }
            }
        }
        sums(&mut self.points, states, weights, |s| &s.points);
        sums(&mut self.orient, states, weights, |s| &s.orient);
        sums(&mut self.class, states, weights, |s| &s.class);
        sum(&mut self.theta, states, weights, |s| &s.theta);
        sum(&mut self.slides, states, weights, |s| &s.slides);
    }

    /// Derivative of the closure with respect to one unknown.
    fn column(&self, cx: &Context<'_>, dyad: &Dyad, unknown: Unknown) -> Vector {
        let mut sum = Vector::ZERO;
        for &(e, backward) in &dyad.path {
            let edge = &cx.plan.edges[e];
            let v = match unknown {
                Unknown::Class(c) if cx.plan.class_of(e) == c => self.edge(cx, e, 0).left(),
                Unknown::Slide(s) if edge.along == Along::Slide(s) => {
                    self.orient[edge.orientation * self.len] * cx.bound.guide[e]
                }
                _ => continue,
            };
            sum = if backward { sum - v } else { sum + v };
        }
        sum
    }
}
