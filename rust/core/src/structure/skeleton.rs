//! The geometry of a drawing: residuals, Jacobian and gradients of the closure equations.

use std::sync::atomic::AtomicBool;

use nalgebra::DVector;

use super::closure::{Closure, Rotation, Span};
use super::elimination::SparseRows;
use super::system::{SkeletonPose, System};
use crate::description::Linkage;
use crate::math::trig::sin_cos;
use crate::math::vector::Vector;

/// The geometry of the drawing, from which poses are computed.
#[derive(Debug)]
pub(crate) struct Skeleton<'a> {
    pub(super) linkage: &'a Linkage,
    pub(super) closure: &'a Closure,
    /// Rotations with no driver locked.
    free: &'a [Rotation],
    /// Edge vectors in the drawing.
    vector: Vec<[f64; 2]>,
    /// Guide directions in the drawing; zero for edges without a guide.
    direction: Vec<[f64; 2]>,
    drawing: SkeletonPose,
    /// Unit of all lengths here, m.
    size: f64,
    /// Stops the work once true.
    pub(super) cancel: Option<&'a AtomicBool>,
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
        let drawing = SkeletonPose {
            points,
            turn: vec![0.0; classes],
            slide: vec![0.0; linkage.slides.len()],
        };
        Self { linkage, closure, free, vector, direction, drawing, size, cancel }
    }

    /// The drawing itself.
    #[must_use]
    pub(crate) fn drawing(&self) -> &SkeletonPose {
        &self.drawing
    }

    /// Unit of all lengths here, m.
    #[must_use]
    pub(crate) fn size(&self) -> f64 {
        self.size
    }

    /// Rotation of an edge's link since the drawing, as a unit vector.
    fn edge_rotation(&self, pose: &SkeletonPose, e: usize) -> Vector {
        Vector::at_angle(pose.turn[self.free[self.closure.edges[e].link].class])
    }

    /// Edge vector and guide direction in a pose.
    fn edge_vectors(&self, pose: &SkeletonPose, e: usize) -> ([f64; 2], [f64; 2]) {
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
    pub(crate) fn residual(&self, system: &System, pose: &SkeletonPose) -> DVector<f64> {
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
    pub(super) fn jacobian(&self, system: &System, pose: &SkeletonPose) -> SparseRows {
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

    /// Gradient of a weighted sum of the closure equations by the coordinates of all joints in the
    /// drawing (relative to the size), then by the angles of all guides.
    #[must_use]
    pub(crate) fn drawing_gradient(
        &self,
        system: &System,
        pose: &SkeletonPose,
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
                let translated = if self.closure.fixed[point] { weight } else { Vector::ZERO };
                let change = (translated - unrotated).scale(sign);
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
}

/// Index of the joint at a point; at least the number of joints if the point is not a joint,
/// `None` for the ground's origin.
fn joint_of_point(point: usize) -> Option<usize> {
    point.checked_sub(1)
}

/// Size of the linkage, from the joints that are pairs.
pub(super) fn paired_size(linkage: &Linkage) -> f64 {
    let mut trimmed = linkage.clone();
    let paired = |j: usize| linkage.links_at(j).nth(1).is_some();
    trimmed.joints = (0..linkage.joints.len())
        .filter(|&j| paired(j))
        .map(|j| linkage.joints[j].clone())
        .collect();
    if trimmed.joints.len() > 1 { trimmed.size() } else { linkage.size() }
}
