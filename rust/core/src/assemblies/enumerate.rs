//! All assemblies of a mechanism at one coordinate: the two of each dyad in closed form, those of each
//! group above class II by homotopy, one after another in the order of the plan.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use super::assembly::{Assemblies, Assembly, PathFailure};
use super::forms::GroupForms;
use super::parameters::parameters;
use super::solutions::{GroupFibres, PathEnd, unknowns};
use crate::batch::request::{Coordinates, Motion, Outputs, Request, Series};
use crate::branch::constant_signs::SignConstancy;
use crate::branch::design::Design;
use crate::description::error::SolveError;
use crate::math::derivatives::DerivativeTables;
use crate::math::vector::Vector;
use crate::plan::dyad::{Dyad, Unknown};
use crate::plan::group::Group;
use crate::plan::mechanism::Mechanism;
use crate::plan::plan::Step;
use crate::state::state::{Context, State};
use crate::state::status::{Fault, Status};
use crate::structure::closure::point_of_joint;

/// Where a dyad or group is flat, two assemblies nearer than this (relative to the size) are one: beside a
/// dead point half of all digits are lost.
const DOUBLE: f64 = 1.0e-8;
/// Greatest distance (rad, or in sizes) that Newton's iteration may lead from the end of a path. Beside a
/// dead point that end is good to half of all digits.
const CONFIRMED: f64 = 1.0e-5;

/// Results nearer than this (rad, or relative to the size) are the same assembly, found in two ways.
const SAME: f64 = 1.0e-6;
/// Most signs whose combinations are tried.
const MOST_TRIED: usize = 8;

/// The fibres of all groups of a mechanism, in order.
struct Fibres(Vec<GroupFibres>);

/// A step with several solutions.
enum Choice<'p> {
    Sign { sign: usize, step: usize },
    Group { group: &'p Group, step: usize },
}

impl Choice<'_> {
    fn step(&self) -> usize {
        match *self {
            Self::Sign { step, .. } | Self::Group { step, .. } => step,
        }
    }
}

impl Mechanism {
    /// Every assembly that exists at `q`.
    ///
    /// # Errors
    ///
    /// Slices of the wrong length, a coordinate too far from the drawing, a group with more assemblies
    /// than the method can find, or [`SolveError::Interrupted`] once `cancel` is true.
    pub fn assemblies(
        &self,
        dimensions: &[f64],
        q: &[f64],
        cancel: Option<&AtomicBool>,
    ) -> Result<Assemblies, SolveError> {
        let count = self.plan().signs();
        self.check(dimensions, q, &vec![1; count])?;
        if self.dimensions().first_fault(dimensions).is_some() || q.len() != self.q0().len() {
            return Ok(Assemblies::default());
        }
        let fibres = self.fibres();
        let derivatives = DerivativeTables::shared(q.len(), 1);
        let mut design = Design::new(self, &vec![1; count], &derivatives);
        design.bind(dimensions);
        let scaled = design.scaled(q);
        if design.is_too_far(&scaled) {
            return Err(SolveError::CoordinateTooFar { q: q.to_vec() });
        }
        let state = design.state(&derivatives);
        let mut search = Search {
            design: &design,
            fibres: &fibres,
            derivatives: &derivatives,
            scaled: &scaled,
            choices: choices(self),
            signs: vec![1.0; count],
            unknowns: vec![0.0; self.plan().groups().map(|group| group.unknowns.len()).sum()],
            state,
            cancel,
            assemblies: Assemblies {
                complex_counts: fibres.0.iter().map(GroupFibres::count).collect(),
                ..Assemblies::default()
            },
            places: Vec::new(),
        };
        search.complete(0, false)?;
        let mut assemblies = search.assemblies;
        if !design.has_groups() {
            let mut constancy = SignConstancy::new(&mut design);
            for assembly in &mut assemblies.found {
                if cancel.is_some_and(|flag| flag.load(Ordering::Relaxed)) {
                    return Err(SolveError::Interrupted);
                }
                let signs: Vec<f64> = assembly.signs.iter().map(|&sign| f64::from(sign)).collect();
                if !constancy.holds(&signs) {
                    let back = constancy.design.signs_at_drawing(&signs, &scaled);
                    assembly.signs = self.leading_to(assembly, back, (dimensions, q))?;
                }
            }
        }
        Ok(assemblies)
    }

