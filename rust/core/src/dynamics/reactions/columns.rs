//! Reads the kinematics of a few positions from the columns of a solved motion.

use super::force_plan::{Direction, ForcePlan};
use super::scene::{Moving, Scene};
use crate::batch::outputs::{Column, Quantity};
use crate::math::lanes::Real;
use crate::math::vector::Vector;
use crate::plan::mechanism::Mechanism;

/// Which columns hold the orders of every quantity that a plan reads.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Sources {
    /// Of every point: its columns from order 0 on.
    points: Vec<Option<usize>>,
    angles: Vec<Option<usize>>,
    slides: Vec<Option<usize>>,
}

/// The solved columns of some positions of one design, and the motion of its drivers there.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Solved<'a> {
    /// Position after position.
    pub columns: &'a [&'a [f64]],
    /// Speeds and accelerations of the drivers, drivers fastest.
    pub speed: &'a [f64],
    pub acceleration: &'a [f64],
    pub positions: usize,
}

impl Sources {
    pub(crate) fn new(plan: &ForcePlan, columns: &[Column]) -> Self {
        let find = |quantity: Quantity| {
            columns.iter().position(|c| c.quantity == quantity && c.order == 0)
        };
        Self {
            points: plan.points.iter().map(|quantity| quantity.and_then(find)).collect(),
            angles: (0..plan.reference.len()).map(|l| find(Quantity::Angle(l))).collect(),
            slides: (0..plan.slide_links.len()).map(|s| find(Quantity::Slide(s))).collect(),
        }
    }
}

/// The directions of all guides in the frames of the links that carry them.
pub(crate) fn guide_directions(mechanism: &Mechanism, dimensions: &[f64]) -> Vec<Vector> {
    let slides = mechanism.slots.slides.iter();
    slides.map(|slide| crate::plan::constants::unit(slide.angle(dimensions))).collect()
}

/// The positions that the lanes hold: from `first` on, the last again where there are no more.
#[derive(Clone, Copy)]
pub(crate) struct Rows {
    pub first: usize,
    pub last: usize,
}

impl Rows {
    /// The number `offset` of each position's `width` numbers.
    #[inline(always)]
    pub(crate) fn read<R: Real>(self, values: &[f64], width: usize, offset: usize) -> R {
        let first = self.first * width;
        // Widths that the compiler knows are read by few instructions.
        match (values.get(first..first + R::LANES * width), width) {
            (Some(all), 1) => R::from_lanes(|lane| all[lane]),
            (Some(all), 2) => R::from_lanes(|lane| all[2 * lane + offset]),
            _ => R::from_lanes(|lane| values[(self.first + lane).min(self.last) * width + offset]),
        }
    }
}

impl<R: Real> Scene<R> {
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
        for (point, source) in self.points.iter_mut().zip(&sources.points) {
            let &Some(column) = source else { continue };
            let (x, y) = (
                read_component(plan, solved, rows, column, [2, 0]),
                read_component(plan, solved, rows, column, [2, 1]),
            );
            *point = Moving {
                at: Vector::new(x.at, y.at),
                velocity: Vector::new(x.velocity, y.velocity),
                acceleration: Vector::new(x.acceleration, y.acceleration),
            };
        }
        for (angle, source) in self.angles.iter_mut().zip(&sources.angles) {
            let &Some(column) = source else { continue };
            *angle = read_component(plan, solved, rows, column, [1, 0]);
        }
        for (slide, source) in self.slides.iter_mut().zip(&sources.slides) {
            let &Some(column) = source else { continue };
            *slide = rows.read(solved.columns[column], 1, 0);
        }
        for link in (0..self.directions.len()).filter(|&link| plan.needs_direction[link]) {
            self.directions[link] = match plan.direction[link] {
                Direction::Ground => Vector::ONE,
                Direction::Joints([a, b]) => {
                    let span = self.points[b].at - self.points[a].at;
                    span.scale(R::ONE / span.norm())
                }
                Direction::Angle => Vector::at_angle(self.angles[link].at),
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

/// Value, velocity and acceleration of one component by the chain rule: `ẋ = x_a q̇_a`,
/// `ẍ = x_a q̈_a + x_ab q̇_a q̇_b`.
#[inline(always)]
fn read_component<R: Real>(
    plan: &ForcePlan,
    solved: &Solved<'_>,
    rows: Rows,
    column: usize,
    [width, component]: [usize; 2],
) -> Moving<R> {
    let n = plan.drivers;
    let at = rows.read(solved.columns[column], width, component);
    let (mut velocity, mut acceleration) = (R::ZERO, R::ZERO);
    if plan.order == 0 {
        return Moving { at, velocity, acceleration };
    }
    for a in 0..n {
        let d1 = rows.read::<R>(solved.columns[column + 1], width * n, component * n + a);
        velocity += d1 * rows.read(solved.speed, n, a);
        if plan.order > 1 {
            acceleration += d1 * rows.read(solved.acceleration, n, a);
        }
    }
    if plan.order > 1 {
        for a in 0..n {
            for b in 0..n {
                let entry = (component * n + a) * n + b;
                let d2 = rows.read::<R>(solved.columns[column + 2], width * n * n, entry);
                let speeds = rows.read::<R>(solved.speed, n, a) * rows.read(solved.speed, n, b);
                acceleration += d2 * speeds;
            }
        }
    }
    Moving { at, velocity, acceleration }
}
