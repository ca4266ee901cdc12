//! Mechanisms drawn in an assembly, or driven otherwise from a pose on.

use super::assembly::Assembly;
use crate::description::Description;
use crate::description::error::{SolveError, StructureError};
use crate::plan::mechanism::{Flat, Mechanism};
use crate::plan::redraw::{Drawing, Pose};

impl Mechanism {
    /// The mechanism drawn in an assembly of a design at `q`.
    ///
    /// # Errors
    ///
    /// Numbers that do not fit this mechanism.
    pub fn drawn_in(
        &self,
        dimensions: &[f64],
        q: &[f64],
        assembly: &Assembly,
    ) -> Result<Self, SolveError> {
        self.check(dimensions, q, &assembly.signs)?;
        let fits = q.len() == self.q0().len()
            && assembly.class_angles.len() == self.class_angle.len()
            && assembly.slides.len() == self.slide_value.len();
        if !fits {
            return Err(SolveError::Shape("the assembly is one of another mechanism".into()));
        }
        let drawing = Drawing {
            q0: q.to_vec(),
            signs: assembly.signs.clone(),
            class_angle: assembly.class_angles.clone(),
            slide_value: assembly.slides.clone(),
        };
        Ok(self.drawn_at(dimensions, drawing))
    }

    /// Compiles a description whose drawing need not show the assembly: [`Mechanism::at_pose`] gives it.
    ///
    /// # Errors
    ///
    /// Those of [`Mechanism::new`] except for flat dyads.
    pub fn new_for_pose(description: &Description) -> Result<Self, StructureError> {
        let mut mechanism = Self::compile(description, Flat::Positive, None)?;
        mechanism.examine_chords();
        Ok(mechanism)
    }

    /// The coordinates of the drivers in a pose, and the assembly that it shows.
    ///
    /// # Errors
    ///
    /// [`StructureError::FlatDyad`]: a dyad is flat there, so its assembly is not definite.
    pub fn at_pose(&self, pose: &Pose) -> Result<(Vec<f64>, Assembly), StructureError> {
        let drawing = self.drawing_of(pose)?;
        let assembly = Assembly {
            signs: drawing.signs,
            class_angles: drawing.class_angle,
            slides: drawing.slide_value,
            joints: pose.joints.clone(),
            angles: pose.angles.clone(),
            is_double: false,
        };
        Ok((drawing.q0, assembly))
    }
}
