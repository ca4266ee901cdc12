//! The reactions of one design at some positions, a register of these at a time: stored, or their
//! squares alone.

use std::mem::MaybeUninit;

use super::positions::{DesignPositions, MachineBatch};
use super::request::{Reaction, ReactionRequest};
use super::squares::Squares;
use crate::batch::dispatch::Task;
use crate::batch::rows::{RowSlices, begins_line, store_pairs, write};
use crate::dynamics::friction::pairs::{FrictionPair, PairKind};
use crate::dynamics::friction::rows::FrictionRequest;
use crate::dynamics::friction::workspace::FrictionWorkspace;
use crate::dynamics::reactions::lane_rows::Rows;
use crate::dynamics::reactions::pair_forces::JointForce;
use crate::dynamics::reactions::scene::Scene;
use crate::math::lanes::{Mask, Real};
use crate::math::vector::Vector;
use crate::state::status::Status;

/// The data that all chunks of a batch share.
pub(super) struct ReactionBatch<'b> {
    pub positions: MachineBatch<'b>,
    pub joints: Vec<JointForce>,
    /// Whether forces in pairs are requested, and not only what acts on links from outside.
    pub balances: bool,
    pub friction: Vec<FrictionPair>,
    pub request: &'b ReactionRequest<'b>,
}

/// The reactions of one design at some positions.
pub(super) struct Evaluate<'e, 'r, R: Real> {
    pub batch: &'e ReactionBatch<'e>,
    pub design: DesignPositions<'e>,
    pub scene: &'e mut Scene<R>,
    pub friction: &'e mut FrictionWorkspace<R>,
    pub results: &'e mut RowSlices<'r>,
    pub squares: &'e mut Vec<Squares<R>>,
    /// Row of the first position, or of the design if squares are requested.
    pub first: usize,
}

impl<R: Real> Task<R> for Evaluate<'_, '_, R> {
    #[inline(always)]
    fn run(&mut self) {
        let ReactionBatch { positions, request, friction, .. } = self.batch;
        let MachineBatch { plan, machine, sources, motion, .. } = positions;
        let count = self.design.solved.positions;
        self.squares.clear();
        self.squares.resize(request.reactions.len(), Squares::NONE);
        for first in (0..count).step_by(R::LANES) {
            let rows = Rows { first, last: count - 1 };
            self.scene.read(plan, sources, self.design.guides, &self.design.solved, rows);
            self.scene.apply(plan, machine, self.design.values, rows);
            if !friction.is_empty() {
                self.apply_friction(rows);
                // A position that friction locks takes milliseconds, a block of them seconds.
                if motion.control.is_cancelled() {
                    return;
                }
            }
            if self.batch.balances {
                self.scene.start(plan);
                self.scene.carry_loads(plan);
                self.scene.pass_moments(plan);
            }
            let lanes = R::LANES.min(count - first);
            if request.squares {
                self.add_squares(first, lanes);
            } else {
                self.write(first, lanes);
            }
            if !self.batch.balances {
                continue;
            }
            for &stress in &plan.self_stresses {
                self.scene.stress(plan, stress);
                self.scene.carry_loads(plan);
                self.scene.pass_moments(plan);
                self.drop_stressed(first, lanes);
            }
        }
        if request.squares {
            self.write_squares();
            return;
        }
        for (row, &status) in self.design.status.iter().enumerate() {
            self.results.status[self.first + row] = MaybeUninit::new(status);
            if status > Status::NearSingular as u8 {
                self.write_nan(self.first + row);
            }
        }
    }
}

impl<R: Real> Evaluate<'_, '_, R> {
    /// Adds friction to the loads.
    #[inline(always)]
    fn apply_friction(&mut self, rows: Rows) {
        let ReactionBatch { positions, request, friction, .. } = self.batch;
        let MachineBatch { plan, sources, motion, .. } = positions;
        let size = self.design.size;
        let ways = self.scene.ways(request.sense);
        let pairs = (*plan, &friction[..]);
        self.friction.read(self.scene, pairs, sources, (&self.design.solved, rows), &ways, size);
        let friction_request = FrictionRequest {
            solution: request.solution,
            safety: request.reactions.contains(&Reaction::Safety),
            cancel: motion.control.cancel,
        };
        self.friction.apply(self.scene, pairs, friction_request, size);
    }

