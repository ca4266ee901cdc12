//! Tolerances of a run.

use super::callbacks::Callbacks;
use super::error::RunError;
use super::model::ReducedModel;
use super::options::RunOptions;
use super::system::RunSystem;
use super::variable::Variable;
use crate::dynamics::driver_scales::small_speeds;
use crate::ode::system::Fault;

/// Relative and absolute tolerances of the state.
pub(crate) fn tolerances<S: ReducedModel, O: Callbacks>(
    system: &mut RunSystem<'_, S, O>,
    options: &RunOptions<'_>,
    sizes: &[f64],
) -> Result<[Vec<f64>; 2], RunError<O::Error>> {
    let (n, relative) = (options.q.len(), options.relative);
    if options.along == Variable::Coordinate {
        // From a thousandth of the typical speed for q̇², from all of it for the time: the initial
        // speed may be small.
        let typical = 1e3 * typical_speeds(system, options, sizes)?[0];
        let of_speed = options.absolute.map_or(relative * typical * 1e-3, |[_, of_speed]| of_speed);
        let absolute = vec![
            2.0 * of_speed * options.speed[0].abs(),
            relative * sizes[0] / typical,
            f64::INFINITY,
        ];
        return Ok([vec![relative, relative, 0.0], absolute]);
    }
    let mut absolute = Vec::with_capacity(2 * n + 1);
    if let Some([of_q, of_speed]) = options.absolute {
        absolute.extend(std::iter::repeat_n(of_q, n));
        absolute.extend(std::iter::repeat_n(of_speed, n));
    } else {
        absolute.extend(sizes.iter().map(|size| relative * size));
        absolute.extend(typical_speeds(system, options, sizes)?.iter().map(|v| relative * v));
    }
    absolute.push(f64::INFINITY);
    // An angle counts turns, so its size gives no tolerance.
    let relative = [vec![0.0; n], vec![relative; n], vec![0.0]].concat();
    Ok([relative, absolute])
}

/// A thousandth of the typical speeds; see [`small_speeds`].
fn typical_speeds<S: ReducedModel, O: Callbacks>(
    system: &mut RunSystem<'_, S, O>,
    options: &RunOptions<'_>,
    sizes: &[f64],
) -> Result<Vec<f64>, RunError<O::Error>> {
    let n = options.q.len();
    let mut accelerations = vec![0.0; n];
    let equation = &mut system.equation;
    let outcome = equation
        .set_configuration(options.q)
        .and_then(|()| equation.apply_loads(options.t, options.q, options.speed))
        .and_then(|()| equation.accelerations(options.q, options.speed, &mut accelerations));
    match outcome {
        Err(Fault::Error(error)) => return Err(error),
        // The run will end where it begins.
        Err(Fault::OutOfDomain) => accelerations.fill(0.0),
        Ok(()) => {}
    }
    let duration = (options.end - options.t).abs();
    let mut typical = vec![0.0; n];
    small_speeds([options.speed, &accelerations], sizes, duration, &mut typical);
    Ok(typical)
}
