//! Mass and inertia of a link.

use super::kinematics::Point;

/// Mass and inertia of a link.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Body {
    /// The link.
    pub link: usize,
    /// Its centre of mass.
    pub at: Point,
    /// Mass, kg.
    pub mass: f64,
    /// Moment of inertia about the centre of mass, kg·m².
    pub inertia: f64,
}
