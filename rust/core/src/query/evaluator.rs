//! One design, one position after another, for a motion in time.

use std::borrow::Cow;
use std::sync::atomic::AtomicBool;

use crate::branch::branch::Branch;
use crate::branch::change_interpolant::ChangeWindow;
use crate::branch::design::Design;
use crate::branch::design::Units;
use crate::branch::knot::{InitialGuess, Taylor2};
use crate::branch::lanes::uniform::Traced;
use crate::branch::position::BranchPoint;
use crate::math::angle::unwrap_to;
use crate::math::derivatives::DerivativeTables;
use crate::math::lanes::Real;
use crate::math::root::ternary::ternary_search;
use crate::math::tolerance::NEAR_SINGULAR_CONDITION;
use crate::plan::constants::DesignConstants;
use crate::plan::dyad::{Dyad, Unknown};
use crate::plan::mechanism::Mechanism;
use crate::plan::plan::{Plan, Step};
use crate::query::failure::Failure;
use crate::state::state::{Context, State};
use crate::state::status::{Fault, Rejection, Status};

/// The positions that will be requested.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Queries<'a> {
    /// These; each is traced straight from the drawing.
    Listed(&'a [f64]),
    /// Any, each near the one before; with several drivers it is traced from there.
    Any,
}

/// A slide's branch is traced to its end, or over this many sizes: beyond, the slide is refused
/// anyway.
const MAX_SLIDE: f64 = 1.0e9;

/// Longest step (rad, or sizes) between positions with several drivers: the branch between them is
/// traced, which must not take more than about a millisecond.
const MAX_STEP: f64 = 50.0;

/// A mechanism of one design with its branch traced, and work space for a position.
pub(crate) struct Evaluator<'m> {
    design: Design<'m>,
    state: State,
    q: Vec<f64>,
    /// Class angles near those of the position, if angles are needed.
    reference_angles: Vec<f64>,
    needs_angles: bool,
    /// The last position, if the next one is traced from it.
    last: Option<LastPosition>,
    continues_from_last: bool,
}

/// A position where a dyad is nearly flat: with slightly other lengths it would be a change point.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct NearMiss {
    /// Inner joint or slide of the dyad.
    pub dyad: String,
    /// Error of its lengths, m.
    pub miss: f64,
    /// Coordinate where the dyad is nearest to flat.
    pub q: f64,
}

/// Greatest distance (rad, or of the size) of a near miss from a position beside it, times the
/// condition there.
const NEAR_MISS_REACH: f64 = 64.0;
/// Shortest driven length (in sizes), times the condition there, that does not cause the condition.
const SHORT: f64 = 8.0;
/// Steps of the search for a near miss; each shortens the interval to two thirds.
const NARROWINGS: u32 = 60;

/// A position from which the next one is traced.
#[derive(Clone)]
struct LastPosition {
    q: Vec<f64>,
    signs: Vec<f64>,
    angles: Vec<f64>,
    taylor: Vec<Taylor2>,
}

/// The position solved last; or one in each lane.
#[derive(Clone, Copy)]
pub(crate) struct Position<'p, R: Real = f64> {
    pub state: &'p State<R>,
    pub plan: &'p Plan,
    pub constants: &'p DesignConstants,
    pub units: &'p Units,
    q: &'p [f64],
    reference_angles: &'p [f64],
    whole_turns: &'p [f64],
}

impl<'m> Evaluator<'m> {
    /// Binds dimensions and traces the branch; `needs_angles`: whether angles themselves are
    /// needed.
    pub(crate) fn new(
        mechanism: &'m Mechanism,
        dimensions: &[f64],
        derivatives: &'m DerivativeTables,
        queries: Queries<'_>,
        needs_angles: bool,
    ) -> Self {
        let design = (dimensions, mechanism.signs());
        Self::with_signs(mechanism, design, derivatives, queries, needs_angles, None)
    }

