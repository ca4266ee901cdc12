//! Friction at some positions: the speeds of the pairs, and the effect of friction on all reactions.

use std::sync::atomic::AtomicBool;

use super::pairs::{FrictionPair, PairKind};
use super::rest::{AT_REST, RATE_ROUNDING};
use super::workspace::FrictionWorkspace;
use crate::dynamics::friction::problem::{FrictionProblem, SlidingPair};
use crate::dynamics::friction::solutions::TooManyPaths;
use crate::dynamics::reactions::columns::{Solved, Sources};
use crate::dynamics::reactions::force_plan::ForcePlan;
use crate::dynamics::reactions::lane_rows::Rows;
use crate::dynamics::reactions::scene::Scene;
use crate::math::lanes::{Mask, Real};
use crate::math::vector::Vector;

/// Greatest factor of the coefficients in the search for the safety.
const MOST_SAFETY: f64 = 1.0e6;

/// Number of solutions where too many pairs depend on one another for a search.
const UNSOLVED: f64 = -1.0;
/// The same where redundant links leave the force in a pair undetermined.
const UNDETERMINED: f64 = -2.0;

/// The friction in one lane.
struct LaneFriction {
    /// Dry friction of every pair.
    dry: Vec<f64>,
    solutions: f64,
    safety: f64,
    residual: f64,
}

impl LaneFriction {
    fn unknown(pairs: usize) -> Self {
        Self {
            dry: vec![f64::NAN; pairs],
            solutions: f64::NAN,
            safety: f64::NAN,
            residual: f64::NAN,
        }
    }
}

/// A request for the friction.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FrictionRequest<'c> {
    /// Index of the requested solution.
    pub solution: usize,
    /// Whether the safety against locking is requested.
    pub safety: bool,
    /// Set to true when the caller no longer needs the result.
    pub cancel: Option<&'c AtomicBool>,
}

