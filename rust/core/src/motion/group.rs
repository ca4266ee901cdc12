//! Groups above class II: Newton's iteration on their loops, and their analogues.
//!
//! The unknown rotations are unit vectors, turned by every step; the equations are polynomials
//! in them and in the slides, so the matrix is exact. It starts where the caller has put the
//! rotations and slides, on the way from the drawing.

use super::state::{Context, FLAT2, Fault, State, Status};
use crate::lanes::invert::invert;
use crate::lanes::{Mask, Real};
use crate::plan::group::{Chord, Group, Loop};
use crate::plan::{Along, Unknown};
use crate::plane::Vector;
use crate::tolerance::{NEWTON_DONE, NEWTON_STEPS};

impl<R: Real, const G: usize> State<R, G> {
    /// Solves the group (step `index`) from where its unknowns are.
    #[inline(always)]
    pub(crate) fn solve_group(&mut self, g: usize, cx: &Context<'_>, group: &Group, index: usize) {
        let mut matrix = std::mem::take(&mut self.matrix);
        let n = group.rows;
        let mut done = R::Mask::NONE;
        for step in 0..=NEWTON_STEPS {
            for (place, &unknown) in group.unknowns.iter().enumerate() {
                if let Unknown::Class(class) = unknown {
                    self.spread_rotation(g, cx, &group.turned[place], self.class[class][g]);
                }
            }
            self.measure(g, cx, group, 0);
            self.linearise(g, cx, group, &mut matrix);
            self.determinants[group.index][g] = invert(&mut matrix, n);
            if done.all() || step == NEWTON_STEPS {
                break;
            }
            let mut most = R::ZERO;
            for (place, &unknown) in group.unknowns.iter().enumerate() {
                let step = -times(&matrix, n, place);
                // No number counts as great.
                most = R::select(step.abs().le(most), most, step.abs());
                match unknown {
                    Unknown::Class(class) => {
                        let old = self.class[class][g];
                        let new = turned(old, step);
                        let x = R::select(done, old.x, new.x);
                        self.class[class][g] = Vector::new(x, R::select(done, old.y, new.y));
                    }
                    Unknown::Slide(slide) => {
                        let value = &mut self.slides[slide * self.len][g];
                        *value = R::select(done, *value, *value + step);
                    }
                }
            }
            done = done.or(most.lt(R::splat(NEWTON_DONE)));
        }
        self.care[g] = self.care[g].or(done.not());
        if R::LANES == 1 && !done.all() {
            self.fault = Some(Fault::Astray { step: index });
            self.status = Status::NotConverged;
        } else {
            self.judge(g, cx, group, index, &matrix);
            self.group_analogues(g, cx, group, &mut matrix);
        }
        self.matrix = matrix;
    }

    /// Entry `k` of the edges, guides and chords.
    #[inline(always)]
    fn measure(&mut self, g: usize, cx: &Context<'_>, group: &Group, k: usize) {
        let len = self.len;
        for (place, edge) in group.edges.iter().enumerate() {
            let e = edge.edge;
            let along = cx.plan.edges[e].along;
            let unit = self.orient[cx.plan.edges[e].orientation * len + k][g];
            let mut span = unit * Vector::splat(cx.bound.rigid[e]);
            if along != Along::Nothing {
                self.guides[place * len + k] = unit * Vector::splat(cx.bound.guide[e]);
            }
            if let Along::Slide(slide) | Along::Driver { slide } = along {
                for term in &cx.jets.product[k] {
                    let s = R::splat(term.factor) * self.slides[slide * len + term.right][g];
                    span += self.guides[place * len + term.left].scale(s);
                }
            }
            self.spans[place * len + k] = span;
        }
        for (place, l) in group.loops.iter().enumerate() {
            let [start, end] = [l.start, l.end].map(|point| self.points[point * len + k][g]);
            let mut sum = end - start;
            for piece in &l.path {
                let v = self.spans[piece.place * len + k];
                sum += if piece.backward { -v } else { v };
            }
            self.chords[place * len + k] = sum;
        }
    }

