//! One design, one position after another: what a motion in time asks for.

use std::borrow::Cow;

use crate::branch::branch::Branch;
use crate::branch::change_interpolant::ChangeWindow;
use crate::branch::design::{BranchPoint, Design};
use crate::branch::knot::{InitialGuess, Taylor2};
use crate::branch::units::Units;
use crate::math::angle::unwrap_to;
use crate::math::derivatives::DerivativeTables;
use crate::plan::constants::DesignConstants;
use crate::plan::dyad::{Dyad, Unknown};
use crate::plan::mechanism::Mechanism;
use crate::plan::plan::{Plan, Step};
use crate::state::state::{Context, State};
use crate::state::status::{Fault, Status};

/// Which positions will be asked for.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Asked<'a> {
    /// These; each is reached straight from the drawing.
    These(&'a [f64]),
    /// Any, each near the one before: with several drivers it is reached from there.
    Any,
}

/// A slide is followed as far as it goes: farther than this many sizes it is refused anyway.
const FAR: f64 = 1.0e9;

/// With several drivers the way from one position to the next is walked: not farther at once (rad,
/// or sizes) than takes a millisecond or so.
const FAR_STEP: f64 = 50.0;

/// A mechanism of one design with its way laid, and work space for a position.
pub(crate) struct Evaluator<'m> {
    design: Design<'m>,
    state: State,
    q: Vec<f64>,
    /// Angles of classes near those of the position, if they are asked for.
    near: Vec<f64>,
    lifted: bool,
    /// Where the last position was, if the next one is reached from there.
    last: Option<LastPosition>,
    roams: bool,
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

/// How far (rad, or of the size) by the condition a near miss is from a position beside it.
const NEAR_MISS_WITHIN: f64 = 64.0;
/// Steps in which it is narrowed down, each to two thirds.
const HALVINGS: u32 = 60;

/// A position from which another is reached straight.
#[derive(Clone)]
struct LastPosition {
    q: Vec<f64>,
    signs: Vec<f64>,
    angles: Vec<f64>,
    seeds: Vec<Taylor2>,
}

/// A position just solved.
#[derive(Clone, Copy)]
pub(crate) struct Position<'p> {
    pub state: &'p State,
    pub plan: &'p Plan,
    pub bound: &'p DesignConstants,
    pub units: &'p Units,
    q: &'p [f64],
    near: &'p [f64],
    whole: &'p [f64],
}

