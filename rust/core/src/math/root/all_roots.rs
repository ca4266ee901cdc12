//! All roots of a function in an interval, from its values and slopes.
//!
//! Between two samples the function is compared with its Hermite cubic. In Bernstein's form a cubic lies
//! between its coefficients and has at most as many roots as these have sign changes. So a cell is halved
//! until its coefficients, by more than the error of the cubic, have one sign or are monotone (J. M. Lane &
//! R. F. Riesenfeld, Bounds on a polynomial, BIT 21 (1981) 112). The error is that of the cell of twice the
//! width, at its middle: 16 times too great for a smooth function.

use std::convert::Infallible;
use std::ops::RangeInclusive;

use super::bisection::bisect;
use super::itp::itp;

/// Halvings of a cell, after which its roots are a cluster: 4e-6 of the cell.
const MAX_DEPTH: u32 = 18;
/// Steps from node to node within a gap, in search of islands.
const ISLAND_STEPS: u32 = 16;
/// Halvings that locate the end of a gap: 1e-9 of a cell.
const EDGE_HALVINGS: u32 = 30;
/// Limit of evaluations for each node: a smooth function takes 2, and some 50 for a root.
const EVALUATIONS_PER_NODE: usize = 1000;
/// Width to which roots are located, in u of the greater end.
const WIDTH_ULPS: f64 = 4.0;
/// A root's value is its slope times the width, or rounding; beyond this multiple it is a jump.
const JUMP: f64 = 8.0;

/// A gap narrower than this part of its cell is a point: its ends are located to less.
const POINT: f64 = 1.0e-8;

/// Beside a jump values are of the size of those at the nodes around it, within this factor.
const RISE: f64 = 100.0;

/// A function at a point, with a bound of the rounding error of its value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Sample {
    pub x: f64,
    pub value: f64,
    pub slope: f64,
    pub noise: f64,
}

/// A root, and the signs of the function before and behind it (equal where it only touches zero).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Root {
    pub at: f64,
    pub signs: [f64; 2],
}

/// The result of a search.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Roots {
    /// Isolated roots, ascending.
    pub isolated: Vec<Root>,
    /// Intervals in which the function is zero to rounding.
    pub zero: Vec<[f64; 2]>,
    /// Where the function changes its sign without being zero.
    pub jumps: Vec<f64>,
    /// Whether any node has a value.
    pub has_values: bool,
    /// Whether the limit of evaluations was reached.
    pub incomplete: bool,
}

/// Finds the roots between ascending nodes of a function that has no value (`None`) in gaps. Those
/// closer together than 4e-6 of a cell count as one root or none, by the signs around them. Islands
/// in gaps are found if they are wider than 1/16 of a cell.
pub(crate) fn all_roots(nodes: &[f64], f: impl FnMut(f64) -> Option<Sample>) -> Roots {
    let mut search = Search {
        f,
        nodes: Vec::new(),
        left: nodes.len() * EVALUATIONS_PER_NODE,
        unresolved: Vec::new(),
        roots: Roots::default(),
    };
    let samples = search.sample(nodes);
    search.nodes = samples.iter().filter_map(|pair| pair.1).collect();
    search.roots.has_values = !search.nodes.is_empty();
    let mut before: Option<Sample> = None;
    let mut missing: Option<[f64; 2]> = None;
    for &(x, sample) in &samples {
        let Some(here) = sample else {
            missing = Some([missing.map_or(x, |gap| gap[0]), x]);
            continue;
        };
        match (before, missing.take()) {
            (_, Some(gap)) => search.beside_gap([before, sample], gap, 0),
            (Some(before), None) => search.cell([before, here], 0),
            (None, None) => {}
        }
        before = sample;
    }
    if let (Some(_), Some(gap)) = (before, missing) {
        search.beside_gap([before, None], gap, 0);
    }
    let mut unresolved = std::mem::take(&mut search.unresolved);
    unresolved.sort_by(|a, b| a.ends[0].x.total_cmp(&b.ends[0].x));
    let widest = nodes.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
    for cluster in unresolved.chunk_by(|a, b| a.ends[1].x == b.ends[0].x) {
        search.resolve(cluster, 0.5 * widest);
    }
    let mut roots = search.roots;
    roots.isolated.sort_by(|a, b| a.at.total_cmp(&b.at));
    roots
}

