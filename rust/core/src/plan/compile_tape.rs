//! Compiles the tape of a plan for the needs of a request.

use std::collections::HashMap;

use super::dyad::{Dyad, Form, LoopTerm, Unknown};
use super::plan::{EdgeSlide, Plan, Step};
use super::tape::{CrankPin, DrivenOrientation, DyadOp, Op, PlaceKind, PlaceOp, Tape};

/// The needs of a request.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Needs<'a> {
    pub points: &'a [bool],
    /// Rotations.
    pub classes: &'a [bool],
    /// Orientations.
    pub orientations: &'a [bool],
    /// Whether dyads are sampled: the points that they connect are kept, and unused dyads are not
    /// solved.
    pub samples: bool,
}

/// Results that later operations use.
struct Uses {
    /// Points used with checks and without.
    points: Vec<bool>,
    points_unchecked: Vec<bool>,
    orientations: Vec<bool>,
    legs: Vec<bool>,
    /// Points whose conditions are read.
    conditions: Vec<bool>,
    classes: Vec<bool>,
    slides: Vec<bool>,
}

impl Uses {
    /// What the request itself uses; `all`: every orientation, leg and slide.
    fn by_request(plan: &Plan, needs: Needs<'_>, all: bool, has_redundant: bool) -> Self {
        Self {
            points: needs.points.to_vec(),
            points_unchecked: needs.points.to_vec(),
            orientations: vec![all; plan.orientations.len()],
            legs: vec![all; plan.legs()],
            conditions: vec![has_redundant; plan.points],
            classes: needs.classes.to_vec(),
            slides: vec![all || !needs.samples; plan.slide_links.len()],
        }
    }
}

impl Plan {
    /// Leaves all dyads and groups to the general formulas, which serve derivatives of any order.
    pub(crate) fn generalize(&mut self) {
        self.is_general = true;
        for step in &mut self.steps {
            if let Step::Group(group) = step {
                group.binary_loops = None;
            }
        }
        for edge in &mut self.edges {
            // Legs of guides that turn are found by their kernel alone.
            edge.on_leg = None;
        }
        self.tape = Tape::whole(self);
        self.tracing_tape = Tape::for_dyads(self, &vec![true; self.classes]);
    }
}

impl Tape {
    /// The whole plan.
    pub(crate) fn whole(plan: &Plan) -> Self {
        let (points, classes) = (vec![true; plan.points], vec![true; plan.classes]);
        Self::new(
            plan,
            Needs { points: &points, classes: &classes, orientations: &[], samples: true },
        )
    }

    /// The dyads and groups alone, with the rotations of these classes.
    pub(crate) fn for_dyads(plan: &Plan, classes: &[bool]) -> Self {
        let points = vec![false; plan.points];
        Self::new(plan, Needs { points: &points, classes, orientations: &[], samples: true })
    }

