//! The slider-crank of the papers over flat arrays; Python checks, broadcasts and reshapes.

use assur::slider_crank::{self as core, Jet, Quantity, Series, SlowSeries};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;

use crate::error;
use crate::metrics::same;

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
    let jets: Vec<Jet> =
        py.detach(|| phi.iter().zip(&ratio).map(|(&phi, &ratio)| of(phi, ratio)).collect());
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
    let jets = py.detach(|| {
        // Designs mostly have their angles side by side.
        let mut last: Option<(f64, Series)> = None;
        let mut jets = Vec::with_capacity(phi.len());
        for (&phi, &k) in phi.iter().zip(&k) {
            let series = match last.take() {
                Some((own, series)) if own.to_bits() == k.to_bits() => series,
                _ => Series::new(k, harmonics, terms)?,
            };
            jets.push(series.stroke(phi));
            last = Some((k, series));
        }
        Ok(jets)
    });
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
    let all = py.detach(|| {
        let mut all = Vec::new();
        for &k in &k {
            let series = Series::new(k, harmonics.max(1), terms)?;
            all.extend_from_slice(series.coefficients());
        }
        Ok(all)
    });
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
    let (phi, lambda) = (phi.as_slice()?, lambda_.as_slice()?);
    let (along, across) = (along.as_slice()?, across.as_slice()?);
    same(phi.len(), lambda.len())?;
    same(along.len(), across.len())?;
    same(phi.len(), along.len())?;
    let mut jets = Vec::with_capacity(2 * phi.len());
    for (i, &angle) in phi.iter().enumerate() {
        jets.extend(core::rod_point(angle, lambda[i], along[i], across[i]));
    }
    Ok(three(py, &jets))
}

/// Angles of greatest speed, and the speeds; exactly, or by three terms of the series.
#[pyfunction]
pub(crate) fn slider_crank_greatest_speed<'py>(
    py: Python<'py>,
    k: Flat<'py>,
    exact: bool,
) -> PyResult<Two<'py>> {
    let (mut places, mut values) = (Vec::new(), Vec::new());
    for &k in k.as_slice()? {
        let greatest = if exact {
            core::greatest_speed(k)
        } else {
            core::greatest_speed_by_series(k).map_err(slow)?
        };
        places.push(greatest.at);
        values.push(greatest.value);
    }
    Ok(two(py, places, values))
}

/// Angles of the most negative acceleration, and the accelerations.
#[pyfunction]
pub(crate) fn slider_crank_greatest_acceleration<'py>(
    py: Python<'py>,
    k: Flat<'py>,
) -> PyResult<Two<'py>> {
    let found: Vec<_> = k.as_slice()?.iter().map(|&k| core::greatest_acceleration(k)).collect();
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
    let found: Vec<_> =
        py.detach(|| lambda.iter().map(|&lambda| core::deviation(lambda, n, quantity)).collect());
    let relative = |of: fn(&core::Greatest) -> f64| {
        let one = |d: &core::Deviation| d.relative.as_ref().map_or(f64::NAN, of);
        PyArray1::from_vec(py, found.iter().map(one).collect())
    };
    let absolute = |of: fn(&core::Greatest) -> f64| {
        PyArray1::from_vec(py, found.iter().map(|d| of(&d.absolute)).collect())
    };
    Ok((relative(|g| g.value), relative(|g| g.at), absolute(|g| g.value), absolute(|g| g.at)))
}
