//! The slider-crank of the papers over flat arrays; Python checks, broadcasts and reshapes.

use std::sync::atomic::Ordering;

use assur::papers::slider_crank as core;
use assur::papers::slider_crank::{Jet, Quantity, Series, SlowSeries};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;

use crate::metrics::same;
use crate::{error, gate};

/// Numbers below which a series is summed sooner than a person can interrupt it.
const SMALL: usize = 4096;

type Flat<'py> = PyReadonlyArray1<'py, f64>;
type Array<'py> = Bound<'py, PyArray1<f64>>;
/// Value and two analogues.
type Three<'py> = (Array<'py>, Array<'py>, Array<'py>);
/// Places and values.
type Two<'py> = (Array<'py>, Array<'py>);

fn three<'py>(py: Python<'py>, jets: &[Jet]) -> Three<'py> {
    let of = |k: usize| PyArray1::from_vec(py, jets.iter().map(|jet| jet.order(k)).collect());
    (of(0), of(1), of(2))
}

fn two(py: Python<'_>, places: Vec<f64>, values: Vec<f64>) -> Two<'_> {
    (PyArray1::from_vec(py, places), PyArray1::from_vec(py, values))
}

fn slow(error: SlowSeries) -> PyErr {
    error::input(error.to_string(), Some(error.k))
}

/// Of every pair of angle and ratio.
fn each<'py>(
    py: Python<'py>,
    phi: &Flat<'py>,
    ratio: &Flat<'py>,
    of: impl Fn(f64, f64) -> Jet + Sync,
) -> PyResult<Three<'py>> {
    let (phi, ratio) = (phi.as_slice()?.to_vec(), ratio.as_slice()?.to_vec());
    same(phi.len(), ratio.len())?;
    let jets = gate::each(py, phi.len(), |i| of(phi[i], ratio[i]))?;
    Ok(three(py, &jets))
}

/// Exact strokes per crank length.
#[pyfunction]
pub(crate) fn slider_crank_stroke<'py>(
    py: Python<'py>,
    phi: Flat<'py>,
    lambda_: Flat<'py>,
) -> PyResult<Three<'py>> {
    each(py, &phi, &lambda_, core::stroke)
}

/// Strokes by the fraction's approximation.
#[pyfunction]
pub(crate) fn slider_crank_fraction<'py>(
    py: Python<'py>,
    phi: Flat<'py>,
    lambda_: Flat<'py>,
    n: u32,
) -> PyResult<Three<'py>> {
    each(py, &phi, &lambda_, |phi, lambda| core::stroke_by_fraction(phi, lambda, n))
}

/// Angles of the rod.
#[pyfunction]
pub(crate) fn slider_crank_rod_angle<'py>(
    py: Python<'py>,
    phi: Flat<'py>,
    lambda_: Flat<'py>,
) -> PyResult<Three<'py>> {
    each(py, &phi, &lambda_, core::rod_angle)
}

/// Strokes by the series.
#[pyfunction]
pub(crate) fn slider_crank_series<'py>(
    py: Python<'py>,
    phi: Flat<'py>,
    k: Flat<'py>,
    harmonics: usize,
    terms: Option<usize>,
) -> PyResult<Three<'py>> {
    let (phi, k) = (phi.as_slice()?.to_vec(), k.as_slice()?.to_vec());
    same(phi.len(), k.len())?;
    let jets = gate::run(py, phi.len() < SMALL, |cancel| {
        // Designs mostly have their angles side by side.
        let mut last: Option<(f64, Series)> = None;
        let mut jets = Vec::with_capacity(phi.len());
        for (&phi, &k) in phi.iter().zip(&k).take_while(|_| !cancel.load(Ordering::Relaxed)) {
            let series = match last.take() {
                Some((own, series)) if own.to_bits() == k.to_bits() => series,
                _ => Series::new(k, harmonics, terms)?,
            };
            jets.push(series.stroke(phi));
            last = Some((k, series));
        }
        Ok(jets)
    })?;
    Ok(three(py, &jets.map_err(slow)?))
}

