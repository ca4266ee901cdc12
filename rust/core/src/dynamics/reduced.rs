//! A machine referred to its drivers at one position.

use super::body::Body;
use super::kinematics::SolvedPose;
use crate::math::lanes::Real;
use crate::math::vector::Vector;

/// Inertia, forces and energy of a machine, referred to its drivers.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Reduced {
    /// The mass matrix, row by row; with one driver the reduced inertia.
    pub inertia: Vec<f64>,
    /// Its derivatives: one matrix per driver.
    pub d_inertia: Vec<f64>,
    /// Reduced moments (forces, for slides) of weights and springs.
    pub conservative: Vec<f64>,
    /// Reduced moments of all other loads.
    pub applied: Vec<f64>,
    /// Derivative of the first of these by the speed, for one driver.
    pub d_moment_d_speed: f64,
    /// Potential energy of weights and springs, J.
    pub potential: f64,
}

impl Reduced {
    /// Zero inertia and loads for a number of drivers.
    #[must_use]
    pub(crate) fn new(drivers: usize) -> Self {
        Self {
            inertia: vec![0.0; drivers * drivers],
            d_inertia: vec![0.0; drivers * drivers * drivers],
            conservative: vec![0.0; drivers],
            applied: vec![0.0; drivers],
            ..Self::default()
        }
    }

    /// Reduced moment of all loads on a driver.
    #[must_use]
    pub(crate) fn moment(&self, driver: usize) -> f64 {
        self.conservative[driver] + self.applied[driver]
    }

    /// Kinetic energy at these speeds, J.
    #[must_use]
    pub(crate) fn kinetic(&self, speed: &[f64]) -> f64 {
        let n = speed.len();
        let row = |a: usize| -> f64 { (0..n).map(|b| self.inertia[a * n + b] * speed[b]).sum() };
        0.5 * (0..n).map(|a| speed[a] * row(a)).sum::<f64>()
    }

    /// Velocity-dependent inertia moment on a driver: Σ (∂Mₐᵦ/∂γ − ½ ∂Mᵦᵧ/∂α) vᵦ vᵧ (the terms of
    /// Lagrange's equations without accelerations; for one driver ½ J′ v²).
    #[must_use]
    pub(crate) fn centrifugal(&self, driver: usize, speed: &[f64]) -> f64 {
        if let &[speed] = speed {
            return 0.5 * self.d_inertia[0] * speed * speed;
        }
        let n = speed.len();
        let rate = |c: usize, a: usize, b: usize| self.d_inertia[(c * n + a) * n + b];
        let mut sum = 0.0;
        for b in 0..n {
            for c in 0..n {
                let term = rate(c, driver, b) - 0.5 * rate(driver, b, c);
                sum += term * speed[b] * speed[c];
            }
        }
        sum
    }

    /// Sets inertia, weights and springs to zero.
    pub(crate) fn clear(&mut self) {
        self.inertia.fill(0.0);
        self.d_inertia.fill(0.0);
        self.conservative.fill(0.0);
        self.potential = 0.0;
    }

    /// Adds a body: Σ m ∂S·∂S + I ∂Θ ∂Θ (I. M. Matsyuk & E. M. Shlyakhov, equation 2), its
    /// derivatives from second analogues, and its weight.
    pub(crate) fn add_body(&mut self, pose: &SolvedPose<'_>, body: &Body, gravity: Vector) {
        let n = self.conservative.len();
        let product = |(p, u): (Vector, f64), (r, v): (Vector, f64)| {
            body.mass * p.dot(r) + body.inertia * u * v
        };
        if n == 1 {
            let terms = BodyTerms::of(pose, body, gravity);
            self.inertia[0] += terms.inertia;
            self.d_inertia[0] += terms.d_inertia;
            self.conservative[0] += terms.conservative;
            self.potential += terms.potential;
            return;
        }
        let weight = gravity.scale(body.mass);
        self.potential += -weight.dot(pose.point(body.at, 0));
        let first = |a: usize| {
            let k = SolvedPose::first_order(a);
            (pose.point(body.at, k), pose.angle(body.link, k))
        };
        let second = |a: usize, c: usize| {
            let k = pose.second_order(a, c);
            (pose.point(body.at, k), pose.angle(body.link, k))
        };
        for a in 0..n {
            self.conservative[a] += weight.dot(first(a).0);
            for b in 0..n {
                self.inertia[a * n + b] += product(first(a), first(b));
                for c in 0..n {
                    let rate = product(second(a, c), first(b)) + product(first(a), second(b, c));
                    self.d_inertia[(c * n + a) * n + b] += rate;
                }
            }
        }
    }
}

/// What a body adds to a machine with one driver; or in each lane.
pub(crate) struct BodyTerms<R> {
    pub inertia: R,
    pub d_inertia: R,
    pub conservative: R,
    pub potential: R,
}

impl<R: Real> BodyTerms<R> {
    /// See [`Reduced::add_body`].
    #[inline(always)]
    pub(crate) fn of(pose: &SolvedPose<'_, R>, body: &Body, gravity: Vector) -> Self {
        let [place, first, second] = pose.point_jet(body.at);
        let (rate, second_rate) = (pose.angle(body.link, 1), pose.angle(body.link, 2));
        let (mass, inertia) = (R::splat(body.mass), R::splat(body.inertia));
        let weight = Vector::splat(gravity.scale(body.mass));
        Self {
            inertia: mass * first.dot(first) + inertia * rate * rate,
            d_inertia: R::splat(2.0) * (mass * first.dot(second) + inertia * rate * second_rate),
            conservative: weight.dot(first),
            potential: -weight.dot(place),
        }
    }
}
