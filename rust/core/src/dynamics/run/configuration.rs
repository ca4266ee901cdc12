//! A machine with one driver at a coordinate, and its energy balance.

use crate::math::lanes::Real;
use crate::math::tolerance::ANALOGUE_PER_CONDITION_SQUARED;

/// Largest change of the energy over a step, in tolerances: its error is only estimated.
pub(super) const MAX_DRIFT: f64 = 3.0;
/// Multiples of the energies' rounding that do not count as a change.
pub(super) const ROUNDINGS: f64 = 64.0;

/// Inertia and weights at coordinates, and the condition of the position.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Configuration<R = f64> {
    pub inertia: R,
    pub d_inertia: R,
    pub conservative: R,
    pub potential: R,
    pub condition: R,
}

impl<R: Real> Configuration<R> {
    /// Kinetic and potential energy less work at a speed, and the tolerance of that sum. `relative`: that of
    /// the speed; `unit`: that of the coordinate.
    #[inline(always)]
    pub(super) fn balance(&self, [speed, work]: [R; 2], [relative, unit]: [R; 2]) -> [R; 2] {
        let Self { inertia, d_inertia, conservative, potential, condition } = *self;
        let half = R::splat(0.5);
        let kinetic = half * (speed * (inertia * speed));
        // Speeds are accurate to the relative tolerance, coordinates to that part of their unit.
        let change = half * d_inertia * speed * speed - conservative;
        let by_coordinate = change.abs() * unit;
        let size = kinetic.abs() + potential.abs() + work.abs();
        let noise = R::splat(ANALOGUE_PER_CONDITION_SQUARED) * condition * condition;
        let allowed = R::splat(MAX_DRIFT) * relative * (R::splat(2.0) * kinetic + by_coordinate)
            + R::splat(ROUNDINGS * f64::EPSILON) * size
            + noise * kinetic;
        [kinetic + potential - work, allowed]
    }
}
