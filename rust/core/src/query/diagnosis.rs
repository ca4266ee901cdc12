//! Why a position came out as it did: status, residual, condition and a sentence.

use crate::branch::design::Design;
use crate::description::error::{SolveError, number};
use crate::math::derivatives::DerivativeTables;
use crate::plan::mechanism::Mechanism;
use crate::plan::plan::{EdgeSlide, Plan, Step};
use crate::state::state::State;
use crate::state::status::{Fault, Status};

/// If a joint is farther (in sizes) than this at the end of a branch, the distance ended it, not a
/// dead point: the condition of a group grows with its square, so no branch is followed all the way
/// to a pole.
const FAR_JOINT: f64 = 100.0;

/// A position examined closely.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagnosis {
    /// How the position came out.
    pub status: Status,
    /// Greatest loop-closure error at the computed position, relative to the size; NaN without a
    /// position.
    pub residual: f64,
    /// Product of the conditions along the worst chain of dyads; NaN without a position.
    pub condition: f64,
    /// Gap of the dyad or redundant link that does not close, relative to the size; NaN if all do.
    pub gap: f64,
    /// The dyad (inner joint or slide), group, redundant link or dimension concerned.
    pub name: Option<String>,
    /// The step of the plan concerned.
    pub step: Option<usize>,
    /// What happened, with numbers.
    pub sentence: String,
}

impl Diagnosis {
    /// Only a status and a sentence.
    fn bare(status: Status, sentence: String) -> Self {
        let nothing = f64::NAN;
        let (residual, condition, gap) = (nothing, nothing, nothing);
        Self { status, residual, condition, gap, name: None, step: None, sentence }
    }
}

impl Mechanism {
    /// Examines every position of one design closely (`q`: drivers fastest).
    ///
    /// # Errors
    ///
    /// Slices of the wrong length.
    pub fn diagnose(
        &self,
        dimensions: &[f64],
        q: &[f64],
        signs: &[i8],
    ) -> Result<Vec<Diagnosis>, SolveError> {
        self.check(dimensions, q, signs)?;
        let drivers = self.q0().len();
        if let Some(fault) = self.dimensions().first_fault(dimensions) {
            let name = match &fault {
                SolveError::BadDimension { name, .. } => Some(name.clone()),
                _ => None,
            };
            let one =
                Diagnosis { name, ..Diagnosis::bare(Status::BadDimension, fault.to_string()) };
            return Ok(vec![one; q.len() / drivers]);
        }
        let derivatives = DerivativeTables::new(drivers, 0);
        let mut design = Design::new(self, signs, &derivatives);
        design.bind(dimensions);
        design.trace(q);
        let mut state = design.state(&derivatives);
        let diagnose = |(scaled, q): (&[f64], &[f64])| {
            let analogues = design.solve(&mut state, scaled, design.branch_to(scaled).as_ref());
            self.describe(&design, &state, &derivatives, q, analogues)
        };
        Ok(design
            .scaled(q)
            .chunks_exact(drivers)
            .zip(q.chunks_exact(drivers))
            .map(diagnose)
            .collect())
    }

    fn describe(
        &self,
        design: &Design<'_>,
        state: &State,
        derivatives: &DerivativeTables,
        q: &[f64],
        analogues: bool,
    ) -> Diagnosis {
        let at = &coordinate_text(q);
        let step = state.fault.map(Fault::step);
        let condition = state.condition2[0].sqrt();
        let named = state.fault.map(|fault| self.step_name(fault));
        let dyad = named.as_deref().unwrap_or("?");
        let sentence = match state.status {
            Status::BadInput => {
                let why = if q.iter().any(|x| !x.is_finite()) {
                    "is no number: a finite coordinate is needed"
                } else {
                    "is too far from the drawing to be followed with several drivers: at most 1000 turns, or a slide 3000 times the size"
                };
                return Diagnosis::bare(Status::BadInput, format!("q = {at} {why}"));
            }
            Status::Lost => {
                return Diagnosis::bare(Status::Lost, self.lost_sentence(design, q, at));
            }
            Status::Unreachable | Status::NotConverged => {
                let (name, sentence) = self.unreachable_sentence(state, design.constants.scale, at);
                let gap = match state.fault {
                    Some(Fault::NotClosed { gap, .. } | Fault::RedundantMisfit { gap, .. }) => gap,
                    _ => f64::NAN,
                };
                let bare = Diagnosis::bare(state.status, sentence);
                return Diagnosis { name: Some(name), step, gap, ..bare };
            }
            Status::Singular if analogues => format!(
                "at q = {at} dyad {dyad:?} is flat: a change point, the smooth motion goes on through it"
            ),
            Status::Singular => format!(
                "at q = {at} dyad {dyad:?} is flat: the position is given, its analogues do not exist"
            ),
            Status::NearSingular => format!(
                "at q = {at} the condition is {condition:.1e}: fewer than 6 digits of the analogues remain"
            ),
            _ => format!("at q = {at} the position is solved, condition {condition:.1e}"),
        };
        let residual = state.residual(&design.context(derivatives));
        let gap = f64::NAN;
        Diagnosis { status: state.status, residual, condition, gap, name: named, step, sentence }
    }

