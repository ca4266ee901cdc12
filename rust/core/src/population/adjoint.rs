//! Derivatives of the traced joint by all numbers of a packed linkage, by the adjoint method: weights go from
//! the last joint back to those that it was placed on.
//!
//! With the bars e = P − I and f = P − J of a dyad and λ the weight at P, α = (λ × f) / (e × f) and
//! β = (e × λ) / (e × f) are the parts of λ along both; the weight at I grows by α e, that at J by β f, and the
//! derivatives by the lengths are α a, β b.

use super::course::{Angles, Course};
use super::packed::{PackedLinkage, Placement};
use crate::batch::dispatch::{Entry, Task};
use crate::math::lanes::{LANES, Real};
use crate::math::vector::Vector;

/// Derivatives of the traced joint: for each number (the arc is the last) a line of x and one of y, over the
/// positions on the arc. A line has room before its first position and behind its last.
#[derive(Debug, Clone, Default)]
pub(crate) struct Jacobian {
    lines: Vec<f64>,
    /// How many numbers there are.
    pub numbers: usize,
    /// How many positions there are.
    pub positions: usize,
}

impl Jacobian {
    /// Where the line of a coordinate by a number has its first position.
    #[inline(always)]
    fn start(&self, number: usize, axis: usize) -> usize {
        (2 * number + axis) * (self.positions + 2 * LANES) + LANES
    }

    /// The derivatives by a number at the positions one before those from `t` on, at these, and one behind.
    #[inline(always)]
    pub(crate) fn neighbours<R: Real>(&self, number: usize, t: usize) -> [Vector<R>; 3] {
        let [x, y] = [0, 1].map(|axis| {
            let first = self.start(number, axis) + t - 1;
            &self.lines[first..first + R::LANES + 2]
        });
        [0, 1, 2].map(|shift| Vector::new(R::read(&x[shift..]), R::read(&y[shift..])))
    }

    /// Puts the last position before the first, and the first behind the last.
    fn close(&mut self) {
        for line in self.lines.chunks_exact_mut(self.positions + 2 * LANES) {
            line[LANES - 1] = line[LANES + self.positions - 1];
            line[LANES + self.positions] = line[LANES];
        }
    }
}

/// Finds the derivatives of the last joint on the arc.
pub(crate) fn jacobian<L: Entry>(
    linkage: &PackedLinkage,
    angles: &Angles,
    course: &Course,
    weights: &mut Vec<f64>,
    out: &mut Jacobian,
) {
    out.numbers = 2 * linkage.len() + 1;
    out.positions = angles.arc;
    out.lines.resize(2 * out.numbers * (out.positions + 2 * LANES), 0.0);
    weights.resize(4 * LANES * linkage.len(), 0.0);
    L::call(&mut Adjoint { linkage, angles, course, weights, out });
    out.close();
}

struct Adjoint<'a> {
    linkage: &'a PackedLinkage,
    angles: &'a Angles,
    course: &'a Course,
    /// Weights of the coordinate x and of y at each joint: four registers a joint.
    weights: &'a mut [f64],
    out: &'a mut Jacobian,
}

impl<R: Real> Task<R> for Adjoint<'_> {
    #[inline(always)]
    fn run(&mut self) {
        let last = self.linkage.len() - 1;
        for t in (0..self.angles.arc).step_by(R::LANES) {
            self.weights.fill(0.0);
            self.add::<R>(last, 0, Vector::ONE);
            self.add::<R>(last, 1, Vector::ONE.left());
            for joint in (0..=last).rev() {
                self.pass::<R>(joint, t);
            }
        }
    }
}

