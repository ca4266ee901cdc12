//! The smooth motion through a change point, where a dyad by itself knows too little.

use super::state::{Context, State};
use super::track::Track;
use crate::tolerance::{CHANGE_REACH, SMOOTH_CLOSURE};

/// Where the polynomial is taken.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bridge {
    /// How near to a change point (rad, or units of the scale).
    pub reach: f64,
    /// How far around it the polynomial reaches at first.
    widest: f64,
    /// Nodes of the polynomial: Chebyshev's, of an even number, so that none is at the change
    /// point.
    nodes: u32,
}

impl Bridge {
    /// Of positions by themselves: where too few digits remain.
    pub(crate) const SHORT: Self = Self { reach: CHANGE_REACH, widest: 0.1, nodes: 16 };
    /// Of positions that are integrated over: beside a change point second analogues are off by
    /// u κ³, which no step is narrow enough for. Nodes, the nearest at 0.03, are good to 1e-12 or
    /// so.
    pub(crate) const LONG: Self = Self { reach: 0.03, widest: 0.5, nodes: 24 };
}

/// How far the polynomial reaches at least: its nodes, the nearest at a tenth of the reach, stay
/// about outside [`CHANGE_REACH`].
const NARROWEST: f64 = 1.0e-3;

/// Position and analogues of the smooth motion at (or beside) a change point: the
/// polynomial through states around it, as far around as it closes. None if there is no
/// room.
pub(crate) fn bridge(
    cx: &Context<'_>,
    state: &State,
    track: &Track,
    (q, change): (f64, f64),
    wide: Bridge,
) -> Option<State> {
    let solve = |at: f64| {
        let mut trial = state.clone();
        trial.solve(&Context { signs: track.signs(at), ..*cx }, &[at]);
        let is_there = trial.fault.is_none() && !trial.points.iter().any(|p| p[0].x.is_nan());
        is_there.then_some(trial)
    };
    let mut reach = wide.widest;
    // Nodes must be far around where the polynomial is asked for.
    while reach > NARROWEST.max(2.0 * (q - change).abs()) {
        let place = |part: f64| {
            let angle = std::f64::consts::PI * part / f64::from(wide.nodes);
            (change + reach * angle.cos(), angle.sin())
        };
        let mut states = Vec::new();
        let mut nodes = Vec::new();
        for node in 0..wide.nodes {
            let (at, sine) = place(f64::from(node) + 0.5);
            let Some(solved) = solve(at) else { break };
            // Weights of Chebyshev's nodes of the first kind (Berrut & Trefethen 2004, 5.3).
            nodes.push((at, if node % 2 == 0 { sine } else { -sine }));
            states.push(solved);
        }
        let smooth = |q: f64| {
            let raw: Vec<f64> = nodes.iter().map(|(at, w)| w / (q - at)).collect();
            let total: f64 = raw.iter().sum();
            let weights: Vec<f64> = raw.iter().map(|w| w / total).collect();
            let mut smooth = state.clone();
            smooth.blend(&states, &weights);
            smooth
        };
        // A flat dyad closes almost whatever its angle: far around, where it is not, and farthest
        // from the nodes the polynomial must be the motion too.
        let is_whole = states.len() == wide.nodes as usize;
        let is_motion = |at: f64| solve(at).is_some_and(|own| smooth(at).is_as(&own));
        let ends = [1.0, f64::from(wide.nodes) - 1.0].map(|part| place(part).0);
        if is_whole && (reach <= Bridge::SHORT.widest || ends.into_iter().all(is_motion)) {
            let found = smooth(q);
            if found.residual(cx) <= SMOOTH_CLOSURE {
                return Some(found);
            }
        }
        reach *= 0.5;
    }
    None
}
