//! Why a position cannot be computed: the reason with its names and numbers, from what the solver
//! left behind.

use std::fmt;

use strum::{IntoStaticStr, VariantNames};
use thiserror::Error;

use super::folding::{fold_of, folding_step};
use crate::branch::design::Design;
use crate::description::error::{
    Hint, Named, SolveError, TOO_FAR, coordinate_text, number, rounded,
};
use crate::plan::mechanism::Mechanism;
use crate::plan::plan::{EdgeSlide, Step};
use crate::state::status::{Fault, Rejection, Status};

/// If a joint is farther (in sizes) than this at the end of a branch, the distance ended it, not a
/// dead point: the condition of a group grows with its square, so a branch is never followed all the way
/// to a pole.
const FAR_JOINT: f64 = 100.0;

/// A coordinate without a position, or a position without analogues.
#[derive(Debug, Clone, PartialEq)]
pub struct Failure {
    /// Status of the position.
    pub status: Status,
    /// Coordinates of the drivers, rad or m.
    pub q: Vec<f64>,
    /// The reason.
    pub reason: Reason,
}

/// An Assur group: a dyad by its inner joint or slide, a higher one by class and links.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct GroupName {
    /// Its name.
    pub name: String,
    /// Whether the name is that of a joint or of a slide.
    pub inner: Option<Named>,
    /// Whether it is of class II.
    pub is_dyad: bool,
}

impl fmt::Display for GroupName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_dyad {
            write!(f, "dyad {:?}", self.name)
        } else {
            write!(f, "group {}", self.name)
        }
    }
}

/// The reason of a failed position; it begins with the verb or the subject after "at q = …".
#[derive(Debug, Clone, PartialEq, Error, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "snake_case")]
#[non_exhaustive]
#[expect(missing_docs, reason = "the sentences say what the fields are")]
pub enum Reason {
    /// A dimension of the design is not finite, out of range or not positive.
    #[error("{0}")]
    BadDimension(SolveError),
    /// A coordinate is NaN or infinite.
    #[error("a finite coordinate is needed")]
    CoordinateNotFinite,
    /// With several drivers, a coordinate too far from the drawing.
    #[error("{TOO_FAR}")]
    CoordinateTooFar,
    /// The links of a dyad do not meet.
    #[error("{group} cannot be assembled: its links miss each other by {} m", rounded(*gap, 4))]
    NotClosed { group: GroupName, gap: f64 },
    /// The distance that the links of a dyad must span is infinite.
    #[error("{group} cannot be assembled: it would have to span more than 1e154 times the size")]
    TooFarApart { group: GroupName },
    /// Both outer joints of a dyad coincide, or a leg has no length.
    #[error(
        "{group} has coinciding outer joints, or a leg of length zero: its links can point in any direction"
    )]
    Undetermined { group: GroupName },
    /// The two guides of a dyad are parallel.
    #[error("the guides of {} are parallel and do not cross", all_quoted(slides))]
    ParallelGuides { slides: Vec<String> },
    /// The value of a slide that is a length would be negative.
    #[error("{slide:?} would be {} m long: a length is never negative", rounded(*length, 4))]
    NegativeLength { slide: String, length: f64 },
    /// A slide whose value is a length is too short for a motion to be integrated.
    #[error("{slide:?} has nearly no length: it turns too sharply there to be integrated")]
    ZeroLength { slide: String },
    /// A redundant link or slide does not fit.
    #[error("the redundant {kind} {name:?} does not fit: it misses by {} m", rounded(*gap, 4))]
    RedundantMisfit { kind: Named, name: String, gap: f64 },
    /// The links of a dyad or group are in a dead position: no analogues.
    #[error("{group} is flat: the position exists, but its analogues do not")]
    Flat { group: GroupName },
    /// Newton's method did not converge for a group.
    #[error("the iteration of {group} did not converge")]
    NotConverged { group: GroupName },
    /// Beside a dead point, too close for a motion to be integrated.
    #[error("is beside a dead point{}", group.as_ref().map_or(String::new(), |group| format!(", where {group} folds")))]
    BesideDeadPoint { group: Option<GroupName> },
    /// Beside a near miss of a change point, too close for a motion to be integrated.
    #[error(
        "{group} nearly has a change point: the motion turns too sharply there to be integrated"
    )]
    NearChangePoint { group: GroupName },
    /// The signs of a driven angle do not return.
    #[error("the assembly is unknown: its signs do not repeat within 64 turns of the driver")]
    SignsDoNotReturn,
    /// Too long a step of several drivers.
    #[error(
        "is too far from the position before: with several drivers a step may be 50 rad, or 50 times the mechanism's size"
    )]
    StepTooLong,
    /// The assembly cannot be tracked from the drawing's dimensions to those of the design.
    #[error(
        "cannot track the assembly from the drawing to these dimensions: {} reaches a dead point {:.4} % of the way",
        group_list(groups), 100.0 * part
    )]
    DesignNotTracked { groups: Vec<String>, part: f64 },
    /// Beyond a dead point of the groups above class II.
    #[error(
        "cannot be reached: from the drawing, the motion of {} ends at q = {}, at a dead point or where two branches cross or a joint goes to infinity",
        group_list(groups), number(*end)
    )]
    BeyondDeadPoint { groups: Vec<String>, end: f64 },
    /// A joint goes to infinity on the way.
    #[error(
        "cannot be reached: the motion of {} is tracked from the drawing to q = {}, where a joint is {distance:.0} times the mechanism's size away",
        group_list(groups), number(*end)
    )]
    JointGoesToInfinity { groups: Vec<String>, end: f64, distance: f64 },
    /// A dead point on the straight path from the drawing.
    #[error(
        "cannot be reached: on the straight path from the drawing, {} reaches a dead point",
        group_list(groups)
    )]
    DeadPointOnPath { groups: Vec<String> },
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (reason, q) = (&self.reason, coordinate_text(&self.q));
        match reason {
            Reason::BadDimension(_) | Reason::DesignNotTracked { .. } => reason.fmt(f),
            Reason::CoordinateNotFinite => write!(f, "q = {q}: {reason}"),
            Reason::CoordinateTooFar
            | Reason::StepTooLong
            | Reason::BesideDeadPoint { .. }
            | Reason::BeyondDeadPoint { .. }
            | Reason::JointGoesToInfinity { .. }
            | Reason::DeadPointOnPath { .. } => write!(f, "q = {q} {reason}"),
            _ => write!(f, "at q = {q}, {reason}"),
        }
    }
}

