//! The motion of one design in one assembly, by the coordinates that are to have values.

use std::f64::consts::TAU;
use std::sync::atomic::AtomicBool;

use crate::branch::constant_signs::SignConstancy;
use crate::branch::design::Design;
use crate::math::derivatives::DerivativeTables;
use crate::plan::constants::DesignConstants;
use crate::plan::mechanism::Mechanism;
use crate::plan::plan::Plan;
use crate::query::evaluator::{Evaluator, Position, Queries};
use crate::query::extremes::tracked::Tracked;
use crate::state::state::{Context, State};
use crate::state::status::{Rejection, Status};
use crate::structure::closure::point_of_joint;

/// Values of the coordinates at a position, in sizes from the solver's origin and rad, and their derivatives by the drivers.
#[derive(Debug, Clone)]
pub(super) struct Point {
    /// Coordinates of the drivers, in sizes and rad.
    pub q: Vec<f64>,
    /// Those of angles in (−π, π] up to the turns of the drivers.
    pub values: Vec<f64>,
    /// Row by row, one for each coordinate.
    pub jacobian: Vec<f64>,
}

/// One design in one assembly.
pub(super) struct Motion<'m> {
    solver: Solver<'m>,
    coordinates: &'m [Tracked],
    /// The unit of length, m.
    size: f64,
    /// The point that the solver measures from, m.
    origin: [f64; 2],
    /// Whether each driver is an angle.
    turns: Vec<bool>,
}

/// How positions are found.
enum Solver<'m> {
    /// The signs are the same everywhere.
    Signs { design: Box<Design<'m>>, state: Box<State> },
    /// By the branch from the drawing.
    Branch(Box<Evaluator<'m>>),
}

/// A design to move: its mechanism, dimensions, signs at the drawing.
#[derive(Debug, Clone, Copy)]
pub(super) struct Assembled<'m> {
    pub mechanism: &'m Mechanism,
    pub dimensions: &'m [f64],
    pub signs: &'m [i8],
}

impl<'m> Motion<'m> {
    pub(super) fn new(
        assembled: Assembled<'m>,
        coordinates: &'m [Tracked],
        derivatives: &'m DerivativeTables,
        cancel: Option<&'m AtomicBool>,
    ) -> Self {
        let Assembled { mechanism, dimensions, signs } = assembled;
        let mut design = Box::new(Design::new(mechanism, signs, derivatives));
        design.bind(dimensions);
        let (size, origin) = (design.constants.scale, design.constants.origin);
        let drivers = 0..mechanism.q0().len();
        let has_lengths =
            drivers.clone().any(|driver| mechanism.plan().length_step(driver).is_some());
        let at_drawing = design.signs_in_use().to_vec();
        let solver = if !has_lengths && SignConstancy::new(&mut design).holds(&at_drawing) {
            let state = Box::new(design.state(derivatives));
            Solver::Signs { design, state }
        } else {
            let design = (dimensions, signs);
            let evaluator =
                Evaluator::with_signs(mechanism, design, derivatives, Queries::Any, false, cancel);
            Solver::Branch(Box::new(evaluator))
        };
        let turns = drivers.map(|d| mechanism.plan().driven_slide(d).is_none()).collect();
        Self { solver, coordinates, size, origin, turns }
    }

    /// Goes to coordinates (in sizes and rad), if a position is there and has derivatives. Branches of several
    /// drivers go on from it.
    pub(super) fn at(&mut self, q: &[f64]) -> Option<Point> {
        self.solve(q, Evaluator::solve)
    }

    /// The same without going there.
    pub(super) fn probe(&mut self, q: &[f64]) -> Option<Point> {
        self.solve(q, Evaluator::probe)
    }