    /// Entry `k` of the vector in a chord's own frame, whose length it has.
    #[inline(always)]
    fn local(&self, g: usize, cx: &Context<'_>, e: usize, k: usize) -> Vector<R> {
        let mut local = Vector::ZERO;
        if k == 0 {
            local = Vector::splat(cx.bound.rigid[e]);
        }
        if let Along::Driver { slide } = cx.plan.edges[e].along {
            let value = self.slides[slide * self.len + k][g];
            local += Vector::splat(cx.bound.guide[e]).scale(value);
        }
        local
    }

    /// What the equations miss at order `k`, behind the matrix.
    #[inline(always)]
    fn miss(&self, g: usize, cx: &Context<'_>, group: &Group, k: usize, missing: &mut [R]) {
        let len = self.len;
        let mut row = 0;
        for (place, l) in group.loops.iter().enumerate() {
            let e = group.edges[l.edge].edge;
            match l.chord {
                Chord::Whole => {
                    let v = self.chords[place * len + k] - self.spans[l.edge * len + k];
                    missing[row] = v.x;
                    missing[row + 1] = v.y;
                    row += 1;
                }
                Chord::Length { .. } => {
                    let mut sum = R::ZERO;
                    for term in &cx.jets.product[k] {
                        let [a, b] = [term.left, term.right].map(|k| self.chords[place * len + k]);
                        let [c, d] = [term.left, term.right].map(|k| self.local(g, cx, e, k));
                        sum += R::splat(term.factor) * (a.dot(b) - c.dot(d));
                    }
                    missing[row] = sum * (R::splat(0.5) / self.local(g, cx, e, 0).norm());
                }
                Chord::Guide { .. } => {
                    let mut sum = R::ZERO;
                    for term in &cx.jets.product[k] {
                        let guide = self.guides[l.edge * len + term.left];
                        let chord = self.chords[place * len + term.right];
                        sum += R::splat(term.factor) * guide.cross(chord);
                    }
                    if k == 0 {
                        sum = sum - R::splat(cx.bound.guide[e].cross(cx.bound.rigid[e]));
                    }
                    missing[row] = sum;
                }
            }
            row += 1;
        }
    }

    /// The matrix of the equations and, behind it, what they miss.
    #[inline(always)]
    fn linearise(&self, g: usize, cx: &Context<'_>, group: &Group, matrix: &mut [R]) {
        let (len, n) = (self.len, group.rows);
        matrix[..2 * n * n].fill(R::ZERO);
        self.miss(g, cx, group, 0, &mut matrix[2 * n * n..]);
        let mut row = 0;
        for (place, l) in group.loops.iter().enumerate() {
            let e = group.edges[l.edge].edge;
            let chord = self.chords[place * len];
            // A change v of the chord's vector changes the equations by its products with these;
            // the length's is along the chord, the guide's across the guide.
            let [across, down] = match l.chord {
                Chord::Whole => [Vector::ONE, Vector::ONE.left()],
                Chord::Length { .. } => {
                    let per = R::ONE / self.local(g, cx, e, 0).norm();
                    [chord.scale(per), Vector::ZERO]
                }
                Chord::Guide { .. } => [self.guides[l.edge * len].left(), Vector::ZERO],
            };
            let is_whole = l.chord == Chord::Whole;
            let mut add = |unknown: usize, v: Vector<R>| {
                let at = row * 2 * n + unknown;
                matrix[at] += across.dot(v);
                if is_whole {
                    matrix[at + 2 * n] += down.dot(v);
                }
            };
            for piece in &l.path {
                let edge = &group.edges[piece.place];
                let turn = if piece.backward { -R::ONE } else { R::ONE };
                if let Some(unknown) = edge.turns {
                    add(unknown, self.spans[piece.place * len].left().scale(turn));
                }
                if let Some(unknown) = edge.slides {
                    add(unknown, self.guides[piece.place * len].scale(turn));
                }
            }
            let own = &group.edges[l.edge];
            match l.chord {
                Chord::Whole => {
                    if let Some(unknown) = own.turns {
                        add(unknown, -self.spans[l.edge * len].left());
                    }
                    if let Some(unknown) = own.slides {
                        add(unknown, -self.guides[l.edge * len]);
                    }
                }
                Chord::Guide { .. } => {
                    if let Some(unknown) = own.turns {
                        // The guide turns, which is as if the chord turned back.
                        add(unknown, -chord.left());
                    }
                }
                Chord::Length { .. } => {}
            }
            row += if is_whole { 2 } else { 1 };
        }
    }

