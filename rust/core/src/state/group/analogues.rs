//! Analogues of groups above class II, and back substitution of the unknowns that chords eliminate.

use crate::math::lanes::Real;
use crate::math::vector::Vector;
use crate::plan::dyad::Unknown;
use crate::plan::group::{Chord, Group, Loop};
use crate::plan::plan::EdgeSlide;
use crate::state::state::{Context, State};

impl<R: Real, const G: usize> State<R, G> {
    /// Analogues of the unknowns and, by back substitution, of the chords. Every order has the same
    /// matrix (inverted); the right-hand side follows from lower orders.
    #[inline(always)]
    pub(crate) fn group_analogues(
        &mut self,
        cx: &Context<'_>,
        group: &Group,
        matrix: &mut [[R; G]],
    ) {
        let (len, n) = (self.len, group.rows);
        for k in 1..len {
            // The unknown entry counts as 0 in the right-hand side.
            for (i, &unknown) in group.unknowns.iter().enumerate() {
                if let Unknown::Slide(slide) = unknown {
                    self.pose.slides[slide * len + k] = [R::ZERO; G];
                }
                for &o in &group.orientations[i] {
                    for g in 0..G {
                        self.pose.orient[o * len + k][g] =
                            self.orientation_without_top(g, cx, o, k);
                    }
                }
            }
            self.update_edge_vectors(cx, group, k);
            self.group_residual(cx, group, k, &mut matrix[2 * n * n..]);
            for (i, &unknown) in group.unknowns.iter().enumerate() {
                let mut value = [R::ZERO; G];
                for column in 0..n {
                    let inverse = &matrix[i * 2 * n + n + column];
                    let residual = &matrix[2 * n * n + column];
                    for g in 0..G {
                        value[g] = value[g] - inverse[g] * residual[g];
                    }
                }
                match unknown {
                    Unknown::Slide(slide) => self.pose.slides[slide * len + k] = value,
                    Unknown::Class(class) => self.pose.theta[class * len + k] = value,
                }
                for &o in &group.orientations[i] {
                    for g in 0..G {
                        let top = self.pose.orient[o * len][g].left().scale(value[g]);
                        self.pose.orient[o * len + k][g] += top;
                    }
                }
            }
            self.add_top_terms(cx, group, k);
            self.back_substitute(cx, group, k);
        }
    }

    /// Adds the terms in entry `k` of the unknowns to entry `k` of edges and chords.
    #[inline(always)]
    fn add_top_terms(&mut self, cx: &Context<'_>, group: &Group, k: usize) {
        let len = self.len;
        for (i, edge) in group.edges.iter().enumerate() {
            let (at, leg) = (i * len, (group.first_leg + i) * len);
            if let Some(unknown) = edge.turns
                && let Unknown::Class(class) = group.unknowns[unknown]
            {
                let value = &self.pose.theta[class * len + k];
                let guided = cx.plan.edges[edge.edge].along != EdgeSlide::Nothing;
                for g in 0..G {
                    let top = self.pose.legs[leg][g].left();
                    self.pose.legs[leg + k][g] += top.scale(value[g]);
                    if guided {
                        let guide = self.work.guides[at][g].left();
                        self.work.guides[at + k][g] += guide.scale(value[g]);
                    }
                }
            }
            if let Some(unknown) = edge.slides
                && let Unknown::Slide(slide) = group.unknowns[unknown]
            {
                let value = &self.pose.slides[slide * len + k];
                for g in 0..G {
                    let guide = self.work.guides[at][g];
                    self.pose.legs[leg + k][g] += guide.scale(value[g]);
                }
            }
        }
        self.close_loops(group, k);
    }

