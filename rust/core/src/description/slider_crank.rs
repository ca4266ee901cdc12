//! The slider-crank with given lengths.

use super::Description;

/// A slider-crank with given lengths: joints O, A, B; the bore parallel to +x,
/// its line `offset` to the left of O; B ahead of A.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SliderCrank {
    /// O to A, m.
    pub crank: f64,
    /// A to B, m.
    pub rod: f64,
    /// Distance of the bore's line from O, m, positive to the left of +x.
    pub offset: f64,
}

impl SliderCrank {
    /// The linkage, drawn with lengths independent of any design (crank 1 at 0°, rod 3).
    #[must_use]
    pub fn description() -> Description {
        Description::new()
            .joint("O", [0.0, 0.0])
            .joint("A", [1.0, 0.0])
            .joint("B", [4.0, 0.0])
            .link("ground", ["O"])
            .link("crank", ["O", "A"])
            .link("rod", ["A", "B"])
            .link("piston", ["B"])
            .slide("bore", "piston", "ground", 0.0, Some("O"))
            .driver("crank")
    }
}