    /// The signs at the drawing that lead to an assembly: those traced back, unless rounding beside a
    /// change point on the way decides otherwise on the way forward.
    fn leading_to(
        &self,
        assembly: &Assembly,
        back: Vec<i8>,
        (dimensions, q): (&[f64], &[f64]),
    ) -> Result<Vec<i8>, SolveError> {
        let outputs = Outputs::all(self);
        let lead = |signs: &[i8]| {
            let coordinates = Coordinates::Shared(q);
            let request = Request { dimensions, coordinates, signs, order: 0, outputs: &outputs };
            Ok(is_there(&self.solve(&request)?, assembly))
        };
        if lead(&back)? || back.len() > MOST_TRIED {
            return Ok(back);
        }
        for choice in 1..1_u32 << back.len() {
            let flipped = |(i, &sign): (usize, &i8)| {
                if choice >> i & 1 == 1 && !self.plan().is_length(i) { -sign } else { sign }
            };
            let signs: Vec<i8> = back.iter().enumerate().map(flipped).collect();
            if lead(&signs)? {
                return Ok(signs);
            }
        }
        Ok(back)
    }

    /// The fibres of random dimensions, found once.
    fn fibres(&self) -> Arc<Fibres> {
        self.number.share(
            |_: &Fibres| true,
            || {
                let derivatives = DerivativeTables::shared(self.q0().len(), 0);
                let mut drawing = Design::new(self, self.signs(), &derivatives);
                drawing.bind(self.drawing());
                let mut state = drawing.state(&derivatives);
                for (class, &angle) in state.pose.class.iter_mut().zip(&self.class_angle) {
                    *class = [Vector::at_angle(angle)];
                }
                for (slide, &value) in self.slide_value.iter().enumerate() {
                    state.pose.slides[slide * state.len][0] = value / drawing.constants.scale;
                }
                let cx = drawing.context(&derivatives);
                state.solve(&cx, &drawing.q0);
                let group_fibres = |group| {
                    let forms = GroupForms::new(self.plan(), group);
                    let drawn = parameters(&forms, group, &cx, &state);
                    GroupFibres::new(forms, &drawn)
                };
                Fibres(self.plan().groups().map(group_fibres).collect())
            },
        )
    }
}

/// Whether a motion of one position is in an assembly.
fn is_there(motion: &Motion, assembly: &Assembly) -> bool {
    // The spread of the joints: their place in the drawing's coordinates does not show the size.
    let spread = |axis: usize| {
        let values = assembly.joints.iter().map(|joint| joint[axis]);
        let [low, high] = values
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)]);
        high - low
    };
    let slides = assembly.slides.iter().fold(0.0, |high: f64, value| high.max(value.abs()));
    let size = spread(0).max(spread(1)).max(slides);
    let near = |value: f64, expected: f64| (value - expected).abs() <= SAME * size;
    let joint = |series: &Series| {
        let [x, y] = assembly.joints[series.index];
        near(series.derivatives[0][0], x) && near(series.derivatives[0][1], y)
    };
    let slide = |series: &Series| near(series.derivatives[0][0], assembly.slides[series.index]);
    let link = |series: &Series| {
        let gap = (series.derivatives[0][0] - assembly.angles[series.index]) / TAU;
        (gap - gap.round()).abs() * TAU <= SAME
    };
    motion.joints.iter().all(joint)
        && motion.slides.iter().all(slide)
        && motion.links.iter().all(link)
}

