//! All solutions of quadratic equations u_k² = a_k(u)² + b_k(u)², with a_k and b_k linear: the sizes of
//! forces on which friction depends.
//!
//! A total-degree homotopy (A. J. Sommese and C. W. Wampler, *The Numerical Solution of Systems of
//! Polynomials*, 2005, ch. 8): the 2ⁿ solutions of u_k² = 1 are followed to those of the equations in
//! complex numbers. By Bézout's theorem no isolated solution is left out. In homogeneous coordinates
//! paths that lead to infinity end like others.

use nalgebra::{Complex, DMatrix, DVector};

type Number = Complex<f64>;

/// Turns the start out of the real numbers, so that no two paths meet but at the end.
const GAMMA: Number = Number { re: 0.614_930_271, im: 0.788_580_493 };
/// The longest and shortest step of the way from 0 to 1.
const LONGEST: f64 = 0.1;
const SHORTEST: f64 = 1.0e-12;
/// Steps of a path, and of Newton's iteration on it.
const MAX_STEPS: usize = 10_000;
const CORRECTIONS: usize = 3;
/// A correction that is this small is the last one.
const LAST_CORRECTION: f64 = 1.0e-11;
/// A solution whose first homogeneous coordinate is this small is at infinity; a larger one may be, too.
const AT_INFINITY: f64 = 1.0e-15;

/// The equations; each form lists its constant term, then the factors of the unknowns.
pub(super) struct Quadrics {
    pub forms: Vec<[Vec<f64>; 2]>,
}

impl Quadrics {
    /// All isolated finite solutions, real or not, each as often as its multiplicity; some may be at
    /// infinity but for rounding.
    pub(super) fn solutions(&self) -> Vec<Vec<Number>> {
        let n = self.forms.len();
        (0..1_usize << n).filter_map(|signs| self.end_of_path(signs)).collect()
    }

    /// Follows the path that begins at u_k = ±1.
    fn end_of_path(&self, signs: usize) -> Option<Vec<Number>> {
        let n = self.forms.len();
        let mut point = DVector::from_fn(n + 1, |k, _| {
            let is_negative = k > 0 && signs >> (k - 1) & 1 == 1;
            Number::new(if is_negative { -1.0 } else { 1.0 }, 0.0)
        });
        let height: Number = point.iter().enumerate().map(|(k, &u)| patch(k) * u).sum();
        point /= height;
        let (mut at, mut step) = (0.0, LONGEST);
        for _ in 0..MAX_STEPS {
            if at >= 1.0 {
                break;
            }
            let next = f64::min(at + step, 1.0);
            match self.advance(&point, at, next) {
                Some(found) => {
                    point = found;
                    at = next;
                    step = (1.5 * step).min(LONGEST);
                }
                None if step > SHORTEST => step *= 0.5,
                // A multiple solution: its path has come as near as it can.
                None => break,
            }
        }
        if let Some(correction) = self.jacobian(&point, 1.0).lu().solve(&self.value(&point, 1.0))
            && at >= 1.0
        {
            // Of a solution far away the first coordinate is small, and wanted to many digits.
            point -= correction;
        }
        let size = point.iter().map(|u| u.norm()).fold(0.0, f64::max);
        let first = point[0];
        (first.norm() > AT_INFINITY * size)
            .then(|| point.iter().skip(1).map(|u| u / first).collect())
    }

    /// A step along the tangent, corrected.
    fn advance(&self, from: &DVector<Number>, at: f64, next: f64) -> Option<DVector<Number>> {
        let rate = self.rate(from);
        let tangent = self.jacobian(from, at).lu().solve(&rate)?;
        let mut point = from - tangent * Number::from(next - at);
        for _ in 0..CORRECTIONS {
            let correction = self.jacobian(&point, next).lu().solve(&self.value(&point, next))?;
            point -= &correction;
            let size = correction.iter().map(|u| u.norm()).fold(0.0, f64::max);
            if size <= LAST_CORRECTION {
                return Some(point);
            }
        }
        None
    }

    /// Start u_k² − u₀² and end u_k² − a_k² − b_k² of each equation.
    fn parts(&self, point: &DVector<Number>, k: usize) -> [Number; 2] {
        let square = point[k + 1] * point[k + 1];
        let [a, b] = [0, 1].map(|form| product(&self.forms[k][form], point));
        [square - point[0] * point[0], square - a * a - b * b]
    }

    fn value(&self, point: &DVector<Number>, at: f64) -> DVector<Number> {
        let n = self.forms.len();
        DVector::from_fn(n + 1, |k, _| {
            if k == n {
                point.iter().enumerate().map(|(k, &u)| patch(k) * u).sum::<Number>() - 1.0
            } else {
                let [start, end] = self.parts(point, k);
                GAMMA * start * (1.0 - at) + end * at
            }
        })
    }

    fn rate(&self, point: &DVector<Number>) -> DVector<Number> {
        let n = self.forms.len();
        DVector::from_fn(n + 1, |k, _| {
            if k == n {
                return Number::from(0.0);
            }
            let [start, end] = self.parts(point, k);
            end - GAMMA * start
        })
    }

    fn jacobian(&self, point: &DVector<Number>, at: f64) -> DMatrix<Number> {
        let n = self.forms.len();
        let mut matrix = DMatrix::from_element(n + 1, n + 1, Number::from(0.0));
        for k in 0..n {
            let [a, b] = [0, 1].map(|form| product(&self.forms[k][form], point));
            for column in 0..=n {
                let [from_a, from_b] = [0, 1].map(|form| self.forms[k][form][column]);
                matrix[(k, column)] = -(a * from_a + b * from_b) * (2.0 * at);
            }
            let start = GAMMA * (1.0 - at);
            matrix[(k, k + 1)] += (start + at) * point[k + 1] * 2.0;
            matrix[(k, 0)] -= start * point[0] * 2.0;
        }
        for column in 0..=n {
            matrix[(n, column)] = patch(column);
        }
        matrix
    }
}

fn product(form: &[f64], point: &DVector<Number>) -> Number {
    form.iter().zip(point.iter()).map(|(&factor, &u)| u * factor).sum()
}

/// Factors of the plane in which homogeneous coordinates are scaled: any that are not special.
fn patch(k: usize) -> Number {
    Number::from_polar(1.0, 0.5 + 2.399_963_229_728_653 * k as f64)
}
