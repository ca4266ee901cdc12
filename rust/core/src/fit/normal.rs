//! Adds the residuals of one position to the normal equations.

use super::point::Normal;

/// Share of the square of a coordinate's effect that keeps its step finite where the motion stands still.
const STILL: f64 = 1e-12;

/// Residuals of one position: rows of derivatives, and those by the position's own coordinate.
#[derive(Debug, Default)]
pub(super) struct Rows {
    pub residuals: Vec<f64>,
    /// Row after row.
    pub derivatives: Vec<f64>,
    pub by_q: Vec<f64>,
    along: Vec<f64>,
}

impl Rows {
    pub(super) fn clear(&mut self, count: usize, width: usize) {
        self.residuals.clear();
        self.residuals.resize(count, 0.0);
        self.derivatives.clear();
        self.derivatives.resize(count * width, 0.0);
        self.by_q.clear();
        self.by_q.resize(count, 0.0);
    }

    /// Adds them; half the sum of squares.
    ///
    /// Where the coordinate is free it is eliminated: with residuals r + J·dx + t·dq, the best dq is
    /// −t·(r + J·dx)/t², and what is left has no part along t (the Schur complement of dq).
    pub(super) fn add_to(&mut self, normal: &mut Normal, free: Option<usize>) -> f64 {
        let width = normal.g.len();
        let rows = self.residuals.iter().zip(self.derivatives.chunks_exact(width));
        let value = rows.map(|(&residual, row)| normal.add_row(residual, row)).sum();
        let Some(position) = free else { return value };
        let square: f64 = self.by_q.iter().map(|t| t * t).sum();
        let size: f64 = self.residuals.iter().map(|r| r * r).sum();
        let square = square + STILL * size + f64::MIN_POSITIVE;
        self.along.clear();
        self.along.resize(width, 0.0);
        let mut own = 0.0;
        for (k, row) in self.derivatives.chunks_exact(width).enumerate() {
            own += self.by_q[k] * self.residuals[k];
            for (along, derivative) in self.along.iter_mut().zip(row) {
                *along += self.by_q[k] * derivative;
            }
        }
        let follow = &mut normal.follow[position * (1 + width)..][..=width];
        follow[0] = -own / square;
        for i in 0..width {
            let share = self.along[i] / square;
            follow[1 + i] = -share;
            normal.g[i] -= share * own;
            let row = &mut normal.h[i * width..];
            for j in 0..=i {
                row[j] -= share * self.along[j];
            }
        }
        value
    }
}
