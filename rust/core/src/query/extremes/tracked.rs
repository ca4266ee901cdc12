//! What extremes are of, and what they are.

/// A coordinate of the motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tracked {
    /// A joint's x (0) or y (1), m.
    Joint(usize, usize),
    /// A link's angle, rad.
    Link(usize),
    /// A slide's value, m.
    Slide(usize),
}

/// A value and the coordinate of the driver where it is taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ValueAt {
    /// The value.
    pub value: f64,
    /// Where.
    pub q: f64,
}
