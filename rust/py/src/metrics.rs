//! Pointwise metrics of flat arrays; Python reshapes them.

use assur::{Vector, metrics};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::{detach, reserve};

/// Vectors of a flat array of x, y.
fn vectors(array: &PyReadonlyArray1<'_, f64>) -> PyResult<Vec<Vector>> {
    let pairs = array.as_slice()?.as_chunks::<2>().0;
    reserve::collected(pairs.len(), pairs.iter().map(|&[x, y]| Vector::new(x, y)))
}

pub(crate) fn check_same_length(a: usize, b: usize) -> PyResult<()> {
    if a == b {
        Ok(())
    } else {
        Err(PyValueError::new_err(format!("{a} and {b} entries do not match")))
    }
}

/// Acute angles between pairs of directions (flat x, y).
#[pyfunction]
pub(crate) fn acute<'py>(
    py: Python<'py>,
    a: PyReadonlyArray1<'py, f64>,
    b: PyReadonlyArray1<'py, f64>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let (a, b) = (vectors(&a)?, vectors(&b)?);
    check_same_length(a.len(), b.len())?;
    let angles = detach::map(py, a.len(), |i| metrics::acute(a[i], b[i]))?;
    Ok(PyArray1::from_vec(py, angles))
}

/// Signed curvatures from first and second analogues (flat x, y).
#[pyfunction]
pub(crate) fn curvature<'py>(
    py: Python<'py>,
    d1: PyReadonlyArray1<'py, f64>,
    d2: PyReadonlyArray1<'py, f64>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let (d1, d2) = (vectors(&d1)?, vectors(&d2)?);
    check_same_length(d1.len(), d2.len())?;
    let values = detach::map(py, d1.len(), |i| metrics::curvature(d1[i], d2[i]))?;
    Ok(PyArray1::from_vec(py, values))
}

/// Instant centres (flat x, y) of two links. Each link is given by a point, the point's first
/// analogue and the link's first analogue.
#[pyfunction]
pub(crate) fn instant_centre<'py>(
    py: Python<'py>,
    a: [PyReadonlyArray1<'py, f64>; 3],
    b: [PyReadonlyArray1<'py, f64>; 3],
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let read = |link: &[PyReadonlyArray1<'py, f64>; 3]| -> PyResult<_> {
        let [point, point_rate, angle_rate] = link;
        Ok((vectors(point)?, vectors(point_rate)?, reserve::copied(angle_rate)?))
    };
    let (a, b) = (read(&a)?, read(&b)?);
    check_same_length(a.2.len(), b.2.len())?;
    for (points, point_rates, angle_rates) in [&a, &b] {
        check_same_length(points.len(), angle_rates.len())?;
        check_same_length(point_rates.len(), angle_rates.len())?;
    }
    let centres = detach::map(py, a.2.len(), |i| {
        metrics::instant_centre((a.0[i], a.1[i], a.2[i]), (b.0[i], b.1[i], b.2[i]))
    })?;
    let numbers = centres.iter().flat_map(|p| [p.x, p.y]);
    Ok(PyArray1::from_vec(py, reserve::collected(2 * centres.len(), numbers)?))
}
