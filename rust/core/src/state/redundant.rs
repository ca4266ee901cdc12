//! Redundant links and slides: placed from the links already solved, then checked for closure.

use super::state::{Context, State};
use super::status::Fault;
use crate::math::lanes::{Mask, Real};
use crate::math::tolerance::{CLOSURE_PER_CONDITION, REDUNDANT_CLOSURE, REDUNDANT_MAX};
use crate::math::vector::Vector;
use crate::plan::plan::{AngleFrom, EdgeSlide, RedundantLink, Step};

impl<R: Real, const G: usize> State<R, G> {
    #[inline(always)]
    pub(crate) fn check_redundant(
        &mut self,
        g: usize,
        cx: &Context<'_>,
        redundant: &RedundantLink,
        index: usize,
    ) {
        let (gap, allowed) = self.place_redundant(g, cx, redundant);
        self.mark_open(g, gap.le(allowed).not(), || Fault::RedundantMisfit {
            step: index,
            gap: gap.lane(0),
        });
    }

    /// Places a redundant part; returns its misfit and the allowed misfit.
    #[inline(always)]
    fn place_redundant(&mut self, g: usize, cx: &Context<'_>, redundant: &RedundantLink) -> (R, R) {
        let pair_size = R::splat(cx.constants.pair_size);
        let mut gap = R::ZERO;
        let mut condition2 = R::ONE;
        match &redundant.angle_from {
            None => {}
            Some(AngleFrom::Joints { link, first, second, points }) => {
                let edge_vector = |edge: &Option<usize>| {
                    edge.map_or(Vector::ZERO, |e| cx.constants.edge_vector[e])
                };
                gap = self.turn_by_joints(
                    g,
                    cx,
                    *link,
                    edge_vector(second) - edge_vector(first),
                    *points,
                );
                for &point in points {
                    condition2 = self.conditions.of_point[point][g].max(condition2);
                }
            }
            Some(AngleFrom::Slide { link, slide }) => self.turn_by_slide(g, cx, *link, *slide),
        }
        for &(edge, backward) in &redundant.places {
            self.place(g, cx, edge, backward);
        }
        for &edge in &redundant.checks {
            gap = self.misfit(g, cx, edge).max(gap);
        }
        for &(slide, on) in &redundant.parallel {
            // The displacement that the angle error causes at the size of the pairs.
            gap = (self.angle_misfit(g, cx, slide, on) * pair_size).max(gap);
        }
        for &e in &redundant.touched {
            let edge = &cx.plan.edges[e].edge;
            let ends =
                self.conditions.of_point[edge.from][g].max(self.conditions.of_point[edge.to][g]);
            condition2 = ends.max(condition2);
        }
        let allowed = (R::splat(CLOSURE_PER_CONDITION) * condition2.sqrt())
            .max(R::splat(REDUNDANT_CLOSURE) * pair_size)
            .min(R::splat(REDUNDANT_MAX) * pair_size);
        (gap, allowed)
    }

