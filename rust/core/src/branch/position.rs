//! A single position of a design, with the signs of its branch there, and smooth through change
//! points.

use std::borrow::Cow;

use super::branch::Branch;
use super::change_interpolant::ChangeInterpolant;
use super::design::Design;
use super::knot::{ChangePoint, InitialGuess};
use super::location::BranchLocation;
use crate::math::derivatives::DerivativeTables;
use crate::math::lanes::{Mask, Real};
use crate::math::tolerance::{CHANGE_WIDTH, SMOOTH_CLOSURE};
use crate::math::vector::Vector;
use crate::plan::dyad::Unknown;
use crate::plan::plan::Step;
use crate::state::state::{Context, State};
use crate::state::status::{Fault, Status};

/// A point on a branch.
pub(crate) struct BranchPoint<'a> {
    /// The branch.
    pub branch: Cow<'a, Branch>,
    /// The parameter there.
    pub at: f64,
}

impl BranchPoint<'_> {
    /// Whether it lies on an island without a knot.
    pub(crate) fn is_in_untraced_island(&self) -> bool {
        self.branch.in_untraced_island(&self.branch.locate(self.at), 0)
    }
}

/// Greatest distance (rad, or units of the scale) from the drawing to which several drivers are
/// followed: 1000 turns. The time for a position grows with the distance.
const MAX_DISTANCE: f64 = 1000.0 * std::f64::consts::TAU;

