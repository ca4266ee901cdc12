//! The equations of groups above class II: what their loops miss, and the matrix of it.
//!
//! Polynomials in unit vectors and slides; so derivatives are exact, and those of the loops by the
//! coordinate (analogues) stand beside the equations themselves.

use crate::math::lanes::Real;
use crate::math::vector::Vector;
use crate::plan::group::{Chord, Group};
use crate::plan::plan::EdgeSlide;
use crate::state::state::{Context, State};

impl<R: Real, const G: usize> State<R, G> {
    /// Entry `k` of the edges, guides and chords.
    #[inline(always)]
    pub(crate) fn measure(&mut self, cx: &Context<'_>, group: &Group, k: usize) {
        let len = self.len;
        for (place, edge) in group.edges.iter().enumerate() {
            if edge.is_bar {
                continue;
            }
            let leg = (group.first_leg + place) * len;
            if cx.plan.is_arm(group, place) {
                self.measure_arm(cx, edge.edge, leg, k);
                continue;
            }
            let e = edge.edge;
            let along = cx.plan.edges[e].along;
            let unit = &self.orient[cx.plan.edges[e].orientation * len + k];
            let rigid = Vector::splat(cx.bound.rigid[e]);
            for g in 0..G {
                self.legs[leg + k][g] = unit[g] * rigid;
            }
            if along == EdgeSlide::Nothing {
                continue;
            }
            let guide = Vector::splat(cx.bound.guide[e]);
            for g in 0..G {
                self.guides[place * len + k][g] = unit[g] * guide;
            }
            if let EdgeSlide::Slide(slide) | EdgeSlide::Driver { slide } = along {
                for term in &cx.jets.product[k] {
                    let factor = R::splat(term.factor);
                    for g in 0..G {
                        let s = factor * self.slides[slide * len + term.right][g];
                        let v = self.guides[place * len + term.left][g].scale(s);
                        self.legs[leg + k][g] += v;
                    }
                }
            }
        }
        self.close_loops(group, k);
    }

    /// Entry `k` of a rigid edge that turns with an unknown: from its own entries before.
    #[inline(always)]
    fn measure_arm(&mut self, cx: &Context<'_>, e: usize, leg: usize, k: usize) {
        let (o, class) = (cx.plan.edges[e].orientation, cx.plan.edges[e].class);
        let driven = cx.plan.orientations[o].driven;
        if k == 0 {
            let rigid = Vector::splat(cx.bound.rigid[e]);
            for g in 0..G {
                let rotation = self.class[class][g];
                let unit = if driven { rotation * self.phase[o][g] } else { rotation };
                self.legs[leg][g] = unit * rigid;
            }
            return;
        }
        let mut sum = [Vector::ZERO; G];
        for term in &cx.jets.rotation[k] {
            let factor = R::splat(term.factor);
            for g in 0..G {
                let rate = factor * self.theta_of(g, cx, o, term.right);
                sum[g] += self.legs[leg + term.left][g].scale(rate);
            }
        }
        for g in 0..G {
            if driven {
                sum[g] += self.legs[leg][g].scale(Self::driven(cx, o, k));
            }
            self.legs[leg + k][g] = sum[g].left();
        }
    }

    /// Entry `k` of the chords, from the edges.
    #[inline(always)]
    pub(crate) fn close_loops(&mut self, group: &Group, k: usize) {
        let len = self.len;
        for (place, l) in group.loops.iter().enumerate() {
            let (start, end) = (&self.points[l.start * len + k], &self.points[l.end * len + k]);
            let mut sum = [Vector::ZERO; G];
            for g in 0..G {
                sum[g] = end[g] - start[g];
            }
            for piece in &l.path {
                let span = &self.legs[(group.first_leg + piece.place) * len + k];
                if piece.backward {
                    for g in 0..G {
                        sum[g] = sum[g] - span[g];
                    }
                } else {
                    for g in 0..G {
                        sum[g] += span[g];
                    }
                }
            }
            self.chords[place * len + k] = sum;
        }
    }