/// Coefficients, one k after another.
#[pyfunction]
pub(crate) fn slider_crank_fourier<'py>(
    py: Python<'py>,
    k: Flat<'py>,
    harmonics: usize,
    terms: Option<usize>,
) -> PyResult<Array<'py>> {
    let k = k.as_slice()?.to_vec();
    let all = gate::run(py, k.len() < SMALL, |cancel| {
        let mut all = Vec::new();
        for &k in k.iter().take_while(|_| !cancel.load(Ordering::Relaxed)) {
            let series = Series::new(k, harmonics.max(1), terms)?;
            all.extend_from_slice(series.coefficients());
        }
        Ok(all)
    })?;
    Ok(PyArray1::from_vec(py, all.map_err(slow)?))
}

/// Places of points of the rod, flat x, y, by order.
#[pyfunction]
pub(crate) fn slider_crank_rod_point<'py>(
    py: Python<'py>,
    phi: Flat<'py>,
    lambda_: Flat<'py>,
    along: Flat<'py>,
    across: Flat<'py>,
) -> PyResult<Three<'py>> {
    let (phi, lambda) = (phi.as_slice()?.to_vec(), lambda_.as_slice()?.to_vec());
    let (along, across) = (along.as_slice()?.to_vec(), across.as_slice()?.to_vec());
    same(phi.len(), lambda.len())?;
    same(along.len(), across.len())?;
    same(phi.len(), along.len())?;
    let jets =
        gate::each(py, phi.len(), |i| core::rod_point(phi[i], lambda[i], along[i], across[i]))?;
    Ok(three(py, &jets.into_iter().flatten().collect::<Vec<_>>()))
}

/// Angles of greatest speed, and the speeds; exactly, or by three terms of the series.
#[pyfunction]
pub(crate) fn slider_crank_greatest_speed<'py>(
    py: Python<'py>,
    k: Flat<'py>,
    exact: bool,
) -> PyResult<Two<'py>> {
    let k = k.as_slice()?.to_vec();
    let of = |k: f64| {
        if exact { Ok(core::greatest_speed(k)) } else { core::greatest_speed_by_series(k) }
    };
    let found = gate::each(py, k.len(), |i| of(k[i]))?;
    let found = found.into_iter().collect::<Result<Vec<_>, _>>().map_err(slow)?;
    let (places, values) = found.iter().map(|g| (g.at, g.value)).unzip();
    Ok(two(py, places, values))
}

/// Angles of the most negative acceleration, and the accelerations.
#[pyfunction]
pub(crate) fn slider_crank_greatest_acceleration<'py>(
    py: Python<'py>,
    k: Flat<'py>,
) -> PyResult<Two<'py>> {
    let k = k.as_slice()?.to_vec();
    let found = gate::each(py, k.len(), |i| core::greatest_acceleration(k[i]))?;
    let (places, values) = found.iter().map(|g| (g.at, g.value)).unzip();
    Ok(two(py, places, values))
}

/// Largest deviations of an approximation: relative, where, absolute, where.
#[pyfunction]
pub(crate) fn slider_crank_deviation<'py>(
    py: Python<'py>,
    lambda_: Flat<'py>,
    n: u32,
    order: usize,
) -> PyResult<(Array<'py>, Array<'py>, Array<'py>, Array<'py>)> {
    let quantity = [Quantity::Stroke, Quantity::First, Quantity::Second][order.min(2)];
    let lambda = lambda_.as_slice()?.to_vec();
    let found = gate::each(py, lambda.len(), |i| core::deviation(lambda[i], n, quantity))?;
    let relative = |of: fn(&core::Greatest) -> f64| {
        let one = |d: &core::Deviation| d.relative.as_ref().map_or(f64::NAN, of);
        PyArray1::from_vec(py, found.iter().map(one).collect())
    };
    let absolute = |of: fn(&core::Greatest) -> f64| {
        PyArray1::from_vec(py, found.iter().map(|d| of(&d.absolute)).collect())
    };
    Ok((relative(|g| g.value), relative(|g| g.at), absolute(|g| g.value), absolute(|g| g.at)))
}