    /// The same in another assembly; once `cancel` is true the branch ends where it is.
    pub(crate) fn with_signs(
        mechanism: &'m Mechanism,
        (dimensions, signs): (&[f64], &[i8]),
        derivatives: &'m DerivativeTables,
        queries: Queries<'_>,
        needs_angles: bool,
        cancel: Option<&'m AtomicBool>,
    ) -> Self {
        let mut design = Design::new(mechanism, signs, derivatives);
        design.cancel = cancel;
        design.change_window = ChangeWindow::LONG;
        design.bind(dimensions);
        let far = MAX_SLIDE * design.constants.scale;
        match queries {
            Queries::Listed(q) => {
                let classes = 1..if needs_angles { mechanism.class_angle.len() } else { 1 };
                let classes: Vec<usize> = classes.collect();
                let several = mechanism.q0().len() > 1;
                if !several || design.trace_in_closed_form(&classes, None) == Traced::No {
                    design.trace(q);
                }
            }
            Queries::Any => design.trace(&[-far, far]),
        }
        let state = design.state(derivatives);
        let continues_from_last = matches!(queries, Queries::Any) && mechanism.q0().len() > 1;
        Self {
            design,
            state,
            q: Vec::new(),
            reference_angles: Vec::new(),
            needs_angles: needs_angles || continues_from_last,
            last: None,
            continues_from_last,
        }
    }

    /// Forgets the last position: the next one is traced from the drawing again.
    pub(crate) fn restart(&mut self) {
        self.last = None;
    }

