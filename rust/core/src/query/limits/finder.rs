//! Limits of designs, one after another.

use std::f64::consts::{PI, TAU};
use std::sync::atomic::AtomicBool;

use super::crank_stretches::crank_stretches;
use super::search::{Search, WITHIN};
use super::stretch::{Stretch, intersections, shift_near};
use crate::branch::branch::{CELLS_PER_TURN, MAX_TURNS};
use crate::branch::crank_dyad::CrankDyad;
use crate::branch::design::Design;
use crate::description::error::SolveError;
use crate::math::angle::whole_part;
use crate::math::derivatives::DerivativeTables;
use crate::plan::mechanism::Mechanism;
use crate::query::folding::{fold_of, folding_step, solve};

/// Where (rad) a turn is cut, off the drawing's opposite point: dead points may lie there.
const OFF: f64 = 0.123_456_7;
/// Beside this coordinate (in sizes) of a driven length the branch of a group ends at length 0.
const AT_ZERO: f64 = 1.0e-6;
/// Number of widenings of the range of a slide that nothing ends, and their factor.
const WIDENINGS: u32 = 3;
const WIDENING: f64 = 8.0;

/// Where an assembly of a design exists.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Limits {
    /// Intervals of the coordinate, rad or m: without groups above class II all within a turn of the
    /// driver (or the period of its motion), each with its middle within half a turn of the drawing's
    /// coordinate, so that the one of the drawing contains that coordinate without a shift; else only
    /// that one.
    pub intervals: Vec<Interval>,
    /// Turns after which the motion closes; `None` if it does not, or the driver is a slide.
    pub period: Option<u32>,
}

/// An interval of the coordinate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// Where it begins and ends; infinite if it does not.
    pub ends: [f64; 2],
    /// What folds there, as an index of [`Mechanism::fold_names`], or beyond these a slide whose value
    /// is a length and 0 there; `None` where nothing folds.
    pub folds: [Option<usize>; 2],
}

impl Limits {
    /// Whether the driver goes round: the motion closes after whole turns.
    #[must_use]
    pub fn full_rotation(&self) -> bool {
        self.period.is_some()
    }
}

/// Finds the limits of designs of a mechanism with one driver.
pub struct LimitsFinder<'m> {
    design: Design<'m>,
    cranks: Option<Vec<CrankDyad>>,
}

impl std::fmt::Debug for LimitsFinder<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("LimitsFinder").finish_non_exhaustive()
    }
}

impl Mechanism {
    /// Names of what may fold: dyads in the order of the signs, then groups above class II.
    #[must_use]
    pub fn fold_names(&self) -> Vec<String> {
        let dyads = self.plan().dyad_groups.iter().cloned();
        dyads.chain(self.plan().groups().map(|group| group.name.clone())).collect()
    }
}

impl<'m> LimitsFinder<'m> {
    /// For designs in the assembly with these signs; `cancel`: see [`Self::limits`].
    ///
    /// # Errors
    ///
    /// Several drivers, or signs that do not fit.
    pub fn new(
        mechanism: &'m Mechanism,
        signs: &[i8],
        derivatives: &'m Tables,
        cancel: Option<&'m AtomicBool>,
    ) -> Result<Self, SolveError> {
        if mechanism.q0().len() != 1 {
            return Err(SolveError::Shape("limits are those of one driver".into()));
        }
        mechanism.check(mechanism.drawing(), mechanism.q0(), signs)?;
        let mut design = Design::new(mechanism, signs, &derivatives.0);
        design.cancel = cancel;
        let plan = mechanism.plan();
        // Lengths that redundant links share may miss a change point by more than rounding.
        let is_closed = plan.groups().next().is_none()
            && plan.redundant_links().next().is_none()
            && plan.driven_slide(0).is_none()
            && !plan.has_passive_lengths();
        let cranks =
            is_closed.then(|| plan.dyads().map(|dyad| CrankDyad::of(plan, dyad)).collect());
        Ok(Self { design, cranks: cranks.flatten() })
    }

