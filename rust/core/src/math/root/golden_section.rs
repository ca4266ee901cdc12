//! Golden-section search.

/// (√5 − 1)/2.
const GOLDEN: f64 = 0.618_033_988_749_894_8;
/// Limit of steps: 40 narrow the bracket to 4e-9 of its width, below the √u within which rounding
/// hides the differences of the values.
const MAX_STEPS: u32 = 40;

/// A bracket of a maximum with two inner points, which divide it by the golden section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Bracket {
    /// Its ends, the lesser first.
    pub ends: [f64; 2],
    /// The inner points and the values there.
    pub inner: [(f64, f64); 2],
}

impl Bracket {
    /// Distance between the ends.
    pub(crate) fn width(&self) -> f64 {
        self.ends[1] - self.ends[0]
    }

    /// The inner point with the greater value.
    pub(crate) fn best(&self) -> (f64, f64) {
        let [c, d] = self.inner;
        if c.1 > d.1 { c } else { d }
    }
}

/// Narrows a bracket of the maximum of a function that rises and then falls (J. Kiefer, Sequential
/// minimax search for a maximum, Proc. AMS 4 (1953)): one evaluation a step, after two at first.
///
/// Returns the bracket as soon as `is_narrow` accepts it, or after 40 steps.
///
/// # Errors
///
/// Those of `f`.
pub(crate) fn golden_section<E>(
    [mut a, mut b]: [f64; 2],
    is_narrow: impl Fn(&Bracket) -> bool,
    mut f: impl FnMut(f64) -> Result<f64, E>,
) -> Result<Bracket, E> {
    let (left, right) = (b - GOLDEN * (b - a), a + GOLDEN * (b - a));
    let (mut c, mut d) = ((left, f(left)?), (right, f(right)?));
    for _ in 0..MAX_STEPS {
        if is_narrow(&Bracket { ends: [a, b], inner: [c, d] }) {
            break;
        }
        if c.1 > d.1 {
            (b, d) = (d.0, c);
            let x = b - GOLDEN * (b - a);
            c = (x, f(x)?);
        } else {
            (a, c) = (c.0, d);
            let x = a + GOLDEN * (b - a);
            d = (x, f(x)?);
        }
    }
    Ok(Bracket { ends: [a, b], inner: [c, d] })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::convert::Infallible;

    #[test]
    fn brackets_a_maximum() {
        let f = |x: f64| Ok::<_, Infallible>(-(x - 0.3) * (x - 0.3));
        let Ok(bracket) = golden_section([-1.0, 2.0], |bracket| bracket.width() <= 1e-5, f);
        assert!(
            bracket.width() <= 1e-5 && bracket.ends[0] < 0.3 && bracket.ends[1] > 0.3,
            "{bracket:?}"
        );
        assert!((bracket.best().0 - 0.3).abs() < 1e-5);
        let Ok(narrowest) = golden_section([-1.0, 2.0], |_| false, f);
        assert!(narrowest.width() < 3e-8 && (narrowest.best().0 - 0.3).abs() < 3e-8);
    }

    #[test]
    fn stops_early_and_at_errors() {
        let positive = |bracket: &Bracket| bracket.inner.iter().any(|point| point.1 > 0.0);
        let Ok(bracket) = golden_section([0.0, 1.0], positive, |x| Ok::<_, Infallible>(0.01 - x));
        assert!(bracket.best().1 > 0.0 && bracket.best().0 < 0.01);
        assert!(golden_section([0.0, 1.0], |_| false, |_| Err(())).is_err());
    }
}
