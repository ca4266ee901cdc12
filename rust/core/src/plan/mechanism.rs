//! The compiled mechanism: description, structure, plan, assembly of the drawing.

use std::collections::{HashMap, HashSet};
use std::f64::consts::TAU;
use std::sync::atomic::AtomicBool;

use super::constants::{DesignConstants, DimensionMap};
use super::dyad::{Dyad, Form};
use super::plan::Plan;
use super::work_spaces::PlanNumber;
use crate::description::dimension::Dimensions;
use crate::description::error::{Item, Named, SolveError, StructureError, check_flag};
use crate::description::names::{mistaken_kind, suggest};
use crate::description::{Description, Driver, Linkage};
use crate::math::tolerance::FLAT_SINE;
use crate::math::vector::Vector;
use crate::structure::Structure;
use crate::structure::closure::Closure;
use crate::structure::fitted::{Fitted, fitted};

/// Treatment of dyads whose links are drawn in line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Flat {
    /// The drawing does not show their assembly: an error, unless the description names it.
    Refused,
    /// The drawing's assembly is not needed: all signs are +1.
    Positive,
}

/// A mechanism: its description, its structure, and the plan that solves it.
#[derive(Debug, Clone, PartialEq)]
pub struct Mechanism {
    pub(super) linkage: Linkage,
    structure: Structure,
    pub(super) plan: Plan,
    dimensions: Dimensions,
    pub(super) drawing: Vec<f64>,
    adjustment: f64,
    pub(super) q0: Vec<f64>,
    pub(super) signs: Vec<i8>,
    /// Indices of the dimensions of edges and slides.
    pub(crate) slots: DimensionMap,
    /// Angle of every class in the drawing.
    pub(crate) class_angle: Vec<f64>,
    /// Value of every slide in the drawing, m.
    pub(crate) slide_value: Vec<f64>,
    /// Whole turns between each link's angle in the drawing and the sum of its class's angle and
    /// offsets.
    pub(crate) whole_turns: Vec<f64>,
    pub(crate) number: PlanNumber,
}

impl Mechanism {
    /// The same mechanism, solved only by the general formulas: for derivatives of higher orders, and to
    /// compare kernels with them.
    #[doc(hidden)]
    #[must_use]
    pub fn with_general_kernels(mut self) -> Self {
        self.plan.generalize();
        self.number = PlanNumber::next();
        self
    }
}

impl Mechanism {
    /// Analyses and compiles a description; stops when `cancel` becomes true.
    ///
    /// # Errors
    ///
    /// Those of [`Mechanism::new`], and [`StructureError::Interrupted`].
    pub(crate) fn compile(
        description: &Description,
        flat: Flat,
        cancel: Option<&AtomicBool>,
    ) -> Result<Self, StructureError> {
        let linkage = Linkage::new(description)?;
        let closure = Closure::of(&linkage);
        let Fitted { linkage, structure, change } = fitted(linkage, &closure, None, cancel)?;
        let adjustment = change.length;
        let plan = Plan::new(&linkage, &closure, &structure, cancel)?;
        check_flag(cancel)?;
        let dimensions = Dimensions::of(&linkage);
        let drawing = dimensions.of_drawing(&linkage);
        let q0: Vec<f64> = linkage.drivers.iter().map(|&d| linkage.drawing_coordinate(d)).collect();
        let signs = match flat {
            Flat::Refused => drawing_signs(&linkage, &plan)?,
            Flat::Positive => vec![1; plan.signs()],
        };
        let class_angle = class_angles(&linkage, &plan);
        let slides = 0..linkage.slides.len();
        let slide_value =
            slides.map(|slide| linkage.drawing_coordinate(Driver::Slide(slide))).collect();
        let slots = DimensionMap::new(&plan, &linkage, &closure, &dimensions);
        let constants = DesignConstants::new(&plan, &slots, &drawing);
        let whole_turns = (0..linkage.links.len())
            .map(|l| {
                let r = &plan.rotation[l];
                let driven: f64 = r.turns.iter().zip(&q0).map(|(&t, q)| f64::from(t) * q).sum();
                let angle = class_angle[r.class] + constants.offset[l] + driven;
                ((linkage.drawing_angle(l) - angle) / TAU).round()
            })
            .collect();
        Ok(Self {
            linkage,
            structure,
            plan,
            dimensions,
            drawing,
            adjustment,
            q0,
            signs,
            slots,
            class_angle,
            slide_value,
            whole_turns,
            number: PlanNumber::next(),
        })
    }

    /// The description with names resolved.
    #[must_use]
    pub fn linkage(&self) -> &Linkage {
        &self.linkage
    }

