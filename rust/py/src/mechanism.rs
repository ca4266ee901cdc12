//! The mechanism for Python: names in, arrays out.

use std::num::NonZeroUsize;
use std::sync::atomic::Ordering;

use assur::sweep::Moves;
use assur::{Description, Named, Status};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyList;

use crate::convert::description::{Driver, Slide};
use crate::convert::metric::{metric_of, part};
use crate::convert::word::Word;
use crate::detach::{self, catch_panic};
use crate::motion::sensitivity::{self, Derivatives, ResultKey};
use crate::motion::short_calls::{FEW_ASSEMBLIES, FEW_LINKS, FEW_SIGNS, is_small};
use crate::motion::solve::{KnownSigns, Question, Solution};
use crate::sweep::{self, Found};
use crate::{assemblies, error, error_map, limits, reserve};

/// Positions to diagnose between two checks for cancellation; fewer with several drivers.
const POSITIONS_PER_CHECK: usize = 8192;

/// Residuals and conditions.
type Diagnostics<'py> = (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>);

/// Places of joints, directions of guides, the greatest change of a coordinate.
type Fitted = (Vec<(f64, f64)>, Vec<f64>, f64);

/// An Assur group with the names of its links, joints and slides.
#[derive(IntoPyObject)]
pub(crate) struct GroupFields {
    cls: usize,
    order: usize,
    kind: Option<&'static str>,
    artobolevsky_kind: Option<usize>,
    links: Vec<String>,
    joints: Vec<String>,
    slides: Vec<String>,
}

