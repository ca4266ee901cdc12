//! Derivatives by the constants of a design: of each position, or summed over positions.

use std::ops::AddAssign;

use super::plan::SensitivityPlan;
use super::registers::{entry, entry_mut, grow};
use super::steps::ComponentKind;
use crate::math::lanes::{LANES, Real};
use crate::math::vector::Vector;
use crate::plan::constants_rate::ConstantsRate;

/// Derivatives by the constants, as in [`ConstantsRate`]. Each entry has a register for so many lanes of
/// positions; or a few into which all positions are summed, as many lanes at every level, so that sums have the
/// same bits.
#[derive(Debug, Default)]
pub(super) struct ConstantsSum<R> {
    /// Registers of an entry.
    registers: usize,
    /// x and y of the origin.
    origin: [Vec<R>; 2],
    edge_vector: Vec<Vector<R>>,
    guide: Vec<Vector<R>>,
    fixed: Vec<Vector<R>>,
    offset: Vec<R>,
}

impl<R: Real> ConstantsSum<R> {
    /// Registers of a sum.
    const SUMMED: usize = LANES / R::LANES;

    /// Begins sums over positions.
    #[inline(always)]
    pub(super) fn begin_total(&mut self, sensitivity: &SensitivityPlan<'_>) {
        self.begin(sensitivity, Self::SUMMED);
    }

    /// Begins the derivatives of so many registers of positions.
    #[inline(always)]
    pub(super) fn begin(&mut self, sensitivity: &SensitivityPlan<'_>, registers: usize) {
        self.registers = registers;
        let (plan, backward) = (sensitivity.plan(), &sensitivity.backward);
        grow(&mut self.edge_vector, plan.edges.len() * registers);
        grow(&mut self.guide, plan.edges.len() * registers);
        grow(&mut self.fixed, plan.points * registers);
        grow(&mut self.offset, plan.rotation.len() * registers);
        for origin in &mut self.origin {
            grow(origin, registers);
            origin[..registers].fill(R::ZERO);
        }
        for (vectors, entries) in [
            (&mut self.edge_vector, &backward.edges),
            (&mut self.guide, &backward.guides),
            (&mut self.fixed, &backward.fixed),
        ] {
            for &index in entries {
                entry_mut(vectors, index, registers).fill(Vector::ZERO);
            }
        }
        for &link in &backward.links {
            entry_mut(&mut self.offset, link, registers).fill(R::ZERO);
        }
    }

    /// Adds the weights of a component of a result itself.
    #[inline(always)]
    pub(super) fn add_result(&mut self, kind: ComponentKind, weights: &[R]) {
        let registers = self.registers;
        match kind {
            ComponentKind::X { .. } => {
                add_in_turns(&mut self.origin[0][..registers], weights);
            }
            ComponentKind::Y { .. } => {
                add_in_turns(&mut self.origin[1][..registers], weights);
            }
            ComponentKind::Slide(_) => {}
            ComponentKind::Angle { link, .. } => {
                let offsets = entry_mut(&mut self.offset, link, registers);
                add_in_turns(offsets, weights);
            }
        }
    }

    /// Adds what an edge that turns by `units` gets where it has these weights.
    #[inline(always)]
    pub(super) fn add_edge(&mut self, edge: usize, units: &[Vector<R>], weights: &[Vector<R>]) {
        let sums = entry_mut(&mut self.edge_vector, edge, self.registers);
        add_turned(sums, units, weights);
    }

    /// The same for the guide along it.
    #[inline(always)]
    pub(super) fn add_guide(&mut self, edge: usize, strokes: &[Vector<R>], weights: &[Vector<R>]) {
        let sums = entry_mut(&mut self.guide, edge, self.registers);
        add_turned(sums, strokes, weights);
    }

    /// Adds the weights of a fixed point.
    #[inline(always)]
    pub(super) fn add_fixed(&mut self, point: usize, weights: &[Vector<R>]) {
        let sums = entry_mut(&mut self.fixed, point, self.registers);
        add_in_turns(sums, weights);
    }

