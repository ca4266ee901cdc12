//! Calls that are too short to check for signals meanwhile.

use assur::{Coordinates, Mechanism, Request};

/// Positions below which a call with one driver takes only milliseconds and need not check for
/// signals. With several drivers each position is followed from the drawing: this many knots.
const FEW_POSITIONS: usize = 100_000;
const FEW_KNOTS: f64 = 10_000.0;
/// Knots per rad or size on that way.
const KNOTS_PER_UNIT: f64 = 16.0;
/// Dyads with two solutions below which finding all assemblies need not check for signals.
pub(crate) const FEW_SIGNS: usize = 12;
/// Positions whose assemblies take only milliseconds then.
pub(crate) const FEW_ASSEMBLIES: usize = 100;
/// Links below which building a mechanism, or one search along its branch, need not check for signals.
pub(crate) const FEW_LINKS: usize = 64;
/// Links of the mechanisms for which positions are counted: with more links a position takes longer.
const LINKS_COUNTED: usize = 4;
/// Number of positions that take as long as tracing one branch from the drawing; fewer without groups
/// above class II, whose knots are solved in lanes.
const POSITIONS_PER_BRANCH: usize = 1000;
const POSITIONS_PER_BRANCH_OF_DYADS: usize = 100;
/// Whether designs are solved at positions too quickly to check for signals meanwhile.
pub(crate) fn is_short(mechanism: &Mechanism, designs: usize, positions: usize) -> bool {
    let per_branch = match mechanism.structure().class() {
        0..=2 => POSITIONS_PER_BRANCH_OF_DYADS,
        _ => POSITIONS_PER_BRANCH,
    };
    let links = (mechanism.linkage().links.len() / LINKS_COUNTED).max(1);
    let cost = designs.saturating_mul(positions.saturating_add(per_branch)).saturating_mul(links);
    mechanism.q0().len() == 1 && cost < FEW_POSITIONS
}

/// Whether positions of several drivers are too few and too near the drawing to check for signals
/// meanwhile.
pub(crate) fn is_near(mechanism: &Mechanism, request: &Request<'_>, designs: usize) -> bool {
    let (Coordinates::Shared(q) | Coordinates::PerDesign(q)) = request.coordinates;
    let q0 = mechanism.q0();
    let size = request.dimensions.iter().fold(0.0, |most: f64, d| most.max(d.abs()));
    let far = |place: &[f64]| {
        let apart = place.iter().zip(q0).map(|(q, q0)| (q - q0).abs());
        // NaN is refused at once.
        1.0 + KNOTS_PER_UNIT * apart.fold(0.0, f64::max) / size.min(1.0)
    };
    designs as f64 * q.chunks(q0.len()).map(far).sum::<f64>() < FEW_KNOTS
}

/// Whether one search along a branch takes only milliseconds.
pub(crate) fn is_small(mechanism: &Mechanism) -> bool {
    mechanism.structure().class() <= 2 && mechanism.linkage().links.len() < FEW_LINKS
}
