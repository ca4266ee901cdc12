//! How the oracle moves: Newton's method for positions, order by order for the
//! coefficients of the power series.

use nalgebra::{DVector, Dyn, LU};

use crate::oracles::body::{Oracle, Point, Position};
use crate::oracles::double_double::Dd;
use crate::oracles::series::convolve;

/// Largest residual at which a position counts as solved, of the size.
const SOLVED: f64 = 1e-28;
/// Residual below which the matrix is no longer renewed.
const NEAR: f64 = 1e-9;
/// Iterations: some to come near, then each gains 1e-16 times the condition.
const ITERATIONS: usize = 40;
/// A path that needs smaller parts counts as blocked.
const LEAST_STEP: f64 = 1.0 / 256.0;
/// How far from its prediction a position may be, as part of the step.
const BEND: f64 = 0.2;
/// Greatest turn of a body in one step, rad: no angle may slip by whole turns.
const TURN: f64 = 0.5;
/// Corrections of a series coefficient, each gaining 1e-16 times the condition.
const REFINEMENTS: usize = 12;

type Factors = LU<f64, Dyn, Dyn>;

fn heads(values: &[Dd]) -> DVector<f64> {
    DVector::from_iterator(values.len(), values.iter().map(|v| f64::from(*v)))
}

fn solve(factors: &Factors, rows: &[Dd]) -> Option<DVector<f64>> {
    factors.solve(&heads(rows))
}

impl Oracle {
    /// Subtracts a correction from coefficient `k` of every body.
    fn correct(&self, at: &mut Position, k: usize, step: &DVector<f64>) {
        for body in 0..at.bodies.len() {
            let Some(c) = self.column(body) else { continue };
            let b = &mut at.bodies[body];
            b.x[k] -= Dd::from(step[c]);
            b.y[k] -= Dd::from(step[c + 1]);
            b.turn[k] -= Dd::from(step[c + 2]);
        }
        self.turn(at, k);
    }

    /// Cosines and sines of order `k` from the rotations.
    fn turn(&self, at: &mut Position, k: usize) {
        for b in &mut at.bodies {
            if k == 0 {
                (b.sin[0], b.cos[0]) = b.turn[0].sin_cos();
            } else {
                let terms = &self.tables.turning[k];
                (b.cos[k], b.sin[k]) =
                    (-convolve(terms, &b.turn, &b.sin), convolve(terms, &b.turn, &b.cos));
            }
        }
    }

    /// Newton's method from a guess; the factors are those of the last matrix.
    fn assemble(&self, mut at: Position) -> Option<(Position, Factors)> {
        let mut factors = self.matrix(&at).lu();
        let mut before = f64::INFINITY;
        for _ in 0..ITERATIONS {
            let rows = self.residual(&at, 0);
            let size = heads(&rows).amax();
            if size <= SOLVED {
                return Some((at, factors));
            }
            if size.is_nan() || size > 10.0 * before.min(1.0) {
                return None;
            }
            if before > NEAR {
                factors = self.matrix(&at).lu();
            }
            before = size;
            let step = solve(&factors, &rows)?;
            self.correct(&mut at, 0, &step);
        }
        None
    }

    /// From one position to another value of the drivers, straight and in steps
    /// small enough to stay in the assembly: near the tangent, and the determinant
    /// keeps its sign. None if a fold blocks the path.
    pub fn follow(&self, from: &Position, to: &[f64]) -> Option<Position> {
        let goal: Vec<Dd> = to.iter().zip(&self.unit).map(|(q, u)| Dd::from(q / u)).collect();
        let path: Vec<Dd> = goal.iter().zip(&from.q).map(|(g, q)| *g - *q).collect();
        let (mut at, mut factors) = self.assemble(from.clone())?;
        let sign = factors.determinant().signum();
        let (mut gone, mut step) = (0.0, 0.25);
        while gone < 1.0 {
            // q enters its own equation only, with the factor −1.
            let mut guess = at.clone();
            for ((q, w), f) in guess.q.iter_mut().zip(&path).zip(&from.q) {
                *q = *f + *w * Dd::from(gone + step);
            }
            let tangent = solve(&factors, &self.residual(&guess, 0))?;
            let turned = tangent.iter().skip(2).step_by(3).fold(0.0, |m: f64, t| m.max(t.abs()));
            self.correct(&mut guess, 0, &tangent);
            let predicted = guess.clone();
            match self.assemble(guess) {
                Some((reached, new))
                    if turned <= TURN
                        && new.determinant().signum() == sign
                        && distance(&predicted, &reached) <= BEND * tangent.amax() + 1e-12 =>
                {
                    (at, factors) = (reached, new);
                    gone += step;
                }
                _ if step <= LEAST_STEP => return None,
                _ => step *= 0.5,
            }
        }
        // The last point of the path is the goal up to rounding in double-double.
        at.q = goal;
        Some(self.assemble(at)?.0)
    }

