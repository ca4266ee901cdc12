//! Values at the nodes of a window, so that none is computed twice, and a bound of the rounding between
//! them.

use super::window::Weight;

/// Rounding of a value, relative to the greatest around it.
pub(super) const NOISE: f64 = 1.0e-11;
/// A coordinate whose derivative is below this part of its unit stands still.
const STANDS: f64 = 1.0e-13;

/// Greatest distance of a smooth value from the cubic through its neighbours, relative to itself.
const SMOOTH: f64 = 0.1;

/// A coordinate's derivative with its first two derivatives by the window's angle.
pub(super) type ByAngle = [f64; 3];

/// The value half-way between two nodes of the cubic through them.
pub(super) fn cubic(
    (from, [first, rate, _]): (f64, ByAngle),
    (to, [last, later, _]): (f64, ByAngle),
) -> f64 {
    0.5 * (first + last) + 0.125 * (to - from) * (rate - later)
}

/// Values at the nodes.
#[derive(Default)]
pub(super) struct NodeValues {
    pub nodes: Vec<f64>,
    pub values: Vec<Option<ByAngle>>,
    /// Bounds of the rounding of everything else at each, usually and at most.
    rounding: Vec<[f64; 2]>,
    /// Values between nodes, where a search looks first.
    between: Vec<(f64, Option<ByAngle>)>,
}

impl NodeValues {
    /// Adds a node behind the others.
    pub(super) fn push_node(&mut self, angle: f64, value: Option<ByAngle>, rounding: [f64; 2]) {
        self.nodes.push(angle);
        self.values.push(value);
        self.rounding.push(rounding);
    }

    /// Whether all values are rounding, and most of them no more than usual. `unit`: the natural size.
    /// Smooth values are not rounding, however large everything else is.
    pub(super) fn is_zero(&self, unit: f64) -> bool {
        let (mut count, mut usual) = (0, 0);
        for (jet, [usually, at_most]) in self.values.iter().zip(&self.rounding) {
            let Some([value, ..]) = jet else { continue };
            if value.abs() > *at_most {
                return false;
            }
            count += 1;
            usual += usize::from(value.abs() <= *usually);
        }
        2 * usual > count && !self.is_smooth(STANDS * unit)
    }

    /// Whether most values between nodes are near the cubic through these, and above a size.
    fn is_smooth(&self, bound: f64) -> bool {
        let smooth = self.between.iter().filter(|(angle, middle)| {
            let behind = self.nodes.partition_point(|node| node < angle);
            let ends = [behind.checked_sub(1), Some(behind)];
            let [Some(a), Some(b)] = ends.map(|node| self.sample(node?)) else { return false };
            let Some([value, ..]) = *middle else { return false };
            let apart = (value - cubic(a, b)).abs();
            value.abs() > bound && apart <= SMOOTH * value.abs()
        });
        2 * smooth.count() > self.between.len()
    }

    fn sample(&self, node: usize) -> Option<(f64, ByAngle)> {
        Some((*self.nodes.get(node)?, (*self.values.get(node)?)?))
    }

    /// Adds a value between nodes, behind the others.
    pub(super) fn push_between(&mut self, angle: f64, value: Option<ByAngle>) {
        self.between.push((angle, value));
    }

    /// All angles with a value.
    pub(super) fn angles(&self) -> impl Iterator<Item = f64> + '_ {
        let nodes = self.nodes.iter().zip(&self.values);
        let nodes = nodes.filter_map(|(&angle, value)| value.map(|_| angle));
        let between = self.between.iter().filter_map(|&(angle, value)| value.map(|_| angle));
        nodes.chain(between)
    }

    /// Replaces the value at an angle that has one.
    pub(super) fn replace(&mut self, angle: f64, value: Option<ByAngle>) {
        if let Ok(node) = self.nodes.binary_search_by(|node| node.total_cmp(&angle)) {
            self.values[node] = value;
        }
        if let Ok(index) = self.between.binary_search_by(|(at, _)| at.total_cmp(&angle)) {
            self.between[index].1 = value;
        }
    }

    /// The value at an angle: the known one, or the result of `find`.
    pub(super) fn value_or(
        &self,
        angle: f64,
        find: impl FnOnce() -> Option<ByAngle>,
    ) -> Option<ByAngle> {
        if let Ok(node) = self.nodes.binary_search_by(|node| node.total_cmp(&angle)) {
            return self.values[node];
        }
        match self.between.binary_search_by(|(at, _)| at.total_cmp(&angle)) {
            Ok(index) => self.between[index].1,
            Err(_) => find(),
        }
    }

    /// Sizes at the nodes, plain and weighted, of entry `entry` of the values.
    pub(super) fn sizes(
        &self,
        entry: usize,
        poles: [usize; 2],
    ) -> impl Iterator<Item = (f64, [f64; 2])> + '_ {
        self.nodes.iter().zip(&self.values).map(move |(&angle, value)| {
            // A node without a value counts as zero.
            let plain = value.map_or(0.0, |value| value[entry].abs());
            let factor = Weight::new(angle, poles).factor;
            (angle, [plain, if plain > 0.0 { plain * factor } else { 0.0 }])
        })
    }
}

/// A bound of the rounding of weighted values, all along a window.
///
/// Beside a pole values are far greater than elsewhere, so the bound is that of the values around. Where
/// the weight is small they are either large, and weighted they are of one size, or not large, and plain
/// they are of one size.
pub(super) struct Rounding {
    nodes: Vec<f64>,
    /// Greatest size around each cell, plain and weighted.
    around: Vec<[f64; 2]>,
    /// The size in most of the window.
    typical: f64,
}

impl Rounding {
    /// The bound for entry `entry` of the values with the weight of `poles`; `unit`: the natural size.
    pub(super) fn new(
        node_values: &NodeValues,
        (entry, poles): (usize, [usize; 2]),
        unit: f64,
    ) -> Self {
        let sizes: Vec<[f64; 2]> = node_values.sizes(entry, poles).map(|(_, size)| size).collect();
        let around = (0..sizes.len())
            .map(|cell| {
                let near = &sizes[cell.saturating_sub(1)..(cell + 3).min(sizes.len())];
                [0, 1].map(|i| near.iter().fold(0.0, |size, pair| pair[i].max(size)))
            })
            .collect();
        let typical = median(node_values, &sizes).max(STANDS / NOISE * unit);
        Self { nodes: node_values.nodes.clone(), around, typical }
    }

    /// At an angle, where the weight is `factor`.
    pub(super) fn at(&self, angle: f64, factor: f64) -> f64 {
        let cell = self.nodes.partition_point(|&node| node <= angle).saturating_sub(1);
        let [plain, weighted] = self.around[cell];
        NOISE * (factor * self.typical).max(weighted.min(factor * plain))
    }
}

/// The size that is not exceeded over half of the window: nodes are closer together where it is great.
fn median(node_values: &NodeValues, sizes: &[[f64; 2]]) -> f64 {
    let at = |node: usize| node_values.nodes[node.min(node_values.nodes.len() - 1)];
    let width = |node: usize| at(node + 1) - at(node.saturating_sub(1));
    let mut sized: Vec<[f64; 2]> =
        sizes.iter().enumerate().map(|(node, size)| [size[0], width(node)]).collect();
    sized.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let half = 0.5 * sized.iter().map(|sized_node| sized_node[1]).sum::<f64>();
    let mut so_far = 0.0;
    let beyond = sized.iter().find(|sized_node| {
        so_far += sized_node[1];
        so_far > half
    });
    beyond.map_or(0.0, |sized_node| sized_node[0])
}