impl Design<'_> {
    /// Sets the groups' unknowns to those of the branch at a location, as first guess of the
    /// iteration.
    #[inline(always)]
    pub(crate) fn guess<R: Real, const G: usize>(
        &self,
        g: usize,
        state: &mut State<R, G>,
        branch: &Branch,
        location: &BranchLocation<R>,
    ) {
        let plan = self.mechanism.plan();
        let count = plan.groups().map(|group| group.unknowns.len()).sum();
        let unknowns = plan.groups().flat_map(|group| &group.unknowns);
        for (index, &unknown) in unknowns.enumerate() {
            match unknown {
                Unknown::Class(class) => {
                    state.pose.class[class][g] = branch.rotation(location, index, count);
                }
                Unknown::Slide(slide) => {
                    state.pose.slides[slide * state.len][g] = branch.slide(location, index, count);
                }
            }
        }
    }

    /// Solves a position again that did not converge or came out beyond a fold.
    #[cold]
    fn resolve_from_knot(&self, state: &mut State, q: &[f64], (branch, at): (&Branch, f64)) {
        let cx = self.context(&self.tracing_derivatives);
        if let [_] = *q {
            let Some(taylor) = branch.retrace(&cx, &mut self.state(&self.tracing_derivatives), at)
            else {
                // Too near the fold at the end of the branch to find the unknowns.
                state.set_lost();
                return;
            };
            let unknowns = self.mechanism.plan().groups().flat_map(|group| &group.unknowns);
            for (&unknown, value) in unknowns.zip(taylor) {
                match unknown {
                    Unknown::Class(class) => state.pose.class[class][0] = Vector::at_angle(value),
                    Unknown::Slide(slide) => state.pose.slides[slide * state.len][0] = value,
                }
            }
            state.solve(&Context { signs: branch.signs(at), ..self.context(self.derivatives) }, q);
        }
        let not_converged = state.status == Status::NotConverged;
        let other_side = matches!(state.status, Status::Ok | Status::NearSingular)
            && !branch.same_det_sign(state, 0);
        if (not_converged || other_side) && q.len() == 1 {
            state.set_lost();
        } else if other_side {
            let steps = &self.mechanism.plan().steps;
            let last = steps.iter().rposition(|step| matches!(step, Step::Group(_)));
            state.fault = last.map(|step| Fault::NotConverged { step });
            state.status = Status::NotConverged;
        }
    }

    /// Whether coordinates (scaled) are too far from the drawing to be followed.
    pub(crate) fn is_too_far(&self, q: &[f64]) -> bool {
        q.iter().zip(&self.q0).any(|(a, b)| (a - b).abs() > MAX_DISTANCE)
    }

    /// Whether one of several drivers is somewhere too far from the drawing to be followed, or not finite;
    /// `q`: its coordinates, scaled.
    #[inline(always)]
    pub(crate) fn cannot_follow<R: Real>(&self, driver: usize, q: R) -> bool {
        !(q - R::splat(self.q0[driver])).abs().le(R::splat(MAX_DISTANCE)).all()
    }

    /// The branch to one position (scaled coordinates); `None` if a coordinate is not finite or too
    /// far.
    pub(crate) fn branch_to(&self, q: &[f64]) -> Option<BranchPoint<'_>> {
        if q.iter().any(|x| !x.is_finite()) {
            return None;
        }
        if let [at] = *q {
            return Some(BranchPoint { branch: Cow::Borrowed(&self.branch), at });
        }
        if self.is_too_far(q) {
            return None;
        }
        if self.serves_all && self.chord_paths.is_empty() {
            return Some(BranchPoint { branch: Cow::Borrowed(&self.branch), at: 0.0 });
        }
        let angles = &self.mechanism.class_angle;
        let (branch, at) = if let Ok(taylor) = &self.initial_unknowns {
            let cx = self.context(&self.tracing_derivatives);
            let mut state = self.state(&self.tracing_derivatives);
            let start = &InitialGuess { angles, taylor };
            Branch::along_segment(&cx, &mut state, &self.q0, q, start)
        } else {
            (Branch::empty(angles.len(), &self.signs), 0.0)
        };
        Some(BranchPoint { branch: Cow::Owned(branch), at })
    }

    /// The same where angles are not read from it: then no path is followed if one branch serves all
    /// positions.
    pub(crate) fn branch_without_angles(&self, q: &[f64]) -> Option<BranchPoint<'_>> {
        let is_known = self.serves_all && q.iter().all(|x| x.is_finite()) && !self.is_too_far(q);
        if is_known {
            return Some(BranchPoint { branch: Cow::Borrowed(&self.branch), at: 0.0 });
        }
        self.branch_to(q)
    }

    /// Class angles near those at (scaled) coordinates that can be reached, if chords give them.
    pub(crate) fn angles_by_chords(&self, q: &[f64]) -> Option<Vec<f64>> {
        if self.chord_paths.is_empty() {
            return None;
        }
        let moved: Vec<f64> = q.iter().zip(&self.q0).map(|(q, q0)| q - q0).collect();
        let mut near = vec![0.0; self.mechanism.class_angle.len()];
        for path in &self.chord_paths {
            let turned = path.turned(self.mechanism.plan(), &moved);
            let (angle, missing) = path.end_angle(&turned, false, self.chord_paths.len() == 1);
            if missing {
                return None;
            }
            for (class, middle) in path.legs {
                near[class] = angle + middle;
            }
        }
        Some(near)
    }

    /// Distance (in sizes) of the farthest joint at a parameter of the branch; 0 if it cannot be
    /// solved.
    pub(crate) fn max_distance(&self, at: f64) -> f64 {
        let mut state = self.state(self.derivatives);
        let point = BranchPoint { branch: Cow::Borrowed(&self.branch), at };
        self.solve(&mut state, &[at], Some(&point));
        if state.has_failed() {
            return 0.0;
        }
        let values = state.pose.points.chunks_exact(state.len);
        values.fold(0.0, |max, jet| max.max(jet[0][0].norm()))
    }

    /// Class angles near those at a point, from which whole turns are counted.
    pub(crate) fn reference_angles(&self, point: &BranchPoint<'_>, classes: usize) -> Vec<f64> {
        let location = point.branch.locate(point.at);
        if point.branch.in_untraced_island(&location, 0) {
            // An island between two knots.
            let cx = self.context(&self.tracing_derivatives);
            let island = point.branch.trace_island(
                &cx,
                &mut self.state(&self.tracing_derivatives),
                point.at,
            );
            let location = island.locate(point.at);
            return (0..classes).map(|class| island.reference_angle(&location, class)).collect();
        }
        (0..classes).map(|class| point.branch.reference_angle(&location, class)).collect()
    }

    /// The interpolated motion beside a change point.
    #[cold]
    #[inline(never)]
    fn at_change_point(
        &self,
        state: &State,
        branch: &Branch,
        change: &ChangePoint,
        distance: f64,
    ) -> Option<State> {
        let mut interpolants = self.interpolants.borrow_mut();
        let index = interpolants.iter().position(|(at, _)| *at == change.at);
        let index = index.unwrap_or_else(|| {
            let solve = |derivatives: &DerivativeTables, distance: f64| {
                let at = change.at + distance;
                // A fresh state, so that nothing depends on the position that comes first.
                let mut trial = self.state(derivatives);
                self.guess(0, &mut trial, branch, &branch.locate(at));
                trial.solve(
                    &Context { signs: branch.signs(at), ..self.context(derivatives) },
                    &[at],
                );
                let lost =
                    trial.fault.is_some() || trial.pose.points.iter().any(|p| p[0].x.is_nan());
                (!lost).then_some(trial)
            };
            // Values must not depend on the order requested.
            let judging = DerivativeTables::new(1, ChangeInterpolant::JUDGED_ORDER);
            let interpolant =
                ChangeInterpolant::fit(self.change_window, |distance| solve(&judging, distance));
            let interpolant = interpolant.and_then(|interpolant| {
                interpolant.refit(self.change_window, |at| solve(self.derivatives, at))
            });
            interpolants.push((change.at, interpolant));
            interpolants.len() - 1
        });
        let smooth = interpolants[index].1.as_ref()?.state_at(distance, state)?;
        (smooth.residual(&self.context(self.derivatives)) <= SMOOTH_CLOSURE).then_some(smooth)
    }

    /// The step of a driven length that is negative at these (scaled) coordinates, and by how much.
    fn negative_length(&self, q: &[f64]) -> Option<(usize, f64)> {
        let plan = self.mechanism.plan();
        let (driver, &value) = q
            .iter()
            .enumerate()
            .find(|&(driver, &value)| value < 0.0 && plan.length_step(driver).is_some())?;
        Some((plan.length_step(driver)?, -value))
    }

    /// Solves one position with the signs of its branch there; true if the analogues exist. `state` is
    /// [prepared](Self::prepare) for this design.
    pub(crate) fn solve(
        &self,
        state: &mut State,
        q: &[f64],
        point: Option<&BranchPoint<'_>>,
    ) -> bool {
        let Some(BranchPoint { branch, at }) = point else {
            state.set_bad_input();
            return false;
        };
        if let Some((step, gap)) = self.negative_length(q) {
            state.fault = Some(Fault::NotClosed { step, gap });
            state.status = Status::Unreachable;
            return false;
        }
        if !branch.covers(*at) {
            state.set_lost();
            return false;
        }
        if state.is_interpolated {
            self.prepare(state);
        }
        let cx = self.context(self.derivatives);
        self.guess(0, state, branch, &branch.locate(*at));
        state.solve(&Context { signs: branch.signs(*at), ..cx }, q);
        let not_converged = state.status == Status::NotConverged;
        let solved = matches!(state.status, Status::Ok | Status::NearSingular);
        if not_converged || solved && !branch.same_det_sign(state, 0) {
            self.resolve_from_knot(state, q, (branch, *at));
        }
        // At a change point a dyad is flat, and beside it few digits of the analogues remain: the
        // interpolant is more accurate.
        let solved = matches!(state.status, Status::Ok | Status::NearSingular);
        if q.len() == 1
            && state.status != Status::BadInput
            && let Some((change, distance)) = branch.change_near(*at, self.change_window.reach)
            && let Some(smooth) = self.at_change_point(state, branch, &change, distance)
            && (!solved || smooth.is_near(state))
        {
            let at_change = !solved || distance.abs() <= CHANGE_WIDTH;
            let status = if at_change { Status::Singular } else { state.status };
            *state = State { is_interpolated: true, status, ..smooth };
            if at_change {
                let flat = cx.plan.steps.iter().position(
                    |step| matches!(step, Step::Dyad(dyad) if dyad.sign == Some(change.sign)),
                );
                state.fault = flat.map(|step| Fault::Singular { step });
            }
            return true;
        }
        matches!(state.status, Status::Ok | Status::NearSingular)
            || state.status == Status::Singular && state.is_at_zero_length(cx.plan)
    }
}