    fn solve(
        &mut self,
        q: &[f64],
        by_branch: impl Fn(&mut Evaluator<'m>, &[f64]) -> Result<(), Rejection>,
    ) -> Option<Point> {
        let coordinates = self.coordinates;
        match &mut self.solver {
            Solver::Signs { design, state } => {
                let cx: Context<'_> = design.context(design.derivatives);
                state.solve(&cx, q);
                let solved = matches!(state.status, Status::Ok | Status::NearSingular);
                let solution = Solution { state, plan: cx.plan, constants: &design.constants };
                solved.then(|| solution.point(q, coordinates))
            }
            Solver::Branch(evaluator) => {
                let given: Vec<f64> =
                    q.iter().enumerate().map(|(d, q)| q * evaluator.unit(d)).collect();
                by_branch(evaluator, &given).ok()?;
                let Position { state, plan, constants, .. } = evaluator.position();
                Some(Solution { state, plan, constants }.point(q, coordinates))
            }
        }
    }

    /// Coordinates of the drivers (rad or m) in sizes and rad.
    pub(super) fn scaled(&self, q: &[f64]) -> Vec<f64> {
        let unit = |turns: &bool| if *turns { 1.0 } else { self.size };
        q.iter().zip(&self.turns).map(|(q, t)| q / unit(t)).collect()
    }

    /// The opposite of [`Self::scaled`].
    pub(super) fn in_units(&self, q: &[f64]) -> Vec<f64> {
        let unit = |turns: &bool| if *turns { 1.0 } else { self.size };
        q.iter().zip(&self.turns).map(|(q, t)| q * unit(t)).collect()
    }

    /// Coordinates whole turns from others, at which they are nearest to `near`.
    pub(super) fn turned(&self, q: &[f64], near: &[f64]) -> Vec<f64> {
        let pairs = q.iter().zip(near).zip(&self.turns);
        let nearest = |((&q, &near), &turns): ((&f64, &f64), &bool)| {
            if turns { q + ((near - q) / TAU).round() * TAU } else { q }
        };
        pairs.map(nearest).collect()
    }

    /// Values (rad or m) in sizes and rad, of angles whole turns away those nearest to a position's.
    pub(super) fn targets(&self, values: &[f64], near: &Point) -> Vec<f64> {
        let target = |((&value, coordinate), &near): ((&f64, &Tracked), &f64)| match coordinate {
            Tracked::Link(_) => value + ((near - value) / TAU).round() * TAU,
            Tracked::Joint(_, axis) => (value - self.origin[*axis]) / self.size,
            Tracked::Slide(_) => value / self.size,
        };
        values.iter().zip(self.coordinates).zip(&near.values).map(target).collect()
    }

    /// The same values with the angle of one link the other way round, for each link.
    pub(super) fn other_way_round(&self, targets: &[f64], from: &Point) -> Vec<Vec<f64>> {
        let links = self.coordinates.iter().enumerate();
        let links = links.filter(|(_, coordinate)| matches!(coordinate, Tracked::Link(_)));
        let turned = |(index, _): (usize, &Tracked)| {
            let mut other = targets.to_vec();
            other[index] -= TAU.copysign(targets[index] - from.values[index]);
            other
        };
        links.map(turned).collect()
    }

    /// What is missing from the values of a position; of angles without whole turns.
    pub(super) fn missing(&self, targets: &[f64], at: &Point) -> Vec<f64> {
        let missing = |((&target, coordinate), &value): ((&f64, &Tracked), &f64)| {
            let gap = target - value;
            match coordinate {
                Tracked::Link(_) => gap - (gap / TAU).round() * TAU,
                _ => gap,
            }
        };
        targets.iter().zip(self.coordinates).zip(&at.values).map(missing).collect()
    }
}

/// A solved position.
struct Solution<'s> {
    state: &'s State,
    plan: &'s Plan,
    constants: &'s DesignConstants,
}

impl Solution<'_> {
    fn point(&self, q: &[f64], coordinates: &[Tracked]) -> Point {
        let slopes = coordinates
            .iter()
            .flat_map(|&coordinate| (0..q.len()).map(move |driver| self.slope(coordinate, driver)));
        Point {
            q: q.to_vec(),
            values: coordinates.iter().map(|&coordinate| self.value(coordinate, q)).collect(),
            jacobian: slopes.collect(),
        }
    }

    fn value(&self, coordinate: Tracked, q: &[f64]) -> f64 {
        let Self { state, plan, constants, .. } = self;
        match coordinate {
            Tracked::Joint(joint, axis) => {
                let point = state.pose.points[point_of_joint(joint) * state.len][0];
                [point.x, point.y][axis]
            }
            Tracked::Slide(slide) => state.pose.slides[slide * state.len][0],
            Tracked::Link(link) => {
                let rotation = &plan.rotation[link];
                let driven: f64 =
                    rotation.turns.iter().zip(q).map(|(&turns, q)| f64::from(turns) * q).sum();
                state.pose.class[rotation.class][0].angle() + constants.offset[link] + driven
            }
        }
    }

    fn slope(&self, coordinate: Tracked, driver: usize) -> f64 {
        let Self { state, plan, .. } = self;
        let k = 1 + driver;
        match coordinate {
            Tracked::Joint(joint, axis) => {
                let rate = state.pose.points[point_of_joint(joint) * state.len + k][0];
                [rate.x, rate.y][axis]
            }
            Tracked::Slide(slide) => state.pose.slides[slide * state.len + k][0],
            Tracked::Link(link) => {
                let rotation = &plan.rotation[link];
                let class = state.pose.theta[rotation.class * state.len + k][0];
                class + f64::from(rotation.turns[driver])
            }
        }
    }
}
