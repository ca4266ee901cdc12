//! Solves a dyad: collects the terms of its loop by unknown, then applies its closed form.

use super::intersections::{Guided, TwoCircles};
use crate::math::lanes::Real;
use crate::math::vector::Vector;
use crate::plan::dyad::{Dyad, Form, LoopTerm, Unknown};
use crate::plan::dyad_constants::Sides;
use crate::plan::leg::Leg;
use crate::plan::plan::EdgeSlide;
use crate::state::closing::Closing;
use crate::state::state::{Context, State};

/// The dyad's equation `a u₁ + b u₂ = k`; for a slide the term is the slide times its direction.
struct CollectedTerms<R> {
    /// Vector that turns with the first unknown (or the direction of its slide), unless it is a
    /// leg.
    first: Vector<R>,
    /// The same for the second unknown.
    second: Vector<R>,
    /// Known right-hand side.
    right_side: Vector<R>,
}

impl<R: Real, const G: usize> State<R, G> {
    /// Solves a dyad for the values of its unknowns, and sets them.
    #[inline(always)]
    pub(crate) fn solve_dyad(&mut self, g: usize, cx: &Context<'_>, dyad: &Dyad) -> Closing<R> {
        let CollectedTerms { first, second, right_side: k } = self.collect_terms(g, cx, dyad);
        let sign = if let Some(s) = dyad.sign { self.pose.signs[s][g] } else { R::ONE };
        let [u, v] = dyad.unknowns;
        match dyad.form {
            Form::TwoCircles => {
                let (a, b) = (leg(cx, dyad, 0, first), leg(cx, dyad, 1, second));
                let solved = TwoCircles::solve::<true>([&a, &b], &Sides::of(&a, &b), k, sign);
                let [x, y] = solved.legs;
                self.set_rotation(g, cx, dyad, 0, a.turn_to(x));
                self.set_rotation(g, cx, dyad, 1, b.turn_to(y));
                solved.closing
            }
            Form::CircleAndLine => {
                let a = leg(cx, dyad, 0, first);
                let solved = Guided::circle_and_line::<true>(&a, second, k, sign, R::ZERO);
                self.set_rotation(g, cx, dyad, 0, a.turn_to(solved.turned));
                self.set_slide(g, v, solved.slide);
                solved.closing
            }
            Form::TurningGuide => {
                let constant = Vector::splat(cx.constants.legs[dyad.index][0].vector);
                let a = if dyad.leg[0] { constant } else { first };
                let solved = Guided::turning_guide::<true>(a, second, k, sign);
                self.set_rotation(g, cx, dyad, 0, solved.turned);
                self.set_slide(g, v, solved.slide);
                if !dyad.is_length {
                    return solved.closing;
                }
                let scale2 = &self.conditions.coordinate_scale2;
                let scale2 = scale2[dyad.start][g].max(scale2[dyad.end][g]);
                solved.closing.of_length(k.norm2(), second.cross(a), scale2)
            }
            Form::TwoLines => {
                let determinant = first.cross(second);
                let inverse = R::ONE / determinant;
                let (s, t) = (k.cross(second) * inverse, first.cross(k) * inverse);
                self.set_slide(g, u, s);
                self.set_slide(g, v, t);
                Closing::of_lines(s, t, determinant)
            }
        }
    }

    /// Sums the terms of the path by unknown, without the legs.
    #[inline(always)]
    fn collect_terms(&self, g: usize, cx: &Context<'_>, dyad: &Dyad) -> CollectedTerms<R> {
        let len = self.len;
        let mut terms = [Vector::ZERO; 2];
        let mut right_side =
            self.pose.points[dyad.end * len][g] - self.pose.points[dyad.start * len][g];
        for term in &dyad.others {
            let e = term.edge;
            let edge = &cx.plan.edges[e];
            let driven = cx.plan.orientations[edge.orientation].driven;
            // The known part of its orientation.
            let turn = match term.turns {
                None => Some(self.pose.orient[edge.orientation * len][g]),
                Some(_) if driven => Some(self.pose.phase[edge.orientation][g]),
                Some(_) => None,
            };
            let guide = Vector::splat(cx.constants.guide[e]);
            if let Some(i) = term.slides {
                terms[i] += signed(term, turned(turn, guide));
            }
            if term.in_leg {
                continue;
            }
            let mut edge_vector = Vector::splat(cx.constants.edge_vector[e]);
            if let (EdgeSlide::Slide(slide) | EdgeSlide::Driver { slide }, None) =
                (edge.along, term.slides)
            {
                edge_vector += guide.scale(self.pose.slides[slide * len][g]);
            }
            let v = signed(term, turned(turn, edge_vector));
            match term.turns {
                Some(i) => terms[i] += v,
                None => right_side = right_side - v,
            }
        }
        CollectedTerms { first: terms[0], second: terms[1], right_side }
    }

    #[inline(always)]
    fn set_rotation(
        &mut self,
        g: usize,
        cx: &Context<'_>,
        dyad: &Dyad,
        i: usize,
        rotation: Vector<R>,
    ) {
        let Unknown::Class(class) = dyad.unknowns[i] else { return };
        self.pose.class[class][g] = rotation;
        if dyad.leg[i] {
            let vector = cx.constants.legs[dyad.index][i].vector;
            self.pose.legs[(2 * dyad.index + i) * self.len][g] = rotation * Vector::splat(vector);
        }
        for &o in &dyad.orientations[i] {
            let driven = cx.plan.orientations[o].driven;
            self.pose.orient[o * self.len][g] =
                if driven { rotation * self.pose.phase[o][g] } else { rotation };
        }
    }

    #[inline(always)]
    fn set_slide(&mut self, g: usize, unknown: Unknown, value: R) {
        if let Unknown::Slide(slide) = unknown {
            self.pose.slides[slide * self.len][g] = value;
        }
    }
}

// Functions, not closures: these are always inlined into the code of a level.

/// One of a dyad's legs; `vector` if it is not constant.
#[inline(always)]
fn leg<R: Real>(cx: &Context<'_>, dyad: &Dyad, i: usize, vector: Vector<R>) -> Leg<R> {
    let constant = &cx.constants.legs[dyad.index][i];
    if dyad.leg[i] { constant.on_lanes() } else { Leg::of(vector) }
}

/// A vector in the direction in which its term is traversed.
#[inline(always)]
fn signed<R: Real>(term: &LoopTerm, v: Vector<R>) -> Vector<R> {
    if term.backward { -v } else { v }
}

/// A vector turned, unless there is nothing to turn it by.
#[inline(always)]
fn turned<R: Real>(turn: Option<Vector<R>>, v: Vector<R>) -> Vector<R> {
    if let Some(turn) = turn { turn * v } else { v }
}
