//! The derivatives of one design at some positions, a register of these at a time.

use std::mem::MaybeUninit;

use super::cotangent::Cotangent;
use super::linearization::Linearization;
use super::plan::SensitivityPlan;
use super::request::Product;
use super::tangent::Tangent;
use crate::batch::dispatch::Task;
use crate::batch::motion::SolvedDesign;
use crate::batch::rows::RowSlices;
use crate::branch::design::Design;
use crate::math::lanes::{LANES, Mask, Real};
use crate::plan::constants_rate::ConstantsRate;
use crate::state::status::Status;

/// Work space of a thread.
#[derive(Debug, Default)]
pub(super) struct SensitivitySpace<R> {
    linear: Linearization<R>,
    tangent: Tangent<R>,
    cotangent: Cotangent<R>,
    by: Vec<R>,
    /// Sums over positions, several for each dimension.
    totals: Vec<R>,
}

/// The derivatives of one design at some positions.
pub(super) struct Evaluate<'e, 'r, R: Real> {
    pub sensitivity: &'e SensitivityPlan<'e>,
    pub product: Product<'e>,
    pub solved: SolvedDesign<'e, 'e>,
    /// Rates of the constants, for [`Product::Forward`].
    pub rates: Option<&'e ConstantsRate>,
    pub space: &'e mut SensitivitySpace<R>,
    pub results: &'e mut RowSlices<'r>,
    /// Row of the first position in the results.
    pub first: usize,
}

impl<R: Real> Task<R> for Evaluate<'_, '_, R> {
    #[inline(always)]
    fn run(&mut self) {
        let total = self.product.is_total();
        let count = self.solved.status.len();
        if total {
            self.set_worst_status();
            self.space.totals.clear();
            let count = self.sensitivity.mechanism.dimensions().len();
            self.space.totals.resize(count * Self::SUMS, R::ZERO);
        }
        if !self.solved.is_valid {
            let count = if total { 1 } else { count };
            if !total {
                self.set_status(0, count);
            }
            for (column, out) in self.results.columns.iter_mut().enumerate() {
                let width = self.product.width(self.sensitivity.results[column].len());
                out[self.first * width..(self.first + count) * width]
                    .fill(MaybeUninit::new(f64::NAN));
            }
            return;
        }
        for row in (0..count).step_by(R::LANES) {
            let lanes = R::LANES.min(count - row);
            if !total {
                self.set_status(row, lanes);
            }
            let (design, columns) = (self.solved.design, self.solved.columns);
            self.space.linear.read(self.sensitivity, design, columns, row);
            match self.product {
                Product::Jacobian { by } => self.jacobian(by, row, lanes),
                Product::Forward { .. } => self.forward(row, lanes),
                Product::Backward { weights, by, .. } => self.backward(weights, by, row, lanes),
            }
        }
        if let Product::Backward { by, total: true, .. } = self.product {
            self.write_totals(by);
        }
    }
}

impl<R: Real> Evaluate<'_, '_, R> {
    /// Registers of a sum: as many lanes at every level, so that it has the same bits.
    const SUMS: usize = LANES / R::LANES;

    #[inline(always)]
    fn jacobian(&mut self, by: &[usize], row: usize, lanes: usize) {
        let (sensitivity, design) = (self.sensitivity, self.solved.design);
        for (column, components) in sensitivity.results.iter().enumerate() {
            let width = self.product.width(components.len());
            for (index, &component) in components.iter().enumerate() {
                self.space.cotangent.clear(sensitivity);
                self.space.cotangent.add(sensitivity.len(), &design.units, component, R::ONE);
                self.space.pull_back(sensitivity, design, self.solved.dimensions);
                for (place, &dimension) in by.iter().enumerate() {
                    let number = self.space.by[dimension];
                    self.write((column, width, index * by.len() + place), row, lanes, number);
                }
            }
        }
    }

    #[inline(always)]
    fn forward(&mut self, row: usize, lanes: usize) {
        let Some(rates) = self.rates else { return };
        let (sensitivity, units) = (self.sensitivity, &self.solved.design.units);
        self.space.tangent.solve(sensitivity, &self.space.linear, rates);
        for (column, components) in sensitivity.results.iter().enumerate() {
            for (index, &component) in components.iter().enumerate() {
                let number =
                    self.space.tangent.component(sensitivity.len(), (units, rates), component);
                self.write((column, components.len(), index), row, lanes, number);
            }
        }
    }

