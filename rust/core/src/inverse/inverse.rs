//! A mechanism that a coordinate drives in place of its drivers: for a joint's x or y, added slides carry
//! the joint.

use std::sync::{Arc, OnceLock};

use crate::assemblies::enumerate::Fibres;
use crate::description::error::SolveError;
use crate::math::derivatives::DerivativeTables;
use crate::plan::mechanism::Mechanism;
use crate::query::extremes::tracked::Tracked;

/// A mechanism driven by a coordinate of another one, the original, for any of its designs.
///
/// It has all joints, links and slides of the original, in the same order before any others.
#[derive(Debug)]
pub struct Inverse {
    pub(super) mechanism: Mechanism,
    /// What it is driven by, as coordinates of the original.
    pub(super) coordinates: Vec<Tracked>,
    /// For every dimension of it, the original's; added ones keep the drawing's value.
    slots: Vec<Option<usize>>,
    /// For every driver, the dimension from which the value is measured.
    bases: Vec<Option<usize>>,
    /// Tables of the first derivatives by its drivers, of which the original has as many.
    pub(super) derivatives: Arc<DerivativeTables>,
    /// Found when first needed: the complex assemblies of groups.
    fibres: OnceLock<Arc<Fibres>>,
}

impl Inverse {
    /// `names`: of the coordinates that drive it, in order; `bases`: for every one the dimension of the
    /// inverse that is subtracted from its value.
    ///
    /// # Errors
    ///
    /// [`SolveError::Unknown`] for an unknown dimension, [`SolveError::Shape`] for another number of bases, or
    /// a mechanism that is none of the original's.
    pub fn new(
        original: &Mechanism,
        mechanism: Mechanism,
        names: &[String],
        bases: &[Option<String>],
    ) -> Result<Self, SolveError> {
        let counts = |of: &Mechanism| {
            let linkage = of.linkage();
            [linkage.joints.len(), linkage.links.len(), linkage.slides.len()]
        };
        let holds_all =
            counts(original).iter().zip(counts(&mechanism)).all(|(&own, all)| own <= all);
        let drivers = mechanism.q0().len();
        let has_all = [bases.len(), names.len(), original.q0().len()].iter().all(|&n| n == drivers);
        if !has_all || !holds_all {
            return Err(SolveError::Shape("the inverse is one of another mechanism".into()));
        }
        let of_original = original.dimensions();
        let slots = mechanism.dimensions().iter().map(|(name, _)| of_original.position(name).ok());
        let slots = slots.collect();
        let base = |name: &Option<String>| {
            let position = |name: &String| mechanism.dimensions().position(name);
            name.as_ref().map(position).transpose()
        };
        let bases = bases.iter().map(base).collect::<Result<_, _>>()?;
        let coordinates =
            names.iter().map(|name| original.coordinate(name)).collect::<Result<_, _>>()?;
        let derivatives = DerivativeTables::shared(drivers, 1);
        Ok(Self { mechanism, coordinates, slots, bases, derivatives, fibres: OnceLock::new() })
    }

    /// Number of the coordinates that it is driven by.
    #[must_use]
    pub fn drivers(&self) -> usize {
        self.bases.len()
    }

    /// Whether all positions of a design have closed forms, or are the roots of a polynomial.
    #[must_use]
    pub fn is_quick(&self) -> bool {
        self.mechanism.plan().groups().all(|group| group.unknowns.len() <= 2)
    }

    /// Its dimensions for a design of the original.
    pub(super) fn dimensions(&self, dimensions: &[f64]) -> Vec<f64> {
        let drawing = self.mechanism.drawing();
        let value = |(slot, &drawn): (&Option<usize>, &f64)| slot.map_or(drawn, |i| dimensions[i]);
        self.slots.iter().zip(drawing).map(value).collect()
    }

    /// Its coordinates where the original's have these values.
    pub(super) fn coordinates(&self, own_dimensions: &[f64], values: &[f64]) -> Vec<f64> {
        let from = |(base, &value): (&Option<usize>, &f64)| {
            base.map_or(value, |base| value - own_dimensions[base])
        };
        self.bases.iter().zip(values).map(from).collect()
    }

    pub(super) fn fibres(&self) -> &Fibres {
        self.fibres.get_or_init(|| self.mechanism.fibres())
    }
}