impl Adjoint<'_> {
    /// The weight of a coordinate at a joint.
    #[inline(always)]
    fn weight<R: Real>(&self, joint: usize, axis: usize) -> Vector<R> {
        let first = (4 * joint + 2 * axis) * LANES;
        Vector::new(R::read(&self.weights[first..]), R::read(&self.weights[first + LANES..]))
    }

    #[inline(always)]
    fn add<R: Real>(&mut self, joint: usize, axis: usize, weight: Vector<R>) {
        let sum = self.weight::<R>(joint, axis) + weight;
        let first = (4 * joint + 2 * axis) * LANES;
        sum.x.put(&mut self.weights[first..]);
        sum.y.put(&mut self.weights[first + LANES..]);
    }

    /// Writes the derivatives of a coordinate by a joint's numbers from `number` on.
    #[inline(always)]
    fn write<R: Real>(&mut self, (t, axis): (usize, usize), number: usize, values: &[R]) {
        for (index, value) in values.iter().enumerate() {
            let first = self.out.start(number + index, axis) + t;
            value.put(&mut self.out.lines[first..]);
        }
    }

    /// Passes the weights at a joint to those that it is placed on.
    #[inline(always)]
    fn pass<R: Real>(&mut self, joint: usize, t: usize) {
        let numbers = self.linkage.numbers[joint];
        let at = |index: usize| self.course.register::<R>(index, t);
        match self.linkage.placements[joint] {
            Placement::Pivot => {
                for axis in 0..2 {
                    let weight = self.weight::<R>(joint, axis);
                    self.write((t, axis), 2 * joint, &[weight.x, weight.y]);
                }
            }
            Placement::Crank => {
                let sense = R::splat(self.linkage.sense);
                let arm = at(1) - at(0);
                let (cos, sin) = (&self.angles.cos[t..], &self.angles.sin[t..]);
                let back = Vector::new(R::read(cos), -(sense * R::read(sin)));
                let part = R::read(&self.angles.rates[t..]) * sense;
                for axis in 0..2 {
                    let weight = self.weight::<R>(joint, axis);
                    let turned = back * weight;
                    self.write((t, axis), 2 * joint, &[turned.x, turned.y]);
                    let arc = part * arm.cross(weight);
                    self.write((t, axis), 2 * self.linkage.len(), &[arc]);
                    self.add(0, axis, weight);
                }
            }
            Placement::Rigid { ends: [i, j] } => {
                let bar = at(j) - at(i);
                let ratio = Vector::<R>::splat(Vector::new(numbers[0], numbers[1]));
                for axis in 0..2 {
                    let weight = self.weight::<R>(joint, axis);
                    let by_ratio = bar.conj() * weight;
                    self.write((t, axis), 2 * joint, &[by_ratio.x, by_ratio.y]);
                    let passed = ratio.conj() * weight;
                    self.add(j, axis, passed);
                    self.add(i, axis, weight - passed);
                }
            }
            Placement::Dyad { ends: [i, j], .. } => {
                let point = at(joint);
                let (bar_i, bar_j) = (point - at(i), point - at(j));
                let inverse = R::ONE / bar_i.cross(bar_j);
                let [a, b] = numbers.map(R::splat);
                for axis in 0..2 {
                    let weight = self.weight::<R>(joint, axis);
                    let alpha = weight.cross(bar_j) * inverse;
                    let beta = bar_i.cross(weight) * inverse;
                    self.write((t, axis), 2 * joint, &[alpha * a, beta * b]);
                    self.add(i, axis, bar_i.scale(alpha));
                    self.add(j, axis, bar_j.scale(beta));
                }
            }
        }
    }
}

/// The gradient by all numbers, the arc last, of a sum Σ λ · P of joints at one position, added to `out`.
pub(crate) fn add_gradient_at(
    linkage: &PackedLinkage,
    angles: &Angles,
    course: &Course,
    position: usize,
    seeds: &[(usize, Vector)],
    out: &mut [f64],
) {
    let mut weights = vec![Vector::ZERO; linkage.len()];
    for &(joint, weight) in seeds {
        weights[joint] += weight;
    }
    let at = |joint: usize| course.point(joint, position);
    for joint in (0..linkage.len()).rev() {
        let weight = weights[joint];
        if weight == Vector::ZERO {
            continue;
        }
        let numbers = linkage.numbers[joint];
        let by_numbers = match linkage.placements[joint] {
            Placement::Pivot => weight,
            Placement::Crank => {
                weights[0] += weight;
                let arm = at(joint) - at(0);
                out[2 * linkage.len()] +=
                    angles.rates[position] * linkage.sense * arm.cross(weight);
                let back = Vector::new(angles.cos[position], -linkage.sense * angles.sin[position]);
                back * weight
            }
            Placement::Rigid { ends: [i, j] } => {
                let passed = Vector::new(numbers[0], numbers[1]).conj() * weight;
                weights[j] += passed;
                weights[i] += weight - passed;
                (at(j) - at(i)).conj() * weight
            }
            Placement::Dyad { ends: [i, j], .. } => {
                let (bar_i, bar_j) = (at(joint) - at(i), at(joint) - at(j));
                let area = bar_i.cross(bar_j);
                let (alpha, beta) = (weight.cross(bar_j) / area, bar_i.cross(weight) / area);
                weights[i] += bar_i.scale(alpha);
                weights[j] += bar_j.scale(beta);
                Vector::new(alpha * numbers[0], beta * numbers[1])
            }
        };
        out[2 * joint] += by_numbers.x;
        out[2 * joint + 1] += by_numbers.y;
    }
}
