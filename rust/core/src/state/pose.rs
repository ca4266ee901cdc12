//! The pose of one position, or of several at once: points, orientations and slides, with analogues.

use crate::math::derivatives::DerivativeTables;
use crate::math::lanes::Real;
use crate::math::vector::Vector;
use crate::plan::plan::Plan;

/// Coordinates, assembly, and what follows from them.
#[derive(Debug, Clone)]
pub(crate) struct Pose<R: Real = f64, const G: usize = 1> {
    /// Coordinates (rad; slide drivers in units of the scale).
    pub(crate) q: Vec<[R; G]>,
    /// Unit vectors at the driven angles.
    pub(crate) unit: Vec<[Vector<R>; G]>,
    /// Assembly signs, +1 or −1.
    pub(crate) signs: Vec<[R; G]>,
    /// Jets of points, one after another.
    pub(crate) points: Vec<[Vector<R>; G]>,
    /// Jets of orientations.
    pub(crate) orient: Vec<[Vector<R>; G]>,
    /// Jets of the legs of dyads (two per dyad), then of the edges of groups.
    pub(crate) legs: Vec<[Vector<R>; G]>,
    /// Jets of the angles of classes; entry 0, the value, is not used.
    pub(crate) theta: Vec<[R; G]>,
    /// Jets of slides.
    pub(crate) slides: Vec<[R; G]>,
    /// Rotations of classes.
    pub(crate) class: Vec<[Vector<R>; G]>,
    /// Rotation of every orientation by the drivers alone.
    pub(crate) phase: Vec<[Vector<R>; G]>,
}

impl<R: Real, const G: usize> Pose<R, G> {
    pub(super) fn new(plan: &Plan, derivatives: &DerivativeTables) -> Self {
        let (len, slides) = (derivatives.len(), plan.slide_links.len());
        let mut orient = vec![[Vector::ZERO; G]; plan.orientations.len() * len];
        for (orientation, jet) in plan.orientations.iter().zip(orient.chunks_exact_mut(len)) {
            if orientation.class == 0 {
                jet[0] = [Vector::ONE; G];
            }
        }
        Self {
            q: vec![[R::ZERO; G]; plan.drivers.len()],
            unit: vec![[Vector::ONE; G]; plan.drivers.len()],
            signs: vec![[R::ONE; G]; plan.signs()],
            points: vec![[Vector::ZERO; G]; plan.points * len],
            orient,
            legs: vec![[Vector::ZERO; G]; plan.legs() * len],
            theta: vec![[R::ZERO; G]; plan.classes * len],
            slides: vec![[R::ZERO; G]; slides * len],
            class: vec![[Vector::ONE; G]; plan.classes],
            phase: vec![[Vector::ONE; G]; plan.orientations.len()],
        }
    }
}
