//! The smooth motion through a change point, where a dyad by itself knows too little.

use crate::math::tolerance::CHANGE_REACH;
use crate::math::trig::sin_cos;
use crate::state::state::State;

/// Where the polynomial through a change point is taken.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ChangeWindow {
    /// How near to the change point (rad, or units of the scale).
    pub reach: f64,
    /// How far around it the polynomial is laid at first.
    max_reach: f64,
    /// Nodes of the polynomial: Chebyshev's, of an even number, so that none is at the change
    /// point.
    node_count: u32,
    /// Whether the condition told is that of the nodes, not that of the dyad.
    uses_node_condition: bool,
}

impl ChangeWindow {
    /// Of positions by themselves: where too few digits remain.
    pub(crate) const SHORT: Self =
        Self { reach: CHANGE_REACH, max_reach: 0.1, node_count: 16, uses_node_condition: false };
    /// Of positions that are integrated over: beside a change point second analogues are off by
    /// u κ³, which no step is narrow enough for. Nodes, the nearest at 0.03, are good to 1e-12 or
    /// so.
    pub(crate) const LONG: Self =
        Self { reach: 0.03, max_reach: 0.5, node_count: 24, uses_node_condition: true };
}

/// How far around the polynomial is laid at least: nodes, the nearest at a fifteenth of that, are
/// hardly known there.
const MIN_REACH: f64 = 2.0e-4;
/// Part of its error that half a polynomial has at most if the whole one is truncated.
const TRUNCATION_GAIN: f64 = 0.25;
/// It is used within this part of that, far from its ends.
const INNER: f64 = 0.5;

/// The polynomial through states around a change point, as far around as it is the motion.
#[derive(Debug, Clone)]
pub(crate) struct ChangeInterpolant {
    reach: f64,
    /// Places, from the change point, with their weights.
    nodes: Vec<(f64, f64)>,
    states: Vec<State>,
    /// The greatest condition (squared) of these, if that is what is told.
    condition2: Option<f64>,
}

impl ChangeInterpolant {
    /// Analogues by which the error is judged.
    pub(crate) const JUDGED_ORDER: usize = 2;

    /// Lays it; `solve` gives the state at a distance from the change point. None if there is no
    /// room.
    ///
    /// As long as the polynomial is truncated, half as far around it fits far better; once it is
    /// the motion only rounding grows. That is told without knowing how large the rounding is.
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

    /// Through states of another order.
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
        // Weights of Chebyshev's nodes of the first kind (Berrut & Trefethen 2004, 5.3).
        let nodes: Vec<_> = (0..window.node_count)
            .map(|node| {
                let (at, sine) = chebyshev(f64::from(node) + 0.5, window.node_count);
                (reach * at, if node % 2 == 0 { sine } else { -sine })
            })
            .collect();
        let states = nodes.iter().map(|(at, _)| solve(*at)).collect::<Option<Vec<_>>>()?;
        let condition2 = states.iter().map(|state| state.condition2[0]).fold(0.0, f64::max);
        let condition2 = window.uses_node_condition.then_some(condition2);
        Some(Self { reach, nodes, states, condition2 })
    }

    /// How far from the motion it is between nodes, near its ends. (At the change point itself
    /// nothing tells: a flat dyad closes whatever its angle.)
    fn error(&self, solve: impl Fn(f64) -> Option<State>) -> Option<FitError> {
        let count = u32::try_from(self.nodes.len()).unwrap_or(u32::MAX);
        let mut max = FitError::default();
        for part in [1, 2, 3, count - 3, count - 2, count - 1] {
            let at = self.reach * chebyshev(f64::from(part), count).0;
            let own = solve(at)?;
            let smooth = self.interpolate(at, &own);
            for (order, max) in max.0.iter_mut().enumerate() {
                *max = max.max(smooth.distance(&own, order));
            }
        }
        Some(max)
    }

    /// The state at a distance from the change point, if it is well inside; `like` a state of the
    /// same plan.
    pub(crate) fn at(&self, distance: f64, like: &State) -> Option<State> {
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
        state.blend(&self.states, &weights);
        if let Some(known) = self.condition2 {
            state.condition2[0] = known;
        }
        state
    }
}

/// How far points and their first two analogues are from the motion, in sizes or of themselves.
#[derive(Debug, Clone, Copy, Default)]
struct FitError([f64; 3]);

impl FitError {
    /// What may be left at most.
    const MAX: [f64; 3] = [1.0e-9, 1.0e-6, 1.0e-4];
    /// Less is rounding, which may be smaller by chance.
    const ROUNDING: [f64; 3] = [1.0e-14, 1.0e-13, 1.0e-12];

    fn is_small(&self) -> bool {
        self.0.iter().zip(Self::MAX).all(|(own, max)| *own <= max)
    }

    fn is_far_below(&self, other: &Self) -> bool {
        let mut pairs = self.0.iter().zip(other.0).zip(Self::ROUNDING);
        pairs.any(|((own, other), rounding)| *own <= TRUNCATION_GAIN * other && other > rounding)
    }
}

/// A place of Chebyshev's angles, in parts of their number: from 1 to -1; and its sine.
fn chebyshev(part: f64, count: u32) -> (f64, f64) {
    let angle = std::f64::consts::PI * part / f64::from(count);
    let (sin, cos) = sin_cos(angle);
    (cos, sin)
}
