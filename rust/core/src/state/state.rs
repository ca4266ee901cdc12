//! One position of one design, or eight: every point, orientation and slide with its
//! analogues.

use super::group::workspace::GroupWorkspace;
use super::status::{FLAT2, Fault, Status};
use crate::math::derivatives::DerivativeTables;
use crate::math::lanes::{Mask, Real};
use crate::math::tolerance::NEAR_SINGULAR_CONDITION;
use crate::math::vector::Vector;
use crate::plan::constants::DesignConstants;
use crate::plan::dyad::{Dyad, Unknown};
use crate::plan::group::Group;
use crate::plan::plan::{EdgeSlide, Plan, Step};

/// Work space for one position, or for `G` groups of as many as `R` has lanes; made once,
/// used for all.
///
/// Groups are the innermost index: what a step looks up serves all of them, and they do not wait
/// for each other.
#[derive(Debug, Clone)]
pub(crate) struct State<R: Real = f64, const G: usize = 1> {
    /// Entries of a jet.
    pub(crate) len: usize,
    /// Groups in use.
    pub(crate) groups: usize,
    /// Coordinates (rad; slide drivers in units of the scale).
    pub(crate) q: Vec<[R; G]>,
    /// Unit vectors at the driven angles.
    pub(crate) unit: Vec<[Vector<R>; G]>,
    /// Assembly signs, +1 or −1.
    pub(crate) signs: Vec<[R; G]>,
    /// Jets of points, one after another.
    pub points: Vec<[Vector<R>; G]>,
    /// Jets of orientations.
    pub orient: Vec<[Vector<R>; G]>,
    /// Jets of the legs of dyads, two a dyad, then of the edges of groups.
    pub(crate) legs: Vec<[Vector<R>; G]>,
    /// Jets of the angles of classes; the value itself is not used.
    pub theta: Vec<[R; G]>,
    /// Jets of slides.
    pub slides: Vec<[R; G]>,
    /// Rotations of classes.
    pub class: Vec<[Vector<R>; G]>,
    /// Turns by the drivers alone, of every orientation.
    pub(crate) phase: Vec<[Vector<R>; G]>,
    /// Square of the greatest coordinate or arm on the way to each point: what its
    /// rounding is a part of.
    pub(crate) grain: Vec<[R; G]>,
    /// Square of the product of the conditions of the dyads that each point depends on
    /// (squares need no roots).
    pub(crate) point_condition: Vec<[R; G]>,
    /// Likewise of each class.
    pub(crate) class_condition: Vec<[R; G]>,
    /// Likewise of each slide.
    pub(crate) slide_condition: Vec<[R; G]>,
    /// Square of the condition of what each dyad with a sign hangs on.
    pub(crate) before: Vec<[R; G]>,
    /// Matrix, inverse and right-hand side of a group above class II.
    pub(crate) matrix: Vec<[R; G]>,
    /// Jets of the directions of guides along the edges of a group, and of the chords of its
    /// loops.
    pub(crate) guides: Vec<[Vector<R>; G]>,
    pub(crate) chords: Vec<[Vector<R>; G]>,
    /// 1/length of every chord that has one.
    pub(crate) per: Vec<[R; G]>,
    /// Classes of binary links whose rotation is asked for (where nothing else needs it).
    pub(crate) asked: Vec<bool>,
    /// Work space for groups of binary links.
    pub(crate) loops: GroupWorkspace<R>,
    /// Determinant of every group's matrix (with analogues only).
    pub(crate) determinants: Vec<[R; G]>,
    /// The same of its last round's.
    pub(crate) bends: Vec<[R; G]>,
    /// How far (rad, or of the size) the first step of a group's iteration went, at most, and the
    /// others together.
    pub(crate) first_step: [R; G],
    pub(crate) later_steps: [R; G],
    /// Square of the greatest condition of the position.
    pub condition2: [R; G],
    /// Lanes that did not come out as plainly solved; each is done again by itself.
    pub care: [R::Mask; G],
    /// How one position by itself came out (with several lanes: see `care`).
    pub status: Status,
    /// The first thing that failed, likewise.
    pub fault: Option<Fault>,
}

/// What is the same for all positions of a design.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Context<'a> {
    /// The compiled mechanism.
    pub plan: &'a Plan,
    /// One design.
    pub bound: &'a DesignConstants,
    /// Index tables of the analogues.
    pub jets: &'a DerivativeTables,
    /// Assembly signs, +1 or −1, of positions by themselves.
    pub signs: &'a [f64],
}