    /// Orientation from two joints that other links carry; returns the misfit of their distance.
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
        let chord = self.pose.points[points[1] * len][g] - self.pose.points[points[0] * len][g];
        let (length, distance) = (R::splat(arm.norm()), chord.norm());
        let arm = Vector::splat(arm.conj());
        let inverse = R::ONE / (length * distance);
        self.set_orientation(g, cx, o, (chord * arm).scale(inverse));
        for k in 1..len {
            // chord = U · arm at every order, up to rounding.
            let span =
                self.pose.points[points[1] * len + k][g] - self.pose.points[points[0] * len + k][g];
            let unit = (span * arm).scale(R::ONE / (length * length));
            let partial = self.orientation_without_top(g, cx, o, k);
            let rest = (unit - partial) * self.pose.orient[o * len][g].conj();
            self.set_rate(g, cx, o, k, rest.y);
        }
        let condition =
            self.conditions.of_point[points[0]][g].max(self.conditions.of_point[points[1]][g]);
        self.conditions.of_class[cx.plan.orientations[o].class][g] = condition;
        (distance - length).abs()
    }

    /// Orientation from a slide: that of its other link, turned by a constant.
    #[inline(always)]
    fn turn_by_slide(&mut self, g: usize, cx: &Context<'_>, link: usize, slide: usize) {
        let len = self.len;
        let o = cx.plan.link_orientation[link];
        let (other_link, constant) = cx.constants.across_slide(cx.plan, link, slide);
        let from = cx.plan.link_orientation[other_link];
        let value = self.pose.orient[from * len][g] * Vector::splat(constant);
        self.set_orientation(g, cx, o, value);
        for k in 1..len {
            let rate = self.angle_analogue(g, cx, from, k);
            self.set_rate(g, cx, o, k, rate);
        }
        self.conditions.of_class[cx.plan.orientations[o].class][g] =
            self.conditions.of_class[cx.plan.orientations[from].class][g];
    }

    #[inline(always)]
    fn set_orientation(&mut self, g: usize, cx: &Context<'_>, o: usize, value: Vector<R>) {
        let class = cx.plan.orientations[o].class;
        self.pose.class[class][g] = value * self.pose.phase[o][g].conj();
        self.pose.orient[o * self.len][g] = value;
    }

    #[inline(always)]
    fn set_rate(&mut self, g: usize, cx: &Context<'_>, o: usize, k: usize, rate: R) {
        let class = cx.plan.orientations[o].class;
        self.pose.theta[class * self.len + k][g] = rate;
        let partial = self.orientation_without_top(g, cx, o, k);
        self.pose.orient[o * self.len + k][g] =
            partial + self.pose.orient[o * self.len][g].left().scale(rate);
    }

    /// Distance by which an edge misses its end; sets the slide along it to its best value.
    #[inline(always)]
    fn misfit(&mut self, g: usize, cx: &Context<'_>, e: usize) -> R {
        let len = self.len;
        let edge = cx.plan.edges[e];
        let (from, to, o) = (edge.edge.from * len, edge.edge.to * len, edge.orientation * len);
        if let EdgeSlide::Slide(slide) = edge.along {
            for k in 0..len {
                // Jet of the edge in the frame of the guide's link: conj(U) · ΔP, by Leibniz.
                let mut local = Vector::ZERO;
                for t in &cx.derivatives.product[k] {
                    let span =
                        self.pose.points[to + t.right][g] - self.pose.points[from + t.right][g];
                    let v = span * self.pose.orient[o + t.left][g].conj();
                    local += v.scale(R::splat(t.factor));
                }
                if k == 0 {
                    local = local - Vector::splat(cx.constants.edge_vector[e]);
                }
                self.pose.slides[slide * len + k][g] =
                    local.dot(Vector::splat(cx.constants.guide[e]));
            }
        }
        (self.pose.points[to][g] - self.pose.points[from][g] - self.edge(g, cx, e, 0)).norm()
    }

    /// Misfit of the angle between the two links of a slide, as the distance of unit vectors (2 for
    /// a half turn); `on` carries the slide.
    #[inline(always)]
    fn angle_misfit(&self, g: usize, cx: &Context<'_>, slide: usize, on: usize) -> R {
        let (link, constant) = cx.constants.across_slide(cx.plan, on, slide);
        let turned = self.pose.orient[cx.plan.link_orientation[link] * self.len][g]
            * Vector::splat(constant);
        let actual = self.pose.orient[cx.plan.link_orientation[on] * self.len][g];
        (turned - actual).norm()
    }
}

impl State {
    /// Fills points and orientations with NaN, so that those the next position does not solve stay
    /// NaN.
    pub(crate) fn fill_nan(&mut self, cx: &Context<'_>) {
        let is_fixed = |point: usize| cx.plan.fixed[point];
        for (i, point) in self.pose.points.iter_mut().enumerate() {
            if !is_fixed(i / self.len) {
                *point = [Vector::splat(Vector::new(f64::NAN, f64::NAN))];
            }
        }
        for (i, orient) in self.pose.orient.iter_mut().enumerate() {
            if cx.plan.orientations[i / self.len].class != 0 {
                *orient = [Vector::splat(Vector::new(f64::NAN, f64::NAN))];
            }
        }
    }

    /// Whether all redundant parts whose points are solved fit; `None` if none is solved.
    pub(crate) fn redundant_links_fit(&mut self, cx: &Context<'_>) -> Option<bool> {
        let mut all = None;
        for step in &cx.plan.steps {
            match step {
                // The solver stops at a step that does not close; place the points after it here.
                &Step::Place { edge, backward } => self.place(0, cx, edge, backward),
                Step::Redundant(redundant) => {
                    let (gap, allowed) = self.place_redundant(0, cx, redundant);
                    if self.is_solved(cx, redundant) {
                        all = Some(all.unwrap_or(true) && gap <= allowed);
                    }
                }
                Step::Dyad(_) | Step::Group(_) | Step::Length { .. } => {}
            }
        }
        all
    }

    /// Whether all points and orientations that must fit are finite.
    fn is_solved(&self, cx: &Context<'_>, redundant: &RedundantLink) -> bool {
        let is_finite = |vector: &[Vector; 1]| vector[0].norm2().is_finite();
        let at = |point: usize| is_finite(&self.pose.points[point * self.len]);
        let mut edges = redundant.touched.iter().map(|&e| &cx.plan.edges[e].edge);
        let mut links =
            redundant.parallel.iter().flat_map(|&(slide, _)| cx.plan.slide_links[slide]);
        edges.all(|edge| at(edge.from) && at(edge.to))
            && links
                .all(|link| is_finite(&self.pose.orient[cx.plan.link_orientation[link] * self.len]))
    }
}
