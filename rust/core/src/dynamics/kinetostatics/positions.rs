//! The positions of many designs of a machine, solved chunk by chunk: kinematics, speeds, and what loads
//! read there.

use std::ops::Range;
use std::sync::Arc;

use super::followed::{Drivers, Followed};
use crate::batch::chunks::{Chunk, Designs};
use crate::batch::dispatch::Entry;
use crate::batch::request::{Column, Coordinates, Request, Shape, product};
use crate::batch::rows::Layout;
use crate::batch::schedule::Control;
use crate::batch::scratch::Scratch;
use crate::batch::worker::{Job, Worker};
use crate::batch::writer::Writer;
use crate::description::error::SolveError;
use crate::dynamics::machine::Machine;
use crate::dynamics::reactions::applied::Values;
use crate::dynamics::reactions::columns::{Solved, Sources, guide_directions};
use crate::dynamics::reactions::force_plan::ForcePlan;
use crate::math::derivatives::DerivativeTables;
use crate::math::lanes::Real;
use crate::math::vector::Vector;
use crate::plan::mechanism::Mechanism;

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
    pub mechanism: &'b Mechanism,
    pub machine: &'b Machine,
    pub plan: &'b ForcePlan,
    pub sources: &'b Sources,
    pub request: &'b Request<'b>,
    pub derivatives: &'b DerivativeTables,
    pub writer: &'b Arc<Writer>,
    pub columns: &'b [Column],
    pub driven: Driven<'b>,
    pub callbacks: usize,
    pub shape: &'b Shape,
    /// Most positions of a design that are solved at once: room for all of them would take seconds.
    pub most: usize,
    pub control: &'b Control<'b>,
}

/// The working data of one thread.
pub(crate) struct Positions<'b, R: Real, const G: usize> {
    worker: Worker<'b, R, G>,
    designs: Designs,
    scratch: Scratch,
    tables: Vec<Vec<f64>>,
    followed: Followed,
    known: Vec<(usize, Vector)>,
}

/// Positions of one design to solve.
pub(crate) struct Asked<'a> {
    /// Coordinates and speeds of the drivers, drivers fastest; one speed may serve all.
    pub q: &'a [f64],
    pub speed: &'a [f64],
    /// Offset into the shared coordinates, if shared.
    pub shared: Option<usize>,
    /// Index of the design in its chunk, and in the batch.
    pub index: usize,
    pub design: usize,
    /// Rows of the whole batch.
    pub rows: Range<usize>,
    /// Whether the design must be bound; else it is the one of the last call.
    pub binds: bool,
}

