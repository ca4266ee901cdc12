//! A mechanism from its description. A drawing with redundant links is checked along its motion.
//! That needs the solver, so it is not done in `plan`.

use std::f64::consts::TAU;
use std::sync::atomic::AtomicBool;

use crate::branch::design::Design;
use crate::description::Description;
use crate::description::error::StructureError;
use crate::math::derivatives::DerivativeTables;
use crate::math::tolerance::{NEARLY_REDUNDANT, REDUNDANT_ROUNDING};
use crate::plan::constants::DesignConstants;
use crate::plan::mechanism::{Flat, Mechanism};
use crate::query::failure::Reason;
use crate::state::status::Status;

/// Positions in each direction at which a drawing with redundant links is checked: over a turn, or
/// the size of the drawing along a slide.
const SAMPLES: u32 = 31;

impl Mechanism {
    /// Analyses and compiles a description.
    ///
    /// # Errors
    ///
    /// [`StructureError`]: the reason why the description is not a mechanism with as many drivers
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
        let mut mechanism = Self::compile(description, Flat::Refused, cancel)?;
        mechanism.examine_chords();
        let constants =
            DesignConstants::new(mechanism.plan(), &mechanism.slots, mechanism.drawing());
        mechanism.check_redundancy_along_motion(constants.scale)?;
        Ok(mechanism)
    }

    /// With several drivers, finds which dyads can pass change points.
    pub(crate) fn examine_chords(&mut self) {
        if self.q0().len() > 1 {
            let derivatives = DerivativeTables::new(self.q0().len(), 1);
            let mut drawing = Design::new(self, self.signs(), &derivatives);
            drawing.bind(self.drawing());
            let may_change = drawing.may_change();
            self.set_may_change(may_change);
        }
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
            for diagnosis in
                self.diagnose(self.drawing(), &coordinates, self.signs()).unwrap_or_default()
            {
                let Some(failure) = diagnosis.failure else {
                    residual = residual.max(diagnosis.residual);
                    continue;
                };
                let Reason::RedundantMisfit { name, gap, .. } = failure.reason else {
                    if failure.status == Status::Singular {
                        residual = residual.max(diagnosis.residual);
                    }
                    continue;
                };
                // A wide gap belongs to another assembly, beyond a change point that was missed or
                // a gap of another dyad; the misfit shows in the residual before.
                let gap = gap / scale;
                let part = if gap < NEARLY_REDUNDANT { gap } else { residual };
                if part > REDUNDANT_ROUNDING {
                    return Err(StructureError::AlmostFits {
                        links: vec![name],
                        gap: part * scale,
                        part,
                        limit: None,
                    });
                }
            }
        }
        Ok(())
    }
}