    /// The design with its branch.
    pub(super) fn design(&self) -> &Design<'m> {
        &self.design
    }

    /// Names what failed at coordinates that were rejected.
    pub(crate) fn failure(&self, rejection: Rejection, q: &[f64]) -> Failure {
        Failure::of(&self.design, rejection, q)
    }

    /// Name of a driver: its link or slide.
    pub(crate) fn driver_name(&self, driver: usize) -> String {
        let linkage = self.design.mechanism.linkage();
        linkage.driver_name(linkage.drivers[driver])
    }

    /// Unit of a driver's coordinate: the size for a slide, 1 for an angle.
    pub(crate) fn unit(&self, driver: usize) -> f64 {
        1.0 / self.design.units.coordinate[driver]
    }

    /// The unit of length of the design, m: a power of 2.
    pub(crate) fn unit_of_length(&self) -> f64 {
        self.design.constants.scale
    }

    /// Greatest distance that a slide may go, m.
    pub(crate) fn reach(&self) -> f64 {
        self.design.reach() * self.design.constants.scale
    }

    /// Status of the last position.
    pub(crate) fn status(&self) -> Status {
        self.state.status
    }

    /// Condition of the last position: the product along its worst chain.
    pub(crate) fn total_condition(&self) -> f64 {
        self.state.conditions.greatest[0].sqrt()
    }

    /// The greatest condition of a single dyad or group at the last position, and its step of the
    /// plan if that is a dyad with two solutions. (Beside a change point the position is
    /// interpolated, and the condition is that of the nodes.)
    pub(crate) fn worst_condition(&self) -> (Option<usize>, f64) {
        let beside_change = match *self.q {
            [q] => self.design.branch.change_near(q, self.design.change_window.reach).is_some(),
            _ => false,
        };
        let worst = self.state.worst_own_condition(&self.design.context(self.design.derivatives));
        let Some((step, condition)) = worst.filter(|_| !beside_change) else {
            return (None, self.total_condition());
        };
        let has_two_solutions =
            |step: &Step| matches!(step, Step::Dyad(dyad) if dyad.sign.is_some());
        let steps = &self.design.mechanism.plan().steps;
        (Some(step).filter(|&step| has_two_solutions(&steps[step])), condition)
    }

    /// The condition of every step of the plan on its own at the last position; NaN for steps without
    /// one, and for a dyad that is nearly flat where the position is interpolated.
    pub(crate) fn own_conditions(&self, conditions: &mut Vec<f64>) {
        let cx = self.design.context(self.design.derivatives);
        // The greatest condition is that of the interpolant's nodes there.
        let greatest2 = self.state.conditions.greatest[0];
        conditions.clear();
        conditions.extend((0..cx.plan.steps.len()).map(|step| {
            let own2 = self.state.own_condition2(&cx, step).filter(|&own2| own2 <= greatest2);
            own2.map_or(f64::NAN, f64::sqrt)
        }));
    }

    /// The cause of an ill-conditioned position of one driver, if it is a length of nearly 0: the step of
    /// its dyad, or the check of a driven one. `step`: the dyad with the greatest condition.
    pub(crate) fn zero_length(
        &self,
        q: &[f64],
        step: Option<usize>,
        condition: f64,
    ) -> Option<usize> {
        let &[q] = q else { return None };
        let plan = self.design.mechanism.plan();
        if q < SHORT / condition * self.unit(0)
            && let Some(length_step) = plan.length_step(0)
        {
            return Some(length_step);
        }
        let is_length =
            |&step: &usize| matches!(&plan.steps[step], Step::Dyad(dyad) if dyad.is_length);
        step.filter(is_length).filter(|_| condition > NEAR_SINGULAR_CONDITION)
    }

    /// Solves at a coordinate; the next position is still traced from the one before.
    ///
    /// # Errors
    ///
    /// Those of [`Evaluator::solve`].
    pub(crate) fn probe(&mut self, q: &[f64]) -> Result<(), Rejection> {
        let last = self.last.clone();
        let solved = self.solve(q);
        self.last = last;
        solved
    }

    /// The near miss of a change point beside a coordinate of one driver.
    pub(crate) fn near_miss(&mut self, q: f64) -> Option<NearMiss> {
        self.solve(&[q]).ok()?;
        let (step, condition) = self.worst_condition();
        let step = step?;
        let plan = self.design.mechanism.plan();
        let Step::Dyad(dyad) = &plan.steps[step] else { return None };
        let name = plan.dyad_names.get(dyad.sign?)?;
        // A dyad's sine is its distance from the flat position, up to a factor.
        let reach = NEAR_MISS_REACH / condition * self.unit(0);
        let ends = [q - reach, q + reach];
        let at = ternary_search(ends, NARROWINGS, |at| self.excess_to_flat(dyad, at));
        let miss = self.excess_to_flat(dyad, at).abs() * self.design.constants.scale;
        miss.is_finite().then(|| NearMiss { dyad: name.clone(), miss, q: at })
    }

    /// Difference between the sides of a dyad's triangle at a coordinate and those of a flat one,
    /// relative to the size; negative if it does not close.
    fn excess_to_flat(&mut self, dyad: &Dyad, at: f64) -> f64 {
        let solved = self.solve(&[at]).is_ok();
        match self.state.fault {
            Some(Fault::NotClosed { gap, .. }) if !solved => -gap,
            _ => self.state.flatness_gap(&self.design.context(self.design.derivatives), dyad),
        }
    }

    /// Solves at a coordinate (rad or m, of every driver).
    ///
    /// # Errors
    ///
    /// How a coordinate without a position or without analogues failed.
    pub(crate) fn solve(&mut self, q: &[f64]) -> Result<(), Rejection> {
        self.q.clear();
        self.q.extend(q.iter().zip(&self.design.units.coordinate).map(|(q, unit)| q * unit));
        if let Some(last) = &self.last
            && last.q.iter().zip(&self.q).any(|(a, b)| (a - b).abs() > MAX_STEP)
        {
            return Err(Rejection::Failed { status: Status::Lost, fault: None });
        }
        let point = match self.last.as_ref().filter(|_| self.q.iter().all(|q| q.is_finite())) {
            Some(last) => Some(last.branch_to(&self.design, &self.q)),
            None => self.design.branch_without_angles(&self.q),
        };
        let solved = self.design.solve(&mut self.state, &self.q, point.as_ref());
        let Some(point) = point.filter(|_| solved) else {
            let (status, fault) = (self.state.status, self.state.fault);
            return Err(Rejection::Failed { status, fault });
        };
        if self.needs_angles {
            let by_chords = self.design.angles_by_chords(&self.q);
            self.reference_angles = by_chords.unwrap_or_else(|| {
                // Some turns are ambiguous by these: then the path is followed.
                let uses_chords = !self.design.chord_paths.is_empty();
                let followed = if uses_chords { self.design.branch_to(&self.q) } else { None };
                let point = followed.as_ref().unwrap_or(&point);
                self.design.reference_angles(point, self.state.pose.class.len())
            });
        }
        if self.continues_from_last {
            let last = LastPosition::new(
                &point,
                &self.design,
                &self.state,
                &self.q,
                &self.reference_angles,
            );
            self.last = Some(last);
        }
        Ok(())
    }

    /// The position solved last.
    pub(crate) fn position(&self) -> Position<'_> {
        Position {
            state: &self.state,
            plan: self.design.mechanism.plan(),
            constants: &self.design.constants,
            units: &self.design.units,
            q: &self.q,
            reference_angles: &self.reference_angles,
            whole_turns: &self.design.mechanism.whole_turns,
        }
    }
}

