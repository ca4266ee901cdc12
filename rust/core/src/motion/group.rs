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
        self.iterate(g, cx, group, index, &mut matrix);
        if !self.is_over() {
            self.finish_group(g, cx, group, index, &mut matrix);
        }
        self.matrix = matrix;
    }

    #[inline(always)]
    fn iterate(
        &mut self,
        g: usize,
        cx: &Context<'_>,
        group: &Group,
        index: usize,
        matrix: &mut [R],
    ) {
        let n = group.rows;
        let mut done = R::Mask::NONE;
        for _ in 0..NEWTON_STEPS {
            self.linearise(g, cx, group, matrix);
            invert(matrix, n);
            let mut most = R::ZERO;
            for (place, &unknown) in group.unknowns.iter().enumerate() {
                let step = -times(matrix, n, place);
                // No number counts as great.
                most = R::select(step.abs().le(most), most, step.abs());
                match unknown {
                    Unknown::Class(class) => {
                        let old = self.class[class][g];
                        let new = turned(old, step);
                        let kept = R::select(done, old.x, new.x);
                        self.class[class][g] = Vector::new(kept, R::select(done, old.y, new.y));
                    }
                    Unknown::Slide(slide) => {
                        let value = &mut self.slides[slide * self.len][g];
                        *value = R::select(done, *value, *value + step);
                    }
                }
            }
            done = done.or(most.lt(R::splat(NEWTON_DONE)));
            if done.all() {
                return;
            }
        }
        self.care[g] = self.care[g].or(done.not());
        if R::LANES == 1 {
            self.fault = Some(Fault::Astray { step: index });
            self.status = Status::NotConverged;
        }
    }

    /// The matrix of the equations and, behind it, what they miss.
    #[inline(always)]
    fn linearise(&mut self, g: usize, cx: &Context<'_>, group: &Group, matrix: &mut [R]) {
        for (place, &unknown) in group.unknowns.iter().enumerate() {
            if let Unknown::Class(class) = unknown {
                let rotation = self.class[class][g];
                self.spread_rotation(g, cx, &group.turned[place], rotation);
            }
        }
        let n = group.rows;
        matrix[..2 * n * n].fill(R::ZERO);
        let mut row = 0;
        for l in &group.loops {
            let chord = self.chord(g, cx, l, 0);
            let missing = &mut matrix[2 * n * n..];
            match l.chord {
                Chord::Whole => {
                    let miss = chord - self.edge(g, cx, l.edge, 0);
                    missing[row] = miss.x;
                    missing[row + 1] = miss.y;
                }
                Chord::Length { .. } => {
                    let length2 = self.local(g, cx, l.edge, 0).norm2();
                    let per = R::splat(0.5) / length2.sqrt();
                    missing[row] = (chord.norm2() - length2) * per;
                }
                Chord::Guide { .. } => missing[row] = self.beside_guide(g, cx, l, 0),
            }
            for part in &l.path {
                let v = self.part(g, cx, part, 0);
                if let Some(place) = part.turns {
                    self.add_column(g, cx, l, (matrix, n), (row, place), chord, v.left());
                }
                if let Some(place) = part.slides {
                    let guide = self.guide(g, cx, part.edge, 0);
                    let v = if part.backward { -guide } else { guide };
                    self.add_column(g, cx, l, (matrix, n), (row, place), chord, v);
                }
            }
            self.add_own(g, cx, l, (matrix, n), row, chord);
            row += if l.chord == Chord::Whole { 2 } else { 1 };
        }
    }

    /// Adds the change `v` of the chord with the unknown at `place`.
    #[inline(always)]
    #[expect(clippy::too_many_arguments, reason = "a place in a matrix")]
    fn add_column(
        &self,
        g: usize,
        cx: &Context<'_>,
        l: &Loop,
        (matrix, n): (&mut [R], usize),
        (row, place): (usize, usize),
        chord: Vector<R>,
        v: Vector<R>,
    ) {
        let at = row * 2 * n + place;
        match l.chord {
            Chord::Whole => {
                matrix[at] += v.x;
                matrix[at + 2 * n] += v.y;
            }
            Chord::Length { .. } => {
                let per = R::ONE / self.local(g, cx, l.edge, 0).norm();
                matrix[at] += chord.dot(v) * per;
            }
            Chord::Guide { .. } => matrix[at] += self.guide(g, cx, l.edge, 0).cross(v),
        }
    }

    /// Adds what the chord itself changes with an unknown.
    #[inline(always)]
    fn add_own(
        &self,
        g: usize,
        cx: &Context<'_>,
        l: &Loop,
        (matrix, n): (&mut [R], usize),
        row: usize,
        chord: Vector<R>,
    ) {
        match (l.chord, l.turns) {
            (Chord::Whole, Some(place)) => {
                let v = self.edge(g, cx, l.edge, 0).left();
                let at = row * 2 * n + place;
                matrix[at] += -v.x;
                matrix[at + 2 * n] += -v.y;
            }
            (Chord::Guide { .. }, Some(place)) => {
                let turning = self.guide(g, cx, l.edge, 0).left();
                matrix[row * 2 * n + place] += turning.cross(chord);
            }
            _ => {}
        }
        if let (Chord::Whole, Some(place)) = (l.chord, l.slides) {
            let v = self.guide(g, cx, l.edge, 0);
            let at = row * 2 * n + place;
            matrix[at] += -v.x;
            matrix[at + 2 * n] += -v.y;
        }
    }

    /// Entry `k` of the vector along the chord, by the rest of the loop.
    #[inline(always)]
    fn chord(&self, g: usize, cx: &Context<'_>, l: &Loop, k: usize) -> Vector<R> {
        let [start, end] = [l.start, l.end].map(|point| self.points[point * self.len + k][g]);
        let mut sum = end - start;
        for part in &l.path {
            sum += self.part(g, cx, part, k);
        }
        sum
    }

    /// Entry `k` of an edge's vector in the frame of its class (rigid, or along a driven slide).
    #[inline(always)]
    fn local(&self, g: usize, cx: &Context<'_>, e: usize, k: usize) -> Vector<R> {
        let mut local = Vector::ZERO;
        if k == 0 {
            local = Vector::splat(cx.bound.rigid[e]);
        }
        if let Along::Driver { slide } | Along::Slide(slide) = cx.plan.edges[e].along {
            let value = self.slides[slide * self.len + k][g];
            local += Vector::splat(cx.bound.guide[e]).scale(value);
        }
        local
    }

    /// Entry `k` of a guide's direction.
    #[inline(always)]
    fn guide(&self, g: usize, cx: &Context<'_>, e: usize, k: usize) -> Vector<R> {
        let unit = self.orient[cx.plan.edges[e].orientation * self.len + k][g];
        unit * Vector::splat(cx.bound.guide[e])
    }

    /// Entry `k` of how far the chord's end is to the left of where its guide runs.
    #[inline(always)]
    fn beside_guide(&self, g: usize, cx: &Context<'_>, l: &Loop, k: usize) -> R {
        let mut sum = R::ZERO;
        for term in &cx.jets.product[k] {
            let guide = self.guide(g, cx, l.edge, term.left);
            let chord = self.chord(g, cx, l, term.right);
            sum += R::splat(term.factor) * guide.cross(chord);
        }
        if k == 0 {
            sum = sum - R::splat(cx.bound.guide[l.edge].cross(cx.bound.rigid[l.edge]));
        }
        sum
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

    /// Condition, analogues, and what the chords took with them.
    #[inline(always)]
    fn finish_group(
        &mut self,
        g: usize,
        cx: &Context<'_>,
        group: &Group,
        index: usize,
        matrix: &mut [R],
    ) {
        let n = group.rows;
        self.linearise(g, cx, group, matrix);
        self.determinants[group.index][g] = invert(matrix, n);
        let before = self.before_group(g, cx, group);
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
        self.condition2[g] = R::select(
            condition.le(self.condition2[g]),
            self.condition2[g],
            condition,
        );
        for &unknown in &group.unknowns {
            self.set_condition(g, unknown, condition);
        }
        for l in &group.loops {
            match l.chord {
                Chord::Length { class } => {
                    self.set_condition(g, Unknown::Class(class), condition);
                }
                Chord::Guide { slide } => {
                    self.set_condition(g, Unknown::Slide(slide), condition);
                }
                Chord::Whole => {}
            }
        }
        let flat = (condition * R::splat(FLAT2)).le(before).not();
        self.care[g] = self.care[g].or(flat);
        if R::LANES == 1 && flat.any() {
            self.fault.get_or_insert(Fault::Flat { step: index });
            self.status = Status::Singular;
        }
        self.group_analogues(g, cx, group, matrix);
        for k in 0..self.len {
            for l in &group.loops {
                self.take_along(g, cx, l, k);
            }
        }
    }

    #[inline(always)]
    fn set_condition(&mut self, g: usize, unknown: Unknown, condition: R) {
        match unknown {
            Unknown::Class(class) => self.class_condition[class][g] = condition,
            Unknown::Slide(slide) => self.slide_condition[slide][g] = condition,
        }
    }

    /// Square of the condition of what the group hangs on.
    #[inline(always)]
    fn before_group(&self, g: usize, cx: &Context<'_>, group: &Group) -> R {
        let mut before = R::ONE;
        for l in &group.loops {
            for point in [l.start, l.end] {
                before = before.max(self.point_condition[point][g]);
            }
            for part in &l.path {
                if part.turns.is_none() {
                    before = before.max(self.class_condition[cx.plan.class_of(part.edge)][g]);
                }
            }
        }
        before
    }

    /// Analogues of the unknowns: at every order the same matrix, as right-hand side what is
    /// known of that order.
    #[inline(always)]
    fn group_analogues(&mut self, g: usize, cx: &Context<'_>, group: &Group, matrix: &mut [R]) {
        let (len, n) = (self.len, group.rows);
        for k in 1..len {
            // What is yet unknown counts as 0.
            for (place, &unknown) in group.unknowns.iter().enumerate() {
                if let Unknown::Slide(slide) = unknown {
                    self.slides[slide * len + k][g] = R::ZERO;
                }
                for &o in &group.turned[place] {
                    self.orient[o * len + k][g] = self.orientation_without_top(g, cx, o, k);
                }
            }
            let mut row = 0;
            for l in &group.loops {
                match l.chord {
                    Chord::Whole => {
                        let miss = self.chord(g, cx, l, k) - self.edge(g, cx, l.edge, k);
                        matrix[2 * n * n + row] = miss.x;
                        matrix[2 * n * n + row + 1] = miss.y;
                        row += 1;
                    }
                    Chord::Length { .. } => {
                        let mut sum = R::ZERO;
                        for term in &cx.jets.product[k] {
                            let of = |k: usize| (self.chord(g, cx, l, k), self.local(g, cx, l.edge, k));
                            let ((a, c), (b, d)) = (of(term.left), of(term.right));
                            sum += R::splat(term.factor) * (a.dot(b) - c.dot(d));
                        }
                        let length = self.local(g, cx, l.edge, 0).norm();
                        matrix[2 * n * n + row] = sum * (R::splat(0.5) / length);
                    }
                    Chord::Guide { .. } => {
                        matrix[2 * n * n + row] = self.beside_guide(g, cx, l, k);
                    }
                }
                row += 1;
            }
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
        }
    }

    /// Entry `k` of what a chord took with it.
    #[inline(always)]
    fn take_along(&mut self, g: usize, cx: &Context<'_>, l: &Loop, k: usize) {
        let len = self.len;
        match l.chord {
            Chord::Whole => {}
            Chord::Guide { slide } => {
                let mut sum = R::ZERO;
                for term in &cx.jets.product[k] {
                    let guide = self.guide(g, cx, l.edge, term.left);
                    sum += R::splat(term.factor) * guide.dot(self.chord(g, cx, l, term.right));
                }
                if k == 0 {
                    sum = sum - R::splat(cx.bound.guide[l.edge].dot(cx.bound.rigid[l.edge]));
                }
                self.slides[slide * len + k][g] = sum;
            }
            Chord::Length { class } => {
                // chord = U · local at every order.
                let o = cx.plan.edges[l.edge].orientation;
                let mut rest = self.chord(g, cx, l, k);
                for term in &cx.jets.product[k] {
                    if term.left != k {
                        let local = self.local(g, cx, l.edge, term.right);
                        let known = self.orient[o * len + term.left][g] * local;
                        rest = rest - known.scale(R::splat(term.factor));
                    }
                }
                let local = self.local(g, cx, l.edge, 0);
                let unit = (rest * local.conj()).scale(R::ONE / local.norm2());
                if k == 0 {
                    let rotation = if cx.plan.orientations[o].driven {
                        unit * self.phase[o][g].conj()
                    } else {
                        unit
                    };
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