/// The solved positions of one design of a chunk.
pub(crate) struct DesignPositions<'d> {
    /// Index of the design in its chunk.
    pub index: usize,
    /// Rows of the whole batch.
    pub rows: Range<usize>,
    /// The size of the design, m.
    pub size: f64,
    pub guides: Vec<Vector>,
    /// Points of the ground that are known for the design.
    pub known: &'d [(usize, Vector)],
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
        let rows = product(self.shape.designs, self.shape.positions)?;
        let drivers = self.shape.drivers;
        let fits = [self.driven.speed, self.driven.acceleration]
            .iter()
            .all(|values| self.covers(values, rows * drivers))
            && (rows == 0 || self.driven.external.len().is_multiple_of(rows));
        if !fits {
            return Err(SolveError::Shape("speeds, accelerations or values do not fit".into()));
        }
        Scratch::check(self.columns, self.most, self.control)?;
        Ok(rows)
    }

    /// Whether numbers of the drivers are those of all rows, or one for all.
    pub(crate) fn covers(&self, values: &[f64], all: usize) -> bool {
        [all, self.shape.drivers].contains(&values.len())
    }

    /// The working data of a thread.
    pub(crate) fn thread<R: Real, const G: usize>(&self) -> Positions<'b, R, G> {
        let Self { mechanism, request, derivatives, writer, control, .. } = *self;
        Positions {
            worker: Worker::new(mechanism, request, derivatives, writer, control),
            designs: Designs::default(),
            scratch: Scratch::new(self.columns, self.most, Layout::Blocks),
            tables: vec![Vec::new(); self.machine.tables.len()],
            followed: Followed::default(),
            known: Vec::new(),
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
        let Shape { positions, drivers, .. } = *self.shape;
        let range = if whole { 0..positions } else { chunk.positions.clone() };
        self.read_designs(state, chunk);
        for (index, design) in chunk.designs.clone().enumerate() {
            if self.control.is_cancelled() {
                return;
            }
            let q = self.request.coordinates.of(design, positions * drivers);
            let shared = match self.request.coordinates {
                Coordinates::Shared(_) => Some(range.start),
                Coordinates::PerDesign(_) => None,
            };
            let first = design * positions + range.start;
            let rows = first..first + range.len();
            let asked = Asked {
                q: &q[range.start * drivers..range.end * drivers],
                speed: of_rows(self.driven.speed, drivers, &rows),
                shared,
                index,
                design,
                rows,
                binds: true,
            };
            self.solve_design::<L, G>(state, &asked, &mut each);
        }
        L::Register::fence();
    }

    /// Reads the dimensions of the designs of a chunk.
    pub(crate) fn read_designs<R: Real, const G: usize>(
        &self,
        state: &mut Positions<'b, R, G>,
        chunk: &Chunk,
    ) {
        let dimensions = self.request.dimensions;
        state.designs.read(self.mechanism, dimensions, self.shape.designs, chunk.designs.clone());
    }

    /// Solves some positions of one design of the chunk whose designs were read; false if it has invalid
    /// dimensions.
    pub(crate) fn solve_design<L: Entry, const G: usize>(
        &self,
        state: &mut Positions<'b, L::Register, G>,
        asked: &Asked<'_>,
        each: &mut impl FnMut(DesignPositions<'_>),
    ) -> bool {
        let drivers = self.shape.drivers;
        let Positions { worker, designs, scratch, tables, followed, known } = state;
        let &Asked { q, speed, shared, index, design, ref rows, binds } = asked;
        let row = designs.row(index);
        let mut scratch_rows = scratch.rows();
        let mut job = Job { index: rows.start, shared, ..scratch_rows.job(q, design) };
        let is_valid = !binds || worker.bind(row, &mut job);
        if is_valid {
            L::run(worker, &mut job);
        }
        scratch_rows.repeat_last(rows.len());
        known.clear();
        let points = (0..self.plan.points.len()).filter(|&point| self.plan.is_known[point]);
        known.extend(points.map(|point| (point, worker.fixed_point(point))));
        let size = worker.size();
        let unit = |link: &Option<usize>| if link.is_some() { 1.0 } else { size };
        let units: Vec<f64> = self.plan.driven_links.iter().map(unit).collect();
        let values: Vec<&[f64]> =
            (0..self.columns.len()).map(|column| scratch_rows.column(column)).collect();
        for (table, values) in self.machine.tables.iter().zip(tables.iter_mut()) {
            values.clear();
            values.extend(q.iter().step_by(drivers).map(|&q| table.at(q)));
        }
        let external = rows.start * self.callbacks..rows.end * self.callbacks;
        let solved = Solved {
            columns: &values,
            speed,
            acceleration: of_rows(self.driven.acceleration, drivers, rows),
            positions: rows.len(),
        };
        if self.machine.follows() {
            let drivers = Drivers { q, units: &units, sense: self.driven.sense };
            followed.read(self.machine, self.sources, &solved, drivers, size);
        }
        each(DesignPositions {
            index,
            rows: rows.clone(),
            size,
            guides: guide_directions(self.mechanism, row.dimensions),
            known,
            solved,
            values: Values {
                tables,
                over: &followed.over,
                ways: &followed.ways,
                external: &self.driven.external[external],
                callbacks: self.callbacks,
            },
            status: &scratch_rows.status()[..rows.len()],
        });
        is_valid
    }
}

impl<R: Real, const G: usize> Positions<'_, R, G> {
    /// Keeps the work space for later calls.
    pub(crate) fn finish(self) {
        self.worker.finish();
    }
}

/// The numbers of the drivers at some rows, or those for all.
pub(crate) fn of_rows<'a>(all: &'a [f64], drivers: usize, rows: &Range<usize>) -> &'a [f64] {
    if all.len() == drivers { all } else { &all[rows.start * drivers..rows.end * drivers] }
}
