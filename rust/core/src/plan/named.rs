//! Dimensions of the named mechanisms, in the order of their compiled mechanism.

use super::mechanism::Mechanism;
use crate::description::four_bar::FourBar;
use crate::description::slider_crank::SliderCrank;

impl FourBar {
    /// The dimensions in the order of the mechanism made from
    /// [`FourBar::description`].
    #[must_use]
    pub fn dimensions(&self, mechanism: &Mechanism) -> Vec<f64> {
        drawing_with(
            mechanism,
            &[
                ("crank.length", self.crank),
                ("coupler.length", self.coupler),
                ("rocker.length", self.rocker),
                ("ground.D.x", self.ground),
            ],
        )
    }
}

impl SliderCrank {
    /// The dimensions in the order of the mechanism made from
    /// [`SliderCrank::description`].
    #[must_use]
    pub fn dimensions(&self, mechanism: &Mechanism) -> Vec<f64> {
        drawing_with(
            mechanism,
            &[("crank.length", self.crank), ("rod.length", self.rod), ("bore.offset", self.offset)],
        )
    }
}

/// The dimensions of the drawing with some values replaced by name.
fn drawing_with(mechanism: &Mechanism, replaced: &[(&str, f64)]) -> Vec<f64> {
    let names = mechanism.dimensions().iter().map(|(name, _)| name);
    let value = |(name, &drawn): (&str, &f64)| {
        replaced.iter().find(|(key, _)| *key == name).map_or(drawn, |&(_, value)| value)
    };
    names.zip(mechanism.drawing()).map(value).collect()
}
