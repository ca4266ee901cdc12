//! What is known at the nodes of a window: values that are not computed twice, and how far rounding
//! reaches between them.

use super::window::Weight;

/// Rounding of a value, relative to the greatest around it.
const NOISE: f64 = 1.0e-11;
/// A coordinate stands whose derivative is below this part of its unit.
const STANDS: f64 = 1.0e-13;

/// A coordinate's derivative with its first two derivatives by the window's angle.
pub(super) type ByAngle = [f64; 3];

/// Values at the nodes.
pub(super) struct Known {
    pub nodes: Vec<f64>,
    pub values: Vec<Option<ByAngle>>,
}

impl Known {
    /// The node at an angle.
    pub(super) fn node(&self, angle: f64) -> Option<usize> {
        self.nodes.binary_search_by(|node| node.total_cmp(&angle)).ok()
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
/// the weight is small they are either large, and of one size with their weights, or not, and of one
/// size without.
pub(super) struct Rounding {
    nodes: Vec<f64>,
    /// Greatest size around each cell, plain and weighted.
    around: Vec<[f64; 2]>,
    /// The size in most of the window.
    typical: f64,
}

impl Rounding {
    /// Of entry `entry` of the values with the weight of `poles`; `unit`: the natural size.
    pub(super) fn new(known: &Known, (entry, poles): (usize, [usize; 2]), unit: f64) -> Self {
        let sizes: Vec<[f64; 2]> = known.sizes(entry, poles).map(|(_, size)| size).collect();
        let around = (0..sizes.len())
            .map(|cell| {
                let near = &sizes[cell.saturating_sub(1)..(cell + 3).min(sizes.len())];
                [0, 1].map(|i| near.iter().fold(0.0, |size, own| own[i].max(size)))
            })
            .collect();
        let mut plain: Vec<f64> = sizes.iter().map(|size| size[0]).collect();
        plain.sort_by(f64::total_cmp);
        let typical = plain[plain.len() / 2].max(STANDS / NOISE * unit);
        Self { nodes: known.nodes.clone(), around, typical }
    }

    /// At an angle, where the weight is `factor`.
    pub(super) fn at(&self, angle: f64, factor: f64) -> f64 {
        let cell = self.nodes.partition_point(|&node| node <= angle).saturating_sub(1);
        let [plain, weighted] = self.around[cell];
        NOISE * (factor * self.typical).max(weighted.min(factor * plain))
    }
}
