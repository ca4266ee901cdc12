//! The mechanism as Python sees it: names in, arrays out.

use std::mem::MaybeUninit;
use std::num::NonZeroUsize;
use std::sync::Mutex;
use std::sync::atomic::Ordering;

use assur::{
    Arrays, Control, Coordinates, Description, DriverDescription, Outputs, Quantity, Request,
    SlideDescription, SolveError, Status, fill,
};
use numpy::{PyArray1, PyArrayMethods, PyReadonlyArray1, PyReadwriteArray1, PyUntypedArrayMethods};
use pyo3::exceptions::{PyMemoryError, PyRuntimeError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PySlice};

use crate::error;
use crate::gate::{self, guard};

/// Positions below which a call with one driver ends sooner than a person can interrupt
/// it: some milliseconds. (With several drivers a single position may take that.)
const SMALL: usize = 100_000;
/// Dyads with two solutions below which all assemblies are found as soon.
const FEW_SIGNS: usize = 12;
/// Links below which a mechanism is built sooner than a person can interrupt it.
const FEW_LINKS: usize = 64;
/// Positions that take as long as one way from the drawing.
const WAY: usize = 1000;
/// Positions (with several drivers a part of them) that are looked at closely before
/// signals are.
const LOOK: usize = 8192;

/// Arrays by kind ("joint", "link", "place", "slide"), index and order; statuses.
type Solved<'py> = (Bound<'py, PyDict>, Bound<'py, PyArray1<u8>>);
/// Residuals and conditions.
type Diagnostics<'py> = (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>);
type SlideArguments = (String, String, String, f64, Option<String>);
type GroupParts =
    (usize, usize, Option<&'static str>, Option<usize>, Vec<String>, Vec<String>, Vec<String>);

/// A compiled mechanism.
#[pyclass(frozen, module = "assur._core")]
pub(crate) struct Mechanism {
    pub(crate) inner: assur::Mechanism,
}

#[pymethods]
impl Mechanism {
    #[new]
    fn new(
        py: Python<'_>,
        joints: Vec<(String, f64, f64)>,
        links: Vec<(String, Vec<String>)>,
        slides: Vec<SlideArguments>,
        drivers: Vec<(String, Option<String>)>,
        assembly: Vec<(String, i64)>,
    ) -> PyResult<Self> {
        let description = Description {
            joints: joints.into_iter().map(|(name, x, y)| (name, [x, y])).collect(),
            links,
            slides: slides
                .into_iter()
                .map(|(name, link, on, angle, origin)| SlideDescription {
                    name,
                    link,
                    on,
                    angle,
                    origin,
                })
                .collect(),
            drivers: drivers
                .into_iter()
                .map(|(name, relative_to)| match relative_to {
                    None => DriverDescription::Named(name),
                    Some(relative_to) => DriverDescription::Relative { link: name, relative_to },
                })
                .collect(),
            assembly,
        };
        let small = description.links.len() < FEW_LINKS;
        let built = gate::run(py, small, |cancel| {
            assur::Mechanism::new_unless(&description, Some(cancel))
        })?;
        Ok(Self { inner: built.map_err(error::structure)? })
    }

    /// Names of the dimensions, in order.
    #[getter]
    fn dimension_names(&self) -> Vec<String> {
        self.inner.dimensions().iter().map(|(name, _)| name.to_owned()).collect()
    }

    /// Dimensions of the drawing.
    #[getter]
    fn drawing(&self) -> Vec<f64> {
        self.inner.drawing().to_vec()
    }

    /// Coordinates of the drawing.
    #[getter]
    fn q0(&self) -> Vec<f64> {
        self.inner.q0().to_vec()
    }

    /// Inner pairs of the dyads with two solutions, with the drawing's signs.
    #[getter]
    fn assembly(&self) -> Vec<(String, i8)> {
        let names = self.inner.dyad_names().iter().cloned();
        names.zip(self.inner.signs().iter().copied()).collect()
    }

    /// How far the joints of the drawing were moved, at most, for redundant links to fit, m.
    #[getter]
    fn adjustment(&self) -> f64 {
        self.inner.adjustment()
    }

    /// The structural formula.
    #[getter]
    fn formula(&self) -> PyResult<String> {
        guard(|| Ok(self.inner.structure().formula()))
    }

    /// Mobility by rank, at the drawing, and counted.
    #[getter]
    fn mobility(&self) -> (usize, usize, i64) {
        let s = self.inner.structure();
        (s.mobility, s.mobility_at_drawing, s.mobility_counted)
    }

    /// Class of the mechanism.
    #[getter]
    fn cls(&self) -> usize {
        self.inner.structure().class()
    }

    /// Redundant links and slides.
    #[getter]
    fn redundant(&self) -> PyResult<(Vec<String>, Vec<String>)> {
        let redundant = &self.inner.structure().redundant;
        let linkage = self.inner.linkage();
        let links = || redundant.links.iter().map(|&l| linkage.links[l].name.clone()).collect();
        let slides = || redundant.slides.iter().map(|&s| linkage.slides[s].name.clone()).collect();
        guard(|| Ok((links(), slides())))
    }

    /// Groups: class, order, kind, Artobolevsky's number, links, joints, slides.
    #[getter]
    fn groups(&self) -> PyResult<Vec<GroupParts>> {
        let linkage = self.inner.linkage();
        let parts = |g: &assur::Group| {
            (
                g.class,
                g.order,
                g.kind,
                g.artobolevsky_kind(),
                g.links.iter().map(|&l| linkage.links[l].name.clone()).collect(),
                g.joints.iter().map(|&j| linkage.joints[j].name.clone()).collect(),
                g.slides.iter().map(|&s| linkage.slides[s].name.clone()).collect(),
            )
        };
        guard(|| Ok(self.inner.structure().groups.iter().map(parts).collect()))
    }

    /// Place of a dimension; an unknown name is refused with the nearest ones.
    fn dimension(&self, name: &str) -> PyResult<usize> {
        guard(|| self.inner.dimensions().position(name).map_err(error::solve))
    }

    /// Refuses a name that is no joint, link or slide.
    fn require(&self, kind: &str, name: &str) -> PyResult<usize> {
        let found = || match kind {
            "joint" => self.inner.joint(name),
            "link" => self.inner.link(name),
            _ => self.inner.slide(name),
        };
        guard(|| found().map_err(error::solve))
    }

    /// Refuses the first value that is no dimension.
    fn check_dimensions(&self, values: Vec<f64>) -> PyResult<()> {
        let fault = || self.inner.dimensions().first_fault(&values);
        guard(|| fault().map_or(Ok(()), |e| Err(error::solve(e))))
    }

    /// Solves designs at positions; see `assur.Mechanism.solve`. Outputs: indices of
    /// joints, links, links whose places are wanted, slides. `kept`: arrays of an earlier
    /// call (`columns`, `status`), written again; it is not `complete` while they are. `by`: the
    /// dimension by which all is differentiated.
    #[allow(clippy::too_many_arguments, reason = "the one call across the border")]
    fn solve<'py>(
        &self,
        py: Python<'py>,
        dimensions: PyReadonlyArray1<'py, f64>,
        q: PyReadonlyArray1<'py, f64>,
        per_design: bool,
        signs: Vec<i8>,
        order: usize,
        outputs: [Vec<usize>; 4],
        threads: Option<NonZeroUsize>,
        kept: Option<Bound<'py, PyAny>>,
        by: Option<usize>,
    ) -> PyResult<Solved<'py>> {
        let (dimensions, q) = (dimensions.as_slice()?.to_vec(), q.as_slice()?.to_vec());
        let [joints, links, places, slides] = outputs;
        let outputs = Outputs { joints, links, places, slides };
        let coordinates =
            if per_design { Coordinates::PerDesign(&q) } else { Coordinates::Shared(&q) };
        let request = Request {
            dimensions: &dimensions,
            coordinates,
            signs: &signs,
            order,
            outputs: &outputs,
            by,
        };
        let shape = || request.shape(&self.inner).map_err(error::solve);
        let [designs, positions] = guard(shape)?;
        let columns = request.columns(&self.inner);
        let rows = designs.saturating_mul(positions);
        let (values, status): (Vec<Bound<'py, PyArray1<f64>>>, Bound<'py, PyArray1<u8>>) =
            if let Some(kept) = &kept {
                (kept.getattr("columns")?.extract()?, kept.getattr("status")?.extract()?)
            } else {
                let status = unwritten::<u8>(py, rows, 1)?;
                let new = columns.iter().map(|column| unwritten::<f64>(py, rows, column.width));
                (new.collect::<PyResult<_>>()?, status)
            };
        // Two calls cannot write the same arrays at once.
        let mut held = Vec::new();
        for array in &values {
            held.push(array.try_readwrite().map_err(in_use)?);
        }
        let mut held_status = status.try_readwrite().map_err(in_use)?;
        let arrays = Arrays {
            columns: held.iter_mut().map(places_of).collect::<PyResult<_>>()?,
            status: places_of(&mut held_status)?,
        };
        request.check_arrays(&self.inner, &arrays).map_err(error::solve)?;
        let arrays = Mutex::new(Some(arrays));
        let quick = rows.saturating_add(designs.saturating_mul(WAY)) < SMALL;
        let small = self.inner.q0().len() == 1 && quick;
        if let Some(kept) = &kept {
            kept.setattr("complete", false)?;
        }
        let solved = gate::run(py, small, |cancel| {
            let control = Control { threads, cancel: Some(cancel), ..Control::default() };
            let arrays = arrays.lock().ok().and_then(|mut arrays| arrays.take());
            arrays.map_or(Err(SolveError::Interrupted), |arrays| {
                fill(&self.inner, &request, arrays, &control)
            })
        });
        drop(arrays);
        if let (Some(_), Err(error)) = (&kept, &solved)
            && error::is_internal(py, error)
        {
            // Whoever took arrays from the earlier motion reads no mixture of it and this one.
            for array in &mut held {
                array.as_slice_mut()?.fill(f64::NAN);
            }
            held_status.as_slice_mut()?.fill(Status::Lost as u8);
        }
        solved?.map_err(error::solve)?;
        if let Some(kept) = &kept {
            kept.setattr("complete", true)?;
        }
        drop((held, held_status));
        let dict = PyDict::new(py);
        for (column, values) in columns.iter().zip(values) {
            let (kind, index) = match column.quantity {
                Quantity::Joint(index) => ("joint", index),
                Quantity::Angle(index) => ("link", index),
                Quantity::Place(index) => ("place", index),
                Quantity::Slide(index) => ("slide", index),
            };
            dict.set_item((kind, index, column.order), values)?;
        }
        Ok((dict, status))
    }

    /// Residual and condition of every position.
    fn diagnostics<'py>(
        &self,
        py: Python<'py>,
        dimensions: PyReadonlyArray1<'py, f64>,
        q: PyReadonlyArray1<'py, f64>,
        per_design: bool,
        signs: Vec<i8>,
    ) -> PyResult<Diagnostics<'py>> {
        let (dimensions, q) = (dimensions.as_slice()?.to_vec(), q.as_slice()?.to_vec());
        let (size, drivers) = (self.inner.dimensions().len(), self.inner.q0().len());
        let designs = dimensions.len().checked_div(size).unwrap_or(1);
        let positions = q.len() / drivers / if per_design { designs.max(1) } else { 1 };
        let small = drivers == 1 && designs * (positions + 1) < LOOK;
        let together = if drivers == 1 { LOOK } else { LOOK / 1024 } * drivers;
        let both = gate::run(py, small, |cancel| {
            let (mut residual, mut condition) = (Vec::new(), Vec::new());
            for design in 0..designs {
                let values = &dimensions[design * size..][..size];
                let own = if per_design { design * positions * drivers } else { 0 };
                for some in q[own..][..positions * drivers].chunks(together) {
                    if cancel.load(Ordering::Relaxed) {
                        return Ok((residual, condition));
                    }
                    for d in self.inner.diagnose(values, some, &signs)? {
                        residual.push(d.residual);
                        condition.push(d.condition);
                    }
                }
            }
            Ok((residual, condition))
        })?
        .map_err(error::solve)?;
        Ok((PyArray1::from_vec(py, both.0), PyArray1::from_vec(py, both.1)))
    }

    /// One position looked at closely: status, name concerned, sentence.
    fn explain(
        &self,
        dimensions: Vec<f64>,
        q: Vec<f64>,
        signs: Vec<i8>,
    ) -> PyResult<(u8, Option<String>, String)> {
        guard(|| {
            let found = self.inner.diagnose(&dimensions, &q, &signs).map_err(error::solve)?;
            let one = found.into_iter().next();
            one.map(|d| (d.status as u8, d.name, d.sentence))
                .ok_or_else(|| error::input("no coordinate".into(), None))
        })
    }

    /// Every assembly that exists at `q`, as signs.
    fn assemblies(
        &self,
        py: Python<'_>,
        dimensions: Vec<f64>,
        q: Vec<f64>,
    ) -> PyResult<Vec<Vec<i8>>> {
        let small = self.inner.signs().len() < FEW_SIGNS;
        let found = gate::run(py, small, |cancel| {
            self.inner.assemblies_unless(&dimensions, &q, Some(cancel))
        })?;
        found.map_err(error::solve)
    }

    /// Names and codes of the statuses.
    #[staticmethod]
    fn statuses() -> Vec<(&'static str, u8)> {
        [
            ("OK", Status::Ok),
            ("NEAR_SINGULAR", Status::NearSingular),
            ("SINGULAR", Status::Singular),
            ("UNREACHABLE", Status::Unreachable),
            ("LOST", Status::Lost),
            ("NOT_CONVERGED", Status::NotConverged),
            ("BAD_DIMENSION", Status::BadDimension),
            ("BAD_INPUT", Status::BadInput),
        ]
        .map(|(name, status)| (name, status as u8))
        .to_vec()
    }
}

