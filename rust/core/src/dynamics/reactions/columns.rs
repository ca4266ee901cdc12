//! Reads the kinematics of a few positions from the columns of a solved motion.

use std::ops::Add;

use super::force_plan::{Direction, ForcePlan};
use super::lane_rows::Rows;
use super::scene::{Moving, Scene};
use crate::batch::request::{Column, Quantity};
use crate::math::lanes::Real;
use crate::math::vector::Vector;
use crate::plan::mechanism::Mechanism;

/// The columns with the orders of every quantity that a plan reads.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Sources {
    /// The columns of every point, from order 0 on.
    pub(crate) points: Vec<Option<usize>>,
    pub(crate) angles: Vec<Option<usize>>,
    /// The columns of the derivatives of every angle, from order 1 on.
    pub(crate) rates: Vec<Option<usize>>,
    pub(crate) directions: Vec<Option<usize>>,
    pub(crate) slides: Vec<Option<usize>>,
}

/// The solved columns of some positions of one design, and the motion of its drivers there.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Solved<'a> {
    /// Position after position.
    pub columns: &'a [&'a [f64]],
    /// Speeds and accelerations of the drivers, drivers fastest: for every position, or one for all.
    pub speed: &'a [f64],
    pub acceleration: &'a [f64],
    pub positions: usize,
}

impl Sources {
    pub(crate) fn new(plan: &ForcePlan, columns: &[Column]) -> Self {
        let at_order = |quantity: Quantity, order: usize| {
            columns.iter().position(|c| c.quantity == quantity && c.order == order)
        };
        let find = |quantity: Quantity| at_order(quantity, 0);
        let links = 0..plan.reference.len();
        Self {
            points: plan.points.iter().map(|quantity| quantity.and_then(find)).collect(),
            angles: links.clone().map(|l| find(Quantity::Angle(l))).collect(),
            rates: links.clone().map(|l| at_order(Quantity::Angle(l), 1)).collect(),
            directions: links.map(|l| find(Quantity::Direction(l))).collect(),
            slides: (0..plan.slide_links.len()).map(|s| find(Quantity::Slide(s))).collect(),
        }
    }
}

/// The directions of all guides in the frames of the links that carry them.
pub(crate) fn guide_directions(mechanism: &Mechanism, dimensions: &[f64]) -> Vec<Vector> {
    let slides = mechanism.slots.slides.iter();
    slides.map(|slide| crate::plan::constants::unit(slide.angle(dimensions))).collect()
}

impl<R: Real> Scene<R> {
    /// Sets the points of the ground that are known for a design.
    #[inline(always)]
    pub(crate) fn place_known(&mut self, known: &[(usize, Vector)]) {
        for &(point, at) in known {
            let rest = Vector::ZERO;
            let at = Vector::splat(at);
            self.points[point] = Moving { at, velocity: rest, acceleration: rest };
        }
    }