    /// The orientations of a class from its rotation.
    #[inline(always)]
    fn spread_rotation(
        &mut self,
        g: usize,
        cx: &Context<'_>,
        orientations: &[usize],
        rotation: Vector<R>,
    ) {
        for &o in orientations {
            let driven = cx.plan.orientations[o].driven;
            self.orient[o * self.len][g] =
                if driven { rotation * self.phase[o][g] } else { rotation };
        }
    }

    /// Condition of the group and of all that hangs on it.
    #[inline(always)]
    fn judge(&mut self, g: usize, cx: &Context<'_>, group: &Group, index: usize, matrix: &[R]) {
        let n = group.rows;
        let mut before = R::ONE;
        for l in &group.loops {
            for point in [l.start, l.end] {
                before = before.max(self.point_condition[point][g]);
            }
        }
        for edge in group.edges.iter().filter(|edge| edge.turns.is_none()) {
            let class = cx.plan.class_of(edge.edge);
            let own = |l: &Loop| l.chord == Chord::Length { class };
            if !group.loops.iter().any(own) {
                before = before.max(self.class_condition[class][g]);
            }
        }
        let mut size2 = R::ZERO;
        for (place, &unknown) in group.unknowns.iter().enumerate() {
            // A column of a rotation is measured in units of the greatest arm that turns with it.
            let lever2 = match unknown {
                Unknown::Class(class) => R::splat(cx.bound.lever2[class]),
                Unknown::Slide(_) => R::ONE,
            };
            for column in 0..n {
                let entry = matrix[place * 2 * n + n + column];
                size2 += lever2 * (entry * entry);
            }
        }
        let condition = before * size2.max(R::ONE);
        // No number counts as great.
        let kept = condition.le(self.condition2[g]);
        self.condition2[g] = R::select(kept, self.condition2[g], condition);
        let taken = group.loops.iter().filter_map(|l| match l.chord {
            Chord::Length { class } => Some(Unknown::Class(class)),
            Chord::Guide { slide } => Some(Unknown::Slide(slide)),
            Chord::Whole => None,
        });
        for unknown in group.unknowns.iter().copied().chain(taken) {
            match unknown {
                Unknown::Class(class) => self.class_condition[class][g] = condition,
                Unknown::Slide(slide) => self.slide_condition[slide][g] = condition,
            }
        }
        let flat = (condition * R::splat(FLAT2)).le(before).not();
        self.care[g] = self.care[g].or(flat);
        if R::LANES == 1 && flat.any() {
            self.fault.get_or_insert(Fault::Flat { step: index });
            self.status = Status::Singular;
        }
    }