/// A cell in which the cubic does not show whether there is a root.
#[derive(Clone, Copy)]
struct Unresolved {
    ends: [Sample; 2],
    is_zero: bool,
}

struct Search<F> {
    f: F,
    /// The nodes that have values.
    nodes: Vec<Sample>,
    /// Evaluations that are left.
    left: usize,
    unresolved: Vec<Unresolved>,
    roots: Roots,
}

impl Sample {
    /// The sign of its value; 0 where that is rounding.
    fn sign(&self) -> f64 {
        if self.value.abs() <= self.noise { 0.0 } else { self.value.signum() }
    }
}

/// Bernstein's coefficients of the cubic through two samples.
fn coefficients([a, b]: [Sample; 2]) -> [f64; 4] {
    let third = (b.x - a.x) / 3.0;
    [a.value, a.value + third * a.slope, b.value - third * b.slope, b.value]
}

/// Difference of a sample in the middle from the cubic, in value and in slope: either alone can agree by
/// chance.
fn error([a, b]: [Sample; 2], middle: Sample) -> f64 {
    let width = b.x - a.x;
    let value = 0.5 * (a.value + b.value) + 0.125 * width * (a.slope - b.slope);
    let slope = 1.5 * (b.value - a.value) / width - 0.25 * (a.slope + b.slope);
    (middle.value - value).abs() + 0.25 * width * (middle.slope - slope).abs()
}

impl<F: FnMut(f64) -> Option<Sample>> Search<F> {
    fn at(&mut self, x: f64) -> Option<Sample> {
        let Some(left) = self.left.checked_sub(1) else {
            self.roots.incomplete = true;
            return None;
        };
        self.left = left;
        let is_finite = |s: &Sample| [s.value, s.slope, s.noise].iter().all(|n| n.is_finite());
        (self.f)(x).filter(is_finite)
    }

    /// The samples at the nodes and, within gaps, at points closer together: a gap may hide an island.
    fn sample(&mut self, nodes: &[f64]) -> Vec<(f64, Option<Sample>)> {
        let mut samples: Vec<(f64, Option<Sample>)> = Vec::with_capacity(nodes.len());
        for &x in nodes {
            let here = self.at(x);
            if let Some(&(last, None)) = samples.last()
                && here.is_none()
            {
                for step in 1..ISLAND_STEPS {
                    let between = last + (x - last) * f64::from(step) / f64::from(ISLAND_STEPS);
                    samples.push((between, self.at(between)));
                }
            }
            samples.push((x, here));
        }
        samples
    }

    /// A cell with values at both ends.
    fn cell(&mut self, ends: [Sample; 2], depth: u32) {
        let [a, b] = ends;
        let x = 0.5 * (a.x + b.x);
        let is_within = x > a.x && x < b.x;
        if depth >= MAX_DEPTH || !is_within || self.roots.incomplete {
            self.unresolved.push(Unresolved { ends, is_zero: false });
            return;
        }
        let Some(middle) = self.at(x) else {
            self.beside_gap([Some(a), Some(b)], [x, x], depth + 1);
            return;
        };
        let halves = [[a, middle], [middle, b]];
        let noise = a.noise.max(b.noise).max(middle.noise);
        let is_small = |range: RangeInclusive<f64>| {
            halves.iter().flat_map(|&half| coefficients(half)).all(|c| range.contains(&c))
        };
        if is_small(-noise..=noise) {
            self.unresolved.push(Unresolved { ends, is_zero: true });
            return;
        }
        let margin = error(ends, middle) + noise;
        for half in halves {
            let c = coefficients(half);
            let has_none = c.iter().all(|&c| c > margin) || c.iter().all(|&c| c < -margin);
            let steps = [c[1] - c[0], c[2] - c[1], c[3] - c[2]];
            let is_monotone =
                steps.iter().all(|&s| s > margin) || steps.iter().all(|&s| s < -margin);
            if has_none {
                continue;
            }
            if is_monotone && half[0].sign() * half[1].sign() != 0.0 {
                if half[0].sign() != half[1].sign() {
                    self.bracket(half);
                }
            } else {
                self.cell(half, depth + 1);
            }
        }
    }

