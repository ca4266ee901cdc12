//! The positions of many designs of a machine, solved chunk by chunk: kinematics, speeds, and what loads
//! read there.

use std::ops::Range;

use super::followed::{Drivers, Followed};
use crate::batch::chunks::Chunk;
use crate::batch::dispatch::Entry;
use crate::batch::motion::{Asked, MotionBatch, MotionWorker};
use crate::batch::request::{Shape, product};
use crate::branch::design::Design;
use crate::description::error::SolveError;
use crate::dynamics::machine::Machine;
use crate::dynamics::reactions::applied::Values;
use crate::dynamics::reactions::columns::{Solved, Sources, guide_directions};
use crate::dynamics::reactions::force_plan::ForcePlan;
use crate::dynamics::variation::{self, Variation, Varied};
use crate::math::lanes::Real;
use crate::math::vector::Vector;

/// The motion of the drivers, and what acts, at all positions of all designs.
#[derive(Clone, Copy)]
pub(crate) struct Driven<'a> {
    /// Speeds and accelerations of the drivers: designs × positions × drivers, or one for all.
    pub speed: &'a [f64],
    pub acceleration: &'a [f64],
    /// Values of the callbacks: designs × positions × callbacks.
    pub external: &'a [f64],
    /// Sense in which each driver is about to move where all rest. May be empty.
    pub sense: &'a [f64],
}

/// What all chunks share.
pub(crate) struct MachineBatch<'b> {
    pub motion: MotionBatch<'b>,
    pub machine: &'b Machine,
    pub plan: &'b ForcePlan,
    pub sources: &'b Sources,
    pub driven: Driven<'b>,
    pub callbacks: usize,
    /// Numbers of the machines that differ from one to the next.
    pub variations: &'b [Variation<'b>],
}

/// The working data of one thread.
pub(crate) struct Positions<'b, R: Real, const G: usize> {
    pub motion: MotionWorker<'b, R, G>,
    tables: Vec<Vec<f64>>,
    varied: Vec<Vec<f64>>,
    followed: Followed,
    known: Vec<(usize, Vector)>,
    guides: Vec<Vector>,
}

/// The solved positions of one design of a chunk.
pub(crate) struct DesignPositions<'d> {
    /// Index of the design in its chunk.
    pub index: usize,
    /// Rows of the whole batch.
    pub rows: Range<usize>,
    /// The size of the design, m.
    pub size: f64,
    pub guides: &'d [Vector],
    /// Points of the ground that are known for the design.
    pub known: &'d [(usize, Vector)],
    /// The bound design, unless it has invalid dimensions, and its dimensions.
    pub design: Option<&'d Design<'d>>,
    pub dimensions: &'d [f64],
    /// Coordinates of the drivers, drivers fastest.
    pub q: &'d [f64],
    pub solved: Solved<'d>,
    pub values: Values<'d>,
    pub status: &'d [u8],
}

impl<'b> MachineBatch<'b> {
    /// The number of rows, after checks of the sizes of all inputs.
    ///
    /// # Errors
    ///
    /// Inputs of other sizes; no memory for the work of the threads.
    pub(crate) fn check(&self) -> Result<usize, SolveError> {
        let Shape { designs, positions, drivers } = *self.motion.shape;
        let rows = product(designs, positions)?;
        let fits = [self.driven.speed, self.driven.acceleration]
            .iter()
            .all(|values| self.covers(values, rows * drivers))
            && (rows == 0 || self.driven.external.len().is_multiple_of(rows));
        if !fits {
            return Err(SolveError::Shape("speeds, accelerations or values do not fit".into()));
        }
        variation::check(self.machine, self.variations, rows)?;
        self.motion.check()?;
        Ok(rows)
    }

    /// Whether numbers of the drivers are those of all rows, or one for all.
    pub(crate) fn covers(&self, values: &[f64], all: usize) -> bool {
        [all, self.motion.shape.drivers].contains(&values.len())
    }

