//! Mass matrix and bias where accelerations alone are asked for, body after body from the derivatives of its place
//! and angle: fewer operations than by the inertia forces on links, which the terms of the equations share.

use super::bodies::Partials;
use super::equation_batch::EquationBatch;
use crate::dynamics::body::Body;
use crate::dynamics::kinematics::Point;
use crate::dynamics::reactions::lane_numbers::LaneNumbers;
use crate::math::lanes::Real;
use crate::math::vector::Vector;
use crate::structure::closure::point_of_joint;

/// Work space of any number of drivers.
#[derive(Debug, Clone, Default)]
pub(super) struct Direct<R> {
    speeds: Vec<R>,
    products: Vec<R>,
    places: Vec<Vector<R>>,
}

/// What all bodies read, the derivatives of one, and the sums.
struct Sums<'s, R> {
    /// Speeds of the drivers.
    speeds: &'s mut [R],
    /// Their products, row by row of the lower half, those beside the diagonal doubled.
    products: &'s mut [R],
    /// Derivatives of the place of a body by the drivers.
    places: &'s mut [Vector<R>],
    mass: &'s mut [R],
    bias: &'s mut [R],
}

impl<R: Real> Direct<R> {
    /// Computes mass matrix and bias without loads.
    #[inline(always)]
    pub(super) fn read_bodies(
        &mut self,
        batch: &EquationBatch<'_>,
        numbers: &LaneNumbers<R>,
        partials: Partials<'_>,
        [mass, bias]: [&mut Vec<R>; 2],
    ) {
        let n = partials.drivers;
        mass.resize(n * n, R::ZERO);
        bias.resize(n, R::ZERO);
        let (mass, bias) = (&mut mass[..], &mut bias[..]);
        match n {
            1 => sum_few::<R, 1, 1, 1>(batch, numbers, partials, [mass, bias]),
            2 => sum_few::<R, 2, 3, 4>(batch, numbers, partials, [mass, bias]),
            _ => {
                let Self { speeds, products, places } = self;
                speeds.resize(n, R::ZERO);
                products.resize(n * (n + 1) / 2, R::ZERO);
                places.resize(n, Vector::ZERO);
                let mut sums = Sums { speeds, products, places, mass, bias };
                sums.add_bodies(batch, numbers, partials);
            }
        }
    }
}

/// The same of a number of drivers for which the compiler unrolls all loops, and keeps the sums in registers.
#[inline(always)]
fn sum_few<R: Real, const N: usize, const PRODUCTS: usize, const ENTRIES: usize>(
    batch: &EquationBatch<'_>,
    numbers: &LaneNumbers<R>,
    partials: Partials<'_>,
    [mass, bias]: [&mut [R]; 2],
) {
    let (mut speeds, mut products) = ([R::ZERO; N], [R::ZERO; PRODUCTS]);
    let (mut places, mut entries, mut forces) =
        ([Vector::ZERO; N], [R::ZERO; ENTRIES], [R::ZERO; N]);
    let mut sums = Sums {
        speeds: &mut speeds,
        products: &mut products,
        places: &mut places,
        mass: &mut entries,
        bias: &mut forces,
    };
    sums.add_bodies(batch, numbers, Partials { drivers: N, ..partials });
    mass.copy_from_slice(&entries);
    bias.copy_from_slice(&forces);
}

impl<R: Real> Sums<'_, R> {
    /// Adds rotors and bodies.
    #[inline(always)]
    fn add_bodies(
        &mut self,
        batch: &EquationBatch<'_>,
        numbers: &LaneNumbers<R>,
        partials: Partials<'_>,
    ) {
        let n = partials.drivers;
        let mut entry = 0;
        for a in 0..n {
            self.speeds[a] = partials.rows.read_drive(partials.solved.speed, n, a);
            for b in 0..=a {
                let product = self.speeds[a] * self.speeds[b];
                self.products[entry] = if a == b { product } else { product + product };
                entry += 1;
            }
        }
        self.mass.fill(R::ZERO);
        self.bias.fill(R::ZERO);
        let machine = batch.positions.machine;
        if batch.has_rotors {
            for a in 0..n {
                for (motor, &[ratio, rotor]) in machine.motors.iter().zip(&numbers.motors) {
                    if motor.driver == a {
                        self.mass[a * n + a] += ratio * ratio * rotor;
                    }
                }
            }
        }
        let gravity = Vector::splat(Vector::new(machine.gravity[0], machine.gravity[1]));
        // Where numbers vary the machine has the greatest: zero there is zero everywhere.
        for (body, &[m, inertia]) in machine.bodies.iter().zip(&numbers.bodies) {
            if body.mass != 0.0 {
                self.add_mass(partials, (body, m, gravity));
            }
            if body.inertia != 0.0 {
                self.add_inertia(partials, (body, inertia));
            }
        }
    }

    /// Adds the mass of a body: `M_ab = m S_a·S_b`, `b_a = m S_a·(S_bc q̇_b q̇_c − g)`.
    #[inline(always)]
    fn add_mass(&mut self, partials: Partials<'_>, (body, m, gravity): (&Body, R, Vector<R>)) {
        let n = partials.drivers;
        let Self { speeds, products, places, mass, bias } = self;
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
    fn add_inertia(&mut self, partials: Partials<'_>, (body, inertia): (&Body, R)) {
        let n = partials.drivers;
        let Self { products, mass, bias, .. } = self;
        let couple = inertia * turn_rate(products, partials, body.link);
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