    /// Fills in the coefficients of the series: the same matrix at every order,
    /// and as right-hand side what the orders below leave open.
    pub fn differentiate(&self, at: &mut Position) {
        let factors = self.matrix(at).lu();
        for k in 1..self.tables.len() {
            for b in &mut at.bodies {
                (b.x[k], b.y[k], b.turn[k]) = (Dd::ZERO, Dd::ZERO, Dd::ZERO);
            }
            self.turn(at, k);
            for _ in 0..REFINEMENTS {
                let rows = self.residual(at, k);
                if heads(&rows).amax() == 0.0 {
                    break;
                }
                let step = solve(&factors, &rows).expect("a regular position");
                self.correct(at, k, &step);
                if step.amax() < 1e-26 * coefficient(at, k) {
                    break;
                }
            }
        }
    }
}

impl Oracle {
    /// Greatest coordinate, as a part of `size`: of joints and links' own points (seen
    /// from the ground's first joint, where it has one) and of slides.
    pub fn extent(&self, at: &Position) -> f64 {
        let place = |joint: &(usize, Point)| at.point(joint.0, joint.1, 0);
        let base = self.joints.iter().find(|j| j.0 == self.ground).map(place);
        let base = base.unwrap_or([Dd::ZERO; 2]);
        let own = at.bodies.iter().map(|b| [b.x[0], b.y[0]]);
        let far = |p: Point| f64::from(p[0] - base[0]).abs().max(f64::from(p[1] - base[1]).abs());
        let slides = self.values.iter().map(|v| f64::from(self.reach(at, v, 0)).abs());
        self.joints.iter().map(place).chain(own).map(far).chain(slides).fold(0.0, f64::max)
    }

    /// By what an angle's error is to be multiplied to be a length: for every link
    /// the greatest distance between joints that turn with it (on it or on links
    /// tied to it by slides), as a part of `size`; 1 where there are no two.
    pub fn arms(&self, at: &Position) -> Vec<f64> {
        let mut tied: Vec<usize> = (0..at.bodies.len()).collect();
        for v in &self.values {
            let (from, to) = (tied[v.a], tied[v.b]);
            tied.iter_mut().filter(|t| **t == from).for_each(|t| *t = to);
        }
        let arm = |class: usize| {
            let joints: Vec<Point> = self
                .pins
                .iter()
                .filter(|(body, _)| tied[*body] == class)
                .map(|&(body, u)| at.point(body, u, 0))
                .collect();
            let gap = |p: Point, r: Point| f64::from(p[0] - r[0]).hypot(f64::from(p[1] - r[1]));
            let all = joints.iter().flat_map(|&p| joints.iter().map(move |&r| gap(p, r)));
            let greatest = all.fold(0.0, f64::max);
            if greatest > 0.0 { greatest } else { 1.0 }
        };
        tied.iter().map(|&class| arm(class)).collect()
    }
}

/// Greatest distance between two positions in any coordinate.
fn distance(a: &Position, b: &Position) -> f64 {
    let far = |x: &[Dd], y: &[Dd]| f64::from(x[0] - y[0]).abs();
    (a.bodies.iter().zip(&b.bodies))
        .map(|(a, b)| far(&a.x, &b.x).max(far(&a.y, &b.y)).max(far(&a.turn, &b.turn)))
        .fold(0.0, f64::max)
}

/// Greatest coefficient of an order.
fn coefficient(at: &Position, k: usize) -> f64 {
    let greatest = at.bodies.iter().flat_map(|b| [b.x[k], b.y[k], b.turn[k]]);
    greatest.map(|v| f64::from(v).abs()).fold(0.0, f64::max)
}
