//! Derivatives of places and angles by the drivers at the positions of a register, and the mass matrix.

use crate::dynamics::body::Body;
use crate::dynamics::kinematics::Point;
use crate::dynamics::reactions::columns::{Solved, Sources};
use crate::dynamics::reactions::force_plan::ForcePlan;
use crate::dynamics::reactions::lane_rows::Rows;
use crate::dynamics::reactions::scene::Scene;
use crate::math::lanes::Real;
use crate::math::vector::Vector;
use crate::structure::closure::point_of_joint;

/// The solved positions of a register.
#[derive(Clone, Copy)]
pub(super) struct Partials<'p> {
    pub plan: &'p ForcePlan,
    pub sources: &'p Sources,
    pub solved: &'p Solved<'p>,
    pub rows: Rows,
    /// The number of drivers, which the compiler may know.
    pub drivers: usize,
}

impl Partials<'_> {
    /// Derivative of a point of the closure by driver `a`.
    #[inline(always)]
    pub(super) fn point<R: Real>(self, point: usize, a: usize) -> Vector<R> {
        match self.sources.points[point] {
            Some(column) => self.rows.pairs(self.solved.columns[column + 1], self.drivers, a),
            None => Vector::ZERO,
        }
    }

    /// Derivative of a link's angle by driver `a`.
    #[inline(always)]
    pub(super) fn angle<R: Real>(self, link: usize, a: usize) -> R {
        match (self.sources.rates[link], &self.plan.turns[link]) {
            (_, Some(turns)) => R::splat(turns[a]),
            (Some(column), None) => self.rows.solved(self.solved.columns[column], self.drivers, a),
            (None, None) => R::ZERO,
        }
    }

    /// Whether the drivers alone turn a link, so that its second derivatives vanish.
    #[inline(always)]
    pub(super) fn turns_by_drivers_alone(self, link: usize) -> bool {
        self.sources.rates[link].is_none() || self.plan.turns[link].is_some()
    }

    /// Direction of a link's x axis, which is solved.
    #[inline(always)]
    pub(super) fn direction<R: Real>(self, link: usize) -> Vector<R> {
        match self.sources.directions[link] {
            Some(column) => self.rows.pairs(self.solved.columns[column], 1, 0),
            None => Vector::ONE,
        }
    }

    /// Derivative of a point of the closure by drivers `a` and `b`.
    #[inline(always)]
    pub(super) fn second_point<R: Real>(self, point: usize, [a, b]: [usize; 2]) -> Vector<R> {
        let n = self.drivers;
        match self.sources.points[point] {
            Some(column) => self.rows.pairs(self.solved.columns[column + 2], n * n, a * n + b),
            None => Vector::ZERO,
        }
    }

    /// Derivative of a link's angle by drivers `a` and `b`.
    #[inline(always)]
    pub(super) fn second_angle<R: Real>(self, link: usize, [a, b]: [usize; 2]) -> R {
        let n = self.drivers;
        match (self.sources.rates[link], &self.plan.turns[link]) {
            (Some(column), None) => {
                self.rows.solved(self.solved.columns[column + 1], n * n, a * n + b)
            }
            _ => R::ZERO,
        }
    }

    /// The arm of a place on a link from the link's reference point; `None` for that point itself.
    #[inline(always)]
    fn arm<R: Real>(scene: &Scene<R>, link: usize, at: [f64; 2]) -> Option<Vector<R>> {
        let [x, y] = at;
        if x == 0.0 && y == 0.0 {
            return None;
        }
        Some(scene.directions[link] * Vector::splat(Vector::new(x, y)))
    }

    /// Derivative of a place by driver `a`: `∂S = ∂S_ref + i r ∂Θ`.
    #[inline(always)]
    pub(super) fn place<R: Real>(self, scene: &Scene<R>, place: Point, a: usize) -> Vector<R> {
        match place {
            Point::Joint(joint) => self.point(point_of_joint(joint), a),
            Point::Link { link, .. } if link == self.plan.ground => Vector::ZERO,
            Point::Link { link, at } => {
                let reference = self.point(self.plan.reference[link], a);
                match Self::arm(scene, link, at) {
                    Some(arm) => reference + arm.left().scale(self.angle(link, a)),
                    None => reference,
                }
            }
        }
    }

    /// Derivative of a place by two drivers: `∂∂S = ∂∂S_ref + i r ∂∂Θ − r ∂Θ ∂Θ`.
    #[inline(always)]
    fn second_place<R: Real>(
        self,
        scene: &Scene<R>,
        place: Point,
        [a, b]: [usize; 2],
    ) -> Vector<R> {
        match place {
            Point::Joint(joint) => self.second_point(point_of_joint(joint), [a, b]),
            Point::Link { link, .. } if link == self.plan.ground => Vector::ZERO,
            Point::Link { link, at } => {
                let reference = self.second_point(self.plan.reference[link], [a, b]);
                match Self::arm(scene, link, at) {
                    Some(arm) => {
                        let turning = self.angle::<R>(link, a) * self.angle::<R>(link, b);
                        reference + arm.left().scale(self.second_angle(link, [a, b]))
                            - arm.scale(turning)
                    }
                    None => reference,
                }
            }
        }
    }

    /// Adds a body of this mass and inertia to the mass matrix, the lower half of which is kept, row by row.
    #[inline(always)]
    pub(super) fn add_mass<R: Real>(
        self,
        scene: &Scene<R>,
        body: &Body,
        [m, inertia]: [R; 2],
        mass: &mut [R],
    ) {
        let n = self.drivers;
        for a in 0..n {
            let (first, turning) = (self.place(scene, body.at, a), self.turning::<R>(body, a));
            for b in 0..=a {
                let (second, turned) = if a == b {
                    (first, turning)
                } else {
                    (self.place(scene, body.at, b), self.turning(body, b))
                };
                mass[a * n + b] += m * first.dot(second) + inertia * (turning * turned);
            }
        }
    }

    /// Adds a body of this mass and inertia to the derivatives of the mass matrix, n × n × n with the coordinate's axis last.
    #[inline(always)]
    pub(super) fn add_mass_rates<R: Real>(
        self,
        scene: &Scene<R>,
        body: &Body,
        [m, inertia]: [R; 2],
        rates: &mut [R],
    ) {
        let n = self.drivers;
        for a in 0..n {
            let (place_a, angle_a) = (self.place(scene, body.at, a), self.turning::<R>(body, a));
            for b in 0..n {
                let (place_b, angle_b) =
                    (self.place(scene, body.at, b), self.turning::<R>(body, b));
                for c in 0..n {
                    let place = self.second_place(scene, body.at, [a, c]).dot(place_b)
                        + place_a.dot(self.second_place(scene, body.at, [b, c]));
                    let angle = self.second_turning::<R>(body, [a, c]) * angle_b
                        + angle_a * self.second_turning::<R>(body, [b, c]);
                    rates[(a * n + b) * n + c] += m * place + inertia * angle;
                }
            }
        }
    }

    /// Derivative of a body's angle; zero where no machine's has inertia, and the ground.
    #[inline(always)]
    fn turning<R: Real>(self, body: &Body, a: usize) -> R {
        if body.inertia == 0.0 { R::ZERO } else { self.angle(body.link, a) }
    }

    #[inline(always)]
    fn second_turning<R: Real>(self, body: &Body, drivers: [usize; 2]) -> R {
        if body.inertia == 0.0 { R::ZERO } else { self.second_angle(body.link, drivers) }
    }
}
