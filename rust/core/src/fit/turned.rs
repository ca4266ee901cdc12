//! The angle at which a body is fixed to its link, where a fit starts: the one that fits its poses best.

use std::sync::atomic::AtomicBool;

use super::point::Point;
use super::problem::{Problem, series};
use super::target::Freedom;
use crate::description::error::SolveError;
use crate::math::vector::Vector;

/// Sets that angle in points of one assembly.
pub(super) fn turn_bodies(
    problem: &Problem,
    points: &mut [&mut Point],
    assembly: usize,
    cancel: &AtomicBool,
) -> Result<(), SolveError> {
    if problem.targets.iter().all(|target| target.freedom != Freedom::Turned) {
        return Ok(());
    }
    let motion = problem.at_positions(points, assembly, cancel)?;
    let count = problem.positions();
    for (design, point) in points.iter_mut().enumerate() {
        for (target, positions, extra) in problem.parts() {
            let (Freedom::Turned, [.., angle]) = (target.freedom, &*target.numbers) else {
                continue;
            };
            let Some(found) = series(&motion, angle.quantity) else { continue };
            // The mean direction of what is missing.
            let missing = positions.zip(&angle.wanted).map(|(position, wanted)| {
                Vector::at_angle(wanted - found.derivatives[0][design * count + position])
            });
            let sum = missing.fold(Vector::ZERO, |sum, one| sum + one);
            let last = extra + target.extra() - 1;
            if sum.norm2() > 0.0 && sum.norm2().is_finite() {
                point.x[last] = sum.angle();
            }
        }
    }
    Ok(())
}
