//! Targets of metrics: paths, functions and poses.

use assur::sweep::{Coordinate, Fitted, FunctionError, PathDistance, PathError, PoseError};
use numpy::{PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

use super::word::Word;
use crate::detach::catch_panic;
use crate::{error, reserve};

/// Numbers in rows, all of one width.
#[derive(FromPyObject)]
struct Rows<'py> {
    array: PyReadonlyArray2<'py, f64>,
}

impl Rows<'_> {
    fn read<const N: usize>(&self) -> PyResult<Vec<[f64; N]>> {
        rows(&self.array)
    }
}

/// One number after another.
#[derive(FromPyObject)]
struct Numbers<'py> {
    array: PyReadonlyArray1<'py, f64>,
}

fn rows<const N: usize>(array: &PyReadonlyArray2<'_, f64>) -> PyResult<Vec<[f64; N]>> {
    let rows = array.as_slice()?.as_chunks::<N>().0;
    reserve::collected(rows.len(), rows.iter().copied())
}

fn refused(reason: String) -> PyErr {
    error::input(&reason, None)
}

/// See `assur.metric.path_error`.
pub(super) fn path_error(joint: usize, options: &Bound<'_, PyAny>) -> PyResult<PathError> {
    let (points, Word(distance), closed): (Rows, Word<PathDistance>, Option<bool>) =
        options.extract()?;
    PathError::new(joint, &points.read()?, distance, closed).map_err(refused)
}

/// See `assur.metric.function_error`. Options: indices of positions, values there, and what is fitted.
pub(super) fn function_error(
    of: Coordinate,
    options: &Bound<'_, PyAny>,
) -> PyResult<FunctionError> {
    let (places, values, Word(fitted)): (Vec<usize>, Numbers, Word<Fitted>) = options.extract()?;
    let values = values.array.as_slice()?;
    let wanted = places.into_iter().zip(values.iter().copied()).collect();
    Ok(FunctionError::new(of, wanted, fitted))
}

/// See `assur.metric.pose_error`.
pub(super) fn pose_error(link: usize, options: &Bound<'_, PyAny>) -> PyResult<PoseError> {
    let (poses, length): (Rows, Option<f64>) = options.extract()?;
    PoseError::new(link, &poses.read()?, length).map_err(refused)
}

/// The reason why points make no target of a path, if any.
#[pyfunction]
pub(crate) fn refusal_of_path(
    points: PyReadonlyArray2<'_, f64>,
    kind: Word<PathDistance>,
    closed: Option<bool>,
) -> PyResult<Option<String>> {
    catch_panic(|| Ok(PathError::new(0, &rows(&points)?, kind.0, closed).err()))
}

/// The reason why poses make no target of a link, if any.
#[pyfunction]
pub(crate) fn refusal_of_poses(
    poses: PyReadonlyArray2<'_, f64>,
    length: Option<f64>,
) -> PyResult<Option<String>> {
    catch_panic(|| Ok(PoseError::new(0, &rows(&poses)?, length).err()))
}
