//! Point-wise metrics over flat arrays; Python reshapes.

use assur::{Vector, metrics};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::gate;

/// Pairs of a flat array of x, y.
fn pairs(array: &PyReadonlyArray1<'_, f64>) -> PyResult<Vec<Vector>> {
    Ok(array.as_slice()?.as_chunks::<2>().0.iter().map(|&[x, y]| Vector::new(x, y)).collect())
}

pub(crate) fn same(a: usize, b: usize) -> PyResult<()> {
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
    let (a, b) = (pairs(&a)?, pairs(&b)?);
    same(a.len(), b.len())?;
    let angles = gate::each(py, a.len(), |i| metrics::acute(a[i], b[i]))?;
    Ok(PyArray1::from_vec(py, angles))
}

/// Signed curvatures from first and second analogues (flat x, y).
#[pyfunction]
pub(crate) fn curvature<'py>(
    py: Python<'py>,
    d1: PyReadonlyArray1<'py, f64>,
    d2: PyReadonlyArray1<'py, f64>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let (d1, d2) = (pairs(&d1)?, pairs(&d2)?);
    same(d1.len(), d2.len())?;
    let values = gate::each(py, d1.len(), |i| metrics::curvature(d1[i], d2[i]))?;
    Ok(PyArray1::from_vec(py, values))
}

/// Instant centres (flat x, y) of two links, each by a point, its first
/// analogue and the link's.
#[pyfunction]
pub(crate) fn instant_centre<'py>(
    py: Python<'py>,
    a: [PyReadonlyArray1<'py, f64>; 3],
    b: [PyReadonlyArray1<'py, f64>; 3],
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let read = |link: &[PyReadonlyArray1<'py, f64>; 3]| -> PyResult<_> {
        let [place, rate, turn] = link;
        Ok((pairs(place)?, pairs(rate)?, turn.as_slice()?.to_vec()))
    };
    let (a, b) = (read(&a)?, read(&b)?);
    same(a.2.len(), b.2.len())?;
    for (places, rates, turns) in [&a, &b] {
        same(places.len(), turns.len())?;
        same(rates.len(), turns.len())?;
    }
    let centres = gate::each(py, a.2.len(), |i| {
        metrics::instant_centre((a.0[i], a.1[i], a.2[i]), (b.0[i], b.1[i], b.2[i]))
    })?;
    Ok(PyArray1::from_vec(py, centres.into_iter().flat_map(|p| [p.x, p.y]).collect()))
}
