//! The kinematics that forces and masses need: positions of points, angles of links, and their
//! derivatives by the drivers, in metres and radians.

use crate::math::derivatives::DerivativeTables;
use crate::math::lanes::Real;
use crate::math::vector::Vector;
use crate::query::evaluator::Position;
use crate::structure::closure::point_of_joint;

/// A point that moves with a mechanism.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Point {
    /// A joint.
    Joint(usize),
    /// A point in a link's frame (origin at its first joint, x toward its second; the ground's
    /// frame is the drawing's), m.
    Link {
        /// The link.
        link: usize,
        /// Its coordinates.
        at: [f64; 2],
    },
}

/// A solved position; or one in each lane.
pub(crate) struct SolvedPose<'p, R: Real = f64> {
    position: Position<'p, R>,
    derivatives: &'p DerivativeTables,
}

impl<'p, R: Real> SolvedPose<'p, R> {
    pub(crate) fn new(position: Position<'p, R>, derivatives: &'p DerivativeTables) -> Self {
        Self { position, derivatives }
    }

    /// Index of the second derivative by two drivers.
    pub(crate) fn second_order(&self, a: usize, b: usize) -> usize {
        let (a, b) = (a.min(b), a.max(b));
        let is_entry = |k: &usize| {
            let (driver, lower) = self.derivatives.lowered[*k];
            driver == a && self.derivatives.driver_of[lower] == Some(b)
        };
        (1 + self.derivatives.drivers..self.derivatives.len()).find(is_entry).unwrap_or(0)
    }

    /// Derivative `k` of a point's position (0: the position), m.
    #[inline(always)]
    pub(crate) fn point(&self, point: Point, k: usize) -> Vector<R> {
        let plan = self.position.plan;
        match point {
            Point::Joint(joint) => self.place(point_of_joint(joint), k),
            // The ground's frame is the drawing's, wherever its first joint is.
            Point::Link { link, at: [x, y] } if link == plan.ground => {
                if k == 0 {
                    Vector::splat(Vector::new(x, y))
                } else {
                    Vector::ZERO
                }
            }
            Point::Link { link, at } => {
                let at = Vector::splat(Vector::new(at[0], at[1]));
                self.place(plan.reference[link], k) + self.frame(link, k) * at
            }
        }
    }

    /// The position of a point and its first and second derivatives by the only driver: those of
    /// [`point`](Self::point), with what they share computed once.
    #[inline(always)]
    pub(crate) fn point_jet(&self, point: Point) -> [Vector<R>; 3] {
        let plan = self.position.plan;
        match point {
            Point::Link { link, at } if link != plan.ground => {
                let at = Vector::splat(Vector::new(at[0], at[1]));
                let unit = self.unit_vector(link);
                let (first, second) = (self.angle(link, 1), self.angle(link, 2));
                let tangent = unit.left();
                let frames =
                    [unit, tangent.scale(first), tangent.scale(second) - unit.scale(first * first)];
                let reference = plan.reference[link];
                [
                    self.place(reference, 0) + frames[0] * at,
                    self.place(reference, 1) + frames[1] * at,
                    self.place(reference, 2) + frames[2] * at,
                ]
            }
            _ => [self.point(point, 0), self.point(point, 1), self.point(point, 2)],
        }
    }

    /// Derivative `k` of the position of a point of the plan, m.
    #[inline(always)]
    fn place(&self, point: usize, k: usize) -> Vector<R> {
        let Position { state, constants, units, .. } = &self.position;
        let scaled = state.pose.points[point * self.derivatives.len() + k][0]
            .scale(R::splat(units.length[k]));
        let origin = Vector::splat(Vector::new(constants.origin[0], constants.origin[1]));
        if k == 0 { scaled + origin } else { scaled }
    }

    /// The unit vector along a link's x axis.
    #[inline(always)]
    fn unit_vector(&self, link: usize) -> Vector<R> {
        let Position { state, plan, constants, .. } = &self.position;
        let o = plan.link_orientation[link];
        let orientation = &plan.orientations[o];
        let phase = if orientation.driven { state.pose.phase[o][0] } else { Vector::ONE };
        state.pose.class[orientation.class][0] * phase * Vector::splat(constants.turn[link])
    }

    /// Derivative `k` of the unit vector along a link's x axis, up to the second order.
    #[inline(always)]
    pub(crate) fn frame(&self, link: usize, k: usize) -> Vector<R> {
        let unit = self.unit_vector(link);
        if k == 0 {
            return unit;
        }
        let tangential = unit.left().scale(self.angle(link, k));
        if self.derivatives.driver_of[k].is_some() {
            return tangential;
        }
        // ∂∂U = i U ∂∂Θ − U ∂Θ ∂Θ.
        let (driver, lower) = self.derivatives.lowered[k];
        let rates =
            self.angle(link, SolvedPose::<f64>::first_order(driver)) * self.angle(link, lower);
        tangential - unit.scale(rates)
    }

    /// Derivative `k` (not 0) of a link's angle.
    #[inline(always)]
    pub(crate) fn angle(&self, link: usize, k: usize) -> R {
        let Position { state, plan, units, .. } = &self.position;
        let rotation = &plan.rotation[link];
        let turns = self.derivatives.driver_of[k].map_or(0, |driver| rotation.turns[driver]);
        let class_angle = state.pose.theta[rotation.class * self.derivatives.len() + k][0];
        (class_angle + R::splat(f64::from(turns))) * R::splat(units.angle[k])
    }

    /// Derivative `k` of a slide's value (0: the value), m.
    pub(crate) fn slide(&self, slide: usize, k: usize) -> R {
        let Position { state, units, .. } = &self.position;
        state.pose.slides[slide * self.derivatives.len() + k][0] * R::splat(units.length[k])
    }

    /// The size of the design, m.
    pub(crate) fn size(&self) -> f64 {
        self.position.constants.scale
    }

    /// One over the unit of a driver's coordinate: the size for a slide, 1 for an angle.
    pub(crate) fn unit(&self, driver: usize) -> f64 {
        self.position.units.coordinate[driver]
    }
}

impl SolvedPose<'_> {
    /// Index of the first derivative by a driver.
    pub(crate) fn first_order(driver: usize) -> usize {
        1 + driver
    }

    /// A link's angle, rad, continuous along the branch from the drawing.
    pub(crate) fn total_angle(&self, link: usize) -> f64 {
        self.position.angle(link)
    }
}