    /// Entry `k` of the slides and rotations that the chords eliminate.
    #[inline(always)]
    pub(crate) fn back_substitute(&mut self, cx: &Context<'_>, group: &Group, k: usize) {
        for (i, l) in group.loops.iter().enumerate() {
            match l.chord {
                Chord::Whole => {}
                Chord::Guide { slide } => {
                    for g in 0..G {
                        self.back_substitute_slide(g, cx, group, (i, l), slide, k);
                    }
                }
                Chord::Length { class } => {
                    for g in 0..G {
                        self.back_substitute_rotation(g, cx, group, (i, l), class, k);
                    }
                }
            }
        }
    }

    #[inline(always)]
    fn back_substitute_slide(
        &mut self,
        g: usize,
        cx: &Context<'_>,
        group: &Group,
        (i, l): (usize, &Loop),
        slide: usize,
        k: usize,
    ) {
        let len = self.len;
        let e = group.edges[l.edge].edge;
        let mut sum = R::ZERO;
        for term in &cx.derivatives.product[k] {
            let guide = self.work.guides[l.edge * len + term.left][g];
            let chord = self.work.chords[i * len + term.right][g];
            sum += R::splat(term.factor) * guide.dot(chord);
        }
        if k == 0 {
            sum = sum - R::splat(cx.constants.guide[e].dot(cx.constants.edge_vector[e]));
        }
        self.pose.slides[slide * len + k][g] = sum;
    }

    /// Rotation U of a chord, from chord = U · local at every order.
    #[inline(always)]
    fn back_substitute_rotation(
        &mut self,
        g: usize,
        cx: &Context<'_>,
        group: &Group,
        (i, l): (usize, &Loop),
        class: usize,
        k: usize,
    ) {
        let len = self.len;
        let e = group.edges[l.edge].edge;
        let chord_orientation = cx.plan.edges[e].orientation;
        let inv_length = self.work.inv_length[i][g];
        let inv_length2 = inv_length * inv_length;
        if k == 0 {
            let local = self.local(g, cx, e, 0);
            let unit = (self.work.chords[i * len][g] * local.conj()).scale(inv_length2);
            let driven = cx.plan.orientations[chord_orientation].driven;
            let rotation =
                if driven { unit * self.pose.phase[chord_orientation][g].conj() } else { unit };
            self.pose.class[class][g] = rotation;
            for &o in &l.orientations {
                let driven = cx.plan.orientations[o].driven;
                self.pose.orient[o * len][g] =
                    if driven { rotation * self.pose.phase[o][g] } else { rotation };
            }
            return;
        }
        let rate = if let EdgeSlide::Driver { .. } = cx.plan.edges[e].along {
            // Solve Leibniz's sum for the top entry of U.
            let mut rest = self.work.chords[i * len + k][g];
            for term in cx.derivatives.product[k].iter().filter(|term| term.left != k) {
                let lower = self.pose.orient[chord_orientation * len + term.left][g]
                    * self.local(g, cx, e, term.right);
                rest = rest - lower.scale(R::splat(term.factor));
            }
            let unit = (rest * self.local(g, cx, e, 0).conj()).scale(inv_length2);
            let partial = self.orientation_without_top(g, cx, chord_orientation, k);
            ((unit - partial) * self.pose.orient[chord_orientation * len][g].conj()).y
        } else {
            // The chord is rigid: its jet follows from its lower entries.
            let mut partial = Vector::ZERO;
            for term in &cx.derivatives.rotation[k] {
                let rate = R::splat(term.factor)
                    * self.angle_analogue(g, cx, chord_orientation, term.right);
                partial += self.work.chords[i * len + term.left][g].scale(rate);
            }
            let top = self.work.chords[i * len + k][g] - partial.left();
            let rate = self.work.chords[i * len][g].cross(top) * inv_length2;
            let driven = cx.plan.orientations[chord_orientation].driven;
            if driven { rate - Self::driver_analogue(cx, chord_orientation, k) } else { rate }
        };
        self.pose.theta[class * len + k][g] = rate;
        for &o in &l.orientations {
            let top = self.pose.orient[o * len][g].left().scale(rate);
            self.pose.orient[o * len + k][g] = self.orientation_without_top(g, cx, o, k) + top;
        }
    }
}