    /// Reads positions.
    #[inline(always)]
    pub(crate) fn read(
        &mut self,
        plan: &ForcePlan,
        sources: &Sources,
        guides: &[Vector],
        solved: &Solved<'_>,
        rows: Rows,
    ) {
        let n = plan.drivers;
        for (driver, drive) in self.drive.iter_mut().enumerate() {
            *drive = [
                rows.read_drive(solved.speed, n, driver),
                rows.read_drive(solved.acceleration, n, driver),
            ];
        }
        let drive = &self.drive;
        for (point, source) in self.points.iter_mut().zip(&sources.points) {
            let &Some(column) = source else { continue };
            *point = moving(plan.order, drive, rows, &solved.columns[column..]);
        }
        let of_angles = sources.angles.iter().zip(&sources.rates);
        for (angle, (&value, &rates)) in self.angles.iter_mut().zip(of_angles) {
            if let Some(column) = value {
                *angle = moving(plan.order, drive, rows, &solved.columns[column..]);
            } else if let Some(column) = rates {
                let rates = &solved.columns[column..];
                let [velocity, acceleration] = changing(plan.order, drive, rows, rates);
                *angle = Moving { velocity, acceleration, ..*angle };
            }
        }
        for (angle, turns) in self.angles.iter_mut().zip(&plan.turns) {
            let Some(turns) = turns else { continue };
            (angle.velocity, angle.acceleration) = (R::ZERO, R::ZERO);
            for (&turns, &[speed, speed_rate]) in turns.iter().zip(drive) {
                angle.velocity += R::splat(turns) * speed;
                angle.acceleration += R::splat(turns) * speed_rate;
            }
        }
        for (slide, source) in self.slides.iter_mut().zip(&sources.slides) {
            let &Some(column) = source else { continue };
            *slide = rows.solved(solved.columns[column], 1, 0);
        }
        for link in (0..self.directions.len()).filter(|&link| plan.needs_direction[link]) {
            self.directions[link] = match plan.direction[link] {
                Direction::Ground => Vector::ONE,
                Direction::Joints([a, b]) => {
                    let span = self.points[b].at - self.points[a].at;
                    span.scale(R::ONE / span.norm())
                }
                Direction::Angle => Vector::at_angle(self.angles[link].at),
                Direction::Solved => match sources.directions[link] {
                    Some(column) => rows.pairs(solved.columns[column], 1, 0),
                    None => Vector::ONE,
                },
            };
        }
        for (slide, &guide) in guides.iter().enumerate() {
            let carrier = plan.slide_links[slide][1];
            let guide = Vector::splat(guide);
            self.guides[slide] =
                if carrier == plan.ground { guide } else { self.directions[carrier] * guide };
        }
    }
}

/// Value, velocity and acceleration by the chain rule: `ẋ = x_a q̇_a`, `ẍ = x_a q̈_a + x_ab q̇_a q̇_b`.
/// `columns`: those of all orders.
// A closure here would not be compiled with the level's instructions.
#[inline(always)]
fn moving<R: Real, T: Term<R>>(
    highest: usize,
    drive: &[[R; 2]],
    rows: Rows,
    columns: &[&[f64]],
) -> Moving<T> {
    let at = T::read(rows, columns[0], 1, 0);
    let [velocity, acceleration] =
        changing(highest, drive, rows, columns.get(1..).unwrap_or_default());
    Moving { at, velocity, acceleration }
}

/// Velocity and acceleration; `columns`: those of the first and the second order.
#[inline(always)]
fn changing<R: Real, T: Term<R>>(
    highest: usize,
    drive: &[[R; 2]],
    rows: Rows,
    columns: &[&[f64]],
) -> [T; 2] {
    let n = drive.len();
    let (mut velocity, mut acceleration) = (T::NONE, T::NONE);
    if highest == 0 {
        return [velocity, acceleration];
    }
    for (a, &[speed, speed_rate]) in drive.iter().enumerate() {
        let d1 = T::read(rows, columns[0], n, a);
        velocity = velocity + d1.times(speed);
        if highest > 1 {
            acceleration = acceleration + d1.times(speed_rate);
        }
    }
    if highest > 1 {
        for (a, &[first, _]) in drive.iter().enumerate() {
            for (b, &[second, _]) in drive.iter().enumerate() {
                let d2 = T::read(rows, columns[1], n * n, a * n + b);
                acceleration = acceleration + d2.times(first * second);
            }
        }
    }
    [velocity, acceleration]
}

/// A number or a vector that moves.
trait Term<R>: Copy + Add<Output = Self> {
    const NONE: Self;
    fn times(self, factor: R) -> Self;
    /// The entry `offset` of `width` at each position.
    fn read(rows: Rows, values: &[f64], width: usize, offset: usize) -> Self;
}

impl<R: Real> Term<R> for R {
    const NONE: Self = R::ZERO;
    #[inline(always)]
    fn times(self, factor: R) -> Self {
        self * factor
    }
    #[inline(always)]
    fn read(rows: Rows, values: &[f64], width: usize, offset: usize) -> Self {
        rows.solved(values, width, offset)
    }
}

impl<R: Real> Term<R> for Vector<R> {
    const NONE: Self = Self::ZERO;
    #[inline(always)]
    fn times(self, factor: R) -> Self {
        self.scale(factor)
    }
    #[inline(always)]
    fn read(rows: Rows, values: &[f64], width: usize, offset: usize) -> Self {
        rows.pairs(values, width, offset)
    }
}