impl Hint for Failure {
    fn hint(&self) -> Option<String> {
        let hint = match &self.reason {
            Reason::DesignNotTracked { .. } => "draw the mechanism with these dimensions",
            Reason::BeyondDeadPoint { .. } => "another driver (with_driver) may lead past it",
            _ => return None,
        };
        Some(hint.into())
    }
}

impl Reason {
    /// The dyad or group concerned.
    #[must_use]
    pub fn group(&self) -> Option<&GroupName> {
        match self {
            Self::NotClosed { group, .. }
            | Self::TooFarApart { group }
            | Self::Undetermined { group }
            | Self::Flat { group }
            | Self::NotConverged { group }
            | Self::NearChangePoint { group } => Some(group),
            Self::BesideDeadPoint { group } => group.as_ref(),
            _ => None,
        }
    }
}

impl Failure {
    /// The failure of a design with a bad dimension.
    pub(crate) fn of_dimension(error: SolveError, q: &[f64]) -> Self {
        let reason = Reason::BadDimension(error);
        Self { status: Status::BadDimension, q: q.to_vec(), reason }
    }

    /// Names what failed at coordinates of a design (rad or m).
    pub(crate) fn of(design: &Design<'_>, rejection: Rejection, q: &[f64]) -> Self {
        let (mechanism, scale) = (design.mechanism, design.constants.scale);
        let reason = match rejection {
            Rejection::DeadPoint { step } => {
                Reason::BesideDeadPoint { group: step.map(|step| group_name(mechanism, step)) }
            }
            Rejection::NearMiss { step } => {
                Reason::NearChangePoint { group: group_name(mechanism, step) }
            }
            Rejection::ZeroLength { step } => {
                Reason::ZeroLength { slide: group_name(mechanism, step).name }
            }
            Rejection::Failed { fault: Some(fault), .. } => of_fault(mechanism, fault, scale),
            Rejection::Failed { status: Status::BadInput, .. } => {
                if q.iter().all(|x| x.is_finite()) {
                    Reason::CoordinateTooFar
                } else {
                    Reason::CoordinateNotFinite
                }
            }
            Rejection::Failed { .. } => of_lost(design, q),
        };
        Self { status: rejection.status(), q: q.to_vec(), reason }
    }
}

