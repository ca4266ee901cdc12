//! The equations of motion of one design at some positions, a register of these at a time.

use std::mem::MaybeUninit;

use super::bodies::Partials;
use super::direct::Direct;
use super::equation_batch::EquationBatch;
use super::request::Term;
use super::solve::solve_positive;
use crate::batch::dispatch::Task;
use crate::batch::rows::{RowSlices, store_lanes, store_pairs};
use crate::dynamics::kinetostatics::positions::{DesignPositions, MachineBatch};
use crate::dynamics::reactions::lane_rows::Rows;
use crate::dynamics::reactions::scene::Scene;
use crate::math::lanes::Real;
use crate::math::vector::Vector;
use crate::state::status::Status;
use crate::structure::closure::point_of_joint;

/// The numbers of the positions in a register.
#[derive(Debug, Clone, Default)]
pub(super) struct Equation<R> {
    /// Lower half of the mass matrix, row by row.
    pub(super) mass: Vec<R>,
    rates: Vec<R>,
    pub(super) bias: Vec<R>,
    gravity: Vec<R>,
    /// Matrix and right side while accelerations are solved for.
    factor: Vec<R>,
    right: Vec<R>,
    pub(super) direct: Direct<R>,
}

/// The equations of one design at some positions.
pub(super) struct Evaluate<'e, 'r, R: Real> {
    pub batch: &'e EquationBatch<'e>,
    pub design: DesignPositions<'e>,
    pub scene: &'e mut Scene<R>,
    pub equation: &'e mut Equation<R>,
    /// Efforts and accelerations of the request at these positions, drivers fastest, or one for all.
    pub effort: &'e [f64],
    pub acceleration: &'e [f64],
    pub results: &'e mut RowSlices<'r>,
    /// Row of the first position in the results.
    pub first: usize,
}

impl<R: Real> Task<R> for Evaluate<'_, '_, R> {
    #[inline(always)]
    fn run(&mut self) {
        let MachineBatch { plan, machine, sources, .. } = &self.batch.positions;
        let count = self.design.solved.positions;
        self.scene.place_known(self.design.known);
        for first in (0..count).step_by(R::LANES) {
            let rows = Rows { first, last: count - 1 };
            let solved = &{ self.design.solved };
            let partials = Partials { plan, sources, solved, rows, drivers: plan.drivers };
            if self.batch.request.terms == [Term::Acceleration] {
                self.equation.read_directly(self.batch, self.scene, partials, &self.design);
            } else {
                self.scene.read(plan, sources, self.design.guides, solved, rows);
                self.scene.apply(plan, machine, self.design.values, rows);
                self.equation.read(self.batch, self.scene, partials);
            }
            self.write(partials, first, R::LANES.min(count - first));
        }
        for (row, &status) in self.design.status.iter().enumerate() {
            let mut status = status;
            // At a change point the numbers are those of the motion through it.
            if status == Status::Singular as u8 && self.is_finite(self.first + row) {
                status = Status::NearSingular as u8;
            }
            self.results.status[self.first + row] = MaybeUninit::new(status);
            if status > Status::NearSingular as u8 {
                self.write_nan(self.first + row);
            }
        }
    }
}

impl<R: Real> Equation<R> {
    /// Computes what the requested terms need.
    #[inline(always)]
    pub(super) fn read(
        &mut self,
        batch: &EquationBatch<'_>,
        scene: &Scene<R>,
        partials: Partials<'_>,
    ) {
        let MachineBatch { plan, machine, .. } = &batch.positions;
        let (n, terms) = (plan.drivers, batch.request.terms);
        let needs = |wanted: &[Term]| terms.iter().any(|term| wanted.contains(term));
        if needs(&[Term::MassMatrix, Term::Effort, Term::Acceleration]) {
            self.mass.clear();
            self.mass.resize(n * n, R::ZERO);
            if batch.has_rotors {
                for (motor, &[ratio, rotor]) in machine.motors.iter().zip(&scene.numbers.motors) {
                    self.mass[motor.driver * n + motor.driver] += ratio * ratio * rotor;
                }
            }
            for (body, &numbers) in machine.bodies.iter().zip(&scene.numbers.bodies) {
                partials.add_mass(scene, body, numbers, &mut self.mass);
            }
        }
        if needs(&[Term::MassRates]) {
            self.rates.clear();
            self.rates.resize(n * n * n, R::ZERO);
            for (body, &numbers) in machine.bodies.iter().zip(&scene.numbers.bodies) {
                partials.add_mass_rates(scene, body, numbers, &mut self.rates);
            }
        }
        if needs(&[Term::Bias, Term::Effort, Term::Acceleration]) {
            self.bias.clear();
            for a in 0..n {
                self.bias.push(-power(scene, partials, a));
            }
        }
        if needs(&[Term::Gravity]) {
            self.gravity.clear();
            let gravity = Vector::splat(Vector::new(machine.gravity[0], machine.gravity[1]));
            for a in 0..n {
                let mut power = R::ZERO;
                for (body, &[mass, _]) in machine.bodies.iter().zip(&scene.numbers.bodies) {
                    let rate = partials.place(scene, body.at, a);
                    power += mass * gravity.dot(rate);
                }
                self.gravity.push(-power);
            }
        }
    }