    /// The sum over the pairs with friction at a joint or in a slide.
    #[inline(always)]
    fn sum_of_friction(&self, reaction: Reaction) -> Vector<R> {
        let mut sum = R::ZERO;
        for (index, pair) in self.batch.friction.iter().enumerate() {
            match share(&pair.kind, reaction) {
                Some(Share::Friction(sign)) => {
                    sum += self.friction.efforts[index] * R::splat(sign);
                }
                Some(Share::Loss) => sum += self.friction.loss(index),
                None => {}
            }
        }
        scalar(sum)
    }

    /// Force of a guide on the sliding link.
    #[inline(always)]
    fn normal(&self, slide: usize) -> R {
        self.scene.normal(self.batch.positions.plan, slide)
    }

    /// The value of a reaction in all lanes.
    #[inline(always)]
    fn value(&self, index: usize) -> Vector<R> {
        let (reaction, joint) = (self.batch.request.reactions[index], &self.batch.joints[index]);
        let scene = &*self.scene;
        match reaction {
            Reaction::Joint { .. } => joint.of(scene),
            Reaction::Normal(slide) => scalar(self.normal(slide)),
            Reaction::Moment(slide) => scalar(scene.slide_moment[slide]),
            Reaction::Along(slide) => {
                scalar(scene.slides[slide] + scene.slide_moment[slide] / self.normal(slide))
            }
            Reaction::JointMoment { .. }
            | Reaction::JointLoss(_)
            | Reaction::Friction(_)
            | Reaction::SlideLoss(_) => self.sum_of_friction(reaction),
            Reaction::Solutions if self.batch.friction.is_empty() => scalar(R::ONE),
            Reaction::Solutions => scalar(self.friction.solutions),
            Reaction::Safety => scalar(self.friction.safety),
            Reaction::Residual => scalar(self.friction.residual),
            Reaction::Driver(driver) => scalar(scene.driver[driver]),
            Reaction::ShakingForce => scene.shaking_force,
            Reaction::ShakingMoment => scalar(scene.shaking_moment),
            Reaction::LoadForce(action) | Reaction::LoadCouple(action) => {
                scene.load_on(&self.batch.positions.plan.load_actions[action])
            }
            Reaction::LoadPlace(action) => {
                let plan = self.batch.positions.plan;
                let point = plan.load_actions[action].at;
                // Not `map_or`: the closure would not be compiled for the level.
                match point {
                    Some(point) => scene.place(plan, point).at,
                    None => Vector::ZERO,
                }
            }
        }
    }

    #[inline(always)]
    fn write(&mut self, first: usize, lanes: usize) {
        // An infinite load has no reactions. (The place of a guide's force is at infinity where the force
        // is zero.)
        let (infinity, mut infinite) = (R::splat(f64::INFINITY), R::Mask::NONE);
        for (index, reaction) in self.batch.request.reactions.iter().enumerate() {
            let value = self.value(index);
            if !is_unbounded(*reaction) {
                infinite = infinite.or(infinity.le(value.x.abs())).or(infinity.le(value.y.abs()));
            }
            let width = reaction.width();
            let out = &mut self.results.columns[index][(self.first + first) * width..];
            if lanes == R::LANES {
                let out = &mut out[..lanes * width];
                let past = self.results.past_caches && begins_line(out);
                if width == 2 {
                    store_pairs(out, past, value);
                } else {
                    write(out, past, value.x);
                }
                continue;
            }
            for lane in 0..lanes {
                out[lane * width] = MaybeUninit::new(value.x.lane(lane));
                if width == 2 {
                    out[lane * width + 1] = MaybeUninit::new(value.y.lane(lane));
                }
            }
        }
        if infinite.any() {
            for lane in 0..lanes {
                if infinite.lane(lane) {
                    self.write_nan(self.first + first + lane);
                }
            }
        }
    }

    #[inline(always)]
    fn add_squares(&mut self, first: usize, lanes: usize) {
        let used = R::from_lanes(|lane| lane as f64).lt(R::splat(lanes as f64));
        for index in 0..self.squares.len() {
            let value = self.value(index);
            self.squares[index].add(value, first / R::LANES, used);
        }
    }

