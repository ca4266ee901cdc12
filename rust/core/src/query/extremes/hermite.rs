//! Polynomials through values and slopes (C. Hermite, J. reine angew. Math. 84 (1878) 70), in Newton's form.

/// A polynomial through values and slopes at three nodes.
struct Hermite {
    /// Every node twice, and the divided differences.
    nodes: [f64; 6],
    coefficients: [f64; 6],
}

impl Hermite {
    /// Through nodes, each with its value and slope.
    fn new([a, b, c]: [(f64, f64, f64); 3]) -> Self {
        let doubled = [a, a, b, b, c, c];
        let mut column = doubled.map(|node| node.1);
        let mut coefficients = column;
        for order in 1..doubled.len() {
            for i in 0..doubled.len() - order {
                let ((from, _, slope), (to, ..)) = (doubled[i], doubled[i + order]);
                let difference = column[i + 1] - column[i];
                column[i] = if to == from { slope } else { difference / (to - from) };
            }
            coefficients[order] = column[0];
        }
        Self { nodes: doubled.map(|node| node.0), coefficients }
    }

    /// Its value with its first two derivatives.
    fn at(&self, x: f64) -> [f64; 3] {
        let terms = self.coefficients.iter().zip(&self.nodes).rev();
        terms.fold([0.0; 3], |[value, slope, bend], (coefficient, node)| {
            let step = x - node;
            [value * step + coefficient, slope * step + value, bend * step + 2.0 * slope]
        })
    }
}

/// A polynomial of a distance, or of its square.
pub(super) struct Series {
    polynomial: Hermite,
    is_even: bool,
}

impl Series {
    /// Through nodes, none of them 0, each with its value and slope.
    pub(super) fn new(nodes: [(f64, f64, f64); 3], is_even: bool) -> Self {
        let of_square = |(x, value, slope): (f64, f64, f64)| (x * x, value, slope / (x + x));
        let nodes = if is_even { nodes.map(of_square) } else { nodes };
        Self { polynomial: Hermite::new(nodes), is_even }
    }

    /// Its value with its first two derivatives.
    pub(super) fn at(&self, x: f64) -> [f64; 3] {
        if !self.is_even {
            return self.polynomial.at(x);
        }
        let [value, slope, bend] = self.polynomial.at(x * x);
        [value, 2.0 * x * slope, 2.0 * slope + 4.0 * x * x * bend]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_polynomial_of_the_fifth_degree_is_its_own() {
        let polynomial = |x: f64| {
            let value = 3.0 - x + 0.5 * x * x - x.powi(5);
            [value, -1.0 + x - 5.0 * x.powi(4), 1.0 - 20.0 * x.powi(3)]
        };
        let hermite =
            Hermite::new([0.1, 0.25, 0.4].map(|x| (x, polynomial(x)[0], polynomial(x)[1])));
        for x in [0.0, 0.1, 0.17, 0.4] {
            let apart = [0, 1, 2].map(|k| hermite.at(x)[k] - polynomial(x)[k]);
            // Each derivative divides rounding by a distance of nodes.
            let digits = apart.iter().zip([1e-13, 1e-12, 1e-11]);
            assert!(digits.into_iter().all(|(gap, most)| gap.abs() < most), "{x}: {apart:?}");
        }
    }

    #[test]
    fn an_even_polynomial_of_the_tenth_degree_is_its_own() {
        let polynomial = |x: f64| {
            let value = 2.0 + 3.0 * x * x - x.powi(10);
            [value, 6.0 * x - 10.0 * x.powi(9), 6.0 - 90.0 * x.powi(8)]
        };
        let series =
            Series::new([0.3, 0.6, 0.9].map(|x| (x, polynomial(x)[0], polynomial(x)[1])), true);
        for x in [0.0, 0.3, 0.5, 0.9] {
            let apart = [0, 1, 2].map(|k| series.at(x)[k] - polynomial(x)[k]);
            assert!(apart.iter().all(|gap| gap.abs() < 1e-11), "{x}: {apart:?}");
        }
    }
}
