//! Groups at the knots of a uniform branch: their first guess, and the polynomials between knots.

use super::uniform::UniformTracer;
use crate::branch::branch::Branch;
use crate::branch::hermite::{HermiteCell, coefficients};
use crate::branch::knot::{MAX_FIRST_STEP, MAX_LATER_STEPS, closes, prediction_failed};
use crate::math::lanes::{Mask, Real};
use crate::math::vector::Vector;
use crate::plan::dyad::Unknown;
use crate::state::state::Context;

impl<R: Real, const G: usize> UniformTracer<R, G> {
    /// Sets the groups' unknowns to those of the drawing, as first guess of the iteration.
    #[inline(always)]
    pub(crate) fn guess(&mut self, cx: &Context<'_>) {
        let Some(Some(reference)) = self.reference.get() else { return };
        let inverse_scale = R::splat(1.0 / cx.constants.scale);
        let groups = self.state.groups.min(G);
        let unknowns = cx.plan.groups().flat_map(|group| &group.unknowns);
        for (&unknown, knots) in unknowns.zip(reference.unknowns_at(&self.grid())) {
            match unknown {
                Unknown::Class(class) => {
                    self.state.pose.class[class][..groups].copy_from_slice(&knots[..groups]);
                }
                Unknown::Slide(slide) => {
                    let values = &mut self.state.pose.slides[slide * self.state.len];
                    for (value, knot) in values[..groups].iter_mut().zip(knots) {
                        *value = knot.x * inverse_scale;
                    }
                }
            }
        }
    }

    /// Builds the polynomials of the groups' unknowns; false if one may belong to another assembly
    /// than the knot before, or than the drawing.
    #[inline(always)]
    pub(crate) fn build_cells(&mut self, cx: &Context<'_>, branch: &mut Branch) -> bool {
        let Some(Some(reference)) = self.reference.get() else {
            branch.cells.clear();
            return true;
        };
        let grid = self.grid();
        let registers = (grid.count / R::LANES).min(G);
        let state = &self.state;
        let is_near = |step: R, max: f64| step.lane(0) <= max;
        if !(is_near(state.work.first_step[0], MAX_FIRST_STEP)
            && is_near(state.work.later_steps[0], MAX_LATER_STEPS))
        {
            return false;
        }
        for (groups, &expected) in state.work.determinants.iter().zip(&reference.det_signs) {
            if groups[..registers]
                .iter()
                .any(|lanes| (0..R::LANES).any(|lane| (lanes.lane(lane) > 0.0) != expected))
            {
                return false;
            }
        }
        let count = reference.unknowns_at(&grid).len();
        let classes = self.last_angles.len();
        let cell = HermiteCell { coefficients: [0.0; 6], unit: Vector::ONE };
        branch.cells.resize(grid.count * count, cell);
        let unknowns = cx.plan.groups().flat_map(|group| &group.unknowns);
        for (index, &unknown) in unknowns.enumerate() {
            let (jet, mut values) = match unknown {
                Unknown::Class(class) => (&state.pose.theta[class * state.len..], [R::ZERO; G]),
                Unknown::Slide(slide) => {
                    let jet = &state.pose.slides[slide * state.len..];
                    (jet, jet[0])
                }
            };
            if let Unknown::Class(class) = unknown {
                for group in 0..registers {
                    values[group] = R::from_lanes(|lane| {
                        branch.angles[(group * R::LANES + lane) * classes + class]
                    });
                }
            }
            let taylor = [&values, &jet[1], &jet[2]];
            for group in 0..registers {
                let here = taylor.map(|knots| knots[group]);
                let next = taylor.map(|knots| one_on(knots, group, registers));
                // No knot follows the last one.
                let with_next = (grid.count - 1 - group * R::LANES).min(R::LANES);
                let failed =
                    prediction_failed(&here, &next, grid.cell).bits() & ((1 << with_next) - 1);
                if failed != 0 {
                    return false;
                }
                let polynomial = coefficients(here, next, grid.cell);
                let mut unit = Vector::ONE;
                if let Unknown::Class(class) = unknown {
                    unit = state.pose.class[class][group];
                }
                for lane in 0..R::LANES {
                    let cell = &mut branch.cells[(group * R::LANES + lane) * count + index];
                    for (out, c) in cell.coefficients.iter_mut().zip(polynomial) {
                        *out = c.lane(lane);
                    }
                    cell.unit = Vector::new(unit.x.lane(lane), unit.y.lane(lane));
                    if lane >= with_next {
                        let [c0, c1, c2, ..] = cell.coefficients;
                        cell.coefficients = [c0, c1, c2, 0.0, 0.0, 0.0];
                    }
                }
            }
            let last = values[registers - 1].lane(R::LANES - 1);
            if !closes(unknown, values[0].lane(0), last) {
                return false;
            }
        }
        true
    }
}

/// The knot after each of a register; 0 after the last of all.
#[inline(always)]
fn one_on<R: Real>(knots: &[R], group: usize, registers: usize) -> R {
    let after = if group + 1 < registers { knots[group + 1].lane(0) } else { 0.0 };
    let here = knots[group];
    R::from_lanes(|lane| if lane + 1 < R::LANES { here.lane(lane + 1) } else { after })
}
