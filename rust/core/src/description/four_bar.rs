//! The four-bar linkage with given lengths.

use super::Description;

/// The assembly of a four-bar.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum FourBarMode {
    /// C to the right of the ray from D to B.
    #[default]
    Open,
    /// C to the left of that ray.
    Crossed,
}

/// A four-bar with given lengths: joints A, B, C, D, the ground along +x from A to D.
///
/// # Examples
///
/// ```
/// use assur::{FourBar, FourBarMode, Mechanism};
///
/// let four_bar = FourBar { crank: 40.0, coupler: 120.0, rocker: 80.0, ground: 100.0, mode: FourBarMode::Open };
/// let mechanism = Mechanism::new(&FourBar::description(four_bar.mode))?;
/// let dimensions = four_bar.dimensions(&mechanism);
/// assert_eq!(dimensions.len(), mechanism.dimensions().len());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FourBar {
    /// A to B, m.
    pub crank: f64,
    /// B to C, m.
    pub coupler: f64,
    /// D to C, m.
    pub rocker: f64,
    /// A to D, m.
    pub ground: f64,
    /// The assembly.
    pub mode: FourBarMode,
}

impl FourBar {
    /// The linkage, drawn with the crank upright and lengths independent of any design,
    /// so that the assembly and the starting position are always the same.
    #[must_use]
    pub fn description(mode: FourBarMode) -> Description {
        // Right and left of the ray from D to B, which points along (−3, 1).
        let c = match mode {
            FourBarMode::Open => [2.5, 2.0],
            FourBarMode::Crossed => [1.8, -1.6],
        };
        Description::new()
            .joint("A", [0.0, 0.0])
            .joint("B", [0.0, 1.0])
            .joint("C", c)
            .joint("D", [3.0, 0.0])
            .link("ground", ["A", "D"])
            .link("crank", ["A", "B"])
            .link("coupler", ["B", "C"])
            .link("rocker", ["D", "C"])
            .driver("crank")
    }
}
