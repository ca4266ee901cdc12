//! Real mobility: ranks of the closure equations, at the drawing and at a
//! random regular position.
//!
//! A drawing can be singular by chance (a four-bar drawn in line), and special
//! dimensions can make a counted structure move (a parallelogram with a third
//! bar). The two are told apart by moving the linkage: from the drawing along
//! its null space, back onto the closure by Gauss-Newton, and taking the rank
//! there. A shaky structure does not move and has mobility 0.

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

/// A displaced linkage: every point, the turn of every free class since the
/// drawing, the displacement of every slide. Lengths in units of the size.
#[derive(Debug, Clone)]
pub(crate) struct Pose {
    points: Vec<[f64; 2]>,
    turn: Vec<f64>,
    slide: Vec<f64>,
}

impl Pose {
    /// The pose after a step in the unknowns of a system.
    fn moved(&self, step: &DVector<f64>, system: &System) -> Self {
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

/// The closure equations of the kept part, with their unknowns.
#[derive(Debug, Clone)]
pub(crate) struct System {
    /// Kept edges, two rows each.
    pub edges: Vec<usize>,
    /// Columns.
    pub unknowns: Vec<Unknown>,
    /// Class of every link in this system.
    class_of: Vec<usize>,
    /// Columns by point (that of x), class and slide.
    of_point: Vec<Option<usize>>,
    of_class: Vec<Option<usize>>,
    of_slide: Vec<Option<usize>>,
}

impl System {
    /// Sets up the equations; `locked` takes the driven slides as known.
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
        let mut of_point = vec![None; closure.points];
        let mut of_class = vec![None; linkage.links.len()];
        let mut of_slide = vec![None; linkage.slides.len()];
        for (column, unknown) in unknowns.iter().enumerate() {
            match *unknown {
                Unknown::Point { point, axis: 0 } => of_point[point] = Some(column),
                Unknown::Point { .. } => {}
                Unknown::Class(class) => of_class[class] = Some(column),
                Unknown::Slide(slide) => of_slide[slide] = Some(column),
            }
        }
        Self { edges, unknowns, class_of, of_point, of_class, of_slide }
    }

    /// Number of scalar equations.
    #[must_use]
    pub(crate) fn rows(&self) -> usize {
        2 * self.edges.len()
    }
}

/// The geometry of the drawing, ready to be displaced.
#[derive(Debug)]
pub(crate) struct Skeleton<'a> {
    linkage: &'a Linkage,
    closure: &'a Closure,
    free: &'a [Rotation],
    vector: Vec<[f64; 2]>,
    direction: Vec<[f64; 2]>,
    start: Pose,
    /// Unit of all lengths here, m.
    size: f64,
    /// When true, work stops.
    cancel: Option<&'a AtomicBool>,
}

