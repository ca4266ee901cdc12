//! The derivatives of one design at some positions, some registers of these at a time.

use std::mem::MaybeUninit;

use super::cotangent::Cotangent;
use super::linearization::Linearization;
use super::plan::SensitivityPlan;
use super::registers::{grow, read_numbers};
use super::request::Product;
use super::tangent::Tangent;
use crate::batch::dispatch::Task;
use crate::batch::motion::SolvedDesign;
use crate::batch::rows::RowSlices;
use crate::math::lanes::{Mask, Real};
use crate::plan::constants_rate::ConstantsRate;
use crate::state::kernel::BLOCK;
use crate::state::status::Status;

/// Positions whose equations are linearised at once: as many as are solved at once. Half or twice as many take
/// about as long.
const POSITIONS: usize = BLOCK;

/// Work space of a thread.
#[derive(Debug, Default)]
pub(crate) struct SensitivitySpace<R> {
    linear: Linearization<R>,
    tangent: Tangent<R>,
    cotangent: Cotangent<R>,
    /// Weights of a component of a result, and its values.
    weights: Vec<R>,
    values: Vec<R>,
    /// Derivatives of a register of positions by constants and by dimensions.
    rate: ConstantsRate<R>,
    by: Vec<R>,
    /// Their sums over positions.
    sums: ConstantsRate,
    totals: Vec<f64>,
}

/// The derivatives of one design at some positions.
pub(crate) struct Evaluate<'e, 'r, R: Real> {
    pub sensitivity: &'e SensitivityPlan<'e>,
    pub product: Product<'e>,
    pub solved: &'e SolvedDesign<'e, 'e>,
    /// Rates of the constants, for [`Product::Forward`].
    pub rates: Option<&'e ConstantsRate>,
    pub space: &'e mut SensitivitySpace<R>,
    pub results: &'e mut RowSlices<'r>,
    /// The first column of the product in the results, and there the row of the first position.
    pub column: usize,
    pub first: usize,
    /// What totals are divided by.
    pub divisor: f64,
    /// What is added to totals before: dimensions with derivatives by themselves.
    pub besides: &'e [(usize, f64)],
}

impl<R: Real> Task<R> for Evaluate<'_, '_, R> {
    #[inline(always)]
    fn run(&mut self) {
        let total = self.product.is_total();
        let count = self.solved.status.len();
        let mut worst = 0;
        if total {
            for &status in self.solved.status {
                worst = worst.max(status);
            }
            self.results.status[self.first] = MaybeUninit::new(worst);
        }
        if !self.solved.is_valid {
            let count = if total { 1 } else { count };
            if !total {
                self.set_status(0, count);
            }
            for (column, out) in self.results.columns[self.column..].iter_mut().enumerate() {
                let width = self.product.width(self.sensitivity.results[column].len());
                out[self.first * width..(self.first + count) * width]
                    .fill(MaybeUninit::new(f64::NAN));
            }
            return;
        }
        for row in (0..count).step_by(POSITIONS) {
            let rows = POSITIONS.min(count - row);
            if !total {
                self.set_status(row, rows);
            }
            let (design, columns) = (self.solved.design, self.solved.columns);
            let registers = rows.div_ceil(R::LANES);
            self.space.linear.read(self.sensitivity, design, columns, (row, registers));
            match self.product {
                Product::Jacobian { by } => self.jacobian(by, row, rows),
                Product::Forward { .. } => self.forward(row, rows),
                Product::Backward { weights, by, of_squares, .. } => {
                    self.backward((weights, of_squares), by, row, rows);
                }
            }
        }
        if let Product::Backward { by, total: true, .. } = self.product {
            self.write_totals(by, worst);
        }
    }
}

impl<R: Real> Evaluate<'_, '_, R> {
    #[inline(always)]
    fn jacobian(&mut self, by: &[usize], row: usize, rows: usize) {
        let (sensitivity, units) = (self.sensitivity, &self.solved.design.units);
        let registers = rows.div_ceil(R::LANES);
        for (column, components) in sensitivity.results.iter().enumerate() {
            let width = self.product.width(components.len());
            for (index, &component) in components.iter().enumerate() {
                let SensitivitySpace { linear, cotangent, weights, .. } = &mut *self.space;
                cotangent.begin(sensitivity, registers);
                cotangent.constants.begin(sensitivity, registers);
                grow(weights, registers);
                weights[..registers].fill(R::ONE);
                cotangent.add(sensitivity.len(), units, component, &weights[..registers]);
                cotangent.pull_back(sensitivity, linear);
                self.write_by((column, width, index * by.len()), by, row, rows);
            }
        }
    }

    #[inline(always)]
    fn forward(&mut self, row: usize, rows: usize) {
        let Some(rates) = self.rates else { return };
        let (sensitivity, units) = (self.sensitivity, &self.solved.design.units);
        for first in (0..rows).step_by(R::LANES) {
            let register = first / R::LANES;
            let SensitivitySpace { linear, tangent, .. } = &mut *self.space;
            tangent.solve(sensitivity, (linear, register), rates);
            for (column, components) in sensitivity.results.iter().enumerate() {
                for (index, &component) in components.iter().enumerate() {
                    let number =
                        self.space.tangent.component(sensitivity.len(), (units, rates), component);
                    let lanes = R::LANES.min(rows - first);
                    self.write((column, components.len(), index), row + first, lanes, number);
                }
            }
        }
    }

