//! Derivatives of the terms of the equations of motion: the same formulas in dual numbers, one direction after
//! another at each position.

use std::borrow::Cow;
use std::mem::MaybeUninit;

use super::bodies::Partials;
use super::dual_row::{DualPlan, DualRow};
use super::equation_batch::EquationBatch;
use super::evaluate::Equation;
use super::plan::EquationPlan;
use super::request::{Direction, EquationRequest, Term};
use crate::batch::chunks::{Chunk, Chunks};
use crate::batch::dispatch::{self, Entry, ForLevel};
use crate::batch::request::{Arrays, Column, Quantity, Request, Shape, check_arrays, product};
use crate::batch::rows::RowSlices;
use crate::batch::schedule::Control;
use crate::description::error::SolveError;
use crate::dynamics::kinetostatics::positions::{DesignPositions, Positions, of_rows};
use crate::dynamics::machine::Machine;
use crate::dynamics::reactions::applied::Values;
use crate::dynamics::reactions::columns::Solved;
use crate::dynamics::reactions::lane_rows::Rows;
use crate::dynamics::reactions::scene::{Moving, Scene};
use crate::dynamics::value::Numbers;
use crate::dynamics::variation::Varied;
use crate::math::dual::Dual;
use crate::math::lanes::Real;
use crate::math::vector::Vector;
use crate::plan::constants_rate::ConstantsRate;
use crate::plan::mechanism::Mechanism;
use crate::sensitivity::plan::SensitivityPlan;
use crate::state::status::Status;

impl Machine {
    /// Derivatives of the request's terms in directions: for each term an array, numbers × directions; and the
    /// statuses. The plan is one [`for derivatives`](EquationPlan::for_derivatives). Values of callbacks
    /// have no derivatives: they count as constant. The motors' rotors count, except with [`Term::Effort`].
    ///
    /// # Errors
    ///
    /// Those of [`Machine::equations`]; redundant links where a direction is a dimension.
    pub fn equation_derivatives(
        &self,
        mechanism: &Mechanism,
        plan: &EquationPlan,
        request: &EquationRequest<'_>,
        by: &[Direction],
        arrays: Arrays<'_>,
        control: &Control<'_>,
    ) -> Result<(), SolveError> {
        let forces = &plan.forces;
        let n = forces.drivers;
        let solve_request = Request {
            dimensions: request.dimensions,
            coordinates: request.coordinates,
            signs: request.signs,
            order: plan.solved_order,
            outputs: &forces.outputs,
        };
        let shape = Shape::of(mechanism, &solve_request)?;
        let rows = product(shape.designs, shape.positions)?;
        let width = |term: &Term| term.width(n) * by.len();
        let column =
            |term: &Term| Column { quantity: Quantity::Joint(0), order: 0, width: width(term) };
        let results: Vec<Column> = request.terms.iter().map(column).collect();
        check_arrays(&results, &arrays, rows)?;
        let rest = vec![0.0; n];
        let mut equations = EquationBatch::new(
            (mechanism, self, plan),
            (&solve_request, &shape),
            request,
            &rest,
            control,
        );
        if request.terms.contains(&Term::Effort) {
            equations.has_rotors = false;
        }
        equations.positions.check()?;
        let fits = [request.effort, request.acceleration]
            .iter()
            .all(|values| equations.positions.covers(values, rows * n));
        let exists = by.iter().all(|direction| match *direction {
            Direction::Dimension(index) => index < mechanism.dimensions().len(),
            Direction::Coordinate(driver)
            | Direction::Speed(driver)
            | Direction::Acceleration(driver)
            | Direction::Effort(driver) => driver < n,
        });
        if !(fits && exists) {
            return Err(SolveError::Shape(
                "efforts, accelerations or directions do not fit".into(),
            ));
        }
        let has_dimensions = by.iter().any(|by| matches!(by, Direction::Dimension(_)));
        let columns = &plan.writer.columns;
        let sensitivity = if has_dimensions {
            SensitivityPlan::refuse_redundant(mechanism)?;
            let read: Vec<bool> = columns.iter().map(|c| c.order <= forces.order).collect();
            let results = read.iter().scan(0, |count, &read| {
                *count += usize::from(read);
                Some(read.then(|| *count - 1))
            });
            let results = results.collect();
            let of: Vec<(Quantity, usize)> = columns
                .iter()
                .zip(&read)
                .filter(|(_, read)| **read)
                .map(|(column, _)| (column.quantity, column.order))
                .collect();
            let mut sensitivity = SensitivityPlan::new(mechanism, &of);
            sensitivity.read_from(columns);
            Some((sensitivity, results))
        } else {
            None
        };
        let dual = DualPlan {
            mechanism,
            machine: self,
            forces,
            sources: &plan.sources,
            columns,
            sensitivity,
        };
        let batch = DerivativeBatch { equations, dual, by };
        let chunks = Chunks::new(arrays, &results, [shape.designs, shape.positions], n);
        dispatch::at_level(control.simd, Derive { batch: &batch, chunks })
    }
}