    // Loops: closures would not be compiled with the level's instructions.
    #[inline(always)]
    fn write_squares(&mut self) {
        let mut worst = Status::Ok as u8;
        for &status in self.design.status {
            worst = worst.max(status);
        }
        self.results.status[self.first] = MaybeUninit::new(worst);
        let mut is_known = worst <= Status::NearSingular as u8;
        for (index, reaction) in self.batch.request.reactions.iter().enumerate() {
            // The place of a guide's force may be at infinity.
            let is_place = is_unbounded(*reaction);
            is_known &= is_place || !self.squares[index].is_infinite();
        }
        for (index, column) in self.results.columns.iter_mut().enumerate() {
            let both = self.squares[index].greatest_and_mean(self.design.solved.positions);
            let both = if is_known { both } else { [f64::NAN; 2] };
            for axis in 0..2 {
                column[2 * self.first + axis] = MaybeUninit::new(both[axis]);
            }
        }
    }

    /// Sets reactions to NaN that a self-stress changes: they are undetermined.
    #[inline(always)]
    fn drop_stressed(&mut self, first: usize, lanes: usize) {
        let size = self.design.size;
        for (index, &reaction) in self.batch.request.reactions.iter().enumerate() {
            let unit = match reaction {
                _ if reaction.is_given() => continue,
                Reaction::JointMoment { .. }
                | Reaction::Friction(_)
                | Reaction::JointLoss(_)
                | Reaction::SlideLoss(_)
                | Reaction::Solutions
                | Reaction::Safety
                | Reaction::Residual => continue,
                Reaction::Moment(_) => size,
                Reaction::Along(slide) => {
                    // Known with the normal force and the moment.
                    let moment = self.scene.slide_moment[slide];
                    let stressed = Scene::is_stressed(self.normal(slide), R::ONE)
                        .or(Scene::is_stressed(moment, R::splat(size)));
                    self.drop_lanes(index, [first, lanes], stressed);
                    continue;
                }
                Reaction::Driver(driver)
                    if self.batch.positions.plan.driven_links[driver].is_some() =>
                {
                    size
                }
                _ => 1.0,
            };
            // A force is known as a whole, or not at all: its axes are the drawing's.
            let stressed = Scene::is_stressed(self.value(index).size(), R::splat(unit));
            self.drop_lanes(index, [first, lanes], stressed);
        }
    }

    #[inline(always)]
    fn drop_lanes(&mut self, index: usize, [first, lanes]: [usize; 2], stressed: R::Mask) {
        if self.batch.request.squares {
            // The lanes beyond the last position repeat it.
            self.squares[index].drop(stressed);
            return;
        }
        for lane in (0..lanes).filter(|&lane| stressed.lane(lane)) {
            let width = self.batch.request.reactions[index].width();
            let row = self.first + first + lane;
            self.results.columns[index][row * width..(row + 1) * width]
                .fill(MaybeUninit::new(f64::NAN));
        }
    }

    fn write_nan(&mut self, row: usize) {
        for (reaction, column) in self.batch.request.reactions.iter().zip(&mut self.results.columns)
        {
            let width = reaction.width();
            column[row * width..(row + 1) * width].fill(MaybeUninit::new(f64::NAN));
        }
    }
}

#[inline(always)]
fn scalar<R: Real>(value: R) -> Vector<R> {
    Vector::new(value, R::ZERO)
}

/// The contribution of a pair to a sum over pairs.
enum Share {
    /// Its friction, with this sign.
    Friction(f64),
    /// The power that it loses.
    Loss,
}

fn share(pair: &PairKind, reaction: Reaction) -> Option<Share> {
    match (reaction, pair) {
        (
            Reaction::JointMoment { joint, on },
            &PairKind::Journal { joint: at, on: sliding_link, fast, .. },
        ) if at == joint => {
            let against = (fast == on).then_some(Share::Friction(-1.0));
            (sliding_link == on).then_some(Share::Friction(1.0)).or(against)
        }
        (Reaction::JointLoss(joint), PairKind::Journal { joint: at, .. }) if *at == joint => {
            Some(Share::Loss)
        }
        (Reaction::Friction(slide), PairKind::Guide { slide: sliding_link, .. })
            if *sliding_link == slide =>
        {
            Some(Share::Friction(1.0))
        }
        (Reaction::SlideLoss(slide), PairKind::Guide { slide: sliding_link, .. })
            if *sliding_link == slide =>
        {
            Some(Share::Loss)
        }
        _ => None,
    }
}

/// Whether a reaction may be infinite where the machine is not.
fn is_unbounded(reaction: Reaction) -> bool {
    matches!(reaction, Reaction::Along(_) | Reaction::Safety)
}
