//! A drawing whose redundant links fit, with its structure.

use std::sync::atomic::AtomicBool;

use super::Structure;
use super::adjust::{Adjusted, adjust};
use super::closure::Closure;
use super::drawing_change::{Change, Tolerance};
use super::skeleton::paired_size;
use crate::description::error::StructureError;
use crate::description::{Description, Linkage};

/// A drawing that fits.
#[derive(Debug)]
pub(crate) struct Fitted {
    pub linkage: Linkage,
    pub structure: Structure,
    /// How it differs from the drawing given.
    pub change: Change,
}

/// Finds the structure of a linkage, and adjusts its drawing if it has redundant links: within
/// `tolerance`, by default the rounding of nine digits.
///
/// # Errors
///
/// Those of [`Structure::of`], and [`StructureError::AlmostFits`].
pub(crate) fn fitted(
    linkage: Linkage,
    closure: &Closure,
    tolerance: Option<Tolerance>,
    cancel: Option<&AtomicBool>,
) -> Result<Fitted, StructureError> {
    let unchanged = Change { length: 0.0, angle: 0.0 };
    let as_drawn = match Structure::of(&linkage, closure, cancel) {
        Err(StructureError::Interrupted) => return Err(StructureError::Interrupted),
        // Without redundant links no lengths need to agree. Guides that are nearly parallel, or a
        // dyad that is nearly flat, are meant as drawn: an adjustment could free another link.
        Ok(structure) if structure.redundant.is_empty() => {
            return Ok(Fitted { linkage, structure, change: unchanged });
        }
        result => result,
    };
    match adjust(&linkage, closure, tolerance, cancel)? {
        Adjusted::AsDrawn => Ok(Fitted { linkage, structure: as_drawn?, change: unchanged }),
        Adjusted::By(fitted, change) => {
            let structure = Structure::of(&fitted, closure, cancel)?;
            Ok(Fitted { linkage: *fitted, structure, change })
        }
        Adjusted::TooFar { links, gap, part } => {
            let limit = tolerance.map(|tolerance| tolerance.length);
            let refused = StructureError::AlmostFits { links, gap, part, limit };
            let structure = as_drawn.map_err(|_| refused)?;
            Ok(Fitted { linkage, structure, change: unchanged })
        }
    }
}

/// A description whose drawing is adjusted so that redundant links fit, and how it differs: joints
/// by up to `length` in each coordinate, m, guides by up to `angle`, rad (by default `length` at the
/// size of the linkage). Nothing is adjusted where no link is redundant.
///
/// # Errors
///
/// Those of [`Linkage::new`] and [`Structure::of`], [`StructureError::AlmostFits`], and
/// [`StructureError::Interrupted`] once `cancel` is true.
pub fn fit(
    description: &Description,
    length: f64,
    angle: Option<f64>,
    cancel: Option<&AtomicBool>,
) -> Result<(Description, Change), StructureError> {
    let linkage = Linkage::new(description)?;
    let angle = angle.unwrap_or_else(|| length / paired_size(&linkage));
    let tolerance = Tolerance { length, angle };
    let closure = Closure::of(&linkage);
    let Fitted { linkage, change, .. } = fitted(linkage, &closure, Some(tolerance), cancel)?;
    let mut adjusted = description.clone();
    for ((_, at), joint) in adjusted.joints.iter_mut().zip(&linkage.joints) {
        *at = joint.at;
    }
    for (adjusted_slide, slide) in adjusted.slides.iter_mut().zip(&linkage.slides) {
        adjusted_slide.angle = slide.angle;
    }
    Ok((adjusted, change))
}
