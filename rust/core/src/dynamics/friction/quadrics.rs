//! All solutions of quadratic equations uₖ² = aₖ(u)² + bₖ(u)², with aₖ and bₖ linear: the sizes of
//! forces on which friction depends.
//!
//! A total-degree homotopy (A. J. Sommese and C. W. Wampler, *The Numerical Solution of Systems of
//! Polynomials*, 2005, ch. 8): the 2ⁿ solutions of uₖ² = 1 are followed to those of the equations in
//! complex numbers. By Bézout's theorem they reach every isolated solution. In homogeneous coordinates
//! paths that lead to infinity end like others.

use nalgebra::Complex;

type Number = Complex<f64>;

/// Turns the start out of the real numbers, so that no two paths meet but at the end.
const GAMMA: Number = Number { re: 0.614_930_271, im: 0.788_580_493 };
/// The first and the shortest step of the way from 0 to 1.
const FIRST: f64 = 0.05;
const SHORTEST: f64 = 1.0e-12;
/// Steps of a path, and of Newton's iteration on it.
const MAX_STEPS: usize = 10_000;
const CORRECTIONS: usize = 3;
/// A correction below this is the last: the next would be about its square.
const LAST_CORRECTION: f64 = 1.0e-5;
/// The first correction of a step, relative to the point: the greatest allowed, and the greatest after which
/// the next step may be longer.
const MOST_CORRECTION: f64 = 0.02;
const EASY: f64 = 2.0e-3;
/// A solution with a first homogeneous coordinate below this is at infinity; others may be, too.
const AT_INFINITY: f64 = 1.0e-15;

/// Most unknowns. Vectors and matrices of a fixed size need no allocation, which would take most of the time.
pub(super) const MAX_UNKNOWNS: usize = 15;

/// Homogeneous coordinates, and vectors of the same length; the other entries are not used.
type Point = [Number; MAX_UNKNOWNS + 1];

/// The equations; each form lists its constant term, then the factors of the unknowns.
pub(super) struct Quadrics {
    pub forms: Vec<[Vec<f64>; 2]>,
}

impl Quadrics {
    /// All isolated finite solutions, real or not, each as often as its multiplicity; some may be at
    /// infinity to rounding. At most [`MAX_UNKNOWNS`] unknowns. If the work is cancelled, those found so far.
    pub(super) fn solutions(&self, goes_on: impl Fn() -> bool) -> Vec<Vec<Number>> {
        let paths = (0..1_usize << self.forms.len()).take_while(|_| goes_on());
        paths.filter_map(|signs| self.end_of_path(signs)).collect()
    }

    /// Follows the path that begins at uₖ = ±1.
    fn end_of_path(&self, signs: usize) -> Option<Vec<Number>> {
        let n = self.forms.len();
        let mut point = [Number::ZERO; MAX_UNKNOWNS + 1];
        let mut height = Number::ZERO;
        for (k, u) in point.iter_mut().enumerate().take(n + 1) {
            let is_negative = k > 0 && signs >> (k - 1) & 1 == 1;
            *u = Number::from(if is_negative { -1.0 } else { 1.0 });
            height += patch(k) * *u;
        }
        for u in &mut point {
            *u /= height;
        }
        let (mut at, mut step) = (0.0, FIRST);
        for _ in 0..MAX_STEPS {
            if at >= 1.0 {
                break;
            }
            let next = f64::min(at + step, 1.0);
            match self.advance(&point, at, next) {
                Some((corrected, is_easy)) => {
                    point = corrected;
                    at = next;
                    step *= if is_easy { 2.0 } else { 1.0 };
                }
                None if step > SHORTEST => step *= 0.25,
                // A multiple solution: its path can come no nearer.
                None => break,
            }
        }
        for _ in 0..CORRECTIONS {
            // The first coordinate of a solution far away is small, and needed to many digits.
            match self.newton(&point, 1.0) {
                Some(correction) if at >= 1.0 => subtract(&mut point, &correction),
                _ => break,
            }
        }
        let first = point[0];
        (first.norm() > AT_INFINITY * size(&point))
            .then(|| point[1..=n].iter().map(|u| u / first).collect())
    }

    /// The negative rate of the point along the path.
    fn tangent(&self, point: &Point, at: f64) -> Option<Point> {
        let mut rate = [Number::ZERO; MAX_UNKNOWNS + 1];
        for (k, rate) in rate.iter_mut().enumerate().take(self.forms.len()) {
            let [start, end] = self.parts(point, k);
            *rate = end - GAMMA * start;
        }
        self.solve(point, at, rate)
    }

    /// A step by the midpoint rule, corrected; and whether a longer one would have been accepted.
    fn advance(&self, from: &Point, at: f64, next: f64) -> Option<(Point, bool)> {
        let half = self.tangent(from, at)?;
        let mut middle = *from;
        for (u, rate) in middle.iter_mut().zip(&half) {
            *u -= rate * (0.5 * (next - at));
        }
        let rate = self.tangent(&middle, 0.5 * (at + next))?;
        let mut point = *from;
        for (u, rate) in point.iter_mut().zip(&rate) {
            *u -= rate * (next - at);
        }
        let mut first = 0.0;
        for round in 0..CORRECTIONS {
            let correction = self.newton(&point, next)?;
            subtract(&mut point, &correction);
            let moved = size(&correction);
            if round == 0 {
                first = moved;
            }
            if first > MOST_CORRECTION * size(from) {
                return None;
            }
            if moved <= LAST_CORRECTION {
                return Some((point, first <= EASY));
            }
        }
        None
    }

