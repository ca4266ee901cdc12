//! The ITP method: interpolate, truncate, project.

/// Locates the sign change between `a`, where the function is positive, and `b`, where it is not.
/// Returns the far end of a bracket no wider than `width`.
///
/// ITP method (Oliveira & Takahashi, An enhancement of the bisection method average performance
/// preserving minmax optimality, ACM TOMS 47 (2020)), with their κ₁ = 0.2/(b − a), κ₂ = 2, n₀ = 1:
/// at most one evaluation more than bisection. `far` decides whether a value is on the far side:
/// NaN counts as positive, and with a strict `far` zero does too.
///
/// # Errors
///
/// Those of `f`.
pub(crate) fn itp<E>(
    (mut a, mut fa): (f64, f64),
    (mut b, mut fb): (f64, f64),
    width: f64,
    far: impl Fn(f64) -> bool,
    mut f: impl FnMut(f64) -> Result<f64, E>,
) -> Result<f64, E> {
    /// n₀.
    const SLACK: i32 = 1;
    let half = 0.5 * width;
    let kappa = 0.2 / (b - a);
    let bisections = libm::log2((b - a) / width).ceil().max(0.0);
    // Half the greatest width of the bracket after each step.
    let mut radius = half * libm::exp2(bisections + f64::from(SLACK));
    while b - a > width {
        let middle = 0.5 * (a + b);
        let chord = (fb * a - fa * b) / (fb - fa);
        let regula_falsi = if chord.is_finite() { chord } else { middle };
        let to_middle = middle - regula_falsi;
        let push = kappa * ((b - a) * (b - a));
        let truncated =
            if push <= to_middle.abs() { regula_falsi + push.copysign(to_middle) } else { middle };
        let reach = (radius - 0.5 * (b - a)).max(0.0);
        let x = if (truncated - middle).abs() <= reach {
            truncated
        } else {
            middle - reach.copysign(to_middle)
        };
        // Rounding must not stop the bracket from closing.
        let x = if x > a && x < b { x } else { middle };
        if x <= a || x >= b {
            break;
        }
        let value = f(x)?;
        if far(value) {
            (b, fb) = (x, value);
            if value == 0.0 {
                break;
            }
        } else {
            (a, fa) = (x, value);
        }
        radius *= 0.5;
    }
    Ok(b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::convert::Infallible;

    fn root(a: f64, b: f64, f: impl Fn(f64) -> f64) -> (f64, u32) {
        let mut count = 0;
        let x = itp(
            (a, f(a)),
            (b, f(b)),
            4.0 * f64::EPSILON * b,
            |v| v <= 0.0,
            |x| {
                count += 1;
                Ok::<_, Infallible>(f(x))
            },
        );
        let Ok(x) = x;
        (x, count)
    }

    #[test]
    fn simple_roots_take_few_evaluations() {
        let (x, count) = root(0.0, 2.0, f64::cos);
        assert!((x - std::f64::consts::FRAC_PI_2).abs() < 1e-15 && count < 14, "{x}, {count}");
        let (x, count) = root(0.0, 1.0, |x| 0.3 - x);
        assert!((x - 0.3).abs() < 1e-15 && count < 14, "{x}, {count}");
    }

    #[test]
    fn bad_functions_take_at_most_one_more_than_bisection() {
        let most = 53;
        let jump = |x: f64| if x < 0.3 { 1.0 } else { -1e-9 };
        let (x, count) = root(0.0, 1.0, jump);
        assert!((x - 0.3).abs() < 1e-15 && jump(x) < 0.0 && count <= most, "{x}, {count}");
        let (x, count) = root(0.0, 1.0, |x| (0.3 - x).powi(9));
        assert!((x - 0.3).abs() < 1e-1 && count <= most, "{x}, {count}");
        let (x, count) = root(0.0, 1.0, |x| if x < 0.3 { f64::NAN } else { -1.0 });
        assert!((x - 0.3).abs() < 1e-15 && count <= most, "{x}, {count}");
        let (x, count) = root(0.0, 1.0, |x| 1e-12 - x.powi(3));
        assert!((x - 1e-4).abs() < 1e-14 && count <= most, "{x}, {count}");
    }
}
