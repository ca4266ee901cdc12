//! The unknowns of the groups along the drawing's branch, from which designs near it begin.

use std::f64::consts::TAU;

use super::grid::{Grid, knots_at};
use crate::branch::branch::Branch;
use crate::math::lanes::Real;
use crate::math::vector::Vector;
use crate::plan::dyad::Unknown;
use crate::plan::plan::Plan;

/// Unknowns of groups at the knots of the drawing's branch.
#[derive(Debug)]
pub(crate) struct ReferenceBranch<R, const G: usize> {
    /// Rotations; for slides the value (m) as x. At the knots of a turn, and of one in wide cells.
    unknowns: [Vec<[Vector<R>; G]>; 2],
    /// Whether each group's determinant is positive.
    pub(in crate::branch) det_signs: Vec<bool>,
    /// Whether wide cells are narrow enough for the drawing.
    pub(in crate::branch) goes_wide: bool,
}

impl<R: Real, const G: usize> ReferenceBranch<R, G> {
    /// From a branch of a design with this scale; `None` if it does not close after one turn from
    /// `q0`.
    pub(crate) fn new(plan: &Plan, branch: &Branch, q0: f64, scale: f64) -> Option<Self> {
        if branch.period != Some(TAU) {
            return None;
        }
        let list: Vec<Unknown> = plan.groups().flat_map(|g| g.unknowns.clone()).collect();
        let at_knots = |turn: &Grid, index: usize, unknown: Unknown| {
            std::array::from_fn(|group| {
                let at_lane = |lane: usize| {
                    let location = branch.locate(knots_at::<f64>(turn, group * R::LANES + lane));
                    match unknown {
                        Unknown::Class(_) => branch.rotation(&location, index, list.len()),
                        Unknown::Slide(_) => {
                            Vector::new(branch.slide(&location, index, list.len()) * scale, 0.0)
                        }
                    }
                };
                let x = R::from_lanes(|lane| at_lane(lane).x);
                Vector::new(x, R::from_lanes(|lane| at_lane(lane).y))
            })
        };
        let unknowns = [Grid::turn(q0), Grid::wide_turn(q0)].map(|turn| {
            list.iter().enumerate().map(|(index, &u)| at_knots(&turn, index, u)).collect()
        });
        Some(Self { unknowns, det_signs: branch.det_signs.clone(), goes_wide: false })
    }

    /// The unknowns at the knots of a turn.
    pub(in crate::branch) fn unknowns_at(&self, turn: &Grid) -> &[[Vector<R>; G]] {
        &self.unknowns[usize::from(turn.is_wide())]
    }
}