    /// Mobility, Assur groups, redundant links.
    #[must_use]
    pub fn structure(&self) -> &Structure {
        &self.structure
    }

    /// The compiled steps.
    #[must_use]
    pub(crate) fn plan(&self) -> &Plan {
        &self.plan
    }

    /// Sets, for every sign, whether its dyad can pass change points in the drawing.
    pub(crate) fn set_may_change(&mut self, may_change: Vec<bool>) {
        self.plan.may_change = may_change;
    }

    /// Names and kinds of the dimensions.
    #[must_use]
    pub fn dimensions(&self) -> &Dimensions {
        &self.dimensions
    }

    /// Dimensions of the drawing, in the order of [`Mechanism::dimensions`].
    #[must_use]
    pub fn drawing(&self) -> &[f64] {
        &self.drawing
    }

    /// The greatest distance by which a joint of the drawing was moved to make its redundant links
    /// fit, m; 0 for most drawings.
    #[must_use]
    pub fn adjustment(&self) -> f64 {
        self.adjustment
    }

    /// Coordinates of the drawing, one per driver, rad or m.
    #[must_use]
    pub fn q0(&self) -> &[f64] {
        &self.q0
    }

    /// Inner joint or slide of every dyad that has two solutions, in the order of the signs.
    #[must_use]
    pub fn dyad_names(&self) -> &[String] {
        &self.plan.dyad_names
    }

    /// The slides among them whose values are lengths: their sign is always +1.
    #[must_use]
    pub fn lengths(&self) -> Vec<&str> {
        let dyads = self.plan.dyads().filter(|dyad| dyad.is_length);
        dyads.filter_map(|dyad| dyad.sign).map(|sign| self.plan.dyad_names[sign].as_str()).collect()
    }

    /// Assembly of the drawing: +1 or −1 for every dyad that has two solutions.
    #[must_use]
    pub fn signs(&self) -> &[i8] {
        &self.signs
    }

    /// Index of a joint by name.
    ///
    /// # Errors
    ///
    /// [`SolveError::Unknown`] with the nearest names.
    pub fn joint(&self, name: &str) -> Result<usize, SolveError> {
        let (joints, links) = (&self.linkage.joints, &self.linkage.links);
        let is_link = links.iter().any(|link| link.name == name);
        let other_kind = is_link.then_some(Named::Link);
        find(name, Named::Joint, other_kind, joints.iter().map(|x| x.name.as_str()))
    }

    /// Index of a link by name.
    ///
    /// # Errors
    ///
    /// [`SolveError::Unknown`] with the nearest names.
    pub fn link(&self, name: &str) -> Result<usize, SolveError> {
        let (joints, links) = (&self.linkage.joints, &self.linkage.links);
        let is_joint = joints.iter().any(|joint| joint.name == name);
        let other_kind = is_joint.then_some(Named::Joint);
        find(name, Named::Link, other_kind, links.iter().map(|x| x.name.as_str()))
    }

    /// Index of a slide by name.
    ///
    /// # Errors
    ///
    /// [`SolveError::Unknown`] with the nearest names.
    pub fn slide(&self, name: &str) -> Result<usize, SolveError> {
        find(name, Named::Slide, None, self.linkage.slides.iter().map(|x| x.name.as_str()))
    }

    /// Index of a slide, or of a link, by name.
    ///
    /// # Errors
    ///
    /// [`SolveError::Unknown`] with the nearest names of slides and links.
    pub fn slide_or_link(&self, name: &str) -> Result<(Named, usize), SolveError> {
        let (slides, links) = (&self.linkage.slides, &self.linkage.links);
        if let Some(slide) = slides.iter().position(|slide| slide.name == name) {
            return Ok((Named::Slide, slide));
        }
        if let Some(link) = links.iter().position(|link| link.name == name) {
            return Ok((Named::Link, link));
        }
        let kind = if slides.is_empty() { Named::Link } else { Named::Slide };
        let names = slides.iter().map(|x| &x.name).chain(links.iter().map(|x| &x.name));
        let names =
            names.enumerate().filter(|(index, _)| *index != slides.len() + self.linkage.ground);
        let hint = suggest(name, names.map(|(_, name)| name.as_str()));
        Err(SolveError::Unknown { kind, name: name.into(), hint })
    }
}

fn find<'a>(
    name: &str,
    kind: Named,
    other_kind: Option<Named>,
    names: impl Iterator<Item = &'a str> + Clone,
) -> Result<usize, SolveError> {
    names.clone().position(|n| n == name).ok_or_else(|| SolveError::Unknown {
        kind,
        name: name.into(),
        hint: other_kind
            .and_then(|other_kind| mistaken_kind(name, kind, other_kind))
            .or_else(|| suggest(name, names)),
    })
}

