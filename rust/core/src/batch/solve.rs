//! From a request (designs, coordinates, wanted outputs) to arrays.

use std::mem::MaybeUninit;

use super::outputs::{Column, Outputs, Quantity, Writer, columns};
use super::schedule::{Chunks, Control};
use super::streaming_store as stream;
use super::worker::{Job, Worker};
use crate::description::error::SolveError;
use crate::math::derivatives::Jets;
use crate::plan::mechanism::Mechanism;
use crate::plan::plan::Step;

/// Where the coordinates are taken from; `drivers` numbers a position.
#[derive(Debug, Clone, Copy)]
pub enum Coordinates<'a> {
    /// The same positions for every design.
    Shared(&'a [f64]),
    /// Positions of every design, one design after another.
    PerDesign(&'a [f64]),
}

impl<'a> Coordinates<'a> {
    /// The `count` numbers of one design.
    pub(crate) fn of(self, design: usize, count: usize) -> &'a [f64] {
        match self {
            Self::Shared(q) => q,
            Self::PerDesign(q) => &q[design * count..][..count],
        }
    }
}

/// What to solve.
#[derive(Debug, Clone)]
pub struct Request<'a> {
    /// Dimensions, one design after another.
    pub dimensions: &'a [f64],
    /// Coordinates, rad or m.
    pub coordinates: Coordinates<'a>,
    /// Assembly signs, +1 or −1 for every dyad with two solutions.
    pub signs: &'a [i8],
    /// Highest order of the analogues, 0 to 3.
    pub order: usize,
    /// What to keep.
    pub outputs: &'a Outputs,
    /// The dimension by which all of it is differentiated, in the order of
    /// [`Mechanism::dimensions`]; none: the motion itself.
    pub by: Option<usize>,
}

/// Value and analogues of one quantity over all designs and positions.
///
/// `derivatives[k]` is of order k (0: the value). Entries run over designs,
/// positions, components (2 for a point) and k driver indices, last fastest.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Track {
    /// Index of the joint, link or slide.
    pub index: usize,
    /// Arrays by order.
    pub derivatives: Vec<Vec<f64>>,
}

/// The motion of a batch of designs.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Motion {
    /// Number of designs.
    pub designs: usize,
    /// Positions of each design.
    pub positions: usize,
    /// Joints' places, m.
    pub joints: Vec<Track>,
    /// Links' angles, rad.
    pub links: Vec<Track>,
    /// Places of the links' reference points (first joint), m.
    pub places: Vec<Track>,
    /// Slides' values, m.
    pub slides: Vec<Track>,
    /// One [`crate::state::state::Status`] code a position.
    pub status: Vec<u8>,
}

/// Arrays to be filled, in the order of [`Request::columns`]; see [`fill`].
#[derive(Debug)]
pub struct Arrays<'a> {
    /// One array a column, of designs × positions × width numbers.
    pub columns: Vec<&'a mut [MaybeUninit<f64>]>,
    /// One [`crate::state::state::Status`] code a position.
    pub status: &'a mut [MaybeUninit<u8>],
}

impl Request<'_> {
    /// The arrays that this request fills.
    #[must_use]
    pub fn columns(&self, mechanism: &Mechanism) -> Vec<Column> {
        columns(self.outputs, mechanism.q0().len(), self.order)
    }

    /// Designs and positions of each.
    ///
    /// # Errors
    ///
    /// Those of [`Mechanism::solve`].
    pub fn shape(&self, mechanism: &Mechanism) -> Result<[usize; 2], SolveError> {
        let shape = Shape::of(mechanism, self)?;
        Ok([shape.designs, shape.positions])
    }

    /// Refuses arrays of other sizes than this request fills.
    ///
    /// # Errors
    ///
    /// That, and those of [`Mechanism::solve`].
    pub fn check_arrays(
        &self,
        mechanism: &Mechanism,
        arrays: &Arrays<'_>,
    ) -> Result<(), SolveError> {
        let [designs, positions] = self.shape(mechanism)?;
        check_arrays(&self.columns(mechanism), arrays, product(designs, positions)?)
    }
}

