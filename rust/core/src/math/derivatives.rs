//! Partial derivatives of products, to any order, in any number of drivers.
//!
//! A jet lists all partial derivatives of one quantity in graded order. The tables here give the
//! terms in the derivative of a product (Leibniz) and of a unit vector `U = exp(iΘ)`, from
//! `∂U = i U ∂Θ`.

use std::sync::{Arc, OnceLock};

/// One term `factor · a[left] · b[right]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Term {
    /// Product of binomial coefficients.
    pub factor: f64,
    /// Entry of the first jet.
    pub left: usize,
    /// Entry of the second jet.
    pub right: usize,
}

/// Highest order that the kernels know; the general formulas serve any order.
pub(crate) const MAX_ORDER: usize = ONE_DRIVER.len() - 1;

/// [`DerivativeTables::rotation`] for one driver to order 3, as a constant.
pub(crate) const ONE_DRIVER: [&[Term]; 4] = [
    &[],
    &[],
    &[Term { factor: 1.0, left: 1, right: 1 }],
    &[Term { factor: 1.0, left: 2, right: 1 }, Term { factor: 2.0, left: 1, right: 2 }],
];

/// [`DerivativeTables::mixed`] for one driver to order 3, as a constant.
pub(crate) const ONE_DRIVER_MIXED: [&[Term]; 4] = [
    &[],
    &[],
    &[Term { factor: 2.0, left: 1, right: 1 }],
    &[Term { factor: 3.0, left: 2, right: 1 }, Term { factor: 3.0, left: 1, right: 2 }],
];

/// [`DerivativeTables::rotation`] for two drivers to order 2, as a constant.
pub(crate) const TWO_DRIVERS: [&[Term]; 6] = [
    &[],
    &[],
    &[],
    &[Term { factor: 1.0, left: 1, right: 1 }],
    &[Term { factor: 1.0, left: 2, right: 1 }],
    &[Term { factor: 1.0, left: 2, right: 2 }],
];

/// Terms of rotation, and of a slide along a turning guide, for one driver.
pub(crate) fn one_driver(k: usize) -> (&'static [Term], &'static [Term]) {
    (ONE_DRIVER[k], ONE_DRIVER_MIXED[k])
}

/// Index tables for derivatives of a given order in a given number of drivers.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct DerivativeTables {
    /// Number of drivers.
    pub drivers: usize,
    /// Highest order.
    pub order: usize,
    /// Multi-indices in graded order; the first is the value itself.
    pub powers: Vec<Vec<usize>>,
    /// The driver of a first-order entry, else `None`.
    pub driver_of: Vec<Option<usize>>,
    /// For each entry except the first, a driver that it contains and the entry of one order less in it.
    pub lowered: Vec<(usize, usize)>,
    /// Terms of the derivative of a product, for each multi-index.
    pub product: Vec<Vec<Term>>,
    /// The terms in which both factors are differentiated.
    pub mixed: Vec<Vec<Term>>,
    /// Terms of the derivative of a unit vector (times i), except the one in the highest derivative
    /// of its angle: left is U, right is Θ.
    pub rotation: Vec<Vec<Term>>,
}

/// Tables of one driver: most calls need them, and building them takes as long as some hundred positions.
static OF_ONE_DRIVER: [OnceLock<Arc<DerivativeTables>>; 4] = [const { OnceLock::new() }; 4];

impl DerivativeTables {
    /// The tables up to an order, built once for one driver.
    pub(crate) fn shared(drivers: usize, order: usize) -> Arc<Self> {
        let build = || Arc::new(Self::new(drivers, order));
        match OF_ONE_DRIVER.get(order) {
            Some(built) if drivers == 1 => Arc::clone(built.get_or_init(build)),
            _ => build(),
        }
    }

