//! Nodes as close together as the motion is sharp.
//!
//! Beside a change point that is missed by δ a coordinate turns within some δ of q, and even nodes step
//! over it. There the inverse of the condition of a dyad is the root of a smooth function, 1/κ² ~ x² + δ²,
//! whose complex zeros are where the series of the motion end: as far from x as 1/κ. So a cell in which 1/κ
//! of every dyad and group is of one size is no wider than the distance to them. Three samples of such a
//! parabola that passes its minimum between them differ at least by a factor of 3.
//!
//! At a length of 0 the condition of its dyad is infinite, but on each side the motion is smooth: times the
//! distance that condition is of one size.

use super::curve::Curve;
use super::node_values::{ByAngle, NodeValues, cubic};
use super::window::Window;

/// The greatest ratio of a condition's values in a cell.
const GREATEST_RATIO: f64 = 2.0;
/// Greatest distance of the value in the middle of a cell from the cubic through its ends, as a part of the
/// greatest of the three. Conditions of groups are those of several motions, and may hide a sharp one.
const GREATEST_BEND: f64 = 0.1;
/// Halvings of a cell for that, beside a sharp motion: in smaller cells conditions show it.
const BEND_HALVINGS: u32 = 3;
/// Halvings of a cell: 1e-9 of a turn. Nearer to a place where a joint is at infinity, or a length is 0,
/// conditions grow without end.
const MAX_HALVINGS: u32 = 24;
/// Distance (as an angle) from a length of 0 within which the condition is weighted by the distance.
const NEAR_ZERO: f64 = 0.1;

/// A sample of the curve, with the conditions of its dyads and groups.
struct Node {
    angle: f64,
    value: Option<ByAngle>,
    /// Bounds of the rounding of everything else, usually and at most.
    rounding: [f64; 2],
    conditions: Vec<f64>,
}

impl Curve<'_> {
    /// Values at nodes, and at those between them that show how sharp the motion is.
    pub(super) fn node_values_at(&mut self, window: &Window, nodes: &[f64]) -> NodeValues {
        let mut node_values = NodeValues::default();
        let mut before: Option<Node> = None;
        for &angle in nodes {
            let here = self.node(window, angle);
            if let Some(before) = &before {
                self.grade(window, [before, &here], MAX_HALVINGS, &mut node_values);
            }
            node_values.push_node(angle, here.value, here.rounding);
            before = Some(here);
        }
        node_values
    }

    fn node(&mut self, window: &Window, angle: f64) -> Node {
        let value = self.by_angle(window, angle);
        let mut conditions = Vec::new();
        if value.is_some() {
            self.evaluator.own_conditions(&mut conditions);
            for zero in &window.zero_lengths {
                conditions[zero.step] *= window.distance(angle, zero.angle).min(NEAR_ZERO);
            }
        }
        let rounding = if value.is_some() { self.rounding() } else { [0.0; 2] };
        Node { angle, value, rounding, conditions }
    }

    /// Adds the values between two nodes.
    fn grade(
        &mut self,
        window: &Window,
        [a, b]: [&Node; 2],
        halvings: u32,
        node_values: &mut NodeValues,
    ) {
        let middle = self.node(window, 0.5 * (a.angle + b.angle));
        let is_within = middle.angle > a.angle && middle.angle < b.angle;
        let first_ones = halvings > MAX_HALVINGS - BEND_HALVINGS;
        let is_sharp = vary([a, &middle, b]) || first_ones && bends([a, &middle, b]);
        if halvings > 0 && is_within && is_sharp {
            self.grade(window, [a, &middle], halvings - 1, node_values);
            node_values.push_node(middle.angle, middle.value, middle.rounding);
            self.grade(window, [&middle, b], halvings - 1, node_values);
        } else {
            node_values.push_between(middle.angle, middle.value);
        }
    }
}

/// Whether a condition has values of different sizes.
fn vary(samples: [&Node; 3]) -> bool {
    let [a, middle, b] = samples.map(|node| &node.conditions);
    a.iter().zip(middle).zip(b).any(|((&a, &middle), &b)| {
        let (smallest, greatest) = (a.min(middle).min(b), a.max(middle).max(b));
        greatest > GREATEST_RATIO * smallest
    })
}

/// Whether the value is far from the cubic through the ends.
fn bends([a, middle, b]: [&Node; 3]) -> bool {
    let (Some(first), Some([value, ..]), Some(last)) = (a.value, middle.value, b.value) else {
        return false;
    };
    let cubic = cubic((a.angle, first), (b.angle, last));
    let size = first[0].abs().max(value.abs()).max(last[0].abs());
    (value - cubic).abs() > (GREATEST_BEND * size).max(middle.rounding[1])
}