    /// The part of a plan that a request needs. All dyads are part of it: they decide the status.
    pub(crate) fn new(plan: &Plan, needs: Needs<'_>) -> Self {
        let has_redundant = plan.steps.iter().any(|step| matches!(step, Step::Redundant(_)));
        let all_points = has_redundant || needs.points.iter().all(|&needed| needed);
        let all = !plan.has_closed_forms() || all_points;
        // Discriminants of dyads without a kernel read orientations.
        let general = plan.dyads().any(|dyad| !dyad.has_kernel(plan));
        let mut uses = Uses::by_request(plan, needs, all || general, has_redundant);
        let mut ops = Vec::with_capacity(plan.steps.len());
        for dyad in plan.dyads() {
            uses.points[dyad.start] = true;
            uses.points[dyad.end] = true;
        }
        let pins = CrankPin::all(plan);
        for (step, what) in plan.steps.iter().enumerate().rev() {
            match what {
                Step::Dyad(dyad) => {
                    let op = Op::of_dyad(plan, dyad, step, &uses, needs.samples, &pins);
                    // Samples read both columns.
                    let [start, end] = if needs.samples { [true; 2] } else { op.columns() };
                    uses.points_unchecked[dyad.start] |= start;
                    uses.points_unchecked[dyad.end] |= end;
                    uses.conditions[dyad.start] = true;
                    uses.conditions[dyad.end] = true;
                    if let Op::MovingGuide(DyadOp { carrier: Some(carrier), .. }) = op {
                        uses.orientations[carrier] = true;
                    }
                    if let Op::Dyad { .. } = op {
                        for o in dyad.orientations.iter().flatten() {
                            uses.orientations[*o] = true;
                        }
                        for term in &dyad.others {
                            uses.orientations[plan.edges[term.edge].orientation] = true;
                        }
                    }
                    ops.push(op);
                }
                Step::Group(group) => {
                    for point in group.loops.iter().flat_map(|l| [l.start, l.end]) {
                        uses.points[point] = true;
                        uses.points_unchecked[point] = true;
                        uses.conditions[point] = true;
                    }
                    ops.push(Op::Group { step });
                }
                Step::Redundant(_) => ops.push(Op::Redundant { step }),
                &Step::Length { slide } => {
                    uses.slides[slide] = true;
                    ops.push(Op::Length { step, slide });
                }
                &Step::Place { edge, backward } => {
                    let mut place = PlaceOp::new(plan, edge, backward);
                    if !(all_points || uses.points[place.to]) {
                        continue;
                    }
                    place.is_recorded = uses.conditions[place.to];
                    uses.conditions[place.from] |= place.is_recorded;
                    place.is_used = all || uses.points_unchecked[place.to];
                    uses.points[place.from] = true;
                    let from_column = !place.from_ground || place.kind == PlaceKind::Along;
                    uses.points_unchecked[place.from] |= place.is_used && from_column;
                    match place.kind {
                        PlaceKind::Rigid { .. } | PlaceKind::Along => {
                            uses.orientations[plan.edges[edge].orientation] = true;
                            if let EdgeSlide::Slide(slide) = plan.edges[edge].along {
                                uses.slides[slide] = true;
                            }
                        }
                        PlaceKind::Leg { leg, .. } | PlaceKind::OnLeg { leg } => {
                            if let Some(leg) = uses.legs.get_mut(leg) {
                                *leg |= place.is_used;
                            }
                        }
                        PlaceKind::Crank { .. } => {}
                    }
                    ops.push(Op::Place(place));
                }
            }
        }
        ops.reverse();
        add_upstream(plan, &mut ops);
        let is_needed = |o: usize| needs.orientations.get(o).is_some_and(|&needed| needed);
        let driven = (0..plan.orientations.len())
            .filter(|&o| plan.orientations[o].driven && (uses.orientations[o] || is_needed(o)))
            .map(|index| DrivenOrientation { index, has_jet: uses.orientations[index] })
            .collect();
        let fixed =
            (0..plan.points).filter(|&at| plan.fixed[at] && uses.points_unchecked[at]).collect();
        let is_bounded = is_bounded(plan) && !ops.iter().any(|op| matches!(op, Op::Dyad { .. }));
        let is_dyad = |op: &Op| {
            !matches!(
                op,
                Op::Place(_) | Op::Group { .. } | Op::Redundant { .. } | Op::Length { .. }
            )
        };
        let dyads = (0..ops.len()).filter(|&op| is_dyad(&ops[op])).collect();
        let serves_two_drivers = ops.iter().all(|op| match op {
            Op::TwoLegs(op) => op.pin.is_none(),
            op => matches!(op, Op::Place(_)),
        });
        Self { ops, dyads, fixed, driven, is_bounded, serves_two_drivers }
    }
}

/// A dyad and those before it that it depends on: a bit each, since in a long linkage most dyads
/// depend on all before them.
struct Dyads(Vec<u64>);

impl Dyads {
    fn one(dyad: usize) -> Self {
        let mut bits = vec![0; dyad / 64 + 1];
        bits[dyad / 64] = 1 << (dyad % 64);
        Self(bits)
    }

    fn add_all(&mut self, earlier: &Self) {
        self.0.iter_mut().zip(&earlier.0).for_each(|(word, bits)| *word |= bits);
    }

