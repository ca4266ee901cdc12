//! Loop equations of groups above class II: their residuals and their Jacobian.
//!
//! The equations are polynomials in unit vectors and slides, so all derivatives are exact. Entry
//! `k` of a jet gives the derivative of the residual by the drivers in the same way as entry 0
//! gives the residual.

use super::newton::Equations;
use super::turn::turned;
use crate::math::inverse::invert;
use crate::math::lanes::Real;
use crate::math::tolerance::NEWTON_MAX_STEP;
use crate::math::vector::Vector;
use crate::plan::dyad::Unknown;
use crate::plan::group::{Chord, Group};
use crate::plan::plan::EdgeSlide;
use crate::state::state::{Context, State};

/// The equations of a group of any links and joints.
pub(super) struct GroupEquations<'s, 'c, R: Real, const G: usize> {
    pub state: &'s mut State<R, G>,
    pub cx: &'c Context<'c>,
    pub group: &'c Group,
    /// Jacobian with its inverse beside it, then a right-hand side.
    pub matrix: Vec<[R; G]>,
}

impl<R: Real, const G: usize> Equations<R, G> for GroupEquations<'_, '_, R, G> {
    #[inline(always)]
    fn update(&mut self) {
        for (i, &unknown) in self.group.unknowns.iter().enumerate() {
            if let Unknown::Class(class) = unknown {
                self.state.set_orientations(self.cx, &self.group.orientations[i], class);
            }
        }
        self.state.update_edge_vectors(self.cx, self.group, 0);
    }

    #[inline(always)]
    fn invert(&mut self) -> [R; G] {
        self.state.jacobian(self.group, &mut self.matrix);
        invert(&mut self.matrix, self.group.rows)
    }

    #[inline(always)]
    fn inverse_size2(&self) -> [R; G] {
        let n = self.group.rows;
        let mut size2 = [R::ZERO; G];
        for (i, &unknown) in self.group.unknowns.iter().enumerate() {
            let max_arm2 = match unknown {
                Unknown::Class(class) => R::splat(self.cx.constants.max_arm2[class]),
                Unknown::Slide(_) => R::ONE,
            };
            let row = &self.matrix[i * 2 * n + n..][..n];
            for g in 0..G {
                let mut sum = R::ZERO;
                for entry in row {
                    sum += entry[g] * entry[g];
                }
                size2[g] += max_arm2 * sum;
            }
        }
        size2
    }

    #[inline(always)]
    fn curvature(&self) -> R {
        R::splat(self.cx.constants.curvature[self.group.index])
    }

    #[inline(always)]
    fn step(&mut self, done: &[R::Mask; G]) -> [R; G] {
        let (len, n) = (self.state.len, self.group.rows);
        let (inverse, residual) = self.matrix.split_at_mut(2 * n * n);
        self.state.group_residual(self.cx, self.group, 0, residual);
        let longest = R::splat(NEWTON_MAX_STEP);
        let mut largest = [R::ZERO; G];
        for (i, &unknown) in self.group.unknowns.iter().enumerate() {
            let row = &inverse[i * 2 * n + n..][..n];
            for g in 0..G {
                let mut step = R::ZERO;
                for (inverse, residual) in row.iter().zip(&residual[..n]) {
                    step = step - inverse[g] * residual[g];
                }
                let size = step.abs();
                // NaN must count as large, so that it does not look converged.
                largest[g] = R::select(size.le(largest[g]), largest[g], size);
                let step = R::select(done[g], R::ZERO, step.max(-longest).min(longest));
                match unknown {
                    Unknown::Class(class) => {
                        let old = self.state.pose.class[class][g];
                        let new = turned(old, step);
                        let x = R::select(done[g], old.x, new.x);
                        self.state.pose.class[class][g] =
                            Vector::new(x, R::select(done[g], old.y, new.y));
                    }
                    Unknown::Slide(slide) => {
                        let value = &mut self.state.pose.slides[slide * len][g];
                        *value += step;
                    }
                }
            }
        }
        largest
    }
}