impl Mechanism {
    /// Solves designs at positions.
    ///
    /// # Errors
    ///
    /// [`SolveError`] for what concerns the whole request (shapes, orders). Single positions that
    /// cannot be had are NaN and have a
    /// status of their own.
    pub fn solve(&self, request: &Request<'_>) -> Result<Motion, SolveError> {
        self.solve_with(request, &Control::default())
    }

    /// Solves a request on as many threads and with such vector instructions as `control` says.
    ///
    /// # Errors
    ///
    /// Those of [`Mechanism::solve`]; [`SolveError::Interrupted`] if `control` was cancelled.
    pub fn solve_with(
        &self,
        request: &Request<'_>,
        control: &Control<'_>,
    ) -> Result<Motion, SolveError> {
        solve(self, request, control)
    }
}

/// Solves a request; see [`Mechanism::solve_with`].
///
/// # Errors
///
/// Those of [`Mechanism::solve`], and [`SolveError::Interrupted`].
pub fn solve(
    mechanism: &Mechanism,
    request: &Request<'_>,
    control: &Control<'_>,
) -> Result<Motion, SolveError> {
    let [designs, positions] = request.shape(mechanism)?;
    let rows = product(designs, positions)?;
    let columns = request.columns(mechanism);
    let mut values: Vec<Vec<f64>> = columns.iter().map(|c| vec![0.0; rows * c.width]).collect();
    let mut status = vec![0; rows];
    // SAFETY: `fill` stores nothing but numbers.
    #[allow(unsafe_code, reason = "the standard library has no safe form of this yet")]
    let arrays = unsafe {
        Arrays {
            columns: values.iter_mut().map(|v| as_unwritten(v)).collect(),
            status: as_unwritten(&mut status),
        }
    };
    fill(mechanism, request, arrays, control)?;
    let mut motion = Motion { designs, positions, status, ..Motion::default() };
    for (column, values) in columns.iter().zip(values) {
        let (list, index) = match column.quantity {
            Quantity::Joint(index) => (&mut motion.joints, index),
            Quantity::Place(index) => (&mut motion.places, index),
            Quantity::Slide(index) => (&mut motion.slides, index),
            Quantity::Angle(index) => (&mut motion.links, index),
        };
        if column.order == 0 {
            list.push(Track { index, derivatives: Vec::new() });
        }
        if let Some(track) = list.last_mut() {
            track.derivatives.push(values);
        }
    }
    Ok(motion)
}

fn product(designs: usize, positions: usize) -> Result<usize, SolveError> {
    let wrong = || SolveError::Shape(format!("{designs} × {positions} positions are too many"));
    designs.checked_mul(positions).ok_or_else(wrong)
}

/// Numbers seen as places to be written.
///
/// # Safety
///
/// Whoever has the places stores no uninitialised value there.
#[allow(unsafe_code, reason = "the standard library has no safe form of this yet")]
unsafe fn as_unwritten<T: Copy>(values: &mut [T]) -> &mut [MaybeUninit<T>] {
    // SAFETY: same layout; what is stored there are numbers, as the caller promises.
    unsafe { &mut *(std::ptr::from_mut(values) as *mut [MaybeUninit<T>]) }
}

