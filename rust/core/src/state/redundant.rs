//! Redundant links and slides: placed by what the others give, then checked.

use super::state::{Context, State};
use super::status::Fault;
use crate::math::lanes::{Mask, Real};
use crate::math::tolerance::{CLOSURE_PER_CONDITION, REDUNDANT_CLOSURE, REDUNDANT_MAX};
use crate::math::vector::Vector;
use crate::plan::plan::{AngleFrom, EdgeSlide, RedundantLink, Step};

impl<R: Real, const G: usize> State<R, G> {
    #[inline(always)]
    pub(crate) fn fit(&mut self, g: usize, cx: &Context<'_>, fit: &RedundantLink, index: usize) {
        let (gap, allowed) = self.place_redundant(g, cx, fit);
        self.open(g, gap.le(allowed).not(), || Fault::RedundantMisfit {
            step: index,
            gap: gap.lane(0),
        });
    }

    /// Places what is redundant; returns by how much it misses, and may.
    #[inline(always)]
    fn place_redundant(&mut self, g: usize, cx: &Context<'_>, fit: &RedundantLink) -> (R, R) {
        let pair_size = R::splat(cx.bound.pair_size);
        let mut gap = R::ZERO;
        let mut condition2 = R::ONE;
        match &fit.turned {
            None => {}
            Some(AngleFrom::Joints { link, first, second, points }) => {
                let rigid = |edge: &Option<usize>| edge.map_or(Vector::ZERO, |e| cx.bound.rigid[e]);
                gap = self.turn_by_joints(g, cx, *link, rigid(second) - rigid(first), *points);
                for &point in points {
                    condition2 = self.point_condition[point][g].max(condition2);
                }
            }
            Some(AngleFrom::Slide { link, slide }) => self.turn_by_slide(g, cx, *link, *slide),
        }
        for &(edge, backward) in &fit.places {
            self.place(g, cx, edge, backward);
        }
        for &edge in &fit.checks {
            gap = self.misfit(g, cx, edge).max(gap);
        }
        for &(slide, on) in &fit.parallel {
            // An angle misses by as much at the size of what is paired.
            gap = (self.angle_misfit(g, cx, slide, on) * pair_size).max(gap);
        }
        for &e in &fit.touched {
            let edge = &cx.plan.edges[e].edge;
            let ends = self.point_condition[edge.from][g].max(self.point_condition[edge.to][g]);
            condition2 = ends.max(condition2);
        }
        let allowed = (R::splat(CLOSURE_PER_CONDITION) * condition2.sqrt())
            .max(R::splat(REDUNDANT_CLOSURE) * pair_size)
            .min(R::splat(REDUNDANT_MAX) * pair_size);
        (gap, allowed)
    }

    /// Orientation from two joints that others carry; returns the misfit of
    /// their distance.
    #[inline(always)]
    fn turn_by_joints(
        &mut self,
        g: usize,
        cx: &Context<'_>,
        link: usize,
        arm: Vector,
        points: [usize; 2],
    ) -> R {
        let len = self.len;
        let o = cx.plan.link_orientation[link];
        let span = |state: &Self, k: usize| -> Vector<R> {
            state.points[points[1] * len + k][g] - state.points[points[0] * len + k][g]
        };
        let chord = span(self, 0);
        let (length, distance) = (R::splat(arm.norm()), chord.norm());
        let arm = Vector::splat(arm.conj());
        let per = R::ONE / (length * distance);
        self.set_orientation(g, cx, o, (chord * arm).scale(per));
        for k in 1..len {
            // chord = U · arm at every order, were it not for rounding.
            let unit = (span(self, k) * arm).scale(R::ONE / (length * length));
            let partial = self.orientation_without_top(g, cx, o, k);
            let rest = (unit - partial) * self.orient[o * len][g].conj();
            self.set_rate(g, cx, o, k, rest.y);
        }
        let condition = self.point_condition[points[0]][g].max(self.point_condition[points[1]][g]);
        self.class_condition[cx.plan.orientations[o].class][g] = condition;
        (distance - length).abs()
    }

    /// Orientation from a slide: the other link's, turned by a constant.
    #[inline(always)]
    fn turn_by_slide(&mut self, g: usize, cx: &Context<'_>, link: usize, slide: usize) {
        let len = self.len;
        let o = cx.plan.link_orientation[link];
        let (other, constant) = cx.bound.across_slide(cx.plan, link, slide);
        let from = cx.plan.link_orientation[other];
        let value = self.orient[from * len][g] * Vector::splat(constant);
        self.set_orientation(g, cx, o, value);
        for k in 1..len {
            let rate = self.theta_of(g, cx, from, k);
            self.set_rate(g, cx, o, k, rate);
        }
        self.class_condition[cx.plan.orientations[o].class][g] =
            self.class_condition[cx.plan.orientations[from].class][g];
    }

