//! A point of the space that a fit searches, and the objective linearised there.

use super::multipliers::Multipliers;

/// A design with the coordinates at which it meets its targets.
#[derive(Debug, Clone, Default)]
pub(super) struct Point {
    /// The variables, then the numbers that targets have for themselves.
    pub x: Vec<f64>,
    /// The coordinates of all positions, target after target.
    pub q: Vec<f64>,
    /// Half the sum of squares of all residuals; infinite where the design does not move as it must.
    pub value: f64,
    /// That of what targets miss alone, without limits.
    pub misfit: f64,
    pub multipliers: Multipliers,
    pub normal: Normal,
}

/// The normal equations: second and first derivatives of the objective, without those of free coordinates, which
/// each belong to one position alone.
#[derive(Debug, Clone, Default)]
pub(super) struct Normal {
    /// Row after row, the lower triangle.
    pub h: Vec<f64>,
    pub g: Vec<f64>,
    /// How each free coordinate follows: its own step, then its change with each number of x.
    pub follow: Vec<f64>,
}

impl Normal {
    /// Adds a residual with its derivatives; half its square.
    pub(super) fn add_row(&mut self, residual: f64, row: &[f64]) -> f64 {
        let width = self.g.len();
        for i in 0..width {
            self.g[i] += residual * row[i];
            let own = &mut self.h[i * width..];
            for j in 0..=i {
                own[j] += row[i] * row[j];
            }
        }
        0.5 * residual * residual
    }

    pub(super) fn clear(&mut self, count: usize, positions: usize) {
        self.h.clear();
        self.h.resize(count * count, 0.0);
        self.g.clear();
        self.g.resize(count, 0.0);
        self.follow.clear();
        self.follow.resize(positions * (1 + count), 0.0);
    }
}