    /// The cells on both sides of a gap: between values, and points without one.
    fn beside_gap(&mut self, values: [Option<Sample>; 2], missing: [f64; 2], depth: u32) {
        let mut end_of = |from: Option<Sample>, to: f64| {
            let from = from?;
            let has_value = |x: f64| Ok::<_, Infallible>(self.at(x).is_some());
            let Ok([near, _]) = bisect([from.x, to], EDGE_HALVINGS, has_value);
            if near == from.x { Some(from) } else { self.at(near) }
        };
        let ends = [end_of(values[0], missing[0]), end_of(values[1], missing[1])];
        if let ([Some(a), _], [Some(end), _]) = (values, ends)
            && a.x < end.x
        {
            self.cell([a, end], depth);
        }
        if let ([_, Some(b)], [_, Some(end)]) = (values, ends)
            && end.x < b.x
        {
            self.cell([end, b], depth);
        }
        // One point without a value, and different signs beside it.
        if let ([Some(a), Some(b)], [Some(first), Some(last)]) = (ends, values)
            && b.x - a.x <= POINT * (last.x - first.x)
            && a.sign() * b.sign() < 0.0
        {
            self.jump(0.5 * (a.x + b.x), a.value.abs().max(b.value.abs()));
        }
    }

    /// A change of sign at values of a size; where they rise far above those around, it is a pole.
    fn jump(&mut self, x: f64, size: f64) {
        let after = self.nodes.partition_point(|node| node.x < x);
        let beside = [after.checked_sub(1), Some(after)].into_iter().flatten();
        let nodes = beside.filter_map(|index| self.nodes.get(index));
        if size <= RISE * nodes.map(|node| node.value.abs()).fold(0.0, f64::max) {
            self.roots.jumps.push(x);
        }
    }

    /// Adjacent cells in which values are small. If they are zero over a width, that is an interval.
    fn resolve(&mut self, cluster: &[Unresolved], width: f64) {
        let (a, b) = (cluster[0].ends[0], cluster[cluster.len() - 1].ends[1]);
        let zeros = cluster.iter().filter(|cell| cell.is_zero);
        if zeros.map(|cell| cell.ends[1].x - cell.ends[0].x).sum::<f64>() >= width {
            self.roots.zero.push([a.x, b.x]);
            return;
        }
        let (before, after) = (a.sign(), b.sign());
        if before * after < 0.0 {
            self.bracket([a, b]);
        }
        // Zero at one end: the function begins or ends there, beside a gap.
        if before * after <= 0.0 {
            return;
        }
        let nearest = self.nearest_to_zero(cluster, before);
        if nearest.sign() == 0.0 {
            self.roots.isolated.push(Root { at: nearest.x, signs: [before, after] });
        } else if nearest.sign() != before {
            self.bracket([a, nearest]);
            self.bracket([nearest, b]);
        }
    }

    /// The sample of a cluster where a function of this sign is nearest to zero, or crosses it.
    fn nearest_to_zero(&mut self, cluster: &[Unresolved], sign: f64) -> Sample {
        let (a, b) = (cluster[0].ends[0], cluster[cluster.len() - 1].ends[1]);
        let falls = |sample: Sample| -sign * sample.slope;
        if falls(a) > 0.0 && falls(b) < 0.0 {
            let slope = |x: f64| self.at(x).map(falls).ok_or(());
            let turns = itp((a.x, falls(a)), (b.x, falls(b)), width(a, b), |v| v <= 0.0, slope);
            if let Some(sample) = turns.ok().and_then(|x| self.at(x)) {
                return sample;
            }
        }
        let inner = cluster.iter().map(|cell| cell.ends[1]);
        inner.fold(a, |nearest, s| if sign * s.value < sign * nearest.value { s } else { nearest })
    }