    fn contains(&self, dyad: usize) -> bool {
        self.0.get(dyad / 64).is_some_and(|bits| bits >> (dyad % 64) & 1 == 1)
    }
}

/// Sets the dyads that every dyad directly depends on.
fn add_upstream(plan: &Plan, ops: &mut [Op]) {
    let mut of_point: Vec<Vec<usize>> = vec![Vec::new(); plan.points];
    let mut of_class: Vec<Option<usize>> = vec![None; plan.classes];
    let mut before: Vec<Dyads> = Vec::new();
    let last = |dyads: &mut Vec<usize>, before: &[Dyads]| {
        dyads.sort_unstable();
        dyads.dedup();
        let all = dyads.clone();
        dyads.retain(|dyad| {
            !all.iter().any(|later| later != dyad && before[*later].contains(*dyad))
        });
    };
    for op in ops {
        match op {
            Op::TwoLegs(op)
            | Op::StandingGuide(op)
            | Op::MovingGuide(op)
            | Op::TurningGuide(op)
            | Op::StandingGuides(op) => {
                op.upstream = [&of_point[op.start][..], &of_point[op.end]].concat();
                let carrier = op.carrier.and_then(|o| of_class[plan.orientations[o].class]);
                op.upstream.extend(carrier);
                last(&mut op.upstream, &before);
                let mut dependencies = Dyads::one(op.dyad);
                op.upstream.iter().for_each(|&dyad| dependencies.add_all(&before[dyad]));
                before.push(dependencies);
                if let Step::Dyad(dyad) = &plan.steps[op.step] {
                    for unknown in dyad.unknowns {
                        if let Unknown::Class(class) = unknown {
                            of_class[class] = Some(op.dyad);
                        }
                    }
                }
            }
            Op::Place(place) => {
                let mut dyads = of_point[place.from].clone();
                dyads.extend(of_class[place.class]);
                last(&mut dyads, &before);
                of_point[place.to] = dyads;
            }
            Op::Length { .. } => {}
            // Such tapes run without bounds.
            Op::Dyad { .. } | Op::Group { .. } | Op::Redundant { .. } => return,
        }
    }
}

/// Whether all steps have closed forms, and no dyad starts or ends at a point placed by a slide whose
/// value a dyad finds.
fn is_bounded(plan: &Plan) -> bool {
    let mut bounded = plan.fixed.clone();
    for step in &plan.steps {
        match step {
            &Step::Place { edge, backward } => {
                let [from, to] = plan.edges[edge].ends(backward);
                let along = plan.edges[edge].along;
                bounded[to] = bounded[from] && !matches!(along, EdgeSlide::Slide(_));
            }
            Step::Dyad(dyad) => {
                // A closed path starts at the origin.
                if ![dyad.start, dyad.end].iter().all(|&point| point == 0 || bounded[point]) {
                    return false;
                }
            }
            Step::Length { .. } => {}
            Step::Group(_) | Step::Redundant(_) => return false,
        }
    }
    true
}

/// Whether an edge is fixed.
fn stands(plan: &Plan, edge: usize) -> bool {
    let edge = &plan.edges[edge];
    edge.class == 0 && !plan.orientations[edge.orientation].driven
}