// Loops: closures would not be compiled with the level's instructions.
impl<R: Real> FrictionWorkspace<R> {
    /// Reads the speed of every pair, and its speed if the drivers had the speeds `ways`, which give the
    /// sense of friction.
    #[inline(always)]
    pub(crate) fn read(
        &mut self,
        scene: &Scene<R>,
        (plan, pairs): (&ForcePlan, &[FrictionPair]),
        sources: &Sources,
        (solved, rows): (&Solved<'_>, Rows),
        ways: &[R],
        size: f64,
    ) {
        let mut speeds = Vec::with_capacity(scene.drive.len());
        for &[speed, _] in &scene.drive {
            speeds.push(speed);
        }
        self.length = size;
        let mut turning = R::ZERO;
        for (driver, &way) in ways.iter().enumerate() {
            let is_angle = plan.driven_links[driver].is_some();
            turning += way.abs() * R::splat(if is_angle { 1.0 } else { 1.0 / size });
        }
        self.speeds.clear();
        self.still.clear();
        self.point_speeds.clear();
        for source in &sources.points {
            let mut speed = R::ZERO;
            if let &Some(column) = source {
                speed = rows.velocity_size(solved.columns[column + 1], ways);
            }
            self.point_speeds.push(speed);
        }
        for pair in pairs {
            let [added, subtracted] = pair.speed_columns(plan, sources);
            let mut rates = [R::ZERO; 2];
            for (rate, drivers) in rates.iter_mut().zip([&speeds[..], ways]) {
                if let Some(column) = added {
                    *rate += rows.rate(solved.columns[column + 1], drivers);
                }
                if let Some(column) = subtracted {
                    *rate = *rate - rows.rate(solved.columns[column + 1], drivers);
                }
            }
            let mut summed = R::ZERO;
            for column in [added, subtracted].into_iter().flatten() {
                summed += rows.rate_size(solved.columns[column + 1], ways);
            }
            let unit = if matches!(pair.kind, PairKind::Guide { .. }) { size } else { 1.0 };
            self.speeds.push(rates);
            let still = turning * R::splat(AT_REST * unit) + summed * R::splat(RATE_ROUNDING);
            self.still.push(still);
        }
    }

    /// Adds the friction of all pairs to the other loads.
    #[inline(always)]
    pub(crate) fn apply(
        &mut self,
        scene: &mut Scene<R>,
        (plan, pairs): (&ForcePlan, &[FrictionPair]),
        request: FrictionRequest<'_>,
        size: f64,
    ) {
        self.drag(scene, plan, pairs);
        let loads = (scene.link_force.clone(), scene.link_moment.clone());
        scene.start(plan);
        self.base = scene.pair_reactions(plan, pairs);
        self.force = scene.greatest_force(size);
        self.respond(scene, plan, pairs, |_| ());
        let undetermined = scene.undetermined(plan, pairs, size);
        (scene.link_force, scene.link_moment) = loads;
        let mut is_determined = Vec::with_capacity(R::LANES);
        for lane in 0..R::LANES {
            is_determined.push(!undetermined.lane(lane));
        }
        let lanes = self.solve(scene, pairs, &is_determined, request);
        self.solutions = R::from_lanes(|lane| lanes[lane].solutions);
        self.safety = R::from_lanes(|lane| lanes[lane].safety);
        self.residual = R::from_lanes(|lane| lanes[lane].residual);
        for (index, pair) in pairs.iter().enumerate() {
            let dry = R::from_lanes(|lane| lanes[lane].dry[index]);
            scene.apply_friction(plan, pair, dry);
            self.efforts[index] += dry;
        }
    }

    /// Solves the friction of all pairs, one lane at a time.
    fn solve(
        &self,
        scene: &Scene<R>,
        pairs: &[FrictionPair],
        is_determined: &[bool],
        request: FrictionRequest<'_>,
    ) -> Vec<LaneFriction> {
        let lane_friction = |(lane, &is_determined): (usize, &bool)| {
            let (mut problem, used) = self.problem(scene, pairs, lane);
            problem.cancel = request.cancel;
            if problem.is_cancelled() {
                return LaneFriction::unknown(pairs.len());
            }
            let is_known = is_determined && problem.pairs.iter().all(SlidingPair::is_finite);
            let solved = if is_known { problem.solve() } else { Ok(Vec::new()) };
            let solutions = match &solved {
                Ok(all) if is_known => all.len() as f64,
                Ok(_) if is_determined => f64::NAN,
                Ok(_) => UNDETERMINED,
                Err(TooManyPaths) => UNSOLVED,
            };
            let all = solved.unwrap_or_default();
            let meant = all.get(request.solution);
            let mut dry = vec![if meant.is_some() { 0.0 } else { f64::NAN }; pairs.len()];
            for (index, &pair) in used.iter().enumerate() {
                dry[pair] = meant.map_or(f64::NAN, |friction| friction[index]);
            }
            LaneFriction {
                dry,
                solutions,
                safety: if request.safety && is_known {
                    problem.safety(MOST_SAFETY)
                } else {
                    f64::NAN
                },
                residual: meant.map_or(f64::NAN, |friction| problem.missed(friction)),
            }
        };
        is_determined.iter().enumerate().map(lane_friction).collect()
    }

    /// Adds viscous friction to the loads.
    #[inline(always)]
    pub(crate) fn drag(&mut self, scene: &mut Scene<R>, plan: &ForcePlan, pairs: &[FrictionPair]) {
        self.efforts.resize(pairs.len(), R::ZERO);
        for (index, pair) in pairs.iter().enumerate() {
            let drag = -(self.speeds[index][0] * R::splat(pair.viscous));
            scene.apply_friction(plan, pair, drag);
            self.efforts[index] = drag;
        }
    }

    /// Finds the reactions of all pairs to a unit of friction in each, and the speed that rounding may
    /// give the pair; replaces the loads. `each` sees the scene of one pair after another.
    #[inline(always)]
    pub(crate) fn respond(
        &mut self,
        scene: &mut Scene<R>,
        plan: &ForcePlan,
        pairs: &[FrictionPair],
        mut each: impl FnMut(&Scene<R>),
    ) {
        self.find_edge_errors(scene, plan);
        self.slopes.clear();
        self.forces_per_unit.clear();
        for (index, pair) in pairs.iter().enumerate() {
            scene.link_force.fill(Vector::ZERO);
            scene.link_moment.fill(R::ZERO);
            scene.apply_friction(plan, pair, R::ONE);
            scene.start(plan);
            let slopes = scene.pair_reactions(plan, pairs);
            self.slopes.push(slopes);
            self.forces_per_unit.push(scene.greatest_force(self.length));
            let still = self.still[index] + self.rate_rounding(scene);
            // At a singular position nothing is known: the pair does not count as at rest.
            let is_known = still.lt(R::splat(f64::INFINITY));
            self.still[index] = R::select(is_known, still, self.still[index]);
            each(scene);
        }
    }

    /// The pairs that slide under load in a lane, and their indices. At rest they have their static law.
    pub(crate) fn problem(
        &self,
        scene: &Scene<R>,
        pairs: &[FrictionPair],
        lane: usize,
    ) -> (FrictionProblem<'static>, Vec<usize>) {
        let way = |pair: usize| self.speeds[pair][1].lane(lane);
        let slides_here = |&pair: &usize| way(pair).abs() > self.still[pair].lane(lane);
        let used = self.loaded((0..pairs.len()).filter(slides_here).collect(), pairs, lane);
        let rests = scene.drive.iter().all(|[speed, _]| speed.lane(lane) == 0.0);
        let is_static = self.is_static.unwrap_or(rests);
        let in_lane = |vector: Vector<R>| [vector.x.lane(lane), vector.y.lane(lane)];
        let pairs = used.iter().map(|&pair| {
            let friction_pair = &pairs[pair];
            SlidingPair {
                law: if is_static { friction_pair.static_law } else { friction_pair.law },
                sense: 1.0_f64.copysign(way(pair)),
                rate: way(pair).abs(),
                base: in_lane(self.base[pair]),
                slopes: used.iter().map(|&on| in_lane(self.slopes[on][pair])).collect(),
            }
        });
        (FrictionProblem { pairs: pairs.collect(), cancel: None }, used)
    }
}

impl<R: Real> Scene<R> {
    /// The speeds of the drivers; where all rest, unit speeds in the given sense.
    #[inline(always)]
    pub(crate) fn ways(&self, sense: &[f64]) -> Vec<R> {
        let mut rests = R::Mask::NONE.not();
        for &[speed, _] in &self.drive {
            rests = rests.and(speed.abs().le(R::ZERO));
        }
        let mut ways = Vec::with_capacity(self.drive.len());
        for (driver, &[speed, _]) in self.drive.iter().enumerate() {
            let sense = sense.get(driver).copied().unwrap_or(0.0);
            ways.push(R::select(rests, R::splat(sense), speed));
        }
        ways
    }

