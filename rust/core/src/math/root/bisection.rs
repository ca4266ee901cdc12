//! Bisection.

/// Halvings after which any bracket of binary64 has closed: its width is below 2^1025, and the
/// least spacing is 2^-1074.
pub(crate) const TO_ROUNDING: u32 = 2100;

/// Narrows a bracket between a point with a property, `near`, and one without it, `far` (Press et al.,
/// Numerical Recipes, 3rd ed. 2007, 9.1). Either may be the greater.
///
/// Returns the bracket after `max_halvings`, or earlier when its ends are neighbouring numbers. The
/// property holds at the near end and not at the far one; neither end is evaluated.
///
/// # Errors
///
/// Those of `is_near`.
pub(crate) fn bisect<E>(
    [mut near, mut far]: [f64; 2],
    max_halvings: u32,
    mut is_near: impl FnMut(f64) -> Result<bool, E>,
) -> Result<[f64; 2], E> {
    for _ in 0..max_halvings {
        let middle = 0.5 * (near + far);
        if middle == near || middle == far {
            break;
        }
        *(if is_near(middle)? { &mut near } else { &mut far }) = middle;
    }
    Ok([near, far])
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::convert::Infallible;

    fn bracket(ends: [f64; 2], max_halvings: u32, is_near: impl Fn(f64) -> bool) -> [f64; 2] {
        let Ok(ends) = bisect(ends, max_halvings, |x| Ok::<_, Infallible>(is_near(x)));
        ends
    }

    #[test]
    fn ends_at_neighbouring_numbers() {
        let [near, far] = bracket([1.0, 2.0], TO_ROUNDING, |x| x * x < 2.0);
        assert!(near * near < 2.0 && far * far >= 2.0);
        assert_eq!(far.to_bits(), near.to_bits() + 1);
        let [near, far] = bracket([2.0, 1.0], TO_ROUNDING, |x| x * x >= 2.0);
        assert_eq!(near.to_bits(), far.to_bits() + 1);
    }

    #[test]
    fn the_widest_brackets_close() {
        assert_eq!(bracket([0.0, f64::MAX], TO_ROUNDING, |_| false), [0.0, 5e-324]);
        let widest = bracket([-0.5 * f64::MAX, f64::MAX], TO_ROUNDING, |x| x < 1e-300);
        assert_eq!(widest[1].to_bits(), widest[0].to_bits() + 1);
    }

    #[test]
    fn stops_at_the_limit_and_at_errors() {
        assert_eq!(bracket([0.0, 1.0], 3, |_| false), [0.0, 0.125]);
        assert_eq!(bisect([0.0, 1.0], 3, Err), Err(0.5));
        // Neither NaN nor a sum that overflows makes an endless loop.
        assert!(bracket([f64::NAN, 1.0], TO_ROUNDING, |_| true)[0].is_nan());
        assert_eq!(bracket([0.0, f64::INFINITY], TO_ROUNDING, |_| true), [0.0, f64::INFINITY]);
    }
}
