//! One design, one position after another: what a motion in time asks for.

use std::borrow::Cow;

use crate::branch::branch::Branch;
use crate::branch::change_interpolant::ChangeWindow;
use crate::branch::design::{BranchPoint, Design};
use crate::branch::knot::{InitialGuess, Taylor2};
use crate::branch::units::Units;
use crate::math::angle::nearest;
use crate::math::derivatives::DerivativeTables;
use crate::plan::constants::DesignConstants;
use crate::plan::dyad::{Dyad, Unknown};
use crate::plan::mechanism::Mechanism;
use crate::plan::plan::{Plan, Step};
use crate::state::state::{Context, State};
use crate::state::status::{Fault, Status};

/// Which positions will be queries for.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Queries<'a> {
    /// Listed; each is reached straight from the drawing.
    Listed(&'a [f64]),
    /// Any, each reference_angles the one before: with several drivers it is reached from there.
    Any,
}

/// A slide is followed as far as it goes: farther than this many sizes it is refused anyway.
const MAX_SLIDE: f64 = 1.0e9;

/// With several drivers the way from one position to the next is walked: not farther at once (rad,
/// or sizes) than takes a millisecond or so.
const MAX_STEP: f64 = 50.0;

/// A mechanism of one design with its way laid, and work space for a position.
pub(crate) struct Evaluator<'m> {
    design: Design<'m>,
    state: State,
    q: Vec<f64>,
    /// Angles of classes reference_angles those of the position, if they are queries for.
    reference_angles: Vec<f64>,
    needs_angles: bool,
    /// Where the last position was, if the next one is reached from there.
    last: Option<LastPosition>,
    continues_from_last: bool,
}

/// Where a dyad is nearly flat: a change point, if its lengths were a little others.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct NearMiss {
    /// Inner joint or slide of the dyad.
    pub dyad: String,
    /// By how much its lengths miss, m.
    pub miss: f64,
    /// Where it is nearest to flat.
    pub q: f64,
}

/// How far (rad, or of the size) by the condition a reference_angles miss is from a position beside it.
const NEAR_MISS_REACH: f64 = 64.0;
/// Steps in which it is narrowed down, each to two thirds.
const NARROWINGS: u32 = 60;

/// A position from which another is reached straight.
#[derive(Clone)]
struct LastPosition {
    q: Vec<f64>,
    signs: Vec<f64>,
    angles: Vec<f64>,
    taylor: Vec<Taylor2>,
}

/// A position just solved.
#[derive(Clone, Copy)]
pub(crate) struct Position<'p> {
    pub state: &'p State,
    pub plan: &'p Plan,
    pub bound: &'p DesignConstants,
    pub units: &'p Units,
    q: &'p [f64],
    reference_angles: &'p [f64],
    whole_turns: &'p [f64],
}