    /// Computes mass matrix and bias alone, body after body.
    #[inline(always)]
    pub(super) fn read_directly(
        &mut self,
        batch: &EquationBatch<'_>,
        scene: &mut Scene<R>,
        partials: Partials<'_>,
        design: &DesignPositions<'_>,
    ) {
        let Self { direct, mass, bias, .. } = self;
        let (MachineBatch { plan, machine, .. }, rows) = (&batch.positions, partials.rows);
        scene.numbers.read(machine, design.values.varied, rows);
        direct.read_bodies(batch, &scene.numbers, partials, [mass, bias]);
        if !plan.load_actions.is_empty() {
            scene.read(plan, partials.sources, design.guides, partials.solved, rows);
            scene.clear_forces();
            scene.apply_loads(plan, machine, design.values, rows);
            for (a, bias) in bias.iter_mut().enumerate() {
                *bias = *bias - power(scene, partials, a);
            }
        }
    }

    /// Solves for the accelerations under efforts.
    #[inline(always)]
    pub(super) fn accelerate(&mut self, effort: &[f64], rows: Rows) {
        let n = self.bias.len();
        self.right.clear();
        for driver in 0..n {
            self.right.push(rows.read_drive::<R>(effort, n, driver) - self.bias[driver]);
        }
        self.factor.clear();
        self.factor.extend_from_slice(&self.mass);
        solve_positive(&mut self.factor, &mut self.right);
    }

    /// The acceleration of a driver, after [`Self::accelerate`].
    #[inline(always)]
    pub(super) fn solution(&self, driver: usize) -> R {
        self.right[driver]
    }

    /// The diagonal entry of the mass matrix of a driver, after [`Self::read_directly`].
    #[inline(always)]
    pub(super) fn inertia(&self, driver: usize) -> R {
        self.mass[driver * self.bias.len() + driver]
    }

    /// Number `entry` of a term, after [`Self::read`] and, for accelerations, [`Self::accelerate`].
    #[inline(always)]
    pub(super) fn entry(
        &self,
        term: Term,
        entry: usize,
        partials: Partials<'_>,
        acceleration: &[f64],
    ) -> R {
        let n = partials.plan.drivers;
        match term {
            Term::MassMatrix => {
                let (a, b) = (entry / n, entry % n);
                self.mass[a.max(b) * n + a.min(b)]
            }
            Term::MassRates => self.rates[entry],
            Term::Bias => self.bias[entry],
            Term::Gravity => self.gravity[entry],
            Term::Effort => self.effort(entry, acceleration, partials.rows),
            Term::Acceleration => self.right[entry],
            Term::Jacobian(joint) => {
                let rate: Vector<R> = partials.point(point_of_joint(joint), entry % n);
                if entry < n { rate.x } else { rate.y }
            }
        }
    }

    /// The effort of a driver that accelerations need.
    #[inline(always)]
    fn effort(&self, a: usize, acceleration: &[f64], rows: Rows) -> R {
        let n = self.bias.len();
        let mut sum = self.bias[a];
        for b in 0..n {
            let entry = self.mass[a.max(b) * n + a.min(b)];
            sum += entry * rows.read_drive::<R>(acceleration, n, b);
        }
        sum
    }
}

impl<R: Real> Evaluate<'_, '_, R> {
    #[inline(always)]
    fn write(&mut self, partials: Partials<'_>, first: usize, lanes: usize) {
        let (n, rows) = (partials.plan.drivers, partials.rows);
        for (column, &term) in self.batch.request.terms.iter().enumerate() {
            let row = self.first + first;
            let width = term.width(n);
            if term == Term::Acceleration {
                self.equation.accelerate(self.effort, rows);
            }
            let out = &mut self.results.columns[column][row * width..(row + lanes) * width];
            if width == 2 && lanes == R::LANES {
                let x = self.equation.entry(term, 0, partials, self.acceleration);
                let y = self.equation.entry(term, 1, partials, self.acceleration);
                store_pairs(out, false, Vector::new(x, y));
                continue;
            }
            for entry in 0..width {
                let value = self.equation.entry(term, entry, partials, self.acceleration);
                store_lanes(out, width, entry, value);
            }
        }
    }

    /// Whether all numbers of a row are finite.
    fn is_finite(&self, row: usize) -> bool {
        let n = self.batch.positions.plan.drivers;
        let terms = self.batch.request.terms.iter().zip(&self.results.columns);
        terms.into_iter().all(|(term, column)| {
            let width = term.width(n);
            #[allow(unsafe_code, reason = "the standard library has no safe form of this yet")]
            // SAFETY: `write` has stored the numbers of all positions.
            let numbers = unsafe { column[row * width..(row + 1) * width].assume_init_ref() };
            numbers.iter().all(|number| number.is_finite())
        })
    }

    fn write_nan(&mut self, row: usize) {
        let n = self.batch.positions.plan.drivers;
        for (term, column) in self.batch.request.terms.iter().zip(&mut self.results.columns) {
            let width = term.width(n);
            column[row * width..(row + 1) * width].fill(MaybeUninit::new(f64::NAN));
        }
    }
}

/// The power of the forces on all links at a unit speed of driver `a`.
#[inline(always)]
fn power<R: Real>(scene: &Scene<R>, partials: Partials<'_>, a: usize) -> R {
    let plan = partials.plan;
    let mut power = R::ZERO;
    for link in 0..plan.reference.len() {
        if link != plan.ground {
            let rate: Vector<R> = partials.point(plan.reference[link], a);
            power += scene.link_force[link].dot(rate)
                + scene.link_moment[link] * partials.angle(link, a);
        }
    }
    power
}
