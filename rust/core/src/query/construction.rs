//! A mechanism from its description. A drawing with redundant links is checked along its motion.
//! That needs the solver, so it is not done in `plan`.

use std::f64::consts::TAU;
use std::sync::atomic::AtomicBool;

use crate::description::Description;
use crate::description::error::StructureError;
use crate::math::tolerance::{NEARLY_REDUNDANT, REDUNDANT_ROUNDING};
use crate::plan::constants::DesignConstants;
use crate::plan::mechanism::Mechanism;
use crate::plan::plan::Step;
use crate::state::status::Status;

/// Positions in each direction at which a drawing with redundant links is checked: over a turn, or
/// the size of the drawing along a slide.
const SAMPLES: u32 = 31;

impl Mechanism {
    /// Analyses and compiles a description.
    ///
    /// # Errors
    ///
    /// [`StructureError`]: what keeps the description from being a mechanism with as many drivers
    /// as freedoms and a definite assembly.
    pub fn new(description: &Description) -> Result<Self, StructureError> {
        Self::new_unless(description, None)
    }

    /// [`Mechanism::new`], stopping once `cancel` is true: thousands of links take seconds.
    ///
    /// # Errors
    ///
    /// Those of [`Mechanism::new`], and [`StructureError::Interrupted`].
    pub fn new_unless(
        description: &Description,
        cancel: Option<&AtomicBool>,
    ) -> Result<Self, StructureError> {
        let mechanism = Self::compile(description, cancel)?;
        let constants =
            DesignConstants::new(mechanism.plan(), &mechanism.slots, mechanism.drawing());
        mechanism.check_redundancy_along_motion(constants.scale)?;
        Ok(mechanism)
    }

    /// Refuses a drawing whose redundant links fit near it but not along all of its motion: its
    /// lengths do not agree well enough to pass a change point.
    fn check_redundancy_along_motion(&self, scale: f64) -> Result<(), StructureError> {
        let is_slide = self.plan().driven_slide(0).is_some();
        if self.plan().redundant_links().next().is_none() || self.q0().len() > 1 {
            return Ok(());
        }
        let step = if is_slide { self.linkage().size() } else { TAU } / f64::from(SAMPLES);
        for step in [step, -step] {
            let samples = (0..=SAMPLES).map(f64::from);
            let coordinates: Vec<f64> =
                samples.map(|sample| self.q0()[0] + step * sample).collect();
            let mut residual = 0.0_f64;
            for found in
                self.diagnose(self.drawing(), &coordinates, self.signs()).unwrap_or_default()
            {
                if matches!(found.status, Status::Ok | Status::NearSingular | Status::Singular) {
                    residual = residual.max(found.residual);
                    continue;
                }
                let steps = &self.plan().steps;
                let fit = found.step.is_some_and(|step| matches!(steps[step], Step::Redundant(_)));
                // A wide gap belongs to another assembly, beyond a change point that was missed or
                // a gap of another dyad; the misfit shows in the residual before.
                let part = if found.gap < NEARLY_REDUNDANT { found.gap } else { residual };
                if fit && part > REDUNDANT_ROUNDING {
                    let links = format!("{:?} and others", found.name.unwrap_or_default());
                    return Err(StructureError::AlmostFits { links, gap: part * scale, part });
                }
            }
        }
        Ok(())
    }
}