    /// Builds the tables up to an order.
    #[must_use]
    pub(crate) fn new(drivers: usize, order: usize) -> Self {
        let mut powers = vec![vec![0; drivers]];
        let mut layer = powers.clone();
        for _ in 0..order {
            let mut next: Vec<Vec<usize>> = Vec::new();
            for driver in 0..drivers {
                for power in &layer {
                    let mut raised = power.clone();
                    raised[driver] += 1;
                    if !next.contains(&raised) {
                        next.push(raised);
                    }
                }
            }
            powers.extend(next.iter().cloned());
            layer = next;
        }
        let find = |p: &[usize]| powers.iter().position(|q| q == p).unwrap_or(0);
        let first = |p: &Vec<usize>| p.iter().position(|&a| a > 0);
        let driver_of = powers
            .iter()
            .map(|p| if p.iter().sum::<usize>() == 1 { first(p) } else { None })
            .collect();
        let lowered = powers
            .iter()
            .map(|p| {
                let Some(driver) = first(p) else { return (0, 0) };
                let mut lower = p.clone();
                lower[driver] -= 1;
                (driver, find(&lower))
            })
            .collect();
        let product: Vec<Vec<Term>> = powers.iter().map(|alpha| leibniz(alpha, &find)).collect();
        let is_mixed = |term: &Term| term.left != 0 && term.right != 0;
        let mixed =
            product.iter().map(|terms| terms.iter().copied().filter(is_mixed).collect()).collect();
        let rotation = powers
            .iter()
            .enumerate()
            .map(|(index, alpha)| {
                let Some(driver) = alpha.iter().position(|&a| a > 0) else { return Vec::new() };
                let raise = |p: &[usize]| {
                    let mut raised = p.to_vec();
                    raised[driver] += 1;
                    find(&raised)
                };
                let mut lowered = alpha.clone();
                lowered[driver] -= 1;
                leibniz(&lowered, &find)
                    .into_iter()
                    .map(|t| Term { right: raise(&powers[t.right]), ..t })
                    .filter(|t| t.right != index)
                    .collect()
            })
            .collect();
        Self { drivers, order, powers, driver_of, lowered, product, mixed, rotation }
    }

    /// Entries in a jet.
    #[must_use]
    pub(crate) fn len(&self) -> usize {
        self.powers.len()
    }

    /// Entries of the full symmetric tensor of one order, last driver fastest.
    #[must_use]
    pub(crate) fn tensor(&self, order: usize) -> Vec<usize> {
        let mut entries = Vec::new();
        for mut code in 0..self.drivers.pow(u32::try_from(order).unwrap_or(0)) {
            let mut power = vec![0; self.drivers];
            for _ in 0..order {
                power[code % self.drivers] += 1;
                code /= self.drivers;
            }
            entries.push(self.powers.iter().position(|p| *p == power).unwrap_or(0));
        }
        entries
    }
}

/// All ways to split `alpha` in two, each with its product of binomial coefficients.
fn leibniz(alpha: &[usize], find: &impl Fn(&[usize]) -> usize) -> Vec<Term> {
    let mut splits: Vec<(f64, Vec<usize>)> = vec![(1.0, Vec::new())];
    for &a in alpha {
        let mut next = Vec::new();
        for (factor, head) in &splits {
            let mut binomial = 1.0;
            for b in 0..=a {
                let mut longer = head.clone();
                longer.push(b);
                next.push((factor * binomial, longer));
                let ratio = (a - b) as f64 / (b + 1) as f64;
                binomial *= ratio;
            }
        }
        splits = next;
    }
    splits
        .into_iter()
        .map(|(factor, right)| {
            let left: Vec<usize> = alpha.iter().zip(&right).map(|(a, b)| a - b).collect();
            Term { factor, left: find(&left), right: find(&right) }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_driver_has_binomial_coefficients() {
        let derivatives = DerivativeTables::new(1, 3);
        assert_eq!(derivatives.len(), 4);
        let third: Vec<f64> = derivatives.product[3].iter().map(|t| t.factor).collect();
        assert_eq!(third, [1.0, 3.0, 3.0, 1.0]);
        // U''' = i (U'' Θ' + 2 U' Θ'') + i U Θ'''
        let terms: Vec<_> =
            derivatives.rotation[3].iter().map(|t| (t.factor, t.left, t.right)).collect();
        assert_eq!(terms, [(1.0, 2, 1), (2.0, 1, 2)]);
        assert!(
            ONE_DRIVER_MIXED
                .iter()
                .zip(&derivatives.mixed)
                .all(|(constant, made)| constant == made)
        );
        assert!(
            ONE_DRIVER.iter().zip(&derivatives.rotation).all(|(constant, made)| constant == made)
        );
    }

    #[test]
    fn two_drivers_are_as_in_the_table() {
        let derivatives = DerivativeTables::new(2, 2);
        assert!(
            TWO_DRIVERS.iter().zip(&derivatives.rotation).all(|(constant, made)| constant == made)
        );
        assert_eq!(TWO_DRIVERS.len(), derivatives.len());
    }

    #[test]
    fn jet_lengths_are_binomial_coefficients() {
        for (drivers, order, count) in [(2, 3, 10), (3, 3, 20), (3, 2, 10), (1, 0, 1)] {
            assert_eq!(DerivativeTables::new(drivers, order).len(), count);
        }
    }

    #[test]
    fn the_tensor_is_symmetric() {
        let derivatives = DerivativeTables::new(2, 2);
        let t = derivatives.tensor(2);
        assert_eq!(t.len(), 4);
        assert_eq!(t[1], t[2]);
    }
}