    /// Analogues of the unknowns: at every order the same matrix, as right-hand side what is
    /// known of that order; and what the chords took with them.
    #[inline(always)]
    fn group_analogues(&mut self, g: usize, cx: &Context<'_>, group: &Group, matrix: &mut [R]) {
        let (len, n) = (self.len, group.rows);
        for k in 0..len {
            if k > 0 {
                // What is yet unknown counts as 0.
                for (place, &unknown) in group.unknowns.iter().enumerate() {
                    if let Unknown::Slide(slide) = unknown {
                        self.slides[slide * len + k][g] = R::ZERO;
                    }
                    for &o in &group.turned[place] {
                        self.orient[o * len + k][g] = self.orientation_without_top(g, cx, o, k);
                    }
                }
                self.measure(g, cx, group, k);
                self.miss(g, cx, group, k, &mut matrix[2 * n * n..]);
                for (place, &unknown) in group.unknowns.iter().enumerate() {
                    let value = -times(matrix, n, place);
                    match unknown {
                        Unknown::Slide(slide) => self.slides[slide * len + k][g] = value,
                        Unknown::Class(class) => self.theta[class * len + k][g] = value,
                    }
                    for &o in &group.turned[place] {
                        let top = self.orient[o * len][g].left().scale(value);
                        self.orient[o * len + k][g] += top;
                    }
                }
                self.measure(g, cx, group, k);
            }
            for (place, l) in group.loops.iter().enumerate() {
                self.take_along(g, cx, group, (place, l), k);
            }
        }
    }

    /// Entry `k` of what a chord took with it.
    #[inline(always)]
    fn take_along(
        &mut self,
        g: usize,
        cx: &Context<'_>,
        group: &Group,
        (place, l): (usize, &Loop),
        k: usize,
    ) {
        let len = self.len;
        let e = group.edges[l.edge].edge;
        match l.chord {
            Chord::Whole => {}
            Chord::Guide { slide } => {
                let mut sum = R::ZERO;
                for term in &cx.jets.product[k] {
                    let guide = self.guides[l.edge * len + term.left];
                    let chord = self.chords[place * len + term.right];
                    sum += R::splat(term.factor) * guide.dot(chord);
                }
                if k == 0 {
                    sum = sum - R::splat(cx.bound.guide[e].dot(cx.bound.rigid[e]));
                }
                self.slides[slide * len + k][g] = sum;
            }
            Chord::Length { class } => {
                // chord = U · local at every order.
                let o = cx.plan.edges[e].orientation;
                let mut rest = self.chords[place * len + k];
                for term in &cx.jets.product[k] {
                    if term.left != k {
                        let known =
                            self.orient[o * len + term.left][g] * self.local(g, cx, e, term.right);
                        rest = rest - known.scale(R::splat(term.factor));
                    }
                }
                let local = self.local(g, cx, e, 0);
                let unit = (rest * local.conj()).scale(R::ONE / local.norm2());
                if k == 0 {
                    let driven = cx.plan.orientations[o].driven;
                    let rotation = if driven { unit * self.phase[o][g].conj() } else { unit };
                    self.class[class][g] = rotation;
                    self.spread_rotation(g, cx, &l.turned, rotation);
                    return;
                }
                let partial = self.orientation_without_top(g, cx, o, k);
                let rate = ((unit - partial) * self.orient[o * len][g].conj()).y;
                self.theta[class * len + k][g] = rate;
                for &o in &l.turned {
                    let partial = self.orientation_without_top(g, cx, o, k);
                    let top = self.orient[o * len][g].left().scale(rate);
                    self.orient[o * len + k][g] = partial + top;
                }
            }
        }
    }
}

/// A row of the inverse times what is missing.
#[inline(always)]
fn times<R: Real>(matrix: &[R], n: usize, row: usize) -> R {
    let mut sum = R::ZERO;
    for column in 0..n {
        sum += matrix[row * 2 * n + n + column] * matrix[2 * n * n + column];
    }
    sum
}

/// A unit vector turned by a small angle, and a unit vector again: by Cayley's rational rotation
/// (exact to the third order), then one step of Newton's for 1/√.
#[inline(always)]
fn turned<R: Real>(unit: Vector<R>, angle: R) -> Vector<R> {
    let half = angle * R::splat(0.5);
    let per = R::ONE / (R::ONE + half * half);
    let turn = Vector::new((R::ONE - half * half) * per, angle * per);
    let new = unit * turn;
    new.scale(R::splat(1.5) - R::splat(0.5) * new.norm2())
}