impl<'m> Evaluator<'m> {
    /// Binds dimensions and lays the way; `needs_angles`: whether angles themselves will be queries for.
    pub(crate) fn new(
        mechanism: &'m Mechanism,
        dimensions: &[f64],
        jets: &'m DerivativeTables,
        queries: Queries<'_>,
        needs_angles: bool,
    ) -> Self {
        let mut design = Design::new(mechanism, mechanism.signs(), jets);
        design.change_window = ChangeWindow::LONG;
        design.bind(dimensions);
        let far = MAX_SLIDE * design.bound.scale;
        match queries {
            Queries::Listed(q) => design.trace(q),
            Queries::Any => design.trace(&[-far, far]),
        }
        let state = design.state(jets);
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

    /// What a driver's coordinate is measured in: the size of a slide, of an angle 1.
    pub(crate) fn unit(&self, driver: usize) -> f64 {
        1.0 / self.design.unit.coordinate[driver]
    }

    /// How the last position came out.
    pub(crate) fn status(&self) -> Status {
        self.state.status
    }

    /// The condition of the last position: the total_condition along its worst chain.
    pub(crate) fn total_condition(&self) -> f64 {
        self.state.condition2[0].sqrt()
    }

    /// The greatest condition of a dyad or group of the last position by itself, and the step of the
    /// plan if that is a dyad with two solutions. (Beside a change point the position is a
    /// polynomial's, and the condition is that of its nodes.)
    pub(crate) fn worst_condition(&self) -> (Option<usize>, f64) {
        let beside_change = match *self.q {
            [q] => self.design.branch.change_near(q, self.design.change_window.reach).is_some(),
            _ => false,
        };
        let worst = self.state.worst_by_itself(&self.design.context(self.design.jets));
        let Some((step, condition)) = worst.filter(|_| !beside_change) else {
            return (None, self.total_condition());
        };
        let has_two_solutions =
            |step: &Step| matches!(step, Step::Dyad(dyad) if dyad.sign.is_some());
        let steps = &self.design.mechanism.plan().steps;
        (Some(step).filter(|&step| has_two_solutions(&steps[step])), condition)
    }

    /// Solves at a coordinate without leaving the position from which the next one is reached.
    ///
    /// # Errors
    ///
    /// Those of [`Evaluator::solve`].
    pub(crate) fn probe(&mut self, q: &[f64]) -> Result<(), Status> {
        let last = self.last.clone();
        let solved = self.solve(q);
        self.last = last;
        solved
    }

    /// The reference_angles miss of a change point beside a coordinate of one driver: the name of the dyad, by
    /// how much its lengths miss (m), and the coordinate where they are nearest.
    pub(crate) fn near_miss(&mut self, q: f64) -> Option<NearMiss> {
        self.solve(&[q]).ok()?;
        let (step, condition) = self.worst_condition();
        let step = step?;
        let plan = self.design.mechanism.plan();
        let Step::Dyad(dyad) = &plan.steps[step] else { return None };
        let name = plan.dyad_names.get(dyad.sign?)?;
        // A dyad is as flat as its distance from there, up to a factor.
        let reach = NEAR_MISS_REACH / condition * self.unit(0);
        let (mut low, mut high) = (q - reach, q + reach);
        for _ in 0..NARROWINGS {
            let third = (high - low) / 3.0;
            let [a, b] = [low + third, high - third].map(|at| self.flat_error(dyad, at));
            if a < b { high -= third } else { low += third }
        }
        let at = 0.5 * (low + high);
        let miss = self.flat_error(dyad, at).abs() * self.design.bound.scale;
        miss.is_finite().then(|| NearMiss { dyad: name.clone(), miss, q: at })
    }

    /// By how much the sides of a dyad's triangle at a coordinate miss those of a flat one, of the
    /// size; negative where it does not close.
    fn flat_error(&mut self, dyad: &Dyad, at: f64) -> f64 {
        let solved = self.solve(&[at]).is_ok();
        match self.state.fault {
            Some(Fault::NotClosed { gap, .. }) if !solved => -gap,
            _ => self.state.misses_flat_by(&self.design.context(self.design.jets), dyad),
        }
    }

    /// Solves at a coordinate (rad or m, of every driver).
    ///
    /// # Errors
    ///
    /// The status of a place that has no position, or no analogues.
    pub(crate) fn solve(&mut self, q: &[f64]) -> Result<(), Status> {
        self.q.clear();
        self.q.extend(q.iter().zip(&self.design.unit.coordinate).map(|(q, unit)| q * unit));
        if let Some(last) = &self.last
            && last.q.iter().zip(&self.q).any(|(a, b)| (a - b).abs() > MAX_STEP)
        {
            return Err(Status::Lost);
        }
        let point = match self.last.as_ref().filter(|_| self.q.iter().all(|q| q.is_finite())) {
            Some(last) => Some(last.branch_to(&self.design, &self.q)),
            None => self.design.branch_to(&self.q),
        };
        let solved = self.design.solve(&mut self.state, &self.q, point.as_ref());
        let Some(point) = point.filter(|_| solved) else { return Err(self.state.status) };
        if self.needs_angles {
            self.reference_angles = self.design.reference_angles(&point, self.state.class.len());
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

    /// The position that was solved last.
    pub(crate) fn position(&self) -> Position<'_> {
        Position {
            state: &self.state,
            plan: self.design.mechanism.plan(),
            bound: &self.design.bound,
            units: &self.design.unit,
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
        let angle = |class: usize| nearest(state.class[class][0].angle(), reference_angles[class]);
        let seed = |&unknown: &Unknown| match unknown {
            Unknown::Class(class) => [angle(class), 0.0, 0.0],
            Unknown::Slide(slide) => [state.slides[slide * state.len][0], 0.0, 0.0],
        };
        let groups = design.mechanism.plan().groups();
        Self {
            q: q.to_vec(),
            signs: point.branch.signs(point.at).to_vec(),
            angles: (0..state.class.len()).map(angle).collect(),
            taylor: groups.flat_map(|group| &group.unknowns).map(seed).collect(),
        }
    }

    /// The straight way from here.
    fn branch_to(&self, design: &Design<'_>, q: &[f64]) -> BranchPoint<'static> {
        let jets = design.tracing_jets();
        let cx = Context { signs: &self.signs, ..design.context(jets) };
        let start = &InitialGuess { angles: &self.angles, taylor: &self.taylor };
        let (branch, at) = Branch::along_segment(&cx, &mut design.state(jets), &self.q, q, start);
        BranchPoint { branch: Cow::Owned(branch), at }
    }
}

impl Position<'_> {
    /// Angle of a link, rad, continuous along the way.
    pub(crate) fn angle(&self, link: usize) -> f64 {
        let rotation = &self.plan.rotation[link];
        let class = self.state.class[rotation.class][0].angle();
        let reference_angles = self.reference_angles.get(rotation.class).copied().unwrap_or(class);
        let mut angle = nearest(class, reference_angles);
        for (&turns, q) in rotation.turns.iter().zip(self.q) {
            angle += f64::from(turns) * q;
        }
        angle + self.bound.offset[link] + std::f64::consts::TAU * self.whole_turns[link]
    }
}
