//! The quick way of groups above class II: their unknowns at all knots from those of the drawing.
//!
//! A design near the drawing moves nearly as it does; so the iteration starts, at all knots at
//! once, where the drawing is. What it comes to is held to what the walk holds its knots to: from
//! each knot the next is foretold, and the first is told from the drawing.

use std::f64::consts::TAU;

use super::branch::Track;
use super::hermite::Cell;
use super::homotopy::{FIRST_STEP, LATER_STEPS};
use super::tracer::{returns, strays};
use super::uniform::{CELL, GROUPS, KNOTS, Quick, knots_at};
use crate::math::lanes::{LANES, Lanes, Real};
use crate::math::vector::Vector;
use crate::plan::dyad::Unknown;
use crate::plan::plan::Plan;
use crate::state::state::Context;

/// Unknowns of groups at the knots of the drawing's way.
#[derive(Debug)]
pub(crate) struct Template {
    /// Rotations, or slides (m) in the place of their x.
    unknowns: Vec<[Vector<Lanes>; GROUPS]>,
    /// Signs of the groups' determinants.
    bends: Vec<bool>,
}

impl Template {
    /// From a way from `q0` that returns after one turn, of a design of this scale.
    pub(crate) fn of(plan: &Plan, track: &Track, q0: f64, scale: f64) -> Option<Self> {
        if track.period != Some(TAU) {
            return None;
        }
        let list: Vec<Unknown> = plan.groups().flat_map(|g| g.unknowns.clone()).collect();
        let of = |(place, &unknown): (usize, &Unknown)| {
            std::array::from_fn(|group| {
                let spot = track.spot(knots_at(q0, group * LANES));
                match unknown {
                    Unknown::Class(_) => track.rotation(&spot, place, list.len()),
                    Unknown::Slide(_) => {
                        let value = track.slide(&spot, place, list.len());
                        Vector::new(value * Lanes::splat(scale), Lanes::ZERO)
                    }
                }
            })
        };
        let unknowns = list.iter().enumerate().map(of).collect();
        Some(Self { unknowns, bends: track.bends.clone() })
    }
}

impl Quick {
    /// The unknowns of groups where the drawing has them, as the iteration's first guess.
    #[inline(always)]
    pub(crate) fn guess(&mut self, cx: &Context<'_>) {
        let Some(Some(template)) = self.template.get() else { return };
        let per = Lanes::splat(1.0 / cx.bound.scale);
        let unknowns = cx.plan.groups().flat_map(|group| &group.unknowns);
        for (&unknown, knots) in unknowns.zip(&template.unknowns) {
            match unknown {
                Unknown::Class(class) => self.state.class[class] = *knots,
                Unknown::Slide(slide) => {
                    self.state.slides[slide * self.state.len] = knots.map(|v| v.x * per);
                }
            }
        }
    }

    /// Lays the polynomials of the groups' unknowns; false if one is not surely the same
    /// assembly as at the knot before, or as in the drawing.
    #[inline(always)]
    pub(crate) fn lay_cells(&mut self, cx: &Context<'_>, track: &mut Track) -> bool {
        track.cells.clear();
        let Some(Some(template)) = self.template.get() else { return true };
        let state = &self.state;
        let is_near = |step: Lanes, most: f64| step.0[0] <= most;
        if !(is_near(state.first_step[0], FIRST_STEP) && is_near(state.later_steps[0], LATER_STEPS))
        {
            return false;
        }
        for (groups, &bend) in state.determinants.iter().zip(&template.bends) {
            if groups.iter().any(|lanes| lanes.0.iter().any(|&d| (d > 0.0) != bend)) {
                return false;
            }
        }
        let unknowns = || cx.plan.groups().flat_map(|group| &group.unknowns);
        let count = template.unknowns.len();
        self.seeds.clear();
        self.seeds.resize(KNOTS * count, [0.0; 3]);
        for (place, &unknown) in unknowns().enumerate() {
            let jet = match unknown {
                Unknown::Class(class) => &state.theta[class * state.len..],
                Unknown::Slide(slide) => &state.slides[slide * state.len..],
            };
            for knot in 0..KNOTS {
                let (group, lane) = (knot / LANES, knot % LANES);
                let value = match unknown {
                    Unknown::Class(class) => track.angles[knot * self.last.len() + class],
                    Unknown::Slide(_) => jet[0][group].0[lane],
                };
                self.seeds[knot * count + place] =
                    [value, jet[1][group].0[lane], jet[2][group].0[lane]];
            }
        }
        track.cells.reserve(KNOTS * count);
        for knot in 0..KNOTS {
            for (place, &unknown) in unknowns().enumerate() {
                let a = &self.seeds[knot * count + place];
                let b = self.seeds.get((knot + 1) * count + place);
                if b.is_some_and(|b| strays(a, b, CELL)) {
                    return false;
                }
                let unit = match unknown {
                    Unknown::Class(class) => {
                        let unit = state.class[class][knot / LANES];
                        Vector::new(unit.x.0[knot % LANES], unit.y.0[knot % LANES])
                    }
                    Unknown::Slide(_) => Vector::ONE,
                };
                track.cells.push(Cell::new(a, b, CELL, unit));
            }
        }
        let (first, last) = (&self.seeds[..count], &self.seeds[(KNOTS - 1) * count..]);
        unknowns().zip(first.iter().zip(last)).all(|(&u, (a, b))| returns(u, a, b))
    }
}
