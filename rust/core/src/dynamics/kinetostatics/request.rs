//! A request for the reactions of a motion.

use crate::batch::request::Coordinates;

/// A reaction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reaction {
    /// Force on a link from all other links at a joint, N: x and y.
    Joint {
        /// The joint.
        joint: usize,
        /// The link.
        on: usize,
    },
    /// Force on the sliding link along the guide turned by +90°, N.
    Normal(usize),
    /// Moment on the sliding link about its sliding point, N·m.
    Moment(usize),
    /// Place on the guide where the normal force alone would have that moment: value + moment/normal, m.
    Along(usize),
    /// Moment of friction on a link at a joint, N·m.
    JointMoment {
        /// The joint.
        joint: usize,
        /// The link.
        on: usize,
    },
    /// Force of friction on the sliding link along the guide, N.
    Friction(usize),
    /// Power that friction dissipates at a joint, W.
    JointLoss(usize),
    /// Power that friction dissipates in a slide, W.
    SlideLoss(usize),
    /// Number of solutions: 0 where friction locks the machine, −1 where too many pairs depend on one
    /// another, −2 where redundant links leave the force in a pair undetermined.
    Solutions,
    /// Residual of the law of friction, relative to the greatest friction.
    Residual,
    /// Factor of all coefficients of friction at which the solution ends that begins without friction.
    Safety,
    /// Torque (N·m) or force (N) of a driver.
    Driver(usize),
    /// Inertia forces of all bodies, N: x and y.
    ShakingForce,
    /// Their moment about the origin of the drawing, N·m.
    ShakingMoment,
    /// Force of a load on a link, N: x and y, by one of the machine's
    /// [actions](crate::dynamics::Machine::load_actions).
    LoadForce(usize),
    /// The place where it acts, m: x and y.
    LoadPlace(usize),
    /// Couple of a load on a link, N·m.
    LoadCouple(usize),
}

impl Reaction {
    /// Numbers per position.
    #[must_use]
    pub fn width(self) -> usize {
        match self {
            Self::Joint { .. } | Self::ShakingForce | Self::LoadForce(_) | Self::LoadPlace(_) => 2,
            _ => 1,
        }
    }

    /// Whether it follows from the motion alone, independent of the forces in pairs.
    pub(crate) fn is_given(self) -> bool {
        matches!(
            self,
            Self::ShakingForce
                | Self::ShakingMoment
                | Self::LoadForce(_)
                | Self::LoadPlace(_)
                | Self::LoadCouple(_)
        )
    }
}

/// Motions of a batch of designs whose reactions are requested.
#[derive(Debug, Clone, Copy)]
pub struct ReactionRequest<'a> {
    /// Dimensions: the first of every design, then the second of every design, and so on.
    pub dimensions: &'a [f64],
    /// Coordinates of the drivers, rad or m.
    pub coordinates: Coordinates<'a>,
    /// Assembly signs, +1 or −1 for every dyad with two solutions.
    pub signs: &'a [i8],
    /// Speeds of the drivers, rad/s or m/s: designs × positions × drivers, or one for all.
    pub speed: &'a [f64],
    /// Accelerations of the drivers, rad/s² or m/s²: designs × positions × drivers, or one for all.
    pub acceleration: &'a [f64],
    /// Values of the loads' callbacks: designs × positions × callbacks.
    pub external: &'a [f64],
    /// Sense in which each driver is about to move where all rest, +1 or −1, for friction. May be
    /// empty.
    pub sense: &'a [f64],
    /// Index of the solution where friction has several; 0: the one that begins without friction as friction
    /// grows.
    pub solution: usize,
    /// The requested reactions.
    pub reactions: &'a [Reaction],
    /// Whether to return only the greatest and the mean square of every reaction over the positions of
    /// each design.
    pub squares: bool,
}
