//! All complex assemblies of one group with random dimensions: a start for those of any dimensions.
//!
//! The paths begin at products of linear forms. Each choice of n factors in X and the other n in Y has one
//! solution: C(2n, n), the greatest possible number (Sommese & Wampler 2005, ch. 8, a two-homogeneous
//! start). Some paths end at infinity; how many is a property of the group.

use super::compare::is_same;
use super::follow::{Ends, follow};
use super::forms::GroupForms;
use super::homotopy::{Homotopy, Parameters};
use super::linear::{inverse, solve};
use super::paths::Tightness;
use super::random::Random;
use crate::math::simd::Simd;
use crate::math::vector::Vector;

/// Paths that may lead to infinity are followed up to here.
const NEAR_END: f64 = 1.0 - 1.0e-9;
/// Rounds of Newton's iteration from there: toward a multiple solution each halves the distance.
const ROUNDS: usize = 40;
/// The last of them, relative to the solution, if the solution is regular: rounding times its condition,
/// which rarely reaches a million for random parameters. At a multiple solution rounding leaves its root,
/// 1e-8.
const REGULAR: f64 = 1.0e-9;
/// A solution with a first homogeneous coordinate this small is at infinity.
const AT_INFINITY: f64 = 1.0e-7;
/// Distance of the parameters from those of the drawing, in sizes: near enough for short paths, and far
/// from the dead points that lie near real parameters.
const AWAY: f64 = 0.3;
/// Searches without two that agree before the group is given up.
const TRIALS: u64 = 6;

/// The complex assemblies of a group with random parameters.
#[derive(Debug)]
pub(super) struct Fibre {
    pub parameters: Parameters,
    /// Components of x, then of y.
    pub points: Vec<Vec<Vector>>,
}

impl Fibre {
    /// Finds the assemblies for parameters beside `drawing`; `None` if no two searches agree.
    pub(super) fn new(forms: &GroupForms, drawing: &Parameters, seed: u64) -> Option<Self> {
        let mut random = Random(seed);
        let mut beside = |x: Vector| {
            // A drawing that does not close leaves points unknown.
            let is_known = x.x.is_finite() && x.y.is_finite();
            let from = if is_known { x } else { Vector::ZERO };
            from + random.complex().scale(if is_known { AWAY } else { 1.0 })
        };
        let parameters: Parameters = drawing.iter().map(|&[x, y]| [beside(x), beside(y)]).collect();
        let system = Homotopy::between(forms, &parameters, &parameters);
        let mut earlier: Vec<Vec<Vec<Vector>>> = Vec::new();
        for _ in 0..TRIALS {
            let solutions = finite_solutions(&system, forms.half(), &mut random);
            if !are_different(&solutions) {
                // A path has jumped to another.
                continue;
            }
            // A search may miss a solution, but one that an earlier search found exists.
            let is_complete =
                earlier.iter().all(|earlier_points| earlier_points.len() <= solutions.len());
            if is_complete && earlier.iter().any(|earlier_points| agree(&solutions, earlier_points))
            {
                return Some(Self { parameters, points: solutions });
            }
            earlier.push(solutions);
        }
        None
    }
}

/// The finite regular solutions of a system, by a random start.
fn finite_solutions(system: &Homotopy, half: usize, random: &mut Random) -> Vec<Vec<Vector>> {
    let n = system.variables + 1;
    let coordinates =
        [0, 1].map(|_| -> Vec<Vector> { (0..n * n).map(|_| random.complex()).collect() });
    let there = system.transformed([&coordinates[0], &coordinates[1]]);
    let mut form = || -> Vec<Vector> { (0..n).map(|_| random.complex()).collect() };
    let products: Vec<[Vec<Vector>; 2]> = system.forms.iter().map(|_| [form(), form()]).collect();
    let way = there.beginning_at(&products, random.direction());
    let starts: Vec<Vec<Vector>> = (0..1_usize << products.len())
        .filter(|choice| choice.count_ones() as usize == half)
        .map(|choice| start(&there, &products, choice))
        .collect();
    let ends = follow(&way, &starts, Tightness::LOOSE, NEAR_END, Simd::default());
    let finished = Homotopy { ..way };
    let Ends { points, last, .. } = super::follow::refine(&finished, &ends.points, ROUNDS);
    let mut solutions = Vec::new();
    for (point, last) in points.into_iter().zip(last) {
        let [x, y] = [0, 1].map(|side| {
            let variables = &point[side * (n - 1)..][..n - 1];
            let by = &coordinates[side];
            let full = |i: usize| {
                variables
                    .iter()
                    .enumerate()
                    .fold(by[i * n], |sum, (j, &x)| sum + by[i * n + j + 1] * x)
            };
            (0..n).map(full).collect::<Vec<Vector>>()
        });
        let is_finite = [&x, &y].iter().all(|full| {
            let size = full.iter().map(|x| x.norm()).fold(0.0, f64::max);
            full[0].norm() > AT_INFINITY * size
        });
        if last < REGULAR && is_finite {
            let mut affine = Vec::with_capacity(2 * (n - 1));
            for full in [x, y] {
                let scale = inverse(full[0]);
                affine.extend(full[1..].iter().map(|&x| x * scale));
            }
            solutions.push(affine);
        }
    }
    solutions
}

/// The point where chosen left factors vanish, and the right ones of all other products.
fn start(system: &Homotopy, products: &[[Vec<Vector>; 2]], choice: usize) -> Vec<Vector> {
    let n = system.variables;
    let mut point = Vec::with_capacity(2 * n);
    for side in 0..2 {
        let mut matrix = Vec::with_capacity(n * (n + 1));
        let mut add = |factors: &[Vector]| {
            matrix.extend_from_slice(&factors[1..]);
            matrix.push(-factors[0]);
        };
        for (k, product) in products.iter().enumerate() {
            if choice >> k & 1 == 1 - side {
                add(&product[side]);
            }
        }
        for row in &system.rows[side] {
            let row: Vec<Vector> = row.iter().map(|factor| factor[0]).collect();
            add(&row);
        }
        solve(&mut matrix, n);
        point.extend(matrix.chunks_exact(n + 1).map(|row| row[n]));
    }
    point
}

/// Whether all solutions of a list differ.
fn are_different(points: &[Vec<Vector>]) -> bool {
    points.iter().enumerate().all(|(i, a)| points[..i].iter().all(|b| !is_same(a, b)))
}

/// Whether two lists of different solutions hold the same ones.
fn agree(left: &[Vec<Vector>], right: &[Vec<Vector>]) -> bool {
    left.len() == right.len()
        && left.iter().all(|point| right.iter().filter(|right| is_same(point, right)).count() == 1)
        && right.iter().all(|point| left.iter().filter(|right| is_same(point, right)).count() == 1)
}
