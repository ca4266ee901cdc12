//! A dyad's loop, sorted by what its edges turn with, and solved.

use super::closed_form::{DyadSolution, circle_and_line, turning_guide, two_circles, two_lines};
use crate::math::lanes::Real;
use crate::math::vector::Vector;
use crate::plan::dyad::{Dyad, Form, Unknown};
use crate::plan::leg::Leg;
use crate::plan::plan::EdgeSlide;
use crate::state::state::{Context, State};

/// The dyad's equation, sorted: `a u₁ + b u₂ = k` with slides put in for the
/// terms that are missing.
struct Sorted<R> {
    /// What turns with the first unknown, unless it is a leg.
    first: Vector<R>,
    /// What turns with the second unknown, or the direction of its slide.
    second: Vector<R>,
    /// The known rest.
    known: Vector<R>,
}

impl<R: Real, const G: usize> State<R, G> {
    /// Solves for the value of the unknowns.
    #[inline(always)]
    pub(crate) fn close(&mut self, g: usize, cx: &Context<'_>, dyad: &Dyad) -> DyadSolution<R> {
        let Sorted { first, second, known: k } = self.sorted(g, cx, dyad);
        let sign = if let Some(s) = dyad.sign { self.signs[s][g] } else { R::ONE };
        let data = self.data2(g, dyad);
        // A column of a rotation is measured in units of the greatest arm that turns
        // with it.
        let lever = |unknown: Unknown, per: R| match unknown {
            Unknown::Class(c) => R::splat(cx.bound.lever2[c]).max(data) * per,
            Unknown::Slide(_) => R::ONE,
        };
        let [u, v] = dyad.unknowns;
        let leg = |place: usize, vector: Vector<R>| {
            let rigid = &cx.bound.legs[dyad.index][place];
            if dyad.leg[place] { rigid.on_lanes() } else { Leg::of(vector) }
        };
        match dyad.form {
            Form::TwoCircles => {
                let (a, b) = (leg(0, first), leg(1, second));
                let (x, y, closed) = two_circles(&a, &b, k, sign);
                self.turn(g, cx, dyad, 0, a.turn_to(x));
                self.turn(g, cx, dyad, 1, b.turn_to(y));
                closed.with(lever(u, a.per).max(lever(v, b.per)))
            }
            Form::CircleAndLine => {
                let a = leg(0, first);
                let (x, s, closed) = circle_and_line(&a, second, k, sign);
                self.turn(g, cx, dyad, 0, x);
                self.slide(g, v, s);
                closed.with(lever(u, a.per))
            }
            Form::TurningGuide => {
                let rigid = Vector::splat(cx.bound.legs[dyad.index][0].vector);
                let a = if dyad.leg[0] { rigid } else { first };
                let (x, s, per, closed) = turning_guide(a, second, k, sign);
                self.turn(g, cx, dyad, 0, x);
                self.slide(g, v, s);
                closed.with(lever(u, per))
            }
            Form::TwoLines => {
                let (s, t, closed) = two_lines(first, second, k);
                self.slide(g, u, s);
                self.slide(g, v, t);
                closed
            }
        }
    }

    /// Square of the arm below which the rounding of the joints that a dyad hangs on is
    /// felt: half of their coordinates (more is within the margins of the bounds).
    #[inline(always)]
    pub(crate) fn data2(&self, g: usize, dyad: &Dyad) -> R {
        R::splat(0.25) * self.grain[dyad.start][g].max(self.grain[dyad.end][g])
    }

    /// Sums of the path, by what they turn with; legs are not in them.
    #[inline(always)]
    fn sorted(&self, g: usize, cx: &Context<'_>, dyad: &Dyad) -> Sorted<R> {
        let len = self.len;
        let mut terms = [Vector::ZERO; 2];
        let mut known = self.points[dyad.end * len][g] - self.points[dyad.start * len][g];
        for part in &dyad.others {
            let e = part.edge;
            let edge = &cx.plan.edges[e];
            let driven = cx.plan.orientations[edge.orientation].driven;
            let signed = |v: Vector<R>| if part.backward { -v } else { v };
            // By the part of the orientation that is known.
            let turned = |v: Vector<R>| match part.turns {
                None => self.orient[edge.orientation * len][g] * v,
                Some(_) if driven => self.phase[edge.orientation][g] * v,
                Some(_) => v,
            };
            let guide = Vector::splat(cx.bound.guide[e]);
            if let Some(place) = part.slides {
                terms[place] += signed(turned(guide));
            }
            if part.in_leg {
                continue;
            }
            let mut rigid = Vector::splat(cx.bound.rigid[e]);
            if let (EdgeSlide::Slide(slide) | EdgeSlide::Driver { slide }, None) =
                (edge.along, part.slides)
            {
                rigid += guide.scale(self.slides[slide * len][g]);
            }
            let v = signed(turned(rigid));
            match part.turns {
                Some(place) => terms[place] += v,
                None => known = known - v,
            }
        }
        Sorted { first: terms[0], second: terms[1], known }
    }

    #[inline(always)]
    fn turn(&mut self, g: usize, cx: &Context<'_>, dyad: &Dyad, place: usize, rotation: Vector<R>) {
        let Unknown::Class(class) = dyad.unknowns[place] else { return };
        self.class[class][g] = rotation;
        if dyad.leg[place] {
            let vector = cx.bound.legs[dyad.index][place].vector;
            self.legs[(2 * dyad.index + place) * self.len][g] = rotation * Vector::splat(vector);
        }
        for &o in &dyad.turned[place] {
            let driven = cx.plan.orientations[o].driven;
            self.orient[o * self.len][g] =
                if driven { rotation * self.phase[o][g] } else { rotation };
        }
    }

    #[inline(always)]
    fn slide(&mut self, g: usize, unknown: Unknown, value: R) {
        if let Unknown::Slide(slide) = unknown {
            self.slides[slide * self.len][g] = value;
        }
    }
}
