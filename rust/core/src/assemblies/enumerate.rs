//! All assemblies of a mechanism at one coordinate: the two of each dyad in closed form, those of each
//! group above class II by homotopy, one after another in the order of the plan.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use super::assembly::{Assemblies, Assembly, PathFailure};
use super::drawing_signs::DrawingSigns;
use super::forms::GroupForms;
use super::parameters::parameters;
use super::solutions::{GroupFibres, PathEnd, unknowns};
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

/// Where a dyad or group is flat, two assemblies nearer than this (relative to the size) are one: beside a
/// dead point half of all digits are lost.
const DOUBLE: f64 = 1.0e-8;
/// Greatest distance (rad, or in sizes) that Newton's iteration may lead from the end of a path. Beside a
/// dead point that end is good to half of all digits.
const CONFIRMED: f64 = 1.0e-5;

/// The fibres of all groups of a mechanism, in order.
#[derive(Debug)]
pub(crate) struct Fibres(Vec<GroupFibres>);

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
        if design.is_too_far(&design.scaled(q)) {
            return Err(SolveError::CoordinateTooFar { q: q.to_vec() });
        }
        let mut state = design.state(&derivatives);
        let search = (&*fibres, Search::Followed);
        let mut assemblies = poses(&design, &mut state, search, q, cancel)?;
        if !design.has_groups() {
            let mut drawing_signs = DrawingSigns::default();
            for assembly in &mut assemblies.found {
                if cancel.is_some_and(|flag| flag.load(Ordering::Relaxed)) {
                    return Err(SolveError::Interrupted);
                }
                drawing_signs.trace((&mut design, dimensions), assembly, q)?;
            }
        }
        Ok(assemblies)
    }

    /// The fibres of random dimensions, found once.
    pub(crate) fn fibres(&self) -> Arc<Fibres> {
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

/// How the assemblies of a group above class II are found. Both ways find the same ones, to rounding.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Search {
    /// By homotopy.
    Followed,
    /// By elimination, where that is certain to find them all.
    Quick,
}

/// Every assembly of a bound design at `q`, with the signs that it has there; `state`: its work space.
pub(crate) fn poses(
    design: &Design<'_>,
    state: &mut State,
    (fibres, search): (&Fibres, Search),
    q: &[f64],
    cancel: Option<&AtomicBool>,
) -> Result<Assemblies, SolveError> {
    let mechanism = design.mechanism;
    let scaled = design.scaled(q);
    let mut tree = Tree {
        design,
        fibres,
        search,
        scaled: &scaled,
        choices: choices(mechanism),
        signs: vec![1.0; mechanism.plan().signs()],
        unknowns: vec![0.0; mechanism.plan().groups().map(|group| group.unknowns.len()).sum()],
        state,
        cancel,
        assemblies: Assemblies {
            complex_counts: fibres.0.iter().map(GroupFibres::count).collect(),
            ..Assemblies::default()
        },
        places: Vec::new(),
    };
    tree.complete(0, false)?;
    Ok(tree.assemblies)
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

/// All choices, completed depth first.
struct Tree<'s> {
    design: &'s Design<'s>,
    fibres: &'s Fibres,
    search: Search,
    scaled: &'s [f64],
    choices: Vec<Choice<'s>>,
    /// The choices so far.
    signs: Vec<f64>,
    unknowns: Vec<f64>,
    state: &'s mut State,
    cancel: Option<&'s AtomicBool>,
    assemblies: Assemblies,
    /// Points and rotations of the assemblies so far, in sizes.
    places: Vec<Vec<Vector>>,
}

impl Tree<'_> {
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
        Context { signs: &self.signs, ..self.design.context(self.design.derivatives) }
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
        let cx = Context { signs: &self.signs, ..self.design.context(self.design.derivatives) };
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
        let parameters = parameters(&group_fibres.forms, group, &self.context(), self.state);
        let solutions = match self.search {
            Search::Followed => group_fibres.solutions(&parameters),
            Search::Quick => group_fibres.quick_solutions(&parameters),
        };
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
        let state = &*self.state;
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
        self.assemblies.found.push(Assembly::of(
            self.design,
            self.state,
            &self.signs,
            self.scaled,
            is_double,
        ));
        self.places.push(place);
    }
}
