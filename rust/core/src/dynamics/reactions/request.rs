//! What reactions are asked for.

use super::pair_forces::Reaction;
use crate::batch::request::Coordinates;

/// Motions of a batch of designs, of which reactions are asked for.
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
    /// In which sense each driver is about to move where all rest, +1 or −1: for friction. May be
    /// empty.
    pub sense: &'a [f64],
    /// Which of the solutions is meant where friction has several; 0: the one to which friction leads
    /// as it grows from nothing.
    pub solution: usize,
    /// What is asked for.
    pub reactions: &'a [Reaction],
    /// Whether of each design only the greatest square and the mean square of every reaction are
    /// wanted, over its positions.
    pub squares: bool,
}