impl<'m> Evaluator<'m> {
    /// Binds dimensions and lays the way; `lifted`: whether angles themselves will be asked for.
    pub(crate) fn new(
        mechanism: &'m Mechanism,
        dimensions: &[f64],
        jets: &'m DerivativeTables,
        asked: Asked<'_>,
        lifted: bool,
    ) -> Self {
        let mut design = Design::new(mechanism, mechanism.signs(), jets);
        design.bridge = ChangeWindow::LONG;
        design.bind(dimensions);
        let far = FAR * design.bound.scale;
        match asked {
            Asked::These(q) => design.lay_way(q),
            Asked::Any => design.lay_way(&[-far, far]),
        }
        let state = design.state(jets);
        let roams = matches!(asked, Asked::Any) && mechanism.q0().len() > 1;
        Self {
            design,
            state,
            q: Vec::new(),
            near: Vec::new(),
            lifted: lifted || roams,
            last: None,
            roams,
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

    /// The condition of the last position: the product along its worst chain.
    pub(crate) fn product(&self) -> f64 {
        self.state.condition2[0].sqrt()
    }

    /// The greatest condition of a dyad or group of the last position by itself, and the step of the
    /// plan if that is a dyad with two solutions. (Beside a change point the position is a
    /// polynomial's, and the condition is that of its nodes.)
    pub(crate) fn condition(&self) -> (Option<usize>, f64) {
        let beside_change = match *self.q {
            [q] => self.design.track.change_near(q, self.design.bridge.reach).is_some(),
            _ => false,
        };
        let worst = self.state.worst_by_itself(&self.design.context(self.design.jets));
        let Some((step, condition)) = worst.filter(|_| !beside_change) else {
            return (None, self.product());
        };
        let is_flat_soon = |step: &Step| matches!(step, Step::Dyad(dyad) if dyad.sign.is_some());
        let steps = &self.design.mechanism.plan().steps;
        (Some(step).filter(|&step| is_flat_soon(&steps[step])), condition)
    }

    /// Solves at a coordinate without leaving the position from which the next one is reached.
    ///
    /// # Errors
    ///
    /// Those of [`Evaluator::solve`].
    pub(crate) fn solve_aside(&mut self, q: &[f64]) -> Result<(), Status> {
        let last = self.last.clone();
        let solved = self.solve(q);
        self.last = last;
        solved
    }

    /// The near miss of a change point beside a coordinate of one driver: the name of the dyad, by
    /// how much its lengths miss (m), and the coordinate where they are nearest.
    pub(crate) fn near_miss(&mut self, q: f64) -> Option<NearMiss> {
        self.solve(&[q]).ok()?;
        let (step, condition) = self.condition();
        let step = step?;
        let plan = self.design.mechanism.plan();
        let Step::Dyad(dyad) = &plan.steps[step] else { return None };
        let name = plan.dyad_names.get(dyad.sign?)?;
        // A dyad is as flat as its distance from there, up to a factor.
        let reach = NEAR_MISS_WITHIN / condition * self.unit(0);
        let (mut low, mut high) = (q - reach, q + reach);
        for _ in 0..HALVINGS {
            let third = (high - low) / 3.0;
            let [a, b] = [low + third, high - third].map(|at| self.misses_flat_by(dyad, at));
            if a < b { high -= third } else { low += third }
        }
        let at = 0.5 * (low + high);
        let miss = self.misses_flat_by(dyad, at).abs() * self.design.bound.scale;
        miss.is_finite().then(|| NearMiss { dyad: name.clone(), miss, q: at })
    }

    /// By how much the sides of a dyad's triangle at a coordinate miss those of a flat one, of the
    /// size; negative where it does not close.
    fn misses_flat_by(&mut self, dyad: &Dyad, at: f64) -> f64 {
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
            && last.q.iter().zip(&self.q).any(|(a, b)| (a - b).abs() > FAR_STEP)
        {
            return Err(Status::Lost);
        }
        let place = match self.last.as_ref().filter(|_| self.q.iter().all(|q| q.is_finite())) {
            Some(last) => Some(last.way(&self.design, &self.q)),
            None => self.design.way(&self.q),
        };
        let solved = self.design.solve(&mut self.state, &self.q, place.as_ref());
        let Some(place) = place.filter(|_| solved) else { return Err(self.state.status) };
        if self.lifted {
            self.near = self.design.near(&place, self.state.class.len());
        }
        if self.roams {
            let anchor = LastPosition::of(&place, &self.design, &self.state, &self.q, &self.near);
            self.last = Some(anchor);
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
            near: &self.near,
            whole: &self.design.mechanism.whole_turns,
        }
    }
}

impl LastPosition {
    fn of(
        place: &BranchPoint<'_>,
        design: &Design<'_>,
        state: &State,
        q: &[f64],
        near: &[f64],
    ) -> Self {
        let angle = |class: usize| unwrap_to(state.class[class][0].angle(), near[class]);
        let seed = |&unknown: &Unknown| match unknown {
            Unknown::Class(class) => [angle(class), 0.0, 0.0],
            Unknown::Slide(slide) => [state.slides[slide * state.len][0], 0.0, 0.0],
        };
        let groups = design.mechanism.plan().groups();
        Self {
            q: q.to_vec(),
            signs: place.track.signs(place.at).to_vec(),
            angles: (0..state.class.len()).map(angle).collect(),
            seeds: groups.flat_map(|group| &group.unknowns).map(seed).collect(),
        }
    }

    /// The straight way from here.
    fn way(&self, design: &Design<'_>, q: &[f64]) -> BranchPoint<'static> {
        let jets = design.first_jets();
        let cx = Context { signs: &self.signs, ..design.context(jets) };
        let start = &InitialGuess { angles: &self.angles, seeds: &self.seeds };
        let (track, at) = Branch::straight(&cx, &mut design.state(jets), &self.q, q, start);
        BranchPoint { track: Cow::Owned(track), at }
    }
}

impl Position<'_> {
    /// Angle of a link, rad, continuous along the way.
    pub(crate) fn angle(&self, link: usize) -> f64 {
        let rotation = &self.plan.rotation[link];
        let class = self.state.class[rotation.class][0].angle();
        let near = self.near.get(rotation.class).copied().unwrap_or(class);
        let mut angle = unwrap_to(class, near);
        for (&turns, q) in rotation.turns.iter().zip(self.q) {
            angle += f64::from(turns) * q;
        }
        angle + self.bound.offset[link] + std::f64::consts::TAU * self.whole[link]
    }
}