/// What all chunks share.
struct DerivativeBatch<'b> {
    equations: EquationBatch<'b>,
    dual: DualPlan<'b>,
    by: &'b [Direction],
}

struct Derive<'b, 'r> {
    batch: &'b DerivativeBatch<'b>,
    chunks: Chunks<'r>,
}

/// The working data of one thread.
struct ThreadState<'b, R: Real, const G: usize> {
    positions: Positions<'b, R, G>,
    space: Space,
}

/// Where one position is evaluated.
struct Space {
    scene: Scene<Dual>,
    equation: Equation<Dual>,
    row: DualRow,
    effort: Vec<f64>,
    acceleration: Vec<f64>,
}

impl<'b> ForLevel for Derive<'b, '_> {
    type Output = Result<(), SolveError>;

    fn run<L: Entry, const G: usize>(self) -> Self::Output {
        let batch = self.batch;
        let new_state = || ThreadState::<'b, L::Register, G> {
            positions: batch.equations.positions.thread(),
            space: Space {
                scene: Scene::new(
                    batch.equations.positions.plan,
                    batch.equations.positions.machine,
                ),
                equation: Equation::default(),
                row: DualRow::default(),
                effort: Vec::new(),
                acceleration: Vec::new(),
            },
        };
        let work =
            |state: &mut ThreadState<'b, L::Register, G>, chunk: &Chunk, rows: RowSlices<'_>| {
                batch.chunk::<L, G>(state, chunk, rows);
            };
        let control = batch.equations.positions.motion.control;
        control.run(self.chunks, new_state, work, |state| state.positions.finish())
    }
}

impl<'b> DerivativeBatch<'b> {
    fn chunk<L: Entry, const G: usize>(
        &self,
        state: &mut ThreadState<'b, L::Register, G>,
        chunk: &Chunk,
        mut results: RowSlices<'_>,
    ) {
        let ThreadState { positions, space } = state;
        let batch = &self.equations.positions;
        batch.solve::<L, G>(positions, chunk, false, |positions| {
            let rates: Vec<Option<ConstantsRate>> =
                self.by.iter().map(|&by| Self::constants_rate(&positions, by)).collect();
            let first = positions.index * positions.status.len();
            for (index, &status) in positions.status.iter().enumerate() {
                if batch.motion.control.is_cancelled() {
                    return;
                }
                let row = first + index;
                results.status[row] = MaybeUninit::new(status);
                if status > Status::NearSingular as u8 {
                    self.write_nan(&mut results, row);
                    continue;
                }
                self.dual.load(&mut space.row, &positions, index);
                for (place, (&direction, rates)) in self.by.iter().zip(&rates).enumerate() {
                    let rates = rates.as_ref();
                    self.dual.direct(&mut space.row, &positions, index, direction, rates);
                    self.evaluate(space, &positions, (index, direction), rates);
                    self.write(space, &mut results, (row, place));
                }
            }
        });
    }

    /// The rates of a design's constants in a direction that is a dimension.
    fn constants_rate(positions: &DesignPositions<'_>, by: Direction) -> Option<ConstantsRate> {
        let (Direction::Dimension(index), Some(design)) = (by, positions.design) else {
            return None;
        };
        let mut change = vec![0.0; positions.dimensions.len()];
        change[index] = 1.0;
        Some(design.rate(&change))
    }

    /// Evaluates the equations of one position in a direction.
    fn evaluate(
        &self,
        space: &mut Space,
        positions: &DesignPositions<'_>,
        (index, direction): (usize, Direction),
        rates: Option<&ConstantsRate>,
    ) {
        let batch = &self.equations.positions;
        let (plan, n) = (batch.plan, batch.plan.drivers);
        self.set_drive(space, positions, index, direction);
        let Space { scene, equation, row, effort, .. } = space;
        let columns: Vec<&[f64]> = row.columns.iter().map(Vec::as_slice).collect();
        let rest = vec![0.0; 2 * n];
        let solved =
            Solved { columns: &columns, speed: &row.speed, acceleration: &rest, positions: 1 };
        let rows = Rows { first: 0, last: 0 };
        scene.place_known(positions.known);
        if let (Some(rates), Some(design)) = (rates, positions.design) {
            for &(point, at) in positions.known {
                let rate = self.dual.fixed_rate(row, design, rates, point);
                let [x, y] = [Dual::new(at.x, rate.x), Dual::new(at.y, rate.y)];
                scene.points[point] = Moving { at: Vector::new(x, y), ..scene.points[point] };
            }
        }
        scene.read(plan, batch.sources, positions.guides, &solved, rows);
        if let Direction::Dimension(index) = direction {
            self.turn_guides(scene, positions.guides, index);
        }
        let external: Vec<f64> = {
            let callbacks = positions.values.callbacks;
            let values = &positions.values.external[index * callbacks..][..callbacks];
            values.iter().flat_map(|&value| [value, 0.0]).collect()
        };
        let values = Values {
            tables: &row.tables,
            over: &row.over,
            ways: &row.ways,
            external: &external,
            callbacks: positions.values.callbacks,
            varied: Varied { rows: &row.varied, ..positions.values.varied },
        };
        scene.apply(plan, batch.machine, values, rows);
        let drivers = plan.drivers;
        let partials = Partials { plan, sources: batch.sources, solved: &solved, rows, drivers };
        equation.read(&self.equations, scene, partials);
        if self.equations.request.terms.contains(&Term::Acceleration) {
            equation.accelerate(effort, rows);
        }
    }

