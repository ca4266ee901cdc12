//! Units of length of a design.

use crate::math::derivatives::DerivativeTables;
use crate::plan::mechanism::Mechanism;

/// Factors between the design's own unit of length and the metre: powers of two.
#[derive(Debug, Default)]
pub(crate) struct Units {
    /// The unit of length that they belong to, m.
    scale: f64,
    /// Factor of every coordinate, into the design's unit.
    pub coordinate: Vec<f64>,
    /// Factor of every jet entry of a length, into metres.
    pub length: Vec<f64>,
    /// Factor of every jet entry of an angle.
    pub angle: Vec<f64>,
}

impl Units {
    pub(super) fn set(
        &mut self,
        mechanism: &Mechanism,
        scale: f64,
        derivatives: &DerivativeTables,
    ) {
        if self.scale == scale {
            return;
        }
        self.scale = scale;
        let inverse_scale = 1.0 / scale;
        let slides = |d: usize| mechanism.plan().driven_slide(d).is_some();
        self.coordinate.clear();
        self.coordinate
            .extend((0..mechanism.q0().len()).map(|d| if slides(d) { inverse_scale } else { 1.0 }));
        self.angle.clear();
        self.length.clear();
        for power in &derivatives.powers {
            // One factor at a time: a length's third analogue stays in range where the cube of the
            // unit does not.
            let (mut angle, mut length) = (1.0, scale);
            for (&power, &unit) in power.iter().zip(&self.coordinate) {
                for _ in 0..power {
                    angle *= unit;
                    length *= unit;
                }
            }
            self.angle.push(angle);
            self.length.push(length);
        }
    }
}