    /// The limits of one design, without intervals if its dimensions are invalid.
    ///
    /// # Errors
    ///
    /// A wrong number of dimensions; [`SolveError::Interrupted`] once `cancel` is true.
    pub fn limits(&mut self, dimensions: &[f64]) -> Result<Limits, SolveError> {
        let mechanism = self.design.mechanism;
        if dimensions.len() != mechanism.dimensions().len() {
            return Err(SolveError::Shape("the number of dimensions does not fit".into()));
        }
        if mechanism.dimensions().first_fault(dimensions).is_some() {
            return Ok(Limits::default());
        }
        self.design.bind(dimensions);
        let mut stretches = self.in_closed_form().unwrap_or_else(|| self.by_search());
        if mechanism.plan().redundant_links().next().is_some() {
            self.keep_where_redundant_links_fit(&mut stretches);
        }
        let period = self.period(&stretches);
        if self.design.is_cancelled() {
            return Err(SolveError::Interrupted);
        }
        let unit = self.design.units.coordinate[0];
        let interval = |stretch: Stretch| Interval {
            ends: stretch.ends.map(|end| end / unit),
            folds: stretch.folds,
        };
        Ok(Limits { intervals: stretches.into_iter().map(interval).collect(), period })
    }

    /// If all dyads are on a crank and the ground.
    fn in_closed_form(&self) -> Option<Vec<Stretch>> {
        let (plan, constants) = (self.design.mechanism.plan(), &self.design.constants);
        let mut stretches = vec![Stretch::WHOLE];
        for (crank, dyad) in self.cranks.as_ref()?.iter().zip(plan.dyads()) {
            let Some(sign) = dyad.sign else { continue };
            let closing = crank_stretches(crank, plan, constants, sign)?;
            stretches = intersections(&stretches, &closing);
        }
        shift_near(&mut stretches, self.design.q0[0], TAU);
        Some(stretches)
    }

    /// By roots of discriminants along the branch.
    fn by_search(&mut self) -> Vec<Stretch> {
        let mechanism = self.design.mechanism;
        let is_turn = self.design.has_one_rotary_driver();
        let size = self.design.constants.scale;
        let reach = self.design.reach();
        // Guides that are nearly parallel carry a slide farther than all lengths together.
        let farthest = reach * libm::pow(WIDENING, f64::from(WIDENINGS));
        self.design.trace(&[-farthest * size, farthest * size]);
        let branch = &self.design.branch;
        if branch.covered.is_some_and(|[low, high]| low > high) {
            return Vec::new();
        }
        let q0 = self.design.q0[0];
        let turns = TAU * f64::from(MAX_TURNS);
        let covered = branch.covered.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
        let half = 0.5 * branch.period.unwrap_or(TAU);
        let is_periodic = is_turn && covered == [f64::NEG_INFINITY, f64::INFINITY];
        let length = mechanism.plan().driven_length();
        let mut within = Stretch { ends: covered, folds: [None; 2] };
        let cell = if is_turn { TAU / f64::from(CELLS_PER_TURN) } else { 1.0 / 16.0 };
        let design = &self.design;
        let state = design.state(design.tracing_derivatives());
        let core = if is_turn { f64::INFINITY } else { reach };
        let mut search = Search { design, state, cell, core };
        if is_periodic {
            within.ends = [q0 - half + OFF, q0 + half + OFF];
        } else {
            for (side, end) in within.ends.iter_mut().enumerate() {
                let beyond = if is_turn {
                    turns
                } else if design.has_groups() {
                    farthest
                } else {
                    reach
                };
                if let (Some(slide), 0, true) = (length, side, end.is_finite() && *end < AT_ZERO) {
                    // Not followed to the very end: the cylinder can point in any direction there.
                    (*end, within.folds[0]) = (0.0, Some(mechanism.plan().end_of_length(slide)));
                    continue;
                }
                let is_known = if is_turn { turns } else { farthest };
                let is_fold =
                    end.is_finite() && (*end - q0).abs() < is_known && design.has_groups();
                if is_fold {
                    let step = folding_step(design, &mut search.state, *end);
                    within.folds[side] = step.and_then(|step| fold_of(mechanism.plan(), step));
                } else {
                    *end = end.clamp(q0 - beyond, q0 + beyond);
                }
            }
        }
        if !is_turn && !design.has_groups() {
            for widening in 1..=WIDENINGS {
                let first = search.stretches_of_first(within);
                let mut is_wider = false;
                for (side, far) in [-reach, reach].into_iter().enumerate() {
                    if first.iter().any(|stretch| touches(stretch, &within)[side]) {
                        within.ends[side] = q0 + far * libm::pow(WIDENING, f64::from(widening));
                        is_wider = true;
                    }
                }
                if !is_wider {
                    break;
                }
            }
        }
        let mut stretches = search.stretches(within);
        if is_periodic {
            join(&mut stretches, within);
        }
        if !is_turn {
            // A stretch that reaches so far has no limit.
            for stretch in &mut stretches {
                let goes_on = touches(stretch, &within);
                for (side, far) in [f64::NEG_INFINITY, f64::INFINITY].into_iter().enumerate() {
                    if goes_on[side] {
                        stretch.ends[side] = far;
                    }
                }
            }
        }
        if is_periodic {
            shift_near(&mut stretches, q0, 2.0 * half);
        }
        if design.has_groups() {
            stretches.retain(|stretch| stretch.ends[0] <= q0 && q0 <= stretch.ends[1]);
        }
        stretches
    }