    /// The working data of a thread.
    pub(crate) fn thread<R: Real, const G: usize>(&self) -> Positions<'b, R, G> {
        Positions {
            motion: self.motion.thread(),
            tables: vec![Vec::new(); self.machine.tables.len()],
            varied: vec![Vec::new(); self.variations.len()],
            followed: Followed::default(),
            known: Vec::new(),
            guides: Vec::new(),
        }
    }

    /// Solves the positions of the designs of a chunk, one design after another. `whole`: all positions of
    /// each, not those of the chunk.
    pub(crate) fn solve<L: Entry, const G: usize>(
        &self,
        state: &mut Positions<'b, L::Register, G>,
        chunk: &Chunk,
        whole: bool,
        mut each: impl FnMut(DesignPositions<'_>),
    ) {
        self.motion.read_designs(&mut state.motion, chunk);
        for asked in self.motion.designs(chunk, whole) {
            let speed = of_rows(self.driven.speed, self.motion.shape.drivers, &asked.rows);
            self.solve_design::<L, G>(state, &asked, speed, &mut each);
        }
        L::Register::fence();
    }

    /// Solves some positions of one design of the chunk whose designs were read, at speeds of the drivers,
    /// one for all or each its own; false if it has invalid dimensions.
    pub(crate) fn solve_design<L: Entry, const G: usize>(
        &self,
        state: &mut Positions<'b, L::Register, G>,
        asked: &Asked<'_>,
        speed: &[f64],
        each: &mut impl FnMut(DesignPositions<'_>),
    ) -> bool {
        let drivers = self.motion.shape.drivers;
        let Positions { motion, tables, varied, followed, known, guides } = state;
        let mut is_valid = true;
        self.motion.solve::<L, G>(motion, asked, |design| {
            is_valid = design.is_valid;
            if asked.binds {
                known.clear();
                let points = (0..self.plan.points.len()).filter(|&point| self.plan.is_known[point]);
                known.extend(points.map(|point| (point, design.design.fixed_point(point))));
                *guides = guide_directions(self.motion.mechanism, design.dimensions);
            }
            let size = design.design.constants.scale;
            for (table, values) in self.machine.tables.iter().zip(tables.iter_mut()) {
                values.clear();
                values.extend(design.q.iter().step_by(drivers).map(|&q| table.at(q)));
            }
            let rows = design.rows;
            let all = self.motion.shape.designs * self.motion.shape.positions;
            for (variation, values) in self.variations.iter().zip(varied.iter_mut()) {
                variation.at_rows(&rows, all, values);
            }
            let external = rows.start * self.callbacks..rows.end * self.callbacks;
            let solved = Solved {
                columns: design.columns,
                speed,
                acceleration: of_rows(self.driven.acceleration, drivers, &rows),
                positions: rows.len(),
            };
            if self.machine.follows() {
                let unit = |link: &Option<usize>| if link.is_some() { 1.0 } else { size };
                let units: Vec<f64> = self.plan.driven_links.iter().map(unit).collect();
                let drivers = Drivers { q: design.q, units: &units, sense: self.driven.sense };
                followed.read(self.machine, self.sources, &solved, drivers, size);
            }
            each(DesignPositions {
                index: design.index,
                rows,
                size,
                guides,
                known,
                design: is_valid.then_some(design.design),
                dimensions: design.dimensions,
                q: design.q,
                solved,
                values: Values {
                    tables,
                    over: &followed.over,
                    ways: &followed.ways,
                    external: &self.driven.external[external],
                    callbacks: self.callbacks,
                    varied: Varied { variations: self.variations, rows: varied },
                },
                status: design.status,
            });
        });
        is_valid
    }
}

impl<R: Real, const G: usize> Positions<'_, R, G> {
    /// Keeps the work space for later calls.
    pub(crate) fn finish(self) {
        self.motion.finish();
    }
}

/// The numbers of the drivers at some rows, or those for all.
pub(crate) fn of_rows<'a>(all: &'a [f64], drivers: usize, rows: &Range<usize>) -> &'a [f64] {
    if all.len() == drivers { all } else { &all[rows.start * drivers..rows.end * drivers] }
}
