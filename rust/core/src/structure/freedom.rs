//! Real mobility: ranks of the closure equations, at the drawing and at a
//! random regular position.
//!
//! A drawing can be singular by chance (a four-bar drawn in line), and special
//! dimensions can make a counted structure move (a parallelogram with a third
//! bar). The two are told apart by moving the linkage: from the drawing along
//! its null space, back onto the closure by Gauss-Newton, and taking the rank
//! there. A shaky structure does not move and has mobility 0.

use nalgebra::{DMatrix, DVector};

use super::closure::{Closure, LeftOut, Rotation, Span};
use crate::linkage::{Driver, Linkage};
use crate::tolerance::{RANK, REGULAR_CLOSURE};

/// A displaced linkage: every point, the turn of every free class since the
/// drawing, the displacement of every slide. Lengths in units of the size.
#[derive(Debug, Clone)]
pub struct Pose {
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
pub enum Unknown {
    /// x (0) or y (1) of a point.
    Point { point: usize, axis: usize },
    /// Rotation of a class.
    Class(usize),
    /// Value of a slide.
    Slide(usize),
}

/// The closure equations of the kept part, with their unknowns.
#[derive(Debug, Clone)]
pub struct System {
    /// Kept edges, two rows each.
    pub edges: Vec<usize>,
    /// Columns.
    pub unknowns: Vec<Unknown>,
    /// Class of every link in this system.
    class_of: Vec<usize>,
}

impl System {
    /// Sets up the equations; `locked` takes the driven slides as known.
    #[must_use]
    pub fn new(
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
        Self { edges, unknowns, class_of }
    }

    /// Number of scalar equations.
    #[must_use]
    pub fn rows(&self) -> usize {
        2 * self.edges.len()
    }
}

/// A rank with the spaces that belong to it.
#[derive(Debug, Clone)]
pub struct Rank {
    /// Unknowns minus rank.
    pub mobility: usize,
    /// Equations minus rank.
    pub excess: usize,
    /// Columns that span the motions the equations allow (rows: unknowns).
    pub motions: DMatrix<f64>,
    /// Columns that span the self-stresses, the dependent equations (rows: equations).
    pub stresses: DMatrix<f64>,
}

/// The geometry of the drawing, ready to be displaced.
#[derive(Debug)]
pub struct Skeleton<'a> {
    linkage: &'a Linkage,
    closure: &'a Closure,
    free: &'a [Rotation],
    vector: Vec<[f64; 2]>,
    direction: Vec<[f64; 2]>,
    start: Pose,
}

