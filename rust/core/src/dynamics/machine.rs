//! Bodies and loads of a mechanism, referred to its drivers.

use std::sync::atomic::{AtomicBool, Ordering};

use super::load::Load;
use super::pose::{Point, Pose};
use crate::mechanism::Mechanism;
use crate::motion::Status;
use crate::motion::follow::Follower;
use crate::plan::jet::Jets;
use crate::plane::Vector;

/// Mass of a link.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Body {
    /// The link.
    pub link: usize,
    /// Its centre of mass.
    pub at: Point,
    /// Mass, kg.
    pub mass: f64,
    /// Moment of inertia about that centre, kg·m².
    pub inertia: f64,
}

/// What a mechanism carries and what acts on it.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Machine {
    /// Its bodies.
    pub bodies: Vec<Body>,
    /// Its loads.
    pub loads: Vec<Load>,
    /// Acceleration of free fall, m/s².
    pub gravity: [f64; 2],
    /// Inertia that turns (or moves) with the first driver: a motor's rotor by the square of its
    /// ratio, kg·m² (kg).
    pub rotor: f64,
}

/// A machine referred to its drivers at one position.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Reduced {
    /// The mass matrix, row after row: of one driver the reduced inertia.
    pub inertia: Vec<f64>,
    /// Its derivatives: by every driver one matrix.
    pub rates: Vec<f64>,
    /// Reduced forces and moments of all loads.
    pub moment: Vec<f64>,
    /// Potential energy of weights and springs, J.
    pub potential: f64,
}

impl Machine {
    /// Refers to the drivers at positions (`q`, `speed`: drivers fastest; `given`: the numbers from
    /// outside of every position, as many each). Ends early once `cancel` is true.
    #[must_use]
    pub fn reduce(
        &self,
        mechanism: &Mechanism,
        dimensions: &[f64],
        q: &[f64],
        speed: &[f64],
        given: &[f64],
        cancel: &AtomicBool,
    ) -> Vec<Result<Reduced, Status>> {
        let drivers = mechanism.q0().len();
        let jets = Jets::new(drivers, 2);
        let mut follower = Follower::new(mechanism, dimensions, mechanism.signs(), &jets, q);
        let each = given.len().checked_div(q.len() / drivers).unwrap_or(0);
        let rows = q.chunks_exact(drivers).zip(speed.chunks_exact(drivers)).enumerate();
        let one = |(row, (q, speed))| {
            let position = follower.solve(q)?;
            let given = &given[row * each..(row + 1) * each];
            Ok(self.at(&Pose::new(position, &jets), q, speed, given))
        };
        rows.take_while(|_| !cancel.load(Ordering::Relaxed)).map(one).collect()
    }

    /// Refers to the drivers at a position.
    pub(super) fn at(&self, pose: &Pose<'_>, q: &[f64], speed: &[f64], given: &[f64]) -> Reduced {
        let n = q.len();
        let mut reduced = Reduced {
            inertia: vec![0.0; n * n],
            rates: vec![0.0; n * n * n],
            moment: vec![0.0; n],
            potential: 0.0,
        };
        reduced.inertia[0] = self.rotor;
        for body in &self.bodies {
            reduced.add(pose, body);
        }
        let gravity = Vector::new(self.gravity[0], self.gravity[1]);
        for body in &self.bodies {
            let weight = gravity.scale(body.mass);
            for (driver, sum) in reduced.moment.iter_mut().enumerate() {
                *sum += weight.dot(pose.point(body.at, Pose::first(driver)));
            }
            reduced.potential += -weight.dot(pose.point(body.at, 0));
        }
        for load in &self.loads {
            load.add(pose, q[0], speed, given, &mut reduced.moment);
            reduced.potential += load.energy(pose);
        }
        reduced
    }
}

impl Reduced {
    /// Adds a body: Σ m ∂S·∂S + I ∂Θ ∂Θ (I. M. Matsyuk & E. M. Shlyakhov, equation 2), and its
    /// derivatives from second analogues.
    fn add(&mut self, pose: &Pose<'_>, body: &Body) {
        let n = self.moment.len();
        let first = |a: usize| {
            let k = Pose::first(a);
            (pose.point(body.at, k), pose.angle(body.link, k))
        };
        let second = |a: usize, c: usize| {
            let k = pose.second(a, c);
            (pose.point(body.at, k), pose.angle(body.link, k))
        };
        let product = |(p, u): (Vector, f64), (r, v): (Vector, f64)| {
            body.mass * p.dot(r) + body.inertia * u * v
        };
        for a in 0..n {
            for b in 0..n {
                self.inertia[a * n + b] += product(first(a), first(b));
                for c in 0..n {
                    let rate = product(second(a, c), first(b)) + product(first(a), second(b, c));
                    self.rates[(c * n + a) * n + b] += rate;
                }
            }
        }
    }
}
