//! The closure equations of a linkage, their unknowns, and a pose as values of these.

use nalgebra::DVector;

use super::closure::{Closure, LeftOut, Rotation};
use crate::description::{Driver, Linkage};

/// A displaced linkage: points, and rotations of the free classes and displacements
/// of the slides since the drawing. Lengths are relative to the size.
#[derive(Debug, Clone)]
pub(crate) struct SkeletonPose {
    pub(super) points: Vec<[f64; 2]>,
    pub(super) turn: Vec<f64>,
    pub(super) slide: Vec<f64>,
}

impl SkeletonPose {
    /// The pose after a step in the unknowns of a system.
    pub(super) fn after_step(&self, step: &DVector<f64>, system: &System) -> Self {
        let mut next = self.clone();
        for (unknown, delta) in system.unknowns.iter().zip(step.iter()) {
            match *unknown {
                ClosureUnknown::Point { point, axis } => next.points[point][axis] += delta,
                ClosureUnknown::Class(class) => next.turn[class] += delta,
                ClosureUnknown::Slide(slide) => next.slide[slide] += delta,
            }
        }
        next
    }
}

/// One unknown of the closure equations.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ClosureUnknown {
    /// x (0) or y (1) of a point.
    Point { point: usize, axis: usize },
    /// Rotation of a class.
    Class(usize),
    /// Value of a slide.
    Slide(usize),
}

/// Closure equations of the kept links and slides, with their unknowns.
#[derive(Debug, Clone)]
pub(crate) struct System {
    /// Kept edges, two rows each.
    pub edges: Vec<usize>,
    /// Columns.
    pub unknowns: Vec<ClosureUnknown>,
    /// Class of every link in this system.
    pub(super) class_of: Vec<usize>,
    /// Column of each point (its x), class and slide that is unknown.
    pub(super) column_of_point: Vec<Option<usize>>,
    pub(super) column_of_class: Vec<Option<usize>>,
    pub(super) column_of_slide: Vec<Option<usize>>,
}

impl System {
    /// Sets up the equations. With `locked`, driven slides are known.
    #[must_use]
    pub(crate) fn new(
        linkage: &Linkage,
        closure: &Closure,
        left_out: &LeftOut,
        rotation: &[Rotation],
        locked: bool,
    ) -> Self {
        let edges: Vec<usize> =
            (closure.kept(linkage, left_out)).filter(|&e| closure.is_paired(linkage, e)).collect();
        let links: Vec<usize> =
            (0..linkage.links.len()).filter(|l| !left_out.links.contains(l)).collect();
        let mut point_used = vec![false; closure.points];
        for &l in links.iter().filter(|&&l| l != linkage.ground) {
            point_used[closure.reference[l]] = true;
        }
        for &e in &edges {
            point_used[closure.edges[e].from] = true;
            point_used[closure.edges[e].to] = true;
        }
        let mut unknowns = Vec::new();
        for point in (0..closure.points).filter(|&p| point_used[p] && !closure.fixed[p]) {
            unknowns.extend([0, 1].map(|axis| ClosureUnknown::Point { point, axis }));
        }
        let class_of: Vec<usize> = rotation.iter().map(|r| r.class).collect();
        let mut classes: Vec<usize> = links.iter().map(|&l| class_of[l]).collect();
        classes.sort_unstable();
        classes.dedup();
        unknowns.extend(classes.into_iter().filter(|&c| c != 0).map(ClosureUnknown::Class));
        let driven = |slide| locked && linkage.drivers.contains(&Driver::Slide(slide));
        for &e in &edges {
            if let Some(slide) = closure.edges[e].slide().filter(|&s| !driven(s)) {
                unknowns.push(ClosureUnknown::Slide(slide));
            }
        }
        let mut column_of_point = vec![None; closure.points];
        let mut column_of_class = vec![None; linkage.links.len()];
        let mut column_of_slide = vec![None; linkage.slides.len()];
        for (column, unknown) in unknowns.iter().enumerate() {
            match *unknown {
                ClosureUnknown::Point { point, axis: 0 } => column_of_point[point] = Some(column),
                ClosureUnknown::Point { .. } => {}
                ClosureUnknown::Class(class) => column_of_class[class] = Some(column),
                ClosureUnknown::Slide(slide) => column_of_slide[slide] = Some(column),
            }
        }
        Self { edges, unknowns, class_of, column_of_point, column_of_class, column_of_slide }
    }

    /// Number of scalar equations.
    #[must_use]
    pub(crate) fn rows(&self) -> usize {
        2 * self.edges.len()
    }
}
