//! Mobility by rank: ranks of the closure equations at the drawing and at
//! displaced, regular positions.
//!
//! A drawing can be singular by chance (a four-bar drawn collinear), and special
//! dimensions can make a counted structure move (a parallelogram with a third
//! bar). Moving the linkage distinguishes the two: a step from the drawing along
//! the null space, Gauss-Newton back onto the closure, and the rank there. A shaky
//! structure does not move: its mobility is 0.

use std::sync::atomic::{AtomicBool, Ordering};

use nalgebra::{DMatrix, DVector};

use super::closure::{Closure, LeftOut, Rotation, Span};
use super::elimination::SparseRows;
use super::rank;
use super::rank::Rank;
use crate::description::error::Interrupted;
use crate::description::{Driver, Linkage};
use crate::math::tolerance::{
    NEARLY_DEPENDENT, NEARLY_REDUNDANT, RANK, REGULAR_CLOSURE, TRUNCATED,
};
use crate::math::trig::sin_cos;
use crate::math::vector::Vector;

/// A displaced linkage: points, and rotations of the free classes and displacements
/// of the slides since the drawing. Lengths are relative to the size.
#[derive(Debug, Clone)]
pub(crate) struct Pose {
    points: Vec<[f64; 2]>,
    turn: Vec<f64>,
    slide: Vec<f64>,
}

impl Pose {
    /// The pose after a step in the unknowns of a system.
    fn after_step(&self, step: &DVector<f64>, system: &System) -> Self {
        let mut next = self.clone();
        for (unknown, delta) in system.unknowns.iter().zip(step.iter()) {
            match *unknown {
                Unknown::Point { point, axis } => next.points[point][axis] += delta,
                Unknown::Class(class) => next.turn[class] += delta,
                Unknown::Slide(slide) => next.slide[slide] += delta,
            }
        }
        next
    }
}

