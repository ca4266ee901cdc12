//! Index tables of power series in one or two drivers, truncated after order 3.

use crate::oracles::double_double::Dd;

/// Highest order of the analogues.
pub const ORDER: usize = 3;

/// `factor · first[left] · second[right]`.
#[derive(Debug, Clone, Copy)]
pub struct Term {
    pub factor: f64,
    pub left: usize,
    pub right: usize,
}

/// Which coefficients make those of a product and of a sine.
#[derive(Debug, Clone)]
pub struct Tables {
    /// Exponents of every coefficient, by total degree.
    pub exponents: Vec<Vec<usize>>,
    /// Coefficient of a product: Σ a[left] b[right] (Cauchy).
    pub product: Vec<Vec<Term>>,
    /// Coefficient of the cosine (negative: with the sine for b) and of the sine:
    /// Σ factor θ[left] b[right], from n cₙ = −Σ j θⱼ sₙ₋ⱼ (Knuth 4.7, ex. 4).
    pub turning: Vec<Vec<Term>>,
}

impl Tables {
    pub fn new(drivers: usize) -> Self {
        let mut exponents: Vec<Vec<usize>> = vec![Vec::new()];
        for _ in 0..drivers {
            exponents = (exponents.iter())
                .flat_map(|e| (0..=ORDER).map(move |p| [&e[..], &[p]].concat()))
                .filter(|e| e.iter().sum::<usize>() <= ORDER)
                .collect();
        }
        exponents.sort_by_key(|e| e.iter().sum::<usize>());
        let entry = |e: &[usize]| exponents.iter().position(|x| x == e);
        let product: Vec<Vec<Term>> = exponents
            .iter()
            .map(|whole| {
                let splits = exponents.iter().enumerate().filter_map(|(left, part)| {
                    let pairs = whole.iter().zip(part);
                    let rest: Option<Vec<usize>> = pairs.map(|(w, p)| w.checked_sub(*p)).collect();
                    Some(Term { factor: 1.0, left, right: entry(&rest?)? })
                });
                splits.collect()
            })
            .collect();
        let turning = exponents
            .iter()
            .zip(&product)
            .map(|(whole, terms)| {
                let Some(axis) = whole.iter().position(|&e| e > 0) else { return Vec::new() };
                let weigh = |t: &Term| Term {
                    factor: exponents[t.left][axis] as f64 / whole[axis] as f64,
                    ..*t
                };
                terms.iter().map(weigh).filter(|t| t.factor != 0.0).collect()
            })
            .collect();
        Self { exponents, product, turning }
    }

    pub fn len(&self) -> usize {
        self.exponents.len()
    }

    /// The driver of a coefficient of degree 1, else none.
    pub fn driver_of(&self, k: usize) -> Option<usize> {
        let e = &self.exponents[k];
        (e.iter().sum::<usize>() == 1).then(|| e.iter().position(|&p| p == 1)).flatten()
    }

    /// Coefficient of the partial derivative by `drivers` (indices), and the
    /// factorials by which it is multiplied.
    pub fn partial(&self, drivers: &[usize]) -> (usize, f64) {
        let mut wanted = vec![0; self.exponents[0].len()];
        let mut factor = 1.0;
        for &d in drivers {
            wanted[d] += 1;
            factor *= wanted[d] as f64;
        }
        let entry = self.exponents.iter().position(|e| *e == wanted);
        (entry.expect("a partial derivative of order 3 at most"), factor)
    }
}

/// Σ factor a[left] b[right]; a factor of 1 costs nothing in accuracy, and the
/// others are quotients of small numbers, taken exactly in double-double.
pub fn convolve(terms: &[Term], a: &[Dd], b: &[Dd]) -> Dd {
    terms.iter().fold(Dd::ZERO, |sum, t| {
        let product = a[t.left] * b[t.right];
        sum + if t.factor == 1.0 { product } else { product * Dd::from(t.factor) }
    })
}

#[test]
fn sine_of_a_line() {
    // θ = q: the Taylor coefficients of the cosine and the sine.
    let tables = Tables::new(1);
    let theta = [Dd::ZERO, Dd::ONE, Dd::ZERO, Dd::ZERO];
    let (mut c, mut s) = ([Dd::ZERO; 4], [Dd::ZERO; 4]);
    c[0] = Dd::ONE;
    for k in 1..4 {
        let (dc, ds) =
            (convolve(&tables.turning[k], &theta, &s), convolve(&tables.turning[k], &theta, &c));
        (c[k], s[k]) = (-dc, ds);
    }
    assert_eq!(c.map(f64::from), [1.0, 0.0, -0.5, 0.0]);
    assert_eq!(s.map(f64::from)[1..3], [1.0, 0.0]);
    assert!((f64::from(s[3]) + 1.0 / 6.0).abs() < 1e-16);
}

#[test]
fn two_drivers() {
    let tables = Tables::new(2);
    assert_eq!(tables.len(), 10);
    assert_eq!(tables.partial(&[0, 1, 0]).1, 2.0);
    assert_eq!(tables.partial(&[0, 1]).0, tables.partial(&[1, 0]).0);
}