impl<'a> Skeleton<'a> {
    /// Takes the drawing; `free` are the rotations with no driver locked.
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
        let place = |at: [f64; 2]| [(at[0] - origin[0]) / size, (at[1] - origin[1]) / size];
        let mut points = vec![[0.0; 2]; closure.points];
        points[0] = place([0.0; 2]);
        for (j, joint) in linkage.joints.iter().enumerate() {
            points[super::closure::point_of_joint(j)] = place(joint.at);
        }
        for (l, &p) in closure.reference.iter().enumerate() {
            if let Some(at) = linkage.reference_point(l).filter(|_| p != 0) {
                points[p] = place(at);
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
        let start =
            Pose { points, turn: vec![0.0; classes], slide: vec![0.0; linkage.slides.len()] };
        Self { linkage, closure, free, vector, direction, start, size, cancel }
    }

    /// The drawing itself.
    #[must_use]
    pub(crate) fn drawing(&self) -> &Pose {
        &self.start
    }

    /// Unit of all lengths here, m.
    #[must_use]
    pub(crate) fn size(&self) -> f64 {
        self.size
    }

    /// How far the link of an edge has turned since the drawing.
    fn turn(&self, pose: &Pose, e: usize) -> Vector {
        Vector::at_angle(pose.turn[self.free[self.closure.edges[e].link].class])
    }

    /// Edge vector and guide direction in a pose.
    fn edge(&self, pose: &Pose, e: usize) -> ([f64; 2], [f64; 2]) {
        let edge = &self.closure.edges[e];
        let turn = self.turn(pose, e);
        let (sin, cos) = (turn.y, turn.x);
        let turned = |v: [f64; 2]| [cos * v[0] - sin * v[1], sin * v[0] + cos * v[1]];
        let d = turned(self.direction[e]);
        let s = edge.slide().map_or(0.0, |s| pose.slide[s]);
        let v = turned(self.vector[e]);
        ([v[0] + s * d[0], v[1] + s * d[1]], d)
    }

    /// How far every equation of a system is from being met in a pose.
    #[must_use]
    pub(crate) fn residual(&self, system: &System, pose: &Pose) -> DVector<f64> {
        let mut rows = Vec::with_capacity(system.rows());
        for &e in &system.edges {
            let edge = &self.closure.edges[e];
            let (v, _) = self.edge(pose, e);
            for (k, component) in v.iter().enumerate() {
                rows.push(pose.points[edge.to][k] - pose.points[edge.from][k] - component);
            }
        }
        DVector::from_vec(rows)
    }

    /// Derivatives of the closure equations: entries of every row, in the order of columns.
    fn jacobian(&self, system: &System, pose: &Pose) -> SparseRows {
        let mut rows = Vec::with_capacity(system.rows());
        for &e in &system.edges {
            let edge = &self.closure.edges[e];
            let (v, d) = self.edge(pose, e);
            let class = system.of_class[system.class_of[edge.link]];
            let slide = edge.slide().and_then(|slide| system.of_slide[slide]);
            for (axis, turned) in [v[1], -v[0]].into_iter().enumerate() {
                let mut row = Vec::with_capacity(4);
                if edge.from != edge.to {
                    row.extend(system.of_point[edge.to].map(|x| (x + axis, 1.0)));
                    row.extend(system.of_point[edge.from].map(|x| (x + axis, -1.0)));
                }
                row.extend(class.map(|column| (column, turned)));
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

    /// The same, where what nearly depends on others counts as dependent.
    ///
    /// # Errors
    ///
    /// [`Interrupted`].
    pub(crate) fn nearly_rank(&self, system: &System, pose: &Pose) -> Result<Rank, Interrupted> {
        self.rank_above(NEARLY_DEPENDENT, system, pose)
    }

    fn rank_above(&self, least: f64, system: &System, pose: &Pose) -> Result<Rank, Interrupted> {
        self.go_on()?;
        let (jacobian, unknowns) = (self.jacobian(system, pose), system.unknowns.len());
        rank::rank(jacobian, unknowns, least, || self.go_on().is_err())
    }

    /// Derivatives of a weighted sum of the closure equations by the drawing: the coordinates of
    /// all joints (of the size), then the angles of all guides.
    #[must_use]
    pub(crate) fn by_drawing(
        &self,
        system: &System,
        pose: &Pose,
        weights: &DVector<f64>,
    ) -> Vec<f64> {
        let joints = self.linkage.joints.len();
        let mut all = vec![0.0; 2 * joints + self.linkage.slides.len()];
        for (row, &e) in system.edges.iter().enumerate() {
            let edge = &self.closure.edges[e];
            let weight = Vector::new(weights[2 * row], weights[2 * row + 1]);
            // The equation is P_to − P_from − U · (w + s d), with w = P_to − P_from as drawn.
            let turned = self.turn(pose, e).conj() * weight;
            for (point, sign) in [(edge.to, 1.0), (edge.from, -1.0)] {
                let Some(joint) = joint_of_point(point).filter(|&j| j < joints) else { continue };
                let own = if self.closure.fixed[point] { weight } else { Vector::ZERO };
                let change = (own - turned).scale(sign);
                all[2 * joint] += change.x;
                all[2 * joint + 1] += change.y;
            }
            if let Some(slide) = edge.slide() {
                let guide = Vector::new(self.direction[e][0], self.direction[e][1]);
                all[2 * joints + slide] -= pose.slide[slide] * guide.left().dot(turned);
            }
        }
        all
    }

    fn go_on(&self) -> Result<(), Interrupted> {
        let stop = self.cancel.is_some_and(|flag| flag.load(Ordering::Relaxed));
        if stop { Err(Interrupted) } else { Ok(()) }
    }

    /// Positions to which the linkage lets itself be displaced from the drawing, along
    /// its null space in fixed pseudo-random directions, the most regular first.
    /// Empty: it is rigid.
    ///
    /// # Errors
    ///
    /// [`Interrupted`].
    pub(crate) fn displaced(&self, system: &System) -> Result<Vec<(Pose, Rank)>, Interrupted> {
        let here = self.rank(system, &self.start)?;
        if here.mobility == 0 {
            return Ok(Vec::new());
        }
        let mut random = 0x9E37_79B9_7F4A_7C15_u64;
        let mut found: Vec<(Pose, Rank)> = Vec::new();
        // Several, because a singular drawing lies on several branches of motion.
        for _ in 0..8 {
            for reach in [0.1, 0.03, -0.1, -0.03, 0.01, 0.003] {
                let weights =
                    DVector::from_fn(here.motions.ncols(), |_, _| next_random(&mut random));
                let direction = &here.motions * weights;
                let step = direction.scale(reach / direction.amax().max(f64::MIN_POSITIVE));
                if let Some(reached) = self.project(system, &self.start, &step)? {
                    let rank = self.rank(system, &reached)?;
                    found.push((reached, rank));
                    break;
                }
            }
        }
        found.sort_by_key(|(_, rank)| rank.mobility);
        Ok(found)
    }

    /// Gauss-Newton back onto the closure; None if it fails or goes back.
    fn project(
        &self,
        system: &System,
        from: &Pose,
        step: &DVector<f64>,
    ) -> Result<Option<Pose>, Interrupted> {
        let mut pose = from.moved(step, system);
        let mut total = step.clone();
        for _ in 0..30 {
            let residual = self.residual(system, &pose);
            if residual.amax() < REGULAR_CLOSURE {
                return Ok((total.amax() > 0.25 * step.amax()).then_some(pose));
            }
            let correction = self.correction(system, &pose, &residual, TRUNCATED)?;
            if !correction.amax().is_finite() || correction.amax() > 1.0 {
                return Ok(None);
            }
            total += &correction;
            pose = pose.moved(&correction, system);
        }
        Ok(None)
    }

    /// The same where equations that nearly depend on others are left as they are; and by how much
    /// these miss.
    ///
    /// # Errors
    ///
    /// [`Interrupted`].
    pub(crate) fn project_nearly(
        &self,
        system: &System,
        from: &Pose,
        step: &DVector<f64>,
    ) -> Result<Option<(Pose, f64)>, Interrupted> {
        let mut pose = from.moved(step, system);
        let mut total = step.clone();
        let mut before = f64::INFINITY;
        for _ in 0..30 {
            let residual = self.residual(system, &pose);
            let correction = self.correction(system, &pose, &residual, NEARLY_DEPENDENT)?;
            let length = correction.amax();
            if !length.is_finite() || length > 1.0 {
                return Ok(None);
            }
            total += &correction;
            pose = pose.moved(&correction, system);
            // Which of the equations are left unmet may change from step to step: then steps stay
            // as long as what these miss.
            let ends =
                length < REGULAR_CLOSURE || (length < NEARLY_REDUNDANT && length > 0.5 * before);
            before = length;
            if ends {
                let misfit = self.residual(system, &pose).amax();
                return Ok((total.amax() > 0.25 * step.amax()).then_some((pose, misfit)));
            }
        }
        Ok(None)
    }

    /// A step of Gauss-Newton.
    fn correction(
        &self,
        system: &System,
        pose: &Pose,
        residual: &DVector<f64>,
        least: f64,
    ) -> Result<DVector<f64>, Interrupted> {
        self.go_on()?;
        let (jacobian, unknowns) = (self.jacobian(system, pose), system.unknowns.len());
        Ok(-rank::solve(jacobian, unknowns, least, residual, || self.go_on().is_err())?)
    }

    /// The links that a motion (a vector over the unknowns) moves.
    #[must_use]
    pub(crate) fn moving_links(&self, system: &System, motions: &DMatrix<f64>) -> Vec<usize> {
        let moves = |wanted: &dyn Fn(Unknown) -> bool| {
            let rows = system.unknowns.iter().enumerate().filter(|(_, u)| wanted(**u));
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

    /// The links and slides whose equations take part in a self-stress, by name.
    #[must_use]
    pub(crate) fn stressed(&self, system: &System, stresses: &DMatrix<f64>) -> Vec<String> {
        let (links, slides) = self.under_stress(system, stresses);
        let links = links.into_iter().map(|l| self.linkage.links[l].name.clone());
        links.chain(slides.into_iter().map(|s| self.linkage.slides[s].name.clone())).collect()
    }

    /// The same by index: moving links, then slides.
    #[must_use]
    pub(crate) fn under_stress(
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

/// The joint at a point; what is no joint has a greater index than there are joints.
fn joint_of_point(point: usize) -> Option<usize> {
    point.checked_sub(1)
}

/// Greatest extent of the joints that are pairs.
fn paired_size(linkage: &Linkage) -> f64 {
    let mut trimmed = linkage.clone();
    let paired = |j: usize| linkage.links_at(j).nth(1).is_some();
    trimmed.joints = (0..linkage.joints.len())
        .filter(|&j| paired(j))
        .map(|j| linkage.joints[j].clone())
        .collect();
    if trimmed.joints.len() > 1 { trimmed.size() } else { linkage.size() }
}

/// xorshift64* in (−1, 1) (Marsaglia 2003, Vigna 2016); fixed seed, so that
/// the same description always gives the same answer.
fn next_random(state: &mut u64) -> f64 {
    *state ^= *state >> 12;
    *state ^= *state << 25;
    *state ^= *state >> 27;
    let bits = state.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11;
    // 53 bits fit a double exactly.
    let unit = bits as f64 / (1_u64 << 53) as f64;
    2.0 * unit - 1.0
}