impl<'a> Skeleton<'a> {
    /// Takes the drawing; `free` are the rotations with no driver locked.
    #[must_use]
    pub fn new(
        linkage: &'a Linkage,
        closure: &'a Closure,
        free: &'a [Rotation],
        classes: usize,
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
                    let (sin, cos) = linkage.slides[slide].angle.sin_cos();
                    [cos, sin]
                }
                Span::Joint { .. } => [0.0; 2],
            })
            .collect();
        let start =
            Pose { points, turn: vec![0.0; classes], slide: vec![0.0; linkage.slides.len()] };
        Self { linkage, closure, free, vector, direction, start }
    }

    /// The drawing itself.
    #[must_use]
    pub fn drawing(&self) -> &Pose {
        &self.start
    }

    /// Edge vector and guide direction in a pose.
    fn edge(&self, pose: &Pose, e: usize) -> ([f64; 2], [f64; 2]) {
        let edge = &self.closure.edges[e];
        let (sin, cos) = pose.turn[self.free[edge.link].class].sin_cos();
        let turned = |v: [f64; 2]| [cos * v[0] - sin * v[1], sin * v[0] + cos * v[1]];
        let d = turned(self.direction[e]);
        let s = edge.slide().map_or(0.0, |s| pose.slide[s]);
        let v = turned(self.vector[e]);
        ([v[0] + s * d[0], v[1] + s * d[1]], d)
    }

    fn residual(&self, system: &System, pose: &Pose) -> DVector<f64> {
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

    fn jacobian(&self, system: &System, pose: &Pose) -> DMatrix<f64> {
        let mut j = DMatrix::zeros(system.rows(), system.unknowns.len());
        for (row, &e) in system.edges.iter().enumerate() {
            let edge = &self.closure.edges[e];
            let (v, d) = self.edge(pose, e);
            for (column, unknown) in system.unknowns.iter().enumerate() {
                let [x, y] = match *unknown {
                    Unknown::Point { point, axis } => {
                        let sign = f64::from(u8::from(point == edge.to))
                            - f64::from(u8::from(point == edge.from));
                        if axis == 0 { [sign, 0.0] } else { [0.0, sign] }
                    }
                    Unknown::Class(class) if system.class_of[edge.link] == class => [v[1], -v[0]],
                    Unknown::Slide(slide) if edge.slide() == Some(slide) => [-d[0], -d[1]],
                    _ => [0.0, 0.0],
                };
                j[(2 * row, column)] = x;
                j[(2 * row + 1, column)] = y;
            }
        }
        j
    }

    /// Rank, motions and self-stresses of a system in a pose.
    #[must_use]
    pub fn rank(&self, system: &System, pose: &Pose) -> Rank {
        let mut j = self.jacobian(system, pose);
        let (m, n) = j.shape();
        let mut scale = vec![1.0; n];
        for (column, factor) in scale.iter_mut().enumerate() {
            let norm = j.column(column).norm();
            if norm > 0.0 {
                *factor = 1.0 / norm;
                j.column_mut(column).scale_mut(*factor);
            }
        }
        // Square, so that the decomposition has both null spaces.
        let side = m.max(n).max(1);
        let svd = j.resize(side, side, 0.0).svd(true, true);
        let greatest = svd.singular_values.max();
        let small: Vec<usize> =
            (0..side).filter(|&i| svd.singular_values[i] <= RANK * greatest).collect();
        let empty = DMatrix::zeros(side, side);
        let (u, vt) = (svd.u.as_ref().unwrap_or(&empty), svd.v_t.as_ref().unwrap_or(&empty));
        let rank = side - small.len();
        // The null spaces of the padded matrix, cut to the real rows or columns,
        // still span the real ones.
        let span = |count: usize, dimension: usize, of: &dyn Fn(usize, usize) -> f64| {
            let columns = if dimension == 0 { 0 } else { small.len() };
            DMatrix::from_fn(count, columns, |row, k| of(row, small[k]))
        };
        let (mobility, excess) = (n - rank, m - rank);
        let motions = span(n, mobility, &|row, i| vt[(i, row)] * scale[row]);
        let stresses = span(m, excess, &|row, i| u[(row, i)]);
        Rank { mobility, excess, motions, stresses }
    }

    /// Positions to which the linkage lets itself be displaced from the drawing, along
    /// its null space in fixed pseudo-random directions, the most regular first.
    /// Empty: it is rigid.
    #[must_use]
    pub fn displaced(&self, system: &System) -> Vec<(Pose, Rank)> {
        let here = self.rank(system, &self.start);
        if here.mobility == 0 {
            return Vec::new();
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
                if let Some(reached) = self.project(system, &self.start, &step) {
                    let rank = self.rank(system, &reached);
                    found.push((reached, rank));
                    break;
                }
            }
        }
        found.sort_by_key(|(_, rank)| rank.mobility);
        found
    }

    /// Gauss-Newton back onto the closure; None if it fails or goes back.
    fn project(&self, system: &System, from: &Pose, step: &DVector<f64>) -> Option<Pose> {
        let mut pose = from.moved(step, system);
        let mut total = step.clone();
        for _ in 0..30 {
            let residual = self.residual(system, &pose);
            if residual.amax() < REGULAR_CLOSURE {
                return (total.amax() > 0.25 * step.amax()).then_some(pose);
            }
            let svd = self.jacobian(system, &pose).svd(true, true);
            // Only directions that are not (nearly) dependent are corrected.
            let correction = -svd.solve(&residual, 1e-6 * svd.singular_values.max()).ok()?;
            if !correction.amax().is_finite() || correction.amax() > 1.0 {
                return None;
            }
            total += &correction;
            pose = pose.moved(&correction, system);
        }
        None
    }

    /// The links that a motion (a vector over the unknowns) moves.
    #[must_use]
    pub fn moving_links(&self, system: &System, motions: &DMatrix<f64>) -> Vec<usize> {
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
    pub fn stressed(&self, system: &System, stresses: &DMatrix<f64>) -> Vec<String> {
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
        let links = links.into_iter().map(|l| self.linkage.links[l].name.clone());
        links.chain(slides.into_iter().map(|s| self.linkage.slides[s].name.clone())).collect()
    }
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