pub(crate) fn described(
    joints: Vec<(String, f64, f64)>,
    links: Vec<(String, Vec<String>)>,
    slides: Vec<(String, Slide)>,
    drivers: Vec<Driver>,
    assembly: Vec<(String, i64)>,
) -> Description {
    Description {
        joints: joints.into_iter().map(|(name, x, y)| (name, [x, y])).collect(),
        links,
        slides: slides.into_iter().map(|(name, slide)| slide.named(name)).collect(),
        drivers: drivers.into_iter().map(|driver| driver.0).collect(),
        assembly,
    }
}

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
        slides: Vec<(String, Slide)>,
        drivers: Vec<Driver>,
        assembly: Vec<(String, i64)>,
    ) -> PyResult<Self> {
        let description = described(joints, links, slides, drivers, assembly);
        let small = description.links.len() < FEW_LINKS;
        let built = detach::run(py, small, |cancel| {
            assur::Mechanism::new_unless(&description, Some(cancel))
        })?;
        Ok(Self { inner: built.map_err(error_map::structure)? })
    }

    /// Places of joints and directions of guides of a drawing that is adjusted within a tolerance
    /// (m, rad) so that its redundant links fit, and the greatest change of a coordinate, m.
    #[staticmethod]
    #[pyo3(signature = (joints, links, slides, drivers, assembly, *, tolerance))]
    fn fit(
        py: Python<'_>,
        joints: Vec<(String, f64, f64)>,
        links: Vec<(String, Vec<String>)>,
        slides: Vec<(String, Slide)>,
        drivers: Vec<Driver>,
        assembly: Vec<(String, i64)>,
        tolerance: (f64, Option<f64>),
    ) -> PyResult<Fitted> {
        let description = described(joints, links, slides, drivers, assembly);
        let (length, angle) = tolerance;
        let small = description.links.len() < FEW_LINKS;
        let result =
            detach::run(py, small, |cancel| assur::fit(&description, length, angle, Some(cancel)))?;
        let (fitted, change) = result.map_err(error_map::structure)?;
        let places = fitted.joints.into_iter().map(|(_, [x, y])| (x, y)).collect();
        let angles = fitted.slides.into_iter().map(|slide| slide.angle).collect();
        Ok((places, angles, change.length))
    }

    /// Compiles a drawing that need not show the assembly.
    #[staticmethod]
    fn for_pose(
        joints: Vec<(String, f64, f64)>,
        links: Vec<(String, Vec<String>)>,
        slides: Vec<(String, Slide)>,
        drivers: Vec<Driver>,
    ) -> PyResult<Self> {
        catch_panic(|| {
            let description = described(joints, links, slides, drivers, Vec::new());
            let inner = assur::Mechanism::new_for_pose(&description);
            Ok(Self { inner: inner.map_err(error_map::structure)? })
        })
    }

    /// Coordinates of the drivers in a pose (joints, angles of links, values of slides), and the
    /// assembly that it shows.
    fn at_pose(
        &self,
        joints: Vec<(f64, f64)>,
        angles: Vec<f64>,
        slides: Vec<f64>,
    ) -> PyResult<(Vec<f64>, assemblies::AssemblyNumbers)> {
        catch_panic(|| {
            let joints = joints.into_iter().map(|(x, y)| [x, y]).collect();
            let pose = assur::Pose { joints, angles, slides };
            let (q, assembly) = self.inner.at_pose(&pose).map_err(error_map::structure)?;
            Ok((q, assembly.into()))
        })
    }

    /// Least and greatest value of a coordinate (a joint's with its component, a link's, a slide's)
    /// or of a derivative of it, each with its place, over all intervals or the one that contains `within`;
    /// `None` if the assembly does not exist there.
    #[pyo3(signature = (dimensions, signs, coordinate, order, within=None))]
    fn extremes(
        &self,
        py: Python<'_>,
        dimensions: Vec<f64>,
        signs: Vec<i8>,
        coordinate: &str,
        order: usize,
        within: Option<f64>,
    ) -> PyResult<Option<[(f64, f64); 2]>> {
        let tracked = (self.inner.coordinate(coordinate).map_err(error_map::solve)?, order);
        let extremes = detach::run(py, is_small(&self.inner), |cancel| {
            self.inner.extremes(&dimensions, &signs, tracked, within, Some(cancel))
        })?;
        let pair = |extreme: assur::ValueAt| (extreme.value, extreme.q);
        Ok(extremes.map_err(error_map::solve)?.map(|both| both.map(pair)))
    }

    /// Stretches over which a coordinate is at least, or at most, at a level.
    fn stretches_beyond(
        &self,
        py: Python<'_>,
        dimensions: Vec<f64>,
        signs: Vec<i8>,
        coordinate: &str,
        order: usize,
        level: (f64, bool),
    ) -> PyResult<Vec<[f64; 2]>> {
        let tracked = (self.inner.coordinate(coordinate).map_err(error_map::solve)?, order);
        let stretches = detach::run(py, is_small(&self.inner), |cancel| {
            self.inner.stretches_beyond(&dimensions, &signs, tracked, level, Some(cancel))
        })?;
        stretches.map_err(error_map::solve)
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

    /// Inner pairs of the dyads with two solutions, and their signs in the drawing.
    #[getter]
    fn assembly(&self) -> Vec<(String, i8)> {
        let names = self.inner.dyad_names().iter().cloned();
        names.zip(self.inner.signs().iter().copied()).collect()
    }

    /// The pairs among them whose sign is always +1, because a length is never negative.
    #[getter]
    fn lengths(&self) -> Vec<String> {
        self.inner.lengths().into_iter().map(Into::into).collect()
    }

    /// Greatest change of a joint's coordinate by the adjustment for redundant links, m.
    #[getter]
    fn adjustment(&self) -> f64 {
        self.inner.adjustment()
    }

    /// The structural formula.
    #[getter]
    fn formula(&self) -> PyResult<String> {
        catch_panic(|| Ok(self.inner.structure().formula()))
    }

    /// Mobility: by rank, at the drawing, and by counting.
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
        catch_panic(|| Ok((links(), slides())))
    }

    /// Groups in solving order.
    #[getter]
    fn groups(&self) -> PyResult<Vec<GroupFields>> {
        let linkage = self.inner.linkage();
        let parts = |g: &assur::Group| GroupFields {
            cls: g.class,
            order: g.order,
            kind: g.kind,
            artobolevsky_kind: g.artobolevsky_kind(),
            links: g.links.iter().map(|&l| linkage.links[l].name.clone()).collect(),
            joints: g.joints.iter().map(|&j| linkage.joints[j].name.clone()).collect(),
            slides: g.slides.iter().map(|&s| linkage.slides[s].name.clone()).collect(),
        };
        catch_panic(|| Ok(self.inner.structure().groups.iter().map(parts).collect()))
    }

    /// Index of a dimension. Raises `InputError` with similar names if the name is unknown.
    fn dimension(&self, name: &str) -> PyResult<usize> {
        catch_panic(|| self.inner.dimensions().position(name).map_err(error_map::solve))
    }

    /// Index of a joint, link or slide. Raises `InputError` if the name is unknown.
    fn index_of(&self, kind: Word<Named>, name: &str) -> PyResult<usize> {
        let index = || match kind.0 {
            Named::Joint => self.inner.joint(name),
            Named::Link => self.inner.link(name),
            _ => self.inner.slide(name),
        };
        catch_panic(|| index().map_err(error_map::solve))
    }

    /// Raises `InputError` if a name is not that of a coordinate.
    fn check_coordinate(&self, name: &str) -> PyResult<()> {
        catch_panic(|| self.inner.coordinate(name).map(drop).map_err(error_map::solve))
    }

    /// The link that takes a load at a joint, and whether another link could take it too: several links
    /// have the joint, and a single block is not among them. Raises `InputError` if the name is unknown.
    fn loaded_link(&self, joint: &str) -> PyResult<(String, bool)> {
        catch_panic(|| {
            let (linkage, joint) = (self.inner.linkage(), self.inner.joint(joint));
            let joint = joint.map_err(error_map::solve)?;
            let several = linkage.links_at(joint).nth(1).is_some();
            let is_open = several && linkage.block_at(joint).is_none();
            Ok((linkage.links[linkage.loaded_link(joint)].name.clone(), is_open))
        })
    }

    /// Raises `DimensionError` for the first invalid value.
    fn check_dimensions(&self, values: Vec<f64>) -> PyResult<()> {
        let fault = || self.inner.dimensions().first_fault(&values);
        catch_panic(|| fault().map_or(Ok(()), |e| Err(error_map::solve(e))))
    }

    /// Solves designs at positions; see `assur.Mechanism.solve`. `outputs`: indices of joints,
    /// links (angles), links (reference points) and slides. `buffers`: the arrays of an earlier result
    /// (`arrays`, `status`) to overwrite; its `complete` is false meanwhile. `report`: the shape of the designs, for the exception of the
    /// first position that failed. `known_signs`: valid for these dimensions and signs.
    #[allow(clippy::too_many_arguments, reason = "the one call across the border")]
    #[pyo3(signature = (
        dimensions, q, per_design, signs, order, outputs, threads, buffers, report,
        known_signs = None
    ))]
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
        buffers: Option<Bound<'py, PyAny>>,
        report: Option<Vec<usize>>,
        known_signs: Option<Bound<'py, KnownSigns>>,
    ) -> PyResult<Solution<'py>> {
        let question = Question {
            mechanism: &self.inner,
            dimensions,
            q,
            per_design,
            signs: &signs,
            order,
            outputs,
            known_signs,
        };
        question.answer(py, threads, buffers, report)
    }

    /// Indices of the positions within a range of the driver's coordinate, as metrics `over` it have them.
    fn places_within(
        &self,
        q: PyReadonlyArray1<'_, f64>,
        over: (f64, f64),
    ) -> PyResult<Vec<usize>> {
        let q = q.as_slice()?;
        catch_panic(|| Ok(part(&self.inner, Moves, over).places(q)))
    }

    /// Derivatives of results by dimensions, or their products with vectors; see `assur.Motion.jacobian`.
    /// `of`: kind, index and order of each result; `by`: indices of dimensions; `shape`: designs, positions.
    #[allow(clippy::too_many_arguments, reason = "the one call across the border")]
    #[pyo3(signature = (
        dimensions, q, per_design, signs, shape, of, by, threads, *, rates = None, weights = None,
        total = false, of_squares = false
    ))]
    fn sensitivities<'py>(
        &self,
        py: Python<'py>,
        dimensions: PyReadonlyArray1<'py, f64>,
        q: PyReadonlyArray1<'py, f64>,
        per_design: bool,
        signs: Vec<i8>,
        shape: [usize; 2],
        of: Vec<ResultKey>,
        by: Vec<usize>,
        threads: Option<NonZeroUsize>,
        rates: Option<PyReadonlyArray1<'py, f64>>,
        weights: Option<Vec<PyReadonlyArray1<'py, f64>>>,
        total: bool,
        of_squares: bool,
    ) -> PyResult<Derivatives<'py>> {
        let positions = sensitivity::Positions { dimensions, q, per_design, signs: &signs, shape };
        let vectors = sensitivity::Vectors { rates, weights, total, of_squares };
        sensitivity::sensitivities(py, &self.inner, &positions, (&of, &by), &vectors, threads)
    }

    /// Metrics of designs; see `assur.sweep`. `conditions`: metric, relation and limit; `gradients`: indices
    /// of means, and of the dimensions.
    #[allow(clippy::too_many_arguments, reason = "the one call across the border")]
    fn measure<'py>(
        &self,
        py: Python<'py>,
        dimensions: PyReadonlyArray1<'py, f64>,
        q: PyReadonlyArray1<'py, f64>,
        signs: Vec<i8>,
        metrics: Vec<Bound<'py, PyAny>>,
        conditions: Vec<(usize, Word<assur::sweep::Relation>, f64)>,
        gradients: (Vec<usize>, Vec<usize>),
        threads: Option<NonZeroUsize>,
    ) -> PyResult<Found<'py>> {
        let (designs, gradients) = ((dimensions, q), (&gradients.0[..], &gradients.1[..]));
        let asked = (&metrics[..], conditions);
        sweep::measure(py, &self.inner, designs, &signs, asked, gradients, threads)
    }

    /// The reason why a metric has no meaning at coordinates, if any.
    fn refusal_of_metric(
        &self,
        q: PyReadonlyArray1<'_, f64>,
        metric: Bound<'_, PyAny>,
    ) -> PyResult<Option<String>> {
        let q = q.as_slice()?;
        catch_panic(|| Ok(metric_of(&self.inner, &metric)?.check(&self.inner.course(q)).err()))
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
        let _room = reserve::room_for(py, dimensions.as_array().len() + 3 * q.as_array().len())?;
        let (dimensions, q) = (dimensions.as_slice()?.to_vec(), q.as_slice()?.to_vec());
        let (size, drivers) = (self.inner.dimensions().len(), self.inner.q0().len());
        let designs = dimensions.len().checked_div(size).unwrap_or(1);
        let positions = q.len() / drivers / if per_design { designs.max(1) } else { 1 };
        let small = drivers == 1 && designs * (positions + 1) < POSITIONS_PER_CHECK;
        let chunk =
            if drivers == 1 { POSITIONS_PER_CHECK } else { POSITIONS_PER_CHECK / 1024 } * drivers;
        let diagnostics = detach::run(py, small, |cancel| {
            let (mut residual, mut condition) = (Vec::new(), Vec::new());
            for design in 0..designs {
                let values: Vec<f64> =
                    (0..size).map(|index| dimensions[index * designs + design]).collect();
                let first = if per_design { design * positions * drivers } else { 0 };
                for coordinates in q[first..][..positions * drivers].chunks(chunk) {
                    if cancel.load(Ordering::Relaxed) {
                        return Ok((residual, condition));
                    }
                    for d in self.inner.diagnose(&values, coordinates, &signs)? {
                        residual.push(d.residual);
                        condition.push(d.condition);
                    }
                }
            }
            Ok((residual, condition))
        })?
        .map_err(error_map::solve)?;
        Ok((PyArray1::from_vec(py, diagnostics.0), PyArray1::from_vec(py, diagnostics.1)))
    }

    /// The outcome of one position, as a sentence.
    fn explain(&self, dimensions: Vec<f64>, q: Vec<f64>, signs: Vec<i8>) -> PyResult<String> {
        catch_panic(|| {
            let diagnoses =
                self.inner.diagnose(&dimensions, &q, &signs).map_err(error_map::solve)?;
            let sentence = diagnoses.first().map(ToString::to_string);
            sentence.ok_or_else(|| error::input("no coordinate", None))
        })
    }

    /// Every assembly of designs at positions.
    fn assemblies<'py>(
        &self,
        py: Python<'py>,
        dimensions: PyReadonlyArray1<'py, f64>,
        q: PyReadonlyArray1<'py, f64>,
        per_design: bool,
        threads: Option<usize>,
    ) -> PyResult<Bound<'py, PyList>> {
        let _room = reserve::room_for(py, dimensions.as_array().len() + q.as_array().len())?;
        let (dimensions, q) = (dimensions.as_slice()?.to_vec(), q.as_slice()?.to_vec());
        let (mechanism, dimensions, q) = (&self.inner, &dimensions[..], &q[..]);
        let question = assemblies::Question { mechanism, dimensions, q, per_design };
        let [designs, positions] = question.shape();
        let is_quick = mechanism.structure().class() <= 2 && mechanism.signs().len() < FEW_SIGNS;
        let small = is_quick && designs * positions < FEW_ASSEMBLIES;
        let answers = detach::run(py, small, |cancel| question.answer(threads, cancel))?;
        assemblies::Found::of_all(py, answers.map_err(error_map::solve)?)
    }

    /// The intervals where an assembly of designs exists.
    fn limits<'py>(
        &self,
        py: Python<'py>,
        dimensions: PyReadonlyArray1<'py, f64>,
        signs: Vec<i8>,
        threads: Option<usize>,
    ) -> PyResult<limits::FoundLimits<'py>> {
        let _room = reserve::room_for(py, 2 * dimensions.as_array().len())?;
        let dimensions = dimensions.as_slice()?.to_vec();
        let designs = dimensions.len() / self.inner.dimensions().len().max(1);
        let small = is_small(&self.inner) && designs < FEW_ASSEMBLIES;
        let result = detach::run(py, small, |cancel| {
            limits::find(&self.inner, &dimensions, &signs, threads, cancel)
        })?;
        Ok(limits::arrays(py, &result.map_err(error_map::solve)?, self.inner.fold_names()))
    }

    /// The mechanism drawn in an assembly of a design.
    fn drawn_in(
        &self,
        dimensions: Vec<f64>,
        q: Vec<f64>,
        assembly: assemblies::AssemblyNumbers,
    ) -> PyResult<Self> {
        catch_panic(|| {
            let drawn = self.inner.drawn_in(&dimensions, &q, &assembly.into());
            Ok(Self { inner: drawn.map_err(error_map::solve)? })
        })
    }

    /// Names and codes of the statuses.
    #[staticmethod]
    fn statuses() -> Vec<(&'static str, u8)> {
        STATUSES.map(|(name, status)| (name, status as u8)).to_vec()
    }
}

/// The statuses and their names in Python.
pub(crate) const STATUSES: [(&str, Status); 8] = [
    ("OK", Status::Ok),
    ("NEAR_SINGULAR", Status::NearSingular),
    ("SINGULAR", Status::Singular),
    ("UNREACHABLE", Status::Unreachable),
    ("LOST", Status::Lost),
    ("NOT_CONVERGED", Status::NotConverged),
    ("BAD_DIMENSION", Status::BadDimension),
    ("BAD_INPUT", Status::BadInput),
];