/// A NumPy array whose numbers are yet to be written; `MemoryError` where there is no room.
fn unwritten<T: numpy::Element>(
    py: Python<'_>,
    rows: usize,
    width: usize,
) -> PyResult<Bound<'_, PyArray1<T>>> {
    let len = rows.checked_mul(width).and_then(|len| len.checked_add(LINE)).ok_or_else(|| {
        PyMemoryError::new_err(
            "the result has more numbers than can be counted: ask for fewer designs or positions",
        )
    })?;
    let array = py.import("numpy")?.call_method1("empty", (len, T::get_dtype(py)))?;
    let array: Bound<'_, PyArray1<T>> = array.cast_into()?;
    // Rows of eight numbers that begin with a line of the cache are written quicker.
    let first = array.data().align_offset(LINE).min(LINE);
    let some = PySlice::new(py, first.cast_signed(), (first + len - LINE).cast_signed(), 1);
    Ok(array.get_item(some)?.cast_into()?)
}

/// Bytes of a line of the cache, and more than its numbers.
const LINE: usize = 64;

fn in_use(error: numpy::BorrowError) -> PyErr {
    PyRuntimeError::new_err(format!("the arrays given to out= are in use: {error}"))
}

/// The places of an array that is held for writing.
fn places_of<'a, T: numpy::Element>(
    array: &'a mut PyReadwriteArray1<'_, T>,
) -> PyResult<&'a mut [MaybeUninit<T>]> {
    let data: *mut T = array.data();
    if !(array.is_c_contiguous() && data.is_aligned()) {
        let message = "out: its arrays are not contiguous: only those of a motion can be written";
        return Err(error::input(message.into(), None));
    }
    #[allow(unsafe_code, reason = "NumPy knows no places that are not written")]
    // SAFETY: one-dimensional, contiguous and aligned (looked at above), of this length; the
    // exclusive borrow keeps other calls away. `fill` writes every number, or nobody reads them:
    // new arrays are dropped, those of a motion are marked as not complete.
    let places = unsafe { std::slice::from_raw_parts_mut(data.cast(), array.len()) };
    Ok(places)
}
