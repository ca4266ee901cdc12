//! The positions of one design into their rows: eight at a time, and one by one
//! those that need care.

use std::mem::MaybeUninit;

use super::design::Design;
use super::outputs::{Column, Rows, Writer};
use super::quick::Quick;
use super::simd::{self, Simd};
use super::state::{Context, State, Status};
use super::track::{Spot, nearest};
use crate::lanes::{LANES, Lanes, Mask, Real};
use crate::mechanism::Mechanism;
use crate::plan::jet::Jets;
use crate::plane::Vector;

/// Work space of one thread.
pub(crate) struct Worker<'a> {
    design: Design<'a>,
    writer: &'a Writer<'a>,
    columns: &'a [Column],
    simd: Simd,
    quick: Quick,
    one: State,
    eight: State<Lanes>,
    signs: Vec<Lanes>,
    lifted: Vec<Lanes>,
    /// Positions of the last job, in groups, and which they were.
    turned: Vec<Turned>,
    shared: Option<usize>,
}

/// Some positions of one design, and where they go.
pub(crate) struct Job<'j, 'r> {
    /// Coordinates, drivers fastest, rad or m.
    pub q: &'j [f64],
    pub rows: &'j mut Rows<'r>,
    /// Row of the first position.
    pub first: usize,
    /// Which coordinates these are, if other designs have the same.
    pub shared: Option<usize>,
}

/// Eight positions of a driven angle: what does not depend on the design.
#[derive(Debug, Clone, Copy)]
struct Turned {
    q: Lanes,
    unit: Vector<Lanes>,
}

impl<'a> Worker<'a> {
    pub(crate) fn new(
        mechanism: &'a Mechanism,
        signs: &[i8],
        jets: &'a Jets,
        writer: &'a Writer<'a>,
        columns: &'a [Column],
        simd: Simd,
    ) -> Self {
        let design = Design::new(mechanism, signs, jets);
        let plan = mechanism.plan();
        Self {
            quick: design.quick(),
            one: State::new(plan, jets),
            eight: State::new(plan, jets),
            signs: vec![Lanes::ONE; plan.signs()],
            lifted: vec![Lanes::ZERO; plan.classes],
            turned: Vec::new(),
            shared: None,
            design,
            writer,
            columns,
            simd,
        }
    }

    /// Solves positions of the design with these dimensions.
    pub(crate) fn solve(&mut self, values: &[f64], mut job: Job<'_, '_>) {
        let mechanism = self.design.mechanism;
        if mechanism.dimensions().first_fault(values).is_some() {
            let count = job.q.len() / mechanism.q0().len();
            let status = Status::BadDimension as u8;
            job.rows.leave_out(self.columns, job.first, count, status);
            return;
        }
        self.design.bind(values);
        simd::solve(self.simd, self, &mut job);
    }

    /// What [`simd`] dispatches.
    #[inline(always)]
    pub(crate) fn run(&mut self, job: &mut Job<'_, '_>) {
        if !self.design.lay_quick(&mut self.quick) {
            self.design.lay_way(job.q);
        }
        let drivers = self.design.mechanism.q0().len();
        let count = job.q.len() / drivers;
        if drivers > 1 {
            for row in 0..count {
                self.one_row(job, row);
            }
            return;
        }
        self.eight.prepare(self.design.mechanism.plan(), &self.design.bound, self.design.jets);
        self.set_signs(&Spot::default());
        self.turn(job);
        for row in (0..count).step_by(LANES) {
            self.group(job, row, (count - row).min(LANES));
        }
    }

    /// Coordinates in groups of eight; sines and cosines of shared ones are kept.
    #[inline(always)]
    fn turn(&mut self, job: &Job<'_, '_>) {
        let is_angle = self.design.mechanism.plan().driven_slide(0).is_none();
        if is_angle && job.shared.is_some() && self.shared == job.shared {
            return;
        }
        self.shared = job.shared;
        self.turned.clear();
        let scale = self.design.unit.coordinate[0];
        for eight in job.q.chunks(LANES) {
            let q = Lanes::from_lanes(|i| eight[i.min(eight.len() - 1)] * scale);
            let unit = if is_angle { Vector::at_angle(q) } else { Vector::ONE };
            self.turned.push(Turned { q, unit });
        }
    }

    /// Signs of the lanes, at their places on the way.
    #[inline(always)]
    fn set_signs(&mut self, spot: &Spot<Lanes>) {
        for (sign, lanes) in self.signs.iter_mut().enumerate() {
            *lanes = Lanes::from_lanes(|i| self.design.track.signs_at(spot, i)[sign]);
        }
    }

    /// Up to eight positions from `row` on.
    #[inline(always)]
    fn group(&mut self, job: &mut Job<'_, '_>, row: usize, count: usize) {
        let Turned { q, unit } = self.turned[row / LANES];
        let track = &self.design.track;
        let spot = track.spot(q);
        let mut care = <Lanes as Real>::Mask::NONE;
        if track.even.is_none() {
            let strange = |i: usize| {
                let at = q.lane(i);
                !track.covers(at) || track.hides(&spot, i) || track.change_near(at).is_some()
            };
            let flags = Lanes::from_lanes(|i| if strange(i) { 1.0 } else { 0.0 });
            care = Lanes::ZERO.lt(flags);
        }
        if !track.is_one_stretch() {
            self.set_signs(&spot);
        }
        let design = &self.design;
        let cx = Context {
            plan: design.mechanism.plan(),
            bound: &design.bound,
            jets: design.jets,
            signs: &self.signs,
        };
        self.eight.unit[0] = unit;
        self.eight.solve_turned(&cx, &[q]);
        care = care.or(self.eight.care);
        if !care.all() {
            for &class in &self.writer.classes {
                let near = design.track.near(&spot, class);
                self.lifted[class] = nearest(self.eight.class[class].angle(), near);
            }
            let (state, unit, lifted) = (&self.eight, &design.unit, &self.lifted);
            let at = (job.first + row, count);
            self.writer.write(job.rows, at, &cx, state, unit, lifted, &[q]);
            let near = self.eight.near_singular();
            for lane in 0..count {
                let status = if near.lane(lane) { Status::NearSingular } else { Status::Ok };
                job.rows.status[job.first + row + lane] = MaybeUninit::new(status as u8);
            }
        }
        if care.any() {
            for lane in 0..count {
                if care.lane(lane) {
                    self.one_row(job, row + lane);
                }
            }
        }
    }

    /// One position by itself.
    #[cold]
    #[inline(never)]
    fn one_row(&mut self, job: &mut Job<'_, '_>, row: usize) {
        let drivers = self.design.mechanism.q0().len();
        let q = self.design.scaled(&job.q[row * drivers..][..drivers]);
        let place = self.design.way(&q);
        let state = &mut self.one;
        let analogues = self.design.solve(state, &q, place.as_ref());
        let at = job.first + row;
        let solved = matches!(state.status, Status::Ok | Status::NearSingular | Status::Singular);
        let (true, Some(place)) = (solved, &place) else {
            job.rows.leave_out(self.columns, at, 1, state.status as u8);
            return;
        };
        let near = self.design.near(place, self.lifted.len());
        let lift = |class: usize| nearest(state.class[class].angle(), near[class]);
        let lifted: Vec<f64> = (0..near.len()).map(lift).collect();
        let cx = self.design.context(self.design.jets);
        let unit = &self.design.unit;
        self.writer.write(job.rows, (at, 1), &cx, state, unit, &lifted, &q);
        if !analogues {
            job.rows.blank(self.columns, 1, at, 1);
        }
        job.rows.status[at] = MaybeUninit::new(state.status as u8);
    }
}