    /// A step of Newton's iteration.
    fn newton(&self, point: &Point, at: f64) -> Option<Point> {
        let n = self.forms.len();
        let mut value = [Number::ZERO; MAX_UNKNOWNS + 1];
        for (k, value) in value.iter_mut().enumerate().take(n) {
            let [start, end] = self.parts(point, k);
            *value = GAMMA * start * (1.0 - at) + end * at;
        }
        value[n] = Number::from(-1.0);
        for (k, u) in point.iter().enumerate().take(n + 1) {
            value[n] += patch(k) * u;
        }
        self.solve(point, at, value)
    }

    /// Start uₖ² − u₀² and end uₖ² − aₖ² − bₖ² of each equation.
    fn parts(&self, point: &Point, k: usize) -> [Number; 2] {
        let square = point[k + 1] * point[k + 1];
        let [a, b] = [0, 1].map(|form| product(&self.forms[k][form], point));
        [square - point[0] * point[0], square - a * a - b * b]
    }

    /// Solves the equations linear at a point, by Gauss's elimination.
    fn solve(&self, point: &Point, at: f64, mut right: Point) -> Option<Point> {
        let n = self.forms.len();
        let mut matrix = [[Number::ZERO; MAX_UNKNOWNS + 1]; MAX_UNKNOWNS + 1];
        for k in 0..n {
            let [a, b] = [0, 1].map(|form| product(&self.forms[k][form], point) * (-2.0 * at));
            let [of_a, of_b] = &self.forms[k];
            for (entry, (&of_a, &of_b)) in matrix[k].iter_mut().zip(of_a.iter().zip(of_b)) {
                *entry = a * of_a + b * of_b;
            }
            let start = GAMMA * (1.0 - at);
            matrix[k][k + 1] += (start + at) * point[k + 1] * 2.0;
            matrix[k][0] -= start * point[0] * 2.0;
        }
        for (k, entry) in matrix[n].iter_mut().enumerate().take(n + 1) {
            *entry = patch(k);
        }
        for column in 0..=n {
            let pivot = (column..=n).fold(column, |best, row| {
                let [size, best_size] = [row, best].map(|row| matrix[row][column].norm_sqr());
                if size > best_size { row } else { best }
            });
            matrix.swap(column, pivot);
            right.swap(column, pivot);
            if matrix[column][column] == Number::ZERO {
                return None;
            }
            let inverse = Number::from(1.0) / matrix[column][column];
            let pivot_row = matrix[column];
            let pivot_right = right[column];
            for row in column + 1..=n {
                let factor = matrix[row][column] * inverse;
                for (entry, above) in matrix[row][column..=n].iter_mut().zip(&pivot_row[column..=n])
                {
                    *entry -= factor * above;
                }
                right[row] -= factor * pivot_right;
            }
        }
        for row in (0..=n).rev() {
            let mut sum = right[row];
            for column in row + 1..=n {
                sum -= matrix[row][column] * right[column];
            }
            right[row] = sum / matrix[row][row];
        }
        right[..=n].iter().all(|u| u.re.is_finite() && u.im.is_finite()).then_some(right)
    }
}

fn product(form: &[f64], point: &Point) -> Number {
    let mut sum = Number::ZERO;
    for (&factor, u) in form.iter().zip(point) {
        sum += u * factor;
    }
    sum
}

fn subtract(point: &mut Point, step: &Point) {
    for (u, step) in point.iter_mut().zip(step) {
        *u -= step;
    }
}

fn size(point: &Point) -> f64 {
    point.iter().map(|u| u.norm()).fold(0.0, f64::max)
}

/// Factors of the plane to which homogeneous coordinates are scaled: arbitrary generic numbers.
fn patch(k: usize) -> Number {
    const PATCH: [Number; MAX_UNKNOWNS + 1] = [
        Number { re: 0.877582562, im: 0.479425539 },
        Number { re: -0.970949367, im: 0.239285031 },
        Number { re: 0.554313129, im: -0.832308209 },
        Number { re: 0.153482867, im: 0.988151309 },
        Number { re: -0.780660108, im: -0.624955835 },
        Number { re: 0.997786069, im: -0.066505343 },
        Number { re: -0.690812681, im: 0.723033775 },
        Number { re: 0.020981474, im: -0.999779865 },
        Number { re: 0.659870509, im: 0.751379339 },
        Number { re: -0.994117428, im: -0.108307616 },
        Number { re: 0.806191996, im: -0.591654009 },
        Number { re: -0.194804347, im: 0.980842121 },
        Number { re: -0.518906670, im: -0.854830900 },
        Number { re: 0.960055605, im: 0.279809282 },
        Number { re: -0.896923579, im: 0.442185587 },
        Number { re: 0.362671461, im: -0.931917063 },
    ];
    PATCH[k]
}
