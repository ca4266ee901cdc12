//! All positions of a design at which coordinates have given values.

use std::sync::atomic::{AtomicBool, Ordering};

use super::answers::{Answer, Answers};
use super::inverse::Inverse;
use super::original::Original;
use crate::assemblies::enumerate::{Search, poses};
use crate::branch::design::Design;
use crate::description::error::SolveError;
use crate::plan::mechanism::Mechanism;
use crate::state::state::State;

/// A design that is ready for any values.
pub struct Finder<'f> {
    inverse: &'f Inverse,
    /// The design of the inverse, its dimensions and work space.
    own: Design<'f>,
    own_dimensions: Vec<f64>,
    state: State,
    original: Original<'f>,
    cancel: Option<&'f AtomicBool>,
}

impl Inverse {
    /// A design of the original, ready for any values; none if a dimension is not valid.
    ///
    /// # Errors
    ///
    /// [`SolveError::Shape`] for another number of dimensions.
    pub fn finder<'f>(
        &'f self,
        original: &'f Mechanism,
        dimensions: &'f [f64],
        cancel: Option<&'f AtomicBool>,
    ) -> Result<Option<Finder<'f>>, SolveError> {
        original.check(dimensions, original.q0(), original.signs())?;
        if original.dimensions().first_fault(dimensions).is_some() {
            return Ok(None);
        }
        let own_dimensions = self.dimensions(dimensions);
        let mut own = Design::new(&self.mechanism, self.mechanism.signs(), &self.derivatives);
        own.bind(&own_dimensions);
        let mut design = Design::new(original, original.signs(), &self.derivatives);
        design.bind(dimensions);
        let state = own.state(&self.derivatives);
        let original = Original::new(design, dimensions, cancel);
        Ok(Some(Finder { inverse: self, own, own_dimensions, state, original, cancel }))
    }

    /// Every position of a design of the original at which the coordinates have these values.
    ///
    /// # Errors
    ///
    /// Those of [`Mechanism::assemblies`].
    pub fn find(
        &self,
        original: &Mechanism,
        dimensions: &[f64],
        values: &[f64],
        cancel: Option<&AtomicBool>,
    ) -> Result<Answers, SolveError> {
        match self.finder(original, dimensions, cancel)? {
            Some(mut finder) => finder.find(values),
            None => Ok(Answers { found: Vec::new(), failures: Vec::new(), is_complete: true }),
        }
    }
}

impl Finder<'_> {
    /// Every position of the design at which the coordinates have these values.
    ///
    /// # Errors
    ///
    /// Those of [`Mechanism::assemblies`].
    pub fn find(&mut self, values: &[f64]) -> Result<Answers, SolveError> {
        let Self { inverse, own, state, original, cancel, .. } = self;
        if values.len() != inverse.drivers() {
            return Err(SolveError::Shape("a value of every coordinate is needed".into()));
        }
        let q = inverse.coordinates(&self.own_dimensions, values);
        let poses = poses(own, state, (inverse.fibres(), Search::Quick), &q, *cancel)?;
        let is_complete = poses.is_complete();
        let mut found: Vec<Answer> = Vec::with_capacity(poses.found.len());
        for pose in &poses.found {
            if cancel.is_some_and(|flag| flag.load(Ordering::Relaxed)) {
                return Err(SolveError::Interrupted);
            }
            let Some(answer) = original.answer(pose)? else { continue };
            if !found.iter().any(|known| original.is_same(known, &answer)) {
                found.push(answer);
            }
        }
        found.sort_by(Answer::order);
        Ok(Answers { found, failures: poses.failures, is_complete })
    }
}
