//! The smooth motion through a change point, near which a dyad alone gives too few digits.

use crate::math::tolerance::CHANGE_REACH;
use crate::math::trig::sin_cos;
use crate::state::state::State;

/// The range around a change point within which the motion is interpolated.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ChangeWindow {
    /// The interpolant is used within this distance of the change point (rad, or units of the
    /// scale).
    pub reach: f64,
    /// Half-width of the first polynomial tried.
    max_reach: f64,
    /// Chebyshev nodes of the polynomial; an even number, so that none is at the change point.
    node_count: u32,
    /// Whether the reported condition is that of the nodes, not that of the dyad.
    uses_node_condition: bool,
}

impl ChangeWindow {
    /// For single positions: where too few digits remain.
    pub(crate) const SHORT: Self =
        Self { reach: CHANGE_REACH, max_reach: 0.1, node_count: 16, uses_node_condition: false };
    /// For integration: beside a change point second analogues have errors of u κ³, too rough for any
    /// step of an integrator. States at the nodes, the nearest at 0.03, are good to about 1e-12.
    pub(crate) const LONG: Self =
        Self { reach: 0.03, max_reach: 0.5, node_count: 24, uses_node_condition: true };
}

/// Least half-width of the polynomial: its nearest nodes, at a fifteenth of that, have hardly any correct
/// digits.
const MIN_REACH: f64 = 2.0e-4;
/// If a polynomial is truncated, one of half its width has at most this part of its error.
const TRUNCATION_GAIN: f64 = 0.25;
/// The polynomial is used within this part of its half-width, away from its ends.
const INNER: f64 = 0.5;

/// The polynomial through states around a change point, as wide as it still represents the motion.
#[derive(Debug, Clone)]
pub(crate) struct ChangeInterpolant {
    reach: f64,
    /// Distances of the nodes from the change point, with their weights.
    nodes: Vec<(f64, f64)>,
    states: Vec<State>,
    /// Greatest squared condition of the nodes, if that is reported.
    condition2: Option<f64>,
}

impl ChangeInterpolant {
    /// Order of the analogues that the error estimate uses.
    pub(crate) const JUDGED_ORDER: usize = 2;

    /// Fits the polynomial; `solve` gives the state at a distance from the change point. `None` if
    /// no width is good enough.
    ///
    /// While a polynomial is truncated, one of half the width fits far better; once it represents
    /// the motion, only rounding grows. This finds the width without knowing how large the rounding
    /// is.
    pub(crate) fn fit(window: ChangeWindow, solve: impl Fn(f64) -> Option<State>) -> Option<Self> {
        let mut best: Option<(FitError, Self)> = None;
        let mut reach = window.max_reach;
        while reach > MIN_REACH {
            if let Some(interpolant) = Self::through(reach, window, &solve)
                && let Some(error) = interpolant.error(&solve)
                && error.is_small()
            {
                if let Some((before, _)) = &best
                    && !error.is_far_below(before)
                {
                    break;
                }
                best = Some((error, interpolant));
            }
            reach *= 0.5;
        }
        best.map(|(_, interpolant)| interpolant)
    }

    /// Interpolates states of another order at the same nodes.
    pub(crate) fn refit(
        &self,
        window: ChangeWindow,
        solve: impl Fn(f64) -> Option<State>,
    ) -> Option<Self> {
        Self::through(self.reach, window, solve)
    }

    fn through(
        reach: f64,
        window: ChangeWindow,
        solve: impl Fn(f64) -> Option<State>,
    ) -> Option<Self> {
        // Weights of Chebyshev nodes of the first kind (Berrut & Trefethen 2004, 5.3).
        let nodes: Vec<_> = (0..window.node_count)
            .map(|node| {
                let (at, sine) = chebyshev(f64::from(node) + 0.5, window.node_count);
                (reach * at, if node % 2 == 0 { sine } else { -sine })
            })
            .collect();
        let states = nodes.iter().map(|(at, _)| solve(*at)).collect::<Option<Vec<_>>>()?;
        let condition2 =
            states.iter().map(|state| state.conditions.greatest[0]).fold(0.0, f64::max);
        let condition2 = window.uses_node_condition.then_some(condition2);
        Some(Self { reach, nodes, states, condition2 })
    }

    /// Distance from the motion between nodes, near the ends. (The change point itself tests nothing: a flat dyad
    /// closes at any angle.)
    fn error(&self, solve: impl Fn(f64) -> Option<State>) -> Option<FitError> {
        let count = u32::try_from(self.nodes.len()).unwrap_or(u32::MAX);
        let mut max = FitError::default();
        for part in [1, 2, 3, count - 3, count - 2, count - 1] {
            let at = self.reach * chebyshev(f64::from(part), count).0;
            let solved = solve(at)?;
            let smooth = self.interpolate(at, &solved);
            for (order, max) in max.0.iter_mut().enumerate() {
                *max = max.max(smooth.distance(&solved, order));
            }
        }
        Some(max)
    }

    /// The state at a distance from the change point, if that is well inside; `like` is any state
    /// of the same plan.
    pub(crate) fn state_at(&self, distance: f64, like: &State) -> Option<State> {
        (distance.abs() <= INNER * self.reach).then(|| self.interpolate(distance, like))
    }

    fn interpolate(&self, distance: f64, like: &State) -> State {
        let mut state = like.clone();
        if let Some(node) = self.nodes.iter().position(|(at, _)| *at == distance) {
            return self.states[node].clone();
        }
        let raw: Vec<f64> = self.nodes.iter().map(|(at, w)| w / (distance - at)).collect();
        let total: f64 = raw.iter().sum();
        let weights: Vec<f64> = raw.iter().map(|w| w / total).collect();
        state.interpolate(&self.states, &weights);
        if let Some(condition2) = self.condition2 {
            state.conditions.greatest[0] = condition2;
        }
        state
    }
}

/// Distance of points and their first two analogues from the motion, relative to the size or to
/// themselves.
#[derive(Debug, Clone, Copy, Default)]
struct FitError([f64; 3]);

impl FitError {
    /// Greatest error allowed.
    const MAX: [f64; 3] = [1.0e-9, 1.0e-6, 1.0e-4];
    /// Smaller errors are rounding, which may be small by chance.
    const ROUNDING: [f64; 3] = [1.0e-14, 1.0e-13, 1.0e-12];

    fn is_small(&self) -> bool {
        self.0.iter().zip(Self::MAX).all(|(error, max)| *error <= max)
    }

    fn is_far_below(&self, other: &Self) -> bool {
        let mut pairs = self.0.iter().zip(other.0).zip(Self::ROUNDING);
        pairs
            .any(|((error, wider), rounding)| *error <= TRUNCATION_GAIN * wider && wider > rounding)
    }
}

/// Cosine and sine of the angle π `part`/`count`: a Chebyshev point, from 1 to −1.
fn chebyshev(part: f64, count: u32) -> (f64, f64) {
    let angle = std::f64::consts::PI * part / f64::from(count);
    let (sin, cos) = sin_cos(angle);
    (cos, sin)
}