impl Op {
    fn of_dyad(
        plan: &Plan,
        dyad: &Dyad,
        step: usize,
        uses: &Uses,
        samples: bool,
        pins: &HashMap<usize, CrankPin>,
    ) -> Self {
        let turns = dyad.unknowns.map(|unknown| match unknown {
            Unknown::Class(class) => uses.classes[class],
            Unknown::Slide(_) => false,
        });
        let mut turned = Vec::new();
        for (unknown, list) in dyad.unknowns.iter().zip(&dyad.orientations) {
            if let &Unknown::Class(class) = unknown {
                turned.extend(list.iter().filter(|&&o| uses.orientations[o]).map(|&o| (o, class)));
            }
        }
        let turns_some =
            |i: usize| turned.iter().any(|&(_, class)| dyad.unknowns[i] == Unknown::Class(class));
        let turns = [turns[0] || turns_some(0), turns[1] || turns_some(1)];
        let keeps = [uses.legs[2 * dyad.index], uses.legs[2 * dyad.index + 1]];
        let slides = dyad.unknowns.iter().any(|&unknown| match unknown {
            Unknown::Slide(slide) => uses.slides[slide],
            Unknown::Class(_) => false,
        });
        let op = DyadOp {
            step,
            dyad: dyad.index,
            start: dyad.start,
            end: dyad.end,
            sign: dyad.sign,
            is_length: dyad.is_length,
            unknowns: dyad.unknowns.map(|unknown| match unknown {
                Unknown::Class(index) | Unknown::Slide(index) => index,
            }),
            turns,
            orientations: turned,
            upstream: Vec::new(),
            keeps,
            is_used: !samples || slides || turns.contains(&true) || keeps.contains(&true),
            pin: CrankPin::of(plan, dyad, pins),
            on_ground: [dyad.start, dyad.end].map(|point| plan.fixed[point]),
            carrier: dyad.moving_guide(plan).map(|term| plan.edges[term.edge].orientation),
        };
        match dyad.form {
            _ if !dyad.has_kernel(plan) => Self::Dyad { step },
            Form::TwoCircles => Self::TwoLegs(op),
            Form::CircleAndLine if dyad.moving_guide(plan).is_some() => Self::MovingGuide(op),
            Form::CircleAndLine => Self::StandingGuide(op),
            Form::TwoLines => Self::StandingGuides(op),
            Form::TurningGuide => Self::TurningGuide(op),
        }
    }
}

impl Op {
    /// Whether the unchecked path reads the columns of the dyad's start and end; it does not read those of a
    /// crank's pin or of the ground.
    fn columns(&self) -> [bool; 2] {
        match self {
            Self::TwoLegs(op) | Self::StandingGuide(op) => match (op.pin, op.on_ground) {
                (Some(_), _) => [false; 2],
                (None, [_, true]) => [true, false],
                (None, [true, false]) => [false, true],
                (None, [false, false]) => [true; 2],
            },
            _ => [true; 2],
        }
    }
}

impl CrankPin {
    /// The pins of all cranks, by their points.
    fn all(plan: &Plan) -> HashMap<usize, Self> {
        let mut pins = HashMap::new();
        for step in &plan.steps {
            let &Step::Place { edge, backward } = step else { continue };
            let place = PlaceOp::new(plan, edge, backward);
            let PlaceKind::Crank { driver, conj } = place.kind else { continue };
            if plan.fixed[place.from] {
                let pin = Self { is_start: true, pivot: place.from, edge, backward, driver, conj };
                pins.entry(place.to).or_insert(pin);
            }
        }
        pins
    }

    /// The crank's pin, if the dyad connects one to the ground.
    fn of(plan: &Plan, dyad: &Dyad, pins: &HashMap<usize, Self>) -> Option<Self> {
        let is_start = plan.fixed[dyad.end];
        let (pin, ground) = if is_start { (dyad.start, dyad.end) } else { (dyad.end, dyad.start) };
        let pin = pins.get(&pin).filter(|_| plan.fixed[ground])?;
        Some(Self { is_start, ..*pin })
    }
}

impl Dyad {
    /// Whether a kernel solves it.
    pub(super) fn has_kernel(&self, plan: &Plan) -> bool {
        !plan.is_general && self.fits_kernel(plan)
    }

    fn fits_kernel(&self, plan: &Plan) -> bool {
        match self.form {
            Form::TwoCircles => self.rrr_classes.is_some(),
            Form::CircleAndLine => {
                self.leg[0] && self.has_standing_terms(plan) || self.moving_guide(plan).is_some()
            }
            Form::TwoLines => self.has_standing_terms(plan),
            Form::TurningGuide => self.turning_guide().is_some(),
        }
    }

    /// Whether all its terms except the legs are fixed, and its only slides are its unknowns.
    pub(crate) fn has_standing_terms(&self, plan: &Plan) -> bool {
        self.others.iter().all(|term| {
            stands(plan, term.edge)
                && (term.slides.is_some() || plan.edges[term.edge].along == EdgeSlide::Nothing)
        })
    }