impl<R: Real, const G: usize> State<R, G> {
    /// Computes entry `k` of the edges, guides and chords.
    #[inline(always)]
    pub(crate) fn update_edge_vectors(&mut self, cx: &Context<'_>, group: &Group, k: usize) {
        let len = self.len;
        for (i, edge) in group.edges.iter().enumerate() {
            if edge.is_bar {
                continue;
            }
            let leg = (group.first_leg + i) * len;
            if cx.plan.is_arm(group, i) {
                self.update_arm_vector(cx, edge.edge, leg, k);
                continue;
            }
            let e = edge.edge;
            let along = cx.plan.edges[e].along;
            let unit = &self.pose.orient[cx.plan.edges[e].orientation * len + k];
            let edge_vector = Vector::splat(cx.constants.edge_vector[e]);
            for g in 0..G {
                self.pose.legs[leg + k][g] = unit[g] * edge_vector;
            }
            if along == EdgeSlide::Nothing {
                continue;
            }
            let guide = Vector::splat(cx.constants.guide[e]);
            for g in 0..G {
                self.work.guides[i * len + k][g] = unit[g] * guide;
            }
            if let EdgeSlide::Slide(slide) | EdgeSlide::Driver { slide } = along {
                for term in &cx.derivatives.product[k] {
                    let factor = R::splat(term.factor);
                    for g in 0..G {
                        let s = factor * self.pose.slides[slide * len + term.right][g];
                        let v = self.work.guides[i * len + term.left][g].scale(s);
                        self.pose.legs[leg + k][g] += v;
                    }
                }
            }
        }
        self.close_loops(group, k);
    }

    /// Computes entry `k` of a rigid edge that turns with an unknown, from its lower entries.
    #[inline(always)]
    fn update_arm_vector(&mut self, cx: &Context<'_>, e: usize, leg: usize, k: usize) {
        let (o, class) = (cx.plan.edges[e].orientation, cx.plan.edges[e].class);
        let driven = cx.plan.orientations[o].driven;
        if k == 0 {
            let edge_vector = Vector::splat(cx.constants.edge_vector[e]);
            for g in 0..G {
                let rotation = self.pose.class[class][g];
                let unit = if driven { rotation * self.pose.phase[o][g] } else { rotation };
                self.pose.legs[leg][g] = unit * edge_vector;
            }
            return;
        }
        let mut sum = [Vector::ZERO; G];
        for term in &cx.derivatives.rotation[k] {
            let factor = R::splat(term.factor);
            for g in 0..G {
                let rate = factor * self.angle_analogue(g, cx, o, term.right);
                sum[g] += self.pose.legs[leg + term.left][g].scale(rate);
            }
        }
        for g in 0..G {
            if driven {
                sum[g] += self.pose.legs[leg][g].scale(Self::driver_analogue(cx, o, k));
            }
            self.pose.legs[leg + k][g] = sum[g].left();
        }
    }

    /// Computes entry `k` of the chords from the edges.
    #[inline(always)]
    pub(crate) fn close_loops(&mut self, group: &Group, k: usize) {
        let len = self.len;
        for (i, l) in group.loops.iter().enumerate() {
            let (start, end) =
                (&self.pose.points[l.start * len + k], &self.pose.points[l.end * len + k]);
            let mut sum = [Vector::ZERO; G];
            for g in 0..G {
                sum[g] = end[g] - start[g];
            }
            for path_edge in &l.path {
                let span = &self.pose.legs[(group.first_leg + path_edge.edge) * len + k];
                if path_edge.backward {
                    for g in 0..G {
                        sum[g] = sum[g] - span[g];
                    }
                } else {
                    for g in 0..G {
                        sum[g] += span[g];
                    }
                }
            }
            self.work.chords[i * len + k] = sum;
        }
    }

    /// Entry `k` of a chord's vector in its own frame, that is before it is turned.
    #[inline(always)]
    pub(crate) fn local(&self, g: usize, cx: &Context<'_>, e: usize, k: usize) -> Vector<R> {
        let mut local = Vector::ZERO;
        if k == 0 {
            local = Vector::splat(cx.constants.edge_vector[e]);
        }
        if let EdgeSlide::Driver { slide } = cx.plan.edges[e].along {
            let value = self.pose.slides[slide * self.len + k][g];
            local += Vector::splat(cx.constants.guide[e]).scale(value);
        }
        local
    }

