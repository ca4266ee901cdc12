//! Butcher tableau, and the coefficients of order 5(4) as printed in their sources.
//!
//! Rows are sparse: stage and weight. Stages count from zero.

/// A sparse row: (stage, weight).
pub(crate) type Row = &'static [(usize, f64)];

/// An explicit Runge-Kutta pair with a continuous extension.
///
/// Stage s is evaluated at t + cₛh, y + h Σ aₛⱼkⱼ. After the `stages` of the new state come
/// the derivative at the new state (index `stages`) and the stages that only the continuous
/// extension needs.
#[derive(Debug)]
pub(crate) struct Tableau {
    /// Order of the new state.
    pub order: u8,
    /// Number of stages of the new state.
    pub stages: usize,
    /// Nodes of all stages as fractions of the step, including those of the continuous extension.
    pub c: &'static [f64],
    /// Weights of the earlier stages in each stage; row `stages` is the weights of the new state.
    pub a: &'static [Row],
    /// Weights of the new state minus the embedded one.
    pub error: Row,
    /// The same for a third formula of lower order (Hairer combines orders 5 and 3).
    pub coarse_error: Option<Row>,
    /// Whether the error estimate needs the derivative at the new state.
    pub error_needs_end: bool,
    /// Weights of the highest coefficients of the continuous extension, one row each.
    pub extension: &'static [Row],
    /// Stability, not accuracy, limits steps with h|λ| above this (Hairer & Wanner,
    /// Solving Ordinary Differential Equations II, 2nd ed. 1996, IV.2; DOPRI5 and DOP853).
    pub stability: f64,
}

impl Tableau {
    /// Weights of the new state.
    pub(crate) fn b(&self) -> Row {
        self.a[self.stages]
    }

    /// Number of all stages.
    pub(in crate::ode) fn all_stages(&self) -> usize {
        self.c.len()
    }

    /// Number of coefficients of the continuous extension besides the initial state.
    pub(in crate::ode) fn extension_rows(&self) -> usize {
        HERMITE_ROWS + self.extension.len()
    }
}

/// Coefficients of the continuous extension from the states and derivatives at both ends.
pub(in crate::ode) const HERMITE_ROWS: usize = 3;

/// Dormand & Prince, A family of embedded Runge-Kutta formulae, J. Comp. Appl. Math. 6 (1980),
/// pp. 19-26, RK5(4)7M; Hairer, Nørsett & Wanner, Solving Ordinary Differential Equations I, 2nd
/// ed. 1993, table II.5.2. Continuous extension of order 4: the same, II.6, after Shampine, Some
/// practical Runge-Kutta formulas, Math. Comp. 46 (1986), pp. 135-150, in the nested form of
/// Hairer's program DOPRI5.
pub(in crate::ode) static DORMAND_PRINCE_54: Tableau = Tableau {
    order: 5,
    stages: 6,
    c: &[0.0, 0.2, 0.3, 0.8, 8.0 / 9.0, 1.0, 1.0],
    a: &[
        &[],
        &[(0, 0.2)],
        &[(0, 3.0 / 40.0), (1, 9.0 / 40.0)],
        &[(0, 44.0 / 45.0), (1, -56.0 / 15.0), (2, 32.0 / 9.0)],
        &[
            (0, 19372.0 / 6561.0),
            (1, -25360.0 / 2187.0),
            (2, 64448.0 / 6561.0),
            (3, -212.0 / 729.0),
        ],
        &[
            (0, 9017.0 / 3168.0),
            (1, -355.0 / 33.0),
            (2, 46732.0 / 5247.0),
            (3, 49.0 / 176.0),
            (4, -5103.0 / 18656.0),
        ],
        &[
            (0, 35.0 / 384.0),
            (2, 500.0 / 1113.0),
            (3, 125.0 / 192.0),
            (4, -2187.0 / 6784.0),
            (5, 11.0 / 84.0),
        ],
    ],
    error: &[
        (0, 71.0 / 57600.0),
        (2, -71.0 / 16695.0),
        (3, 71.0 / 1920.0),
        (4, -17253.0 / 339200.0),
        (5, 22.0 / 525.0),
        (6, -1.0 / 40.0),
    ],
    coarse_error: None,
    error_needs_end: true,
    extension: &[&[
        (0, -12715105075.0 / 11282082432.0),
        (2, 87487479700.0 / 32700410799.0),
        (3, -10690763975.0 / 1880347072.0),
        (4, 701980252875.0 / 199316789632.0),
        (5, -1453857185.0 / 822651844.0),
        (6, 69997945.0 / 29380423.0),
    ]],
    stability: 3.25,
};

