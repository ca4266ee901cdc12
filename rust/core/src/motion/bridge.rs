//! The smooth motion through a change point, where a dyad by itself knows too little.

use super::state::{Context, State};
use super::track::Track;
use crate::tolerance::SMOOTH_CLOSURE;

/// Nodes of the polynomial through a change point: Chebyshev's, so that none is
/// at it.
const NODES: u32 = 16;

/// How far around a change point (rad, or units of the scale) the polynomial reaches at
/// first.
const WIDEST: f64 = 0.1;
/// And at least: its nodes, the nearest at a tenth of the reach, stay about outside
/// [`crate::tolerance::CHANGE_REACH`].
const NARROWEST: f64 = 1.0e-3;

/// Position and analogues of the smooth motion at (or beside) a change point: the
/// polynomial through states around it, as far around as it closes. None if there is no
/// room.
pub(crate) fn bridge(
    cx: &Context<'_>,
    state: &State,
    track: &Track,
    q: f64,
    change: f64,
) -> Option<State> {
    let mut reach = WIDEST;
    while reach > NARROWEST {
        let mut states = Vec::new();
        let mut nodes = Vec::new();
        for node in 0..NODES {
            let angle = std::f64::consts::PI * (f64::from(node) + 0.5) / f64::from(NODES);
            let at = change + reach * angle.cos();
            let mut trial = state.clone();
            trial.solve(&Context { signs: track.signs(at), ..*cx }, &[at]);
            if trial.fault.is_some() || trial.points.iter().any(|p| p[0].x.is_nan()) {
                break;
            }
            // Weights of Chebyshev's nodes of the first kind (Berrut & Trefethen 2004, 5.3).
            let weight = if node % 2 == 0 { angle.sin() } else { -angle.sin() };
            nodes.push((at, weight));
            states.push(trial);
        }
        if nodes.len() == NODES as usize {
            let raw: Vec<f64> = nodes.iter().map(|(at, w)| w / (q - at)).collect();
            let total: f64 = raw.iter().sum();
            let weights: Vec<f64> = raw.iter().map(|w| w / total).collect();
            let mut smooth = state.clone();
            smooth.blend(&states, &weights);
            if smooth.residual(cx) <= SMOOTH_CLOSURE {
                return Some(smooth);
            }
        }
        reach *= 0.5;
    }
    None
}
