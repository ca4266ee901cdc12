//! The class IV mechanism of V. M. Dvorzhak's paper, with given joints.

use super::Description;

/// Crank 1-2, ternary links 2-3-4, 3-6-5 and 8-7-6, bar 4-8, rockers 9-5 and 10-7, fixed pivots
/// 1, 9 and 10; driven by the crank.
///
/// # Examples
///
/// ```
/// use assur::{ClassIv, Mechanism};
///
/// let joints = [
///     [0.0, 0.0], [0.35, 0.0], [1.24, 0.99], [0.75, 1.91], [3.02, -0.73],
///     [2.45, 1.02], [3.2, 2.24], [1.85, 2.35], [1.62, -1.11], [4.28, 1.52],
/// ];
/// let mechanism = Mechanism::new(&ClassIv::description(joints))?;
/// assert_eq!(mechanism.structure().formula(), "I(crank) → IV(l234, l365, l48, l876, l95, l107)");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ClassIv;

impl ClassIv {
    /// The linkage, drawn with joints 1 to 10 at these coordinates, m.
    #[must_use]
    pub fn description(joints: [[f64; 2]; 10]) -> Description {
        let named = joints.into_iter().enumerate();
        named
            .fold(Description::new(), |d, (i, at)| d.joint(&(i + 1).to_string(), at))
            .link("ground", ["1", "9", "10"])
            .link("crank", ["1", "2"])
            .link("l234", ["2", "3", "4"])
            .link("l365", ["3", "6", "5"])
            .link("l48", ["4", "8"])
            .link("l876", ["8", "7", "6"])
            .link("l95", ["9", "5"])
            .link("l107", ["10", "7"])
            .driver("crank")
    }
}