impl LastPosition {
    fn new(
        point: &BranchPoint<'_>,
        design: &Design<'_>,
        state: &State,
        q: &[f64],
        reference_angles: &[f64],
    ) -> Self {
        let angle = |class: usize| {
            unwrap_to(state.pose.class[class][0].unit_angle(), reference_angles[class])
        };
        let unknown_value = |&unknown: &Unknown| match unknown {
            Unknown::Class(class) => [angle(class), 0.0, 0.0],
            Unknown::Slide(slide) => [state.pose.slides[slide * state.len][0], 0.0, 0.0],
        };
        let groups = design.mechanism.plan().groups();
        Self {
            q: q.to_vec(),
            signs: point.branch.signs(point.at).to_vec(),
            angles: (0..state.pose.class.len()).map(angle).collect(),
            taylor: groups.flat_map(|group| &group.unknowns).map(unknown_value).collect(),
        }
    }

    /// The segment from here to `q`.
    fn branch_to(&self, design: &Design<'_>, q: &[f64]) -> BranchPoint<'static> {
        let derivatives = design.tracing_derivatives();
        let cx = Context { signs: &self.signs, ..design.context(derivatives) };
        let start = &InitialGuess { angles: &self.angles, taylor: &self.taylor };
        let (branch, at) =
            Branch::along_segment(&cx, &mut design.state(derivatives), &self.q, q, start);
        BranchPoint { branch: Cow::Owned(branch), at }
    }
}

impl<'p, R: Real> Position<'p, R> {
    /// A position of a design, without its angles.
    pub(super) fn of(design: &'p Design<'_>, state: &'p State<R>) -> Self {
        Self {
            state,
            plan: design.mechanism.plan(),
            constants: &design.constants,
            units: &design.units,
            q: &[],
            reference_angles: &[],
            whole_turns: &design.mechanism.whole_turns,
        }
    }
}

impl Position<'_> {
    /// The greatest derivative of an order of all points and slides (in sizes) and angles, of one driver.
    pub(crate) fn greatest(&self, order: usize) -> f64 {
        let (len, pose) = (self.state.len, &self.state.pose);
        let points = pose.points.iter().skip(order).step_by(len);
        let lengths = points.flat_map(|point| [point[0].x, point[0].y]);
        let rates = [&pose.slides, &pose.theta].into_iter();
        let rates = rates.flat_map(|jets| jets.iter().skip(order).step_by(len).map(|rate| rate[0]));
        lengths.chain(rates).fold(0.0, |greatest, rate| rate.abs().max(greatest))
    }

    /// Angle of a link, rad, continuous along the branch.
    pub(crate) fn angle(&self, link: usize) -> f64 {
        let rotation = &self.plan.rotation[link];
        let class = self.state.pose.class[rotation.class][0].angle();
        let reference_angles = self.reference_angles.get(rotation.class).copied().unwrap_or(class);
        let mut angle = unwrap_to(class, reference_angles);
        for (&turns, q) in rotation.turns.iter().zip(self.q) {
            angle += f64::from(turns) * q;
        }
        angle + self.constants.offset[link] + std::f64::consts::TAU * self.whole_turns[link]
    }

    /// Derivative of a link's angle, of one driver.
    pub(crate) fn angle_rate(&self, link: usize, order: usize) -> f64 {
        let rotation = &self.plan.rotation[link];
        let class = self.state.pose.theta[rotation.class * self.state.len + order][0];
        let driven = if order == 1 { f64::from(rotation.turns[0]) } else { 0.0 };
        (class + driven) * self.units.angle[order]
    }
}