    /// The derivatives in one register.
    #[inline(always)]
    pub(super) fn register(
        &self,
        sensitivity: &SensitivityPlan<'_>,
        g: usize,
        rate: &mut ConstantsRate<R>,
    ) {
        let backward = &sensitivity.backward;
        make_room(sensitivity, rate);
        rate.origin = Vector::new(self.origin[0][g], self.origin[1][g]);
        for &edge in &backward.edges {
            rate.edge_vector[edge] = entry(&self.edge_vector, edge, self.registers)[g];
        }
        for &edge in &backward.guides {
            rate.guide[edge] = entry(&self.guide, edge, self.registers)[g];
        }
        for &point in &backward.fixed {
            rate.fixed[point] = entry(&self.fixed, point, self.registers)[g];
        }
        for &link in &backward.links {
            rate.offset[link] = entry(&self.offset, link, self.registers)[g];
        }
    }

    /// The sums over all positions.
    #[inline(always)]
    pub(super) fn sums(&self, sensitivity: &SensitivityPlan<'_>, rate: &mut ConstantsRate) {
        let (backward, registers) = (&sensitivity.backward, self.registers);
        make_room(sensitivity, rate);
        // Another plan may have left weights.
        for vectors in [&mut rate.edge_vector, &mut rate.guide, &mut rate.fixed] {
            vectors.fill(Vector::ZERO);
        }
        rate.offset.fill(0.0);
        let [x, y] = &self.origin;
        rate.origin = Vector::new(lane_sum(&x[..registers]), lane_sum(&y[..registers]));
        for &edge in &backward.edges {
            rate.edge_vector[edge] = vector_sum(entry(&self.edge_vector, edge, registers));
        }
        for &edge in &backward.guides {
            rate.guide[edge] = vector_sum(entry(&self.guide, edge, registers));
        }
        for &point in &backward.fixed {
            rate.fixed[point] = vector_sum(entry(&self.fixed, point, registers));
        }
        for &link in &backward.links {
            rate.offset[link] = lane_sum(entry(&self.offset, link, registers));
        }
    }
}

/// Adds weights seen from what turns by `units`. No closures here: they are not always inlined into the code of a
/// level, and then take three times as long.
#[inline(always)]
fn add_turned<R: Real>(sums: &mut [Vector<R>], units: &[Vector<R>], weights: &[Vector<R>]) {
    if let [sum] = sums {
        // Kept in a register.
        let mut total = *sum;
        for (unit, &weight) in units.iter().zip(weights) {
            total += unit.conj() * weight;
        }
        *sum = total;
        return;
    }
    let registers = sums.len();
    for (units, weights) in units.chunks(registers).zip(weights.chunks(registers)) {
        for ((sum, unit), &weight) in sums.iter_mut().zip(units).zip(weights) {
            *sum += unit.conj() * weight;
        }
    }
}

/// Adds weights to sums in turns: one to each, and from the first again.
#[inline(always)]
fn add_in_turns<S: Copy + AddAssign>(sums: &mut [S], weights: &[S]) {
    if let [sum] = sums {
        let mut total = *sum;
        for &weight in weights {
            total += weight;
        }
        *sum = total;
        return;
    }
    for weights in weights.chunks(sums.len()) {
        for (sum, &weight) in sums.iter_mut().zip(weights) {
            *sum += weight;
        }
    }
}

/// The sum of the lanes of some registers, one after another.
#[inline(always)]
fn lane_sum<R: Real>(registers: &[R]) -> f64 {
    let mut sum = 0.0;
    for register in registers {
        for lane in 0..R::LANES {
            sum += register.lane(lane);
        }
    }
    sum
}

/// The same for vectors.
#[inline(always)]
fn vector_sum<R: Real>(registers: &[Vector<R>]) -> Vector {
    let mut sum = Vector::ZERO;
    for register in registers {
        for lane in 0..R::LANES {
            sum += Vector::new(register.x.lane(lane), register.y.lane(lane));
        }
    }
    sum
}

/// Makes room for all constants; those without weights stay zero.
#[inline(always)]
fn make_room<R: Real>(sensitivity: &SensitivityPlan<'_>, rate: &mut ConstantsRate<R>) {
    let plan = sensitivity.plan();
    grow(&mut rate.edge_vector, plan.edges.len());
    grow(&mut rate.guide, plan.edges.len());
    grow(&mut rate.fixed, plan.points);
    grow(&mut rate.offset, plan.rotation.len());
}