impl<R: Real, const G: usize> State<R, G> {
    /// Work space for a plan.
    #[must_use]
    pub(crate) fn new(plan: &Plan, jets: &DerivativeTables) -> Self {
        let (len, slides) = (jets.len(), plan.slide_links.len());
        let edges = plan.groups().map(|group| group.edges.len()).max().unwrap_or(0);
        let loops = plan.groups().map(|group| group.loops.len()).max().unwrap_or(0);
        Self {
            len,
            groups: G,
            q: vec![[R::ZERO; G]; plan.drivers.len()],
            unit: vec![[Vector::ONE; G]; plan.drivers.len()],
            signs: vec![[R::ONE; G]; plan.signs()],
            points: vec![[Vector::ZERO; G]; plan.points * len],
            orient: vec![[Vector::ZERO; G]; plan.orientations.len() * len],
            legs: vec![[Vector::ZERO; G]; plan.legs() * len],
            theta: vec![[R::ZERO; G]; plan.classes * len],
            slides: vec![[R::ZERO; G]; slides * len],
            class: vec![[Vector::ONE; G]; plan.classes],
            phase: vec![[Vector::ONE; G]; plan.orientations.len()],
            grain: vec![[R::ZERO; G]; plan.points],
            point_condition: vec![[R::ONE; G]; plan.points],
            class_condition: vec![[R::ONE; G]; plan.classes],
            slide_condition: vec![[R::ONE; G]; slides],
            before: vec![[R::ONE; G]; plan.signs()],
            matrix: vec![[R::ZERO; G]; plan.matrix_size()],
            guides: vec![[Vector::ZERO; G]; edges * len],
            chords: vec![[Vector::ZERO; G]; loops * len],
            per: vec![[R::ONE; G]; loops],
            asked: vec![true; plan.classes],
            loops: GroupWorkspace::default(),
            determinants: vec![[R::ZERO; G]; plan.groups().count()],
            bends: vec![[R::ZERO; G]; plan.groups().count()],
            first_step: [R::ZERO; G],
            later_steps: [R::ZERO; G],
            condition2: [R::ONE; G],
            care: [R::Mask::NONE; G],
            status: Status::Ok,
            fault: None,
        }
    }

    /// Takes what is the same at all positions of a design; before the first of each.
    #[inline(always)]
    pub(crate) fn prepare(
        &mut self,
        plan: &Plan,
        bound: &DesignConstants,
        jets: &DerivativeTables,
    ) {
        let len = self.len;
        for (point, (&fixed, jet)) in
            bound.fixed.iter().zip(self.points.chunks_exact_mut(len)).enumerate()
        {
            let fixed = Vector::splat(fixed);
            jet.fill([Vector::ZERO; G]);
            jet[0] = [fixed; G];
            self.grain[point] = [fixed.norm2(); G];
        }
        self.class[0] = [Vector::ONE; G];
        self.theta[..len].fill([R::ZERO; G]);
        for (orientation, jet) in plan.orientations.iter().zip(self.orient.chunks_exact_mut(len)) {
            if orientation.class == 0 {
                jet.fill([Vector::ZERO; G]);
                jet[0] = [Vector::ONE; G];
            }
        }
        for driver in 0..plan.drivers.len() {
            let Some(slide) = plan.driven_slide(driver) else { continue };
            for k in 1..len {
                let own = jets.driver_of[k] == Some(driver);
                self.slides[slide * len + k] = [if own { R::ONE } else { R::ZERO }; G];
            }
        }
    }

