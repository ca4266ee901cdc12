//! Multipliers of limits: the augmented Lagrangian of Hestenes and Powell (1969), where λ grows by μ·c between
//! descents.

/// The square of a miss of one unit, at first, in sizes of the target; how it grows where misses stay.
const PENALTY: f64 = 10.0;
const GROWTH: f64 = 4.0;
/// A miss that falls to this part stays no longer.
const FALLS: f64 = 0.25;
/// By how much limits are missed, and how strongly that counts.
#[derive(Debug, Clone, Default)]
pub(super) struct Multipliers {
    /// In units; not positive where a limit is kept.
    pub misses: Vec<f64>,
    lambda: Vec<f64>,
    pub penalty: f64,
    /// The worst miss after the last descent.
    worst: f64,
}

impl Multipliers {
    /// Of so many conditions, where the squares of a target's residuals have this size.
    pub(super) fn new(count: usize, size: f64) -> Self {
        Self {
            misses: vec![0.0; count],
            lambda: vec![0.0; count],
            penalty: PENALTY * size,
            worst: f64::INFINITY,
        }
    }

    /// By how much a limit presses: max(0, c + λ/μ).
    pub(super) fn hinge(&self, index: usize) -> f64 {
        (self.misses[index] + self.lambda[index] / self.penalty).max(0.0)
    }

    /// The worst miss, in units.
    pub(super) fn worst(&self) -> f64 {
        self.misses.iter().copied().fold(0.0, f64::max)
    }

    /// After a descent.
    pub(super) fn update(&mut self) {
        for (lambda, miss) in self.lambda.iter_mut().zip(&self.misses) {
            *lambda = (*lambda + self.penalty * miss).max(0.0);
        }
        let worst = self.worst();
        if worst > FALLS * self.worst {
            self.penalty *= GROWTH;
        }
        self.worst = worst;
    }
}
