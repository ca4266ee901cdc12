//! The core's trigonometry on flat arrays: whole groups of lanes, then the rest one by one.

use assur::lanes::{LANES, Real};
use assur::{Lanes, trig};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;

use crate::detach;
use crate::metrics::check_same_length;
use crate::reserve;

type Array<'py> = Bound<'py, PyArray1<f64>>;

/// Sines and cosines.
#[pyfunction]
pub(crate) fn sin_cos<'py>(
    py: Python<'py>,
    x: PyReadonlyArray1<'py, f64>,
) -> PyResult<(Array<'py>, Array<'py>)> {
    let x = x.as_slice()?;
    let _room = reserve::room_for(py, 2 * x.len())?;
    detach::catch_panic(|| {
        let (mut sines, mut cosines) = (Vec::new(), Vec::new());
        let (groups, rest) = x.as_chunks::<LANES>();
        for group in groups {
            let (s, c) = trig::sin_cos(in_lanes(group));
            sines.extend(numbers(s));
            cosines.extend(numbers(c));
        }
        for &angle in rest {
            let (s, c) = trig::sin_cos(angle);
            sines.push(s);
            cosines.push(c);
        }
        Ok((PyArray1::from_vec(py, sines), PyArray1::from_vec(py, cosines)))
    })
}

/// Angles of points (x, y).
#[pyfunction]
pub(crate) fn atan2<'py>(
    py: Python<'py>,
    y: PyReadonlyArray1<'py, f64>,
    x: PyReadonlyArray1<'py, f64>,
) -> PyResult<Array<'py>> {
    angles(py, [&y, &x], trig::atan2, trig::atan2)
}

/// Angles of points at a distance of 1.
#[pyfunction]
pub(crate) fn unit_angle<'py>(
    py: Python<'py>,
    y: PyReadonlyArray1<'py, f64>,
    x: PyReadonlyArray1<'py, f64>,
) -> PyResult<Array<'py>> {
    angles(py, [&y, &x], |y, x| trig::unit_angle(x, y), |y, x| trig::unit_angle(x, y))
}

fn angles<'py>(
    py: Python<'py>,
    [y, x]: [&PyReadonlyArray1<'py, f64>; 2],
    of_lanes: fn(Lanes, Lanes) -> Lanes,
    of_one: fn(f64, f64) -> f64,
) -> PyResult<Array<'py>> {
    let (y, x) = (y.as_slice()?, x.as_slice()?);
    check_same_length(y.len(), x.len())?;
    let _room = reserve::room_for(py, y.len())?;
    detach::catch_panic(|| {
        let mut angles = Vec::new();
        for (y, x) in y.chunks(LANES).zip(x.chunks(LANES)) {
            if y.len() == LANES {
                angles.extend(numbers(of_lanes(in_lanes(y), in_lanes(x))));
            } else {
                angles.extend(y.iter().zip(x).map(|(&y, &x)| of_one(y, x)));
            }
        }
        Ok(PyArray1::from_vec(py, angles))
    })
}

/// Arc sines.
#[pyfunction]
pub(crate) fn asin<'py>(py: Python<'py>, x: PyReadonlyArray1<'py, f64>) -> PyResult<Array<'py>> {
    let x = x.as_slice()?;
    let _room = reserve::room_for(py, x.len())?;
    let (groups, rest) = x.as_chunks::<LANES>();
    detach::catch_panic(|| {
        let mut angles = Vec::new();
        for group in groups {
            angles.extend(numbers(trig::asin(in_lanes(group))));
        }
        angles.extend(rest.iter().map(|&sine| trig::asin(sine)));
        Ok(PyArray1::from_vec(py, angles))
    })
}

fn in_lanes(group: &[f64]) -> Lanes {
    Lanes::from_lanes(|lane| group[lane])
}

fn numbers(lanes: Lanes) -> impl Iterator<Item = f64> {
    (0..LANES).map(move |lane| lanes.lane(lane))
}
