//! The slider-crank of the papers on flat arrays. Python checks, broadcasts and reshapes them.

use std::sync::atomic::Ordering;

use assur::papers::slider_crank as core;
use assur::papers::slider_crank::{Jet, Quantity, Series};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;

use crate::metrics::check_same_length;
use crate::{detach, error_map, reserve};

/// Values below which summing a series need not check for signals.
const FEW_VALUES: usize = 4096;

type Flat<'py> = PyReadonlyArray1<'py, f64>;
type Array<'py> = Bound<'py, PyArray1<f64>>;
/// Values, first and second analogues.
type Orders<'py> = (Array<'py>, Array<'py>, Array<'py>);
/// Angles and values.
type AnglesAndValues<'py> = (Array<'py>, Array<'py>);

fn orders<'py>(py: Python<'py>, jets: &[Jet]) -> PyResult<Orders<'py>> {
    let column = |k: usize| -> PyResult<_> {
        let values = reserve::collected(jets.len(), jets.iter().map(|jet| jet.order(k)))?;
        Ok(PyArray1::from_vec(py, values))
    };
    Ok((column(0)?, column(1)?, column(2)?))
}

fn angles_and_values(py: Python<'_>, angles: Vec<f64>, values: Vec<f64>) -> AnglesAndValues<'_> {
    (PyArray1::from_vec(py, angles), PyArray1::from_vec(py, values))
}

/// Evaluates a function for each pair of angle and ratio.
fn map_pairs<'py>(
    py: Python<'py>,
    phi: &Flat<'py>,
    ratio: &Flat<'py>,
    function: impl Fn(f64, f64) -> Jet + Sync,
) -> PyResult<Orders<'py>> {
    let (phi, ratio) = (reserve::copied(phi)?, reserve::copied(ratio)?);
    check_same_length(phi.len(), ratio.len())?;
    let jets = detach::map(py, phi.len(), |i| function(phi[i], ratio[i]))?;
    orders(py, &jets)
}

/// Exact strokes divided by the crank length.
#[pyfunction]
pub(crate) fn slider_crank_stroke<'py>(
    py: Python<'py>,
    phi: Flat<'py>,
    lambda_: Flat<'py>,
) -> PyResult<Orders<'py>> {
    map_pairs(py, &phi, &lambda_, core::stroke)
}

/// Strokes by the approximation with a fraction.
#[pyfunction]
pub(crate) fn slider_crank_fraction<'py>(
    py: Python<'py>,
    phi: Flat<'py>,
    lambda_: Flat<'py>,
    n: u32,
) -> PyResult<Orders<'py>> {
    map_pairs(py, &phi, &lambda_, |phi, lambda| core::stroke_by_fraction(phi, lambda, n))
}

/// Angles of the rod.
#[pyfunction]
pub(crate) fn slider_crank_rod_angle<'py>(
    py: Python<'py>,
    phi: Flat<'py>,
    lambda_: Flat<'py>,
) -> PyResult<Orders<'py>> {
    map_pairs(py, &phi, &lambda_, core::rod_angle)
}

/// Strokes by the series.
#[pyfunction]
pub(crate) fn slider_crank_series<'py>(
    py: Python<'py>,
    phi: Flat<'py>,
    k: Flat<'py>,
    harmonics: usize,
    terms: Option<usize>,
) -> PyResult<Orders<'py>> {
    let (phi, k) = (reserve::copied(&phi)?, reserve::copied(&k)?);
    check_same_length(phi.len(), k.len())?;
    let _room = reserve::room(py, phi.len().saturating_mul(size_of::<Jet>()))?;
    let jets = detach::run(py, phi.len() < FEW_VALUES, |cancel| {
        // Neighbouring values mostly belong to one design, with the same k.
        let mut last: Option<(f64, Series)> = None;
        let mut jets = Vec::with_capacity(phi.len());
        for (&phi, &k) in phi.iter().zip(&k).take_while(|_| !cancel.load(Ordering::Relaxed)) {
            let series = match last.take() {
                Some((last_k, series)) if last_k.to_bits() == k.to_bits() => series,
                _ => Series::new(k, harmonics, terms)?,
            };
            jets.push(series.stroke(phi));
            last = Some((k, series));
        }
        Ok(jets)
    })?;
    orders(py, &jets.map_err(error_map::series)?)
}