    /// Applies the friction of a pair to both of its links.
    #[inline(always)]
    fn apply_friction(&mut self, plan: &ForcePlan, pair: &FrictionPair, friction: R) {
        match pair.kind {
            PairKind::Journal { on, fast, .. } => {
                self.moment_on(plan, on, friction);
                self.moment_on(plan, fast, -friction);
            }
            PairKind::Guide { slide, sliding, carrying } => {
                let at = self.points[plan.reference[sliding]].at;
                let along = self.guides[slide].scale(friction);
                self.force_on(plan, sliding, at, along);
                self.force_on(plan, carrying, at, -along);
            }
        }
    }

    /// Lanes in which a force of a pair is undetermined.
    #[inline(always)]
    fn undetermined(&mut self, plan: &ForcePlan, pairs: &[FrictionPair], size: f64) -> R::Mask {
        let mut stressed = R::Mask::NONE;
        for &stress in &plan.self_stresses {
            self.stress(plan, stress);
            let reactions = self.pair_reactions(plan, pairs);
            for (pair, reaction) in pairs.iter().zip(&reactions) {
                let moment = match pair.kind {
                    PairKind::Journal { .. } => reaction.y,
                    PairKind::Guide { .. } => reaction.y * R::splat(1.0 / size),
                };
                let force = Vector::new(reaction.x, moment);
                stressed = stressed.or(Self::is_stressed(force.size(), R::ONE));
            }
        }
        stressed
    }

    /// The reactions on which the friction of every pair depends.
    #[inline(always)]
    pub(crate) fn pair_reactions(
        &mut self,
        plan: &ForcePlan,
        pairs: &[FrictionPair],
    ) -> Vec<Vector<R>> {
        self.carry_loads(plan);
        self.pass_moments(plan);
        let mut reactions = Vec::with_capacity(pairs.len());
        for pair in pairs {
            reactions.push(match &pair.kind {
                PairKind::Journal { force, .. } => force.of(self),
                &PairKind::Guide { slide, .. } => {
                    Vector::new(self.normal(plan, slide), self.slide_moment[slide])
                }
            });
        }
        reactions
    }
}