    /// Entry `k` of the vector in a chord's own frame, whose length it has.
    #[inline(always)]
    pub(crate) fn local(&self, g: usize, cx: &Context<'_>, e: usize, k: usize) -> Vector<R> {
        let mut local = Vector::ZERO;
        if k == 0 {
            local = Vector::splat(cx.bound.rigid[e]);
        }
        if let EdgeSlide::Driver { slide } = cx.plan.edges[e].along {
            let value = self.slides[slide * self.len + k][g];
            local += Vector::splat(cx.bound.guide[e]).scale(value);
        }
        local
    }

    /// What the equations miss at order `k`.
    #[inline(always)]
    pub(crate) fn miss(&self, cx: &Context<'_>, group: &Group, k: usize, missing: &mut [[R; G]]) {
        let len = self.len;
        let mut row = 0;
        for (place, l) in group.loops.iter().enumerate() {
            let e = group.edges[l.edge].edge;
            let mut sum = [R::ZERO; G];
            match l.chord {
                Chord::Whole => {
                    let (chord, span) = (
                        &self.chords[place * len + k],
                        &self.legs[(group.first_leg + l.edge) * len + k],
                    );
                    for g in 0..G {
                        let v = chord[g] - span[g];
                        sum[g] = v.x;
                        missing[row + 1][g] = v.y;
                    }
                }
                Chord::Length { .. } => {
                    for term in &cx.jets.product[k] {
                        let factor = R::splat(term.factor);
                        let [a, b] = [term.left, term.right].map(|k| &self.chords[place * len + k]);
                        for g in 0..G {
                            let c = self.local(g, cx, e, term.left);
                            let d = self.local(g, cx, e, term.right);
                            sum[g] += factor * (a[g].dot(b[g]) - c.dot(d));
                        }
                    }
                    for g in 0..G {
                        sum[g] = sum[g] * (R::splat(0.5) * self.per[place][g]);
                    }
                }
                Chord::Guide { .. } => {
                    for term in &cx.jets.product[k] {
                        let factor = R::splat(term.factor);
                        let guide = &self.guides[l.edge * len + term.left];
                        let chord = &self.chords[place * len + term.right];
                        for g in 0..G {
                            sum[g] += factor * guide[g].cross(chord[g]);
                        }
                    }
                    if k == 0 {
                        let own = R::splat(cx.bound.guide[e].cross(cx.bound.rigid[e]));
                        for sum in &mut sum {
                            *sum = *sum - own;
                        }
                    }
                }
            }
            missing[row] = sum;
            row += if l.chord == Chord::Whole { 2 } else { 1 };
        }
    }

    /// The matrix of the equations and, behind it, what they miss.
    #[inline(always)]
    pub(crate) fn linearise(&self, cx: &Context<'_>, group: &Group, matrix: &mut [[R; G]]) {
        let (len, n) = (self.len, group.rows);
        self.miss(cx, group, 0, &mut matrix[2 * n * n..]);
        let mut row = 0;
        for (place, l) in group.loops.iter().enumerate() {
            let chord = &self.chords[place * len];
            // A change v of the chord's vector changes the equations by its products with these;
            // the length's is along the chord, the guide's across the guide.
            let mut across = [Vector::ONE; G];
            for g in 0..G {
                match l.chord {
                    Chord::Whole => {}
                    Chord::Length { .. } => across[g] = chord[g].scale(self.per[place][g]),
                    Chord::Guide { .. } => across[g] = self.guides[l.edge * len][g].left(),
                }
            }
            for (unknown, column) in l.columns.iter().enumerate() {
                let mut sum = [Vector::ZERO; G];
                for influence in column {
                    let v = match influence.place {
                        None => chord,
                        Some(edge) if influence.turns => &self.legs[(group.first_leg + edge) * len],
                        Some(edge) => &self.guides[edge * len],
                    };
                    for g in 0..G {
                        let v = if influence.turns { v[g].left() } else { v[g] };
                        sum[g] = if influence.backward { sum[g] - v } else { sum[g] + v };
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

    /// The orientations of a class from its rotation.
    #[inline(always)]
    pub(crate) fn spread_rotation(
        &mut self,
        cx: &Context<'_>,
        orientations: &[usize],
        class: usize,
    ) {
        let len = self.len;
        for &o in orientations {
            let driven = cx.plan.orientations[o].driven;
            for g in 0..G {
                let rotation = self.class[class][g];
                self.orient[o * len][g] =
                    if driven { rotation * self.phase[o][g] } else { rotation };
            }
        }
    }
}