    #[inline(always)]
    fn backward(&mut self, weights: &[&[f64]], by: &[usize], row: usize, lanes: usize) {
        let (sensitivity, design) = (self.sensitivity, self.solved.design);
        self.space.cotangent.clear(sensitivity);
        for (components, weights) in sensitivity.results.iter().zip(weights) {
            let width = components.len();
            let first = if weights.len() == width { None } else { Some(self.solved.rows.start) };
            for (index, &component) in components.iter().enumerate() {
                let weight = match first {
                    None => R::splat(weights[index]),
                    Some(first) => R::from_lanes(|lane| {
                        weights[(first + row + lane.min(lanes - 1)) * width + index]
                    }),
                };
                self.space.cotangent.add(sensitivity.len(), &design.units, component, weight);
            }
        }
        self.space.pull_back(sensitivity, design, self.solved.dimensions);
        if self.product.is_total() {
            // Lanes beyond the last position repeat it.
            let exists = R::from_lanes(|lane| if lane < lanes { 1.0 } else { 0.0 });
            let sum = row / R::LANES % Self::SUMS;
            for &dimension in by {
                self.space.totals[dimension * Self::SUMS + sum] +=
                    self.space.by[dimension] * exists;
            }
            return;
        }
        for (place, &dimension) in by.iter().enumerate() {
            let number = self.space.by[dimension];
            self.write((0, by.len(), place), row, lanes, number);
        }
    }

    /// Writes the sums over all positions, lane after lane.
    #[inline(always)]
    fn write_totals(&mut self, by: &[usize]) {
        let worst = self.solved.status.iter().fold(0, |worst, &status| worst.max(status));
        let exists = worst <= Status::NearSingular as u8;
        for (place, &dimension) in by.iter().enumerate() {
            let mut sum = 0.0;
            for total in &self.space.totals[dimension * Self::SUMS..][..Self::SUMS] {
                for lane in 0..R::LANES {
                    sum += total.lane(lane);
                }
            }
            let value = if exists { sum } else { f64::NAN };
            self.results.columns[0][self.first * by.len() + place] = MaybeUninit::new(value);
            if exists && !sum.is_finite() {
                self.results.status[self.first] = MaybeUninit::new(Status::Singular as u8);
            }
        }
    }

    #[inline(always)]
    fn set_worst_status(&mut self) {
        let worst = self.solved.status.iter().fold(0, |worst, &status| worst.max(status));
        self.results.status[self.first] = MaybeUninit::new(worst);
    }

    /// Copies the statuses of the positions.
    #[inline(always)]
    fn set_status(&mut self, row: usize, lanes: usize) {
        for at in row..row + lanes {
            self.results.status[self.first + at] = MaybeUninit::new(self.solved.status[at]);
        }
    }

    /// Writes a number of each position: NaN where there is none.
    #[inline(always)]
    fn write(
        &mut self,
        (column, width, entry): (usize, usize, usize),
        row: usize,
        lanes: usize,
        number: R,
    ) {
        let finite = number.finite();
        let out = &mut self.results.columns[column];
        for lane in 0..lanes {
            let status = self.solved.status[row + lane];
            let exists = status <= Status::NearSingular as u8;
            let value = if exists && finite.lane(lane) { number.lane(lane) } else { f64::NAN };
            out[(self.first + row + lane) * width + entry] = MaybeUninit::new(value);
            if exists && !finite.lane(lane) {
                // The closures have no derivative there.
                self.results.status[self.first + row + lane] =
                    MaybeUninit::new(Status::Singular as u8);
            }
        }
    }
}

impl<R: Real> SensitivitySpace<R> {
    /// Passes the weights back to the dimensions.
    #[inline(always)]
    fn pull_back(
        &mut self,
        sensitivity: &SensitivityPlan<'_>,
        design: &Design<'_>,
        dimensions: &[f64],
    ) {
        let mechanism = sensitivity.mechanism;
        self.cotangent.pull_back(sensitivity, &self.linear);
        self.by.resize(dimensions.len(), R::ZERO);
        let constants = &self.cotangent.constants;
        let (plan, slots) = (mechanism.plan(), &mechanism.slots);
        constants.by_dimensions(plan, slots, &design.constants, dimensions, &mut self.by);
    }
}
