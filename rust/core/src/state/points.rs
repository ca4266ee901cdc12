//! Points from known points, along edges.

use super::state::{Context, State};
use crate::math::lanes::Real;
use crate::math::vector::Vector;
use crate::plan::plan::EdgeSlide;
use crate::plan::tape::{PlaceKind, PlaceOp};

impl<R: Real, const G: usize> State<R, G> {
    /// Computes the point at one end of any edge from that at the other end, in one lane group.
    #[inline(always)]
    pub(crate) fn place(&mut self, g: usize, cx: &Context<'_>, e: usize, backward: bool) {
        let edge = &cx.plan.edges[e];
        let [from, to] = edge.ends(backward);
        for k in 0..self.len {
            let v = self.edge(g, cx, e, k);
            let base = self.pose.points[from * self.len + k][g];
            self.pose.points[to * self.len + k][g] = if backward { base - v } else { base + v };
        }
        let (start, end) =
            (self.pose.points[from * self.len][g], self.pose.points[to * self.len][g]);
        let arm = match edge.along {
            EdgeSlide::Nothing => R::splat(cx.constants.arm2[e]),
            _ => (end - start).norm2(),
        };
        self.conditions.coordinate_scale2[to][g] =
            self.conditions.coordinate_scale2[from][g].max(arm).max(end.norm2());
        let mut condition =
            self.conditions.of_point[from][g].max(self.conditions.of_class[edge.class][g]);
        if let EdgeSlide::Slide(slide) = edge.along {
            condition = condition.max(self.conditions.of_slide[slide][g]);
        }
        self.conditions.of_point[to][g] = condition;
    }

    /// Computes a point from another, in all lane groups.
    #[inline(always)]
    pub(crate) fn place_point(&mut self, cx: &Context<'_>, op: &PlaceOp) {
        self.place_of_length(cx, op, self.len);
        if op.is_recorded {
            self.record_point(cx, op);
        }
    }

    /// Value and analogues: jets of `len` entries.
    #[inline(always)]
    pub(crate) fn place_of_length(&mut self, cx: &Context<'_>, op: &PlaceOp, len: usize) {
        let jet = |i: usize| i * len..i * len + len;
        let groups = self.groups.min(G);
        if op.kind == PlaceKind::Along {
            for g in 0..groups {
                for k in 0..len {
                    let v = self.edge(g, cx, op.edge, k);
                    let base = self.pose.points[op.from * len + k][g];
                    self.pose.points[op.to * len + k][g] =
                        if op.backward { base - v } else { base + v };
                }
            }
            return;
        }
        let Ok([base, out]) = self.pose.points.get_disjoint_mut([op.from, op.to].map(jet)) else {
            return;
        };
        let ground = op.from_ground.then(|| Vector::splat(cx.constants.fixed[op.from]));
        let base = Base { column: base, ground };
        match op.kind {
            PlaceKind::Leg { leg, negative: false } => {
                let leg = &self.pose.legs[jet(leg)];
                for k in 0..len {
                    for g in 0..groups {
                        out[k][g] = base.entry(k, g) + leg[k][g];
                    }
                }
            }
            PlaceKind::Leg { leg, negative: true } => {
                let leg = &self.pose.legs[jet(leg)];
                for k in 0..len {
                    for g in 0..groups {
                        out[k][g] = base.entry(k, g) - leg[k][g];
                    }
                }
            }
            PlaceKind::OnLeg { leg } => {
                let part = directed(cx.constants.on_leg[op.edge], op.backward);
                let leg = &self.pose.legs[jet(leg)];
                for k in 0..len {
                    for g in 0..groups {
                        out[k][g] = base.entry(k, g) + leg[k][g] * part;
                    }
                }
            }
            PlaceKind::Rigid { orientation } => {
                let edge = directed(cx.constants.edge_vector[op.edge], op.backward);
                let orientation = &self.pose.orient[jet(orientation)];
                for k in 0..len {
                    for g in 0..groups {
                        out[k][g] = base.entry(k, g) + orientation[k][g] * edge;
                    }
                }
            }
            PlaceKind::Crank { driver, conj } => {
                let edge = cx.constants.edge_vector[op.edge];
                let edge = if op.backward { -edge } else { edge };
                let units = &self.pose.unit[driver];
                let one_driver = cx.derivatives.drivers == 1;
                for g in 0..groups {
                    let unit = if conj { units[g].conj() } else { units[g] };
                    let mut entry = unit.turn(edge);
                    out[0][g] = base.entry(0, g) + entry;
                    for k in 1..if one_driver { len } else { 1 } {
                        entry = if conj { -entry.left() } else { entry.left() };
                        out[k][g] = base.entry(k, g) + entry;
                    }
                }
                for k in if one_driver { len..len } else { 1..len } {
                    // Only derivatives by this driver alone are not 0.
                    let power = &cx.derivatives.powers[k];
                    let order = power[driver];
                    if power.iter().sum::<usize>() != order {
                        for g in 0..groups {
                            out[k][g] = base.entry(k, g) + Vector::ZERO;
                        }
                        continue;
                    }
                    for g in 0..groups {
                        let unit = if conj { units[g].conj() } else { units[g] };
                        let mut entry = unit.turn(edge);
                        for _ in 0..order {
                            entry = if conj { -entry.left() } else { entry.left() };
                        }
                        out[k][g] = base.entry(k, g) + entry;
                    }
                }
            }
            PlaceKind::Along => {}
        }
    }

    /// Records the size of a point's coordinates, and its condition.
    #[inline(always)]
    fn record_point(&mut self, cx: &Context<'_>, op: &PlaceOp) {
        let along = cx.plan.edges[op.edge].along;
        for g in 0..self.groups.min(G) {
            let (start, end) =
                (self.pose.points[op.from * self.len][g], self.pose.points[op.to * self.len][g]);
            let arm = match along {
                EdgeSlide::Nothing => R::splat(cx.constants.arm2[op.edge]),
                _ => (end - start).norm2(),
            };
            self.conditions.coordinate_scale2[op.to][g] =
                self.conditions.coordinate_scale2[op.from][g].max(arm).max(end.norm2());
            let mut condition =
                self.conditions.of_point[op.from][g].max(self.conditions.of_class[op.class][g]);
            if let EdgeSlide::Slide(slide) = along {
                condition = condition.max(self.conditions.of_slide[slide][g]);
            }
            self.conditions.of_point[op.to][g] = condition;
        }
    }
}

/// The point from which another is placed.
#[derive(Clone, Copy)]
struct Base<'a, R, const G: usize> {
    column: &'a [[Vector<R>; G]],
    /// A point of the ground, which needs no column.
    ground: Option<Vector<R>>,
}

impl<R: Real, const G: usize> Base<'_, R, G> {
    /// An entry of its jet.
    #[inline(always)]
    fn entry(&self, k: usize, g: usize) -> Vector<R> {
        match self.ground {
            Some(at) if k == 0 => at,
            Some(_) => Vector::ZERO,
            None => self.column[k][g],
        }
    }
}

/// A vector on every lane, reversed if it is traversed backward.
#[inline(always)]
fn directed<R: Real>(vector: Vector, backward: bool) -> Vector<R> {
    Vector::splat(if backward { -vector } else { vector })
}
