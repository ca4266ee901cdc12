//! How a position came out: status, residual, condition, and the reason if it failed.

use std::fmt;

use super::failure::{Failure, GroupName, group_name};
use crate::branch::design::Design;
use crate::description::error::{Hint, SolveError, coordinate_text, rounded};
use crate::math::derivatives::DerivativeTables;
use crate::plan::mechanism::Mechanism;
use crate::state::state::State;
use crate::state::status::{Fault, Rejection, Status};

/// A position examined closely. Shown, it is a sentence.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagnosis {
    /// How the position came out.
    pub status: Status,
    /// Coordinates of the drivers, rad or m.
    pub q: Vec<f64>,
    /// Greatest loop-closure error at the computed position, relative to the size; NaN without a
    /// position.
    pub residual: f64,
    /// Product of the conditions along the worst chain of dyads; NaN without a position.
    pub condition: f64,
    /// Why the position or its analogues could not be computed.
    pub failure: Option<Failure>,
    /// The dyad that is flat at a change point.
    pub change_point: Option<GroupName>,
}

impl fmt::Display for Diagnosis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(failure) = &self.failure {
            return f.write_str(&failure.with_hint());
        }
        let (q, condition) = (coordinate_text(&self.q), rounded(self.condition, 2));
        match (&self.change_point, self.status) {
            (Some(dyad), _) => write!(
                f,
                "at q = {q}, {dyad} is flat: a change point, through which the smooth motion goes on"
            ),
            (None, Status::NearSingular) => write!(
                f,
                "at q = {q}, the condition is {condition}: fewer than 6 digits of the analogues remain"
            ),
            _ => write!(f, "at q = {q}, the position is solved, condition {condition}"),
        }
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
            let failed = |q: &[f64]| Diagnosis {
                status: Status::BadDimension,
                q: q.to_vec(),
                residual: f64::NAN,
                condition: f64::NAN,
                failure: Some(Failure::of_dimension(fault.clone(), q)),
                change_point: None,
            };
            return Ok(q.chunks_exact(drivers).map(failed).collect());
        }
        let derivatives = DerivativeTables::new(drivers, 0);
        let mut design = Design::new(self, signs, &derivatives);
        design.bind(dimensions);
        design.trace(q);
        let mut state = design.state(&derivatives);
        let diagnose = |(scaled, q): (&[f64], &[f64])| {
            let analogues = design.solve(&mut state, scaled, design.branch_to(scaled).as_ref());
            examine(&design, &state, &derivatives, q, analogues)
        };
        Ok(design
            .scaled(q)
            .chunks_exact(drivers)
            .zip(q.chunks_exact(drivers))
            .map(diagnose)
            .collect())
    }

    /// Refuses slices whose lengths do not fit this mechanism.
    pub(crate) fn check(
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
}

/// Examines the position that the state holds.
fn examine(
    design: &Design<'_>,
    state: &State,
    derivatives: &DerivativeTables,
    q: &[f64],
    analogues: bool,
) -> Diagnosis {
    let (status, fault) = (state.status, state.fault);
    let solved = matches!(status, Status::Ok | Status::NearSingular | Status::Singular);
    let failed = !solved || (status == Status::Singular && !analogues);
    let failure = failed.then(|| Failure::of(design, Rejection::Failed { status, fault }, q));
    let change_point = match (status, fault) {
        (Status::Singular, Some(Fault::Singular { step }))
            if !failed && !state.is_at_zero_length(design.mechanism.plan()) =>
        {
            Some(group_name(design.mechanism, step))
        }
        _ => None,
    };
    let (residual, condition) = if solved {
        (state.residual(&design.context(derivatives)), state.conditions.greatest[0].sqrt())
    } else {
        (f64::NAN, f64::NAN)
    };
    Diagnosis { status, q: q.to_vec(), residual, condition, failure, change_point }
}