/// One unknown of the closure equations.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Unknown {
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
    pub unknowns: Vec<Unknown>,
    /// Class of every link in this system.
    class_of: Vec<usize>,
    /// Column of each point (its x), class and slide that is unknown.
    column_of_point: Vec<Option<usize>>,
    column_of_class: Vec<Option<usize>>,
    column_of_slide: Vec<Option<usize>>,
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
            unknowns.extend([0, 1].map(|axis| Unknown::Point { point, axis }));
        }
        let class_of: Vec<usize> = rotation.iter().map(|r| r.class).collect();
        let mut classes: Vec<usize> = links.iter().map(|&l| class_of[l]).collect();
        classes.sort_unstable();
        classes.dedup();
        unknowns.extend(classes.into_iter().filter(|&c| c != 0).map(Unknown::Class));
        let driven = |slide| locked && linkage.drivers.contains(&Driver::Slide(slide));
        for &e in &edges {
            if let Some(slide) = closure.edges[e].slide().filter(|&s| !driven(s)) {
                unknowns.push(Unknown::Slide(slide));
            }
        }
        let mut column_of_point = vec![None; closure.points];
        let mut column_of_class = vec![None; linkage.links.len()];
        let mut column_of_slide = vec![None; linkage.slides.len()];
        for (column, unknown) in unknowns.iter().enumerate() {
            match *unknown {
                Unknown::Point { point, axis: 0 } => column_of_point[point] = Some(column),
                Unknown::Point { .. } => {}
                Unknown::Class(class) => column_of_class[class] = Some(column),
                Unknown::Slide(slide) => column_of_slide[slide] = Some(column),
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

/// The geometry of the drawing, from which poses are computed.
#[derive(Debug)]
pub(crate) struct Skeleton<'a> {
    linkage: &'a Linkage,
    closure: &'a Closure,
    /// Rotations with no driver locked.
    free: &'a [Rotation],
    /// Edge vectors in the drawing.
    vector: Vec<[f64; 2]>,
    /// Guide directions in the drawing; zero for edges without a guide.
    direction: Vec<[f64; 2]>,
    drawing: Pose,
    /// Unit of all lengths here, m.
    size: f64,
    /// Stops the work once true.
    cancel: Option<&'a AtomicBool>,
}

impl<'a> Skeleton<'a> {
    /// Takes over the drawing; `free` are the rotations with no driver locked.
    #[must_use]
    pub(crate) fn new(
        linkage: &'a Linkage,
        closure: &'a Closure,
        free: &'a [Rotation],
        classes: usize,
        cancel: Option<&'a AtomicBool>,
    ) -> Self {
        let size = paired_size(linkage);
        let origin = linkage.joints.first().map_or([0.0; 2], |j| j.at);
        let scaled = |at: [f64; 2]| [(at[0] - origin[0]) / size, (at[1] - origin[1]) / size];
        let mut points = vec![[0.0; 2]; closure.points];
        points[0] = scaled([0.0; 2]);
        for (j, joint) in linkage.joints.iter().enumerate() {
            points[super::closure::point_of_joint(j)] = scaled(joint.at);
        }
        for (l, &p) in closure.reference.iter().enumerate() {
            if let Some(at) = linkage.reference_point(l).filter(|_| p != 0) {
                points[p] = scaled(at);
            }
        }
        let vector = (closure.edges.iter())
            .map(|e| [0, 1].map(|k| points[e.to][k] - points[e.from][k]))
            .collect();
        let direction = (closure.edges.iter())
            .map(|e| match e.span {
                Span::Guide { slide } => {
                    let (sin, cos) = sin_cos(linkage.slides[slide].angle);
                    [cos, sin]
                }
                Span::Joint { .. } => [0.0; 2],
            })
            .collect();
        let drawing =
            Pose { points, turn: vec![0.0; classes], slide: vec![0.0; linkage.slides.len()] };
        Self { linkage, closure, free, vector, direction, drawing, size, cancel }
    }

    /// The drawing itself.
    #[must_use]
    pub(crate) fn drawing(&self) -> &Pose {
        &self.drawing
    }

    /// Unit of all lengths here, m.
    #[must_use]
    pub(crate) fn size(&self) -> f64 {
        self.size
    }

    /// Rotation of an edge's link since the drawing, as a unit vector.
    fn edge_rotation(&self, pose: &Pose, e: usize) -> Vector {
        Vector::at_angle(pose.turn[self.free[self.closure.edges[e].link].class])
    }

    /// Edge vector and guide direction in a pose.
    fn edge_vectors(&self, pose: &Pose, e: usize) -> ([f64; 2], [f64; 2]) {
        let edge = &self.closure.edges[e];
        let turn = self.edge_rotation(pose, e);
        let (sin, cos) = (turn.y, turn.x);
        let rotated = |v: [f64; 2]| [cos * v[0] - sin * v[1], sin * v[0] + cos * v[1]];
        let d = rotated(self.direction[e]);
        let s = edge.slide().map_or(0.0, |s| pose.slide[s]);
        let v = rotated(self.vector[e]);
        ([v[0] + s * d[0], v[1] + s * d[1]], d)
    }

    /// Residual of each equation of a system in a pose.
    #[must_use]
    pub(crate) fn residual(&self, system: &System, pose: &Pose) -> DVector<f64> {
        let mut rows = Vec::with_capacity(system.rows());
        for &e in &system.edges {
            let edge = &self.closure.edges[e];
            let (v, _) = self.edge_vectors(pose, e);
            for (k, component) in v.iter().enumerate() {
                rows.push(pose.points[edge.to][k] - pose.points[edge.from][k] - component);
            }
        }
        DVector::from_vec(rows)
    }

    /// Jacobian of the closure equations: the entries of each row in the order of columns.
    fn jacobian(&self, system: &System, pose: &Pose) -> SparseRows {
        let mut rows = Vec::with_capacity(system.rows());
        for &e in &system.edges {
            let edge = &self.closure.edges[e];
            let (v, d) = self.edge_vectors(pose, e);
            let class = system.column_of_class[system.class_of[edge.link]];
            let slide = edge.slide().and_then(|slide| system.column_of_slide[slide]);
            for (axis, by_angle) in [v[1], -v[0]].into_iter().enumerate() {
                let mut row = Vec::with_capacity(4);
                if edge.from != edge.to {
                    row.extend(system.column_of_point[edge.to].map(|x| (x + axis, 1.0)));
                    row.extend(system.column_of_point[edge.from].map(|x| (x + axis, -1.0)));
                }
                row.extend(class.map(|column| (column, by_angle)));
                row.extend(slide.map(|column| (column, -d[axis])));
                row.sort_unstable_by_key(|entry| entry.0);
                rows.push(row);
            }
        }
        rows
    }

    /// Rank, motions and self-stresses of a system in a pose.
    ///
    /// # Errors
    ///
    /// [`Interrupted`].
    pub(crate) fn rank(&self, system: &System, pose: &Pose) -> Result<Rank, Interrupted> {
        self.rank_above(RANK, system, pose)
    }

    /// [`Self::rank`], counting nearly dependent equations as dependent.
    ///
    /// # Errors
    ///
    /// [`Interrupted`].
    pub(crate) fn tolerant_rank(&self, system: &System, pose: &Pose) -> Result<Rank, Interrupted> {
        self.rank_above(NEARLY_DEPENDENT, system, pose)
    }

    fn rank_above(
        &self,
        threshold: f64,
        system: &System,
        pose: &Pose,
    ) -> Result<Rank, Interrupted> {
        self.check_cancelled()?;
        let (jacobian, unknowns) = (self.jacobian(system, pose), system.unknowns.len());
        rank::rank(jacobian, unknowns, threshold, || self.check_cancelled().is_err())
    }

    /// Gradient of a weighted sum of the closure equations by the coordinates of all joints in the
    /// drawing (relative to the size), then by the angles of all guides.
    #[must_use]
    pub(crate) fn drawing_gradient(
        &self,
        system: &System,
        pose: &Pose,
        weights: &DVector<f64>,
    ) -> Vec<f64> {
        let joints = self.linkage.joints.len();
        let mut gradient = vec![0.0; 2 * joints + self.linkage.slides.len()];
        for (row, &e) in system.edges.iter().enumerate() {
            let edge = &self.closure.edges[e];
            let weight = Vector::new(weights[2 * row], weights[2 * row + 1]);
            // The equation is P_to − P_from − U · (w + s d), with w = P_to − P_from as drawn.
            let unrotated = self.edge_rotation(pose, e).conj() * weight;
            for (point, sign) in [(edge.to, 1.0), (edge.from, -1.0)] {
                let Some(joint) = joint_of_point(point).filter(|&j| j < joints) else { continue };
                let own = if self.closure.fixed[point] { weight } else { Vector::ZERO };
                let change = (own - unrotated).scale(sign);
                gradient[2 * joint] += change.x;
                gradient[2 * joint + 1] += change.y;
            }
            if let Some(slide) = edge.slide() {
                let guide = Vector::new(self.direction[e][0], self.direction[e][1]);
                gradient[2 * joints + slide] -= pose.slide[slide] * guide.left().dot(unrotated);
            }
        }
        gradient
    }

    fn check_cancelled(&self) -> Result<(), Interrupted> {
        let stop = self.cancel.is_some_and(|flag| flag.load(Ordering::Relaxed));
        if stop { Err(Interrupted) } else { Ok(()) }
    }

    /// Poses displaced from the drawing along its null space in pseudo-random directions, in
    /// ascending order of mobility, so that the most regular come first. Empty if the linkage
    /// is rigid.
    ///
    /// # Errors
    ///
    /// [`Interrupted`].
    pub(crate) fn displaced_poses(
        &self,
        system: &System,
    ) -> Result<Vec<(Pose, Rank)>, Interrupted> {
        let initial = self.rank(system, &self.drawing)?;
        if initial.mobility == 0 {
            return Ok(Vec::new());
        }
        let mut random = 0x9E37_79B9_7F4A_7C15_u64;
        let mut poses: Vec<(Pose, Rank)> = Vec::new();
        // Several directions, because several branches of motion meet in a singular drawing.
        for _ in 0..8 {
            for amplitude in [0.1, 0.03, -0.1, -0.03, 0.01, 0.003] {
                let weights =
                    DVector::from_fn(initial.motions.ncols(), |_, _| next_random(&mut random));
                let direction = &initial.motions * weights;
                let step = direction.scale(amplitude / direction.amax().max(f64::MIN_POSITIVE));
                if let Some(reached) = self.project(system, &self.drawing, &step)? {
                    let rank = self.rank(system, &reached)?;
                    poses.push((reached, rank));
                    break;
                }
            }
        }
        poses.sort_by_key(|(_, rank)| rank.mobility);
        Ok(poses)
    }

    /// Takes a step and returns onto the closure by Gauss-Newton. `None` if that fails or undoes
    /// most of the step.
    fn project(
        &self,
        system: &System,
        from: &Pose,
        step: &DVector<f64>,
    ) -> Result<Option<Pose>, Interrupted> {
        let mut pose = from.after_step(step, system);
        let mut total = step.clone();
        for _ in 0..30 {
            let residual = self.residual(system, &pose);
            if residual.amax() < REGULAR_CLOSURE {
                return Ok((total.amax() > 0.25 * step.amax()).then_some(pose));
            }
            let correction = self.gauss_newton_step(system, &pose, &residual, TRUNCATED)?;
            if !correction.amax().is_finite() || correction.amax() > 1.0 {
                return Ok(None);
            }
            total += &correction;
            pose = pose.after_step(&correction, system);
        }
        Ok(None)
    }

    /// [`Self::project`], ignoring nearly dependent equations. Also returns the greatest residual,
    /// which these equations leave.
    ///
    /// # Errors
    ///
    /// [`Interrupted`].
    pub(crate) fn project_tolerant(
        &self,
        system: &System,
        from: &Pose,
        step: &DVector<f64>,
    ) -> Result<Option<(Pose, f64)>, Interrupted> {
        let mut pose = from.after_step(step, system);
        let mut total = step.clone();
        let mut previous = f64::INFINITY;
        for _ in 0..30 {
            let residual = self.residual(system, &pose);
            let correction = self.gauss_newton_step(system, &pose, &residual, NEARLY_DEPENDENT)?;
            let length = correction.amax();
            if !length.is_finite() || length > 1.0 {
                return Ok(None);
            }
            total += &correction;
            pose = pose.after_step(&correction, system);
            // Which equations are ignored may change from step to step. The steps then remain as
            // long as the residuals of these equations.
            let converged =
                length < REGULAR_CLOSURE || (length < NEARLY_REDUNDANT && length > 0.5 * previous);
            previous = length;
            if converged {
                let misfit = self.residual(system, &pose).amax();
                return Ok((total.amax() > 0.25 * step.amax()).then_some((pose, misfit)));
            }
        }
        Ok(None)
    }

    /// One step of Gauss-Newton.
    fn gauss_newton_step(
        &self,
        system: &System,
        pose: &Pose,
        residual: &DVector<f64>,
        threshold: f64,
    ) -> Result<DVector<f64>, Interrupted> {
        self.check_cancelled()?;
        let (jacobian, unknowns) = (self.jacobian(system, pose), system.unknowns.len());
        Ok(-rank::solve(jacobian, unknowns, threshold, residual, || {
            self.check_cancelled().is_err()
        })?)
    }

    /// Links that any of the motions (columns over the unknowns) moves.
    #[must_use]
    pub(crate) fn moving_links(&self, system: &System, motions: &DMatrix<f64>) -> Vec<usize> {
        let moves = |selected: &dyn Fn(Unknown) -> bool| {
            let rows = system.unknowns.iter().enumerate().filter(|(_, u)| selected(**u));
            rows.map(|(row, _)| motions.row(row).amax()).fold(0.0, f64::max)
                > 1e-6 * motions.amax().max(f64::MIN_POSITIVE)
        };
        (0..self.linkage.links.len())
            .filter(|&l| l != self.linkage.ground)
            .filter(|&l| {
                let (class, point) = (system.class_of[l], self.closure.reference[l]);
                moves(&|u| match u {
                    Unknown::Class(c) => c == class,
                    Unknown::Point { point: p, .. } => p == point,
                    Unknown::Slide(_) => false,
                })
            })
            .collect()
    }

    /// Names of the links and slides with equations in a self-stress.
    #[must_use]
    pub(crate) fn stressed_names(&self, system: &System, stresses: &DMatrix<f64>) -> Vec<String> {
        let (links, slides) = self.stressed_parts(system, stresses);
        let links = links.into_iter().map(|l| self.linkage.links[l].name.clone());
        links.chain(slides.into_iter().map(|s| self.linkage.slides[s].name.clone())).collect()
    }

    /// Indices of the moving links, and of the slides, with equations in a self-stress.
    #[must_use]
    pub(crate) fn stressed_parts(
        &self,
        system: &System,
        stresses: &DMatrix<f64>,
    ) -> (Vec<usize>, Vec<usize>) {
        let limit = 1e-6 * stresses.amax().max(f64::MIN_POSITIVE);
        let (mut links, mut slides) = (Vec::new(), Vec::new());
        for (row, &e) in system.edges.iter().enumerate() {
            if stresses.ncols() > 0 && stresses.rows(2 * row, 2).amax() > limit {
                links.push(self.closure.edges[e].link);
                if let Some(slide) = self.closure.edges[e].slide() {
                    links.push(self.linkage.slides[slide].link);
                    slides.push(slide);
                }
            }
        }
        links.sort_unstable();
        links.dedup();
        links.retain(|&l| l != self.linkage.ground);
        (links, slides)
    }
}

/// Index of the joint at a point; at least the number of joints if the point is not a joint,
/// `None` for the ground's origin.
fn joint_of_point(point: usize) -> Option<usize> {
    point.checked_sub(1)
}

/// Size of the linkage, from the joints that are pairs.
fn paired_size(linkage: &Linkage) -> f64 {
    let mut trimmed = linkage.clone();
    let paired = |j: usize| linkage.links_at(j).nth(1).is_some();
    trimmed.joints = (0..linkage.joints.len())
        .filter(|&j| paired(j))
        .map(|j| linkage.joints[j].clone())
        .collect();
    if trimmed.joints.len() > 1 { trimmed.size() } else { linkage.size() }
}

/// xorshift64* in (−1, 1) (Marsaglia 2003, Vigna 2016). The seed is fixed, so that
/// the same description always gives the same result.
fn next_random(state: &mut u64) -> f64 {
    *state ^= *state >> 12;
    *state ^= *state << 25;
    *state ^= *state >> 27;
    let bits = state.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11;
    // 53 bits are exact in a double.
    let unit = bits as f64 / (1_u64 << 53) as f64;
    2.0 * unit - 1.0
}
