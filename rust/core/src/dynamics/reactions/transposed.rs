//! The transposed solution: loads pass from the last group to the drivers.

use super::force_plan::ForcePlan;
use super::scene::Scene;
use super::steps::{LoadedUnknown, Transposed};
use crate::math::inverse::invert;
use crate::math::lanes::Real;
use crate::math::vector::Vector;
use crate::plan::dyad::Unknown;
use crate::state::closures::{ClosedPath, Closures};

impl<R: Real> Scene<R> {
    /// Starts with the loads on the links.
    #[inline(always)]
    pub(crate) fn start(&mut self, plan: &ForcePlan) {
        self.point_load.fill(Vector::ZERO);
        self.edge_force.fill(Vector::ZERO);
        self.sliding.fill(R::ZERO);
        self.slide_moment.fill(R::ZERO);
        for (link, &reference) in plan.reference.iter().enumerate() {
            self.point_load[reference] += self.link_force[link];
            self.moment[link] = self.link_moment[link];
        }
    }

    /// Finds the force in every edge.
    #[inline(always)]
    pub(crate) fn carry_loads(&mut self, plan: &ForcePlan) {
        for step in &plan.steps {
            match step {
                &Transposed::Carry { edge, backward } => self.carry(plan, edge, backward),
                Transposed::Close { closures, unknowns } => self.close(plan, closures, unknowns),
                &Transposed::TurnByJoints { link, edges, points } => {
                    self.turn_by_joints(link, edges, points);
                }
                &Transposed::TurnBySlide { link, slide } => self.turn_by_slide(plan, link, slide),
            }
        }
    }

    /// The vector of an edge.
    #[inline(always)]
    fn span(&self, plan: &ForcePlan, edge: usize) -> Vector<R> {
        let edge = &plan.edges[edge];
        self.points[edge.to].at - self.points[edge.from].at
    }

    /// Passes the load on the end of an edge to its start (`backward`: the other way).
    #[inline(always)]
    fn carry(&mut self, plan: &ForcePlan, edge: usize, backward: bool) {
        let ends = [plan.edges[edge].from, plan.edges[edge].to];
        let [start, end] = if backward { [ends[1], ends[0]] } else { ends };
        let load = std::mem::replace(&mut self.point_load[end], Vector::ZERO);
        self.point_load[start] += load;
        self.load_edge(plan, edge, if backward { -load } else { load });
    }

    /// Adds a force at the end of an edge to its link and its slide.
    #[inline(always)]
    pub(crate) fn load_edge(&mut self, plan: &ForcePlan, edge: usize, force: Vector<R>) {
        self.edge_force[edge] += force;
        let link = plan.edges[edge].link;
        if link != plan.ground {
            let turning = self.span(plan, edge).cross(force);
            self.moment[link] += turning;
        }
        if let Some(slide) = plan.edges[edge].slide {
            let along = self.guides[slide].dot(force);
            self.sliding[slide] += along;
        }
    }

    /// The derivative of a closed path by an unknown.
    #[inline(always)]
    pub(crate) fn column(
        &self,
        plan: &ForcePlan,
        path: &ClosedPath,
        unknown: Unknown,
    ) -> Vector<R> {
        let mut sum = Vector::ZERO;
        for &(edge, sign) in &path.edges {
            let sign = R::splat(sign);
            match unknown {
                Unknown::Class(class) if class == plan.edges[edge].class => {
                    sum += self.span(plan, edge).left().scale(sign * self.per_metre);
                }
                Unknown::Slide(slide) if Some(slide) == plan.edges[edge].slide => {
                    sum += self.guides[slide].scale(sign);
                }
                _ => {}
            }
        }
        sum
    }

    /// Solves `Jᵀ λ = −W` for the forces `λ` that close paths.
    #[inline(always)]
    fn close(&mut self, plan: &ForcePlan, closures: &Closures, unknowns: &[LoadedUnknown]) {
        let n = unknowns.len();
        self.right.clear();
        for unknown in unknowns {
            let load = match unknown {
                LoadedUnknown::Links(links) => {
                    let mut sum = R::ZERO;
                    for &link in links {
                        sum += self.moment[link];
                    }
                    sum * self.per_metre
                }
                &LoadedUnknown::Slide(slide) => self.sliding[slide],
            };
            self.right.push(-load);
        }
        if let ([path], &[first, second]) = (&closures.paths[..], &closures.unknowns[..]) {
            // Cramer's rule on the two rows of Jᵀ.
            let (a, b) = (self.column(plan, path, first), self.column(plan, path, second));
            let inverse = R::ONE / a.cross(b);
            let (p, q) = (self.right[0], self.right[1]);
            let force = Vector::new((p * b.y - q * a.y) * inverse, (q * a.x - p * b.x) * inverse);
            self.load_path(plan, path, force);
            return;
        }
        // Rows of Jᵀ are the unknowns, its columns the components of λ.
        self.matrix.resize(2 * n * n, [R::ZERO]);
        for (row, &unknown) in closures.unknowns.iter().enumerate() {
            for (index, path) in closures.paths.iter().enumerate() {
                let column = self.column(plan, path, unknown);
                self.matrix[row * 2 * n + 2 * index] = [column.x];
                self.matrix[row * 2 * n + 2 * index + 1] = [column.y];
            }
        }
        invert(&mut self.matrix[..2 * n * n], n);
        for (index, path) in closures.paths.iter().enumerate() {
            let force = Vector::new(self.solved(n, 2 * index), self.solved(n, 2 * index + 1));
            self.load_path(plan, path, force);
        }
    }

    /// A row of the inverse times the right-hand side.
    #[inline(always)]
    fn solved(&self, n: usize, row: usize) -> R {
        let mut sum = R::ZERO;
        for column in 0..n {
            sum += self.matrix[row * 2 * n + n + column][0] * self.right[column];
        }
        sum
    }

    /// Applies the force that closes a path to its edges and to the carriers of the path.
    #[inline(always)]
    fn load_path(&mut self, plan: &ForcePlan, path: &ClosedPath, force: Vector<R>) {
        self.point_load[path.plus] += force;
        self.point_load[path.minus] += -force;
        for &(edge, sign) in &path.edges {
            self.load_edge(plan, edge, force.scale(R::splat(sign)));
        }
    }
}