#[cfg(test)]
mod tests {
    use super::super::dop853::DORMAND_PRINCE_853;
    use super::*;
    use crate::ode::tests::trees::{Tree, trees};

    const BOTH: [&Tableau; 2] = [&DORMAND_PRINCE_54, &DORMAND_PRINCE_853];

    /// Elementary weights of a tree at every stage: Φᵢ = Π over the branches of Σ aᵢⱼ Φⱼ(branch).
    fn weights(tableau: &Tableau, tree: &Tree) -> Vec<f64> {
        let branches: Vec<_> = tree.branches.iter().map(|b| weights(tableau, b)).collect();
        let stage = |row: Row| {
            branches.iter().map(|b| row.iter().map(|&(j, a)| a * b[j]).sum::<f64>()).product()
        };
        tableau.a.iter().map(|row| stage(row)).collect()
    }

    fn sum(row: Row, weights: &[f64]) -> f64 {
        row.iter().map(|&(j, b)| b * weights[j]).sum()
    }

    /// Weights with 30 digits leave 1e-15 times their size (up to 43 in a row of A).
    const ROUNDING: f64 = 3e-13;

    #[test]
    fn rows_sum_to_the_node_of_their_stage() {
        for tableau in BOTH {
            assert_eq!(tableau.a.len(), tableau.c.len());
            for (s, (row, c)) in tableau.a.iter().zip(tableau.c).enumerate() {
                let total: f64 = row.iter().map(|(_, a)| a).sum();
                assert!((total - c).abs() < 2e-14, "row {s}: {total} is not {c}");
                assert!(row.iter().all(|&(j, _)| j < s), "row {s} is not explicit");
            }
        }
    }

    #[test]
    fn new_states_meet_all_order_conditions() {
        for (tableau, count) in BOTH.into_iter().zip([17, 200]) {
            let trees = trees(tableau.order);
            assert_eq!(trees.len(), count);
            for tree in trees {
                let error = sum(tableau.b(), &weights(tableau, &tree)) - 1.0 / tree.density();
                assert!(error.abs() < ROUNDING, "{tree:?}: off by {error:e}");
            }
        }
    }

    /// The difference of two formulas vanishes up to the lower of the two orders and no further.
    #[test]
    fn error_estimates_have_their_order() {
        let estimates = [
            (BOTH[0], BOTH[0].error, 4),
            (BOTH[1], BOTH[1].error, 5),
            (BOTH[1], BOTH[1].coarse_error.unwrap(), 3),
        ];
        for (tableau, row, order) in estimates {
            let error = |tree: &Tree| sum(row, &weights(tableau, tree)).abs();
            assert!(trees(order).iter().all(|tree| error(tree) < ROUNDING));
            assert!(trees(order + 1).iter().any(|tree| error(tree) > 1e-5), "order {order}");
        }
    }

    /// y(θ) = y₀ + θ(F₀ + (1−θ)(F₁ + θ(F₂ + …))) as weights of the stages, against θʳ/γ.
    #[test]
    fn continuous_extensions_have_their_order() {
        for (tableau, order) in BOTH.into_iter().zip([4, 7]) {
            for theta in [0.1, 0.35, 0.5, 0.83, 1.0] {
                let at = |tree: &Tree| {
                    let w = weights(tableau, tree);
                    let change = sum(tableau.b(), &w);
                    let first = w[0] - change;
                    let mut rows = vec![change, first, change - w[tableau.stages] - first];
                    rows.extend(tableau.extension.iter().map(|row| sum(row, &w)));
                    let nested = rows.iter().enumerate().rev().fold(0.0, |inner, (i, f)| {
                        (f + inner) * if i % 2 == 0 { theta } else { 1.0 - theta }
                    });
                    nested - theta.powi(i32::from(tree.order())) / tree.density()
                };
                for tree in trees(order) {
                    let error = at(&tree);
                    assert!(error.abs() < ROUNDING, "θ = {theta}, {tree:?}: off by {error:e}");
                }
                let beyond = trees(order + 1).iter().any(|tree| at(tree).abs() > 1e-7);
                assert!(beyond || theta == 1.0, "θ = {theta}: order above {order}");
            }
        }
    }
}