    /// The guide's term, if the loop is a leg and a guide on a moving link that is already solved.
    pub(crate) fn moving_guide(&self, plan: &Plan) -> Option<&LoopTerm> {
        match &self.others[..] {
            [term] if self.form == Form::CircleAndLine => {
                let is_solved = term.turns.is_none() && term.slides == Some(1) && !term.in_leg;
                (self.leg[0] && is_solved && !stands(plan, term.edge)).then_some(term)
            }
            _ => None,
        }
    }

    /// The guide's term, if the loop is a leg and a guide that turns with it.
    pub(crate) fn turning_guide(&self) -> Option<&LoopTerm> {
        match &self.others[..] {
            [term] if self.leg[0] && term.slides == Some(1) && term.turns == Some(0) => Some(term),
            _ => None,
        }
    }
}

impl PlaceOp {
    pub(super) fn new(plan: &Plan, edge: usize, backward: bool) -> Self {
        let plan_edge = &plan.edges[edge];
        let [from, to] = plan_edge.ends(backward);
        let orientation = &plan.orientations[plan_edge.orientation];
        let kind = match (plan_edge.along, plan_edge.leg, plan_edge.on_leg) {
            (EdgeSlide::Nothing, Some(leg), _) => {
                PlaceKind::Leg { leg: leg.index, negative: leg.backward != backward }
            }
            (EdgeSlide::Nothing, None, Some(leg)) => PlaceKind::OnLeg { leg },
            (EdgeSlide::Nothing, ..) => match orientation.single_driver {
                Some((driver, conj)) if plan_edge.class == 0 => PlaceKind::Crank { driver, conj },
                _ => PlaceKind::Rigid { orientation: plan_edge.orientation },
            },
            _ => PlaceKind::Along,
        };
        let from_ground = plan.fixed[from];
        Self {
            edge,
            class: plan_edge.class,
            from,
            to,
            backward,
            kind,
            from_ground,
            is_used: true,
            is_recorded: true,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::mechanism::Mechanism;
    use crate::{FourBar, FourBarMode, SliderCrank};

    fn tape(mechanism: &Mechanism, points: &[usize], classes: &[usize]) -> Tape {
        let plan = mechanism.plan();
        let needed = |count: usize, list: &[usize]| -> Vec<bool> {
            (0..count).map(|index| list.contains(&index)).collect()
        };
        let (points, classes) = (needed(plan.points, points), needed(plan.classes, classes));
        Tape::new(
            plan,
            Needs { points: &points, classes: &classes, orientations: &[], samples: false },
        )
    }

    #[test]
    fn an_angle_of_a_four_bar_needs_one_point_and_one_rotation() {
        let mechanism = Mechanism::new(&FourBar::description(FourBarMode::Open))
            .unwrap_or_else(|error| panic!("{error}"));
        let of_rocker = tape(&mechanism, &[], &[2]);
        let [Op::Place(pin), Op::TwoLegs(dyad)] = &of_rocker.ops[..] else {
            panic!("{of_rocker:?}")
        };
        assert_eq!(pin.kind, PlaceKind::Crank { driver: 0, conj: false });
        // The dyad finds its chord from the crank itself.
        assert!(!pin.is_used && dyad.pin.is_some() && dyad.keeps == [false; 2]);
        assert_eq!((dyad.turns, dyad.orientations.len()), ([false, true], 0));
        assert!(of_rocker.driven.is_empty() && of_rocker.is_bounded);
        // All joints and no other points.
        assert_eq!(Tape::whole(mechanism.plan()).ops.len(), 3);
    }

    #[test]
    fn a_slide_needs_no_point_on_it() {
        let mechanism =
            Mechanism::new(&SliderCrank::description()).unwrap_or_else(|error| panic!("{error}"));
        let of_slide = tape(&mechanism, &[], &[]);
        let [Op::Place(_), Op::StandingGuide(dyad)] = &of_slide.ops[..] else {
            panic!("{of_slide:?}")
        };
        assert_eq!(dyad.turns, [false, false]);
    }
}