/// Angle in the drawing of every class.
pub(super) fn class_angles(linkage: &Linkage, plan: &Plan) -> Vec<f64> {
    let mut angles = vec![0.0; plan.classes];
    for (l, r) in plan.rotation.iter().enumerate() {
        if r.class != 0 && r.slides.is_empty() && r.turns.iter().all(|&t| t == 0) {
            angles[r.class] = linkage.drawing_angle(l);
        }
    }
    angles
}

/// Assembly signs of the drawing, unless the user gives them by name.
pub(super) fn drawing_signs(linkage: &Linkage, plan: &Plan) -> Result<Vec<i8>, StructureError> {
    let names_of_dyads: HashSet<&String> = plan.dyad_names.iter().collect();
    for (name, _) in &linkage.assembly {
        if !names_of_dyads.contains(name) {
            return Err(StructureError::Unknown {
                kind: Named::Dyad,
                name: name.clone(),
                item: Item::Assembly,
                hint: suggest(name, plan.dyad_names.iter().map(String::as_str)),
            });
        }
    }
    // If a name is given twice, the last counts.
    let named_signs: HashMap<&str, i8> =
        linkage.assembly.iter().map(|(name, sign)| (name.as_str(), *sign)).collect();
    let mut signs = vec![1; plan.signs()];
    for dyad in plan.dyads() {
        let Some(sign) = dyad.sign else { continue };
        let name = &plan.dyad_names[sign];
        let named = named_signs.get(name.as_str()).copied();
        let at = |point| drawn_point(linkage, plan, point);
        let sine = sine_of_legs(plan, dyad, at, |slide| linkage.slides[slide].angle);
        signs[sign] = match named {
            Some(-1) if dyad.is_length => {
                let slide = linkage.slides.iter().position(|slide| slide.name == *name);
                let value = slide.map_or(f64::NAN, |slide| -linkage.drawing_slide(slide).0);
                return Err(StructureError::NoLength { slide: name.clone(), value });
            }
            Some(chosen) => chosen,
            None if sine.abs() >= FLAT_SINE => {
                if sine > 0.0 {
                    1
                } else {
                    -1
                }
            }
            None => {
                let is_slide = linkage.slides.iter().any(|slide| slide.name == *name);
                return Err(StructureError::FlatDyad {
                    dyad: plan.dyad_links[sign].clone(),
                    inner: if is_slide { Named::Slide } else { Named::Joint },
                    name: name.clone(),
                    sine,
                });
            }
        };
    }
    Ok(signs)
}

/// Sine of the angle between a dyad's legs, where points are `at` and guides have these angles; its sign is that
/// of the assembly.
pub(super) fn sine_of_legs(
    plan: &Plan,
    dyad: &Dyad,
    at: impl Fn(usize) -> [f64; 2],
    guide_angle: impl Fn(usize) -> f64,
) -> f64 {
    let at = |point: usize| {
        let [x, y] = at(point);
        Vector::new(x, y)
    };
    let mut terms = [Vector::ZERO; 2];
    let mut guide = Vector::ZERO;
    for term in &dyad.path {
        let edge = &plan.edges[term.edge];
        let signed = |v: Vector| if term.backward { -v } else { v };
        if let Some(unknown) = term.turns {
            terms[unknown] += signed(at(edge.edge.to) - at(edge.edge.from));
        }
        if let (Some(slide), Some(_)) = (edge.edge.slide(), term.slides) {
            guide = signed(Vector::at_angle(guide_angle(slide)));
        }
    }
    match dyad.form {
        Form::TwoCircles => terms[1].cross(terms[0]) / (terms[0].norm() * terms[1].norm()),
        Form::CircleAndLine => -guide.dot(terms[0]) / terms[0].norm(),
        Form::TurningGuide => guide.dot(terms[0]) / terms[0].norm(),
        Form::TwoLines => 1.0,
    }
}

/// Where a linkage is drawn to have a point of its plan.
pub(super) fn drawn_point(linkage: &Linkage, plan: &Plan, point: usize) -> [f64; 2] {
    match point.checked_sub(1) {
        None => [0.0; 2],
        Some(j) if j < linkage.joints.len() => linkage.joints[j].at,
        Some(_) => {
            let link = plan.reference.iter().position(|&r| r == point).unwrap_or(0);
            linkage.reference_point(link).unwrap_or([0.0; 2])
        }
    }
}
