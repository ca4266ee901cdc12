//! Mass matrix and bias at one stage of a step, body after body from the derivatives of its place and angle:
//! fewer operations than by the inertia forces on links, which the terms of the equations share.

use super::bodies::Partials;
use super::equation_batch::EquationBatch;
use crate::dynamics::body::Body;
use crate::dynamics::kinematics::Point;
use crate::dynamics::reactions::lane_numbers::LaneNumbers;
use crate::math::lanes::Real;
use crate::math::vector::Vector;
use crate::structure::closure::point_of_joint;

/// Work space: what all bodies read, and the derivatives of one.
#[derive(Debug, Clone, Default)]
pub(super) struct Direct<R> {
    /// Speeds of the drivers.
    speeds: Vec<R>,
    /// Their products, row by row of the lower half, those beside the diagonal doubled.
    products: Vec<R>,
    /// Derivatives of the place of a body by the drivers.
    places: Vec<Vector<R>>,
}

impl<R: Real> Direct<R> {
    /// Computes mass matrix and bias without loads, `sums`; `speed`: those of the drivers.
    #[inline(always)]
    pub(super) fn read_bodies(
        &mut self,
        batch: &EquationBatch<'_>,
        numbers: &LaneNumbers<R>,
        partials: Partials<'_>,
        speed: &[f64],
        sums: [&mut Vec<R>; 2],
    ) {
        // The compiler unrolls loops over a number of drivers that it knows.
        match partials.drivers {
            1 => self.sum_bodies(batch, numbers, Partials { drivers: 1, ..partials }, speed, sums),
            2 => self.sum_bodies(batch, numbers, Partials { drivers: 2, ..partials }, speed, sums),
            _ => self.sum_bodies(batch, numbers, partials, speed, sums),
        }
    }

    #[inline(always)]
    fn sum_bodies(
        &mut self,
        batch: &EquationBatch<'_>,
        numbers: &LaneNumbers<R>,
        partials: Partials<'_>,
        speed: &[f64],
        [mass, bias]: [&mut Vec<R>; 2],
    ) {
        let n = partials.drivers;
        let direct = self;
        direct.speeds.resize(n, R::ZERO);
        direct.products.resize(n * (n + 1) / 2, R::ZERO);
        direct.places.resize(n, Vector::ZERO);
        let mut entry = 0;
        for a in 0..n {
            direct.speeds[a] = partials.rows.read_drive(speed, n, a);
            for b in 0..=a {
                let product = direct.speeds[a] * direct.speeds[b];
                direct.products[entry] = if a == b { product } else { product + product };
                entry += 1;
            }
        }
        mass.resize(n * n, R::ZERO);
        mass.fill(R::ZERO);
        bias.resize(n, R::ZERO);
        bias.fill(R::ZERO);
        let (mass, bias) = (&mut mass[..n * n], &mut bias[..n]);
        let machine = batch.positions.machine;
        if batch.has_rotors {
            for (motor, &[ratio, rotor]) in machine.motors.iter().zip(&numbers.motors) {
                mass[motor.driver * n + motor.driver] += ratio * ratio * rotor;
            }
        }
        let gravity = Vector::splat(Vector::new(machine.gravity[0], machine.gravity[1]));
        // Where numbers vary the machine has the greatest: zero there is zero everywhere.
        for (body, &[m, inertia]) in machine.bodies.iter().zip(&numbers.bodies) {
            if body.mass != 0.0 {
                direct.add_mass(partials, (body, m, gravity), mass, bias);
            }
            if body.inertia != 0.0 {
                direct.add_inertia(partials, (body, inertia), mass, bias);
            }
        }
    }
}

impl<R: Real> Direct<R> {
    /// Adds the mass of a body: `M_ab = m S_a·S_b`, `b_a = m S_a·(S_bc q̇_b q̇_c − g)`.
    #[inline(always)]
    fn add_mass(
        &mut self,
        partials: Partials<'_>,
        (body, m, gravity): (&Body, R, Vector<R>),
        mass: &mut [R],
        bias: &mut [R],
    ) {
        let n = partials.drivers;
        let Self { speeds, products, places } = self;
        let (places, speeds) = (&mut places[..n], &speeds[..n]);
        let (reference, beyond) = match body.at {
            Point::Joint(joint) => (point_of_joint(joint), None),
            Point::Link { link, .. } if link == partials.plan.ground => return,
            Point::Link { link, at } => {
                (partials.plan.reference[link], (at != [0.0; 2]).then_some((link, at)))
            }
        };
        let mut acceleration = -gravity;
        places.fill(Vector::ZERO);
        if partials.sources.points[reference].is_some() {
            let mut products = products.iter();
            for a in 0..n {
                places[a] = partials.point(reference, a);
                for (b, &product) in (0..=a).zip(&mut products) {
                    let second = partials.second_point(reference, [a, b]);
                    acceleration += second.scale(product);
                }
            }
        }
        if let Some((link, at)) = beyond {
            let arm = partials.direction::<R>(link) * Vector::splat(Vector::new(at[0], at[1]));
            let (turning, mut turn) = (arm.left(), R::ZERO);
            for a in 0..n {
                let rate = partials.angle(link, a);
                places[a] += turning.scale(rate);
                turn += rate * speeds[a];
            }
            acceleration = acceleration + turning.scale(turn_rate(products, partials, link))
                - arm.scale(turn * turn);
        }
        for a in 0..n {
            let impulse = places[a].scale(m);
            bias[a] += impulse.dot(acceleration);
            for b in 0..=a {
                mass[a * n + b] += impulse.dot(places[b]);
            }
        }
    }

    /// Adds the moment of inertia of a body: `M_ab = J Θ_a Θ_b`, `b_a = J Θ_a Θ_bc q̇_b q̇_c`.
    #[inline(always)]
    fn add_inertia(
        &self,
        partials: Partials<'_>,
        (body, inertia): (&Body, R),
        mass: &mut [R],
        bias: &mut [R],
    ) {
        let n = partials.drivers;
        let couple = inertia * turn_rate(&self.products, partials, body.link);
        for a in 0..n {
            let rate: R = partials.angle(body.link, a);
            bias[a] += rate * couple;
            for b in 0..=a {
                mass[a * n + b] += inertia * (rate * partials.angle::<R>(body.link, b));
            }
        }
    }
}

/// The angular acceleration of a link where the speeds of the drivers, of these products, are constant.
#[inline(always)]
fn turn_rate<R: Real>(products: &[R], partials: Partials<'_>, link: usize) -> R {
    let mut sum = R::ZERO;
    if partials.turns_by_drivers_alone(link) {
        return sum;
    }
    let mut products = products.iter();
    for a in 0..partials.drivers {
        for (b, &product) in (0..=a).zip(&mut products) {
            sum += partials.second_angle::<R>(link, [a, b]) * product;
        }
    }
    sum
}
