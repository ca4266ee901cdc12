//! Double roots by successive parabolic interpolation.

/// Finds a point near `m` where a function is not positive, if any, between `a` and `c`.
/// The function is positive at all three and least at `m`, so it may have two roots around its
/// minimum, which is searched by parabolas through three points (P. Jarratt, An iterative method
/// for locating turning points, Computer J. 10 (1967); R. P. Brent, Algorithms for Minimization
/// without Derivatives, 1973, ch. 3).
///
/// Returns the first point found, or `None` as soon as a parabola shows no root near by, the
/// minimum is located, or the function is NaN; also after 20 steps.
///
/// # Errors
///
/// Those of `f`.
pub(crate) fn find_double_root<E>(
    mut a: (f64, f64),
    mut m: (f64, f64),
    mut c: (f64, f64),
    mut f: impl FnMut(f64) -> Result<f64, E>,
) -> Result<Option<f64>, E> {
    /// Limit of iterations: parabolas converge superlinearly.
    const MAX_STEPS: u32 = 20;
    /// A minimum is flat: it cannot be located closer than the square root of the unit roundoff.
    const RESOLUTION: f64 = 1e-9;
    /// A parabola whose minimum is above this fraction of its lowest point shows no root near by.
    /// (One half, because the parabola is only an estimate.)
    const ROOT_FRACTION: f64 = 0.5;
    for _ in 0..MAX_STEPS {
        let (left, right) = (m.0 - a.0, c.0 - m.0);
        let (slope_left, slope_right) = ((m.1 - a.1) / left, (c.1 - m.1) / right);
        let curvature = (slope_right - slope_left) / (left + right);
        let slope = (slope_left * right + slope_right * left) / (left + right);
        let offset = -0.5 * slope / curvature;
        if !offset.is_finite() || m.1 + 0.5 * slope * offset > ROOT_FRACTION * m.1 {
            return Ok(None);
        }
        // Already at the minimum of the parabola: step aside into the wider half.
        let aside = if left > right { -0.1 * left } else { 0.1 * right };
        let offset = if offset.abs() < RESOLUTION * (c.0 - a.0) { aside } else { offset };
        let x = m.0 + offset;
        if x <= a.0 || x >= c.0 || left.max(right) < RESOLUTION {
            return Ok(None);
        }
        let value = f(x)?;
        if value <= 0.0 {
            return Ok(Some(x));
        }
        if value.is_nan() {
            return Ok(None);
        }
        let new = (x, value);
        match (x < m.0, value < m.1) {
            (true, true) => (c, m) = (m, new),
            (true, false) => a = new,
            (false, true) => (a, m) = (m, new),
            (false, false) => c = new,
        }
    }
    Ok(None)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::convert::Infallible;

    #[test]
    fn finds_dips_below_zero() {
        for depth in [1e-3, 1e-8, 1e-14] {
            let f = |x: f64| 1.0 - (x - 0.27).cos() - depth;
            let at = |x: f64| (x, f(x));
            let Ok(point) =
                find_double_root(at(0.0), at(0.25), at(0.5), |x| Ok::<_, Infallible>(f(x)));
            assert!(f(point.unwrap()) <= 0.0);
            let f = |x: f64| 1.0 - (x - 0.27).cos() + depth;
            let at = |x: f64| (x, f(x));
            let Ok(point) =
                find_double_root(at(0.0), at(0.25), at(0.5), |x| Ok::<_, Infallible>(f(x)));
            assert_eq!(point, None);
        }
    }
}