    /// A root between values of different signs.
    fn bracket(&mut self, [a, b]: [Sample; 2]) {
        let (sign, width) = (a.value.signum(), width(a, b));
        let value = |x: f64| self.at(x).map(|sample| sign * sample.value).ok_or(());
        let crossing =
            itp((a.x, sign * a.value), (b.x, sign * b.value), width, |v| v <= 0.0, value);
        let Some(root) = crossing.ok().and_then(|x| self.at(x)) else {
            self.jump(0.5 * (a.x + b.x), a.value.abs().min(b.value.abs()));
            return;
        };
        let change = root.slope.abs() * width;
        if sign * root.slope > 0.0 && change > root.noise {
            // It goes through infinity: a pole.
            return;
        }
        if root.value.abs() > JUMP * (root.noise + change) {
            self.jump(root.x, root.value.abs());
        } else {
            self.roots.isolated.push(Root { at: root.x, signs: [sign, -sign] });
        }
    }
}

/// The width to which a root between two samples is located.
fn width(a: Sample, b: Sample) -> f64 {
    WIDTH_ULPS * f64::EPSILON * a.x.abs().max(b.x.abs())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{PI, TAU};

    /// Rounding of values of size 1.
    const NOISE: f64 = 1e-15;

    fn find(ends: [f64; 2], f: impl Fn(f64) -> Option<[f64; 2]>) -> Roots {
        let nodes: Vec<f64> =
            (0..=32).map(|i| ends[0] + (ends[1] - ends[0]) * f64::from(i) / 32.0).collect();
        all_roots(&nodes, |x| f(x).map(|[value, slope]| Sample { x, value, slope, noise: NOISE }))
    }

    fn places(roots: &Roots) -> Vec<f64> {
        roots.isolated.iter().map(|root| root.at).collect()
    }

    #[test]
    fn simple_roots_on_nodes_and_between() {
        for shift in [0.0, 0.1, 1e-9, -1e-17] {
            let f = |x: f64| Some([(3.0 * (x - shift)).sin(), 3.0 * (3.0 * (x - shift)).cos()]);
            let roots = find([-1.5, 1.5], f);
            let at = places(&roots);
            let expected = [shift - PI / 3.0, shift, shift + PI / 3.0];
            assert_eq!(at.len(), 3);
            assert!(at.iter().zip(expected).all(|(x, w)| (x - w).abs() < 1e-15), "{at:?}");
            let signs: Vec<_> = roots.isolated.iter().map(|root| root.signs).collect();
            assert_eq!(signs, [[1.0, -1.0], [-1.0, 1.0], [1.0, -1.0]]);
        }
    }

    #[test]
    fn close_roots_are_told_apart_from_touching_and_from_none() {
        for apart in [1e-1, 1e-3, 1e-6] {
            let (a, b) = (0.3, 0.3 + apart);
            let roots = find([-1.0, 1.0], |x| Some([(x - a) * (x - b), 2.0 * x - a - b]));
            let at = places(&roots);
            assert_eq!(at.len(), 2, "{apart} {roots:?}");
            assert!((at[0] - a).abs() < 1e-15 / apart && (at[1] - b).abs() < 1e-15 / apart);
            let miss = 0.25 * apart * apart;
            let f = |x: f64| Some([(x - a) * (x - a) + miss, 2.0 * (x - a)]);
            // A miss of 2.5e-13 is above the rounding.
            assert_eq!(places(&find([-1.0, 1.0], f)), Vec::<f64>::new());
        }
        let roots = find([-1.0, 1.0], |x| Some([(x - 0.3) * (x - 0.3), 2.0 * (x - 0.3)]));
        assert_eq!(roots.isolated.len(), 1);
        assert!((roots.isolated[0].at - 0.3).abs() < 1e-15);
        assert_eq!(roots.isolated[0].signs, [1.0, 1.0]);
    }

    #[test]
    fn triple_roots_and_three_close_ones() {
        let roots = find([-1.0, 1.1], |x| Some([(x - 0.3).powi(3), 3.0 * (x - 0.3).powi(2)]));
        assert_eq!(roots.isolated.len(), 1);
        assert!(
            (roots.isolated[0].at - 0.3).abs() < 1e-4 && roots.isolated[0].signs == [-1.0, 1.0]
        );
        let f = |x: f64| Some([x * (x * x - 1e-6), 3.0 * x * x - 1e-6]);
        let at = places(&find([-1.0, 1.1], f));
        assert_eq!(at.len(), 3);
        assert!((at[2] - 1e-3).abs() < 1e-12 && at[1].abs() < 1e-12);
    }

    #[test]
    fn gaps_and_poles_have_no_roots() {
        let inside = |x: f64| x.abs() <= 0.7 && (x - 0.11).abs() >= 1e-3;
        let f =
            |x: f64| inside(x).then_some([(x - 0.5) * (x + 0.6) * x, 3.0 * x * x + 0.2 * x - 0.3]);
        let at = places(&find([-1.0, 1.0], f));
        assert!(at.len() == 3 && (at[0] + 0.6).abs() < 1e-15, "{at:?}");
        // An island between two nodes.
        let island = |x: f64| ((x - 0.334).abs() < 0.003).then_some([x - 0.335, 1.0]);
        assert_eq!(places(&find([-1.0, 1.0], island)), [0.335]);
        // A wide gap hides a change of sign: no root, no jump.
        let wide = |x: f64| ((x - 0.3).abs() > 0.01).then(|| [(x - 0.3).signum(), 0.0]);
        assert_eq!(find([-1.0, 1.0], wide), Roots { has_values: true, ..Roots::default() });
        let pole = |x: f64| Some([1.0 / (x - 0.31), -1.0 / ((x - 0.31) * (x - 0.31))]);
        assert_eq!(find([-1.0, 1.0], pole), Roots { has_values: true, ..Roots::default() });
        let at_node = |x: f64| (x != 0.0).then(|| [1.0 / x, -1.0 / (x * x)]);
        assert_eq!(find([-1.0, 1.0], at_node), Roots { has_values: true, ..Roots::default() });
        assert!(!find([-1.0, 1.0], |_| None).has_values);
    }

    #[test]
    fn jumps_and_intervals_of_zero_are_reported() {
        let jump = |x: f64| Some([if x < 0.3 { 1.0 } else { -1.0 }, 0.0]);
        let roots = find([-1.0, 1.0], jump);
        assert!(roots.isolated.is_empty() && (roots.jumps[0] - 0.3).abs() < 1e-14);
        // The jump itself has no value; on a node and between nodes.
        for at in [0.0, 0.3] {
            let jump = |x: f64| (x != at).then(|| [(x - at).signum(), 0.0]);
            let roots = find([-1.0, 1.0], jump);
            assert!(roots.isolated.is_empty() && (roots.jumps[0] - at).abs() < 1e-8, "{roots:?}");
        }
        let zero =
            |x: f64| Some(if x < 0.3 { [1e-16 * (99.0 * x).sin(), 0.0] } else { [x - 0.3, 1.0] });
        let roots = find([-1.0, 1.0], zero);
        assert_eq!(roots.isolated, []);
        assert!(roots.zero.len() == 1 && (roots.zero[0][1] - 0.3).abs() < 1e-6, "{roots:?}");
        assert_eq!(find([0.0, TAU], |_| Some([0.0, 0.0])).zero, [[0.0, TAU]]);
    }

    #[test]
    fn a_function_that_cannot_be_resolved_is_reported() {
        let wild = |x: f64| Some([(1e9 * x).sin(), 1e9 * (1e9 * x).cos()]);
        assert!(find([0.0, 1.0], wild).incomplete);
    }
}
