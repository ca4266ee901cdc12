//! The mass of a link.

use super::kinematics::Point;

/// Mass of a link.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Body {
    /// The link.
    pub link: usize,
    /// Its centre of mass.
    pub at: Point,
    /// Mass, kg.
    pub mass: f64,
    /// Moment of inertia about that centre, kg·m².
    pub inertia: f64,
}