    #[inline(always)]
    fn backward(
        &mut self,
        (weights, of_squares): (&[&[f64]], bool),
        by: &[usize],
        row: usize,
        rows: usize,
    ) {
        let (sensitivity, units) = (self.sensitivity, &self.solved.design.units);
        let registers = rows.div_ceil(R::LANES);
        let total = self.product.is_total();
        self.space.cotangent.begin(sensitivity, registers);
        let constants = &mut self.space.cotangent.constants;
        if !total {
            constants.begin(sensitivity, registers);
        } else if row == 0 {
            constants.begin_total(sensitivity);
        }
        grow(&mut self.space.weights, registers);
        for (result, components) in sensitivity.results.iter().enumerate() {
            for (index, &component) in components.iter().enumerate() {
                let place = (result, components.len(), index);
                let is_any = self.weigh(weights[result], of_squares, place, row, rows);
                let SensitivitySpace { cotangent, weights, .. } = &mut *self.space;
                if is_any {
                    cotangent.add(sensitivity.len(), units, component, &weights[..registers]);
                }
            }
        }
        let SensitivitySpace { linear, cotangent, .. } = &mut *self.space;
        cotangent.pull_back(sensitivity, linear);
        if !total {
            self.write_by((0, by.len(), 0), by, row, rows);
        }
    }

    /// The weights of a component of a result at some positions; false if all are zero.
    #[inline(always)]
    fn weigh(
        &mut self,
        weights: &[f64],
        of_squares: bool,
        (result, width, index): (usize, usize, usize),
        row: usize,
        rows: usize,
    ) -> bool {
        let shared = weights.len() == width;
        if shared && weights[index] == 0.0 {
            return false;
        }
        let registers = rows.div_ceil(R::LANES);
        let SensitivitySpace { weights: numbers, values, .. } = &mut *self.space;
        let numbers = &mut numbers[..registers];
        if shared {
            numbers.fill(R::splat(weights[index]));
        } else {
            let first = self.solved.rows.start + row;
            for (g, number) in numbers.iter_mut().enumerate() {
                *number = R::from_lanes(|lane| {
                    let place = (g * R::LANES + lane).min(rows - 1);
                    weights[(first + place) * width + index]
                });
            }
        }
        if of_squares {
            grow(values, registers);
            let column = self.solved.columns[self.sensitivity.values[result]];
            read_numbers(&mut values[..registers], column, row, (width, index));
            for (number, &value) in numbers.iter_mut().zip(&*values) {
                *number = *number * value;
            }
        }
        if let (Some(last), true) = (numbers.last_mut(), self.product.is_total()) {
            // Lanes beyond the last position repeat it.
            let first = rows - rows % R::LANES;
            if first < rows {
                *last = *last * R::from_lanes(|lane| if first + lane < rows { 1.0 } else { 0.0 });
            }
        }
        true
    }

    /// Writes derivatives by the dimensions, whose entries begin at a place of a column's rows.
    #[inline(always)]
    fn write_by(
        &mut self,
        (column, width, place): (usize, usize, usize),
        by: &[usize],
        row: usize,
        rows: usize,
    ) {
        let (sensitivity, design) = (self.sensitivity, self.solved.design);
        let (plan, slots) = (sensitivity.plan(), &sensitivity.mechanism.slots);
        let dimensions = self.solved.dimensions;
        for first in (0..rows).step_by(R::LANES) {
            let SensitivitySpace { cotangent, rate, by: numbers, .. } = &mut *self.space;
            cotangent.constants.register(sensitivity, first / R::LANES, rate);
            grow(numbers, dimensions.len());
            rate.by_dimensions(plan, slots, &design.constants, dimensions, numbers);
            for (index, &dimension) in by.iter().enumerate() {
                let number = self.space.by[dimension];
                let lanes = R::LANES.min(rows - first);
                self.write((column, width, place + index), row + first, lanes, number);
            }
        }
    }

    /// Writes the sums over all positions.
    #[inline(always)]
    fn write_totals(&mut self, by: &[usize], worst: u8) {
        let (sensitivity, design) = (self.sensitivity, self.solved.design);
        let (plan, slots) = (sensitivity.plan(), &sensitivity.mechanism.slots);
        let dimensions = self.solved.dimensions;
        let exists = worst <= Status::NearSingular as u8;
        let SensitivitySpace { cotangent, sums, totals, .. } = &mut *self.space;
        grow(totals, dimensions.len());
        if !self.solved.status.is_empty() {
            cotangent.constants.sums(sensitivity, sums);
            sums.by_dimensions(plan, slots, &design.constants, dimensions, totals);
        }
        for &(dimension, derivative) in self.besides {
            totals[dimension] += derivative;
        }
        for (place, &dimension) in by.iter().enumerate() {
            let sum = totals[dimension];
            let value = if exists { sum / self.divisor } else { f64::NAN };
            self.results.columns[self.column][self.first * by.len() + place] =
                MaybeUninit::new(value);
            if exists && !sum.is_finite() {
                self.results.status[self.first] = MaybeUninit::new(Status::Singular as u8);
            }
        }
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
        let out = &mut self.results.columns[self.column + column];
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