    /// Entry `k` of the residuals of the equations.
    #[inline(always)]
    pub(crate) fn group_residual(
        &self,
        cx: &Context<'_>,
        group: &Group,
        k: usize,
        residual: &mut [[R; G]],
    ) {
        let len = self.len;
        let mut row = 0;
        for (i, l) in group.loops.iter().enumerate() {
            let e = group.edges[l.edge].edge;
            let mut sum = [R::ZERO; G];
            match l.chord {
                Chord::Whole => {
                    let (chord, span) = (
                        &self.work.chords[i * len + k],
                        &self.pose.legs[(group.first_leg + l.edge) * len + k],
                    );
                    for g in 0..G {
                        let v = chord[g] - span[g];
                        sum[g] = v.x;
                        residual[row + 1][g] = v.y;
                    }
                }
                Chord::Length { .. } => {
                    for term in &cx.derivatives.product[k] {
                        let factor = R::splat(term.factor);
                        let [a, b] =
                            [term.left, term.right].map(|k| &self.work.chords[i * len + k]);
                        for g in 0..G {
                            let c = self.local(g, cx, e, term.left);
                            let d = self.local(g, cx, e, term.right);
                            sum[g] += factor * (a[g].dot(b[g]) - c.dot(d));
                        }
                    }
                    for g in 0..G {
                        sum[g] = sum[g] * (R::splat(0.5) * self.work.inv_length[i][g]);
                    }
                }
                Chord::Guide { .. } => {
                    for term in &cx.derivatives.product[k] {
                        let factor = R::splat(term.factor);
                        let guide = &self.work.guides[l.edge * len + term.left];
                        let chord = &self.work.chords[i * len + term.right];
                        for g in 0..G {
                            sum[g] += factor * guide[g].cross(chord[g]);
                        }
                    }
                    if k == 0 {
                        let offset =
                            R::splat(cx.constants.guide[e].cross(cx.constants.edge_vector[e]));
                        for sum in &mut sum {
                            *sum = *sum - offset;
                        }
                    }
                }
            }
            residual[row] = sum;
            row += if l.chord == Chord::Whole { 2 } else { 1 };
        }
    }

    /// The Jacobian of the equations.
    #[inline(always)]
    pub(crate) fn jacobian(&self, group: &Group, matrix: &mut [[R; G]]) {
        let (len, n) = (self.len, group.rows);
        let mut row = 0;
        for (i, l) in group.loops.iter().enumerate() {
            let chord = &self.work.chords[i * len];
            // A change v of the chord changes the equation by v · across: along the chord for a
            // length, across the guide for a guide.
            let mut across = [Vector::ONE; G];
            for g in 0..G {
                match l.chord {
                    Chord::Whole => {}
                    Chord::Length { .. } => across[g] = chord[g].scale(self.work.inv_length[i][g]),
                    Chord::Guide { .. } => across[g] = self.work.guides[l.edge * len][g].left(),
                }
            }
            for (unknown, column) in l.columns.iter().enumerate() {
                let mut sum = [Vector::ZERO; G];
                for term in column {
                    let v = match term.edge {
                        None => chord,
                        Some(edge) if term.turns => &self.pose.legs[(group.first_leg + edge) * len],
                        Some(edge) => &self.work.guides[edge * len],
                    };
                    for g in 0..G {
                        let v = if term.turns { v[g].left() } else { v[g] };
                        sum[g] = if term.backward { sum[g] - v } else { sum[g] + v };
                    }
                }
                let at = row * 2 * n + unknown;
                if l.chord == Chord::Whole {
                    for g in 0..G {
                        matrix[at][g] = sum[g].x;
                        matrix[at + 2 * n][g] = sum[g].y;
                    }
                } else {
                    for g in 0..G {
                        matrix[at][g] = across[g].dot(sum[g]);
                    }
                }
            }
            row += if l.chord == Chord::Whole { 2 } else { 1 };
        }
    }

    /// Sets orientations of a class from its rotation.
    #[inline(always)]
    pub(crate) fn set_orientations(
        &mut self,
        cx: &Context<'_>,
        orientations: &[usize],
        class: usize,
    ) {
        let len = self.len;
        for &o in orientations {
            let driven = cx.plan.orientations[o].driven;
            for g in 0..G {
                let rotation = self.pose.class[class][g];
                self.pose.orient[o * len][g] =
                    if driven { rotation * self.pose.phase[o][g] } else { rotation };
            }
        }
    }
}