    /// Leaves out stretches over which redundant links do not fit throughout. Links that miss by about the
    /// tolerance fit at single positions, which is not a motion.
    fn keep_where_redundant_links_fit(&mut self, stretches: &mut Vec<Stretch>) {
        let q0 = self.design.q0[0];
        let mut state = self.design.state(self.design.tracing_derivatives());
        let mut fits = |q: f64| {
            let cx = solve(&self.design, &mut state, q);
            state.redundant_links_fit(&cx)
        };
        stretches.retain(|stretch| {
            let [from, to] = stretch.ends.map(|end| end.clamp(q0 - PI, q0 + PI));
            let [from, to] = if from < to { [from, to] } else { stretch.ends };
            WITHIN.iter().all(|on| fits(from + on * (to - from)) != Some(false))
        });
    }

    /// Turns after which the motion over all coordinates closes.
    fn period(&mut self, stretches: &[Stretch]) -> Option<u32> {
        let [whole] = stretches else { return None };
        if !whole.is_whole() || !self.design.has_one_rotary_driver() {
            return None;
        }
        if let Some(cranks) = &self.cranks
            && cranks.iter().all(|crank| crank.keeps_sign(&self.design.constants))
        {
            return Some(1);
        }
        if self.cranks.is_some() {
            self.design.trace(&[]);
        }
        let branch = &self.design.branch;
        match branch.period {
            Some(period) => u32::try_from(whole_part((period / TAU).round())).ok(),
            None => branch.is_whole().then_some(1),
        }
    }
}

/// Whether a stretch goes on beyond each end of another.
fn touches(stretch: &Stretch, within: &Stretch) -> [bool; 2] {
    [0, 1].map(|side| stretch.ends[side] == within.ends[side] && within.folds[side].is_none())
}

/// Joins the parts at both ends of a period; all of it is without limits.
fn join(stretches: &mut Vec<Stretch>, period: Stretch) {
    let [from, to] = period.ends;
    let begins = stretches.first().is_some_and(|first| first.ends[0] == from);
    let ends = stretches.last().is_some_and(|last| last.ends[1] == to);
    if !(begins && ends) {
        return;
    }
    if stretches.len() == 1 {
        stretches[0] = Stretch::WHOLE;
    } else if let Some(last) = stretches.pop() {
        stretches[0].ends[0] = last.ends[0] - (to - from);
        stretches[0].folds[0] = last.folds[0];
    }
}

/// Tables that a finder needs.
#[derive(Debug)]
pub struct Tables(DerivativeTables);

impl Default for Tables {
    fn default() -> Self {
        Self(DerivativeTables::new(1, 0))
    }
}
