//! All positions of a design at which a coordinate has a value.

use std::sync::atomic::{AtomicBool, Ordering};

use super::answers::{Answer, Answers};
use super::inverse::Inverse;
use super::original::Original;
use crate::assemblies::assembly::Assemblies;
use crate::assemblies::enumerate::{Search, poses};
use crate::branch::design::Design;
use crate::description::error::SolveError;
use crate::plan::mechanism::Mechanism;

impl Inverse {
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
        original.check(dimensions, original.q0(), original.signs())?;
        if values.len() != self.drivers() {
            return Err(SolveError::Shape("a value of every coordinate is needed".into()));
        }
        if original.dimensions().first_fault(dimensions).is_some() {
            return Ok(Answers { found: Vec::new(), failures: Vec::new(), is_complete: true });
        }
        let poses = self.poses(dimensions, values, cancel)?;
        let is_complete = poses.is_complete();
        let mut found: Vec<Answer> = Vec::with_capacity(poses.found.len());
        if !poses.found.is_empty() {
            let derivatives = &*self.derivatives;
            let mut design = Design::new(original, original.signs(), derivatives);
            design.bind(dimensions);
            let mut original = Original::new(&mut design, dimensions, derivatives, cancel);
            for pose in &poses.found {
                if cancel.is_some_and(|flag| flag.load(Ordering::Relaxed)) {
                    return Err(SolveError::Interrupted);
                }
                let Some(answer) = original.answer(pose)? else { continue };
                if !found.iter().any(|known| original.is_same(known, &answer)) {
                    found.push(answer);
                }
            }
        }
        found.sort_by(Answer::order);
        Ok(Answers { found, failures: poses.failures, is_complete })
    }

    /// The poses of a design: all assemblies of the inverse.
    fn poses(
        &self,
        dimensions: &[f64],
        values: &[f64],
        cancel: Option<&AtomicBool>,
    ) -> Result<Assemblies, SolveError> {
        let own = self.dimensions(dimensions);
        let q = self.coordinates(&own, values);
        let mut design = Design::new(&self.mechanism, self.mechanism.signs(), &self.derivatives);
        design.bind(&own);
        poses(&design, (self.fibres(), Search::Quick), &q, cancel)
    }
}