fn choices(mechanism: &Mechanism) -> Vec<Choice<'_>> {
    let mut choices = Vec::new();
    for (index, step) in mechanism.plan().steps.iter().enumerate() {
        match step {
            Step::Dyad(dyad) => {
                let sign = dyad.sign.filter(|_| !dyad.is_length);
                choices.extend(sign.map(|sign| Choice::Sign { sign, step: index }));
            }
            Step::Group(group) => choices.push(Choice::Group { group, step: index }),
            _ => {}
        }
    }
    choices
}

/// A search through all choices, depth first.
struct Search<'s> {
    design: &'s Design<'s>,
    fibres: &'s Fibres,
    derivatives: &'s DerivativeTables,
    scaled: &'s [f64],
    choices: Vec<Choice<'s>>,
    /// The choices so far.
    signs: Vec<f64>,
    unknowns: Vec<f64>,
    state: State,
    cancel: Option<&'s AtomicBool>,
    assemblies: Assemblies,
    /// Points and rotations of the assemblies so far, in sizes.
    places: Vec<Vec<Vector>>,
}

impl Search<'_> {
    /// Completes the choices from the one at `index` on.
    fn complete(&mut self, index: usize, is_double: bool) -> Result<(), SolveError> {
        if self.cancel.is_some_and(|flag| flag.load(Ordering::Relaxed)) {
            return Err(SolveError::Interrupted);
        }
        let Some(choice) = self.choices.get(index) else {
            self.solve();
            self.note_loose();
            self.add(is_double);
            return Ok(());
        };
        match *choice {
            Choice::Sign { sign, .. } => {
                for value in [1.0, -1.0] {
                    self.signs[sign] = value;
                    if index + 1 == self.choices.len() || self.reaches(index + 1) {
                        self.complete(index + 1, is_double)?;
                    }
                }
                self.signs[sign] = 1.0;
            }
            Choice::Group { group, .. } => self.complete_group(index, group, is_double)?,
        }
        Ok(())
    }

    /// Notes a dyad whose outer joints coincide and whose links fit: it turns freely.
    fn note_loose(&mut self) {
        let Some(Fault::NotClosed { step, gap: 0.0 }) = self.state.fault else { return };
        let mechanism = self.design.mechanism;
        if let Step::Dyad(Dyad { sign: Some(sign), .. }) = mechanism.plan().steps[step] {
            let group = mechanism.plan().dyad_groups[sign].clone();
            let failure = PathFailure { group, end: PathEnd::Loose };
            if !self.assemblies.failures.contains(&failure) {
                self.assemblies.failures.push(failure);
            }
        }
    }

    /// Solves the position as chosen; whether nothing fails before a choice.
    fn reaches(&mut self, index: usize) -> bool {
        self.solve();
        self.note_loose();
        let step = self.choices[index].step();
        !self.state.has_failed() || self.state.fault.is_some_and(|fault| fault.step() >= step)
    }

    fn context(&self) -> Context<'_> {
        Context { signs: &self.signs, ..self.design.context(self.derivatives) }
    }

    fn solve(&mut self) {
        let plan = self.design.mechanism.plan();
        let unknowns = plan.groups().flat_map(|group| &group.unknowns);
        for (&unknown, &value) in unknowns.zip(&self.unknowns) {
            match unknown {
                Unknown::Class(class) => self.state.pose.class[class][0] = Vector::at_angle(value),
                Unknown::Slide(slide) => self.state.pose.slides[slide * self.state.len][0] = value,
            }
        }
        let cx = Context { signs: &self.signs, ..self.design.context(self.derivatives) };
        self.state.solve(&cx, self.scaled);
    }

    fn complete_group(
        &mut self,
        index: usize,
        group: &Group,
        is_double: bool,
    ) -> Result<(), SolveError> {
        let group_fibres = &self.fibres.0[group.index];
        if group_fibres.fibres.is_empty() {
            return Err(SolveError::TooManyAssemblies { group: group.name.clone() });
        }
        if !self.reaches(index) {
            return Ok(());
        }
        let parameters = parameters(&group_fibres.forms, group, &self.context(), &self.state);
        let solutions = group_fibres.solutions(&parameters);
        let fail = |end| PathFailure { group: group.name.clone(), end };
        self.assemblies.failures.extend(solutions.failures.iter().copied().map(fail));
        let plan = self.design.mechanism.plan();
        let earlier = plan.groups().take(group.index).map(|group| group.unknowns.len());
        let first: usize = earlier.sum();
        let step = self.choices[index].step();
        for solution in solutions.real() {
            let is_multiple = solution.is_multiple;
            let values = unknowns(&group_fibres.forms, &parameters, &solution.point);
            self.unknowns[first..first + values.len()].copy_from_slice(&values);
            self.solve();
            let failed = self.state.has_failed()
                && self.state.fault.is_none_or(|fault| fault.step() <= step);
            if failed || !self.confirms(group, &values) {
                if !is_multiple {
                    self.assemblies.failures.push(fail(PathEnd::Unconfirmed));
                }
                continue;
            }
            self.complete(index + 1, is_double || is_multiple)?;
        }
        Ok(())
    }

    /// Whether Newton's iteration of the real closures has led to these values.
    fn confirms(&self, group: &Group, values: &[f64]) -> bool {
        group.unknowns.iter().zip(values).all(|(&unknown, &value)| {
            let error = match unknown {
                Unknown::Class(class) => {
                    (self.state.pose.class[class][0] - Vector::at_angle(value)).norm()
                }
                Unknown::Slide(slide) => {
                    let solved = self.state.pose.slides[slide * self.state.len][0];
                    (solved - value).abs() / value.abs().max(1.0)
                }
            };
            error <= CONFIRMED
        })
    }

    /// Adds the position just solved, if it exists.
    fn add(&mut self, is_double: bool) {
        let state = &self.state;
        if matches!(state.status, Status::Unreachable | Status::BadInput | Status::NotConverged) {
            return;
        }
        let points = state.pose.points.chunks_exact(state.len).map(|jet| jet[0][0]);
        let place: Vec<Vector> =
            points.chain(state.pose.class.iter().map(|unit| unit[0])).collect();
        let size = place.iter().map(|p| p.size()).fold(1.0, f64::max);
        let is_same = |other: &Vec<Vector>| {
            place.iter().zip(other).all(|(&a, &b)| (a - b).size() <= DOUBLE * size)
        };
        let mut is_double = is_double;
        if let Some(index) = self.places.iter().position(is_same) {
            self.assemblies.found[index].is_double = true;
            if self.design.has_groups() {
                return;
            }
            // Elsewhere their signs differ.
            is_double = true;
        }
        let assembly = self.assembly(is_double);
        self.assemblies.found.push(assembly);
        self.places.push(place);
    }

    /// The position just solved.
    fn assembly(&self, is_double: bool) -> Assembly {
        let (mechanism, state) = (self.design.mechanism, &self.state);
        let constants = &self.design.constants;
        let joint = |joint: usize| {
            let point = state.pose.points[point_of_joint(joint) * state.len][0];
            let [x, y] = constants.origin;
            [point.x * constants.scale + x, point.y * constants.scale + y]
        };
        let slides = state.pose.slides.chunks_exact(state.len);
        let angle = |link: usize| {
            let rotation = &mechanism.plan().rotation[link];
            let turns = rotation.turns.iter().zip(self.scaled);
            let driven: f64 = turns.map(|(&turns, q)| f64::from(turns) * q).sum();
            let class = state.pose.class[rotation.class][0].angle();
            let angle = class + constants.offset[link] + driven;
            angle - TAU * ((angle - PI) / TAU).ceil()
        };
        Assembly {
            signs: self.signs.iter().map(|&sign| if sign > 0.0 { 1 } else { -1 }).collect(),
            class_angles: state.pose.class.iter().map(|unit| unit[0].angle()).collect(),
            slides: slides.map(|jet| jet[0][0] * constants.scale).collect(),
            joints: (0..mechanism.linkage().joints.len()).map(joint).collect(),
            angles: (0..mechanism.linkage().links.len()).map(angle).collect(),
            is_double,
        }
    }
}