    /// Computes positions at their `q`, `unit` and `signs`; `group` is
    /// [`solve_group`](Self::solve_group), compiled by itself.
    #[inline(always)]
    pub(crate) fn solve_all(
        &mut self,
        cx: &Context<'_>,
        group: &impl Fn(&mut Self, &Context<'_>, &Group, usize),
    ) {
        self.start(cx);
        for (index, step) in cx.plan.steps.iter().enumerate() {
            if R::LANES == 1 && self.is_over() {
                return;
            }
            match step {
                Step::Dyad(dyad) => match dyad.binary {
                    Some(classes) => self.solve_binary(cx, dyad, classes, index),
                    None => {
                        for g in 0..self.groups.min(G) {
                            self.solve_dyad(g, cx, dyad, index);
                        }
                    }
                },
                &Step::Place { edge, backward } => self.place_all(cx, edge, backward),
                Step::Group(higher) => group(self, cx, higher, index),
                Step::Redundant(fit) => {
                    for g in 0..self.groups.min(G) {
                        self.fit(g, cx, fit, index);
                    }
                }
            }
        }
    }

    /// Whether nothing is left to be computed.
    #[inline(always)]
    pub(crate) fn is_over(&self) -> bool {
        matches!(self.status, Status::Unreachable | Status::BadInput | Status::NotConverged)
    }

    /// Where fewer than six digits of the analogues remain.
    #[inline(always)]
    pub(crate) fn near_singular(&self, g: usize) -> R::Mask {
        R::splat(NEAR_SINGULAR_CONDITION * NEAR_SINGULAR_CONDITION).lt(self.condition2[g])
    }

    /// A coordinate that cannot be computed with.
    pub(crate) fn set_bad_input(&mut self) {
        self.fault = None;
        self.status = Status::BadInput;
    }

    /// A place to which the way from the drawing is not known.
    pub(crate) fn set_lost(&mut self) {
        self.fault = None;
        self.status = Status::Lost;
    }

    /// Lanes where a step did not close; a position by itself is done with then.
    #[inline(always)]
    pub(crate) fn open(&mut self, g: usize, open: R::Mask, fault: impl Fn() -> Fault) {
        self.care[g] = self.care[g].or(open);
        if R::LANES == 1 && open.any() {
            self.fault = Some(fault());
            self.status = Status::Unreachable;
        }
    }

    #[inline(always)]
    fn start(&mut self, cx: &Context<'_>) {
        self.fault = None;
        self.status = Status::Ok;
        self.condition2 = [R::ONE; G];
        self.care = [R::Mask::NONE; G];
        self.first_step = [R::ZERO; G];
        self.later_steps = [R::ZERO; G];
        for (driver, q) in self.q.iter().enumerate() {
            for g in 0..G {
                self.care[g] = self.care[g].or(q[g].finite().not());
            }
            if let Some(slide) = cx.plan.driven_slide(driver) {
                self.slides[slide * self.len] = *q;
            }
        }
        if R::LANES == 1 && self.care[0].any() {
            self.status = Status::BadInput;
            return;
        }
        for (o, orientation) in cx.plan.orientations.iter().enumerate() {
            if !orientation.driven {
                continue;
            }
            for g in 0..self.groups.min(G) {
                let mut phase = Vector::ONE;
                match orientation.lone {
                    Some((driver, false)) => phase = self.unit[driver][g],
                    Some((driver, true)) => phase = self.unit[driver][g].conj(),
                    None => {
                        for (&turns, unit) in orientation.turns.iter().zip(&self.unit) {
                            let unit = if turns < 0 { unit[g].conj() } else { unit[g] };
                            for _ in 0..turns.unsigned_abs() {
                                phase = phase * unit;
                            }
                        }
                    }
                }
                self.phase[o][g] = phase;
                if orientation.class == 0 {
                    self.orient_driven(g, cx, o, phase);
                }
            }
        }
    }

    #[inline(always)]
    fn solve_dyad(&mut self, g: usize, cx: &Context<'_>, dyad: &Dyad, index: usize) {
        let mut before = self.point_condition[dyad.start][g].max(self.point_condition[dyad.end][g]);
        for part in &dyad.others {
            if part.turns.is_none() {
                before = before.max(self.class_condition[cx.plan.class_of(part.edge)][g]);
            }
            if let (EdgeSlide::Slide(slide), None) = (cx.plan.edges[part.edge].along, part.slides) {
                before = before.max(self.slide_condition[slide][g]);
            }
        }
        if let Some(sign) = dyad.sign {
            self.before[sign][g] = before;
        }
        let solved = self.close(g, cx, dyad);
        self.open(g, solved.open, || Fault::NotClosed { step: index, gap: solved.gap.lane(0) });
        if self.status == Status::Unreachable {
            return;
        }
        let condition = before * solved.arm2 / solved.sine2;
        for unknown in dyad.unknowns {
            match unknown {
                Unknown::Class(c) => self.class_condition[c][g] = condition,
                Unknown::Slide(s) => self.slide_condition[s][g] = condition,
            }
        }
        self.condition2[g] = condition.max(self.condition2[g]);
        let flat = solved.flat.or(solved.sine2.lt(R::splat(FLAT2)));
        self.care[g] = self.care[g].or(flat);
        if R::LANES == 1 && flat.any() {
            self.fault.get_or_insert(Fault::Singular { step: index });
            self.status = Status::Singular;
            self.no_analogues(g, dyad);
            return;
        }
        self.analogues(g, cx, dyad);
    }
}

impl State {
    #[inline(never)]
    fn solve_one_group(&mut self, cx: &Context<'_>, group: &Group, index: usize) {
        self.solve_group(cx, group, index);
    }

    /// Computes one position at `q` (rad; slide drivers in units of the scale).
    #[inline(never)]
    pub(crate) fn solve(&mut self, cx: &Context<'_>, q: &[f64]) {
        for (own, &sign) in self.signs.iter_mut().zip(cx.signs) {
            own[0] = sign;
        }
        for (driver, &value) in q.iter().enumerate() {
            self.q[driver][0] = value;
            if cx.plan.driven_slide(driver).is_none() {
                self.unit[driver][0] = Vector::at_angle(value);
            }
        }
        self.solve_all(cx, &Self::solve_one_group);
        if self.status == Status::Ok && self.near_singular(0) {
            self.status = Status::NearSingular;
        }
    }
}