    /// The directions of guides where an angle on a link is the dimension.
    fn turn_guides(&self, scene: &mut Scene<Dual>, guides: &[Vector], dimension: usize) {
        let mechanism = self.dual.mechanism;
        let mut change = vec![0.0; mechanism.dimensions().len()];
        change[dimension] = 1.0;
        for (slide, (&guide, slots)) in guides.iter().zip(&mechanism.slots.slides).enumerate() {
            let rate = guide.left().scale(slots.angle(&change));
            let guide = Vector::new(Dual::new(guide.x, rate.x), Dual::new(guide.y, rate.y));
            let carrier = self.dual.forces.slide_links[slide][1];
            scene.guides[slide] = if carrier == self.dual.forces.ground {
                guide
            } else {
                scene.directions[carrier] * guide
            };
        }
    }

    /// Sets efforts, with those of the motors, and accelerations.
    fn set_drive(
        &self,
        space: &mut Space,
        positions: &DesignPositions<'_>,
        index: usize,
        direction: Direction,
    ) {
        let (request, n) = (self.equations.request, self.dual.forces.drivers);
        let row = positions.rows.start + index;
        for (dual, values) in
            [(&mut space.effort, request.effort), (&mut space.acceleration, request.acceleration)]
        {
            dual.clear();
            let values = of_rows(values, n, &(row..row + 1));
            dual.extend(values.iter().flat_map(|&value| [value, 0.0]));
        }
        match direction {
            Direction::Effort(driver) => space.effort[2 * driver + 1] = 1.0,
            Direction::Acceleration(driver) => space.acceleration[2 * driver + 1] = 1.0,
            _ => {}
        }
        if !request.has_motors {
            return;
        }
        let pairs = |lists: &[Vec<f64>]| -> Vec<[f64; 2]> {
            lists.iter().map(|list| [list[0], list[1]]).collect()
        };
        let (tables, over) = (pairs(&space.row.tables), pairs(&space.row.over));
        let callbacks = positions.values.callbacks;
        let external: Vec<[f64; 2]> = positions.values.external[index * callbacks..][..callbacks]
            .iter()
            .map(|&value| [value, 0.0])
            .collect();
        let numbers =
            Numbers { tables: &tables, over: &over, external: &external, ..Numbers::default() };
        let mut motors = Cow::Borrowed(self.dual.machine.motors.as_slice());
        if positions.values.varied.has_motors() {
            positions.values.varied.set_motors(motors.to_mut(), index);
        }
        for motor in motors.iter() {
            let at = 2 * motor.driver;
            let (speed, rate) = (space.row.speed[at], space.row.speed[at + 1]);
            let [torque, slope] = motor.torque_and_slopes(speed, rate, numbers);
            space.effort[at] += torque;
            space.effort[at + 1] += slope;
        }
    }

    /// Writes the rates of all terms in a direction.
    fn write(&self, space: &Space, results: &mut RowSlices<'_>, (row, place): (usize, usize)) {
        let (n, count) = (self.dual.forces.drivers, self.by.len());
        let columns: Vec<&[f64]> = space.row.columns.iter().map(Vec::as_slice).collect();
        let solved = Solved { columns: &columns, speed: &[], acceleration: &[], positions: 1 };
        let (plan, sources) = (self.dual.forces, self.dual.sources);
        let partials = Partials {
            plan,
            sources,
            solved: &solved,
            rows: Rows { first: 0, last: 0 },
            drivers: n,
        };
        for (out, &term) in results.columns.iter_mut().zip(self.equations.request.terms) {
            let width = term.width(n);
            for entry in 0..width {
                let value = space.equation.entry(term, entry, partials, &space.acceleration);
                // What has no value has no derivative.
                let rate = if value.value.is_finite() { value.rate } else { f64::NAN };
                out[(row * width + entry) * count + place] = MaybeUninit::new(rate);
            }
        }
    }

    fn write_nan(&self, results: &mut RowSlices<'_>, row: usize) {
        let (n, count) = (self.dual.forces.drivers, self.by.len());
        for (out, term) in results.columns.iter_mut().zip(self.equations.request.terms) {
            let width = term.width(n) * count;
            out[row * width..(row + 1) * width].fill(MaybeUninit::new(f64::NAN));
        }
    }
}