fn of_fault(mechanism: &Mechanism, fault: Fault, scale: f64) -> Reason {
    let step = fault.step();
    let group = || group_name(mechanism, step);
    match (fault, &mechanism.plan().steps[step]) {
        (Fault::RedundantMisfit { gap, .. }, _) => {
            let (kind, name) = redundant_name(mechanism, step);
            Reason::RedundantMisfit { kind, name, gap: gap * scale }
        }
        (Fault::NotClosed { gap, .. }, &Step::Length { slide }) => {
            let slide = mechanism.linkage().slides[slide].name.clone();
            Reason::NegativeLength { slide, length: -gap * scale }
        }
        (Fault::NotClosed { gap: 0.0, .. }, _) => Reason::Undetermined { group: group() },
        (Fault::NotClosed { gap, .. }, Step::Dyad(dyad))
            if !gap.is_finite() && dyad.sign.is_none() =>
        {
            Reason::ParallelGuides { slides: guides(mechanism, step) }
        }
        (Fault::NotClosed { gap, .. }, _) if !gap.is_finite() => {
            Reason::TooFarApart { group: group() }
        }
        (Fault::NotClosed { gap, .. }, _) => Reason::NotClosed { group: group(), gap: gap * scale },
        (Fault::Singular { .. }, _) => Reason::Flat { group: group() },
        (Fault::NotConverged { .. }, _) => Reason::NotConverged { group: group() },
    }
}

/// Why the branch from the drawing does not lead to a position.
fn of_lost(design: &Design<'_>, q: &[f64]) -> Reason {
    let groups: Vec<String> =
        design.mechanism.plan().groups().map(|group| group.name.clone()).collect();
    let is_single = q.len() == 1;
    if groups.is_empty() {
        return if is_single { Reason::SignsDoNotReturn } else { Reason::StepTooLong };
    }
    if let Err(part) = design.initial_unknowns {
        return Reason::DesignNotTracked { groups, part };
    }
    match design.branch.covered {
        Some([low, high]) if low <= high && low.is_finite() && is_single => {
            let unit = design.units.coordinate[0];
            let at = if q[0] * unit < low { low } else { high };
            let (end, distance) = (at / unit, design.max_distance(at));
            if distance > FAR_JOINT {
                return Reason::JointGoesToInfinity { groups, end, distance };
            }
            let mut state = design.state(design.tracing_derivatives());
            let step = folding_step(design, &mut state, at);
            let folding = step.map(|step| vec![fold_name(design.mechanism, step)]);
            Reason::BeyondDeadPoint { groups: folding.unwrap_or(groups), end }
        }
        _ => Reason::DeadPointOnPath { groups },
    }
}

/// The class and links of the dyad or group that a step of the plan solves, or its name.
fn fold_name(mechanism: &Mechanism, step: usize) -> String {
    let names = mechanism.fold_names();
    let of_fold = fold_of(mechanism.plan(), step).and_then(|fold| names.into_iter().nth(fold));
    of_fold.unwrap_or_else(|| group_name(mechanism, step).name)
}

/// Name of the dyad or group that a step of the plan solves.
pub(crate) fn group_name(mechanism: &Mechanism, step: usize) -> GroupName {
    let plan = mechanism.plan();
    let (name, is_dyad) = match &plan.steps[step] {
        Step::Dyad(dyad) => match dyad.sign {
            Some(sign) => (plan.dyad_names[sign].clone(), true),
            None => (guides(mechanism, step).join("-"), true),
        },
        Step::Group(group) => (group.name.clone(), false),
        Step::Redundant(redundant) => (redundant.name.clone(), true),
        Step::Place { .. } => (String::new(), true),
        &Step::Length { slide } => (mechanism.linkage().slides[slide].name.clone(), true),
    };
    let linkage = mechanism.linkage();
    let inner = if linkage.joints.iter().any(|joint| joint.name == name) {
        Some(Named::Joint)
    } else if linkage.slides.iter().any(|slide| slide.name == name) {
        Some(Named::Slide)
    } else {
        None
    };
    GroupName { name, inner, is_dyad }
}

/// What the redundant object of a step is, and its name.
pub(crate) fn redundant_name(mechanism: &Mechanism, step: usize) -> (Named, String) {
    let GroupName { name, inner, .. } = group_name(mechanism, step);
    (inner.unwrap_or(Named::Link), name)
}

/// The slides in the loop of a dyad.
fn guides(mechanism: &Mechanism, step: usize) -> Vec<String> {
    let plan = mechanism.plan();
    let Step::Dyad(dyad) = &plan.steps[step] else { return Vec::new() };
    let name = |part: &crate::plan::dyad::LoopTerm| match plan.edges[part.edge].along {
        EdgeSlide::Slide(slide) => Some(mechanism.linkage().slides[slide].name.clone()),
        _ => None,
    };
    dyad.path.iter().filter_map(name).collect()
}

fn all_quoted(names: &[String]) -> String {
    names.iter().map(|name| format!("{name:?}")).collect::<Vec<_>>().join(" and ")
}

/// Groups in solving order.
fn group_list(groups: &[String]) -> String {
    format!("group{} {}", if groups.len() == 1 { "" } else { "s" }, groups.join(" → "))
}