/// Solves a request into arrays that are given.
///
/// # Errors
///
/// Those of [`Mechanism::solve`], and arrays of other sizes: nothing is written then.
/// [`SolveError::Interrupted`]: some numbers are written and others not.
pub fn fill(
    mechanism: &Mechanism,
    request: &Request<'_>,
    arrays: Arrays<'_>,
    control: &Control<'_>,
) -> Result<(), SolveError> {
    let shape = Shape::of(mechanism, request)?;
    let jets = Jets::new(shape.drivers, request.order);
    let columns = request.columns(mechanism);
    check_arrays(&columns, &arrays, product(shape.designs, shape.positions)?)?;
    let numbers = arrays.columns.iter().map(|column| column.len()).sum::<usize>();
    let mut writer = match request.by {
        None => Writer::new(mechanism, &jets, &columns),
        Some(index) => Writer::of_rates(mechanism, &jets, &columns, index),
    };
    writer.streams = numbers >= stream::LEAST;
    let chunks = Chunks::new(arrays, &columns, [shape.designs, shape.positions], shape.drivers);
    let worker = || Worker::new(mechanism, request, &jets, &writer, &columns, control);
    let per_design = shape.positions * shape.drivers;
    control.run(chunks, worker, |worker, chunk, mut rows| {
        for design in chunk.designs.clone() {
            if control.is_cancelled() {
                break;
            }
            let values = &request.dimensions[design * shape.dimensions..][..shape.dimensions];
            let q = request.coordinates.of(design, per_design);
            let q = &q[chunk.positions.start * shape.drivers..chunk.positions.end * shape.drivers];
            let shared = match request.coordinates {
                Coordinates::Shared(_) => Some(chunk.positions.start),
                Coordinates::PerDesign(_) => None,
            };
            let first = (design - chunk.designs.start) * chunk.positions.len();
            worker.solve(values, Job { q, rows: &mut rows, first, shared });
        }
        stream::fence();
    })
}

fn check_arrays(columns: &[Column], arrays: &Arrays<'_>, rows: usize) -> Result<(), SolveError> {
    let fits = columns.len() == arrays.columns.len()
        && columns.iter().zip(&arrays.columns).all(|(c, a)| a.len() == rows * c.width)
        && arrays.status.len() == rows;
    if fits { Ok(()) } else { Err(SolveError::Shape("the arrays do not fit the request".into())) }
}

struct Shape {
    designs: usize,
    positions: usize,
    drivers: usize,
    dimensions: usize,
}

impl Shape {
    fn of(mechanism: &Mechanism, request: &Request<'_>) -> Result<Self, SolveError> {
        if request.order > 3 {
            return Err(SolveError::Order(request.order));
        }
        let (dimensions, drivers) = (mechanism.dimensions().len(), mechanism.q0().len());
        if let Some(index) = request.by {
            if index >= dimensions {
                return Err(SolveError::Shape(format!("there is no dimension number {index}")));
            }
            let redundant = mechanism.plan().steps.iter().find_map(|step| match step {
                Step::Fit(fit) => Some(fit.name.clone()),
                _ => None,
            });
            if let Some(name) = redundant {
                return Err(SolveError::Redundant { name });
            }
        }
        let linkage = mechanism.linkage();
        let within = |wanted: &[usize], have: usize| wanted.iter().all(|&i| i < have);
        let held = request.outputs;
        if !(within(&held.joints, linkage.joints.len())
            && within(&held.links, linkage.links.len())
            && within(&held.slides, linkage.slides.len()))
        {
            return Err(SolveError::Shape("an output's index is beyond what there is".into()));
        }
        let wrong = |what: String| Err(SolveError::Shape(what));
        if request.signs.len() != mechanism.plan().signs() {
            return wrong(format!(
                "{} assembly signs were given, this mechanism has {} dyads with two solutions",
                request.signs.len(),
                mechanism.plan().signs()
            ));
        }
        let designs = request.dimensions.len().checked_div(dimensions).unwrap_or(1);
        if designs * dimensions != request.dimensions.len() {
            return wrong(format!(
                "{} numbers are not a whole number of designs of {dimensions} dimensions",
                request.dimensions.len()
            ));
        }
        let (count, per) = match request.coordinates {
            Coordinates::Shared(q) => (q.len(), drivers),
            Coordinates::PerDesign(q) => (q.len(), drivers * designs),
        };
        if per == 0 || count % per != 0 {
            return wrong(format!(
                "{count} coordinates do not divide into positions of {drivers} drivers"
            ));
        }
        Ok(Self { designs, positions: count / per, drivers, dimensions })
    }
}
