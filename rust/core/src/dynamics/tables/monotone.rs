//! Slopes of cubics that stay between the values at their ends.

use std::sync::atomic::AtomicBool;

use super::passes::collected;

/// Width and rise of the line between two neighbouring knots.
pub(crate) type Leg = [f64; 2];

/// Slopes at the knots of some legs, with the leg before and the one behind where the curve goes on.
///
/// Monotone data give a monotone curve: F. N. Fritsch & R. E. Carlson, Monotone Piecewise Cubic
/// Interpolation, SIAM J. Numer. Anal. 17 (1980) 238; at an inner knot the weighted harmonic mean of
/// F. N. Fritsch & J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300, at an end the slope of
/// C. Moler, Numerical Computing with MATLAB (2004), section 3.6.
///
/// Fewer once `cancel` is true.
pub(crate) fn slopes(legs: &[Leg], beyond: [Option<Leg>; 2], cancel: &AtomicBool) -> Vec<f64> {
    let [before, behind] = beyond;
    let last = legs.len() - 1;
    collected(legs.len() + 1, cancel, |knot| {
        let left = knot.checked_sub(1).map_or(before, |i| Some(legs[i]));
        match (left, legs.get(knot).copied().or(behind)) {
            (Some(left), Some(right)) => inner(left, right),
            (None, Some(leg)) => end(leg, legs.get(1).copied().or(behind)),
            (Some(leg), None) => end(leg, last.checked_sub(1).map_or(before, |i| Some(legs[i]))),
            (None, None) => 0.0,
        }
    })
}

/// The slope between two legs: zero at an extreme of the data.
fn inner([h, r]: Leg, [g, s]: Leg) -> f64 {
    if r == 0.0 || s == 0.0 || (r > 0.0) != (s > 0.0) {
        return 0.0;
    }
    // (w + v)/(w/r + v/s), by the ratio of the rises: neither of them need have a finite inverse.
    let (w, v) = (2.0 * g + h, g + 2.0 * h);
    let ([small, small_weight], [large, large_weight]) =
        if r.abs() < s.abs() { ([r, w], [s, v]) } else { ([s, v], [r, w]) };
    (w + v) / (small_weight + large_weight * (small / large)) * small
}

/// The slope at an end, from the leg there and the next one: that of their parabola, limited.
fn end([h, r]: Leg, next: Option<Leg>) -> f64 {
    let Some([g, s]) = next else {
        return r;
    };
    let slope = r + h / (h + g) * (r - s);
    if slope == 0.0 || r == 0.0 || (slope > 0.0) != (r > 0.0) {
        0.0
    } else if (s > 0.0) != (r > 0.0) && slope.abs() > 3.0 * r.abs() {
        3.0 * r
    } else {
        slope
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn slopes(legs: &[Leg], beyond: [Option<Leg>; 2]) -> Vec<f64> {
        super::slopes(legs, beyond, &AtomicBool::new(false))
    }

    #[test]
    fn slopes_of_known_data() {
        // SciPy 1.11: PchipInterpolator([0, 1, 3, 4], [0, 1, 1.5, 5]).derivative().
        let legs = [[1.0, 1.0], [2.0, 0.25], [1.0, 3.5]];
        let actual = slopes(&legs, [None; 2]);
        let expected = [1.25, 9.0 / (5.0 + 4.0 / 0.25), 9.0 / (4.0 / 0.25 + 5.0 / 3.5), 4.583_333];
        for (slope, reference) in actual.iter().zip(expected) {
            assert!((slope - reference).abs() < 1e-6, "{slope} {reference}");
        }
        assert_eq!(slopes(&[[2.0, 3.0]], [None; 2]), [3.0, 3.0]);
        // An extreme, and level rows.
        assert_eq!(slopes(&[[1.0, 1.0], [1.0, -1.0], [1.0, 0.0]], [None; 2])[1..3], [0.0, 0.0]);
    }

    #[test]
    fn a_leg_beyond_an_end_makes_it_an_inner_knot() {
        let legs = [[1.0, 1.0], [2.0, 0.25], [1.0, 3.5]];
        let all = slopes(&legs, [None; 2]);
        assert_eq!(slopes(&legs[1..2], [Some(legs[0]), Some(legs[2])]), all[1..3]);
        assert_eq!(slopes(&legs[1..], [Some(legs[0]), None]), all[1..]);
    }

    #[test]
    fn rises_of_any_size() {
        for (r, s) in [(1e-310, 1e300), (1e300, 1e-310), (-1e-300, -1e300), (1e308, 1e308)] {
            let slope = inner([1.0, r], [1.0, s]);
            assert!(slope.is_finite() && slope.abs() <= 3.0 * r.abs().min(s.abs()), "{slope}");
        }
    }
}