/// Fourier coefficients, one k after another.
#[pyfunction]
pub(crate) fn slider_crank_fourier<'py>(
    py: Python<'py>,
    k: Flat<'py>,
    harmonics: usize,
    terms: Option<usize>,
) -> PyResult<Array<'py>> {
    let k = reserve::copied(&k)?;
    let all = detach::run(py, k.len() < FEW_VALUES, |cancel| {
        let mut all = Vec::new();
        for &k in k.iter().take_while(|_| !cancel.load(Ordering::Relaxed)) {
            let series = Series::new(k, harmonics.max(1), terms)?;
            all.extend_from_slice(series.coefficients());
        }
        Ok(all)
    })?;
    Ok(PyArray1::from_vec(py, all.map_err(error_map::series)?))
}

/// Coordinates (flat x, y) of points of the rod and their analogues.
#[pyfunction]
pub(crate) fn slider_crank_rod_point<'py>(
    py: Python<'py>,
    phi: Flat<'py>,
    lambda_: Flat<'py>,
    along: Flat<'py>,
    across: Flat<'py>,
) -> PyResult<Orders<'py>> {
    let (phi, lambda) = (reserve::copied(&phi)?, reserve::copied(&lambda_)?);
    let (along, across) = (reserve::copied(&along)?, reserve::copied(&across)?);
    check_same_length(phi.len(), lambda.len())?;
    check_same_length(along.len(), across.len())?;
    check_same_length(phi.len(), along.len())?;
    let jets =
        detach::map(py, phi.len(), |i| core::rod_point(phi[i], lambda[i], along[i], across[i]))?;
    orders(py, jets.as_flattened())
}

/// Angles and values of the greatest speed, exact or by three terms of the series.
#[pyfunction]
pub(crate) fn slider_crank_greatest_speed<'py>(
    py: Python<'py>,
    k: Flat<'py>,
    exact: bool,
) -> PyResult<AnglesAndValues<'py>> {
    let k = reserve::copied(&k)?;
    let greatest = |k: f64| {
        if exact { Ok(core::greatest_speed(k)) } else { core::greatest_speed_by_series(k) }
    };
    let extremes = detach::map(py, k.len(), |i| greatest(k[i]))?;
    let extremes =
        extremes.into_iter().collect::<Result<Vec<_>, _>>().map_err(error_map::series)?;
    let (angles, values) = extremes.iter().map(|g| (g.at, g.value)).unzip();
    Ok(angles_and_values(py, angles, values))
}

/// Angles and values of the most negative acceleration.
#[pyfunction]
pub(crate) fn slider_crank_greatest_acceleration<'py>(
    py: Python<'py>,
    k: Flat<'py>,
) -> PyResult<AnglesAndValues<'py>> {
    let k = reserve::copied(&k)?;
    let extremes = detach::map(py, k.len(), |i| core::greatest_acceleration(k[i]))?;
    let (angles, values) = extremes.iter().map(|g| (g.at, g.value)).unzip();
    Ok(angles_and_values(py, angles, values))
}

/// Largest deviations of an approximation: relative, its angle, absolute, its angle.
#[pyfunction]
pub(crate) fn slider_crank_deviation<'py>(
    py: Python<'py>,
    lambda_: Flat<'py>,
    n: u32,
    order: usize,
) -> PyResult<(Array<'py>, Array<'py>, Array<'py>, Array<'py>)> {
    let quantity = [Quantity::Stroke, Quantity::First, Quantity::Second][order.min(2)];
    let lambda = reserve::copied(&lambda_)?;
    let deviations =
        detach::map_slow(py, lambda.len(), |i| core::deviation(lambda[i], n, quantity))?;
    let relative = |number: fn(&core::Greatest) -> f64| {
        let relative_number = |d: &core::Deviation| d.relative.as_ref().map_or(f64::NAN, number);
        PyArray1::from_vec(py, deviations.iter().map(relative_number).collect())
    };
    let absolute = |number: fn(&core::Greatest) -> f64| {
        PyArray1::from_vec(py, deviations.iter().map(|d| number(&d.absolute)).collect())
    };
    Ok((relative(|g| g.value), relative(|g| g.at), absolute(|g| g.value), absolute(|g| g.at)))
}
