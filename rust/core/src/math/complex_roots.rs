//! All complex roots of a polynomial, at once.

use super::vector::Vector;

/// Most rounds: near simple roots the number of correct digits triples with each.
const ROUNDS: usize = 60;
/// A round that moves no root farther than this, relative to the root, is the last: a further one would move
/// them by rounding alone.
const SETTLED: f64 = 1.0e-10;
/// The first guesses are this far round their circle from the real axis, on which conjugate roots would be
/// approached by the same steps.
const ASIDE: f64 = 0.4;

/// The roots of a polynomial, constant term first, by Aberth's iteration (O. Aberth, Math. Comp. 27 (1973)
/// 339); `None` if it does not settle, as where roots meet, or without a polynomial.
pub(crate) fn complex_roots(coefficients: &[Vector]) -> Option<Vec<Vector>> {
    let (&last, lower) = coefficients.split_last()?;
    let (degree, &first) = (lower.len(), lower.first()?);
    // The circle of the roots' geometric mean.
    let mean = libm::pow(first.norm() / last.norm(), 1.0 / degree as f64);
    let guess = |k: usize| {
        Vector::at_angle(ASIDE + std::f64::consts::TAU * k as f64 / degree as f64).scale(mean)
    };
    let mut roots: Vec<Vector> = (0..degree).map(guess).collect();
    for _ in 0..ROUNDS {
        let mut farthest = 0.0_f64;
        for index in 0..degree {
            let root = roots[index];
            let (value, slope) = value_and_slope(coefficients, root);
            let newton = over(value, slope);
            let others = roots.iter().enumerate().filter(|(other, _)| *other != index);
            let repelled =
                others.fold(Vector::ZERO, |sum, (_, &other)| sum + over(Vector::ONE, root - other));
            let step = over(newton, Vector::ONE - newton * repelled);
            if !step.norm2().is_finite() {
                return None;
            }
            roots[index] = root - step;
            farthest = farthest.max(step.norm() / root.norm());
        }
        if farthest <= SETTLED {
            return Some(roots);
        }
    }
    None
}

/// A polynomial and its derivative by Horner's scheme.
fn value_and_slope(coefficients: &[Vector], x: Vector) -> (Vector, Vector) {
    let start = (Vector::ZERO, Vector::ZERO);
    coefficients.iter().rev().fold(start, |(value, slope), &c| (value * x + c, slope * x + value))
}

fn over(a: Vector, b: Vector) -> Vector {
    (a * b.conj()).scale(1.0 / b.norm2())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The polynomial with given roots.
    fn product(roots: &[Vector]) -> Vec<Vector> {
        let mut polynomial = vec![Vector::new(2.0, -1.0)];
        for &root in roots {
            let mut next = vec![Vector::ZERO; polynomial.len() + 1];
            for (power, &c) in polynomial.iter().enumerate() {
                next[power + 1] += c;
                next[power] += -(c * root);
            }
            polynomial = next;
        }
        polynomial
    }

    #[test]
    fn finds_the_roots_of_products() {
        let place = [(1.0, 0.0), (-0.6, 0.8), (-0.6, -0.8), (3.0, 0.5), (0.1, -0.2), (0.0, 2.0)];
        for count in 1..=place.len() {
            let roots: Vec<Vector> =
                place[..count].iter().map(|&(x, y)| Vector::new(x, y)).collect();
            let found = complex_roots(&product(&roots)).unwrap_or_default();
            assert_eq!(found.len(), count);
            for root in roots {
                let near = found.iter().filter(|x| (**x - root).norm() < 1e-12).count();
                assert_eq!(near, 1, "{root:?}");
            }
        }
    }

    #[test]
    fn says_where_there_is_no_answer() {
        assert_eq!(complex_roots(&[]), None);
        assert_eq!(complex_roots(&[Vector::ONE]), None);
        assert_eq!(complex_roots(&[Vector::ONE, Vector::ZERO]), None);
        assert_eq!(complex_roots(&[Vector::NAN, Vector::ONE, Vector::ONE]), None);
        // A root at 0 has no digits that could settle.
        assert_eq!(complex_roots(&[Vector::ZERO, Vector::ONE, Vector::ONE]), None);
    }
}
