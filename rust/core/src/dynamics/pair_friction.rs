//! Description of the friction in the pairs of a machine.

/// Coulomb friction in a pair, and its viscous part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Friction {
    /// At a joint: the pin is fast in the first link of the description that has it, and a journal in
    /// each other one.
    Joint {
        /// The joint.
        joint: usize,
        /// Radius of the friction circle, m: the coefficient times the journal's radius.
        circle: f64,
        /// The same at rest, not less.
        static_circle: f64,
        /// Moment per relative speed, N·m·s/rad.
        viscous: f64,
    },
    /// In a slide, at both ends of a length that is centred on the sliding point and moves with the
    /// sliding link.
    Slide {
        /// The slide.
        slide: usize,
        /// Coefficient of friction.
        coefficient: f64,
        /// The same at rest, not less.
        static_coefficient: f64,
        /// The length, m.
        length: f64,
        /// Force per speed, N·s/m.
        viscous: f64,
    },
}
