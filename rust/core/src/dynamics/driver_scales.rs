//! Typical sizes of the drivers' coordinates and speeds, which tolerances are relative to.

use crate::description::Driver;
use crate::plan::mechanism::Mechanism;

/// For each driver of a design, the size that the tolerance of its coordinate is relative to: one radian, or
/// the greatest length.
pub(crate) fn sizes_of(mechanism: &Mechanism, dimensions: &[f64]) -> Vec<f64> {
    let greatest = mechanism.slots.size(dimensions);
    let length = if greatest > 0.0 { greatest } else { 1.0 };
    let size = |driver: &Driver| match driver {
        Driver::Angle { .. } => 1.0,
        Driver::Slide(_) => length,
    };
    mechanism.linkage().drivers.iter().map(size).collect()
}

/// Writes a thousandth of the typical speeds: the initial ones, or those that the initial accelerations
/// reach over a radian (for a slide, over the size).
pub(crate) fn small_speeds(
    [speeds, accelerations]: [&[f64]; 2],
    sizes: &[f64],
    duration: f64,
    out: &mut [f64],
) {
    // In sizes per second: the speeds of an angle and of a slide are compared.
    let typical = |driver: usize| {
        let initial = speeds[driver].abs() / sizes[driver];
        initial.max((accelerations[driver].abs() / sizes[driver]).sqrt())
    };
    let greatest = (0..sizes.len()).map(typical).fold(0.0, f64::max);
    // A machine at rest in balance: one radian (or size) over the run.
    let scale = |driver: usize| {
        if greatest > 0.0 {
            typical(driver).max(1e-3 * greatest)
        } else if duration > 0.0 {
            1.0 / duration
        } else {
            1.0
        }
    };
    for (driver, (out, size)) in out.iter_mut().zip(sizes).enumerate() {
        *out = 1e-3 * scale(driver) * size;
    }
}