    #[inline(always)]
    fn set_orientation(&mut self, g: usize, cx: &Context<'_>, o: usize, value: Vector<R>) {
        let class = cx.plan.orientations[o].class;
        self.class[class][g] = value * self.phase[o][g].conj();
        self.orient[o * self.len][g] = value;
    }

    #[inline(always)]
    fn set_rate(&mut self, g: usize, cx: &Context<'_>, o: usize, k: usize, rate: R) {
        let class = cx.plan.orientations[o].class;
        self.theta[class * self.len + k][g] = rate;
        let partial = self.orientation_without_top(g, cx, o, k);
        self.orient[o * self.len + k][g] =
            partial + self.orient[o * self.len][g].left().scale(rate);
    }

    /// How far an edge misses its end; the slide along it takes its best value.
    #[inline(always)]
    fn misfit(&mut self, g: usize, cx: &Context<'_>, e: usize) -> R {
        let len = self.len;
        let edge = cx.plan.edges[e];
        let (from, to, o) = (edge.edge.from * len, edge.edge.to * len, edge.orientation * len);
        if let EdgeSlide::Slide(slide) = edge.along {
            for k in 0..len {
                // The span seen from the guide's link: conj(U) · ΔP, by Leibniz.
                let mut local = Vector::ZERO;
                for t in &cx.jets.product[k] {
                    let span = self.points[to + t.right][g] - self.points[from + t.right][g];
                    let part = span * self.orient[o + t.left][g].conj();
                    local += part.scale(R::splat(t.factor));
                }
                if k == 0 {
                    local = local - Vector::splat(cx.bound.rigid[e]);
                }
                self.slides[slide * len + k][g] = local.dot(Vector::splat(cx.bound.guide[e]));
            }
        }
        (self.points[to][g] - self.points[from][g] - self.edge(g, cx, e, 0)).norm()
    }

    /// How far two links miss their angle at a slide (a half turn: by 2); `on` carries it.
    #[inline(always)]
    fn angle_misfit(&self, g: usize, cx: &Context<'_>, slide: usize, on: usize) -> R {
        let (link, constant) = cx.bound.across_slide(cx.plan, on, slide);
        let turned =
            self.orient[cx.plan.link_orientation[link] * self.len][g] * Vector::splat(constant);
        let actual = self.orient[cx.plan.link_orientation[on] * self.len][g];
        (turned - actual).norm()
    }
}

impl State {
    /// Forgets where things are, so that what the next position leaves unsolved is NaN.
    pub(crate) fn forget(&mut self, cx: &Context<'_>) {
        let known = |point: usize| cx.plan.fixed[point];
        for (place, point) in self.points.iter_mut().enumerate() {
            if !known(place / self.len) {
                *point = [Vector::splat(Vector::new(f64::NAN, f64::NAN))];
            }
        }
        for (place, orient) in self.orient.iter_mut().enumerate() {
            if cx.plan.orientations[place / self.len].class != 0 {
                *orient = [Vector::splat(Vector::new(f64::NAN, f64::NAN))];
            }
        }
    }

    /// Whether all redundant parts fit whose places are solved; `None` if nothing is solved.
    pub(crate) fn fits(&mut self, cx: &Context<'_>) -> Option<bool> {
        let mut all = None;
        for step in &cx.plan.steps {
            match step {
                // Where a step is open, those behind it were not done.
                &Step::Place { edge, backward } => self.place_all(cx, edge, backward),
                Step::Redundant(fit) => {
                    let (gap, allowed) = self.place_redundant(0, cx, fit);
                    if self.is_solved(cx, fit) {
                        all = Some(all.unwrap_or(true) && gap <= allowed);
                    }
                }
                Step::Dyad(_) | Step::Group(_) => {}
            }
        }
        all
    }

    /// Whether everything that must fit is a number.
    fn is_solved(&self, cx: &Context<'_>, fit: &RedundantLink) -> bool {
        let known = |vector: &[Vector; 1]| vector[0].norm2().is_finite();
        let at = |point: usize| known(&self.points[point * self.len]);
        let mut edges = fit.touched.iter().map(|&e| &cx.plan.edges[e].edge);
        let mut links = fit.parallel.iter().flat_map(|&(slide, _)| cx.plan.slide_links[slide]);
        edges.all(|edge| at(edge.from) && at(edge.to))
            && links.all(|link| known(&self.orient[cx.plan.link_orientation[link] * self.len]))
    }
}