    /// Refuses slices whose lengths do not fit this mechanism.
    pub(super) fn check(
        &self,
        dimensions: &[f64],
        q: &[f64],
        signs: &[i8],
    ) -> Result<(), SolveError> {
        let fits = dimensions.len() == self.dimensions().len()
            && q.len().is_multiple_of(self.q0().len())
            && signs.len() == self.plan().signs();
        if fits {
            return Ok(());
        }
        Err(SolveError::Shape(format!(
            "{} dimensions, {} coordinates and {} signs were given; this mechanism has {}, {} and {}",
            dimensions.len(),
            q.len(),
            signs.len(),
            self.dimensions().len(),
            self.q0().len(),
            self.plan().signs()
        )))
    }

    fn step_name(&self, fault: Fault) -> String {
        match &self.plan().steps[fault.step()] {
            Step::Dyad(dyad) => match dyad.sign {
                Some(sign) => self.plan().dyad_names[sign].clone(),
                None => guides_name(self.plan(), self, dyad),
            },
            Step::Group(group) => group.name.clone(),
            Step::Redundant(fit) => fit.name.clone(),
            Step::Place { .. } => String::new(),
        }
    }

    /// Why the branch from the drawing does not lead to a position.
    fn lost_sentence(&self, design: &Design<'_>, q: &[f64], at: &str) -> String {
        let groups: Vec<&str> = self.plan().groups().map(|group| group.name.as_str()).collect();
        if groups.is_empty() {
            return format!(
                "at q = {at} the assembly is unknown: its signs do not return within 64 turns"
            );
        }
        let groups = groups.join(" → ");
        if let Err(part) = design.initial_unknowns {
            return format!(
                "cannot track the assembly from the drawing to these dimensions: {groups} reaches a dead point {:.4} % of the way; use smaller steps, or draw the mechanism with these dimensions",
                100.0 * part
            );
        }
        match design.branch.covered {
            Some([low, high])
                if low <= high && low.is_finite() && design.units.coordinate.len() == 1 =>
            {
                let unit = design.units.coordinate[0];
                let reach = [low, high].map(|end| number(end / unit));
                let reach = format!("from {} to {}", reach[0], reach[1]);
                let end = if q[0] * unit < low { low } else { high };
                let away = design.max_distance(end);
                if away > FAR_JOINT {
                    return format!(
                        "q = {at} cannot be reached: the motion of {groups} is tracked from the drawing {reach}, where a joint is {away:.0} times the mechanism's size away"
                    );
                }
                format!(
                    "q = {at} is beyond a dead point (or a place where two branches cross or a joint goes to infinity): from the drawing the motion of {groups} reaches {reach}; another driver (with_driver) leads on"
                )
            }
            _ => format!(
                "q = {at} cannot be reached: on the straight path from the drawing {groups} reaches a dead point"
            ),
        }
    }

    fn unreachable_sentence(&self, state: &State, scale: f64, at: &str) -> (String, String) {
        let Some(fault) = state.fault else {
            return (String::new(), format!("q = {at} cannot be reached"));
        };
        let name = self.step_name(fault);
        let sentence = match fault {
            Fault::RedundantMisfit { gap, .. } => format!(
                "at q = {at} the redundant {name:?} does not fit: it misses by {} m",
                rounded(gap * scale)
            ),
            Fault::NotClosed { gap: 0.0, .. } => format!(
                "at q = {at} dyad {name:?} has coinciding outer joints, or a leg of no length: its links may stand in any direction"
            ),
            Fault::NotClosed { gap, step } if !gap.is_finite() => match &self.plan().steps[step] {
                Step::Dyad(dyad) if dyad.sign.is_none() => {
                    format!("at q = {at} the guides {name:?} are parallel")
                }
                _ => format!(
                    "at q = {at} dyad {name:?} cannot be assembled: its links are far too short to meet"
                ),
            },
            Fault::NotClosed { gap, .. } => format!(
                "at q = {at} dyad {name:?} cannot be assembled: its links are {} m too short to meet",
                rounded(gap * scale)
            ),
            Fault::Singular { .. } => format!("at q = {at} dyad {name:?} is flat"),
            Fault::NotConverged { .. } => {
                format!("at q = {at} the iteration of the group {name:?} did not converge")
            }
        };
        (name, sentence)
    }
}

/// A number to four digits, without an exponent where it reads well.
fn rounded(x: f64) -> String {
    number(format!("{x:.3e}").parse().unwrap_or(x))
}

fn guides_name(plan: &Plan, mechanism: &Mechanism, dyad: &crate::plan::dyad::Dyad) -> String {
    let slides: Vec<&str> = dyad
        .path
        .iter()
        .filter_map(|part| match plan.edges[part.edge].along {
            EdgeSlide::Slide(s) => Some(mechanism.linkage().slides[s].name.as_str()),
            _ => None,
        })
        .collect();
    slides.join("-")
}

pub(super) fn coordinate_text(q: &[f64]) -> String {
    match q {
        [one] => number(*one),
        many => format!("({})", many.iter().map(|&x| number(x)).collect::<Vec<_>>().join(", ")),
    }
}
