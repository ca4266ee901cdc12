//! Dimensions of the named mechanisms, in the order of their compiled mechanism.

use super::mechanism::Mechanism;
use crate::description::four_bar::FourBar;
use crate::description::slider_crank::SliderCrank;

impl FourBar {
    /// The dimensions in the order of the mechanism made from
    /// [`FourBar::description`].
    #[must_use]
    pub fn dimensions(&self, mechanism: &Mechanism) -> Vec<f64> {
        mechanism
            .dimensions()
            .iter()
            .zip(mechanism.drawing())
            .map(|((name, _), &drawn)| match name {
                "crank.length" => self.crank,
                "coupler.length" => self.coupler,
                "rocker.length" => self.rocker,
                "ground.D.x" => self.ground,
                _ => drawn,
            })
            .collect()
    }
}

impl SliderCrank {
    /// The dimensions in the order of the mechanism made from
    /// [`SliderCrank::description`].
    #[must_use]
    pub fn dimensions(&self, mechanism: &Mechanism) -> Vec<f64> {
        mechanism
            .dimensions()
            .iter()
            .zip(mechanism.drawing())
            .map(|((name, _), &drawn)| match name {
                "crank.length" => self.crank,
                "rod.length" => self.rod,
                "bore.offset" => self.offset,
                _ => drawn,
            })
            .collect()
    }
}
